"""The scene `tmm-gen new` writes."""

from __future__ import annotations

from pathlib import Path

import pytest

from tmm_gen.scene import load_scene, parse_scene
from tmm_gen.scene.model import Kind
from tmm_gen.scene.template import template


@pytest.mark.parametrize("name", ["a", "arm10", "a_name_of_more_than_twenty_letters"])
@pytest.mark.parametrize("kind", ["chain", "planar"])
def test_template_is_a_valid_scene(name: str, kind: Kind) -> None:
    scene = parse_scene(template(name, kind))
    assert (scene.name, scene.model.kind) == (name, kind)


@pytest.mark.parametrize("kind", ["chain", "planar"])
def test_lines_commented_out_are_valid_too(kind: Kind) -> None:
    text = template("arm", kind)
    shown = text.replace("# [initial]", "[initial]").replace("# angles", "angles").replace("# rates", "rates")
    scene = parse_scene(shown)
    assert scene.initial.angles == (0.1,) * scene.stations


@pytest.mark.parametrize("kind", ["chain", "planar"])
def test_lines_fit_a_screen(kind: Kind) -> None:
    assert max(map(len, template("arm", kind).splitlines())) <= 100


def test_control_is_that_of_the_swing(repository: Path) -> None:
    """Tuned for that arm, and fair to start from."""
    swing = load_scene(repository / "scenes" / "swing.toml")
    assert parse_scene(template("crane", "planar", control=True)).control == swing.control
