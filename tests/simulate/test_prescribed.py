"""A prescribed base moves as it is told, in every integrator; what no base can do is refused, and the remedies work."""

from __future__ import annotations

import re
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from tmm_gen.derive.integrators.order import order
from tmm_gen.derive.integrators.registry import integrator, names
from tmm_gen.errors import UserError
from tmm_gen.inputs.given import read_inputs
from tmm_gen.inputs.signals import Constant, Signal, Sine, Table
from tmm_gen.inputs.waveforms import Smooth, Step
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.native.python_module import numpy_module
from tmm_gen.native.series import Series
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.simulate.metrics import convergence_slope
from tmm_gen.simulate.prescribed import kernel_signals
from tmm_gen.simulate.run import simulate

K, D, J = (30.0, 20.0), (0.3, 0.2), (0.012, 0.01)
M, L, C = (0.4, 0.3), (0.5, 0.4), (0.5, 0.45)
ARM = """
name = "told"
[model]
kind = "{kind}"
[integrator]
name = "newmark"
step = 0.001
[base]
kind = "prescribed"
[[joint]]
stiffness = 30.0
damping = 0.3
[[link]]
inertia = 0.012
{first}
[[joint]]
stiffness = 20.0
damping = 0.2
[[link]]
inertia = 0.01
{second}
[[input]]
name = "turn"
at = "base"
acts = "angle"
[[output]]
name = "hub"
at = "base"
of = "angle"
[[output]]
name = "hub_rate"
at = "base"
of = "{rate}"
[[output]]
name = "torque"
at = "base"
of = "torque"
[[output]]
name = "tip"
at = "tip"
of = "angle"
"""


@cache
def arm(kind: str, **changes: Any) -> Scene:
    """Return two links on a prescribed base."""
    planar = kind == "planar"
    shapes = [f"mass = {M[j]}\nlength = {L[j]}\ncenter = {C[j]}" if planar else "" for j in (0, 1)]
    text = ARM.format(kind=kind, first=shapes[0], second=shapes[1], rate="rate" if planar else "velocity")
    keys = {key.replace("__", "."): value for key, value in changes.items()}
    return parse_scene(text).replace(**keys) if keys else parse_scene(text)


@cache
def kernel(kind: str, name: str) -> NativeKernel:
    scene = arm(kind, integrator__name=name, **({"model__iterations": 2} if kind == "planar" else {}))
    return compile_kernel(build_program(scene), scene, flags=("-O1",))


def by_hand(kind: str, base: Signal, times: np.ndarray) -> dict[str, np.ndarray]:
    """Solve the textbook's equations of the two links with SciPy; nothing of the project but the motion of the base."""

    def torques(t: float, q: np.ndarray, v: np.ndarray) -> tuple[float, float]:
        inner = K[0] * (q[0] - float(base.at(t))) + D[0] * (v[0] - float(base.slope(t)))
        return inner, K[1] * (q[1] - q[0]) + D[1] * (v[1] - v[0])

    def right(t: float, state: np.ndarray) -> np.ndarray:
        q, v = state[:2], state[2:]
        inner, outer = torques(t, q, v)
        mass, load = np.diag(J).astype(float), np.array([outer - inner, -outer])
        if kind == "planar":
            way = (C[0] * L[0], C[1] * L[1])
            apart, between = q[0] - q[1], M[1] * L[0] * way[1]
            mass += [
                [M[0] * way[0] ** 2 + M[1] * L[0] ** 2, between * np.cos(apart)],
                [between * np.cos(apart), M[1] * way[1] ** 2],
            ]
            load += [-between * np.sin(apart) * v[1] ** 2, between * np.sin(apart) * v[0] ** 2]
        return np.concatenate([v, np.linalg.solve(mass, load)])

    stops = np.unique(
        np.concatenate([[0.0, times[-1]], base.knots[(base.knots > 0) & (base.knots < times[-1])]])
    )
    state, rows = np.zeros(4), [np.zeros((0, 4))]
    for start, stop in pairwise(stops):
        inside = times[(times >= start) & ((times < stop) | (stop == times[-1]))]
        done = solve_ivp(
            right, (start, stop), state, "DOP853", np.union1d(inside, stop), rtol=1e-11, atol=1e-12
        )
        state = done.y[:, -1]
        rows.append(done.y[:, : len(inside)].T)
    found = np.concatenate(rows)
    inner = [torques(t, row[:2], row[2:])[0] for t, row in zip(times, found, strict=True)]
    return {
        "hub": base.at(times),
        "hub_rate": base.slope(times),
        "torque": np.array(inner),
        "tip": found[:, 1],
    }


