"""Numbers of parts are found from records that equations written apart have made; what a record cannot tell is refused.

The equations here know nothing of scenes: bodies by their numbers, Lagrange's equations of a planar tree from Jacobians
of its masses, and a drivetrain with every gear put in by hand, both integrated by SciPy.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from tmm_gen.calibration.calibrate import Calibration, calibrate
from tmm_gen.calibration.fit import parameters_of
from tmm_gen.calibration.fitted_keys import default_keys
from tmm_gen.cli import main
from tmm_gen.errors import CheckFailed, UserError
from tmm_gen.inputs.signals import Table
from tmm_gen.program.build import build_program
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import Scene, load_scene, parse_scene

pytestmark = pytest.mark.compiler

Array = NDArray[np.float64]
G = 9.81
NOISE = 1e-3
"""Of a sensor, as a share of each column's standard deviation."""


@dataclass(frozen=True)
class Piece:
    """A rigid piece of a planar arm, and the joint at its inner end; ``gear`` times ``torque`` acts in it."""

    host: int
    length: float
    mass: float
    inertia: float
    stiffness: float = 0.0
    damping: float = 0.0
    rest: float = 0.0
    armature: float = 0.0
    gear: float = 0.0
    torque: Callable[[float], float] = field(default=lambda _: 0.0)
    carried: tuple[tuple[float, float], ...] = ()


def strip(
    first: int, host: int, length: float, bending: float, per_length: float, count: int, time: float
) -> list[Piece]:
    """Cut a beam: whole pieces behind a clamp (host -1), else half a piece at either end."""
    piece = length / count
    clamped = host == -1
    lengths = [piece] * count if clamped else [piece / 2, *[piece] * (count - 1), piece / 2]
    spring = bending / piece
    springs = [2 * spring if clamped else 0.0, *[spring] * (len(lengths) - 1)]
    return [
        Piece(host if k == 0 else first + k - 1, far, per_length * far, per_length * far**3 / 12, s, s * time)
        for k, (far, s) in enumerate(zip(lengths, springs, strict=True))
    ]


def moved(pieces: list[Piece], start: Array, times: Array) -> tuple[Array, Array]:
    """Return angles of all pieces and places of their outer ends (complex), by instants."""
    n = len(pieces)
    inner = np.zeros((n, n))  # lever arms of each piece's inner end
    bent = np.eye(n)
    for k, piece in enumerate(pieces):
        if piece.host >= 0:
            inner[k] = inner[piece.host]
            inner[k, piece.host] += pieces[piece.host].length
            bent[k, piece.host] = -1.0
    ends = inner + np.diag([p.length for p in pieces])
    levers = np.array([*(0.5 * (inner + ends)), *(ends[k] for k, p in enumerate(pieces) for _ in p.carried)])
    masses = np.array([*(p.mass for p in pieces), *(m for p in pieces for m, _ in p.carried)])
    own = np.diag([p.inertia + sum(j for _, j in p.carried) for p in pieces])
    stiffness, damping, rest, armature = (
        np.array([getattr(p, key) for p in pieces]) for key in ("stiffness", "damping", "rest", "armature")
    )
    own = own + bent.T @ np.diag(armature) @ bent

    def rates(time: float, x: Array) -> Array:
        q, v = x[:n], x[n:]
        to_x, to_y = -levers * np.sin(q), levers * np.cos(q)
        mass = to_x.T * masses @ to_x + to_y.T * masses @ to_y + own
        torques = -stiffness * (bent @ q - rest) - damping * (bent @ v)
        torques += [p.gear * p.torque(time) for p in pieces]
        force = bent.T @ torques + to_x.T @ (masses * (to_y @ v**2)) - to_y.T @ (masses * (to_x @ v**2 + G))
        return np.concatenate([v, np.linalg.solve(mass, force)])

    found = solve_ivp(
        rates, (0.0, times[-1]), [*start, *np.zeros(n)], t_eval=times, method="LSODA", rtol=1e-9, atol=1e-11
    )
    q = found.y[:n].T
    return q, np.exp(1j * q) @ ends.T


Made = tuple[Scene, dict[str, Table], dict[str, float]]
"""An arm, a record of another one like it, and the numbers of that one."""


