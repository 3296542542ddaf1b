"""The gallery: each picture leads to its playground, and what has none says why."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.playground.page import refusal
from tmm_gen.scene import load_scene

ROOT = Path(__file__).resolve().parents[2]
SCENES = {
    path: load_scene(path)
    for folder in ("scenes", "examples/space")
    for path in (ROOT / folder).glob("*.toml")
}
REFUSED = {path for path, scene in SCENES.items() if refusal(scene) is not None}


def test_all_playgrounds_are_of_the_scenes_that_have_one() -> None:
    """`make site PLAYGROUNDS=all` leaves out those that a playground refuses, and no other."""
    (listed,) = re.findall(r"^UNPLAYED := (.*)$", (ROOT / "Makefile").read_text(), re.MULTILINE)
    assert {ROOT / name for name in listed.split()} == REFUSED


@pytest.fixture
def website(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.syspath_prepend(str(ROOT / "website"))
    yield
    for name in ("gallery", "pictures"):
        sys.modules.pop(name, None)


@pytest.mark.usefixtures("website")
def test_a_picture_is_of_a_run_of_its_scene() -> None:
    from pictures import drawn, picture

    scene = load_scene(ROOT / "scenes" / "thesis2.toml")
    now, kept = (np.array(re.findall(r"\d+\.\d", text), float) for text in (drawn(scene), picture(scene)))
    np.testing.assert_allclose(now, kept, atol=0.2)  # px; the last digits are the machine's
    with pytest.raises(
        FileNotFoundError, match=r"thesis2\.svg is not of the scene as it is: run `python website/pict"
    ):
        picture(scene.replace(**{"integrator.step": 0.9 * scene.integrator.step}))


@pytest.mark.usefixtures("website")
def test_cards_lead_to_playgrounds_or_say_why_there_is_none() -> None:
    from gallery import cards

    made = {scene.name for path, scene in SCENES.items() if path not in REFUSED} - {"swing"}
    shown = cards(ROOT, made, "source")
    found = {re.findall(r'id="(\w+)"', card)[0]: card for card in shown.split("<section>")[1:]}
    assert set(found) == {scene.name for scene in SCENES.values()}
    for path, scene in SCENES.items():
        card = found[scene.name]
        assert bool(re.search(rf'<a href="playground/{scene.name}.html"[^>]*><svg', card)) == (
            scene.name in made
        )
        assert ("no playground: " in card) == (path in REFUSED)
    assert "its base floats in space" in found["satellite"]
    assert "moves the base" in found["arm50"]
