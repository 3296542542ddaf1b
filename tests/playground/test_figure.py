"""Places that a page computes from angles are those of the arm."""

from __future__ import annotations

import html
import json
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.playground.figure import figure_of
from tmm_gen.playground.load import loads
from tmm_gen.resources import templates_dir
from tmm_gen.scene import load_scene
from tmm_gen.simulate.places import ends, node_places
from tmm_gen.simulate.prescribed import kernel_signals
from tmm_gen.simulate.skeleton import Skeleton
from tmm_gen.study.excitation import excitation

ROOT = Path(__file__).resolve().parents[2]


def test_a_page_puts_points_where_they_are(browse: Callable[..., str], tmp_path: Path) -> None:
    """Of an arm in space, one with two fingers, and two that float, at angles drawn at random."""
    draw = np.random.default_rng(1)
    scripts, expected = [], []
    scenes = (
        "examples/space/yaw3.toml",
        "scenes/gripper.toml",
        "scenes/cube.toml",
        "examples/space/satellite.toml",
    )
    for path in scenes:
        scene = load_scene(ROOT / path)
        angles = draw.uniform(-2.0, 2.0, (1, scene.stations))
        base = draw.uniform(-1.0, 1.0, 2 if scene.floats else 0)
        if scene.spatial is not None:
            if scene.spatial.base is not None:
                turn = draw.normal(size=4)
                base = np.concatenate([draw.uniform(-1.0, 1.0, 3), turn / np.linalg.norm(turn)])
            points = Skeleton(scene.spatial).points(np.concatenate([base, angles[0]])[None])[0]
        else:
            x, y = node_places(scene, angles)
            points = np.stack([x[0], y[0], np.zeros(scene.stations + 1)], axis=1)
            points[:, : len(base)] += base
        expected.append(points)
        row = json.dumps([*angles[0], *base])
        code = (templates_dir() / "playground" / "places.js").read_text()
        scripts.append(
            f"found.push((() => {{ const figure = {json.dumps(figure_of(scene))}; const row = {row};"
            f"const width = row.length; {code}; return places({{ states: Float64Array.from(row) }}, 0); }})());"
        )
    page = tmp_path / "places.html"
    shown = "document.body.textContent = JSON.stringify(found)"
    page.write_text(f"<!doctype html><body><script>const found = []; {' '.join(scripts)} {shown}</script>")
    (text,) = re.findall(r"<body>(.*?)</body>", browse(page, "--dump-dom"), re.S)
    for found, right in zip(json.loads(html.unescape(text)), expected, strict=True):
        assert np.array(found) == pytest.approx(right, abs=1e-12)


def test_loads_are_what_kernels_take() -> None:
    """A base's way with its rate and acceleration, before, on and after the way; and torques."""
    times = np.linspace(-0.1, 3.0, 40)
    for name, path in (("arm50", "scenes"), ("satellite", "examples/space")):
        scene = load_scene(ROOT / path / f"{name}.toml")
        signals = excitation(scene, until=2.0).signals
        told = {each["name"]: each for each in loads(scene, signals)}
        assert told.keys() == kernel_signals(scene, signals).keys()
        for key, signal in kernel_signals(scene, signals).items():
            each = told[key]
            if "way" in each:
                share = np.clip(times / each["duration"], 0.0, 1.0) - 0.5
                found = np.polynomial.Polynomial(each["way"])(share)
            else:
                found = each["amplitude"] * np.sin(each["frequency"] * times)
            assert found == pytest.approx(signal.at(times), abs=1e-12)


def test_tips_are_the_ends() -> None:
    scene = load_scene(ROOT / "scenes" / "gripper.toml")
    assert figure_of(scene)["tips"] == list(ends(scene))
    assert len(figure_of(scene)["tips"]) == 2
