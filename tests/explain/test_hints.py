"""Hints at mistaken units: silent on scenes as they are, and each speaks up at the mistake that it is for."""

from __future__ import annotations

import json
from pathlib import Path
from typing import NamedTuple

import pytest

from tmm_gen.cli import main
from tmm_gen.explain.hints import HINTS, Hint, hints
from tmm_gen.scene import load_scene, parse_scene
from tmm_gen.scene.check import document_of
from tmm_gen.scene.template import template

ROOT = Path(__file__).resolve().parents[2]
SCENES = sorted(
    [
        *(ROOT / "scenes").glob("*.toml"),
        *(path for path in (ROOT / "examples").rglob("*.toml") if not path.name.endswith(".flex.toml")),
    ]
)

ARM = """\
name = "arm"
model = { kind = "planar", gravity = 9.81 }
integrator = { name = "newmark", step = 1e-3 }
base = { kind = "clamp" }

[[beam]]
name = "upper"
length = 0.5
material = { young = 70e9, density = 2700 }
section = { kind = "rectangle", width = 0.03, thickness = 0.004 }
links = 3

[[joint]]
name = "elbow"
on = "upper"
stiffness = 20.0
rest = 0.5

[[link]]
name = "forearm"
on = "elbow"
length = 0.4
mass = 0.2
inertia = 3e-3

[[output]]
name = "tip"
at = "forearm"
of = "position"

[initial]
angles = [0.2, 0.5]
"""
BEAM = ARM.replace(
    'material = { young = 70e9, density = 2700 }\nsection = { kind = "rectangle", width = 0.03, thickness = 0.004 }',
    "bending_stiffness = 11.2\nmass_per_length = 0.324",
)
CHAIN = template("chain", "chain")


class Mistake(NamedTuple):
    """A unit that is not SI: what is written, what should have been, and the hint at it."""

    scene: str
    right: str
    wrong: str
    said: str
    key: str


MISTAKES = {
    "mm for m": Mistake(ARM, "length = 0.5", "length = 500", "the arm is 500 m long", "beam"),
    "um for m": Mistake(
        ARM.replace("length = 0.5", "length = 5e-4"), "length = 0.4", "length = 4e-4", "0.0009 m long", "beam"
    ),
    "mm/s^2 for m/s^2": Mistake(ARM, "9.81", "9810", "gravity is 9.81e+03 m/s^2", "model.gravity"),
    "MPa for Pa": Mistake(ARM, "70e9", "70e3", "between rubber and diamond has 7e+04 Pa", "beam[1].material.young"),
    "mPa for Pa": Mistake(ARM, "70e9", "70e12", "between rubber and diamond has 7e+13", "beam[1].material.young"),
    "g/cm^3 for kg/m^3": Mistake(ARM, "2700", "2.7", "between foam and osmium has 2.7", "beam[1].material.density"),
    "g/m^3 for kg/m^3": Mistake(ARM, "2700", "2.7e6", "foam and osmium has 2.7e+06", "beam[1].material.density"),
    "mm for m in a section": Mistake(
        ARM, "0.03, thickness = 0.004", "30, thickness = 4", "8 times as high", "beam[1].section.thickness"
    ),
    "N mm^2 for N m^2": Mistake(BEAM, "11.2", "11.2e6", "that of no material and section", "beam[1].bending_stiffness"),
    "g/m for kg/m": Mistake(BEAM, "0.324", "324", "that of no material and section", "beam[1].bending_stiffness"),
    "g for kg": Mistake(ARM, "mass = 0.2", "mass = 200", "weighs 500 kg per m", "link[1].mass"),
    "g for kg in a payload": Mistake(
        ARM.replace("[[output]]", '[[body]]\nname = "tool"\non = "forearm"\nmass = 0.3\n\n[[output]]'),
        "mass = 0.3", "mass = 300", "weighs 829 times as much", "body[1].mass",
    ),
    "g for kg at the tip": Mistake(template("a", "planar"), "mass = 0.1", "mass = 100", "weighs 250 times", "tip.mass"),
    "kg mm^2 for kg m^2": Mistake(ARM, "3e-3", "3e3", "radius of gyration is 306 times", "link[1].inertia"),
    "g cm^2 for kg m^2 of a rotor": Mistake(
        template("a", "planar", motors=2).replace("2e-5", "3e-5", 1), "3e-5", "300", "times the inertia of the arm",
        "motor[1].rotor_inertia",
    ),
    "degrees in rest": Mistake(ARM, "rest = 0.5", "rest = 28.6", "this is 4.55 turns", "joint[1].rest"),
    "degrees at the start": Mistake(ARM, "[0.2, 0.5]", "[11.5, 28.6]", "this is 2.72 turns", "initial.angles"),
    "kg mm^2 in a chain": Mistake(CHAIN.replace("20.0", "20e-3"), "= 1.0 ", "= 1e6 ", "slowest vibration has", "joint"),
    "N mm for N m, g mm^2 for kg m^2": Mistake(
        CHAIN.replace("1.0 ", "1e-9").replace("0.8", "0.8e-9"), "20.0", "20e6", "slowest vibration has", "joint"
    ),
    "MN m^2 for N m^2": Mistake(BEAM, "11.2", "11.2e-6", "slowest vibration has", "joint"),
}  # fmt: skip


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_nothing_is_said_of_good_scenes(path: Path) -> None:
    assert hints(load_scene(path)) == []