def run(made: NativeKernel, base: Signal, until: float, step: float) -> dict[str, np.ndarray]:
    signals = {name: signal.at for name, signal in kernel_signals(arm("chain"), {"turn": base}).items()}
    return Series(made, signals, round(until / step), step).run()


plans = st.one_of(
    st.builds(
        Smooth,
        before=st.just(0.0),
        after=st.floats(0.2, 1.5) | st.floats(-1.5, -0.2),
        duration=st.floats(0.5, 0.8),
    ),
    st.builds(Sine, amplitude=st.floats(0.2, 1.0), frequency=st.floats(2.0, 6.0)),
)


@pytest.mark.compiler
@pytest.mark.parametrize("kind", ["chain", "planar"])
@pytest.mark.parametrize("name", names())
@settings(max_examples=2, deadline=None, derandomize=True)
@given(base=plans)
def test_every_integrator_follows_at_its_order(kind: str, name: str, base: Signal) -> None:
    """No order is lost to the base, and its own motion is exact."""
    made, until, steps = kernel(kind, name), 0.4, (2e-3, 1e-3, 5e-4)
    exact = by_hand(kind, base, 2e-3 * np.arange(201))
    errors: dict[str, list[float]] = {"tip": [], "torque": []}
    for step in steps:
        found = run(made, base, until, step)
        every = round(2e-3 / step)
        for output in ("hub", "hub_rate"):
            np.testing.assert_allclose(found[output][::every], exact[output], rtol=0, atol=1e-12)
        for output, values in errors.items():
            scale = float(np.max(np.abs(exact[output])))
            values.append(float(np.max(np.abs(found[output][::every] - exact[output]))) / scale)
    least = order(integrator(name)) - 0.25
    for values in errors.values():
        assert convergence_slope(steps, values).order > least or values[-1] < 1e-8
        assert values[-1] < (2e-2 if name == "fox_euler" else 2e-3)


@pytest.mark.parametrize("kind", ["chain", "planar"])
def test_the_corner_of_a_ramp_is_kept(kind: str, tmp_path: Path) -> None:
    """Three rows are straight in between, as they look: the rate is 1 before the corner, and 0 after it."""
    path = tmp_path / "ramp.csv"
    path.write_text("time,turn\n0,0\n1,1\n3,1\n")
    signals = read_inputs([str(path)], ("turn",), {"turn"})
    ramp = Table(np.array([0.0, 1.0, 3.0]), np.array([0.0, 1.0, 1.0]))
    errors = []
    for step in (1e-3, 5e-4):
        found = simulate(arm(kind, integrator__step=step), signals, 1.2)
        rate, before = found.outputs["hub_rate"], found.time < 1.0 - 1e-9
        np.testing.assert_allclose(rate[before], 1.0, rtol=0, atol=1e-12)
        np.testing.assert_allclose(rate[~before], 0.0, rtol=0, atol=1e-12)
        exact = by_hand(kind, ramp, found.time)["torque"]
        apart = np.abs(found.outputs["torque"] - exact)
        apart[np.isclose(found.time, 1.0)] = 0.0  # where the damper's torque jumps, either side is right
        errors.append(np.max(apart) / np.max(np.abs(exact)))
    # a jump of the damper's torque at the end of a step is felt half a step early
    assert errors[0] < 1e-2
    assert errors[1] < 0.6 * errors[0]
    assert "jumps by +1 rad/s at 0 s, -1 rad/s at 1 s" in found.notes[0]


