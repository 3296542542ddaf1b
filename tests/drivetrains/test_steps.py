"""Steps of drivetrains: of all backends, against exponentials of matrices, and against one shaft by referral."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.linalg import expm

from tmm_gen.derive.integrators.registry import names
from tmm_gen.inputs.signals import Constant, Sine
from tmm_gen.native import compile_kernel
from tmm_gen.native.python_module import casadi_module, numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.program.statements import Program
from tmm_gen.reference.chain_motion import exact_angles
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import METHODS, Scene, load_scene, parse_scene
from tmm_gen.simulate.prescribed import kernel_signals
from tmm_gen.verify.agreement import (
    casadi_step,
    largest_difference,
    native_step,
    numpy_step,
    reached_vectors,
)

Chain = Callable[..., Scene]
pytestmark = pytest.mark.compiler

AGREE = 1e-12
UNTIL = 0.2
BRANCHES = 0.4
"""Share of elements that give way on a link further inward than the last one."""
FEW = settings(max_examples=8, deadline=None, suppress_health_check=list(HealthCheck))


@FEW
@given(seed=st.integers(0, 10_000), count=st.integers(1, 5), name=st.sampled_from(names()))
def test_backends_agree(seed: int, count: int, name: str, chain: Chain, drawn: Callable[..., Any]) -> None:
    parts, base = drawn(seed, count, BRANCHES)
    scene = chain(parts, base=base, integrator=name)
    program = build_program(scene)
    module = numpy_module(scene, program)
    ours = numpy_step(module, program)
    vectors = list(reached_vectors(module, program, 4))
    native = native_step(compile_kernel(program, scene, flags=("-O1",)), program)
    assert largest_difference(ours, native, vectors) < AGREE
    assert largest_difference(ours, casadi_step(casadi_module(scene, program), program), vectors) < AGREE


def _end(scene: Scene, torques: dict[str, float], until: float = UNTIL) -> dict[str, float]:
    kernel = compile_kernel(build_program(scene), scene, flags=("-O1",))
    _, found = kernel.simulate(until, torques)
    return {name: float(values[-1]) for name, values in found.items()}


@FEW
@given(seed=st.integers(0, 10_000), count=st.integers(1, 5), order=st.sampled_from([2, 4]))
def test_steps_are_those_of_the_exponential(
    seed: int,
    count: int,
    order: int,
    chain: Chain,
    drawn: Callable[..., Any],
    equations: Callable[..., Any],
) -> None:
    """Within ten times the step's own error, which halving the step shows."""
    name, step = {2: ("newmark", 1e-3), 4: ("sdirk4", 2e-3)}[order]
    parts, base = drawn(seed, count, BRANCHES)
    right = equations(parts, base)
    scene = chain(parts, base=base, integrator=name, step=step)
    torques = {f"on_{n}": 0.5 - 0.3 * k for k, n in enumerate(right.names)}
    wanted = _exact(right, np.array(list(torques.values())))
    whole, half = _end(scene, torques), _end(scene.replace(**{"integrator.step": 0.5 * step}), torques)
    for kind in ("angle", "rate", "acceleration", "torque"):
        columns = [c for c in whole if c.startswith(f"{kind}_")]
        size = max(abs(wanted[c]) for c in columns)
        own = max(abs(half[c] - whole[c]) for c in columns)
        for c in columns:
            assert abs(half[c] - wanted[c]) < 10.0 * own / (2**order - 1) + 1e-11 * size, c


def _exact(right: Any, torques: np.ndarray) -> dict[str, float]:
    m = len(right.mass)
    system = np.zeros((2 * m + 1, 2 * m + 1))
    system[:m, m : 2 * m] = np.eye(m)
    inverse = np.linalg.inv(right.mass)
    system[m : 2 * m, :m], system[m : 2 * m, m : 2 * m] = -inverse @ right.stiffness, -inverse @ right.damping
    system[m : 2 * m, -1] = inverse @ right.load @ torques
    state = expm(UNTIL * system)[:, -1]
    q, v, a = state[:m], state[m : 2 * m], (system @ state)[m : 2 * m]
    found = {f"torque_{n}": -(k * twist @ q + c * twist @ v) for n, (twist, k, c) in right.torque.items()}
    for i, n in enumerate(right.names):
        found |= {
            f"{of}_{n}": right.reading[i] @ x for of, x in (("angle", q), ("rate", v), ("acceleration", a))
        }
    return found


TRAIN: list[tuple[str, dict[str, Any]]] = [
    ("motor", {"name": "motor", "rotor_inertia": 0.02, "gear": 2.0, "damping": 0.03}),
    ("joint", {"name": "coupling", "stiffness": 30.0, "damping": 0.1}),
    ("gear", {"name": "first", "ratio": -4.0}),
    ("link", {"name": "layshaft", "inertia": 0.3}),
    ("gear", {"name": "second", "ratio": 2.5}),
    ("link", {"name": "wheel", "inertia": 0.5}),
    ("gear", {"name": "third", "ratio": 1.6, "stiffness": 900.0, "damping": 1.0}),
    ("link", {"name": "output", "inertia": 0.4}),
    ("joint", {"name": "shaft", "stiffness": 400.0, "damping": 0.5}),
    ("link", {"name": "load", "inertia": 3.0}),
]