def signal(until: float, size: float, seed: int) -> tuple[Table, Callable[[float], float]]:
    """Return a torque that goes from one random value to another, in eight straight lines."""
    times = np.linspace(0.0, until, 9)
    values = size * np.random.default_rng(seed).uniform(-0.2, 2.2, 9)
    return Table(times, values), lambda t: float(np.interp(t, times, values))


@pytest.fixture(scope="module")
def elbow() -> Made:
    """One strip softer, one stiffer, all dampers others; two pieces each, for the time it takes."""
    scene = load_scene(scenes_dir() / "elbow.toml").replace(
        **{"beam.upper.links": 2, "beam.forearm.links": 2, "integrator.name": "sdirk4"}
    )
    shoulder, at_shoulder = signal(0.8, 0.085, 1)
    elbow, at_elbow = signal(0.8, 0.03, 2)
    first, *upper, last = strip(0, -2, 0.5, 9.0, 0.324, 2, 1.5e-3)
    root, *fore, end = strip(3, 2, 0.4, 4.2, 0.162, 2, 3e-3)
    pieces = [
        replace(first, damping=0.7, armature=100**2 * 2e-5, gear=100, torque=at_shoulder),
        *upper,
        replace(last, carried=((0.25, 1e-4),)),
        replace(root, damping=0.06, armature=50**2 * 1e-5, gear=50, torque=at_elbow),
        *fore,
        replace(end, carried=((0.3, 2e-4),)),
    ]
    times = np.linspace(0.0, 0.8, 401)
    q, places = moved(pieces, np.zeros(6), times)
    columns = {"payload_x": places[:, 5].real, "payload_y": places[:, 5].imag}
    columns |= {"shoulder": q[:, 0], "elbow": q[:, 3] - q[:, 2]}
    record = {name: Table(times, values) for name, values in columns.items()}
    truth = {
        "beam.upper.bending_stiffness": 9.0,
        "beam.forearm.bending_stiffness": 4.2,
        "motor.shoulder.damping": 0.7,
        "beam.upper.damping_time": 1.5e-3,
        "motor.elbow.damping": 0.06,
        "beam.forearm.damping_time": 3e-3,
    }
    return scene, {**record, "shoulder_torque": shoulder, "elbow_torque": elbow}, truth


@pytest.fixture(scope="module")
def gripper() -> Made:
    """A branched arm: a beam that carries two fingers with a pad each."""
    scene = load_scene(scenes_dir() / "gripper.toml").replace(
        **{"beam.wrist.links": 2, "integrator.name": "sdirk4"}
    )
    left, at_left = signal(0.4, -0.003, 3)
    right, at_right = signal(0.4, 0.003, 4)
    pieces = strip(0, -1, 0.12, 1.1, 0.295, 2, 3e-3)
    pieces[-1] = replace(pieces[-1], carried=((0.15, 6e-5),))
    for side, torque, damping, stiffness, pad in (
        (1, at_left, 0.09, 0.55, 2e-3),
        (-1, at_right, 0.045, 0.3, 7e-4),
    ):
        root = len(pieces)
        finger = Piece(1, 0.08, 0.03, 1.6e-5, 0.0, damping, 0.0, 30**2 * 1e-7, 30, torque)
        pieces += [finger, Piece(root, 0.04, 0.01, 1.5e-6, stiffness, pad, -0.6 * side)]
    times = np.linspace(0.0, 0.4, 401)
    q, places = moved(pieces, np.array([0.0, 0.0, 0.9, 0.3, -0.9, -0.3]), times)
    columns = {
        f"{name}_tip_{axis}": getattr(places[:, k], part)
        for name, k in (("left", 3), ("right", 5))
        for axis, part in (("x", "real"), ("y", "imag"))
    }
    columns |= {"left": q[:, 2] - q[:, 1], "right": q[:, 4] - q[:, 1]}
    record = {name: Table(times, values) for name, values in columns.items()}
    truth = {
        "beam.wrist.bending_stiffness": 1.1,
        "joint.left_hinge.stiffness": 0.55,
        "joint.right_hinge.stiffness": 0.3,
        "beam.wrist.damping_time": 3e-3,
        "motor.left.damping": 0.09,
        "joint.left_hinge.damping": 2e-3,
        "motor.right.damping": 0.045,
        "joint.right_hinge.damping": 7e-4,
    }
    return scene, {**record, "left_torque": left, "right_torque": right}, truth


