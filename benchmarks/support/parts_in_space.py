"""Arms in space read off the text of a scene by other means than the package's: homogeneous matrices in NumPy.

Parts are placed by 4 x 4 matrices, turned by exponentials about axes in the world, and weighed by pseudo-inertias
(4 x 4 second moments of mass); beams are integrated along their length. Nothing here knows of joints' frames.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from tmm_gen.scene.spatial.arm import RigidBody, SpatialArm

Array = NDArray[np.float64]
Part = dict[str, Any]

_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
_KINDS = ("motor", "joint", "beam", "link", "body")


def parts_of(text: str) -> dict[str, Part]:
    """Return the parts of a scene by name, each with its table's name as ``kind``."""
    data = tomllib.loads(text)
    return {part["name"]: {**part, "kind": kind} for kind in _KINDS for part in data.get(kind, ())}


def moved(at: Any, turn: Any) -> Array:
    """Return the matrix of a frame by its place and its turn about the fixed x, y and z."""
    made = np.eye(4)
    made[:3, :3] = Rotation.from_euler("xyz", turn).as_matrix()
    made[:3, 3] = at
    return made


def placed(parts: Mapping[str, Part], angles: Mapping[str, float] = {}) -> dict[str, tuple[Array, Array]]:
    """Return the frames of each part's inner and outer end in the world, at angles of motors and joints."""
    found: dict[str, tuple[Array, Array]] = {"base": (np.eye(4), np.eye(4))}

    def frames(name: str) -> tuple[Array, Array]:
        if name not in found:
            part = parts[name]
            inner = frames(part.get("on", "base"))[1] @ moved(
                part.get("at", (0, 0, 0)), part.get("turn", (0, 0, 0))
            )
            found[name] = inner, inner @ _along(part, angles.get(name, 0.0))
        return found[name]

    for name in parts:
        frames(name)
    return found


def _along(part: Part, angle: float) -> Array:
    """Return the frame of a part's outer end in that of its inner end."""
    if part["kind"] in ("motor", "joint"):
        axis = np.array(_AXES.get(part["axis"]) if isinstance(part["axis"], str) else part["axis"], float)
        made = np.eye(4)
        made[:3, :3] = expm(np.cross(np.eye(3), angle * axis / np.linalg.norm(axis)))
        return made
    end = part.get("end", (part.get("length", 0.0), 0.0, 0.0))
    return moved(end, (0, 0, 0))


def pseudo_inertia(mass: float, center: Any, inertia: Any) -> Array:
    """Return the second moments of mass in a frame, of a body by its centre and the inertia about that."""
    c = np.asarray(center, float)
    six = np.array([*inertia, *(0.0,) * (6 - len(inertia))])
    xx, yy, zz, xy, xz, yz = six
    about = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    made = np.zeros((4, 4))
    made[:3, :3] = np.trace(about) / 2 * np.eye(3) - about + mass * np.outer(c, c)
    made[:3, 3] = made[3, :3] = mass * c
    made[3, 3] = mass
    return made


def weighed(parts: Mapping[str, Part], angles: Mapping[str, float] = {}) -> Array:
    """Return the pseudo-inertia about the world's origin of all parts that move."""
    frames = placed(parts, angles)
    total = np.zeros((4, 4))
    for name, part in parts.items():
        if part["kind"] == "beam" or (part["kind"] in ("link", "body") and _moves(parts, name)):
            here = frames[name][0]
            total += here @ _own(parts, name) @ here.T
    return total


def _moves(parts: Mapping[str, Part], name: str) -> bool:
    while name != "base":
        if parts[name]["kind"] in ("motor", "joint", "beam"):
            return True
        name = parts[name].get("on", "base")
    return False


def _own(parts: Mapping[str, Part], name: str) -> Array:
    part = parts[name]
    if part["kind"] != "beam":
        end = np.array(part.get("end", (part.get("length", 0.0), 0.0, 0.0)), float)
        center = part.get("center", end / 2)
        return pseudo_inertia(part.get("mass", 0.0), center, part.get("inertia", (0, 0, 0)))
    mass, polar, length = part["mass_per_length"], part.get("polar_inertia_per_length", 0.0), part["length"]
    first = 0.0
    if not _moves(parts, part.get("on", "base")) and part.get("on", "base") != name:
        first = length / part["links"] / 2  # half a piece is fixed to what does not move
    nodes, weights = np.polynomial.legendre.leggauss(4)  # exact for what is integrated
    at = first + (nodes + 1) / 2 * (length - first)
    return sum(
        (
            weight / 2 * (length - first) * pseudo_inertia(mass, (x, 0, 0), (polar, 0, 0))
            for x, weight in zip(at, weights, strict=True)
        ),
        np.zeros((4, 4)),
    )


def joint_frames(arm: SpatialArm, angles: Array) -> list[Array]:
    """Return the frames of an arm's joints in the world, the base first."""
    found = [np.eye(4)]
    for joint, angle in zip(arm.joints, angles, strict=True):
        step = np.eye(4)
        step[:3, :3] = np.array(joint.turn) @ Rotation.from_rotvec(angle * np.eye(3)[joint.axis]).as_matrix()
        step[:3, 3] = joint.at
        found.append(found[joint.host] @ step)
    return found


def body_pseudo_inertia(body: RigidBody) -> Array:
    """Return the second moments of mass of a joint's body in the joint's frame."""
    return pseudo_inertia(body.mass, body.center, body.inertia)


def mass_matrix(arm: SpatialArm, angles: Array) -> Array:
    """Return the mass matrix by Jacobians: kinetic energy of all bodies by the rates of the joints, rotors included."""
    frames, n = joint_frames(arm, angles), len(arm.joints)
    total = np.diag([joint.armature for joint in arm.joints])
    for number, joint in enumerate(arm.joints, start=1):
        frame = frames[number]
        center = frame[:3, :3] @ np.array(joint.body.center) + frame[:3, 3]
        xx, yy, zz, xy, xz, yz = joint.body.inertia
        about = frame[:3, :3] @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ frame[:3, :3].T
        turning, moving = np.zeros((3, n)), np.zeros((3, n))
        k = number
        while k:
            axis = frames[k][:3, arm.joints[k - 1].axis]
            turning[:, k - 1] = axis
            moving[:, k - 1] = np.cross(axis, center - frames[k][:3, 3])
            k = arm.joints[k - 1].host
        total += turning.T @ about @ turning + joint.body.mass * moving.T @ moving
    return total
