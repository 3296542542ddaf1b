"""The page that shows an arm in space in motion: what it holds, that it needs nothing else, what a browser shows."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import matplotlib.image
import numpy as np
import pytest
from support.browser import excess_on_a_phone
from support.spatial.random_arms import random_arm

from tmm_gen.report.space_motion import SpaceMotion
from tmm_gen.report.space_page import MOST_INSTANTS, motion_page, page_data
from tmm_gen.scene import load_scene
from tmm_gen.scene.spatial.arm import Frame, Revolute, SpatialArm

SCENES = Path(__file__).resolve().parents[2] / "examples" / "space"

TITLE = "An <b>arm</b> & </script> more"


@cache
def moved(name: str) -> SpaceMotion:
    """Return an arm of a scene in some motion of all its joints."""
    arm = load_scene(SCENES / f"{name}.toml").spatial
    assert arm is not None
    time = np.linspace(0.0, 3.0, 1501)
    start = np.array([joint.angle for joint in arm.joints])
    rates = np.random.default_rng(5).uniform(0.5, 2.0, len(start))
    return SpaceMotion(arm, time, start + 0.3 * np.sin(time[:, None] * rates))


@cache
def written(name: str) -> str:
    return motion_page(moved(name), name, TITLE, "newmark, step 0.001 s").decode()


def held(page: str) -> Any:
    (data,) = re.findall(r'<script id="motion" type="application/json">(.*?)</script>', page, re.DOTALL)
    return json.loads(data)


@pytest.mark.parametrize("name", ["yaw3", "arm6", "helix"])
def test_the_page_holds_the_points(name: str) -> None:
    motion, data = moved(name), held(written(name))
    skeleton = motion.skeleton
    assert len(data["points"]) == len(data["time"]) == MOST_INSTANTS
    assert (data["time"][0], data["time"][-1]) == (0.0, 3.0)
    rows = np.searchsorted(motion.time, np.array(data["time"]) - 1e-6)
    exact = np.concatenate(skeleton.places(motion.angles[rows]), axis=1)
    found = data["unit"] * np.array(data["points"]).reshape(exact.shape)
    assert np.max(np.abs(found - exact)) <= 0.5000001 * data["unit"]
    assert data["unit"] < 2.001e-4 * motion.reach
    assert [tuple(line) for line in data["lines"]] == list(skeleton.lines)
    assert [(tip["spot"], tip["name"]) for tip in data["tips"]] == [
        (tip.spot, tip.name) for tip in skeleton.tips
    ]
    for (spot, end), joint in zip(data["pins"], skeleton.pins, strict=True):
        assert spot == skeleton.of_joints[joint]
        far = np.linalg.norm(found[:, end] - found[:, spot], axis=1)
        assert np.allclose(far, skeleton.pin, rtol=0.0, atol=2.0 * data["unit"])


@pytest.mark.parametrize("name", ["yaw3", "arm6", "helix"])
def test_the_page_needs_nothing_else(name: str) -> None:
    page = written(name)
    assert not re.search(r"https?:|//\w+\.\w|@import|<link|<img|<iframe|\bfetch\(|XMLHttp|WebSocket", page)
    assert not re.search(r"\b(?:src|href|action)\s*=|\burl\(", page)
    assert "default-src 'none'" in page, "and a browser would refuse what were asked for"
    assert '<meta name="viewport" content="width=device-width, initial-scale=1">' in page
    assert len(page.encode()) < 400_000


def test_what_a_scene_says_is_no_markup() -> None:
    arm = SpatialArm((Revolute("a", 0),), (Frame("</script><b>", 1, (1.0, 0.0, 0.0)),))
    page = motion_page(SpaceMotion(arm, np.zeros(1), np.zeros((1, 1))), "a", TITLE, "<i>").decode()
    assert page.count("</script>") == 2
    assert "An &lt;b&gt;arm&lt;/b&gt; &amp; &lt;/script&gt; more" in page
    assert "<i>" not in page
    assert held(page)["tips"] == [{"spot": 1, "name": "</script><b>"}]


def test_the_page_of_a_long_arm_is_below_a_megabyte() -> None:
    joints = tuple(Revolute(f"j{k}", k, at=(0.01, 0.0, 0.0), axis=(2, 1)[k % 2]) for k in range(900))
    arm = SpatialArm(joints, tuple(Frame(f"j{k + 1}", k + 1) for k in range(0, 900, 2)))
    time = np.linspace(0.0, 60.0, 2000)
    page = motion_page(
        SpaceMotion(arm, time, 0.01 * np.sin(time)[:, None] * np.ones(900)), "long", "Long", ""
    )
    assert len(page) < 1_000_000
    assert len(held(page.decode())["time"]) > 20


@pytest.mark.parametrize("seed", range(6))
def test_views_stand_upright_and_are_no_mirror(seed: int) -> None:
    arm = random_arm(seed)
    data = page_data(SpaceMotion(arm, np.zeros(1), np.zeros((1, len(arm.joints)))))
    axes = np.array(data["axes"], dtype=float)
    assert np.array_equal(axes @ axes.T, np.eye(3))
    assert np.linalg.det(axes) == pytest.approx(1.0)
    assert axes[2] @ arm.gravity == pytest.approx(-np.max(np.abs(arm.gravity)))


# -- in a browser ---------------------------------------------------------------------------------


def probed(page: str, script: str, folder: Path, browse: Callable[..., str]) -> Any:
    """Return what a script in a page finds, once the page stands."""
    probe = """<script>addEventListener("load", () => setTimeout(async () => {
      const found = {};
      const at = (id) => document.getElementById(id);
      const drawn = () => new Promise((go) => setTimeout(go, 30));
      const key = (key, where = document.body) =>
        where.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }));
      SCRIPT
      const told = document.createElement("pre");
      told.id = "found";
      told.textContent = JSON.stringify(found);
      document.body.append(told);
    }, 50));</script></body>""".replace("SCRIPT", script)
    # a browser that only tells what stands in a page draws no frames
    frames = (
        "<script>window.requestAnimationFrame = (go) => setTimeout(() => go(performance.now()), 10)</script>"
    )
    page = page.replace("<body>", f"<body>{frames}")
    (folder / "probe.html").write_text(page.replace("</body>", probe))
    dom = browse(folder / "probe.html", "--dump-dom", "--window-size=900,700", "--virtual-time-budget=3000")
    (text,) = re.findall(r'<pre id="found">(.*?)</pre>', dom)
    return json.loads(text)


def test_keys_and_controls_do_what_the_page_says(browse: Callable[..., str], tmp_path: Path) -> None:
    script = """
    const label = () => at('play').textContent;
    const place = () => at('tips').textContent;
    const picture = () => at('arm').toDataURL();
    found.first = label();
    key(' '); found.paused = label();
    at('time').value = '500'; at('time').dispatchEvent(new Event('input')); await drawn();
    found.half = place(); found.clock = at('clock').textContent; found.said = at('time').ariaValueText
      ?? at('time').getAttribute('aria-valuetext');
    key('.'); await drawn(); found.next = place();
    key(','); await drawn(); found.back = place();
    const start = picture();
    key('ArrowRight'); await drawn(); const turned = picture();
    found.turned = turned !== start;
    key('+'); await drawn(); found.nearer = picture() !== turned;
    key('Home'); await drawn(); found.home = picture() === start;
    key('ArrowRight', at('pace')); await drawn(); found.kept = picture() === start;
    at('parallel').click(); await drawn(); found.parallel = picture() !== start;
    at('parallel').click(); await drawn(); found.perspective = picture() === start;
    const send = (type, x, y, more = {}) => at('arm').dispatchEvent(new PointerEvent(type,
      { pointerId: 1, clientX: x, clientY: y, buttons: 1, bubbles: true, ...more }));
    at('arm').setPointerCapture = () => {};
    send('pointerdown', 300, 300); send('pointermove', 340, 310); send('pointerup', 340, 310); await drawn();
    const dragged = picture(); found.dragged = dragged !== start;
    at('arm').dispatchEvent(new WheelEvent('wheel', { deltaY: 100, cancelable: true })); await drawn();
    found.wheeled = picture() !== dragged;
    at('reset').click(); await drawn(); found.reset = picture() === start;
    key(' '); found.last = label();
    """
    found = probed(written("yaw3"), script, tmp_path, browse)
    assert (found["first"], found["paused"], found["last"]) == ("Pause", "Play", "Pause")
    data = held(written("yaw3"))
    assert found["clock"] == "1.50 of 3.00 s"
    assert found["said"] == "1.50 seconds"
    # half way lies between two instants
    half = np.array([told_place(found[each]) for each in ("half", "next", "back")])
    spot = data["tips"][0]["spot"]
    way = data["unit"] * np.array(data["points"], dtype=float)[:, 3 * spot : 3 * spot + 3]
    exact = [np.interp(1.5, data["time"], way[:, axis]) for axis in range(3)]
    assert half[0] == pytest.approx(exact, abs=6e-4)
    row = int(np.searchsorted(data["time"], 1.5))
    assert half[1] == pytest.approx(way[row], abs=6e-4)
    assert half[2] == pytest.approx(way[row - 1], abs=6e-4)
    flags = {name: value for name, value in found.items() if isinstance(value, bool)}
    assert len(flags) == 9
    assert all(flags.values()), flags


def told_place(text: str) -> list[float]:
    return [float(number.replace("\u2212", "-")) for number in re.findall(r"[-\u2212]?\d+\.\d+", text)]


def two_ends() -> SpaceMotion:
    """Return an arm that stands still, with two ends far from its base and from each other."""
    joints = (Revolute("a", 0, at=(0.0, 0.0, 0.3)), Revolute("b", 0, at=(0.0, 0.0, 0.3)))
    frames = (Frame("one", 1, (0.9, 0.5, 0.7)), Frame("two", 2, (-0.6, -0.7, 0.2)))
    return SpaceMotion(SpatialArm(joints, frames), np.array([0.0, 1.0]), np.zeros((2, 2)))


ENDS = np.array([[0.9, 0.5, 1.0], [-0.6, -0.7, 0.5]])


@pytest.mark.parametrize(("side", "across", "upward"), [("front", 0, 2), ("right", 1, 2), ("top", 0, 1)])
def test_views_are_true_to_scale(
    side: str, across: int, upward: int, browse: Callable[..., str], tmp_path: Path
) -> None:
    motion = two_ends()
    assert np.allclose(motion.skeleton.points(motion.angles)[0, [t.spot for t in motion.skeleton.tips]], ENDS)
    page = motion_page(motion, "two", "Two ends", "").decode()
    choose = (
        f"<script>at = (id) => document.getElementById(id); at('side').value = '{side}';"
        "at('side').dispatchEvent(new Event('change')); at('parallel').click(); at('play').click()</script></body>"
    )
    (tmp_path / "view.html").write_text(page.replace("</body>", choose))
    shot = tmp_path / "shot.png"
    browse(
        tmp_path / "view.html", f"--screenshot={shot}", "--window-size=900,800", "--virtual-time-budget=1000"
    )
    seen = matplotlib.image.imread(shot)[80:670, :, :3]  # without the legend
    places = []
    for colour in ((0xD5, 0x5E, 0x00), (0x00, 0x9E, 0x73)):
        near = np.argwhere(np.all(np.abs(seen - np.array(colour) / 255.0) < 0.02, axis=2))
        assert len(near) > 40, "the end is in sight"
        places.append((near.min(axis=0) + near.max(axis=0)) / 2.0)
    down, right = places[0] - places[1]
    apart = ENDS[0] - ENDS[1]
    scale = right / apart[across]
    assert scale > 100.0, "the arm fills the page"
    assert -down == pytest.approx(scale * apart[upward], abs=2.5)


def test_the_page_fits_a_phone(browse: Callable[..., str], tmp_path: Path) -> None:
    assert excess_on_a_phone(written("helix"), tmp_path, browse) == 0