@pytest.fixture(scope="module")
def geartrain() -> Made:
    """Angles of servo, pinion, wheel, table and feeder, each of its own shaft; the layshaft is -1/4 of the pinion."""
    scene = load_scene(scenes_dir() / "geartrain.toml").replace(**{"integrator.name": "sdirk4"})
    truth = {
        "joint.coupling.stiffness": 110.0,
        "joint.belt.stiffness": 75.0,
        "gear.second.stiffness": 4e4,
        "joint.shaft.stiffness": 3.2e3,
        "motor.servo.damping": 2e-3,
        "joint.coupling.damping": 0.03,
        "joint.belt.damping": 0.02,
        "gear.second.damping": 6.0,
        "joint.shaft.damping": 0.5,
    }
    layshaft = np.array([0.0, -0.25, 0.0, 0.0, 0.0])
    servo, pinion, wheel, table, feeder = np.eye(5)
    mass = sum(
        j * np.outer(a, a)
        for j, a in zip(
            (6e-4, 1.2e-4, 2.4e-3, 1.1e-2, 0.65, 8e-4),
            (servo, pinion, layshaft, wheel, table, feeder),
            strict=True,
        )
    )
    twists = {
        "joint.coupling": pinion - servo,
        "joint.belt": feeder - layshaft,
        "gear.second": wheel + layshaft / 5.0,
        "joint.shaft": table - wheel,
        "motor.servo": servo,
    }
    springs, dampers = (
        sum(truth.get(f"{part}.{key}", 0.0) * np.outer(a, a) for part, a in twists.items())
        for key in ("stiffness", "damping")
    )
    torques = {
        name: signal(0.4, size, 5 + k)
        for k, (name, size) in enumerate(
            (("motor_torque", 2.0), ("load_torque", 10.0), ("feeder_torque", 0.2))
        )
    }
    acting = np.array([servo, table, feeder]).T

    def rates(time: float, x: Array) -> Array:
        load = acting @ [value(time) for _, value in torques.values()]
        return np.concatenate([x[5:], np.linalg.solve(mass, load - springs @ x[:5] - dampers @ x[5:])])

    times = np.linspace(0.0, 0.4, 801)
    x = solve_ivp(rates, (0.0, 0.4), np.zeros(10), t_eval=times, method="LSODA", rtol=1e-9, atol=1e-11).y.T
    q, v = x[:, :5], x[:, 5:]
    columns = {"motor_speed": v[:, 0], "table": q[:, 3], "table_speed": v[:, 3], "feeder_speed": v[:, 4]}
    for name, part in (("coupling_torque", "joint.coupling"), ("teeth", "gear.second")):
        law = truth[f"{part}.stiffness"], truth[f"{part}.damping"]
        columns[name] = -(law[0] * q @ twists[part] + law[1] * v @ twists[part])
    record = {name: Table(times, values) for name, values in columns.items()}
    return scene, {**record, **{name: table for name, (table, _) in torques.items()}}, truth


def noisy(made: Made, seed: int) -> dict[str, Table]:
    scene, record, _ = made
    random, acting = np.random.default_rng(seed), [item.name for item in scene.inputs]
    return {
        name: t
        if name in acting
        else Table(t.times, t.values + NOISE * np.std(t.values) * random.standard_normal(len(t.times)))
        for name, t in record.items()
    }


def errors(done: Calibration, truth: Mapping[str, float]) -> dict[str, float]:
    assert {found.key for found in done.found} == set(truth)
    return {found.key: found.value / truth[found.key] - 1.0 for found in done.found}


CLOSE = 1e-4
"""Of what is found without noise: what two integrators of high order differ by, and the ways between instants."""


