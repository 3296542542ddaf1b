"""Every malformed scene is answered with file, line, key, value and remedy."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pytest

from tmm_gen.scene import Problem, SceneError, load_scene, parse_scene


@dataclass(frozen=True)
class Case:
    """A change to a good scene and the complaint it must cause."""

    name: str
    old: str
    new: str
    line: int
    key: str
    value: object
    remedy: str
    message: str = ""


TABLES = [
    Case("unknown key", "stiffness = 20.0", "stifness = 20.0", 17, "joint[1].stifness", 20.0, "'stiffness'?"),
    Case("key of another table", 'title = "An arm"', "gravity = 9.81", 2, "gravity", 9.81, "in [model]"),
    Case("unknown table", "[[output]]", "[[outptu]]", 34, "outptu", None, "'output'?"),
    Case("missing key", "step = 0.01\n", "", 8, "integrator.step", None, "`step = 0.001`", "missing"),
    Case("missing table", '[base]\nkind = "clamp"\n', "", 1, "base", None, '`kind = "clamp"`', "missing"),
    Case("missing name", 'name = "arm"\n', "", 1, "name", None, '`name = "arm10"`', "missing"),
    Case("one bracket too few", "[[output]]", "[output]", 34, "output", None, "[[output]] with double"),
    Case(
        "one bracket once",
        "[[link]]",
        "[link]",
        20,
        "link",
        "[link]",
        "[[link]], with double brackets, as in",
    ),
    Case("one bracket too many", "[base]", "[[base]]", 13, "base", [{"kind": "clamp"}], "[base] with single"),
    Case("value for a table", "[base]\nkind", "base", 1, "base", None, "[base]"),
    Case("no choice", '"riccati"', '"ricatti"', 6, "model.sweep", "ricatti", "'riccati'?"),
    Case("no choice at all", '"riccati"', "true", 6, "model.sweep", True, "riccati, product"),
    Case("text for a number", "step = 0.01", 'step = "0.01"', 10, "integrator.step", "0.01", "quotes"),
    Case("boolean for a number", "= 20.0", "= true", 17, "joint[1].stiffness", True, "`stiffness = 20.0`"),
    Case("date for a number", "= 20.0", "= 2024-01-01", 17, "joint[1].stiffness", None, "`stiffness = 20.0`"),
    Case("number for text", '"An arm"', "10", 2, "title", 10, "`title ="),
    Case(
        "negative inertia", "inertia = 2.0", "inertia = -2.0", 27, "link[2].inertia", -2.0, "`inertia = 1.0`"
    ),
    Case("zero stiffness", "= 10.0", "= 0", 24, "joint[2].stiffness", 0, "N m/rad", "greater than 0"),
    Case("negative damping", "= 0.5", "= -0.5", 18, "joint[1].damping", -0.5, "N m s/rad", "at least 0"),
    Case("infinite number", "= 20.0", "= inf", 17, "joint[1].stiffness", float("inf"), "20.0", "finite"),
    Case("integer beyond floats", "= 20.0", f"= 1{'0' * 400}", 17, "joint[1].stiffness", 10**400, "20.0"),
    Case("zero step", "step = 0.01", "step = 0", 10, "integrator.step", 0, "in s", "greater than 0"),
    Case(
        "fractional count",
        "inertia = 1.0",
        "inertia = 1.0\nrepeat = 1.5",
        22,
        "link[1].repeat",
        1.5,
        "`repeat",
    ),
    Case("too many copies", "= 1.0", "= 1.0\nrepeat = 10000000", 22, "link[1].repeat", 10**7, "10", "100000"),
]

NAMES = [
    Case("not an identifier", '"arm"', '"my arm"', 1, "name", "my arm", "'my_arm'?"),
    Case("file name for a name", '"arm"', '"arm.toml"', 1, "name", "arm.toml", "'arm'?"),
    Case("letters no compiler takes", '"arm"', '"بازو"', 1, "name", "بازو", "Write for example"),
    Case("leading digit", '"tip_torque"', '"2nd"', 30, "input[1].name", "2nd", "'arm_2nd'?"),
    Case("word of Python", '"tip_torque"', '"lambda"', 30, "input[1].name", "lambda", "'lambda_1'", "Python"),
    Case("name of the clock", '"tip_torque"', '"time"', 30, "input[1].name", "time", "'time_1'", "clock"),
    Case("module of Python", '"arm"', '"statistics"', 1, "name", "statistics", "'statistics_arm'", "hide"),
    Case("header of C", '"arm"', '"stdio"', 1, "name", "stdio", "'stdio_arm'", "hide"),
    Case("long name", '"arm"', f'"{"a" * 49}"', 1, "name", "a" * 49, "shorter"),
    Case("end of a comment", '"An arm"', '"a */ b"', 2, "title", "a */ b", "Remove", "*/"),
    Case("two lines of title", '"An arm"', '"a\\nb"', 2, "title", "a\nb", "line breaks"),
    Case(
        "name used twice",
        'name = "tip"',
        'name = "tip_torque"',
        35,
        "output[1].name",
        "tip_torque",
        "another",
    ),
]

STATIONS = [
    Case("joint missing", "[[joint]]\nstiffness = 10.0\n", "", 24, "link[2]", None, "add 1 [[joint]]"),
    Case("link missing", "\n[[link]]\ninertia = 2.0\n", "", 23, "joint[2]", None, "add 1 [[link]]"),
    Case("planar link", '"chain"', '"planar"', 20, "link[1].mass", None, "`mass = 0.5`", "missing"),
    Case("mass in a chain", "= 1.0", "= 1.0\nmass = 3.0", 22, "link[1].mass", 3.0, "planar", "inertia"),
    Case("gravity in a chain", '"chain"', '"chain"\ngravity = 9.81', 6, "model.gravity", 9.81, "Remove it"),
    Case("newton in a chain", '"chain"', '"chain"\niterations = 2', 6, "model.iterations", 2, "Remove it"),
    Case("corrected chain", '"chain"', '"chain"\ncorrections = 1', 6, "model.corrections", 1, "Remove it"),
    Case("tip in a chain", "[base]", "[tip]\nmass = 1\n[base]", 13, "tip", None, "last [[link]]"),
    Case(
        "too few angles",
        "[base]",
        "[initial]\nangles = [1]\n[base]",
        14,
        "initial.angles",
        (1.0,),
        "one per link",
    ),
    Case("no angles", "[base]", "[initial]\nrates = ['a', 1]\n[base]", 14, "initial.rates", ["a", 1], "0.1"),
    Case("hub of a clamp", '"clamp"', '"clamp"\ninertia = 1.0', 15, "base.inertia", 1.0, '"motor"'),
    Case("motor without a hub", '"clamp"', '"motor"', 13, "base.inertia", None, "0.05", "missing"),
    Case("weightless hub", '"clamp"', '"motor"\ninertia = 0', 15, "base.inertia", 0.0, "0.05"),
]

SIGNALS = [
    Case("place unknown", 'at = "tip"\nacts', 'at = "top"\nacts', 31, "input[1].at", "top", '`at = "tip"`'),
    Case("place as text", 'at = "tip"\nacts', 'at = "1"\nacts', 31, "input[1].at", "1", "without quotes"),
    Case("place true", 'at = "tip"\nacts', "at = true\nacts", 31, "input[1].at", True, '`at = "tip"`'),
    Case("place beyond the tip", 'at = "tip"\nof', "at = 3\nof", 36, "output[1].at", 3, '"tip"', "1 to 2"),
    Case(
        "place before the base", 'at = "tip"\nacts', "at = 0\nacts", 31, "input[1].at", 0, '"base"', "1 to 2"
    ),
    Case("torque on a clamp", 'at = "tip"\nacts', 'at = "base"\nacts', 31, "input[1].at", "base", '"motor"'),
    Case("force in a chain", '"torque"', '"force_x"', 32, "input[1].acts", "force_x", '`acts = "torque"`'),
    Case("angle at the tip", '"torque"', '"angle"', 31, "input[1].at", "tip", '`at = "base"`'),
    Case("no prescribed angle", '"clamp"', '"prescribed"', 14, "base.kind", "prescribed", '`acts = "angle"`'),
    Case("unknown quantity", '"angle"', '"angel"', 37, "output[1].of", "angel", "'angle'?"),
    Case("position in a chain", '"angle"', '"position"', 37, "output[1].of", "position", "velocity"),
    Case("motion of a clamp", '"tip"\nof', '"base"\nof', 37, "output[1].of", "angle", '`of = "torque"`'),
    Case("torque beyond the tip", '"angle"', '"torque"', 36, "output[1].at", "tip", "`at = 2`"),
]

SOLVING = [
    Case(
        "integrator misspelt",
        '"newmark"',
        '"newmrk"',
        9,
        "integrator.name",
        "newmrk",
        "'newmark'? Known are fox_",
    ),
    Case("integrator unknown", '"newmark"', '"ode45"', 9, "integrator.name", "ode45", "Known are fox_euler"),
    Case("parameter misspelt", "beta = 0.25", "bta = 0.25", 11, "integrator.bta", 0.25, "'beta'?"),
    Case(
        "parameter of another",
        "beta",
        "rho_inf",
        11,
        "integrator.rho_inf",
        0.25,
        "belongs to generalized_alpha",
    ),
    Case(
        "parameter out of range",
        "beta = 0.25",
        "beta = -1",
        11,
        "integrator.beta",
        -1,
        "0.25",
        "between 0 and 1",
    ),
    Case("parameter no number", "beta = 0.25", "beta = '1/4'", 11, "integrator.beta", "1/4", "`beta = 0.25`"),
    Case("parameter of none", '"newmark"', '"houbolt"', 11, "integrator.beta", 0.25, "remove the key"),
    Case(
        "explicit method",
        'sweep = "riccati"\n\n[integrator]\nname = "newmark"\nstep = 0.01\nbeta = 0.25',
        'unknown = "increment"\n\n[integrator]\nname = "newmark"\nstep = 0.01\nbeta = 0.0',
        6,
        "model.unknown",
        "increment",
        '`unknown = "acceleration"`',
        "beta = 0",
    ),
]

EMISSION = [
    Case("no backend", "[base]", "[emit]\nbackends = []\n[base]", 14, "emit.backends", [], "numpy"),
    Case(
        "backend twice",
        "[base]",
        "[emit]\nbackends = ['c', 'c']\n[base]",
        14,
        "emit.backends",
        ["c", "c"],
        "repet",
    ),
    Case(
        "backend unknown",
        "[base]",
        "[emit]\nbackends = ['nupy']\n[base]",
        14,
        "emit.backends[1]",
        "nupy",
        "'numpy'?",
    ),
    Case(
        "backend alone", "[base]", "[emit]\nbackends = 'c'\n[base]", 14, "emit.backends", "c", "`backends = ["
    ),
    Case(
        "number type", "[base]", "[emit]\nreal = 'float23'\n[base]", 14, "emit.real", "float23", "'float32'?"
    ),
    Case(
        "number type of no C",
        "[base]",
        "[emit]\nreal = 'float32'\nbackends = ['numpy']\n[base]",
        14,
        "emit.real",
        "float32",
        'Add "c"',
    ),
    Case(
        "whose sine",
        "[base]",
        "[emit]\ntrigonometry = 'mine'\n[base]",
        14,
        "emit.trigonometry",
        "mine",
        "libm, own",
    ),
    Case(
        "own sine of no C",
        "[base]",
        "[emit]\ntrigonometry = 'own'\nbackends = ['numpy']\n[base]",
        14,
        "emit.trigonometry",
        "own",
        'Add "c"',
    ),
    Case(
        "bound with derivatives",
        "[base]",
        "[emit]\nparameters = 'bound'\nsensitivities = true\n[base]",
        14,
        "emit.parameters",
        "bound",
        "remove sensitivities",
    ),
    Case(
        "box of a bound step",
        "[base]",
        "[emit]\nparameters = 'bound'\n[emit.box]\nstep = [1e-3, 1e-2]\n[base]",
        16,
        "emit.box.step",
        (1e-3, 1e-2),
        'parameters = "free"',
    ),
    Case("empty budget", "[base]", "[emit.budget]\n[base]", 13, "emit.budget", None, "flash"),
    Case(
        "budget of nothing",
        "[base]",
        "[emit.budget]\nflash = 0\n[base]",
        14,
        "emit.budget.flash",
        0,
        "`flash =",
    ),
    Case(
        "box of nothing",
        "[base]",
        "[emit.box]\ntorque = [0, 1]\n[base]",
        14,
        "emit.box.torque",
        (0.0, 1.0),
        "tip_",
    ),
    Case(
        "box inside out",
        "[base]",
        "[emit.box]\nrates = [1, 0]\n[base]",
        14,
        "emit.box.rates",
        [1, 0],
        "lower",
    ),
    Case(
        "box of one end",
        "[base]",
        "[emit.box]\nrates = [1]\n[base]",
        14,
        "emit.box.rates",
        [1],
        "`[-10.0, 10.0]`",
    ),
    Case(
        "box of steps", "[base]", "[emit.box]\nstep = [0, 1]\n[base]", 14, "emit.box.step", (0.0, 1.0), "1e-4"
    ),
]

SYNTAX = [
    Case("text without quotes", '"arm"', "arm", 1, "name", "arm", "double quotes"),
    Case("no value", "step = 0.01", "step =", 10, "step", None, "after the equals sign"),
    Case("comma for a point", "= 20.0", "= 20,0", 17, "stiffness", "20,0", "decimal point"),
    Case("point without digits", "= 20.0", "= 20.", 17, "stiffness", "20.", "after the decimal point"),
    Case("point before digits", "= 0.5", "= .5", 18, "damping", ".5", "before and after"),
    Case("unit", "= 20.0", "= 20.0 N m", 17, "stiffness", "20.0 N m", "SI"),
    Case("Python's true", '"An arm"', "True", 2, "title", "True", "small letters"),
    Case("open quotes", '"An arm"', '"An arm', 2, "title", '"An arm', "Close the quotes"),
    Case("open bracket", "= 20.0", "= [20.0", 17, "stiffness", "[20.0", "Close the bracket"),
    Case("open list", "= 20.0", "= [\n20.0,", 17, "stiffness", "[", "Close the bracket"),
    Case("no comma", "= 20.0", "= [20.0 30.0]", 17, "stiffness", "[20.0 30.0]", "separate items by commas"),
    Case("open brace", "= 20.0", "= {a = 1", 17, "stiffness", "{a = 1", "Close the brace"),
    Case("open header", "[base]", "[base", 13, "", "[base", "[[table]]"),
    Case("key twice", "step = 0.01", "step = 0.01\nstep = 1", 11, "step", "1", "once"),
    Case("table twice", "[base]", "[model]\n[base]", 13, "model", "[model]", "once"),
    Case("no equals sign", "step = 0.01", "step 0.01", 10, "", "step 0.01", "`key = value`"),
    Case("endless number", "= 20.0", f"= {'1' * 5000}", 17, "stiffness", "1" * 5000, "shorter"),
    Case("bad escape", '"An arm"', r'"An \arm"', 2, "title", r'"An \arm"', "backslash"),
]


def problems(path: Path, text: str) -> tuple[Problem, ...]:
    path.write_text(text, encoding="utf-8")
    with pytest.raises(SceneError) as caught:
        load_scene(path)
    return caught.value.problems


def complaint(path: Path, text: str, case: Case) -> Problem:
    assert text.count(case.old) >= 1
    found = problems(path, text.replace(case.old, case.new, 1))
    return next((problem for problem in found if problem.key == case.key), found[0])


@pytest.mark.parametrize(
    "case", TABLES + NAMES + STATIONS + SIGNALS + SOLVING + EMISSION + SYNTAX, ids=lambda case: case.name
)
def test_chain(tmp_path: Path, chain: str, case: Case) -> None:
    path = tmp_path / "arm.toml"
    problem = complaint(path, chain, case)
    assert (problem.file, problem.line, problem.key) == (str(path), case.line, case.key)
    if case.value is not None:
        assert problem.value == case.value
    assert case.remedy in problem.remedy
    assert case.message in problem.message
    assert str(problem).startswith(f"{path}:{case.line}: {case.key}{': ' if case.key else ''}")
    assert str(problem).endswith(f". {problem.remedy}")
    assert "\n" not in str(problem)


PLANAR = [
    Case(
        "beam and links",
        "[tip]",
        "[[link]]\ninertia = 1\nmass = 1\nlength = 1\n[tip]",
        22,
        "link[1]",
        None,
        "[beam]",
    ),
    Case(
        "spring rule",
        "links = 5",
        "links = 5\nsprings = 'half_clamp'",
        20,
        "beam.springs",
        None,
        "half-clamp",
    ),
    Case(
        "a spring rule for beams on motors",
        "links = 5",
        "links = 5\nsprings = 'finite-segment'",
        20,
        "beam.springs",
        "finite-segment",
        "clamped-segment",
        "clamped to the base or its hub",
    ),
    Case("no links", "links = 5", "links = 0", 19, "beam.links", 0, "`links = 10`", "at least 1"),
    Case("a million links", "links = 5", "links = 1000000", 19, "beam.links", 10**6, "10", "at most 100000"),
    Case("weightless beam", "= 0.4", "= 0.0", 18, "beam.mass_per_length", 0.0, "kg/m", "greater than 0"),
    Case("beam beyond floats", "= 12.0", "= 1e308", 17, "beam.bending_stiffness", 1e308, "units", "inf"),
    Case(
        "beam below floats",
        "= 1.0",
        "= 1e-160",
        18,
        "beam.mass_per_length",
        0.4,
        "units",
        "link inertia of 0",
    ),
    Case(
        "beam in a chain", 'kind = "planar"\ngravity = 9.81', 'kind = "chain"', 14, "beam", None, "[[joint]]"
    ),
    Case(
        "no stations",
        PLANAR_BEAM := "[beam]\nlength = 1.0\nbending_stiffness = 12.0\nmass_per_length = 0.4\n"
        "links = 5\ndamping_time = 0.002\n",
        "",
        1,
        "link",
        None,
        "a [beam]",
    ),
    Case("gravity upwards", "9.81", "-9.81", 5, "model.gravity", -9.81, "-y", "at least 0"),
    Case(
        "frozen iterations",
        "= 9.81",
        '= 0\nlinearisation = "frozen"\niterations = 2',
        7,
        "model.iterations",
        2,
        "newton",
    ),
    Case("force at the base", '"torque"', '"force_y"', 27, "input[1].at", "base", "link or the tip"),
    Case("prescribed motor", '"torque"', '"angle"', 28, "input[1].acts", "angle", '"prescribed"'),
    Case("base point", 'at = "tip"', 'at = "base"', 33, "output[1].of", "position", '`of = "angle"`'),
    Case(
        "component name",
        "[[output]]",
        '[[output]]\nname = "tip_x"\nat = 1\nof = "angle"\n[[output]]',
        31,
        "output[1].name",
        "tip_x",
        "another",
        "component",
    ),
    Case(
        "energy of a place",
        'of = "position"',
        'of = "kinetic_energy"',
        32,
        "output[1].at",
        "tip",
        '`at = "arm"`',
    ),
    Case(
        "position of the arm",
        'at = "tip"\nof',
        'at = "arm"\nof',
        32,
        "output[1].at",
        "arm",
        "dissipated_energy",
        "belongs to a place",
    ),
    Case(
        "load on the arm",
        'at = "base"\nacts',
        'at = "arm"\nacts',
        27,
        "input[1].at",
        "arm",
        "link number",
        "one place",
    ),
    Case("tip below zero", "mass = 0.1", "mass = -0.1", 23, "tip.mass", -0.1, "kg", "at least 0"),
]


@pytest.mark.parametrize("case", PLANAR, ids=lambda case: case.name)
def test_planar(tmp_path: Path, planar: str, case: Case) -> None:
    path = tmp_path / "arm.toml"
    problem = complaint(path, planar, case)
    assert (problem.file, problem.line, problem.key) == (str(path), case.line, case.key)
    if case.value is not None:
        assert problem.value == case.value
    assert case.remedy in problem.remedy
    assert case.message in problem.message


def test_every_fault_is_told_in_the_order_of_the_file(tmp_path: Path, chain: str) -> None:
    text = chain.replace("20.0", "-1").replace('"riccati"', '"rocket"').replace('"tip"\nof', '"top"\nof')
    assert [problem.line for problem in problems(tmp_path / "arm.toml", text)] == [6, 17, 36]


def test_a_second_prescribed_angle(tmp_path: Path, chain: str) -> None:
    angle = '[[input]]\nname = "{}"\nat = "base"\nacts = "angle"\n'
    text = chain.replace('"clamp"', '"prescribed"') + angle.format("a") + angle.format("b")
    (problem,) = problems(tmp_path / "arm.toml", text)
    assert (problem.line, problem.key) == (45, "input[3].acts")
    assert "'a'" in problem.message


def test_a_scene_without_outputs(tmp_path: Path, chain: str) -> None:
    (problem,) = problems(tmp_path / "arm.toml", chain[: chain.index("[[output]]")])
    assert (problem.key, problem.line) == ("output", 1)
    assert "[[output]]" in problem.remedy


def test_no_file_is_written(tmp_path: Path, chain: str) -> None:
    problems(tmp_path / "arm.toml", chain.replace("20.0", "-1"))
    assert [path.name for path in tmp_path.iterdir()] == ["arm.toml"]


@pytest.mark.parametrize(
    ("angle", "other", "said"),
    [
        ("a", "a_rate", "is already the name of the rate of [[input]] number 2"),
        ("a", "a_acceleration", "is already the name of the acceleration of [[input]] number 2"),
        (
            "long" * 10,
            "b",
            "comes with '" + "long" * 10 + "_acceleration', which must have at most 48 characters",
        ),
    ],
)
def test_names_of_a_prescribed_base(angle: str, other: str, said: str, chain: str) -> None:
    """An angle comes with its rate and acceleration, whose names must be free."""
    text = chain.replace('"clamp"', '"prescribed"')
    text += f'[[input]]\nname = "{angle}"\nat = "base"\nacts = "angle"\n'
    text += f'[[output]]\nname = "{other}"\nat = "tip"\nof = "angle"\n'
    with pytest.raises(SceneError) as caught:
        parse_scene(text)
    assert said in str(caught.value)


@pytest.mark.parametrize("name", ["angles", "rates", "accelerations", "step"])
def test_an_input_called_as_a_state_of_the_box_is_refused_with_a_box_only(name: str) -> None:
    text = (
        'name = "arm"\n[model]\nkind = "chain"\n[integrator]\nname = "newmark"\nstep = 0.01\n[base]\nkind = "clamp"\n'
        "[[joint]]\nstiffness = 1.0\n[[link]]\ninertia = 1.0\n"
        f'[[input]]\nname = "{name}"\nat = "tip"\nacts = "torque"\n[[output]]\nname = "tip"\nat = "tip"\nof = "angle"\n'
    )
    assert parse_scene(text).inputs[0].name == name
    with pytest.raises(SceneError) as refused:
        parse_scene(f"{text}[emit.box]\n{name} = [0.5, 1.0]\n")
    (problem,) = refused.value.problems
    assert (problem.key, problem.value) == ("input[1].name", name)
    assert f"'{name}_1'" in problem.remedy
