"""Peers of an arm in space: what they are given, and their compiled steps."""

from __future__ import annotations

import ctypes
import subprocess
from copy import copy
from dataclasses import replace
from pathlib import Path
from typing import Protocol, Self

import numpy as np
from numpy.typing import NDArray

from peers.articulated import LOOP, c_text
from peers.articulated_space import accelerations, numbers, step_function
from peers.joint_arm import FLAGS, pointer
from peers.pinocchio import LISTS
from tmm_gen.native.compiler import compile_library
from tmm_gen.scene.spatial.arm import ArmOutput, SpatialArm

Array = NDArray[np.float64]
SOURCE = Path(__file__).with_name("pinocchio_space_loop.cpp")


class Peer(Protocol):
    """Somebody who takes steps of Newmark."""

    joints: int

    def at_step(self, step: float) -> Self:
        """Return it at a step, s."""
        ...

    def started(self, angles: Array, rates: Array) -> Array:
        """Return angles, rates and accelerations of the joints at the start, (3 n,)."""
        ...

    def advance(self, motion: Array, steps: int) -> tuple[Array, float]:
        """Take so many steps; return the motion then, and the seconds they took."""
        ...


class ArticulatedTree:
    """The step that CasADi writes; the arm's numbers become part of its code.

    Parameters
    ----------
    arm : SpatialArm
    torques : array, (n,)
        In the joints, constant, N m.
    step : float or None
        s; None where it is to be read when the step is taken: :meth:`at_step` tells.
    """

    def __init__(self, arm: SpatialArm, torques: Array, step: float | None) -> None:
        self.joints = len(arm.joints)
        self._arm, self._torques, self._given = arm, torques, torques
        sources = {"arm_step.c": c_text(step_function(arm, step)), "loop.c": LOOP.read_text()}
        self._handle = ctypes.CDLL(str(compile_library(sources, "gcc", FLAGS)))
        self._handle.peer_seconds.restype = ctypes.c_double

    def at_step(self, step: float) -> Self:
        """Return it at a step, s."""
        other = copy(self)
        other._given = np.append(self._torques, step)
        return other

    def started(self, angles: Array, rates: Array) -> Array:
        """Return angles, rates and accelerations of the joints at the start, (3 n,)."""
        import casadi as ca

        stiffness, damping, slack, rotors = numbers(self._arm)
        torque = self._torques - stiffness * (angles - slack) - damping * rates
        found = ca.evalf(accelerations(self._arm, ca.SX(angles), ca.SX(rates), ca.SX(torque), rotors))
        return np.concatenate([angles, rates, np.array(found).ravel()])

    def advance(self, motion: Array, steps: int) -> tuple[Array, float]:
        """Take so many steps; return the motion then, and the seconds they took."""
        final = np.empty_like(motion)
        seconds = self._handle.peer_seconds(
            pointer(motion), pointer(final), pointer(self._given), len(motion), ctypes.c_long(steps)
        )
        return final, seconds


class PinocchioTree:
    """The step about Pinocchio's articulated-body algorithm; parameters as of :class:`ArticulatedTree`."""

    def __init__(
        self, arm: SpatialArm, torques: Array, step: float, library: Path, *, in_world: bool
    ) -> None:
        self.joints = len(arm.joints)
        self._hosts = np.array([joint.host for joint in arm.joints], np.int32)
        self._axes = np.array([joint.axis for joint in arm.joints], np.int32)
        self._numbers = np.array(
            [
                [*joint.at, *np.ravel(joint.turn), joint.body.mass, *joint.body.center, *joint.body.inertia]
                for joint in arm.joints
            ]
        )
        self._gravity = np.array(arm.gravity)
        self._laws = np.concatenate(numbers(arm))
        self._torques, self._step, self._in_world = torques, step, in_world
        self._handle = ctypes.CDLL(str(library))
        self._handle.peer_seconds.restype = ctypes.c_double

    def at_step(self, step: float) -> Self:
        """Return it at a step, s."""
        other = copy(self)
        other._step = step
        return other

    def started(self, angles: Array, rates: Array) -> Array:
        """Return angles, rates and accelerations of the joints at the start, (3 n,)."""
        return self.advance(np.concatenate([angles, rates, np.zeros(self.joints)]), 0)[0]

    def advance(self, motion: Array, steps: int) -> tuple[Array, float]:
        """Take so many steps; return the motion then, and the seconds they took."""
        final = np.array(motion)
        whole = ctypes.POINTER(ctypes.c_int)
        seconds = self._handle.peer_seconds(
            self.joints,
            self._hosts.ctypes.data_as(whole),
            self._axes.ctypes.data_as(whole),
            pointer(self._numbers),
            pointer(self._gravity),
            pointer(self._laws),
            pointer(self._torques),
            ctypes.c_double(self._step),
            int(self._in_world),
            pointer(final),
            ctypes.c_long(steps),
        )
        return final, seconds


def compiled(place: Path, folder: Path) -> Path:
    """Compile the loop into a folder, if it is not there: Pinocchio's templates take minutes and 3 GB of memory."""
    include = place / "include"
    library = folder / "pinocchio_space_loop.so"
    if library.exists() and library.stat().st_mtime > SOURCE.stat().st_mtime:
        return library
    command = ["g++", "-std=c++17", "-DNDEBUG", *FLAGS, *LISTS, "-fPIC", "-shared"]
    command += [f"-isystem{include}", f"-isystem{include / 'eigen3'}", str(SOURCE), "-o", str(library)]
    subprocess.run(command, check=True)
    return library


def driven(arm: SpatialArm) -> SpatialArm:
    """Return an arm that torques alone act on, and of which the joints' angles are read."""
    angles = tuple(ArmOutput(f"angle_{k}", "angle", joint=k) for k in range(1, len(arm.joints) + 1))
    return replace(arm, inputs=tuple(i for i in arm.inputs if i.acts == "torque"), outputs=angles)
