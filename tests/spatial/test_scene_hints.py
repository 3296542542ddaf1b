"""Hints at mistaken units of arms in space: silent on scenes as they are, each speaks up at its mistake."""

from __future__ import annotations

from pathlib import Path

import pytest

from tmm_gen.explain.hints import OF_BEAMS, hints
from tmm_gen.explain.space_hints import SPACE_HINTS
from tmm_gen.scene import load_scene, parse_scene
from tmm_gen.scene.template import template

SCENES = sorted((Path(__file__).parents[2] / "examples" / "space").glob("*.toml"))
CRANE = template("crane", "spatial")

MISTAKES = {
    "the arm reaches": ("length = 0.5 ", "length = 500 "),
    "gravity is": ("[0, 0, -9.81]", "[0, 0, -9810]"),
    "the radius of gyration is": ("inertia = [1e-4, 1e-4, 1e-4]", "inertia = [100, 100, 100]"),
    "behind its gear the rotor has": ("rotor_inertia = 1e-5", "rotor_inertia = 200"),
    "this is": ("shoulder = -0.3", "shoulder = -30"),
    "no solid between rubber": ("young = 70e9", "young = 70e3"),
    "no solid between foam": ("density = 2700", "density = 2.7"),
    "the section is": ("thickness = 0.005", "thickness = 5"),
}


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_scenes_as_they_are(path: Path) -> None:
    assert hints(load_scene(path)) == []


def test_the_template_is_silent_and_every_hint_is_tried() -> None:
    assert hints(parse_scene(CRANE)) == []
    assert len(MISTAKES) == len(OF_BEAMS) + len(SPACE_HINTS)


@pytest.mark.parametrize("said", MISTAKES)
def test_mistakes(said: str) -> None:
    text = CRANE.replace(*MISTAKES[said], 1)
    assert text != CRANE
    told = [hint for hint in hints(parse_scene(text, "crane.toml")) if said in hint]
    assert len(told) == 1
    assert told[0].startswith("crane.toml:")
