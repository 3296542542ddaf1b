# geartrain: Servo with two stages of gears on a table and a feeder
#
# Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 066060c018d378c5aa38f61f583a4ed37c9ee269f8287dfe93f42445474eebe1
# sha256 of the rest of this file: fdf0f9ccc13c0cd5abac002901233db114a3182f5d1b75dbce819e240e0f28ad
#
# model: torsional chain (linear)
# stations: 4
# base: motor
# integrator: Generalised alpha (Chung & Hulbert 1993), rho_inf = 0.8
# sweep: riccati
# unknown: acceleration
# joints in arrays, from 0: coupling 0, belt 1, second 2, shaft 3
# links in arrays, from 0: pinion 0, layshaft 0, feeder 1, wheel 2, table 3
# operations of a step: 159, 39.75 per station (75 additions, 84 multiplications)
# operations of prepare: 75, 18.75 per station (13 additions, 51 multiplications, 11 divisions)
"""geartrain: Servo with two stages of gears on a table and a feeder.

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

STATIONS = 4
"""Number of links."""
STEP = 0.0001
"""Time step of the scene (s)."""
INPUT_NAMES: tuple[str, ...] = ("motor_torque", "load_torque", "feeder_torque")
OUTPUT_NAMES: tuple[str, ...] = (
    "motor_speed",
    "table",
    "table_speed",
    "feeder_speed",
    "coupling_torque",
    "teeth",
)
STAGE_INSTANTS = ((0.5555555555555556,),)
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
    stiffness : array_like, shape (4, *batch)
        Joint stiffness, base to tip (N m/rad).
    damping : array_like, shape (4, *batch)
        Joint damping, base to tip (N m s/rad).
    ratio : array_like, shape (4, *batch)
        Turns of a joint's inner side per turn of its outer one, base to tip.
    inertia : array_like, shape (4, *batch)
        Link inertia, base to tip (kg m^2).
    hub_inertia : array_like, shape (*batch)
        Hub inertia (kg m^2).
    hub_damping : array_like, shape (*batch)
        Viscous damping of the hub to ground (N m s/rad).
    """

    stiffness: ArrayLike = (150.0, 60.0, 60000.0, 2500.0)
    damping: ArrayLike = (0.02, 0.01, 4.0, 0.8)
    ratio: ArrayLike = (1.0, -4.0, 20.0, 1.0)
    inertia: ArrayLike = (0.00027, 0.0008, 0.011, 0.65)
    hub_inertia: ArrayLike = 0.0006
    hub_damping: ArrayLike = 0.001


@dataclass(frozen=True, eq=False)
class Model:
    """What depends on parameters and step alone.

    Attributes
    ----------
    step : array, shape (*batch)
        Time step (s).
    stiffness : array, shape (4, *batch)
        Joint stiffness, base to tip (N m/rad).
    damping : array, shape (4, *batch)
        Joint damping, base to tip (N m s/rad).
    known_rate_per_acceleration : array, shape (*batch)
        5*step/108 (s).
    known_angle_per_acceleration : array, shape (*batch)
        5*step**2/243 (s^2).
    five_ninths_timestep : array, shape (*batch)
        5*step/9 (s).
    unknown_per_known_rate : array, shape (*batch)
        Hub_admittance*hub_damping (s/rad).
    angle_per_acceleration_2 : array, shape (*batch)
        Step**2/27 (s^2).
    angle_per_unknown : array, shape (*batch)
        25*step**2/54 (rad).
    twelfth_timestep : array, shape (*batch)
        Step/12 (s).
    eleven_twelfths_timestep : array, shape (*batch)
        11*step/12 (s).
    teeth_per_angle : array, shape (*batch)
        Stiffness[2]/ratio[2] (N m/rad).
    teeth_per_rate : array, shape (*batch)
        Damping[2]/ratio[2] (N m s/rad).
    turn : array, shape (4, *batch)
        Turns of a joint's outer side per turn of its inner one.
    admittance : array, shape (4, *batch)
        Inverse pivot of each joint.
    transmission : array, shape (4, *batch)
        Share of motion and torque each joint passes on.
    reflection : array, shape (4, *batch)
        Share of its own known torque each joint passes on.
    hub_admittance : array, shape (*batch)
        Inverse pivot of the hub.
    """

    step: Array
    stiffness: Array
    damping: Array
    known_rate_per_acceleration: Array
    known_angle_per_acceleration: Array
    five_ninths_timestep: Array
    unknown_per_known_rate: Array
    angle_per_acceleration_2: Array
    angle_per_unknown: Array
    twelfth_timestep: Array
    eleven_twelfths_timestep: Array
    teeth_per_angle: Array
    teeth_per_rate: Array
    turn: Array
    admittance: Array
    transmission: Array
    reflection: Array
    hub_admittance: Array