@pytest.mark.parametrize("name", ["elbow", "gripper", "geartrain"])
def test_what_made_the_record_is_found(name: str, request: pytest.FixtureRequest) -> None:
    """Springs and dampers of all parts at once, as nothing else is said: without noise, then with it."""
    made: Made = request.getfixturevalue(name)
    scene, record, truth = made
    exact = calibrate(scene, record)
    assert max(map(abs, errors(exact, truth).values())) < CLOSE
    assert exact.misfit < 1e-5
    assert exact.misfit_before > 0.2
    done = calibrate(scene, noisy(made, 1))
    assert done.misfit == pytest.approx(NOISE, rel=0.1)
    for found in done.found:
        assert abs(found.value - truth[found.key]) < 4.0 * found.deviation
        assert found.deviation < 0.2 * found.value


def test_masses_gears_and_springs_that_were_slack_elsewhere(gripper: Made) -> None:
    """Any number of a part, by the keys of --set; what the others are is known."""
    scene, record, truth = gripper
    known = scene.replace(**truth)
    wrong = {
        "body.palm.mass": 0.1,
        "motor.left.gear": 24.0,
        "joint.right_hinge.rest": 0.9,
        "link.left_pad.center": 0.9,
    }
    right = {
        "body.palm.mass": 0.15,
        "motor.left.gear": 30.0,
        "joint.right_hinge.rest": 0.6,
        "link.left_pad.center": 0.5,
    }
    wrong |= {"motor.right.rotor_inertia": 2e-7, "beam.wrist.mass_per_length": 0.2}
    right |= {"motor.right.rotor_inertia": 1e-7, "beam.wrist.mass_per_length": 0.295}
    done = calibrate(known.replace(**wrong), record, list(right))
    assert max(map(abs, errors(done, right).values())) < 10.0 * CLOSE


def test_a_factor_of_all_springs(geartrain: Made) -> None:
    scene, record, truth = geartrain
    stiffer = scene.replace(**{k: 1.7 * v if "stiffness" in k else v for k, v in truth.items()})
    done = calibrate(stiffer, record, ["stiffness", "motor.servo.damping"])
    assert done.found[0].value == pytest.approx(1 / 1.7, rel=1e-4)
    assert done.scene.replace(**truth) == scene.replace(**truth)
    assert done.scene.joints[0].stiffness == pytest.approx(110.0, rel=1e-4)


def test_numbers_that_are_alike_by_chance_are_fitted_apart(gripper: Made) -> None:
    """Both fingers are, and their pads: numbers that kernels write once."""
    scene, record, truth = gripper
    done = calibrate(
        scene.replace(**truth, **{"link.left_finger.mass": 0.05}), record, ["link.left_finger.mass"]
    )
    assert done.found[0].value == pytest.approx(0.03, rel=1e-3)
    assert [round(link.mass, 4) for link in done.scene.links[2:]] == [0.03, 0.01, 0.03, 0.01]


@pytest.mark.parametrize("path", sorted(scenes_dir().glob("*.toml")), ids=lambda path: path.stem)
def test_every_parameter_of_a_kernel_follows_the_scene(path: Path) -> None:
    """What a fit hands to the kernel is what the kernel of that scene has by itself."""
    scene = load_scene(path)
    known = parameters_of(scene)
    for variable in build_program(scene).parameters:
        values = np.ravel(known[variable.name])
        assert np.array_equal(values if variable.length else values[:1], np.ravel(variable.default))


def written(path: Path, record: Mapping[str, Table], keep: NDArray[np.bool_] | None = None) -> None:
    """Write a record as a file with one clock, some cells empty."""
    times = max((t.times for t in record.values()), key=len)
    columns = [np.interp(times, t.times, t.values) for t in record.values()]
    rows = [",".join(["time", *record])]
    for row, time in enumerate(times):
        cells = (repr(float(c[row])) if keep is None or keep[row, k] else "" for k, c in enumerate(columns))
        rows.append(",".join([repr(float(time)), *cells]))
    path.write_text("\n".join(rows) + "\n")