@pytest.mark.parametrize(
    "text", [ARM, BEAM, CHAIN, template("a", "planar"), template("a", "planar", motors=3)]
)
def test_nothing_is_said_of_templates_nor_of_what_the_mistakes_start_from(text: str) -> None:
    assert hints(parse_scene(text)) == []


@pytest.mark.parametrize("mistake", MISTAKES.values(), ids=MISTAKES)
def test_a_mistake_is_hinted_at(mistake: Mistake) -> None:
    assert mistake.right in mistake.scene
    text = mistake.scene.replace(mistake.right, mistake.wrong)
    found = [hint for hint in hints(parse_scene(text, "a.toml")) if mistake.said in hint]
    assert len(found) == 1
    place, key, _ = found[0].split(": ", 2)
    assert key == mistake.key
    assert place.startswith("a.toml:")


@pytest.mark.parametrize("hint", HINTS, ids=lambda hint: hint.said)
@pytest.mark.parametrize("side", ["low", "high"])
def test_each_bound_is_passed_by_a_mistake(hint: Hint, side: str) -> None:
    """A bound that no mistake passes would say nothing, or is zero for what cannot be less."""
    if side == "low" and hint.low == 0.0:
        return
    for mistake in MISTAKES.values():
        scene = parse_scene(mistake.scene.replace(mistake.right, mistake.wrong))
        values = [value for _, value in hint.measured(scene, document_of(scene.source))]
        if any(value < hint.low if side == "low" else value > hint.high for value in values):
            return
    pytest.fail(f"no mistake has a value {'below' if side == 'low' else 'above'} the bound")


@pytest.mark.parametrize("command", ["explain", "run", "build", "check"])
def test_commands_hint_and_go_on(
    command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    path = Path("arm.toml")
    path.write_text(CHAIN.replace("= 1.0 ", "= 1e9 ").replace("repeat = 2", "repeat = 1"))
    more = ["--until", "1"] if command == "run" else []
    assert main([command, str(path), *more]) == 0
    shown = capsys.readouterr()
    hint = shown.err.strip()
    assert hint.startswith("hint: arm.toml:")
    assert "slowest vibration" in hint
    assert "hint" not in shown.out
    more += ["--check"] if command == "build" else []  # a build hints at what it builds, and that is done
    assert main([command, str(path), *more, "--json"]) == 0
    shown = capsys.readouterr()
    assert json.loads(shown.out)["hints"] == [hint.removeprefix("hint: ")]
    assert shown.err == ""