@dataclass(frozen=True, eq=False)
class State:
    """Motion at one instant.

    Attributes
    ----------
    hub_angle : array, shape (*batch)
        Hub angle (rad).
    hub_rate : array, shape (*batch)
        Hub rate (rad/s).
    hub_acceleration : array, shape (*batch)
        Hub acceleration (rad/s^2).
    angle : array, shape (4, *batch)
        Angle of each link, base to tip (rad).
    rate : array, shape (4, *batch)
        Rate of each link, base to tip (rad/s).
    acceleration : array, shape (4, *batch)
        Acceleration of each link, base to tip (rad/s^2).
    """

    hub_angle: Array
    hub_rate: Array
    hub_acceleration: Array
    angle: Array
    rate: Array
    acceleration: Array


@dataclass(frozen=True, eq=False)
class Input:
    """What acts on the arm during a step.

    Attributes
    ----------
    motor_torque : array_like, shape (*batch)
        Torque acting at 'servo' (N m).
    load_torque : array_like, shape (*batch)
        Torque acting at 'table' (N m).
    feeder_torque : array_like, shape (*batch)
        Torque acting at 'feeder' (N m).
    """

    motor_torque: ArrayLike = 0.0
    load_torque: ArrayLike = 0.0
    feeder_torque: ArrayLike = 0.0


