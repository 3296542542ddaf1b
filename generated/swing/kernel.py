# swing: Flexible arm swung by one radian
#
# Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: c9c08efbdc9f2f1b1ddadadab522649e5100f98e9cdabe31fcf56b416283c60f
# sha256 of the rest of this file: 3506c9fb907e28b46f75a0d4410a0e695c99fa186c18fa287d6ad096eb893047
#
# model: planar arm, large rotations, tip mass
# stations: 5
# base: motor
# integrator: Newmark 1959, beta = 0.25, gamma = 0.5
# linearisation: newton
# sweep: riccati
# unknown: acceleration
# operations of a step: 595, 119 per station (275 additions, 304 multiplications, 6 divisions, 10 sines and
#     cosines)
# operations of prepare: 47, 9.4 per station (10 additions, 37 multiplications)
"""swing: Flexible arm swung by one radian.

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

STATIONS = 5
"""Number of links."""
STEP = 0.005
"""Time step of the scene (s)."""
INPUT_NAMES: tuple[str, ...] = ("hub_torque",)
OUTPUT_NAMES: tuple[str, ...] = ("tip_x", "tip_y", "hub")
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
    length : array_like, shape (*batch)
        Link length, the same everywhere (m).
    mass : array_like, shape (*batch)
        Link mass, the same everywhere (kg).
    inertia : array_like, shape (*batch)
        Link inertia about its centre of mass, the same everywhere (kg m^2).
    center : array_like, shape (*batch)
        Centre of mass along the link, 0 to 1, the same everywhere.
    stiffness : array_like, shape (5, *batch)
        Joint stiffness, base to tip (N m/rad).
    damping : array_like, shape (5, *batch)
        Joint damping, base to tip (N m s/rad).
    hub_inertia : array_like, shape (*batch)
        Hub inertia (kg m^2).
    hub_damping : array_like, shape (*batch)
        Viscous damping of the hub to ground (N m s/rad).
    tip_mass : array_like, shape (*batch)
        Mass at the tip (kg).
    """

    length: ArrayLike = 0.2
    mass: ArrayLike = 0.08
    inertia: ArrayLike = 0.0002666666666666667
    center: ArrayLike = 0.5
    stiffness: ArrayLike = (120.0, 60.0, 60.0, 60.0, 60.0)
    damping: ArrayLike = (0.18, 0.09, 0.09, 0.09, 0.09)
    hub_inertia: ArrayLike = 0.05
    hub_damping: ArrayLike = 0.02
    tip_mass: ArrayLike = 0.1


