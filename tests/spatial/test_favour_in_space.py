"""Fast C of arms in space whose stages follow one another: walks in one direction are one, the motion is the same."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from tmm_gen.emit.c.lower import lower
from tmm_gen.emit.c.split_at_runs import split_at_runs
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.native.library import NonFiniteStateError, OutOfRangeError, VanishingPivotError
from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.program.passes.contract import contract
from tmm_gen.program.passes.fuse import fuse
from tmm_gen.program.statements import Assign, Loop, Order, Program, Routine
from tmm_gen.program.variables import refs_in
from tmm_gen.scene import Scene, parse_scene

CELLS = 6
CLAMP = 'kind = "clamp"'
FREE = 'kind = "free"\n[[body]]\nname = "hub"\non = "base"\nmass = 3.0\ninertia = [0.03, 0.04, 0.05]'
GIVEN = 'kind = "prescribed"\naxis = "z"\n[[input]]\nname = "table"\nat = "base"\nacts = "angle"'
ARM = """
name = "branched"
[model]
kind = "spatial"
gravity = [0, 0, -9.81]
[integrator]
name = "newmark"
step = 2e-3
[emit]
trigonometry = "own"
[base]
{base}
[[motor]]
name = "drive"
on = "base"
at = [0.0, 0.0, 0.2]
axis = "y"
rotor_inertia = 1e-3
gear = 10.0
damping = 0.5
[[beam]]
name = "boom"
on = "drive"
length = 0.5
bending_stiffness = [60.0, 40.0]
mass_per_length = 0.3
links = {cells}
damping_time = 1e-3
[[joint]]
name = "left"
on = "boom"
axis = "x"
stiffness = 10.0
damping = 0.05
[[joint]]
name = "right"
on = "boom"
axis = "z"
stiffness = 5.0
damping = 0.05
[[body]]
name = "load"
on = "left"
mass = 0.4
center = [0.2, 0.0, 0.05]
inertia = [1e-3, 2e-3, 3e-3]
[[body]]
name = "other"
on = "right"
mass = 0.3
center = [0.1, 0.1, 0.0]
inertia = [2e-3, 1e-3, 2e-3]
[[input]]
name = "torque"
at = "drive"
acts = "torque"
[[output]]
name = "load"
at = "load"
of = "position"
"""


@cache
def scene(base: str) -> Scene:
    return parse_scene(ARM.format(base=base, cells=CELLS))


@cache
def program(base: str) -> Program:
    return build_program(scene(base))


def kernels(base: str) -> list[NativeKernel]:
    """Return the small kernel and the fast one, started."""
    made = []
    for favour in ("size", "speed"):
        made.append(compile_kernel(program(base), scene(base).replace(**{"emit.favour": favour})))
        made[-1].prepare()
        made[-1].initialise()
    return made


@pytest.mark.compiler
@pytest.mark.parametrize("base", [CLAMP, GIVEN, FREE], ids=["clamp", "prescribed", "free"])
def test_the_motion_is_the_same_and_so_are_refusals(base: str) -> None:
    small, fast = kernels(base)
    for k in range(5):
        for kernel in (small, fast):
            kernel.step(
                {
                    v.name: 0.01 * k if v.length is None else np.full(v.length, 0.01 * k)
                    for v in kernel.program.inputs
                }
            )
    for key, value in small.state.items():
        allowed = 1e-12 * max(1.0, float(np.max(np.abs(value))))
        np.testing.assert_allclose(fast.state[key], value, rtol=0, atol=allowed, err_msg=key)
    rest = fast.state
    for value, error in ((1e9, OutOfRangeError), (np.nan, OutOfRangeError)):
        for kernel in (small, fast):
            spoilt = {**rest, "angle": np.full(kernel.program.stations, value)}
            kernel.state = spoilt
            with pytest.raises(error):
                kernel.step({})
            np.testing.assert_array_equal(kernel.state["angle"], spoilt["angle"])
    for kernel in (small, fast):
        kernel.state = {**rest, "rate": np.full(kernel.program.stations, np.inf)}
        with pytest.raises((NonFiniteStateError, OutOfRangeError)):
            kernel.step({})
        kernel.prepare({"stiffness": np.where(np.arange(kernel.program.stations) == 1, -1e9, 1.0)})
        kernel.state = rest
        with pytest.raises(VanishingPivotError):
            kernel.step({})


def beam_loops(routine: Routine, order: Order) -> list[Loop]:
    """Return the loops over the cells of the beam in one direction."""
    loops = [s for s in routine.statements() if isinstance(s, Loop) and s.order is order]
    return [loop for loop in loops if loop.stride > 1 and len(loop.visits) > 1]


def written(loop: Loop) -> set[str]:
    return {line.target.variable.name for line in loop.body if isinstance(line, Assign)}


def test_walks_in_one_direction_are_one() -> None:
    """Out by the predicted motion; back out, by what was found, and out again by that; back out to the new state."""
    found = program(CLAMP)
    small, fast = lower(found).main, lower(found, together=True).main
    first, between, last = (written(loop) for loop in beam_loops(fast, Order.OUTWARD))
    assert {"predicted_angle", "sine", "own_force_x"} <= first
    assert {"unknown", "predicted_angle", "sine", "own_force_x"} <= between
    assert {"unknown", "angle", "rate", "acceleration"} <= last
    assert len(beam_loops(small, Order.OUTWARD)) == 4
    assert len(beam_loops(fast, Order.INWARD)) == len(beam_loops(small, Order.INWARD)) == 2
    assert count_routine(fast) == count_routine(small) == count_routine(found.main)


def test_pieces_do_what_the_loop_did() -> None:
    """Station by station the same values are assigned, by the same expressions."""
    whole = program(CLAMP).main
    cut = split_at_runs(whole)
    assert cut != whole

    def assigned(routine: Routine) -> list[tuple[str, str]]:
        """Return what is assigned to each element, and what of which elements."""
        found = []
        for statement in routine.statements():
            loop = isinstance(statement, Loop)
            for j in statement.visits if loop else range(1):
                for line in statement.body if loop else (statement,):
                    refs = refs_in(line.value) | ({line.target} if isinstance(line, Assign) else set())
                    at = {r: r.variable.entry(j + r.offset) for r in refs if r.offset is not None}
                    target = at.get(line.target, line.target) if isinstance(line, Assign) else "required"
                    found.append((str(target), str(line.value.xreplace(at))))
        return found

    assert sorted(assigned(cut)) == sorted(assigned(whole))
    assert len(list(contract(fuse(cut)).statements())) < len(list(cut.statements()))
