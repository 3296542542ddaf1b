"""A planar arm as algorithms in joint coordinates take it, and the Newmark step they are given."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.reference.planar_arm import Arm
from tmm_gen.scene import Scene, station_of

Array = NDArray[np.float64]

FLAGS = ("-O3", "-march=native", "-ffp-contract=fast")
"""With which everyone's code is compiled."""


@dataclass(frozen=True, eq=False)
class JointArm:
    """Bodies by what a recursion over joints needs of them; the payload is part of the last one.

    Parameters
    ----------
    lengths, masses, first_moments, inertias : array, (n,)
        m; kg; kg m about the own joint, along the link; kg m^2 about the own joint.
    stiffness, damping, slack, rotors : array, (n,)
        Of the joints: N m/rad, N m s/rad, rad, kg m^2.
    gears : array, (n, inputs)
        What an input exerts in each joint, N m per N m.
    gravity : float
        Along -y, m/s^2.
    step : float
        s.
    """

    lengths: Array
    masses: Array
    first_moments: Array
    inertias: Array
    stiffness: Array
    damping: Array
    slack: Array
    rotors: Array
    gears: Array
    gravity: float
    step: float

    @property
    def armature(self) -> Array:
        """Rotors, and what springs and dampers resist an acceleration with over a step of Newmark, (n,), kg m^2."""
        return self.rotors + 0.5 * self.step * self.damping + 0.25 * self.step**2 * self.stiffness


def joint_arm(scene: Scene) -> JointArm:
    """Return a scene on a clamp, all of whose inputs, if there are any, are torques of motors; or on a hub.

    A hub is a body without length and mass at a joint without spring, which its own inertia resists as a rotor.
    """
    hub = scene.base.kind == "motor"
    if scene.base.kind not in ("clamp", "motor") or {i.acts for i in scene.inputs} - {
        "torque" if hub else "drive"
    }:
        raise ValueError("peers are written for arms on a clamp or a hub, moved by motors")
    if hub:
        beyond = scene.replace(base={"kind": "clamp"}, input=None)
        return _on_hub(joint_arm(beyond), scene.base.inertia, len(scene.inputs))
    arm = Arm(scene, {})
    centers = np.array([link.center for link in scene.links]) * arm.lengths
    masses, moments, inertias = arm.masses[:-1].copy(), arm.masses[:-1] * centers, arm.inertias.copy()
    inertias += masses * centers**2
    payload = arm.masses[-1]
    masses[-1] += payload
    moments[-1] += payload * arm.lengths[-1]
    inertias[-1] += payload * arm.lengths[-1] ** 2
    gears = np.zeros((len(masses), len(scene.inputs)))
    for column, item in enumerate(scene.inputs):
        row = station_of(item.at, scene.stations) - 1
        gears[row, column] = scene.joints[row].gear
    stiffness, damping = arm.joints
    return JointArm(
        arm.lengths,
        masses,
        moments,
        inertias,
        stiffness,
        damping,
        arm.slack,
        arm.rotors,
        gears,
        arm.gravity,
        scene.integrator.step,
    )


def _on_hub(arm: JointArm, inertia: float, inputs: int) -> JointArm:
    """Return an arm whose clamp turns with a hub that all of some inputs turn."""

    def behind(values: Array, hub: float = 0.0) -> Array:
        return np.concatenate([[hub], values])

    return replace(
        arm,
        lengths=behind(arm.lengths),
        masses=behind(arm.masses),
        first_moments=behind(arm.first_moments),
        inertias=behind(arm.inertias),
        stiffness=behind(arm.stiffness),
        damping=behind(arm.damping),
        slack=behind(arm.slack),
        rotors=behind(arm.rotors, inertia),
        gears=np.vstack([np.ones((1, inputs)), np.zeros((len(arm.lengths), inputs))]),
    )


def pointer(values: Array) -> Any:
    """Return where an array of numbers begins, for C."""
    return values.ctypes.data_as(ctypes.POINTER(ctypes.c_double))
