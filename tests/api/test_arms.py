"""Arms of files and of tables: the same checks, the same words; changes, texts, what is shown."""

from __future__ import annotations

import copy
import pickle
import subprocess
import sys
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import tmm_gen as tg
from tmm_gen.api.tables import Tables
from tmm_gen.scene.document import Document
from tmm_gen.scene.parts.document import PartsDocument
from tmm_gen.scene.spatial.document import SpatialDocument
from tmm_gen.scene.table import file_keys


def test_tables_and_a_file_say_the_same(rod: tg.Arm, tmp_path: Path) -> None:
    file = rod.save(tmp_path / "rod.toml")
    assert tg.load(file) == tg.load(str(file)) == tg.parse(file.read_text()) == rod
    assert tg.Arm(rod.scene.source.data) == rod


def test_an_editor_knows_every_table() -> None:
    assert set(Tables.__annotations__) == {
        key for document in (Document, PartsDocument, SpatialDocument) for key in file_keys(document)
    }


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("beam.length", -1.0),
        ("beam.lenght", 1.0),
        ("beam.links", "3"),
        ("integrator.name", "newmrk"),
        ("tip.mass", float("nan")),
        ("base.kind", "clmp"),
        ("output", []),
    ],
)
def test_faults_are_told_in_the_words_for_files(rod: tg.Arm, key: str, value: object) -> None:
    tables = copy.deepcopy(dict(rod.scene.source.data))
    place: Any = tables
    *way, last = key.split(".")
    for word in way:
        place = place.setdefault(word, {})
    place[last] = value
    told = []
    for attempt in (
        lambda: tg.Arm(tables),
        lambda: tg.parse(rod.toml()).with_({key: value}),
    ):
        with pytest.raises(tg.SceneError) as caught:
            attempt()
        told.append([(p.key, p.message, p.remedy) for p in caught.value.problems])
    assert told[0] == told[1]
    assert str(caught.value).startswith("<string>")
    with pytest.raises(tg.UserError, match=r"^arm 'rod': "):
        tg.Arm(tables)


def test_values_of_numpy_and_absent_ones() -> None:
    tables: Any = {
        "name": "one",
        "title": None,
        "model": {"kind": "chain"},
        "integrator": {"name": "newmark", "step": np.float64(0.01)},
        "base": {"kind": "clamp"},
        "joint": ({"stiffness": np.float32(2.0), "repeat": np.int64(2)},),
        "link": [{"inertia": 1.0, "repeat": 2}],
        "output": [{"name": "end", "at": "tip", "of": "angle"}],
        "initial": {"angles": np.array([0.1, 0.2])},
    }
    arm = tg.Arm(tables)
    assert arm.scene.initial.angles == (0.1, 0.2)
    assert tg.parse(arm.toml()) == arm


@pytest.mark.parametrize(
    ("tables", "words"),
    [
        ([1], "takes tables by name, or a mapping of them, not list"),
        ({"name": b"arm"}, "name: must be text, not bytes"),
        ({"name": "arm", 3: 4}, r"has a key that is no text \(got 3\)"),
        ({"name": "arm", "beam": {3: 4}}, r"beam: has a key that is no text \(got 3\)"),
        ({"name": "arm", "beam": object()}, "beam: must be a table"),
        ({}, "arm: name: is missing"),
    ],
)
def test_what_no_file_could_say(tables: Any, words: str) -> None:
    with pytest.raises(tg.UserError, match=words):
        tg.Arm(tables)


def test_tables_without_an_end() -> None:
    endless: dict[str, Any] = {"name": "arm"}
    endless["beam"] = endless
    with pytest.raises(tg.SceneError, match="nested too deeply"):
        tg.Arm(endless)


def test_changes(rod: tg.Arm) -> None:
    finer = rod.with_({"integrator.step": 1e-3}, beam__links=3)
    assert (finer.scene.stations, finer.scene.integrator.step) == (3, 1e-3)
    assert rod.scene.stations == 2
    assert finer.with_(beam__links=2, integrator__step=2e-3) == rod
    assert rod.with_(initial=None).scene.initial.angles == (0.0, 0.0)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda arm: arm.with_(beam__link=3), r"with beam.link = 3\): beam.link: .* Did you mean 'links'"),
        (lambda arm: arm.with_(link__2__mass=1.0), r"link\[2\].mass: is not in this scene"),
        (lambda arm: arm.with_({"beam.links": 3}, beam__links=4), "beam.links: is given twice"),
        (lambda arm: arm.with_([1]), "must be a mapping from dotted keys to values, not list"),
        (lambda arm: arm.with_({3: 1}), "3 is no key"),
        (lambda arm: arm.save("arm.txt"), r"arm.txt: must end in \.toml"),
        (lambda arm: arm.build(""), "'' is no name of a file or folder"),
        (lambda arm: tg.load("nowhere.toml"), "nowhere.toml: no such file"),
        (lambda arm: tg.load(None), "None is no name of a file"),
        (lambda arm: tg.parse(3), "takes the text of a scene file, not int"),
    ],
)
def test_refusals_end_at_the_call(rod: tg.Arm, change: Callable[[tg.Arm], object], words: str) -> None:
    with pytest.raises(tg.UserError, match=words) as caught:
        change(rod)
    inside = [frame.filename for frame in traceback.extract_tb(caught.value.__traceback__)]
    assert [Path(name).name for name in inside if "tmm_gen" in name] == ["guard.py"]


def test_what_is_shown(rod: tg.Arm, probe: tg.Arm) -> None:
    assert repr(rod) == "<Arm rod: planar, 2 links, newmark at 0.002 s>"
    assert rod.inputs == {"push": "N", "hub_torque": "N m"}
    assert rod.outputs == {"tip_x": "m", "tip_y": "m", "root": "N m", "moving": "J"}
    assert list(probe.inputs) == ["thrust_x", "thrust_y", "thrust_z"]
    assert "kinetic energy of the arm" in rod._repr_html_()
    assert pickle.loads(pickle.dumps(rod)) == copy.copy(rod) == rod
    assert len({rod, copy.copy(rod), probe}) == 2


def test_nothing_slow_is_imported_before_it_is_used() -> None:
    source = """
import sys
import tmm_gen as tg
slow = {"numpy", "pydantic", "click", "sympy", "scipy", "casadi", "matplotlib"}
assert not slow & set(sys.modules), slow & set(sys.modules)
assert {"Arm", "load", "sweep"} <= set(dir(tg))
tg.load("scenes/elbow.toml").with_(beam__upper__links=2)
assert not {"sympy", "casadi", "matplotlib"} & set(sys.modules)
"""
    subprocess.run([sys.executable, "-c", source], cwd=Path(__file__).parents[2], check=True)


def test_names_that_are_not_there() -> None:
    with pytest.raises(AttributeError, match="module 'tmm_gen' has no attribute 'laod'"):
        tg.laod  # type: ignore[attr-defined]  # noqa: B018
