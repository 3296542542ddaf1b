"""Everything numeric that a nonlinear MPC in C needs, prepared once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.arm.holding import holding
from tmm_gen.control.arm.motor_rows import Motors
from tmm_gen.control.arm.payload import laden, payload_of
from tmm_gen.control.arm.payload_body import beside_payload
from tmm_gen.control.estimators.credible import Credible
from tmm_gen.control.estimators.far_gain import FarGain, far_gain
from tmm_gen.control.estimators.kalman import KalmanFilter
from tmm_gen.control.laws.rti import RealTimeIteration
from tmm_gen.control.laws.safe import BRAKE_TIME
from tmm_gen.control.quadratic.response import split_outputs
from tmm_gen.control.quadratic.walls import Wall
from tmm_gen.control.task.terms import Kind
from tmm_gen.onboard.joint_tables import JointTables
from tmm_gen.onboard.linear_data import gains_by_sensors
from tmm_gen.onboard.program_data import ProgramData, program_data
from tmm_gen.onboard.space_payload import SpacePayload
from tmm_gen.onboard.weight import Weight, weight_of

Array = NDArray[np.float64]

OUTPUTS = ("tip", "tip_rate", "hub", "hub_rate")


@dataclass(frozen=True, eq=False)
class RtiData:
    """Tables of a real-time iteration.

    Parameters
    ----------
    size : int
        Entries of the kernel's state, s.
    biases : int
        b, of how many sensors what they are off for long is estimated.
    motors : Motors
        What turns the arm, m of them.
    outputs : tuple of (str, int)
        Those of `OUTPUTS` that are weighed or bounded, of a motor each; then ``keep``, of each wall.
    weights, targets : tuple of float
        Of each output.
    gains : array, (2^(p - m), s + m + b, p)
        Of the filter; see :func:`~tmm_gen.onboard.linear_data.gains_by_sensors`. Where ``far`` is something, its gain
        is one more.
    far : FarGain or None
        What is taken in far from the target; None where gains of the target are used everywhere.
    spread : array, (p, p)
        Covariance of what sensors are off.
    ahead_by, moved_by, now_by : array, (gains p, m N), (gains p, m N + r) and (gains p, r)
        By each of the gains: what each sensor's being off makes, at the target, of ``v = R^-T f``, of the bounds by
        that and of the rows.
    start : array, (s + m,)
        Estimate at time zero.
    start_torque : array, (m,)
        Torques before any is chosen, N m.
    credible : Credible
        What can be believed of a measurement.
    target_hub : array, (m,)
        rad.
    lengths : array, (n,)
        Of the links of an arm in a plane, relative to the sum of those that the same motor carries.
    shares : array, (M,)
        Of the earlier torque in the steps of a sample.
    sensors : tuple of int
        Which there are of m encoders, m accelerometers and m strain gauges.
    holds : array, (m, m)
        What holds up an arm in a plane, N m; see :func:`tmm_gen.control.arm.holding.holding`.
    holds_more : array, (m, m)
        By how much these grow for each kilogram at the tip, N m/kg; zero where there is none.
    payload : float or None
        Mass at the tip, kg; None where it is no parameter of the kernel.
    weight : Weight or None
        What holds up an arm in space.
    payload_words : str
        What that is called.
    beside_payload : float
        Of an arm in a plane, what else is at its tip, kg.
    load : SpacePayload or None
        Of an arm in space that takes another payload.
    target_torque, brake : array, (m,)
        N m; N m s/rad, of the safe law.
    gravity : float
        m/s^2.
    whole, memory : int
        Delay in samples; past torques that count.
    program : ProgramData
        The quadratic program at the target.
    answers : array, (outputs, m, N)
        To each motor's torque, sample by sample, at the target.
    target : array, (s,)
        The state at rest there.
    end : array, (r, s + m)
        G of the cost to go, by the state off the target and the last torques off the target's.
    end_gradient : array, (m N, s + m)
        What these make of the gradient, at the target.
    kinds : tuple of Kind
        What the rows of the program bound.
    accelerations : bool
        Whether the state has them.
    walls : tuple of Wall
        What parts are to stay on one side of.
    joints : JointTables or None
        Where the joints of an arm in space stand.
    """

    size: int
    biases: int
    motors: Motors
    outputs: tuple[tuple[str, int], ...]
    weights: tuple[float, ...]
    targets: tuple[float, ...]
    gains: Array
    far: FarGain | None
    spread: Array
    ahead_by: Array
    moved_by: Array
    now_by: Array
    credible: Credible
    target_hub: Array
    start: Array
    start_torque: Array
    lengths: Array
    shares: Array
    sensors: tuple[int, ...]
    holds: Array
    holds_more: Array
    payload: float | None
    payload_words: str
    beside_payload: float
    weight: Weight | None
    load: SpacePayload | None
    target_torque: Array
    gravity: float
    brake: Array
    whole: int
    memory: int
    program: ProgramData
    answers: Array
    target: Array
    end: Array
    end_gradient: Array
    kinds: tuple[Kind, ...]
    accelerations: bool
    walls: tuple[Wall, ...]
    joints: JointTables | None


def rti_data(controller: RealTimeIteration) -> RtiData:
    """Return the tables of a controller; of its filter, the gain at the target."""
    model, linear, problem = controller.model, controller.linear, controller.problem
    motors, goal, still = model.motors, linear.goal, np.zeros(problem.count)
    walls = range(len(controller.walls))
    weights = {name: getattr(problem.weights, name) for name in OUTPUTS} | {"keep": np.zeros(len(walls))}
    bounded = {(kind.what, kind.motor) for kind in controller.prepared.kinds}
    every = [
        *((name, motor) for name in OUTPUTS for motor in range(problem.count)),
        *(("keep", wall) for wall in walls),
    ]
    outputs = tuple(each for each in every if weights[each[0]][each[1]] or each in bounded)
    targets = {"tip": goal.tip, "tip_rate": still, "hub": goal.hub, "hub_rate": still} | {
        "keep": np.zeros(len(walls))
    }
    kalman = KalmanFilter(linear, problem)
    far = far_gain(model, linear, kalman)
    gains, program = gains_by_sensors(kalman), program_data(problem, controller.prepared)
    if far is not None:
        gains = np.concatenate([gains, far.gain[None]])
    ahead_by, now_by = _by_sensors(controller, gains, program)
    scaled = program.scaling[:, None] * np.vstack([program.inverse, program.rows @ program.inverse])
    slopes, count = controller.prepared.slopes, problem.horizon
    scene = model.scene
    in_space = scene.spatial is not None
    held = np.zeros((problem.count, problem.count)) if in_space else holding(scene)
    payload = payload_of(scene) if model.carries else None
    heavier = scene if payload is None else laden(scene, payload + 1.0)
    more = np.zeros_like(held) if in_space else holding(heavier) - held
    lengths = motors.lengths.copy()
    for motor in () if in_space else motors.each:
        lengths[motor.place : motor.end] /= lengths[motor.place : motor.end].sum()
    return RtiData(
        size=model.size,
        biases=len(kalman.biased),
        motors=motors,
        outputs=outputs,
        weights=tuple(float(weights[name][motor]) for name, motor in outputs),
        targets=tuple(float(targets[name][motor]) for name, motor in outputs),
        gains=gains,
        far=far,
        spread=kalman.spread,
        ahead_by=ahead_by,
        moved_by=ahead_by @ scaled.T,
        now_by=now_by,
        credible=controller.limits,
        target_hub=goal.hub,
        start=np.append(model.initial(), still),
        start_torque=linear.start_torque,
        lengths=lengths[scene.hub :],
        shares=model.delay.shares(problem.substeps),
        sensors=tuple(kalman.sensors),
        holds=held,
        holds_more=more,
        payload=payload,
        payload_words=linear.lift.words,
        beside_payload=0.0 if in_space else beside_payload(scene),
        weight=weight_of(arm_of(scene), arm_of(heavier), problem.count) if in_space else None,
        load=SpacePayload.of(scene, payload) if in_space and payload is not None else None,
        target_torque=goal.torque,
        gravity=0.0 if in_space else scene.model.gravity or 0.0,
        brake=controller.inertia / BRAKE_TIME,
        whole=controller.delay.whole,
        memory=controller.delay.memory,
        program=program,
        answers=np.array([getattr(slopes, name)[motor, :, ::count].T for name, motor in outputs]),
        target=controller.target,
        end=controller.end,
        end_gradient=slopes.end.T @ controller.end,
        kinds=controller.prepared.kinds,
        accelerations=model.accelerations,
        walls=tuple(controller.walls),
        joints=None if scene.spatial is None else JointTables.of(scene.spatial),
    )


def _by_sensors(controller: RealTimeIteration, gains: Array, program: ProgramData) -> tuple[Array, Array]:
    """Return what each sensor's being off makes of ``v = R^-T f`` and of the rows; see :class:`RtiData`.

    Walls are none of what is prepared once.
    """
    problem, size, condensed = controller.problem, controller.model.size, controller.prepared
    shape = (problem.count, problem.horizon)
    still, none = np.zeros(shape), np.zeros(problem.count)

    def program_of(change: Array) -> tuple[Array, Array]:
        along = split_outputs(controller.by_estimate @ change, shape)
        gradient = condensed.gradient(along, still, none, change[size:])[: program.inputs]
        rows = [
            still[0] if k.what in ("rate", "keep") else getattr(along, k.what)[k.motor]
            for k in condensed.kinds
        ]
        return program.inverse.T @ gradient, np.concatenate(rows) if rows else np.zeros(0)

    shift, _ = program_of(np.zeros(size + problem.count))  # the target's own
    # what sensors are off that stays makes no difference to what comes
    found = [program_of(column) for gain in gains for column in gain[: size + problem.count].T]
    return np.array([each[0] - shift for each in found]), np.array([each[1] for each in found])