@settings(max_examples=30, deadline=None)
@given(base=plans, rows=st.sampled_from([0.004, 0.01, 0.02]))
def test_tables_of_smooth_plans_have_their_rates(base: Signal, rows: float) -> None:
    times = np.arange(0.0, 1.2, rows)
    motion = kernel_signals(arm("planar"), {"turn": Table(times, base.at(times))})
    fine = np.arange(0.0, times[-1], 1e-3)
    largest = np.max(np.abs(base.slope(fine)))
    np.testing.assert_allclose(motion["turn_rate"].at(fine), base.slope(fine), rtol=0, atol=5e-3 * largest)
    np.testing.assert_allclose(motion["turn"].at(times), base.at(times), rtol=0, atol=1e-12)


@settings(max_examples=30, deadline=None)
@given(
    ways=st.lists(st.floats(-2.0, 2.0), min_size=2, max_size=3).filter(
        lambda ways: all(abs(a - b) > 0.1 for a, b in zip(ways, [*ways[1:], 0.0], strict=True))
    ),
    span=st.floats(0.2, 3.0),
)
def test_a_few_rows_are_straight_in_between(ways: list[float], span: float) -> None:
    times = span * np.arange(len(ways) + 1)
    table = Table(times, np.concatenate([[0.0], np.cumsum(ways)]))
    motion = kernel_signals(arm("planar"), {"turn": table})
    fine = np.linspace(0.01, times[-1] - 0.01, 77)
    np.testing.assert_allclose(motion["turn"].at(fine), table.at(fine), rtol=0, atol=1e-12)
    inside = np.abs(fine[:, None] - times).min(axis=1) > 1e-6
    np.testing.assert_allclose(motion["turn_rate"].at(fine[inside]), table.slope(fine[inside]), atol=1e-12)


def test_corners_among_many_rows_are_kept() -> None:
    """A spline would ring about the corner: its rate would leave the table's by a quarter."""
    times = np.arange(0.0, 3.0, 0.01)
    motion = kernel_signals(arm("planar"), {"turn": Table(times, np.minimum(times, 1.5))})
    fine = np.arange(0.0, 2.9, 1e-3)
    np.testing.assert_allclose(motion["turn_rate"].at(fine), np.where(fine < 1.5 - 1e-9, 1.0, 0.0), atol=1e-9)