@pytest.fixture
def files(geartrain: Made, tmp_path: Path) -> tuple[str, str]:
    """Scene and record as a user has them: Unix time, a third of the cells empty, one in a hundred far off."""
    text = (scenes_dir() / "geartrain.toml").read_text()
    scene, record = tmp_path / "geartrain.toml", tmp_path / "record.csv"
    scene.write_text(text)
    random = np.random.default_rng(4)
    moved = {}
    for name, table in noisy(geartrain, 2).items():
        acting = name.endswith("_torque") and name != "coupling_torque"
        values = table.values.copy()
        if not acting:
            wrong = random.random(len(values)) < 0.01
            values[wrong] += random.uniform(-20.0, 20.0, wrong.sum()) * np.std(values)
        moved[name] = Table(table.times + 1.7e9, values)
    keep = random.random((801, len(moved))) < 0.67
    keep[0] = True
    keep[:, [k for k, n in enumerate(moved) if n in ("motor_torque", "load_torque", "feeder_torque")]] = True
    written(record, moved, keep)
    return str(scene), str(record)


def test_as_a_user_does_it(
    geartrain: Made, files: tuple[str, str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Table, JSON and file; clock, gaps and wrong samples; every comment stays where it was."""
    truth, out = geartrain[2], tmp_path / "fitted.toml"
    keys = [key for key in truth if "second" not in key]
    fit = [word for key in keys for word in ("--fit", key)]
    assert main(["calibrate", *files, "--loss", "huber", "--json", "--out", str(out)]) == 0
    said = json.loads(capsys.readouterr().out)
    assert {row["key"] for row in said["rows"]} == set(truth)
    for row in said["rows"]:
        assert abs(row["value"] - truth[row["key"]]) < 4.0 * row["deviation"] + 0.01 * row["value"]
    assert said["outliers"] > 20
    before, after = (Path(path).read_text().splitlines() for path in (files[0], out))
    changed = [(a, b) for a, b in zip(before, after, strict=True) if a != b]
    assert len(changed) == len(truth)
    for a, b in changed:
        assert a.partition("=")[0] == b.partition("=")[0]
        assert a.partition("#")[2] == b.partition("#")[2]
    again = load_scene(out)
    assert again.joints[0].stiffness == pytest.approx(110.0, rel=0.01)
    assert main(["calibrate", *files, "--loss", "huber", *fit]) == 0
    assert "joint.coupling.stiffness" in capsys.readouterr().out


def test_a_material_within_braces_is_written_back(tmp_path: Path, elbow: Made) -> None:
    """As docs/arms.md writes it; fitted is Young's modulus, as the file says nothing of EI."""
    text = (scenes_dir() / "elbow.toml").read_text().replace("links = 5", "links = 2")
    text = text.replace('"newmark"', '"sdirk4"').replace(
        "bending_stiffness = 11.2       # N m^2\nmass_per_length = 0.324        # kg/m\n",
        "material = { young = 70e9, density = 2700 }  # aluminium\n"
        'section = { kind = "rectangle", width = 0.03, thickness = 0.004 }\n',
    )
    scene, record, out = tmp_path / "elbow.toml", tmp_path / "r.csv", tmp_path / "fitted.toml"
    scene.write_text(text)
    written(record, elbow[1])
    assert default_keys(load_scene(scene))[0] == "beam.upper.material.young"
    assert main(["calibrate", str(scene), str(record), "--out", str(out)]) == 0
    line = next(line for line in out.read_text().splitlines() if line.startswith("material"))
    found = re.fullmatch(r"material = \{ young = (\S+), density = 2700 \} +# aluminium", line)
    assert found is not None, line
    assert float(found[1]) * 0.03 * 0.004**3 / 12 == pytest.approx(9.0, rel=CLOSE)


REFUSED = [
    ("joint.coupling.stifness", "[[joint]]", "has no number"),
    ("joint.couplng.stiffness", "[[joint]]", "has no number"),
    ("joint.0.stiffness", "[[joint]]", "has no number"),
    ("motor.servo.gear", "[[motor]]", "has no number"),
    ("gear.first.ratio", "ratio = -4.0", "is -4.0, a count or a ratio"),
    ("motor.servo.name", 'name = "servo"', 'is "servo"; only a positive number'),
]


@pytest.mark.parametrize(("key", "stands", "problem"), REFUSED, ids=lambda each: str(each))
def test_keys_that_are_no_numbers(geartrain: Made, key: str, stands: str, problem: str) -> None:
    """File, line, key and value are named, and a key that can be fitted."""
    path = str(scenes_dir() / "geartrain.toml")
    with pytest.raises(UserError) as caught:
        calibrate(load_scene(path), geartrain[1], [key])
    said = str(caught.value)
    place = re.match(rf"{re.escape(path)}:(\d+): ", said)
    assert place is not None, said
    assert problem in said
    assert key in said
    assert Path(path).read_text().splitlines()[int(place[1]) - 1].startswith(stands)
    remedy = re.search(r"(?:one of |mean ')((?:motor|joint)\.[a-z_.]+)", said)
    assert remedy is not None, said
    calibrate(load_scene(path).replace(**geartrain[2]), geartrain[1], [remedy[1]])


def test_what_a_record_cannot_tell_is_named_with_what_it_can(elbow: Made) -> None:
    """Two dampers side by side: the keys that are offered instead can be fitted."""
    scene, record, truth = elbow
    side = scene.replace(**truth | {"motor.elbow.damping": 0.035, "motor.elbow.motor_damping": 1e-5})
    both = ["motor.elbow.damping", "motor.elbow.motor_damping", "beam.upper.bending_stiffness"]
    with pytest.raises(UserError, match="does not tell") as caught:
        calibrate(side, record, both)
    offered = re.findall(r"--fit (\S+?)[; ]", str(caught.value))
    assert len(offered) == 2
    assert set(offered) < set(both)
    assert len(calibrate(side, record, offered).found) == 2
    assert not {"motor.elbow.motor_damping"} & set(default_keys(side))


def test_the_same_number_twice(elbow: Made) -> None:
    scene, record, _ = elbow
    for keys in (["motor.elbow.damping", "motor.2.damping"], ["damping", "motor.elbow.damping"]):
        with pytest.raises(UserError, match=r":\d+: motor\[2\]\.damping would be fitted twice"):
            calibrate(scene, record, keys)


def test_an_arm_without_springs_and_dampers() -> None:
    """What is said to be fitted in their place can be."""
    text = """
name = "free"
model = { kind = "planar", gravity = 9.81 }
integrator = { name = "sdirk4", step = 2e-3 }
base.kind = "clamp"
joint = [{ name = "hinge" }]
link = [{ name = "rod", on = "hinge", length = 0.5, mass = 0.3, inertia = 7e-3 }]
output = [{ name = "rod", at = "rod", of = "angle" }]
"""
    scene = parse_scene(text)
    times = np.linspace(0.0, 1.0, 101)
    q, _ = moved([Piece(-1, 0.5, 0.3, 9e-3)], np.zeros(1), times)
    record = {"rod": Table(times, q[:, 0])}
    with pytest.raises(UserError, match=r"--fit and one of .*link\.rod\.inertia"):
        calibrate(scene, record)
    done = calibrate(scene, record, ["link.rod.inertia"])
    assert done.found[0].value == pytest.approx(9e-3, rel=1e-5)


def test_guards_hold(elbow: Made) -> None:
    """Another clock, signs turned round, a number that leaves its bounds."""
    scene, record, truth = elbow
    acting = {"shoulder_torque", "elbow_torque"}
    late = {n: t if n in acting else Table(t.times + 50.0, t.values) for n, t in record.items()}
    with pytest.raises(UserError, match="clocks differ"):
        calibrate(scene, late)
    half = {n: Table(t.times + 0.3, t.values) for n, t in record.items()}
    with pytest.raises(UserError, match=r"--start 0\.3 or --start 0"):
        calibrate(scene, half)
    again = calibrate(scene.replace(**truth), half, ["motor.elbow.damping"], start=0.3)
    assert again.found[0].value == pytest.approx(0.06, rel=1e-6)
    turned = {n: Table(t.times, -t.values) if n in acting else t for n, t in record.items()}
    with pytest.raises(CheckFailed, match="does not follow the record"):
        calibrate(scene, turned, ["motor.shoulder.damping"])
    centre = {"body.elbow_housing.mass": 0.25, "body.payload.mass": 0.3}
    light = scene.replace(**truth, **{key: 1e-6 * value for key, value in centre.items()})
    with pytest.raises(CheckFailed):
        calibrate(light, record, list(centre))