REFERRED = """
name = "referred"
[model]
kind = "chain"
unknown = "{unknown}"
[integrator]
name = "{integrator}"
step = 1e-3
[base]
kind = "motor"
inertia = {hub}
damping = 0.03
{stations}
[[input]]
name = "on_motor"
at = "base"
acts = "torque"
[[input]]
name = "on_load"
at = "tip"
acts = "torque"
[[output]]
name = "motor"
at = "base"
of = "angle"
[[output]]
name = "load"
at = "tip"
of = "angle"
[[output]]
name = "teeth"
at = 2
of = "torque"
"""


def _referred(integrator: str, unknown: str) -> Scene:
    """Return the same train on one shaft, that of the motor's output, as one would refer it by hand."""
    lay, wheel, out = 4.0**2, (4.0 * 2.5) ** 2, (4.0 * 2.5 * 1.6) ** 2
    stations = [
        (30.0, 0.1, 0.3 / lay + 0.5 / wheel),
        (900.0 / out, 1.0 / out, 0.4 / out),
        (400.0 / out, 0.5 / out, 3.0 / out),
    ]
    text = "".join(
        f"[[joint]]\nstiffness = {k!r}\ndamping = {c!r}\n[[link]]\ninertia = {i!r}\n" for k, c, i in stations
    )
    return parse_scene(
        REFERRED.format(hub=2.0**2 * 0.02, stations=text, integrator=integrator, unknown=unknown)
    )


ON_ONE_SHAFT = {"on_motor": 2.0 * 0.7, "on_load": -2.0 / -16.0}


ONLY_ACCELERATIONS = {"zhai", "zhou", *(method.name for method in METHODS if method.coupled)}
"""What these can be solved for."""


@pytest.mark.parametrize("name", names())
def test_all_on_one_shaft_moves_alike(name: str, chain: Chain) -> None:
    """Angles differ by the ratio, -4 * 2.5 * 1.6 = -16 in all, torques by its inverse."""
    right = _end(_referred(name, "acceleration"), ON_ONE_SHAFT)
    for unknown in ("acceleration",) if name in ONLY_ACCELERATIONS else ("acceleration", "increment"):
        found = _end(chain(TRAIN, integrator=name, unknown=unknown), {"on_motor": 0.7, "on_load": -2.0})
        # what rounding takes from sweeps for increments, the chain on one shaft loses too
        alike = _end(_referred(name, unknown), ON_ONE_SHAFT)
        lost = max(abs(alike[c] / right[c] - 1.0) for c in right)
        same = 1e-12 + lost
        assert lost < 1e-10
        assert found["angle_motor"] == pytest.approx(right["motor"], rel=same)
        assert found["angle_load"] == pytest.approx(right["load"] / -16.0, rel=same)
        assert found["torque_third"] == pytest.approx(-right["teeth"] * -16.0, rel=10.0 * same)
        assert found["angle_wheel"] * 2.5 == pytest.approx(found["angle_layshaft"], rel=1e-15)


def _meshed(stiffness: float | None, chain: Chain, **more: Any) -> Scene:
    parts = [(t, dict(k)) for t, k in TRAIN]
    for name in ("second", "third"):
        keys = next(k for _, k in parts if k["name"] == name)
        keys.pop("stiffness", None), keys.pop("damping", None)
        if stiffness is not None:
            keys["stiffness"] = stiffness
    return chain(parts, **more)


def test_stiff_teeth_are_a_rigid_gear(chain: Chain) -> None:
    torques = {"on_motor": 0.7, "on_load": -2.0}
    more = {"integrator": "newmark", "unknown": "increment"}
    rigid = _end(_meshed(None, chain, **more), torques)
    stiff = _end(_meshed(1e12, chain, **more), torques)
    for column in rigid:
        if column.startswith("angle"):
            assert stiff[column] == pytest.approx(rigid[column], rel=1e-9), column
    soft = _end(_meshed(1e2, chain, **more), torques)
    assert abs(soft["angle_load"] / rigid["angle_load"] - 1.0) > 1e-3


