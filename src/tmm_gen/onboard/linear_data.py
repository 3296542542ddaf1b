"""Everything numeric that a linear MPC in C needs, prepared once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.arm import Holding
from tmm_gen.control.arm.holding import LevelHolding
from tmm_gen.control.arm.space_arm import RigidHolding
from tmm_gen.control.estimators.credible import Credible
from tmm_gen.control.estimators.kalman import KalmanFilter
from tmm_gen.control.laws.linear_mpc import LinearMpc
from tmm_gen.control.laws.safe import BRAKE_TIME
from tmm_gen.control.task.terms import Kind
from tmm_gen.onboard.linear_maps import affine_maps, first_active, folded
from tmm_gen.onboard.linear_pull import pull_of
from tmm_gen.onboard.program_data import ProgramData, program_data
from tmm_gen.onboard.weight import Weight, weight_of

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class LinearMpcData:
    """Tables of a linear MPC of m motors; ``z = (w, d - u_s, u[-1], 1)`` has ``r + 2 m + 1`` entries.

    ``w`` is what of the state x makes a difference to what comes, r numbers of it: a step that integrates
    accelerations goes on from angles and rates that these have been added to already.

    Parameters
    ----------
    size : int
        Entries of the model's state, s.
    biases : int
        b, of how many sensors what they are off for long is estimated.
    kept, others : tuple of int, (r,) and (s - r,)
        Entries of x.
    fold : array, (r, s - r)
        ``w = x[kept] + fold x[others]``.
    transition, before, then : array, (s, r + m), (s, m) and (s, m)
        Of the state over a sample, by w and disturbances, and by the torques that act in it.
    measure, feed : array, (p, s + m) and (p, m)
        Of the Kalman filter.
    gains : array, (2^(p - m), s + m + b, p)
        Of the same, by which sensors behind the encoders are there; see :func:`gains_by_sensors`.
    spread : array, (p, p)
        Covariance of what sensors are off.
    credible : Credible
        What can be believed of a measurement.
    turned, turning : array, (s, m)
        What the state is of an arm of which a hub is turned by 1 rad, and of one of which it turns at 1 rad/s.
    hub, hub_rate : array, (m, s)
        Rows that give the hubs' angles and rates.
    target_hub : array, (m,)
        rad.
    start : array, (s + m,)
        Estimate at time zero.
    start_torque, target_torque : array, (m,)
        Torques before any is chosen, and at the target, N m.
    tip_rate, whirl : array, (s,)
        The accelerometer of an arm on a hub feels the tip's rate squared times ``whirl x`` besides what is linear.
    swept : array, (m, m, m)
        Others feel products of the hubs' rates.
    sensors : tuple of int
        Which there are of m encoders, m accelerometers and m strain gauges.
    shown : array, (p,)
        What they show at the target.
    whole, acting, memory : int
        Delay in samples, of the model and of the arm; past torques that count.
    program : ProgramData
        The quadratic program, but for what follows.
    shift : array, (m N, r + 2 m + 1)
        ``v = R^-T f`` by ``z``.
    free : array, (rows, r + 2 m)
        What the rows are at without inputs, by ``z`` but for its last entry, less what they are at the target.
    kinds : tuple of Kind
        What the rows of the program bound.
    rest : array, (kinds of rows,)
        What the rows are at at the target.
    brake : array, (m,)
        Of the safe law, N m s/rad.
    holds : array, (m, m)
        What holds up an arm in a plane, N m; see :func:`tmm_gen.control.arm.holding.holding`.
    weight : Weight or None
        What holds up an arm in space.
    holds_more : array, (m, m)
        By how much these grow for each kilogram at the tip, N m/kg; zero where that makes no difference.
    payload : float or None
        Mass at the tip, kg; None where another makes no difference to what holds the arm up.
    payload_words : str
        What that is called.
    payloads : (float, float)
        The least and the largest one that the model is good for, kg.
    sag, felt : array, (s, m) and (p, m)
        Of a rest elsewhere; see :class:`~tmm_gen.control.prediction.linear_target.Places`.
    reach, range : array, (m,)
        How far the model is good, rad; see :class:`~tmm_gen.control.laws.linear_mpc.LinearMpc`.
    tips : tuple of (int, array, array)
        Which kinds of rows bound tips; what a tip at the target grows with: hubs' angles, (m,), and their sines, (m,).
    answers : array, (outputs, m, N)
        Of what is weighed to each motor's torque, sample by sample.
    pulls : array, (outputs, 3 m)
        What a motion of the hubs, (3, m), makes of that, times its weight.
    priced : array, (m, 3 m)
        The same of the torques.
    end_pulls : array, (m N, 3 m)
        What the motion at the end makes of the gradient.
    first : tuple of int
        Bounds that are active at the start, counted from 1, lower ones negative, a sample later than they are: where
        a solver that lets them move on by a sample begins. So the first sample is none of the longest.
    """

    size: int
    biases: int
    kept: tuple[int, ...]
    others: tuple[int, ...]
    fold: Array
    transition: Array
    before: Array
    then: Array
    measure: Array
    feed: Array
    gains: Array
    spread: Array
    credible: Credible
    turned: Array
    turning: Array
    hub: Array
    hub_rate: Array
    target_hub: Array
    start: Array
    start_torque: Array
    target_torque: Array
    tip_rate: Array
    whirl: Array
    swept: Array
    sensors: tuple[int, ...]
    shown: Array
    whole: int
    acting: int
    memory: int
    program: ProgramData
    shift: Array
    free: Array
    kinds: tuple[Kind, ...]
    rest: Array
    brake: Array
    holds: Array
    weight: Weight | None
    holds_more: Array
    payload: float | None
    payload_words: str
    payloads: tuple[float, float]
    sag: Array
    felt: Array
    reach: Array
    range: Array
    tips: tuple[tuple[int, Array, Array], ...]
    answers: Array
    pulls: Array
    priced: Array
    end_pulls: Array
    first: tuple[int, ...]


def linear_mpc_data(controller: LinearMpc) -> LinearMpcData:
    """Return the tables of a controller."""
    model, kalman, problem = controller.model, controller.estimator, controller.problem
    assert isinstance(kalman, KalmanFilter)
    program = program_data(problem, controller.condensed)
    size, count = model.size, model.count
    gradient, free = affine_maps(controller)
    kinds = len(free) // problem.horizon
    shift = program.inverse.T @ gradient
    kept, others, fold = folded(np.vstack([model.transition, shift[:, :size], free[:, :size]]))
    known = [*kept, *range(size, size + 2 * count + 1)]
    lift, places, pull = model.lift, controller.places, pull_of(controller)
    lighter, heavier = lift.holding, lift.holding_heavier if lift.carries else lift.holding
    level = [
        each.rows if isinstance(each, LevelHolding) else np.zeros((count, count))
        for each in (lighter, heavier)
    ]
    return LinearMpcData(
        size=size,
        biases=len(kalman.biased),
        kept=kept,
        others=others,
        fold=fold,
        transition=kalman.transition[:size, known[: -count - 1]],
        before=model.before,
        then=model.then,
        measure=kalman.measure[:, : size + count],
        feed=kalman.feed,
        gains=gains_by_sensors(kalman),
        spread=kalman.spread,
        credible=controller.limits,
        turned=model.turned,
        turning=model.turn,
        hub=model.hub,
        hub_rate=model.hub_rate,
        target_hub=model.goal.hub,
        start=np.append(model.start, np.zeros(count)),
        start_torque=model.start_torque,
        target_torque=model.goal.torque,
        tip_rate=model.tip_rate[0],
        whirl=model.whirl,
        swept=model.swept,
        sensors=tuple(kalman.sensors),
        shown=model.target_sensors[kalman.sensors],
        whole=controller.delay.whole,
        acting=controller.delay.acting,
        memory=controller.delay.memory,
        program=program,
        shift=shift[:, known],
        free=free[:, known[:-1]],
        kinds=controller.condensed.kinds,
        rest=free[:: problem.horizon, -1] if kinds else np.zeros(0),
        brake=controller.inertia / BRAKE_TIME,
        holds=level[0],
        holds_more=level[1] - level[0],
        payload=lift.payload if lift.carries else None,
        payload_words=lift.words,
        payloads=controller.payloads if lift.carries else (0.0, 0.0),
        weight=_weight(lighter, heavier, count),
        sag=places.sag,
        felt=places.felt[kalman.sensors],
        reach=controller.reach,
        range=controller.range,
        tips=tuple(
            (place, model.tip[kind.motor] @ model.turned, model.tip[kind.motor] @ places.sag)
            for place, kind in enumerate(controller.condensed.kinds)
            if kind.what == "tip"
        ),
        answers=pull.answers,
        pulls=pull.pulls,
        priced=pull.priced,
        end_pulls=pull.end_pulls,
        first=first_active(controller, program, free),
    )


def _weight(arm: Holding, heavier: Holding, motors: int) -> Weight | None:
    """Return what holds up an arm in space."""
    if not isinstance(arm, RigidHolding) or not isinstance(heavier, RigidHolding):
        return None
    return weight_of(arm.arm, heavier.arm, motors)


def gains_by_sensors(kalman: KalmanFilter) -> Array:
    """Return the gains of a filter for each set of its sensors with all m encoders in it, (2^(p - m), s + m + b, p).

    Bit ``i`` of a set's number is the sensor ``m + i``; columns of sensors that are not in it are zero.
    """
    sensors, encoders = kalman.sensors, kalman.model.count
    found = np.zeros((1 << (len(sensors) - encoders), len(kalman.estimate), len(sensors)))
    for number, gain in enumerate(found):
        more = (encoders + i for i in range(len(sensors) - encoders) if number >> i & 1)
        places = [*range(encoders), *more]
        gain[:, places] = kalman.gain_of(tuple(sensors[i] for i in places))
    return found
