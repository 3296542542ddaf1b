"""The same arm and step in Pinocchio, compiled from its headers: it is no dependency, and may be absent."""

from __future__ import annotations

import ctypes
import importlib.util
import subprocess
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from peers.joint_arm import FLAGS, JointArm, pointer

Array = NDArray[np.float64]
SOURCE = Path(__file__).with_name("pinocchio_loop.cpp")
HOW_TO_GET = "pip install --target out/pin pin cmeel-eigen, then --pinocchio out/pin/cmeel.prefix"

# Pinocchio's joints are more than Boost's lists hold by themselves
LISTS = (
    "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS",
    "-DBOOST_MPL_LIMIT_LIST_SIZE=30",
    "-DBOOST_MPL_LIMIT_VECTOR_SIZE=30",
)


def installed() -> Path | None:
    """Return where the running Python's own Pinocchio lies, if it has one."""
    found = importlib.util.find_spec("cmeel")
    places = [
        Path(p).parent / "cmeel.prefix" for p in (found.submodule_search_locations if found else None) or []
    ]
    return next((p for p in places if has_headers(p)), None)


def has_headers(place: Path) -> bool:
    """Say whether Pinocchio and Eigen lie below a prefix."""
    return all((place / "include" / name).is_dir() for name in ("pinocchio", "eigen3"))


class Pinocchio:
    """The compiled step; its motion is laid out as that of `Articulated`.

    Parameters
    ----------
    arm : JointArm
        The arm.
    torques : array, (inputs,)
        Of the motors, constant, N m.
    library : Path
        As `compiled` has made it.
    in_world : bool
        Whether the recursion runs in axes of the world, or of each link.
    """

    def __init__(self, arm: JointArm, torques: Array, library: Path, *, in_world: bool) -> None:
        self.joints = len(arm.lengths)
        self._arm, self._in_world = arm, in_world
        self._bodies = np.concatenate([arm.lengths, arm.masses, arm.first_moments, arm.inertias])
        self._joints = np.concatenate([arm.stiffness, arm.damping, arm.slack, arm.rotors])
        self._torques = arm.gears @ torques
        self._handle = ctypes.CDLL(str(library))
        self._handle.peer_seconds.restype = ctypes.c_double

    def started(self, angles: Array, rates: Array) -> Array:
        """Return angles, rates and accelerations of the joints at the start, (3 n,)."""
        return self.advance(np.concatenate([angles, rates, np.zeros(self.joints)]), 0)[0]

    def advance(self, motion: Array, steps: int) -> tuple[Array, float]:
        """Take so many steps; return the motion then, and the seconds they took."""
        final = np.array(motion)
        seconds = self._handle.peer_seconds(
            self.joints,
            pointer(self._bodies),
            ctypes.c_double(self._arm.gravity),
            pointer(self._joints),
            pointer(self._torques),
            ctypes.c_double(self._arm.step),
            int(self._in_world),
            pointer(final),
            ctypes.c_long(steps),
        )
        return final, seconds


def compiled(place: Path, folder: Path) -> Path:
    """Compile the loop into a folder, if it is not there: Pinocchio's templates take minutes and 3 GB of memory."""
    include = place / "include"
    library = folder / "pinocchio_loop.so"
    if library.exists() and library.stat().st_mtime > SOURCE.stat().st_mtime:
        return library
    command = ["g++", "-std=c++17", "-DNDEBUG", *FLAGS, *LISTS, "-fPIC", "-shared"]
    command += [f"-isystem{include}", f"-isystem{include / 'eigen3'}", str(SOURCE), "-o", str(library)]
    subprocess.run(command, check=True)
    return library