def test_a_prescribed_base_turns_a_train_through_its_gear(chain: Chain) -> None:
    """Held still after a turn of 1, the load rests where the gears put it, each link in its own angle."""
    parts: list[tuple[str, dict[str, Any]]] = [
        ("gear", {"name": "first", "ratio": 5.0}),
        ("joint", {"name": "shaft", "stiffness": 300.0, "damping": 4.0}),
        ("link", {"name": "disc", "inertia": 0.2}),
        ("gear", {"name": "second", "ratio": -2.0, "stiffness": 80.0, "damping": 2.0}),
        ("link", {"name": "load", "inertia": 0.1}),
    ]
    signals = [("[input]", {"name": "turn", "at": "base", "acts": "angle"})]
    signals += [
        ("[output]", {"name": f"angle_{n}", "at": n, "of": "angle"}) for n in ("disc", "load", "base")
    ]
    scene = chain(parts, base={"kind": "prescribed"}, integrator="sdirk4", signals=signals)
    found = exact_response(scene, {"turn": Constant(1.0)}, np.array([20.0]))
    assert found["angle_disc"][0] == pytest.approx(0.2, rel=1e-6)
    assert found["angle_load"][0] == pytest.approx(-0.1, rel=1e-6)
    kernel = compile_kernel(build_program(scene), scene, flags=("-O1",))
    swing = {"turn": Sine(0.4, 3.0)}
    moving = {name: signal.at for name, signal in kernel_signals(scene, swing).items()}
    _, ours = kernel.simulate(0.2, moving)
    right = exact_response(scene, swing, np.array([0.2]))
    for name in ("angle_disc", "angle_load", "angle_base"):
        assert ours[name][-1] == pytest.approx(right[name][0], rel=1e-6), name


def test_runs_are_judged_by_angles_of_their_own_shafts(chain: Chain) -> None:
    """The motion that runs are held against agrees with the assembled matrices, whole and in modes."""
    scene = chain(TRAIN)
    signals = {"on_motor": Sine(0.7, 11.0), "on_layshaft": Constant(0.0), "on_wheel": Constant(0.1)}
    signals |= {"on_output": Constant(0.0), "on_load": Constant(-2.0)}
    exact = exact_angles(scene, signals, 1e-3, np.array([0, 100, 200]))
    right = exact_response(scene, signals, np.array([0.0, 0.1, 0.2]))
    for column, name in enumerate(("motor", "layshaft", "output", "load")):
        assert exact[:, column] == pytest.approx(right[f"angle_{name}"], rel=1e-9, abs=1e-12)
    assert not np.allclose(exact[1:, 0], exact[1:, 1])


def test_initial_angles_are_those_of_the_parts(chain: Chain) -> None:
    start = {"angles": [0.4, 0.16, -0.1, 0.2], "rates": [1.0, 0.4, 0.0, 3.0]}
    signals = [
        ("[output]", {"name": n, "at": n, "of": "angle"}) for n in ("layshaft", "wheel", "output", "load")
    ]
    scene = chain(TRAIN, signals=[*signals, ("initial", start)])
    kernel = compile_kernel(build_program(scene), scene, flags=("-O1",))
    kernel.prepare()
    kernel.initialise({})
    assert [kernel.output()[n] for n in ("layshaft", "wheel", "output", "load")] == pytest.approx(
        [0.4, 0.16, -0.1, 0.2], rel=1e-15
    )


@pytest.mark.parametrize("name", names())
def test_a_geared_joint_costs_four_multiplications_a_stage(name: str, chain: Chain) -> None:
    """Two for what its spring sees of the inner side, two for its damper; a ratio of 1 costs nothing.

    Explicit ones hand the torque in without a sweep's factors, for one more.
    """

    def train(ratio: float) -> Program:
        parts = [
            ("joint", {"name": "a", "stiffness": 30.0, "damping": 0.1}),
            ("link", {"name": "b", "inertia": 0.4}),
            ("gear", {"name": "c", "ratio": ratio, "stiffness": 90.0, "damping": 0.2}),
            ("link", {"name": "d", "inertia": 0.3}),
        ]
        return build_program(chain(parts, integrator=name))

    plain, geared = train(1.0), train(-2.0)
    assert "ratio" not in [p.name for p in plain.parameters]
    assert "ratio" in [p.name for p in geared.parameters]
    more = count_routine(geared.main).total - count_routine(plain.main).total
    assert 0 < more <= (4 + (name == "zhai")) * len(geared.stage_instants[-1])


@pytest.mark.compiler
def test_compensated_single_precision_turns_as_double_does(repository: Path) -> None:
    """Behind a gear a turn of the hub is another angle: taking it out of all angles alike would change the motion."""
    scene = load_scene(repository / "scenes" / "geartrain.toml")
    single = scene.replace(**{"emit.real": "float32", "emit.compensated": True, "emit.trigonometry": "own"})
    torques = {"motor_torque": 2.0, "load_torque": -1.0, "feeder_torque": 0.5}
    (_, right), (_, found) = (
        compile_kernel(build_program(s), s, flags=("-O1",)).simulate(0.2, torques, step=scene.integrator.step)
        for s in (scene, single)
    )
    for name, values in right.items():
        assert np.abs(found[name] - values).max() < 1e-6 * np.abs(values).max(), name
