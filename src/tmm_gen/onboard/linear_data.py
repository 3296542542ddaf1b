"""Everything numeric that a linear MPC in C needs, prepared once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Status
from tmm_gen.control.credible import Credible
from tmm_gen.control.kalman import KalmanFilter
from tmm_gen.control.linear_mpc import LinearMpc
from tmm_gen.control.safe import BRAKE_TIME
from tmm_gen.onboard.program_data import ProgramData, program_data

Array = NDArray[np.float64]

_ACTIVE = 1e-9
"""How near a bound an input or a row is that is held by it."""

_ROUNDING = 1e-13
"""What is left of a column that others make up, relative to the largest."""


@dataclass(frozen=True, eq=False)
class LinearMpcData:
    """Tables of a linear MPC of one motor; ``z = (w, d - u_s, u[-1], 1)`` has ``r + 3`` entries.

    ``w`` is what of the state x makes a difference to what comes, r numbers of it: a step that integrates
    accelerations goes on from angles and rates that these have been added to already.

    Parameters
    ----------
    size : int
        Entries of the model's state, m.
    kept, others : tuple of int, (r,) and (m - r,)
        Entries of x.
    fold : array, (r, m - r)
        ``w = x[kept] + fold x[others]``.
    transition, before, then : array, (m, r + 1), (m,) and (m,)
        Of the state over a sample, by w and disturbance, and by the torques that act in it.
    measure, feed : array, (p, m + 1) and (p,)
        Of the Kalman filter.
    gains : array, (2^(p - 1), m + 1, p)
        Of the same, by which sensors behind the encoder are there; see :func:`gains_by_sensors`.
    credible : Credible
        What can be believed of a measurement.
    turned, turning : array, (m,)
        What the state is of an arm turned by 1 rad, and of one turning at 1 rad/s.
    target_hub : float
        rad.
    start : array, (m + 1,)
        Estimate at time zero.
    start_torque : array, (1,)
        Torque before any is chosen, N m.
    tip_rate, whirl : array, (m,)
        The accelerometer feels the tip's rate squared times ``whirl x`` besides what is linear.
    sensors : tuple of int
        Which of encoder, accelerometer and strain gauge there are.
    shown : array, (p,)
        What they show at the target.
    target_torque : float
        N m.
    whole, acting, memory : int
        Delay in samples, of the model and of the arm; past torques that count.
    program : ProgramData
        The quadratic program, but for what follows.
    shift : array, (N, r + 3)
        ``v = R^-T f`` by ``z``.
    free : array, (rows, r + 2)
        What the rows are at without inputs, by ``z`` but for its last entry, less what they are at the target.
    rest : array, (kinds of rows,)
        What the rows are at at the target.
    brake : float
        Of the safe law, N m s/rad.
    first : tuple of int
        Bounds that are active at the start, counted from 1, lower ones negative, a sample later than they are: where
        a solver that lets them move on by a sample begins. So the first sample is none of the longest.
    """

    size: int
    kept: tuple[int, ...]
    others: tuple[int, ...]
    fold: Array
    transition: Array
    before: Array
    then: Array
    measure: Array
    feed: Array
    gains: Array
    credible: Credible
    turned: Array
    turning: Array
    target_hub: float
    start: Array
    start_torque: Array
    tip_rate: Array
    whirl: Array
    sensors: tuple[int, ...]
    shown: Array
    target_torque: float
    whole: int
    acting: int
    memory: int
    program: ProgramData
    shift: Array
    free: Array
    rest: Array
    brake: float
    first: tuple[int, ...]


def linear_mpc_data(controller: LinearMpc) -> LinearMpcData:
    """Return the tables of a controller."""
    model, kalman, problem = controller.model, controller.estimator, controller.problem
    assert isinstance(kalman, KalmanFilter)
    program = program_data(problem, controller.condensed)
    size = model.size
    gradient, free = _affine_maps(controller)
    kinds = len(free) // problem.horizon
    shift = program.inverse.T @ gradient
    kept, others, fold = _folded(np.vstack([model.transition, shift[:, :size], free[:, :size]]))
    known = [*kept, *range(size, size + 3)]
    return LinearMpcData(
        size=size,
        kept=kept,
        others=others,
        fold=fold,
        transition=kalman.transition[:size, known[:-2]],
        before=model.before[:, 0],
        then=model.then[:, 0],
        measure=kalman.measure,
        feed=kalman.feed[:, 0],
        gains=gains_by_sensors(kalman),
        credible=controller.limits,
        turned=model.turned[:, 0],
        turning=model.turn[:, 0],
        target_hub=float(model.goal.hub[0]),
        start=np.append(model.start, 0.0),
        start_torque=model.start_torque,
        tip_rate=model.tip_rate[0],
        whirl=model.whirl,
        sensors=tuple(kalman.sensors),
        shown=model.target_sensors[kalman.sensors],
        target_torque=float(model.goal.torque[0]),
        whole=controller.delay.whole,
        acting=controller.delay.acting,
        memory=controller.delay.memory,
        program=program,
        shift=shift[:, known],
        free=free[:, known[:-1]],
        rest=free[:: problem.horizon, -1] if kinds else np.zeros(0),
        brake=float(controller.inertia[0]) / BRAKE_TIME,
        first=_first_active(controller, program, free),
    )


def _folded(columns: Array) -> tuple[tuple[int, ...], tuple[int, ...], Array]:
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


def gains_by_sensors(kalman: KalmanFilter) -> Array:
    """Return the gains of a filter for each set of its sensors with all m encoders in it, (2^(p - m), s + m, p).

    Bit ``i`` of a set's number is the sensor ``m + i``; columns of sensors that are not in it are zero.
    """
    sensors, encoders = kalman.sensors, kalman.model.count
    found = np.zeros((1 << (len(sensors) - encoders), len(kalman.estimate), len(sensors)))
    for number, gain in enumerate(found):
        more = (encoders + i for i in range(len(sensors) - encoders) if number >> i & 1)
        places = [*range(encoders), *more]
        gain[:, places] = kalman.gain_of(tuple(sensors[i] for i in places))
    return found


def _first_active(controller: LinearMpc, program: ProgramData, free: Array) -> tuple[int, ...]:
    """Return what is active at the scene's start, a sample later; see :class:`LinearMpcData`."""
    count, delay = program.horizon, controller.delay
    controller.reset()
    past = np.zeros((delay.memory + 1, 1))
    state, disturbance = controller.estimator.ahead(delay.known(past))
    solution = controller.planned(state, disturbance, past[-1])
    controller.reset()
    if solution.status is not Status.OK:
        return ()
    inputs = solution.point[:count]
    known = np.array([*state, *(disturbance - controller.model.goal.torque), 0.0, 1.0])
    values = np.concatenate([inputs, program.rows @ inputs + free @ known])
    found = []
    for at in np.flatnonzero((values > program.high - _ACTIVE) | (values < program.low + _ACTIVE)):
        place = at if at % count == count - 1 else at + 1
        found.append(int(place + 1 if values[at] > program.low[at] + _ACTIVE else -place - 1))
    return tuple(dict.fromkeys(found))


