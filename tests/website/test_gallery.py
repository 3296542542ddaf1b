"""The gallery: each picture leads to its playground where that was made."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.playground.page import require_played
from tmm_gen.scene import load_scene

ROOT = Path(__file__).resolve().parents[2]
SCENES = {
    path: load_scene(path)
    for folder in ("scenes", "examples/space")
    for path in (ROOT / folder).glob("*.toml")
}


def test_every_scene_has_a_playground() -> None:
    for scene in SCENES.values():
        require_played(scene)


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
def test_cards_lead_to_playgrounds() -> None:
    from gallery import cards

    made = {scene.name for scene in SCENES.values()} - {"swing"}
    shown = cards(ROOT, made, "source")
    found = {re.findall(r'id="(\w+)"', card)[0]: card for card in shown.split("<section>")[1:]}
    assert set(found) == {scene.name for scene in SCENES.values()}
    for name, card in found.items():
        assert bool(re.search(rf'<a href="playground/{name}.html"[^>]*><svg', card)) == (name in made)