@dataclass(frozen=True, eq=False)
class Output:
    """What the scene reports.

    Attributes
    ----------
    motor_speed : array, shape (*batch)
        Velocity at 'servo' (rad/s).
    table : array, shape (*batch)
        Angle at 'table' (rad).
    table_speed : array, shape (*batch)
        Velocity at 'table' (rad/s).
    feeder_speed : array, shape (*batch)
        Velocity at 'feeder' (rad/s).
    coupling_torque : array, shape (*batch)
        Torque at 'coupling' (N m).
    teeth : array, shape (*batch)
        Torque at 'second' (N m).
    """

    motor_speed: Array
    table: Array
    table_speed: Array
    feeder_speed: Array
    coupling_torque: Array
    teeth: Array


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
    stiffness = _array(params.stiffness, STATIONS, "stiffness")
    damping = _array(params.damping, STATIONS, "damping")
    ratio = _array(params.ratio, STATIONS, "ratio")
    inertia = _array(params.inertia, STATIONS, "inertia")
    hub_inertia = _array(params.hub_inertia, None, "hub_inertia")
    hub_damping = _array(params.hub_damping, None, "hub_damping")
    good = _positive(step)
    numbers: tuple[Any, ...] = (step, hub_inertia, hub_damping)
    arrays: tuple[Any, ...] = (stiffness, damping, ratio, inertia)
    batch, dtype = _common(numbers, arrays)
    stiffness = _align(stiffness, batch)
    damping = _align(damping, batch)
    ratio = _align(ratio, batch)
    inertia = _align(inertia, batch)
    admittance = np.zeros((STATIONS, *batch), dtype)
    reflection = np.zeros((STATIONS, *batch), dtype)
    transmission = np.zeros((STATIONS, *batch), dtype)

    # how gears turn
    turn = 1.0 / ratio

    # factors of the sweep that do not change from step to step
    for j in reversed(range(3, STATIONS)):
        impedance = -inertia[j]
        joint_impedance = (55.0 / 108.0) * damping[j] * step + (125.0 / 486.0) * (step * step) * stiffness[j]
        pivot = joint_impedance - impedance
        good = _positive_pivot(good, pivot, "pivot", j)
        admittance[j] = 1.0 / pivot
        transmission[j] = admittance[j] * joint_impedance
        reflection[j] = -admittance[j] * impedance
        impedance = impedance * transmission[j]
    for j in reversed(range(2, 3)):
        impedance = impedance - inertia[j]
        joint_impedance = (55.0 / 108.0) * damping[j] * step + (125.0 / 486.0) * (step * step) * stiffness[j]
        pivot = joint_impedance - impedance
        good = _positive_pivot(good, pivot, "pivot", j)
        admittance[j] = 1.0 / pivot
        transmission[j] = admittance[j] * joint_impedance * turn[j]
        reflection[j] = -admittance[j] * impedance * turn[j]
        impedance = impedance * transmission[j] * turn[j]
    impedance_of_branch_3 = impedance
    for j in reversed(range(1, 2)):
        impedance = -inertia[j]
        joint_impedance = (55.0 / 108.0) * damping[j] * step + (125.0 / 486.0) * (step * step) * stiffness[j]
        pivot = joint_impedance - impedance
        good = _positive_pivot(good, pivot, "pivot", j)
        admittance[j] = 1.0 / pivot
        transmission[j] = admittance[j] * joint_impedance * turn[j]
        reflection[j] = -admittance[j] * impedance * turn[j]
        impedance = impedance * transmission[j] * turn[j]
    impedance = impedance + impedance_of_branch_3
    for j in reversed(range(1)):
        impedance = impedance - inertia[j]
        joint_impedance = (55.0 / 108.0) * damping[j] * step + (125.0 / 486.0) * (step * step) * stiffness[j]
        pivot = joint_impedance - impedance
        good = _positive_pivot(good, pivot, "pivot", j)
        admittance[j] = 1.0 / pivot
        transmission[j] = admittance[j] * joint_impedance
        reflection[j] = -admittance[j] * impedance
        impedance = impedance * transmission[j]
    hub_impedance = hub_inertia + (55.0 / 108.0) * hub_damping * step
    hub_pivot = hub_impedance - impedance
    good = _positive_pivot(good, hub_pivot, "hub_pivot", None)
    hub_admittance = 1.0 / hub_pivot

    # Factors of the step that depend on the time step and parameters alone
    known_rate_per_acceleration = (5.0 / 108.0) * step
    known_angle_per_acceleration = (5.0 / 243.0) * (step * step)
    five_ninths_timestep = (5.0 / 9.0) * step
    unknown_per_known_rate = hub_admittance * hub_damping
    angle_per_acceleration_2 = (1.0 / 27.0) * (step * step)
    angle_per_unknown = (25.0 / 54.0) * (step * step)
    twelfth_timestep = (1.0 / 12.0) * step
    eleven_twelfths_timestep = (11.0 / 12.0) * step
    teeth_per_angle = stiffness[2] / ratio[2]
    teeth_per_rate = damping[2] / ratio[2]

    numbers = (
        step,
        known_rate_per_acceleration,
        known_angle_per_acceleration,
        five_ninths_timestep,
        unknown_per_known_rate,
        angle_per_acceleration_2,
        angle_per_unknown,
        twelfth_timestep,
        eleven_twelfths_timestep,
        teeth_per_angle,
        teeth_per_rate,
        hub_admittance,
        hub_inertia,
        hub_damping,
    )
    arrays = (stiffness, damping, turn, admittance, transmission, reflection, ratio, inertia)
    good = _judged(good, numbers, arrays, "parameters or step are too large or too small for the number type")
    return Model(
        step=_kept(step, good, False),
        stiffness=_kept(stiffness, good, True),
        damping=_kept(damping, good, True),
        known_rate_per_acceleration=_kept(known_rate_per_acceleration, good, False),
        known_angle_per_acceleration=_kept(known_angle_per_acceleration, good, False),
        five_ninths_timestep=_kept(five_ninths_timestep, good, False),
        unknown_per_known_rate=_kept(unknown_per_known_rate, good, False),
        angle_per_acceleration_2=_kept(angle_per_acceleration_2, good, False),
        angle_per_unknown=_kept(angle_per_unknown, good, False),
        twelfth_timestep=_kept(twelfth_timestep, good, False),
        eleven_twelfths_timestep=_kept(eleven_twelfths_timestep, good, False),
        teeth_per_angle=_kept(teeth_per_angle, good, False),
        teeth_per_rate=_kept(teeth_per_rate, good, False),
        turn=_kept(turn, good, True),
        admittance=_kept(admittance, good, True),
        transmission=_kept(transmission, good, True),
        reflection=_kept(reflection, good, True),
        hub_admittance=_kept(hub_admittance, good, False),
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
    initial_angle : number, or array_like, shape (4, *batch)
        Angles to start from (rad).
    initial_rate : number, or array_like, shape (4, *batch)
        Rates to start from (rad/s).

    Raises
    ------
    FloatingPointError
        If an argument or the state is not finite.
    ValueError
        If shapes do not fit.
    VanishingPivotError
        If parameters leave a pivot that is not positive.
    """
    good: Any = True
    motor_torque = _array(input.motor_torque, None, "input motor_torque")
    load_torque_ = _array(input.load_torque, None, "input load_torque")
    feeder_torque = _array(input.feeder_torque, None, "input feeder_torque")
    stiffness = _array(params.stiffness, STATIONS, "stiffness")
    damping = _array(params.damping, STATIONS, "damping")
    ratio = _array(params.ratio, STATIONS, "ratio")
    inertia = _array(params.inertia, STATIONS, "inertia")
    hub_inertia = _array(params.hub_inertia, None, "hub_inertia")
    hub_damping = _array(params.hub_damping, None, "hub_damping")
    initial_angle = _array(initial_angle, STATIONS, "initial_angle")
    initial_rate = _array(initial_rate, STATIONS, "initial_rate")
    numbers: tuple[Any, ...] = (motor_torque, load_torque_, feeder_torque, hub_inertia, hub_damping)
    arrays: tuple[Any, ...] = (stiffness, damping, ratio, inertia, initial_angle, initial_rate)
    batch, dtype = _common(numbers, arrays)
    stiffness = _align(stiffness, batch)
    damping = _align(damping, batch)
    ratio = _align(ratio, batch)
    inertia = _align(inertia, batch)
    initial_angle = _align(initial_angle, batch)
    initial_rate = _align(initial_rate, batch)
    answer_own = np.zeros((STATIONS, *batch), dtype)
    joint_torque = np.zeros((STATIONS, *batch), dtype)
    known_angle = np.zeros((STATIONS + 1, *batch), dtype)
    known_rate = np.zeros((STATIONS + 1, *batch), dtype)
    load_torque = np.zeros((STATIONS, *batch), dtype)
    solved = np.zeros((STATIONS, *batch), dtype)

    # how gears turn
    start_turn = 1.0 / ratio

    # motion known before the sweep
    known_rate[0] = 0.0
    known_angle[0] = 0.0
    known_rate[1:] = initial_rate
    known_angle[1:] = initial_angle

    # forces of the joints at the motion so far
    joint_torque[:1] = damping[:1] * (known_rate[1:2] - known_rate[:1]) + stiffness[:1] * (
        known_angle[1:2] - known_angle[:1]
    )
    joint_torque[1:2] = (
        damping[1:2] * known_rate[2:3]
        + known_angle[2:3] * stiffness[1:2]
        - damping[1:2] * known_rate[1:2] * start_turn[1:2]
        - known_angle[1:2] * start_turn[1:2] * stiffness[1:2]
    )
    joint_torque[2:3] = (
        damping[2:3] * known_rate[3:4]
        + known_angle[3:4] * stiffness[2:3]
        - damping[2:3] * known_rate[1] * start_turn[2:3]
        - known_angle[1] * start_turn[2:3] * stiffness[2:3]
    )
    joint_torque[3:] = damping[3:] * (known_rate[4:] - known_rate[3:4]) + stiffness[3:] * (
        known_angle[4:] - known_angle[3:4]
    )

    # sweep inward: force beyond each joint as an affine function of the motion at it
    load_torque[:] = 0.0
    load_torque[1] = feeder_torque
    torque = load_torque_
    for j in reversed(range(3, STATIONS)):
        torque = load_torque[j] + torque
        impedance = -inertia[j]
        pivot = -impedance
        good = _positive_pivot(good, pivot, "pivot", j)
        start_admittance = 1.0 / pivot
        answer_own[j] = start_admittance * (torque - joint_torque[j])
        torque = joint_torque[j]
    for j in reversed(range(2, 3)):
        torque = load_torque[j] + torque
        impedance = -inertia[j]
        pivot = -impedance
        good = _positive_pivot(good, pivot, "pivot", j)
        start_admittance = 1.0 / pivot
        answer_own[j] = start_admittance * (torque - joint_torque[j])
        torque = joint_torque[j] * start_turn[j]
    torque_of_branch_3 = torque
    for j in reversed(range(1, 2)):
        torque = load_torque[j]
        impedance = -inertia[j]
        pivot = -impedance
        good = _positive_pivot(good, pivot, "pivot", j)
        start_admittance = 1.0 / pivot
        answer_own[j] = start_admittance * (torque - joint_torque[j])
        torque = joint_torque[j] * start_turn[j]
    torque = torque + torque_of_branch_3
    for j in reversed(range(1)):
        torque = load_torque[j] + torque
        impedance = -inertia[j]
        pivot = -impedance
        good = _positive_pivot(good, pivot, "pivot", j)
        start_admittance = 1.0 / pivot
        answer_own[j] = start_admittance * (torque - joint_torque[j])
        torque = joint_torque[j]

    # the base
    hub_pivot = hub_inertia
    good = _positive_pivot(good, hub_pivot, "hub_pivot", None)
    start_hub_admittance = 1.0 / hub_pivot
    unknown = start_hub_admittance * (motor_torque + torque - hub_damping * known_rate[0])
    hub_unknown = unknown

    # sweep outward: the unknown of each station
    unknown = answer_own[:2]
    solved[:2] = unknown
    unknown = np.copy(solved[0])
    unknown = answer_own[2:]
    solved[2:] = unknown

    # motion at the end of the step
    hub_angle = known_angle[0]
    hub_rate = known_rate[0]
    hub_acceleration = hub_unknown
    angle = known_angle[1:]
    rate = known_rate[1:]
    acceleration = solved

    numbers = (hub_angle, hub_rate, hub_acceleration)
    arrays = (angle, rate, acceleration)
    good = _judged(good, numbers, arrays, "the motion has outgrown the number type")
    return State(
        hub_angle=_kept(_spread(hub_angle, batch, False), good, False),
        hub_rate=_kept(_spread(hub_rate, batch, False), good, False),
        hub_acceleration=_kept(_spread(hub_acceleration, batch, False), good, False),
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
    motor_torque = _array(input.motor_torque, None, "input motor_torque")
    load_torque_ = _array(input.load_torque, None, "input load_torque")
    feeder_torque = _array(input.feeder_torque, None, "input feeder_torque")
    step = model.step
    stiffness = np.asarray(model.stiffness)
    damping = np.asarray(model.damping)
    known_rate_per_acceleration = model.known_rate_per_acceleration
    known_angle_per_acceleration = model.known_angle_per_acceleration
    five_ninths_timestep = model.five_ninths_timestep
    unknown_per_known_rate = model.unknown_per_known_rate
    angle_per_acceleration_2 = model.angle_per_acceleration_2
    angle_per_unknown = model.angle_per_unknown
    twelfth_timestep = model.twelfth_timestep
    eleven_twelfths_timestep = model.eleven_twelfths_timestep
    turn = np.asarray(model.turn)
    admittance = np.asarray(model.admittance)
    transmission = np.asarray(model.transmission)
    reflection = np.asarray(model.reflection)
    hub_admittance = model.hub_admittance
    hub_angle = state.hub_angle
    hub_rate = state.hub_rate
    hub_acceleration = state.hub_acceleration
    angle = np.asarray(state.angle)
    rate = np.asarray(state.rate)
    acceleration = np.asarray(state.acceleration)
    numbers: tuple[Any, ...] = (
        motor_torque,
        load_torque_,
        feeder_torque,
        step,
        known_rate_per_acceleration,
        known_angle_per_acceleration,
        five_ninths_timestep,
        unknown_per_known_rate,
        angle_per_acceleration_2,
        angle_per_unknown,
        twelfth_timestep,
        eleven_twelfths_timestep,
        hub_admittance,
        hub_angle,
        hub_rate,
        hub_acceleration,
    )
    arrays: tuple[Any, ...] = (
        stiffness,
        damping,
        turn,
        admittance,
        transmission,
        reflection,
        angle,
        rate,
        acceleration,
    )
    batch, dtype = _common(numbers, arrays)
    stiffness = _align(stiffness, batch)
    damping = _align(damping, batch)
    turn = _align(turn, batch)
    admittance = _align(admittance, batch)
    transmission = _align(transmission, batch)
    reflection = _align(reflection, batch)
    hub_angle = _spread(hub_angle, batch, False)
    hub_rate = _spread(hub_rate, batch, False)
    hub_acceleration = _spread(hub_acceleration, batch, False)
    angle = _spread(angle, batch, True)
    rate = _spread(rate, batch, True)
    acceleration = _spread(acceleration, batch, True)
    answer_own = np.zeros((STATIONS, *batch), dtype)
    joint_torque = np.zeros((STATIONS, *batch), dtype)
    known_angle = np.zeros((STATIONS + 1, *batch), dtype)
    known_rate = np.zeros((STATIONS + 1, *batch), dtype)
    load_torque = np.zeros((STATIONS, *batch), dtype)
    solved = np.zeros((STATIONS, *batch), dtype)

    # motion known before the sweep
    known_rate[0] = hub_rate + hub_acceleration * known_rate_per_acceleration
    known_angle[0] = (
        hub_angle + five_ninths_timestep * hub_rate + hub_acceleration * known_angle_per_acceleration
    )
    known_rate[1:] = rate + acceleration * known_rate_per_acceleration
    known_angle[1:] = angle + acceleration * known_angle_per_acceleration + five_ninths_timestep * rate

    # forces of the joints at the motion so far
    joint_torque[:1] = damping[:1] * (known_rate[1:2] - known_rate[:1]) + stiffness[:1] * (
        known_angle[1:2] - known_angle[:1]
    )
    joint_torque[1:2] = (
        damping[1:2] * known_rate[2:3]
        + known_angle[2:3] * stiffness[1:2]
        - damping[1:2] * known_rate[1:2] * turn[1:2]
        - known_angle[1:2] * stiffness[1:2] * turn[1:2]
    )
    joint_torque[2:3] = (
        damping[2:3] * known_rate[3:4]
        + known_angle[3:4] * stiffness[2:3]
        - damping[2:3] * known_rate[1] * turn[2:3]
        - known_angle[1] * stiffness[2:3] * turn[2:3]
    )
    joint_torque[3:] = damping[3:] * (known_rate[4:] - known_rate[3:4]) + stiffness[3:] * (
        known_angle[4:] - known_angle[3:4]
    )

    # sweep inward: force beyond each joint as an affine function of the motion at it
    load_torque[:] = 0.0
    load_torque[1] = feeder_torque
    torque = load_torque_
    for j in reversed(range(2, STATIONS)):
        torque = load_torque[j] + torque
        answer_own[j] = admittance[j] * (torque - joint_torque[j])
        torque = joint_torque[j] * reflection[j] + torque * transmission[j]
    torque_of_branch_3 = torque
    for j in reversed(range(1, 2)):
        torque = load_torque[j]
        answer_own[j] = admittance[j] * (torque - joint_torque[j])
        torque = joint_torque[j] * reflection[j] + torque * transmission[j]
    torque = torque + torque_of_branch_3
    for j in reversed(range(1)):
        torque = load_torque[j] + torque
        answer_own[j] = admittance[j] * (torque - joint_torque[j])
        torque = joint_torque[j] * reflection[j] + torque * transmission[j]

    # the base
    unknown = hub_admittance * (motor_torque + torque) - known_rate[0] * unknown_per_known_rate
    hub_unknown = unknown

    # sweep outward: the unknown of each station
    for j in range(2):
        unknown = answer_own[j] + transmission[j] * unknown
        solved[j] = unknown
    unknown = np.copy(solved[0])
    for j in range(2, STATIONS):
        unknown = answer_own[j] + transmission[j] * unknown
        solved[j] = unknown

    # motion at the end of the step
    hub_angle = (
        hub_angle
        + angle_per_acceleration_2 * hub_acceleration
        + angle_per_unknown * hub_unknown
        + hub_rate * step
    )
    hub_rate = hub_rate + eleven_twelfths_timestep * hub_unknown + hub_acceleration * twelfth_timestep
    hub_acceleration = 1.5 * hub_unknown - 0.5 * hub_acceleration
    angle = angle + acceleration * angle_per_acceleration_2 + angle_per_unknown * solved + rate * step
    rate = rate + acceleration * twelfth_timestep + eleven_twelfths_timestep * solved
    acceleration = 1.5 * solved - 0.5 * acceleration

    numbers = (hub_angle, hub_rate, hub_acceleration)
    arrays = (angle, rate, acceleration)
    good = _judged(good, numbers, arrays, "the motion has outgrown the number type")
    return State(
        hub_angle=_kept(_spread(hub_angle, batch, False), good, False),
        hub_rate=_kept(_spread(hub_rate, batch, False), good, False),
        hub_acceleration=_kept(_spread(hub_acceleration, batch, False), good, False),
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
    stiffness = np.asarray(model.stiffness)
    damping = np.asarray(model.damping)
    teeth_per_angle = model.teeth_per_angle
    teeth_per_rate = model.teeth_per_rate
    hub_angle = state.hub_angle
    hub_rate = state.hub_rate
    hub_acceleration = state.hub_acceleration
    angle = np.asarray(state.angle)
    rate = np.asarray(state.rate)
    acceleration = np.asarray(state.acceleration)
    numbers: tuple[Any, ...] = (teeth_per_angle, teeth_per_rate, hub_angle, hub_rate, hub_acceleration)
    arrays: tuple[Any, ...] = (stiffness, damping, angle, rate, acceleration)
    batch, _ = _common(numbers, arrays)
    stiffness = _align(stiffness, batch)
    damping = _align(damping, batch)
    hub_angle = _spread(hub_angle, batch, False)
    hub_rate = _spread(hub_rate, batch, False)
    hub_acceleration = _spread(hub_acceleration, batch, False)
    angle = _spread(angle, batch, True)
    rate = _spread(rate, batch, True)
    acceleration = _spread(acceleration, batch, True)

    # outputs
    motor_speed = hub_rate
    table = angle[3]
    table_speed = rate[3]
    feeder_speed = rate[1]
    coupling_torque = damping[0] * (hub_rate - rate[0]) + stiffness[0] * (hub_angle - angle[0])
    teeth = (
        angle[0] * teeth_per_angle - angle[2] * stiffness[2] - damping[2] * rate[2] + rate[0] * teeth_per_rate
    )
    return Output(
        motor_speed=_spread(motor_speed, batch, False),
        table=_spread(table, batch, False),
        table_speed=_spread(table_speed, batch, False),
        feeder_speed=_spread(feeder_speed, batch, False),
        coupling_torque=_spread(coupling_torque, batch, False),
        teeth=_spread(teeth, batch, False),
    )


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
    initial_angle : number, or array_like, shape (4, *batch)
        Angles to start from (rad).
    initial_rate : number, or array_like, shape (4, *batch)
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
