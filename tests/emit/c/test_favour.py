"""Fast C: the same motion to rounding, shorter chains, loops that vectors can take, the same checks."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from tmm_gen.emit.c import emit_kernel
from tmm_gen.emit.c.clock import ADDITION, DIVISION, MULTIPLICATION, period
from tmm_gen.emit.c.lower import lower
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.native.library import NonFiniteStateError, OutOfRangeError, VanishingPivotError
from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.program.passes.lifetimes import carried_scalars
from tmm_gen.program.statements import Loop, Order, Program, Routine
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import Scene, SceneError, load_scene

OWN = {"emit.trigonometry": "own", "emit.box": None, "emit.budget": None}
NEWMARK = {"integrator.beta": None, "integrator.gamma": None}


def scene(name: str, **changes: Any) -> Scene:
    return load_scene(scenes_dir() / f"{name}.toml").replace(**changes)


@pytest.fixture(scope="module")
def arm10() -> Program:
    return build_program(scene("arm10", **OWN))


def kernels(name: str, **changes: Any) -> tuple[NativeKernel, NativeKernel]:
    """Return a scene's small kernel and its fast one, started."""
    made = []
    for favour in ("size", "speed"):
        asked = scene(name, **OWN, **changes, **{"emit.favour": favour})
        made.append(compile_kernel(build_program(asked), asked))
        made[-1].prepare()
        made[-1].initialise()
    return made[0], made[1]


@pytest.mark.compiler
@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("arm10", {}),
        ("arm10", {**NEWMARK, "integrator.name": "radau3"}),  # complex numbers, three stages
        ("arm10", {**NEWMARK, "integrator.name": "houbolt", "model.corrections": 1}),  # other first steps
        ("arm50", {}),  # five stages, a prescribed base
        ("gripper", {}),  # branches
    ],
)
def test_a_step_is_the_same_to_rounding(name: str, changes: dict[str, Any]) -> None:
    small, fast = kernels(name, **changes)
    draw = np.random.default_rng(4)
    inputs = {v.name: 0.01 if v.length is None else np.full(v.length, 0.01) for v in small.program.inputs}
    for kernel in (small, fast):
        for _ in small.program.startup:
            kernel.step(inputs)
    for _ in range(4):
        state = {
            key: value
            if key.startswith("start")
            else np.asarray(value) + draw.uniform(-1e-3, 1e-3, np.shape(value))
            for key, value in small.state.items()
        }
        after = []
        for kernel in (small, fast):
            kernel.state = state
            kernel.step(inputs)
            after.append(kernel.state)
        for key, value in after[0].items():
            # each derivative is one division by a stage's step more, and has a digit less
            digits = 1e-12 if "acceleration" in key else 1e-13 if "rate" in key else 1e-14
            allowed = digits * max(1.0, float(np.max(np.abs(value))))
            np.testing.assert_allclose(after[1][key], value, rtol=0, atol=allowed, err_msg=key)


@pytest.mark.compiler
def test_refusals_are_the_same_and_leave_the_state() -> None:
    for kernel in kernels("arm10"):
        rest = kernel.state
        for key, value, error in (
            ("angle", 1e9, OutOfRangeError),
            ("angle", np.nan, OutOfRangeError),
            ("hub_rate", np.inf, NonFiniteStateError),
        ):
            spoilt = {**rest, key: np.full(10, value) if key in ("angle", "rate") else value}
            kernel.state = spoilt
            with pytest.raises(error):
                kernel.step({})
            if error is OutOfRangeError:  # the other state is what the step has made of it
                np.testing.assert_array_equal(kernel.state[key], spoilt[key])
        kernel.prepare({"mass": -1.0})
        kernel.state = rest
        with pytest.raises(VanishingPivotError):
            kernel.step({})


def sweeps(routine: Routine, order: Order) -> list[Loop]:
    """Return the recursions of a step that carry more than sums of accelerations."""
    loops = [s for s in routine.statements() if isinstance(s, Loop) and s.order is order]
    names = {Order.INWARD: "impedance_xx", Order.OUTWARD: "unknown"}
    return [loop for loop in loops if names[order] in {v.name for v in carried_scalars(loop)}]