@dataclass(frozen=True, eq=False)
class Model:
    """What depends on parameters and step alone.

    Attributes
    ----------
    step : array, shape (*batch)
        Time step (s).
    length : array, shape (*batch)
        Link length, the same everywhere (m).
    mass : array, shape (*batch)
        Link mass, the same everywhere (kg).
    stiffness : array, shape (5, *batch)
        Joint stiffness, base to tip (N m/rad).
    damping : array, shape (5, *batch)
        Joint damping, base to tip (N m s/rad).
    hub_inertia : array, shape (*batch)
        Hub inertia (kg m^2).
    hub_damping : array, shape (*batch)
        Viscous damping of the hub to ground (N m s/rad).
    half_step_squared : array, shape (*batch)
        Step**2/2 (s^2).
    angle_per_acceleration : array, shape (*batch)
        Angle per unit of acceleration: step**2/4 (s^2).
    rate_per_acceleration : array, shape (*batch)
        Rate per unit of acceleration: step/2 (s).
    end_mass : array, shape (*batch)
        Mass at the tip less the share of a link beyond it (kg).
    rod_inertia : array, shape (*batch)
        Inertia of a link that masses at its ends leave over (kg m^2).
    joint_impedance : array, shape (5, *batch)
        Torque of a joint per difference of unknowns (kg m^2).
    hub_impedance : array, shape (*batch)
        Torque of the hub per unknown (kg m^2).
    """

    step: Array
    length: Array
    mass: Array
    stiffness: Array
    damping: Array
    hub_inertia: Array
    hub_damping: Array
    half_step_squared: Array
    angle_per_acceleration: Array
    rate_per_acceleration: Array
    end_mass: Array
    rod_inertia: Array
    joint_impedance: Array
    hub_impedance: Array


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
    angle : array, shape (5, *batch)
        Angle of each link, base to tip (rad).
    rate : array, shape (5, *batch)
        Rate of each link, base to tip (rad/s).
    acceleration : array, shape (5, *batch)
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
    hub_torque : array_like, shape (*batch)
        Torque acting at the base (N m).
    """

    hub_torque: ArrayLike = 0.0


@dataclass(frozen=True, eq=False)
class Output:
    """What the scene reports.

    Attributes
    ----------
    tip_x : array, shape (*batch)
        Position at the tip, x (m).
    tip_y : array, shape (*batch)
        Position at the tip, y (m).
    hub : array, shape (*batch)
        Angle at the base (rad).
    """

    tip_x: Array
    tip_y: Array
    hub: Array


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
    length = _array(params.length, None, "length")
    mass = _array(params.mass, None, "mass")
    inertia = _array(params.inertia, None, "inertia")
    center = _array(params.center, None, "center")
    stiffness = _array(params.stiffness, STATIONS, "stiffness")
    damping = _array(params.damping, STATIONS, "damping")
    hub_inertia = _array(params.hub_inertia, None, "hub_inertia")
    hub_damping = _array(params.hub_damping, None, "hub_damping")
    tip_mass = _array(params.tip_mass, None, "tip_mass")
    good = _positive(step)
    numbers: tuple[Any, ...] = (step, length, mass, inertia, center, hub_inertia, hub_damping, tip_mass)
    arrays: tuple[Any, ...] = (stiffness, damping)
    batch, _ = _common(numbers, arrays)
    stiffness = _align(stiffness, batch)
    damping = _align(damping, batch)

    # masses at the nodes between links, and what they leave over
    end_mass = tip_mass - mass * (1.0 - center)
    rod_inertia = inertia - center * (length * length) * mass * (1.0 - center)

    # factors of the sweep that do not change from step to step
    joint_impedance = 0.5 * damping * step + 0.25 * (step * step) * stiffness
    hub_impedance = hub_inertia + 0.5 * hub_damping * step

    # Factors of the step that depend on the time step and parameters alone
    half_step_squared = 0.5 * (step * step)
    angle_per_acceleration = 0.25 * (step * step)
    rate_per_acceleration = 0.5 * step

    numbers = (
        step,
        length,
        mass,
        hub_inertia,
        hub_damping,
        half_step_squared,
        angle_per_acceleration,
        rate_per_acceleration,
        end_mass,
        rod_inertia,
        hub_impedance,
        inertia,
        center,
        tip_mass,
    )
    arrays = (stiffness, damping, joint_impedance)
    good = _judged(good, numbers, arrays, "parameters or step are too large or too small for the number type")
    return Model(
        step=_kept(step, good, False),
        length=_kept(length, good, False),
        mass=_kept(mass, good, False),
        stiffness=_kept(stiffness, good, True),
        damping=_kept(damping, good, True),
        hub_inertia=_kept(hub_inertia, good, False),
        hub_damping=_kept(hub_damping, good, False),
        half_step_squared=_kept(half_step_squared, good, False),
        angle_per_acceleration=_kept(angle_per_acceleration, good, False),
        rate_per_acceleration=_kept(rate_per_acceleration, good, False),
        end_mass=_kept(end_mass, good, False),
        rod_inertia=_kept(rod_inertia, good, False),
        joint_impedance=_kept(joint_impedance, good, True),
        hub_impedance=_kept(hub_impedance, good, False),
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
    initial_angle : number, or array_like, shape (5, *batch)
        Angles to start from (rad).
    initial_rate : number, or array_like, shape (5, *batch)
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
    hub_torque = _array(input.hub_torque, None, "input hub_torque")
    length = _array(params.length, None, "length")
    mass = _array(params.mass, None, "mass")
    inertia = _array(params.inertia, None, "inertia")
    center = _array(params.center, None, "center")
    stiffness = _array(params.stiffness, STATIONS, "stiffness")
    damping = _array(params.damping, STATIONS, "damping")
    hub_inertia = _array(params.hub_inertia, None, "hub_inertia")
    hub_damping = _array(params.hub_damping, None, "hub_damping")
    tip_mass = _array(params.tip_mass, None, "tip_mass")
    initial_angle = _array(initial_angle, STATIONS, "initial_angle")
    initial_rate = _array(initial_rate, STATIONS, "initial_rate")
    numbers: tuple[Any, ...] = (hub_torque, length, mass, inertia, center, hub_inertia, hub_damping, tip_mass)
    arrays: tuple[Any, ...] = (stiffness, damping, initial_angle, initial_rate)
    batch, dtype = _common(numbers, arrays)
    stiffness = _align(stiffness, batch)
    damping = _align(damping, batch)
    initial_angle = _align(initial_angle, batch)
    initial_rate = _align(initial_rate, batch)
    acceleration_x = np.zeros((STATIONS + 1, *batch), dtype)
    acceleration_y = np.zeros((STATIONS + 1, *batch), dtype)
    answer_own = np.zeros((STATIONS, *batch), dtype)
    answer_x = np.zeros((STATIONS, *batch), dtype)
    answer_y = np.zeros((STATIONS, *batch), dtype)
    predicted_acceleration = np.zeros((STATIONS + 1, *batch), dtype)
    predicted_angle = np.zeros((STATIONS + 1, *batch), dtype)
    predicted_rate = np.zeros((STATIONS + 1, *batch), dtype)
    solved = np.zeros((STATIONS, *batch), dtype)

    # masses at the nodes between links, and what they leave over
    start_end_mass = tip_mass - mass * (1.0 - center)
    start_rod_inertia = inertia - center * (length * length) * mass * (1.0 - center)

    # what is the same at every station
    hub_pivot = hub_inertia
    good = _positive_pivot(good, hub_pivot, "hub_pivot", None)

    # predicted motion
    predicted_rate[0] = 0.0
    predicted_angle[0] = 0.0
    predicted_acceleration[0] = 0.0
    predicted_rate[1:] = initial_rate
    predicted_angle[1:] = initial_angle
    predicted_acceleration[1:] = 0.0

    # accelerations of the nodes
    lever_cosine = length * np.cos(predicted_angle[1:])
    lever_sine = length * np.sin(predicted_angle[1:])
    square = predicted_rate[1:] * predicted_rate[1:]
    relative_x = -lever_cosine * square - lever_sine * predicted_acceleration[1:]
    relative_y = lever_cosine * predicted_acceleration[1:] - lever_sine * square
    node_x: Any = 0.0
    node_y: Any = 0.0
    acceleration_x[0] = node_x
    acceleration_y[0] = node_y
    for j in range(STATIONS):
        node_x = node_x + relative_x[j]
        node_y = node_y + relative_y[j]
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y

    # forces of the joints at the motion so far
    joint_torque = damping * (predicted_rate[:5] - predicted_rate[1:]) + stiffness * (
        predicted_angle[:5] - predicted_angle[1:]
    )

    # sweep inward: force beyond each joint as an affine function of the motion at it
    impedance_xx = start_end_mass
    impedance_xy: Any = 0.0
    impedance_yx: Any = 0.0
    impedance_yy = start_end_mass
    force_x = acceleration_x[5] * start_end_mass
    force_y = acceleration_y[5] * start_end_mass
    torque: Any = 0.0
    for j in reversed(range(STATIONS)):
        impedance_xx = impedance_xx + mass
        force_x = force_x + acceleration_x[j + 1] * mass
        impedance_yy = impedance_yy + mass
        force_y = force_y + acceleration_y[j + 1] * mass
        impedance_xu = impedance_xy * lever_cosine[j] - impedance_xx * lever_sine[j]
        impedance_yu = impedance_yy * lever_cosine[j] - impedance_yx * lever_sine[j]
        impedance_ux = impedance_yx * lever_cosine[j] - impedance_xx * lever_sine[j]
        impedance_uy = impedance_yy * lever_cosine[j] - impedance_xy * lever_sine[j]
        impedance_uu = start_rod_inertia - impedance_xu * lever_sine[j] + impedance_yu * lever_cosine[j]
        torque = (
            torque
            - force_x * lever_sine[j]
            + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * start_rod_inertia
        )
        pivot = impedance_uu
        good = _positive_pivot(good, pivot, "pivot", j)
        admittance = 1.0 / pivot
        answer_own[j] = admittance * (joint_torque[j] - torque)
        answer_x[j] = admittance * impedance_ux
        answer_y[j] = admittance * impedance_uy
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu
        force_x = force_x + answer_own[j] * impedance_xu
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu
        force_y = force_y + answer_own[j] * impedance_yu
        torque = joint_torque[j]

    # the base
    unknown = (
        hub_torque - torque - hub_damping * predicted_rate[0] - hub_inertia * predicted_acceleration[0]
    ) / hub_pivot
    hub_unknown = unknown

    # sweep outward: the unknown of each station
    change_x: Any = 0.0
    change_y: Any = 0.0
    for j in range(STATIONS):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y
        change_x = change_x - lever_sine[j] * unknown
        change_y = change_y + lever_cosine[j] * unknown
        solved[j] = unknown

    # motion at the end of the step
    hub_angle = predicted_angle[0]
    hub_rate = predicted_rate[0]
    hub_acceleration = hub_unknown + predicted_acceleration[0]
    angle = predicted_angle[1:]
    rate = predicted_rate[1:]
    acceleration = predicted_acceleration[1:] + solved

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
    VanishingPivotError
        If the motion, parameters or step leave a pivot that is not positive.
    """
    good: Any = True
    hub_torque = _array(input.hub_torque, None, "input hub_torque")
    step = model.step
    length = model.length
    mass = model.mass
    stiffness = np.asarray(model.stiffness)
    damping = np.asarray(model.damping)
    hub_inertia = model.hub_inertia
    hub_damping = model.hub_damping
    half_step_squared = model.half_step_squared
    angle_per_acceleration = model.angle_per_acceleration
    rate_per_acceleration = model.rate_per_acceleration
    end_mass = model.end_mass
    rod_inertia = model.rod_inertia
    joint_impedance = np.asarray(model.joint_impedance)
    hub_impedance = model.hub_impedance
    hub_angle = state.hub_angle
    hub_rate = state.hub_rate
    hub_acceleration = state.hub_acceleration
    angle = np.asarray(state.angle)
    rate = np.asarray(state.rate)
    acceleration = np.asarray(state.acceleration)
    numbers: tuple[Any, ...] = (
        hub_torque,
        step,
        length,
        mass,
        hub_inertia,
        hub_damping,
        half_step_squared,
        angle_per_acceleration,
        rate_per_acceleration,
        end_mass,
        rod_inertia,
        hub_impedance,
        hub_angle,
        hub_rate,
        hub_acceleration,
    )
    arrays: tuple[Any, ...] = (stiffness, damping, joint_impedance, angle, rate, acceleration)
    batch, dtype = _common(numbers, arrays)
    stiffness = _align(stiffness, batch)
    damping = _align(damping, batch)
    joint_impedance = _align(joint_impedance, batch)
    hub_angle = _spread(hub_angle, batch, False)
    hub_rate = _spread(hub_rate, batch, False)
    hub_acceleration = _spread(hub_acceleration, batch, False)
    angle = _spread(angle, batch, True)
    rate = _spread(rate, batch, True)
    acceleration = _spread(acceleration, batch, True)
    acceleration_x = np.zeros((STATIONS + 1, *batch), dtype)
    acceleration_y = np.zeros((STATIONS + 1, *batch), dtype)
    answer_own = np.zeros((STATIONS, *batch), dtype)
    answer_x = np.zeros((STATIONS, *batch), dtype)
    answer_y = np.zeros((STATIONS, *batch), dtype)
    predicted_angle = np.zeros((STATIONS + 1, *batch), dtype)
    predicted_rate = np.zeros((STATIONS + 1, *batch), dtype)
    solved = np.zeros((STATIONS, *batch), dtype)
    transmission = np.zeros((STATIONS, *batch), dtype)

    # predicted motion
    predicted_rate[0] = hub_rate + hub_acceleration * step
    predicted_angle[0] = hub_angle + half_step_squared * hub_acceleration + hub_rate * step
    predicted_rate[1:] = rate + acceleration * step
    predicted_angle[1:] = angle + acceleration * half_step_squared + rate * step

    # accelerations of the nodes
    lever_cosine = length * np.cos(predicted_angle[1:])
    lever_sine = length * np.sin(predicted_angle[1:])
    square = predicted_rate[1:] * predicted_rate[1:]
    relative_x = -acceleration * lever_sine - lever_cosine * square
    relative_y = acceleration * lever_cosine - lever_sine * square
    turning = predicted_rate[1:] * step
    swing_x = -lever_sine - angle_per_acceleration * relative_y - lever_cosine * turning
    swing_y = lever_cosine + angle_per_acceleration * relative_x - lever_sine * turning
    node_x: Any = 0.0
    node_y: Any = 0.0
    acceleration_x[0] = node_x
    acceleration_y[0] = node_y
    for j in range(STATIONS):
        node_x = node_x + relative_x[j]
        node_y = node_y + relative_y[j]
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y

    # forces of the joints at the motion so far
    joint_torque = damping * (predicted_rate[:5] - predicted_rate[1:]) + stiffness * (
        predicted_angle[:5] - predicted_angle[1:]
    )

    # sweep inward: force beyond each joint as an affine function of the motion at it
    impedance_xx = end_mass
    impedance_xy: Any = 0.0
    impedance_xu: Any = 0.0
    impedance_yx: Any = 0.0
    impedance_yy = end_mass
    impedance_yu: Any = 0.0
    impedance_ux: Any = 0.0
    impedance_uy: Any = 0.0
    impedance_uu: Any = 0.0
    force_x = acceleration_x[5] * end_mass
    force_y = acceleration_y[5] * end_mass
    torque: Any = 0.0
    for j in reversed(range(STATIONS)):
        impedance_xx = impedance_xx + mass
        force_x = force_x + acceleration_x[j + 1] * mass
        impedance_yy = impedance_yy + mass
        force_y = force_y + acceleration_y[j + 1] * mass
        impedance_xu = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j]
        impedance_yu = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j]
        impedance_uu = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j]
        impedance_ux = impedance_ux - impedance_xx * lever_sine[j] + impedance_yx * lever_cosine[j]
        impedance_uy = impedance_uy - impedance_xy * lever_sine[j] + impedance_yy * lever_cosine[j]
        impedance_uu = (
            impedance_uu
            + rod_inertia
            + lever_cosine[j] * (impedance_yu - angle_per_acceleration * force_x)
            + lever_sine[j] * (-impedance_xu - angle_per_acceleration * force_y)
        )
        torque = torque + acceleration[j] * rod_inertia - force_x * lever_sine[j] + force_y * lever_cosine[j]
        pivot = impedance_uu + joint_impedance[j]
        good = _positive_pivot(good, pivot, "pivot", j)
        admittance = 1.0 / pivot
        answer_own[j] = admittance * (joint_torque[j] - torque)
        answer_x[j] = admittance * impedance_ux
        answer_y[j] = admittance * impedance_uy
        transmission[j] = admittance * joint_impedance[j]
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu
        force_x = force_x + answer_own[j] * impedance_xu
        impedance_xu = impedance_xu * transmission[j]
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu
        force_y = force_y + answer_own[j] * impedance_yu
        impedance_yu = impedance_yu * transmission[j]
        impedance_ux = answer_x[j] * joint_impedance[j]
        impedance_uy = answer_y[j] * joint_impedance[j]
        impedance_uu = impedance_uu * transmission[j]
        torque = joint_torque[j] - answer_own[j] * joint_impedance[j]

    # the base
    hub_pivot = hub_impedance + impedance_uu
    good = _positive_pivot(good, hub_pivot, "hub_pivot", None)
    unknown = (
        hub_torque - torque - hub_acceleration * hub_inertia - hub_damping * predicted_rate[0]
    ) / hub_pivot
    hub_unknown = unknown

    # sweep outward: the unknown of each station
    change_x: Any = 0.0
    change_y: Any = 0.0
    for j in range(STATIONS):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
        solved[j] = unknown

    # motion at the end of the step
    hub_angle = predicted_angle[0] + angle_per_acceleration * hub_unknown
    hub_rate = predicted_rate[0] + hub_unknown * rate_per_acceleration
    hub_acceleration = hub_acceleration + hub_unknown
    angle = predicted_angle[1:] + angle_per_acceleration * solved
    rate = predicted_rate[1:] + rate_per_acceleration * solved
    acceleration = acceleration + solved

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
    length = model.length
    hub_angle = state.hub_angle
    hub_rate = state.hub_rate
    hub_acceleration = state.hub_acceleration
    angle = np.asarray(state.angle)
    rate = np.asarray(state.rate)
    acceleration = np.asarray(state.acceleration)
    numbers: tuple[Any, ...] = (length, hub_angle, hub_rate, hub_acceleration)
    arrays: tuple[Any, ...] = (angle, rate, acceleration)
    batch, _ = _common(numbers, arrays)
    hub_angle = _spread(hub_angle, batch, False)
    hub_rate = _spread(hub_rate, batch, False)
    hub_acceleration = _spread(hub_acceleration, batch, False)
    angle = _spread(angle, batch, True)
    rate = _spread(rate, batch, True)
    acceleration = _spread(acceleration, batch, True)

    # output tip: position
    tip_x: Any = 0.0
    tip_y: Any = 0.0
    for j in range(STATIONS):
        tip_x = tip_x + length * np.cos(angle[j])
        tip_y = tip_y + length * np.sin(angle[j])

    # output hub: angle
    hub = hub_angle
    return Output(
        tip_x=_spread(tip_x, batch, False), tip_y=_spread(tip_y, batch, False), hub=_spread(hub, batch, False)
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
    initial_angle : number, or array_like, shape (5, *batch)
        Angles to start from (rad).
    initial_rate : number, or array_like, shape (5, *batch)
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
