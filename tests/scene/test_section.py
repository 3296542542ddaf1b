"""Beams by material and section: the integrals of their sections, and how faults are told."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import pytest
import sympy

from tmm_gen.calibration.fitted_keys import default_keys
from tmm_gen.cli import main
from tmm_gen.scene import SceneError, parse_scene
from tmm_gen.scene.section import Section, Shape

GIVEN = "bending_stiffness = 12.0\nmass_per_length = 0.4\n"
MATERIAL = "material = { young = 70e9, density = 2700 }\n"
SECTION = 'section = { kind = "rectangle", width = 0.03, thickness = 0.002 }\n'
BOTH = MATERIAL + SECTION

D, t, w, r, a, y, z = sympy.symbols("D t w r a y z", positive=True)


def annulus(inner: sympy.Expr) -> tuple[sympy.Expr, sympy.Expr]:
    """Integrate 1 and the squared distance from the axis over what lies between two circles."""

    def over(what: sympy.Expr) -> sympy.Expr:
        return sympy.integrate(sympy.integrate(what * r, (r, inner, D / 2)), (a, 0, 2 * sympy.pi))

    return over(sympy.Integer(1)), over((r * sympy.sin(a)) ** 2)


def rectangle() -> tuple[sympy.Expr, sympy.Expr]:
    def over(what: sympy.Expr) -> sympy.Expr:
        return sympy.integrate(sympy.integrate(what, (y, -t / 2, t / 2)), (z, -w / 2, w / 2))

    return over(sympy.Integer(1)), over(y**2)


INTEGRALS: Mapping[Shape, Callable[[], tuple[sympy.Expr, sympy.Expr]]] = {
    "rectangle": rectangle,
    "tube": lambda: annulus(D / 2 - t),
    "circle": lambda: annulus(sympy.Integer(0)),
}
MEASURES = {"rectangle": {"width": w, "thickness": t}, "tube": {"diameter": D, "thickness": t}}
MEASURES["circle"] = {"diameter": D}


@pytest.mark.parametrize("shape", INTEGRALS)
def test_area_and_second_moment_are_those_integrals(shape: Shape) -> None:
    numbers = {"width": 0.03, "thickness": 0.002, "diameter": 0.017}
    measures = {key: numbers[key] for key in MEASURES[shape]}
    section = Section.model_validate({"kind": shape, **measures})
    values = {symbol: sympy.Rational(str(numbers[key])) for key, symbol in MEASURES[shape].items()}
    for made, integral in zip((section.area, section.second_moment), INTEGRALS[shape](), strict=True):
        assert float(made) == pytest.approx(float(integral.subs(values).evalf(30)), rel=1e-15)


def test_a_wall_as_thick_as_the_radius_leaves_no_bore() -> None:
    tube = Section(kind="tube", diameter=0.02, thickness=0.01)
    circle = Section(kind="circle", diameter=0.02)
    assert (tube.area, tube.second_moment) == (circle.area, circle.second_moment)


def test_a_beam_by_its_section_is_the_beam_by_its_numbers(planar: str) -> None:
    """70e9 * 0.03 * 0.002^3/12 = 1.4 and 2700 * 0.03 * 0.002 = 0.162, exactly; shear says nothing here."""
    made = parse_scene(planar.replace(GIVEN, BOTH))
    numbers = "bending_stiffness = 1.4\nmass_per_length = 0.162\n"
    assert made == parse_scene(planar.replace(GIVEN, numbers))
    assert made == parse_scene(
        planar.replace(GIVEN, MATERIAL.replace("2700", "2700, shear = 26e9") + SECTION)
    )


@dataclass(frozen=True)
class Case:
    """How a beam is written, the key at fault, what is said, and what mends it: the text that the remedy stands for."""

    written: str
    key: str
    words: str
    remedy: str
    mended: str


ROUND = 'section = { kind = "circle", diameter = 0.01 }\n'
WALL = 'section = {{ kind = "tube", diameter = 0.02, thickness = {} }}\n'
CASES = {
    "nothing": Case("", "bending_stiffness", "is missing", "`bending_stiffness = 3.2` and", GIVEN),
    "half of the numbers": Case(
        "mass_per_length = 0.4\n", "bending_stiffness", "is missing beside mass_per_length", "3.2", GIVEN
    ),
    "material alone": Case(MATERIAL, "section", "is missing beside material", SECTION.strip(), BOTH),
    "section alone": Case(SECTION, "material", "is missing beside section", MATERIAL.strip(), BOTH),
    "both": Case(
        GIVEN + MATERIAL + SECTION, "bending_stiffness", "does not go with material", "alone", GIVEN
    ),
    "a half of each": Case(
        "mass_per_length = 0.4\n" + SECTION, "mass_per_length", "with section", "alone", BOTH
    ),
    "unknown shape": Case(
        MATERIAL + SECTION.replace("rectangle", "rectangel"),
        "section.kind",
        "is not one of the choices",
        "'rectangle'",
        BOTH,
    ),
    "no width": Case(
        MATERIAL + SECTION.replace("width = 0.03, ", ""),
        "section.width",
        "is missing: a rectangle has width and thickness",
        "`width = 0.03`",
        BOTH,
    ),
    "a circle with a wall": Case(
        MATERIAL + ROUND.replace(" }", ", thickness = 0.001 }"),
        "section.thickness",
        "is no measure here: a circle has diameter",
        "Remove it.",
        MATERIAL + ROUND,
    ),
    "a wall of more than the radius": Case(
        MATERIAL + WALL.format(0.011),
        "section.thickness",
        "must be at most 0.01, the outer radius",
        '`kind = "circle"`',
        MATERIAL + ROUND,
    ),
    "no thickness at all": Case(
        MATERIAL + SECTION.replace("0.002", "0"), "section.thickness", "must be greater than 0", "0.002", BOTH
    ),
    "negative density": Case(
        MATERIAL.replace("2700", "-2700") + SECTION, "material.density", "greater than 0", "2700", BOTH
    ),
    "no modulus": Case(
        "material = { density = 2700 }\n" + SECTION, "material.young", "is missing", "70e9", BOTH
    ),
    "unknown key": Case(
        MATERIAL.replace("young", "yuong") + SECTION, "material.yuong", "is not a key of", "'young'", BOTH
    ),
    "no table": Case("material = 7.0\n" + SECTION, "material", "must be a table", "[beam.material]", BOTH),
    "beyond numbers": Case(
        MATERIAL.replace("70e9", "1e308") + SECTION.replace("0.03", "1e150").replace("0.002", "1e150"),
        "section",
        "give a bending stiffness of inf",
        "Check the units",
        BOTH,
    ),
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
@pytest.mark.parametrize("parts", [False, True], ids=["[beam]", "[[beam]]"])
def test_faults_are_told_with_a_remedy_that_works(planar: str, case: Case, parts: bool) -> None:
    text, table = planar, "beam"
    if parts:
        for old, new in (
            ("[beam]\n", '[[motor]]\nname = "m"\n\n[[beam]]\nname = "a"\non = "m"\n'),
            ('kind = "motor"\ninertia = 0.05', 'kind = "clamp"'),
            ("[tip]", '[[body]]\nname = "load"'),
            ('at = "base"', 'at = "m"'),
        ):
            assert old in text
            text = text.replace(old, new)
        table = "beam[1]"
    with pytest.raises(SceneError) as caught:
        parse_scene(text.replace(GIVEN, case.written), "a.toml")
    problem = next(p for p in caught.value.problems if p.key == f"{table}.{case.key}")
    assert case.words in problem.message
    assert case.remedy in problem.remedy
    lines = text.replace(GIVEN, case.written).splitlines()
    line = lines[problem.line - 1]
    assert case.key.split(".")[0] in line or line.strip("[]") == "beam"
    assert parse_scene(text.replace(GIVEN, case.mended)).links


def test_measures_can_be_set_and_explain_shows_what_follows(
    planar: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "arm.toml"
    path.write_text(planar.replace(GIVEN, BOTH))
    assert main(["explain", str(path), "--set", "beam.section.thickness=0.004", "--json"]) == 0
    row = json.loads(capsys.readouterr().out)["beams"][0]
    assert row == {
        "beam": "beam",
        "bending_stiffness": pytest.approx(8 * 1.4),
        "mass_per_length": 0.324,
        "from_section": True,
    }
    assert main(["explain", str(path)]) == 0
    assert "beam: EI = 1.4 N m^2 and 0.162 kg/m" in capsys.readouterr().out


def test_what_calibrate_fits_is_in_the_file(planar: str) -> None:
    assert default_keys(parse_scene(planar)) == ("beam.bending_stiffness", "beam.damping_time")
    made = parse_scene(planar.replace(GIVEN, BOTH))
    assert default_keys(made) == ("beam.material.young", "beam.damping_time")
