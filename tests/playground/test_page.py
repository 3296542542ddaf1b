"""The playground: in a browser an arm is off by what compiled C says, and nothing comes from elsewhere."""

from __future__ import annotations

import html
import json
import math
import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support.browser import excess_on_a_phone

from tmm_gen.cli import main
from tmm_gen.native.loading import compile_kernel
from tmm_gen.playground.page import REFERENCE, served_names
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, load_scene

ROOT = Path(__file__).resolve().parents[2]

ARM = """
name = "two"
title = "Two <i>links</i>"
[model]
kind = "planar"
gravity = 9.81
[integrator]
name = "newmark"
step = 4e-3
[base]
kind = "motor"
inertia = 0.05
[beam]
length = 1.0
bending_stiffness = 3.0
mass_per_length = 0.5
links = 2
damping_time = 2e-3
[tip]
mass = 0.1
inertia = 1e-3
[[input]]
name = "push"
at = "tip"
acts = "force_y"
[[output]]
name = "tip"
at = "tip"
of = "position"
"""


TROLLEY = """
name = "trolley"
model = { kind = "spatial", gravity = [0, 0, -9.81] }
integrator = { name = "newmark", step = 1e-3 }
base.kind = "prescribed"
input = [{ name = "way", at = "base", acts = "place_x" }]
joint = [{ name = "sway", axis = "y" }]
body = [{ name = "load", on = "sway", mass = 2, center = [0, 0, -0.7], inertia = [0.1, 0.1, 0.1] }]
output = [{ name = "load", at = "load", of = "position" }]
"""


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the page of an arm of two links, by two integrators."""
    if not os.environ.get("CI"):
        pytest.importorskip("ziglang")
    folder = tmp_path_factory.mktemp("two")
    (folder / "two.toml").write_text(ARM)
    made = folder / "two.html"
    words = ["--integrators", "newmark", "--until", "0.5", "--out", str(made)]
    assert main(["playground", str(folder / "two.toml"), *words]) == 0
    return made


def held(text: str) -> dict[str, Any]:
    (found,) = re.findall(r'<script id="data" type="application/json">(.*?)</script>', text, re.S)
    return dict(json.loads(found))


def tips(scene: Scene, name: str, step: float, data: dict[str, Any], load: float) -> np.ndarray:
    """Return where the tip is over time, by C that gcc compiled."""
    scene = scene.replace(**{"integrator.name": name, "emit.trigonometry": "own"})
    program = build_program(scene)
    signals = {
        each["name"]: lambda t, a=each["amplitude"], w=each["frequency"]: load * a * math.sin(w * t)
        for each in data["signals"]
    }
    _, outputs = compile_kernel(program, scene).simulate(data["until"], signals, step=step)
    return np.array([outputs["tip_x"], outputs["tip_y"]])


def test_the_browser_finds_the_errors_that_compiled_c_makes(page: Path, browse: Callable[..., str]) -> None:
    text = page.read_text()
    data = held(text)
    # heavier, stiffer, pushed harder, at twice the scene's step
    heavier, stiffer, load, step = 2.0, 10**0.3, 1.5, 2 * data["step"]
    factors = [
        value / data["payload"]["values"][data["payload"]["own"]] for value in data["payload"]["values"]
    ]
    hash_ = f"#method=newmark&step=2&stiffness=0.3&payload={factors.index(heavier)}&load={load}"
    moved = page.with_name("moved.html")
    # The settings stand in the address, which a path has no room for. And a browser in virtual time does not wait for
    # what its other threads compile.
    at_once = "{ instance: new WebAssembly.Instance(new WebAssembly.Module(code)) }"
    for old, new in (
        ("location.hash", json.dumps(hash_)),
        ("await WebAssembly.instantiate(code, {})", at_once),
    ):
        assert old in text
        text = text.replace(old, new)
    moved.write_text(text)
    dom = browse(moved, "--dump-dom", "--virtual-time-budget=20000")
    assert re.search(r'<body[^>]* data-state="ready"', dom), "the page stopped on its way"
    (error,) = map(float, re.findall(r'id="error"[^>]* data-value="([^"]+)"', dom))
    (floor,) = map(float, re.findall(r'id="error"[^>]* data-floor="([^"]+)"', dom))

    scene = load_scene(page.with_name("two.toml")).replace(
        **{"tip.mass": 0.1 * heavier, "tip.inertia": 1e-3 * heavier, "beam.bending_stiffness": 3.0 * stiffer}
    )
    fine = tips(scene, REFERENCE, data["step"] / 2.0, data, load)
    double = tips(scene, REFERENCE, data["step"], data, load)
    found = tips(scene, "newmark", step, data, load)
    off = np.hypot(*(found - fine[:, :: round(2.0 * step / data["step"])]))
    assert error == pytest.approx(off.max(), rel=1e-9)
    assert floor == pytest.approx(np.hypot(*(double - fine[:, ::2])).max() / 15.0, rel=1e-6)
    assert floor < 1e-3 * error


def test_the_page_needs_nothing_else_and_fits_a_phone(
    page: Path, browse: Callable[..., str], tmp_path: Path
) -> None:
    text = page.read_text()
    assert not re.search(r"https?:|@import|<img|<iframe|\bfetch\(|XMLHttp|WebSocket|\bsrc\s*=|\burl\(", text)
    assert "default-src 'none'" in text, "and a browser would refuse what were asked for"
    assert re.findall(r"\bhref=\S+", text) == ['href="data:,">']
    assert "<i>" not in text
    assert html.escape("Two <i>links</i>") in text
    assert len(text) < 120_000
    assert excess_on_a_phone(text, tmp_path, browse) == 0


@pytest.mark.parametrize(
    ("scene", "words", "said"),
    [
        (TROLLEY, [], "the input 'way' moves its base in space, which a playground does not show yet"),
        ("scenes/cube.toml", ["--integrators", "gauss4"], "integrator 'gauss4': choose from "),
    ],
)
def test_what_no_page_shows_is_said(
    scene: str, words: list[str], said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("ziglang")
    path = ROOT / scene
    if scene == TROLLEY:
        path = tmp_path / "trolley.toml"
        path.write_text(scene)
    assert main(["playground", str(path), *words]) == 2
    error = capsys.readouterr().err
    assert error.startswith("error: ")
    assert said in error


def test_the_fine_integrator_is_always_there() -> None:
    scene = load_scene(ROOT / "scenes" / "arm10.toml")
    assert served_names(scene, ("bathe", "bathe")) == ("newmark", "bathe", REFERENCE)
