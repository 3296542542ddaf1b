# thesis2: Two-station torsional chain, Gholampour (2018), table 3-2
#
# Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 8302c2fdab02afb73919e09c91c3abafc3d83d0760e2c0e63be40bfdc341e62e
# sha256 of the rest of this file: ec60166a728199d0e631945842016baab5b514c65b5a73e3504a4e9528918cfd
#
# model: torsional chain (linear)
# stations: 2
# base: clamp
# integrator: Newmark 1959, beta = 0.25, gamma = 0.5
# sweep: riccati
# unknown: acceleration
# operations of a step: 44, 22 per station (22 additions, 22 multiplications)
# operations of prepare: 21, 10.5 per station (5 additions, 14 multiplications, 2 divisions)
"""thesis2: Two-station torsional chain, Gholampour (2018), table 3-2.

A state goes in, a new one comes out: ``model = prepare(params, step)``, ``state = initialise(params,
input)``, ``state = step(model, state, input)``, ``y = output(model, state)``; or ``simulate(duration,
inputs)`` for all of them. Arrays are never written in place.

All arrays may have further axes behind, those of a batch: many arms at once, each with its own parameters,
inputs and state. What is one number for an arm then has the batch's shape; what differs between stations has
the stations first, base to tip. An arm with numbers that are not finite, or a step or pivot that is not
positive, is NaN; errors are left for where no other arm is left.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[Any]

STATIONS = 2
"""Number of links."""
STEP = 0.01
"""Time step of the scene (s)."""
INPUT_NAMES: tuple[str, ...] = ("tip_torque",)
OUTPUT_NAMES: tuple[str, ...] = ("tip", "base_torque")
STAGE_INSTANTS = ((1.0,),)
"""When inputs are read, in steps from the start of the step."""
INITIAL_ANGLE: ArrayLike = 0.0
INITIAL_RATE: ArrayLike = 0.0


class VanishingPivotError(ArithmeticError):
    """A pivot that is positive for every passive arm is not: the model cannot be solved."""


@dataclass(frozen=True, eq=False)
class Params:
    """Physical parameters, by default the scene's.

    Attributes
    ----------
    stiffness : array_like, shape (*batch)
        Joint stiffness, the same everywhere (N m/rad).
    damping : array_like, shape (*batch)
        Joint damping, the same everywhere (N m s/rad).
    inertia : array_like, shape (*batch)
        Link inertia, the same everywhere (kg m^2).
    """

    stiffness: ArrayLike = 20.0
    damping: ArrayLike = 5.0
    inertia: ArrayLike = 5.0


@dataclass(frozen=True, eq=False)
class Model:
    """What depends on parameters and step alone.

    Attributes
    ----------
    step : array, shape (*batch)
        Time step (s).
    stiffness : array, shape (*batch)
        Joint stiffness, the same everywhere (N m/rad).
    damping : array, shape (*batch)
        Joint damping, the same everywhere (N m s/rad).
    rate_per_acceleration : array, shape (*batch)
        Rate per unit of acceleration: step/2 (s).
    angle_per_acceleration : array, shape (*batch)
        Angle per unit of acceleration: step**2/4 (s^2).
    admittance : array, shape (2, *batch)
        Inverse pivot of each joint.
    transmission : array, shape (2, *batch)
        Share of motion and torque each joint passes on.
    reflection : array, shape (2, *batch)
        Share of its own known torque each joint passes on.
    """

    step: Array
    stiffness: Array
    damping: Array
    rate_per_acceleration: Array
    angle_per_acceleration: Array
    admittance: Array
    transmission: Array
    reflection: Array


@dataclass(frozen=True, eq=False)
class State:
    """Motion at one instant.

    Attributes
    ----------
    angle : array, shape (2, *batch)
        Angle of each link, base to tip (rad).
    rate : array, shape (2, *batch)
        Rate of each link, base to tip (rad/s).
    acceleration : array, shape (2, *batch)
        Acceleration of each link, base to tip (rad/s^2).
    """

    angle: Array
    rate: Array
    acceleration: Array


@dataclass(frozen=True, eq=False)
class Input:
    """What acts on the arm during a step.

    Attributes
    ----------
    tip_torque : array_like, shape (*batch)
        Torque acting at the tip (N m).
    """

    tip_torque: ArrayLike = 0.0


@dataclass(frozen=True, eq=False)
class Output:
    """What the scene reports.

    Attributes
    ----------
    tip : array, shape (*batch)
        Angle at the tip (rad).
    base_torque : array, shape (*batch)
        Torque at the base (N m).
    """

    tip: Array
    base_torque: Array


@dataclass(frozen=True, eq=False)
class Result:
    """A simulation.

    Attributes
    ----------
    times : array, shape (steps + 1,)
        Instants (s).
    outputs : dict from str to array, shape (steps + 1, *batch)
        Outputs at these instants, by name.
    state : State
        Motion at the end.
    """

    times: Array
    outputs: dict[str, Array]
    state: State


@np.errstate(all="ignore")
def prepare(params: Params = Params(), step: ArrayLike = STEP) -> Model:
    """Compute what depends on parameters and step alone.

    Parameters
    ----------
    params : Params
        Physical parameters.
    step : array_like, shape (*batch)
        Time step (s).

    Raises
    ------
    FloatingPointError
        If parameters, step or what follows from them are not finite.
    ValueError
        If the step is not positive, or shapes do not fit.
    VanishingPivotError
        If parameters or step leave a pivot that is not positive.
    """
    step = _array(step, None, "step")
    stiffness = _array(params.stiffness, None, "stiffness")
    damping = _array(params.damping, None, "damping")
    inertia = _array(params.inertia, None, "inertia")
    good = _positive(step)
    numbers: tuple[Any, ...] = (step, stiffness, damping, inertia)
    arrays: tuple[Any, ...] = ()
    batch, dtype = _common(numbers, arrays)
    admittance = np.zeros((STATIONS, *batch), dtype)
    reflection = np.zeros((STATIONS, *batch), dtype)
    transmission = np.zeros((STATIONS, *batch), dtype)

    # factors of the sweep that do not change from step to step
    impedance: Any = 0.0
    joint_impedance = 0.5 * damping * step + 0.25 * (step * step) * stiffness
    for j in reversed(range(STATIONS)):
        impedance = impedance - inertia
        pivot = joint_impedance - impedance
        good = _positive_pivot(good, pivot, "pivot", j)
        admittance[j] = 1.0 / pivot
        transmission[j] = admittance[j] * joint_impedance
        reflection[j] = -admittance[j] * impedance
        impedance = impedance * transmission[j]

    # Factors of the step that depend on the time step and parameters alone
    rate_per_acceleration = 0.5 * step
    angle_per_acceleration = 0.25 * (step * step)

    numbers = (step, stiffness, damping, rate_per_acceleration, angle_per_acceleration, inertia)
    arrays = (admittance, transmission, reflection)
    good = _judged(good, numbers, arrays, "parameters or step are too large or too small for the number type")
    return Model(
        step=_kept(step, good, False),
        stiffness=_kept(stiffness, good, False),
        damping=_kept(damping, good, False),
        rate_per_acceleration=_kept(rate_per_acceleration, good, False),
        angle_per_acceleration=_kept(angle_per_acceleration, good, False),
        admittance=_kept(admittance, good, True),
        transmission=_kept(transmission, good, True),
        reflection=_kept(reflection, good, True),
    )


@np.errstate(all="ignore")
def initialise(
    params: Params = Params(),
    input: Input = Input(),
    *,
    initial_angle: ArrayLike = INITIAL_ANGLE,
    initial_rate: ArrayLike = INITIAL_RATE,
) -> State:
    """Start from given angles and rates with the acceleration that satisfies the equations of motion.

    Parameters
    ----------
    params : Params
        Physical parameters.
    input : Input
        What acts at the initial instant.
    initial_angle : number, or array_like, shape (2, *batch)
        Angles to start from (rad).
    initial_rate : number, or array_like, shape (2, *batch)
        Rates to start from (rad/s).

    Raises
    ------
    FloatingPointError
        If an argument or the state is not finite.
    ValueError
        If shapes do not fit.
    """
    good: Any = True
    tip_torque = _array(input.tip_torque, None, "input tip_torque")
    stiffness = _array(params.stiffness, None, "stiffness")
    damping = _array(params.damping, None, "damping")
    inertia = _array(params.inertia, None, "inertia")
    initial_angle = _array(initial_angle, STATIONS, "initial_angle")
    initial_rate = _array(initial_rate, STATIONS, "initial_rate")
    numbers: tuple[Any, ...] = (tip_torque, stiffness, damping, inertia)
    arrays: tuple[Any, ...] = (initial_angle, initial_rate)
    batch, dtype = _common(numbers, arrays)
    initial_angle = _align(initial_angle, batch)
    initial_rate = _align(initial_rate, batch)
    answer_own = np.zeros((STATIONS, *batch), dtype)
    known_angle = np.zeros((STATIONS + 1, *batch), dtype)
    known_rate = np.zeros((STATIONS + 1, *batch), dtype)

    # what is the same at every station
    impedance = -inertia
    pivot = -impedance
    start_admittance = 1.0 / pivot

    # motion known before the sweep
    known_rate[0] = 0.0
    known_angle[0] = 0.0
    known_rate[1:] = initial_rate
    known_angle[1:] = initial_angle

    # forces of the joints at the motion so far
    joint_torque = damping * (known_rate[1:] - known_rate[:2]) + stiffness * (
        known_angle[1:] - known_angle[:2]
    )

    # sweep inward: force beyond each joint as an affine function of the motion at it
    torque = tip_torque
    for j in reversed(range(STATIONS)):
        answer_own[j] = start_admittance * (torque - joint_torque[j])
        torque = joint_torque[j]

    # the base
    unknown: Any = 0.0

    # sweep outward: the unknown of each station
    unknown = answer_own
    solved = unknown

    # motion at the end of the step
    angle = known_angle[1:]
    rate = known_rate[1:]
    acceleration = solved

    numbers = ()
    arrays = (angle, rate, acceleration)
    good = _judged(good, numbers, arrays, "the motion has outgrown the number type")
    return State(
        angle=_kept(_spread(angle, batch, True), good, True),
        rate=_kept(_spread(rate, batch, True), good, True),
        acceleration=_kept(_spread(acceleration, batch, True), good, True),
    )


@np.errstate(all="ignore")
def step(model: Model, state: State, input: Input = Input()) -> State:
    """Advance the state by one step.

    Parameters
    ----------
    model : Model
        From :func:`prepare`.
    state : State
        At the start of the step; left as it is.
    input : Input
        What acts at the instant in STAGE_INSTANTS.

    Returns
    -------
    State
        At the end of the step.

    Raises
    ------
    FloatingPointError
        If an input or the new state is not finite.
    ValueError
        If shapes do not fit.
    """
    good: Any = True
    tip_torque = _array(input.tip_torque, None, "input tip_torque")
    step = model.step
    stiffness = model.stiffness
    damping = model.damping
    rate_per_acceleration = model.rate_per_acceleration
    angle_per_acceleration = model.angle_per_acceleration
    admittance = np.asarray(model.admittance)
    transmission = np.asarray(model.transmission)
    reflection = np.asarray(model.reflection)
    angle = np.asarray(state.angle)
    rate = np.asarray(state.rate)
    acceleration = np.asarray(state.acceleration)
    numbers: tuple[Any, ...] = (
        tip_torque,
        step,
        stiffness,
        damping,
        rate_per_acceleration,
        angle_per_acceleration,
    )
    arrays: tuple[Any, ...] = (admittance, transmission, reflection, angle, rate, acceleration)
    batch, dtype = _common(numbers, arrays)
    admittance = _align(admittance, batch)
    transmission = _align(transmission, batch)
    reflection = _align(reflection, batch)
    angle = _spread(angle, batch, True)
    rate = _spread(rate, batch, True)
    acceleration = _spread(acceleration, batch, True)
    answer_own = np.zeros((STATIONS, *batch), dtype)
    known_angle = np.zeros((STATIONS + 1, *batch), dtype)
    known_rate = np.zeros((STATIONS + 1, *batch), dtype)
    solved = np.zeros((STATIONS, *batch), dtype)

    # motion known before the sweep
    known_rate[0] = 0.0
    known_angle[0] = 0.0
    known_rate[1:] = rate + acceleration * rate_per_acceleration
    known_angle[1:] = angle + acceleration * angle_per_acceleration + rate * step

    # forces of the joints at the motion so far
    joint_torque = damping * (known_rate[1:] - known_rate[:2]) + stiffness * (
        known_angle[1:] - known_angle[:2]
    )

    # sweep inward: force beyond each joint as an affine function of the motion at it
    torque = tip_torque
    for j in reversed(range(STATIONS)):
        answer_own[j] = admittance[j] * (torque - joint_torque[j])
        torque = joint_torque[j] * reflection[j] + torque * transmission[j]

    # the base
    unknown: Any = 0.0

    # sweep outward: the unknown of each station
    for j in range(STATIONS):
        unknown = answer_own[j] + transmission[j] * unknown
        solved[j] = unknown

    # motion at the end of the step
    angle = known_angle[1:] + angle_per_acceleration * solved
    rate = known_rate[1:] + rate_per_acceleration * solved
    acceleration = solved

    numbers = ()
    arrays = (angle, rate, acceleration)
    good = _judged(good, numbers, arrays, "the motion has outgrown the number type")
    return State(
        angle=_kept(_spread(angle, batch, True), good, True),
        rate=_kept(_spread(rate, batch, True), good, True),
        acceleration=_kept(_spread(acceleration, batch, True), good, True),
    )


@np.errstate(all="ignore")
def output(model: Model, state: State) -> Output:
    """Read the outputs off a state.

    Parameters
    ----------
    model : Model
        From :func:`prepare`.
    state : State
        At the instant of the outputs.
    """
    stiffness = model.stiffness
    damping = model.damping
    angle = np.asarray(state.angle)
    rate = np.asarray(state.rate)
    acceleration = np.asarray(state.acceleration)
    numbers: tuple[Any, ...] = (stiffness, damping)
    arrays: tuple[Any, ...] = (angle, rate, acceleration)
    batch, _ = _common(numbers, arrays)
    angle = _spread(angle, batch, True)
    rate = _spread(rate, batch, True)
    acceleration = _spread(acceleration, batch, True)

    # outputs
    tip = angle[1]
    base_torque = angle[0] * stiffness + damping * rate[0]
    return Output(tip=_spread(tip, batch, False), base_torque=_spread(base_torque, batch, False))


_advance = step  # an argument of simulate has the name


def simulate(
    duration: float,
    inputs: Mapping[str, ArrayLike | Callable[[float], ArrayLike]] | None = None,
    params: Params = Params(),
    step: float = STEP,
    *,
    initial_angle: ArrayLike = INITIAL_ANGLE,
    initial_rate: ArrayLike = INITIAL_RATE,
) -> Result:
    """Simulate from time zero in whole steps.

    Parameters
    ----------
    duration : float
        Time to simulate (s); the last instant is the last whole step within it.
    inputs : mapping from str
        Constants of shape ``(*batch)``, or functions of time (s) that return them; inputs not named are zero.
    params : Params
        Physical parameters.
    step : float
        Time step (s).
    initial_angle : number, or array_like, shape (2, *batch)
        Angles to start from (rad).
    initial_rate : number, or array_like, shape (2, *batch)
        Rates to start from (rad/s).

    Raises
    ------
    FloatingPointError
        If an argument or an input is not finite.
    ValueError
        If shapes do not fit, an input has no such name, or there is no time to simulate.
    VanishingPivotError
        If parameters or step leave a pivot that is not positive.
    """
    if np.ndim(step) != 0 or not step > 0.0:
        raise ValueError(f"step must be one positive number, not {step!r}")
    if not 0.0 <= duration < np.inf:
        raise ValueError(f"duration must be a time, not {duration!r}")
    given = dict(inputs or {})
    if unknown := sorted(set(given) - set(INPUT_NAMES)):
        known = ", ".join(INPUT_NAMES) or "none"
        raise ValueError(f"no input is named {', '.join(unknown)}; there are: {known}")

    def read(time: float) -> Input:
        return Input(**{name: value(time) if callable(value) else value for name, value in given.items()})

    model = prepare(params, step)
    state = initialise(params, read(0.0), initial_angle=initial_angle, initial_rate=initial_rate)
    rows = [output(model, state)]
    times = step * np.arange(int(np.floor(duration / step * (1.0 + 1e-12))) + 1)
    for index, time in enumerate(times[:-1].tolist()):
        instants = STAGE_INSTANTS[min(index, len(STAGE_INSTANTS) - 1)]
        state = _advance(model, state, read(time + instants[0] * step))
        rows.append(output(model, state))
    outputs = {name: _series([getattr(row, name) for row in rows]) for name in OUTPUT_NAMES}
    return Result(times, outputs, state)


def _array(value: ArrayLike, length: int | None, what: str) -> Array:
    """Check what a user gives: a number for each arm if length is None, else an array over stations."""
    array = np.asarray(value)
    if array.dtype.kind in "biu":
        array = array.astype(float)
    if array.dtype.kind not in "fcO":
        raise TypeError(f"{what} must be numeric, not {value!r}")
    if length is not None and array.ndim == 0:
        array = np.full(length, array)
    if length is not None and array.shape[0] != length:
        expected = f"shape ({length}, *batch), or be one number"
        raise ValueError(f"{what} must have {expected}; it has shape {array.shape}")
    finite = _finite(array)
    if array.size and not np.any(finite if length is None else finite.all(axis=0)):
        raise FloatingPointError(f"{what} must be finite, not {value!r}")
    return array


def _finite(value: Any) -> Array:
    """Return which numbers are finite; of numbers that are objects nobody knows."""
    array = np.asarray(value)
    return np.ones(array.shape, dtype=bool) if array.dtype.kind == "O" else np.isfinite(array)


def _positive(step: Array) -> Any:
    """Return for which arms the time step is positive."""
    good = np.asarray(step > 0.0)
    if step.size and not good.any():
        raise ValueError(f"step must be positive, not {step}")
    return good


def _judged(good: Any, numbers: tuple[Any, ...], arrays: tuple[Any, ...], what: str) -> Any:
    """Return which arms are good so far and have only numbers that are finite; leave if there are none."""
    for number in numbers:
        good = good & _finite(number)
    for array in arrays:
        good = good & _finite(array).all(axis=0)
    if np.size(good) and not np.any(good):
        raise FloatingPointError(what)
    return good


def _kept(value: Any, good: Any, stations: bool) -> Array:
    """Return a result with NaN for the arms that are not good."""
    array = np.asarray(value)
    if np.all(good):
        return array
    if stations:
        array = _align(array, np.shape(good))
    return np.where(good, array, array.dtype.type(np.nan))


def _common(numbers: tuple[Any, ...], arrays: tuple[Array, ...]) -> tuple[tuple[int, ...], np.dtype[Any]]:
    """Return the shape of the batch and the number type of everything together."""
    single = [np.asarray(number) for number in numbers]
    shapes = {number.shape for number in single} | {array.shape[1:] for array in arrays}
    types = {array.dtype for array in (*single, *arrays)}
    try:
        batch = shapes.pop() if len(shapes) == 1 else np.broadcast_shapes(*shapes)
    except ValueError:
        raise ValueError(f"batch shapes do not fit together: {sorted(shapes)}") from None
    return batch, types.pop() if len(types) == 1 else np.result_type(*types)


def _align(array: Array, batch: tuple[int, ...]) -> Array:
    """Give an array over stations as many axes behind the first as the batch has."""
    missing = len(batch) + 1 - array.ndim
    return array.reshape(array.shape[0], *(1,) * missing, *array.shape[1:]) if missing else array


def _spread(value: Any, batch: tuple[int, ...], stations: bool) -> Array:
    """Return a number for every arm of the batch, or an array over stations for every arm."""
    array = np.asarray(value)
    if array.shape[stations:] == batch:
        return array
    if stations:
        return np.broadcast_to(_align(array, batch), (array.shape[0], *batch))
    return np.broadcast_to(array, batch)


def _positive_pivot(
    good: Any, pivot: Any, name: str, station: int | None, batch: tuple[int, ...] | None = None
) -> Any:
    """Return which arms are good so far and have a positive pivot; leave if there are none.

    With a batch given, the pivot may be that of all stations.
    """
    positive = np.asarray((pivot > 0.0) & (pivot < np.inf))
    if batch is not None and positive.ndim > len(batch):
        positive = np.all(positive, axis=0)
    good = good & positive
    if np.size(good) and not np.any(good):
        where = "" if station is None else f" of station {station + 1}"
        raise VanishingPivotError(
            f"{name}{where} must be positive and finite, not {pivot}; check parameters and step"
        )
    return good


def _series(values: list[Array]) -> Array:
    """Put values at all instants together; a batch that came with an input counts from the start."""
    shape = values[-1].shape
    return np.stack([np.broadcast_to(value, shape) for value in values])