@pytest.mark.parametrize("columns", [("turn_rate",), ("turn_rate", "turn_acceleration")])
def test_a_file_may_have_rates_and_accelerations(columns: tuple[str, ...], tmp_path: Path) -> None:
    base, times = Smooth(0.0, 1.5, 0.8), np.arange(0.0, 1.01, 0.1)
    values = [base.at(times), base.slope(times), base.curvature(times)][: len(columns) + 1]
    path = tmp_path / "plan.csv"
    rows = [",".join(map(repr, map(float, row))) for row in zip(times, *values, strict=True)]
    path.write_text("\n".join([",".join(("time", "turn", *columns)), *rows]) + "\n")
    motion = kernel_signals(arm("planar"), read_inputs([f"turn={path}"], ("turn",), {"turn"}))
    fine = np.linspace(0.0, 1.0, 501)
    within = (1e-2, 2.0) if len(columns) == 1 else (1e-12, 1e-9)
    np.testing.assert_allclose(motion["turn_rate"].at(fine), base.slope(fine), atol=within[0])
    np.testing.assert_allclose(motion["turn_acceleration"].at(fine), base.curvature(fine), atol=within[1])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "time,turn,turn_acceleration\n0,0,0\n1,1,0\n",
            "plan.csv:1: has a column 'turn_acceleration' and none",
        ),
        (
            "time,turn,turn_rate\n" + "".join(f"{k},{0.1 * k * k},{11.46 * k}\n" for k in range(9)),
            "is 57.3 times the slope of 'turn'. It must be in rad/s",
        ),
    ],
)
def test_columns_that_do_not_fit(text: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "plan.csv"
    path.write_text(text)
    with pytest.raises(UserError, match=re.escape(said)):
        read_inputs([str(path)], ("turn",), {"turn"})


# -- what no base can do, and what it says to do instead ---------------------------------------------------------


def jump(kind: str, folder: Path) -> tuple[list[str], dict[str, Any]]:
    """Return an option that makes the base jump, and the scene's own changes."""
    table = folder / "jump.csv"
    table.write_text("time,turn\n0,0\n0.1,0\n0.101,0.5\n0.4,0.5\n")
    return {
        "table": ([f"turn={table}"], {}),
        "step": (["turn=step:0:0.5:0.1s"], {}),
        "start": (["turn=0.5"], {}),
        "no input": ([], {"initial__angles": 0.5}),
    }[kind]


@pytest.mark.parametrize("model", ["chain", "planar"])
@pytest.mark.parametrize("kind", ["table", "step", "start", "no input"])
def test_a_jump_is_refused_and_each_remedy_works_alone(kind: str, model: str, tmp_path: Path) -> None:
    options, changes = jump(kind, tmp_path)
    scene = arm(model, **changes)
    with pytest.raises(UserError) as caught:
        simulate(scene, read_inputs(options, ("turn",), {"turn"}), 0.2)
    said = str(caught.value)
    assert said.startswith("scene 'told', input 'turn'")
    assert ("jump.csv:4" in said) == (kind == "table")
    remedies = re.findall(r"--(input|set|step) ([^\s,]+?)(?=[,\s]|\.$|$)", said)
    assert len(remedies) == {"table": 2, "step": 1, "start": 2, "no input": 2}[kind]
    for which, value in remedies:
        own = read_inputs([value] if which == "input" else options, ("turn",), {"turn"})
        changed = scene
        if which == "set":
            key, _, number = value.partition("=")
            changed = scene.replace(**{key: float(number)})
        elif which == "step":
            changed = scene.replace(**{"integrator.step": float(value)})
        # sweeps and steps are another matter, with remedies of their own
        found = simulate(changed, own, 0.2, refuse=False)
        assert np.max(np.abs(found.outputs["tip"])) < 2.0
    if kind == "table":  # the third is in words
        table = tmp_path / "jump.csv"
        table.write_text("time,turn\n0,0\n0.1,0\n0.105,0.5\n0.4,0.5\n")
        assert "rows at least 5 steps apart" in said
        simulate(scene, read_inputs(options, ("turn",), {"turn"}), 0.2, refuse=False)


def test_records_that_begin_a_little_beside_the_arm_are_taken() -> None:
    times = np.arange(0.0, 1.0, 0.01)
    simulate(arm("chain"), {"turn": Table(times, 0.005 + np.sin(3.0 * times))}, 0.1)
    with pytest.raises(UserError, match=r"starts at 0\.05 rad and the arm at 0 rad"):
        simulate(arm("chain"), {"turn": Table(times, 0.05 + np.sin(3.0 * times))}, 0.1)


def test_an_arm_that_starts_bent_starts_as_it_is() -> None:
    simulate(arm("planar", initial__angles=(0.1, 0.3)), {"turn": Constant(0.05)}, 0.02)
    simulate(arm("planar"), {"turn": Step(0.0, 0.0, 0.1)}, 0.02)  # no jump


# -- generated packages --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["newmark", "sdirk4", "wilson", "generalized_alpha"])
def test_the_package_derives_what_a_function_does_not_say(name: str) -> None:
    base = Sine(0.7, 3.0)
    signals = kernel_signals(arm("chain"), {"turn": base})
    module = numpy_module(arm("chain", integrator__name=name))
    told = module.simulate(0.2, {name: signal.at for name, signal in signals.items()}).outputs
    derived = module.simulate(0.2, {"turn": base.at}).outputs
    for output, values in told.items():
        np.testing.assert_allclose(derived[output], values, rtol=0, atol=1e-9)
    assert np.ptp(told["hub_rate"]) > 0.1
    held = module.simulate(0.01, {"turn": 0.3}).outputs
    assert held["hub_rate"].tolist() == [0.0] * 11


@pytest.mark.compiler
def test_both_backends_follow_a_table_alike(tmp_path: Path) -> None:
    times = np.arange(0.0, 0.5, 0.01)
    table = Table(times, Smooth(0.0, 1.0, 0.3).at(times))
    for kind in ("chain", "planar"):
        one, other = (simulate(arm(kind), {"turn": table}, 0.3, backend) for backend in ("numpy", "c"))
        assert not one.notes
        for name, values in one.outputs.items():
            np.testing.assert_allclose(other.outputs[name], values, rtol=0, atol=1e-10)
