"""The articulated-body algorithm of a tree in space and one Newmark step about it, in CasADi, as C."""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene.spatial.arm import Revolute, SpatialArm

Array = NDArray[np.float64]


def accelerations(
    arm: SpatialArm, angles: ca.SX, rates: ca.SX, torques: ca.SX, armature: Array | ca.SX
) -> ca.SX:
    """Return accelerations of the joints (rad/s^2): Featherstone's recursion in axes of the links."""
    joints = arm.joints
    across, spatial, bias, inertia, force = [], [], [], [], []
    spin: list[ca.SX] = []
    for k, joint in enumerate(joints):
        through = _across(joint, angles[k])
        axis = ca.SX(6, 1)
        axis[joint.axis] = 1
        own = axis * rates[k]
        inner = spin[joint.host - 1] if joint.host else ca.SX(6, 1)
        moved = through @ inner + own
        across.append(through)
        spatial.append(axis)
        spin.append(moved)
        bias.append(_motion_cross(moved) @ own)
        inertia.append(_inertia(joint))
        force.append(-_motion_cross(moved).T @ (inertia[k] @ moved))
    answers: dict[int, tuple[ca.SX, ca.SX, ca.SX]] = {}
    for k in reversed(range(len(joints))):
        joint, axis = joints[k], spatial[k]
        turned = inertia[k] @ axis
        over = 1.0 / (turned[joint.axis] + armature[k])
        lacking = torques[k] - force[k][joint.axis]
        answers[k] = (turned, over, lacking)
        if joint.host:
            reduced = inertia[k] - (turned * over) @ turned.T
            pushed = force[k] + reduced @ bias[k] + turned * (over * lacking)
            inertia[joint.host - 1] += across[k].T @ reduced @ across[k]
            force[joint.host - 1] += across[k].T @ pushed
    found: list[ca.SX] = []
    moving: list[ca.SX] = []
    base = ca.SX(ca.DM([0.0, 0.0, 0.0, *(-g for g in arm.gravity)]))
    for k, joint in enumerate(joints):
        turned, over, lacking = answers[k]
        carried = across[k] @ (moving[joint.host - 1] if joint.host else ca.sparsify(base)) + bias[k]
        own = over * (lacking - turned.T @ carried)
        found.append(own)
        moving.append(carried + spatial[k] * own)
    return ca.vertcat(*found)


def step_function(arm: SpatialArm, step: float | None) -> ca.Function:
    """Return one step of Newmark (1/4, 1/2) as ``x_next = step(x, u)``; as in `peers.articulated`, u of the joints.

    Without a step, in s, that is read from behind the torques in u.
    """
    n = len(arm.joints)
    x, u = ca.SX.sym("x", 3 * n), ca.SX.sym("u", n + (step is None))
    h = u[n] if step is None else step
    stiffness, damping, slack, rotors = numbers(arm)
    angle, rate, last = ca.vertsplit(x, n)
    rate_ahead = rate + h * last
    angle_ahead = angle + h * (rate + 0.5 * h * last)
    without_angle = angle_ahead - 0.25 * h**2 * last
    without_rate = rate_ahead - 0.5 * h * last
    torque = u[:n] - _times(stiffness, without_angle - slack) - _times(damping, without_rate)
    implicit = ca.SX(ca.sparsify(ca.DM(rotors)))
    implicit += 0.5 * h * ca.sparsify(ca.DM(damping)) + 0.25 * h**2 * ca.sparsify(ca.DM(stiffness))
    new = accelerations(arm, angle_ahead, rate_ahead, torque, implicit)
    found = ca.vertcat(without_angle + 0.25 * h**2 * new, without_rate + 0.5 * h * new, new)
    return ca.Function("arm_step", [x, u], [ca.cse(found)])


def numbers(arm: SpatialArm) -> tuple[Array, Array, Array, Array]:
    """Return stiffness, damping, slack angle and rotor of each joint."""
    joints = arm.joints
    return (
        np.array([joint.stiffness for joint in joints]),
        np.array([joint.damping for joint in joints]),
        np.array([joint.rest for joint in joints]),
        np.array([joint.armature for joint in joints]),
    )


def _times(factors: Array, values: ca.SX) -> ca.SX:
    return ca.SX(ca.sparsify(ca.DM(factors))) * values


def _skew(v: ca.SX | ca.DM) -> ca.SX:
    return ca.skew(v)


def _across(joint: Revolute, angle: ca.SX) -> ca.SX:
    """Return the transform of motions (turn, then shift) from the host's frame to the joint's."""
    c, s = ca.cos(angle), ca.sin(angle)
    i, j = (joint.axis + 1) % 3, (joint.axis + 2) % 3
    hinge = ca.SX.eye(3)
    hinge[i, i] = hinge[j, j] = c
    hinge[i, j], hinge[j, i] = s, -s
    turn = hinge @ ca.SX(ca.sparsify(ca.DM(np.array(joint.turn).T)))
    shift = ca.SX(ca.sparsify(ca.DM(np.array(joint.at))))
    top = ca.horzcat(turn, ca.SX(3, 3))
    return ca.vertcat(top, ca.horzcat(-turn @ _skew(shift), turn))


def _motion_cross(v: ca.SX) -> ca.SX:
    turning, moving = _skew(v[:3]), _skew(v[3:])
    return ca.vertcat(ca.horzcat(turning, ca.SX(3, 3)), ca.horzcat(moving, turning))


def _inertia(joint: Revolute) -> ca.SX:
    body = joint.body
    xx, yy, zz, xy, xz, yz = body.inertia
    center = np.array(body.center)
    lever = body.mass * np.array(ca.DM(ca.skew(center)))
    about = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    about = about + body.mass * (center @ center * np.eye(3) - np.outer(center, center))
    whole = np.block([[about, lever], [lever.T, body.mass * np.eye(3)]])
    return ca.SX(ca.sparsify(ca.DM(whole)))
