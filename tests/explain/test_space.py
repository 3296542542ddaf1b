"""What the parts of an arm in space cost: their operations and bytes are all of the program's, none counted twice."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from support.spatial.boom import BOOM
from support.spatial.moving import AFLOAT, TABLE

from tmm_gen.c_language.real import REALS
from tmm_gen.cli import main
from tmm_gen.explain.cost import footprint, footprint_of
from tmm_gen.explain.explain import explain
from tmm_gen.explain.explanation import Explained, Explanation
from tmm_gen.explain.space_shares import SHARED, shares
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.scene.check import document_of
from tmm_gen.scene.spatial.document import SpatialDocument

SUMMED = ("step", "output", "prepare", "state_bytes", "model_bytes")
TWIG = """
[[motor]]
name = "wag"
on = "base"
axis = "x"
[[link]]
name = "tail"
on = "wag"
end = [0, 0.2, 0]
mass = 0.1
[[link]]
name = "column"
on = "yaw"
end = [0.1, 0, 0.3]
mass = 0.2
"""
READ = """
[[input]]
name = "torque"
at = "yaw"
acts = "torque"
[[output]]
name = "wag"
at = "wag"
of = "angle"
"""


@pytest.fixture(scope="module")
def boom() -> Scene:
    return parse_scene(BOOM)


@pytest.fixture(scope="module")
def found(boom: Scene) -> Explanation:
    return explain(boom)


def shared(found: Explanation) -> list[Explained]:
    names = ("motor ", "joint '", "beam ", "input ", "output ", SHARED)
    return [each for each in found.terms if each.term.startswith(names)]


def named(found: Explanation, name: str) -> Explained:
    return next(each for each in found.terms if each.term == name)


def test_parts_loads_and_outputs_add_up_to_the_program(found: Explanation) -> None:
    mine = shared(found)
    assert [each.term for each in mine] == [
        "motor 'yaw'",
        "beam 'rod'",
        "input 'push'",
        SHARED,
        "output 'hand'",
        "output 'facing'",
        "output 'yaw'",
    ]
    for key in SUMMED:
        assert sum(getattr(each.worth, key) for each in mine) == getattr(found.own, key), key
        assert all(getattr(each.worth, key) >= 0 for each in mine)
    assert named(found, "beam 'rod'").why == "1 cell, joints 2 to 4, and the bodies of 'hand'"


def test_so_they_do_in_a_tree_with_first_steps() -> None:
    scene = parse_scene(BOOM.split("[[beam]]")[0].replace("newmark", "park") + TWIG + READ)
    document, program = document_of(scene.source), build_program(scene)
    assert isinstance(document, SpatialDocument)
    assert scene.spatial is not None
    assert program.startup
    mine = shares(document, scene.spatial, program, REALS["float32"])
    own = footprint_of(program, REALS["float32"])
    for key in SUMMED:
        assert sum(getattr(each.worth, key) for each in mine) == getattr(own, key), key
    assert all(each.worth.step > 0 for each in mine if each.name.startswith("motor"))


@pytest.mark.parametrize("text", [AFLOAT, TABLE], ids=["floats", "prescribed"])
def test_so_they_do_where_the_base_moves(text: str) -> None:
    scene = parse_scene(text)
    document, program = document_of(scene.source), build_program(scene)
    assert isinstance(document, SpatialDocument)
    assert scene.spatial is not None
    mine = shares(document, scene.spatial, program, REALS["float64"])
    own = footprint_of(program, REALS["float64"])
    for key in SUMMED:
        assert sum(getattr(each.worth, key) for each in mine) == getattr(own, key), key
    told = {each.name: each.why for each in mine}
    assert told.get("the base") == (None if scene.prescribed is None else "turns as input 'table' says")
    assert told[SHARED].startswith("the base, which floats") == (scene.prescribed is None)


def test_a_load_costs_what_the_arm_costs_less_without_it(found: Explanation) -> None:
    before, _, after = BOOM.partition('[[input]]\nname = "push"')
    without = parse_scene(before + after[after.index("[[output]]") :])
    assert [item.name for item in without.inputs] == ["torque"]
    assert named(found, "input 'push'").worth.step == found.own.step - footprint(without).step


def test_terms_are_counted_in_programs_with_and_without(found: Explanation, boom: Scene) -> None:
    assert {each.term: each.modelled for each in found.terms if each not in shared(found)} == {
        "gravity": True,
        "the last correction in each stage": True,
        "slopes by angles and rates": False,
        "joint damping": True,
        "rotors": True,
        "history that no step reads": False,
        "parameters that change between steps": False,
    }
    once = footprint(boom.replace(**{"model.iterations": 1}))
    assert named(found, "the last correction in each stage").worth == found.own - once
    exact = footprint(boom.replace(**{"model.linearisation": "newton", "model.iterations": 2}))
    assert named(found, "slopes by angles and rates").worth == exact - found.own
    assert found.everything.step > exact.step


def test_the_command_shows_them(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "small.toml"
    path.write_text(BOOM.split("[[beam]]")[0] + TWIG + READ)
    assert main(["explain", str(path), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    rows = {row["term"]: row for row in told["rows"]}
    assert rows["motor 'wag'"]["why"] == "joint 2 about its x axis, and the bodies of 'tail'"
    parts = [row for name, row in rows.items() if name.startswith(("motor", "input", "what"))]
    assert sum(row["operations_per_step"] for row in parts) == told["operations_per_step"]