def _affine_maps(controller: LinearMpc) -> tuple[Array, Array]:
    """Return gradient of the inputs, and free motion of the rows, as maps of ``z``: both are affine in it."""
    problem, found, target = controller.problem, controller.response, controller.model
    size = target.size
    none = np.zeros((1, problem.horizon))

    def at(z: Array) -> tuple[Array, Array]:
        state, pushed, last, one = z[:size], z[size : size + 1], z[size + 1 : size + 2], z[size + 2]
        disturbance = pushed + target.goal.torque * one
        motion = (
            found.by_state @ state
            + found.by_constant @ pushed
            + found.by_last @ last
            + controller.offsets * one
        )
        along = found.outputs(motion)
        gradient = controller.condensed.gradient(along, none, last, disturbance)[: problem.horizon]
        rows = [
            np.append(-last, none[0, 1:]) if kind.what == "rate" else getattr(along, kind.what)[kind.motor]
            for kind in controller.condensed.kinds
        ]
        return gradient, np.concatenate(rows) if rows else np.zeros(0)

    units = np.eye(size + 3)
    constant = at(units[-1])
    columns = [at(unit + units[-1]) for unit in units[:-1]]
    # the gradient's own constant belongs to the last entry of z, which is always one
    maps = []
    for which in range(2):
        parts = [column[which] - constant[which] for column in columns]
        maps.append(np.column_stack([*parts, constant[which]]))
    return maps[0], maps[1]
