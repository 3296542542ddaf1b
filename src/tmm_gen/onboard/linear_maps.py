"""What a linear MPC's program is by all that is known of a sample, and where its solver begins."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Status
from tmm_gen.control.laws.linear_mpc import LinearMpc
from tmm_gen.onboard.program_data import ProgramData

Array = NDArray[np.float64]

_ACTIVE = 1e-9
"""How near a bound an input or a row is that is held by it."""

_ROUNDING = 1e-13
"""What is left of a column that others make up, relative to the largest."""


def affine_maps(controller: LinearMpc) -> tuple[Array, Array]:
    """Return gradient of the inputs, (m N, s + 2 m + 1), and free motion of the rows, as maps of what is known.

    That is ``z = (x, d - u_s, u[-1], 1)``, in which both are affine.
    """
    problem, found, target = controller.problem, controller.response, controller.model
    size, count = target.size, problem.count
    none = np.zeros((count, problem.horizon))
    offsets = controller.offsets(target.goal)

    def at(z: Array) -> tuple[Array, Array]:
        state, pushed, last, one = z[:size], z[size : size + count], z[size + count : -1], z[-1]
        disturbance = pushed + target.goal.torque * one
        motion = found.by_state @ state + found.by_constant @ pushed + found.by_last @ last + offsets * one
        along = found.outputs(motion)
        gradient = controller.condensed.gradient(along, none, last, disturbance)[: none.size]
        rows = [
            np.append(-last[kind.motor], none[0, 1:])
            if kind.what == "rate"
            else getattr(along, kind.what)[kind.motor]
            for kind in controller.condensed.kinds
        ]
        return gradient, np.concatenate(rows) if rows else np.zeros(0)

    units = np.eye(size + 2 * count + 1)
    constant = at(units[-1])
    columns = [at(unit + units[-1]) for unit in units[:-1]]
    # the gradient's own constant belongs to the last entry of z, which is always one
    maps = []
    for which in range(2):
        parts = [column[which] - constant[which] for column in columns]
        maps.append(np.column_stack([*parts, constant[which]]))
    return maps[0], maps[1]


def folded(columns: Array) -> tuple[tuple[int, ...], tuple[int, ...], Array]:
    """Return which columns to keep, the others, and how the others are put together from those kept.

    A column counts as put together only if that is exact but for rounding, so that either answer is right.
    """
    from scipy.linalg import qr  # slow to import

    triangle, order = qr(columns, mode="r", pivoting=True)
    sizes = np.abs(np.diag(triangle[: len(order)]))
    rank = int(np.sum(sizes > _ROUNDING * sizes[0]))
    kept, others = tuple(sorted(int(i) for i in order[:rank])), tuple(sorted(int(i) for i in order[rank:]))
    fold = np.linalg.lstsq(columns[:, kept], columns[:, others], rcond=None)[0]
    return kept, others, np.where(np.abs(fold) > _ROUNDING, fold, 0.0)


def first_active(controller: LinearMpc, program: ProgramData, free: Array) -> tuple[int, ...]:
    """Return what is active at the scene's start, a sample later; see `LinearMpcData`."""
    count, delay, start = program.horizon, controller.delay, controller.model.start_torque
    controller.reset()
    past = np.tile(start, (delay.memory + 1, 1))
    state, disturbance = controller.estimator.ahead(delay.known(past))
    solution = controller.planned(state, disturbance, start)
    controller.reset()
    if solution.status is not Status.OK:
        return ()
    inputs = solution.point[: program.inputs]
    known = np.concatenate([state, disturbance - controller.model.goal.torque, start, [1.0]])
    values = np.concatenate([inputs, program.rows @ inputs + free @ known])
    found = []
    for at in np.flatnonzero((values > program.high - _ACTIVE) | (values < program.low + _ACTIVE)):
        place = at if at % count == count - 1 else at + 1
        found.append(int(place + 1 if values[at] > program.low[at] + _ACTIVE else -place - 1))
    return tuple(dict.fromkeys(found))