def test_chains_from_station_to_station_are_as_short_as_they_can_be(arm10: Program) -> None:
    small, fast = lower(arm10), lower(arm10, apart=True)
    (inward,), (outward,) = sweeps(fast.main, Order.INWARD), sweeps(fast.main, Order.OUTWARD)
    # the unknown of one station from that of the last; or both changes of motion, which the unknown has to wait for
    assert period(outward) <= MULTIPLICATION + 2 * ADDITION
    (before,) = sweeps(small.main, Order.OUTWARD)
    assert period(before) >= 2 * MULTIPLICATION + 3 * ADDITION
    # from an impedance by a swing into the force row, by a lever into the pivot, and by its inverse to the next one
    (before,) = sweeps(small.main, Order.INWARD)
    assert period(inward) == DIVISION + 3 * MULTIPLICATION + 7 * ADDITION
    assert period(before) >= period(inward) + MULTIPLICATION


def test_several_systems_go_out_one_station_ahead() -> None:
    """Of a complex one, too, unknowns do not wait for changes just behind them, and no factor is written twice."""
    program = build_program(scene("arm2", **{"integrator.name": "radau3", "model.iterations": 1}))
    small, fast = lower(program), lower(program, apart=True)

    def outward(routine: Routine) -> Loop:
        loops = (s for s in routine.statements() if isinstance(s, Loop) and s.order is Order.OUTWARD)
        (found,) = (s for s in loops if "unknown_system1" in {v.name for v in carried_scalars(s)})
        return found

    # two stations: an unknown into both changes of motion, four products of these into the unknown after next
    assert period(outward(fast.main)) <= (2 * MULTIPLICATION + 6 * ADDITION) / 2
    assert period(outward(small.main)) >= period(outward(fast.main)) + 2 * ADDITION
    factors = [v for v in fast.main.written() if "_passed_on" in v.name]
    assert len(factors) == 3  # of the real one; real and imaginary part of the other


def test_what_it_costs_is_counted(arm10: Program) -> None:
    stations = arm10.stations
    small, fast = (count_routine(lower(arm10, apart=apart).main) for apart in (False, True))
    assert small == count_routine(arm10.main)
    # one station ahead: two products and two differences, of all stations but the first; four products of a late
    # factor; a begin of four impedances and forces in vain
    assert fast.additions - small.additions == 2 * (stations - 1) + 4 - 2
    assert fast.multiplications - small.multiplications == 2 * (stations - 1) + 4 * stations + 2 - 2


def test_loops_over_sines_have_nothing_that_leaves_them(arm10: Program) -> None:
    asked = scene("arm10", **OWN, **{"emit.favour": "speed"})
    source = emit_kernel(build_program(asked), asked)["c/arm10.c"]
    step = source[source.index("arm10_status arm10_step(") :]
    loop = step[: step.index("circle_of(")].rpartition("for (")[2]
    assert "return" not in loop
    assert step.index("ARM10_LARGEST_ANGLE") < step.index("circle_of(")


@pytest.mark.parametrize(
    ("name", "changes", "message", "remedy"),
    [
        ("arm10", {"emit.favour": "fast"}, "not one of the choices", "size, speed"),
        ("arm10", {}, "[emit.box]", 'favour = "size"'),
        ("hundred", {"emit.real": "float32", "emit.compensated": True}, "exclude", "Remove one"),
        ("thesis10", {"emit.backends": ["numpy"]}, "not emitted", 'Add "c"'),
    ],
)
def test_refusals_of_scenes_name_key_and_remedy(
    name: str, changes: dict[str, Any], message: str, remedy: str
) -> None:
    with pytest.raises(SceneError) as raised:
        scene(name, **{"emit.favour": "speed", **changes})
    found = [problem for problem in raised.value.problems if problem.key == "emit.favour"]
    assert len(found) == 1
    assert message in found[0].message
    assert remedy in found[0].remedy
