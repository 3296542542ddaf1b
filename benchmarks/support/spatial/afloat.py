"""Arms in space whose base floats: random ones, and what their kernels keep as the reference's coordinates."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation
from support.spatial.random_arms import random_arm, random_body

from tmm_gen.reference.spatial_turns import product
from tmm_gen.scene.spatial.arm import (
    ArmInput,
    ArmOutput,
    ArmQuantity,
    Frame,
    FreeBase,
    Revolute,
    RigidBody,
    SpatialArm,
    Vector,
)

Array = NDArray[np.float64]

_PUSHES: tuple[Literal["force", "moment"], ...] = ("force", "moment")
_AXES: tuple[Literal["world", "body"], ...] = ("world", "body")
_SEEN: tuple[ArmQuantity, ...] = ("position", "velocity", "orientation")


def random_afloat(seed: int, joints: int = 3, *, loads: bool = True) -> SpatialArm:
    """Return a random tree on a base that floats, tumbles, and is pushed; the same for the same arguments.

    Parameters
    ----------
    loads : bool
        Whether forces and moments act on base and frames, besides torques in all joints.
    """
    rng = np.random.default_rng([seed, 7])
    arm = random_arm(seed, joints, tree=True, loads=loads)
    first, second, third = Rotation.from_rotvec(rng.uniform(-2.0, 2.0, 3)).as_matrix()
    turn = (_vector(first), _vector(second), _vector(third))
    hub = Frame("hub", 0, _vector(rng.uniform(-0.2, 0.2, 3)), turn)
    pushes = [
        ArmInput(f"{acts}_{axes}_hub", acts, frame=hub, axes=axes) for acts in _PUSHES for axes in _AXES
    ]
    seen = [ArmOutput(f"hub_{of}", of, frame=hub) for of in _SEEN]
    base = FreeBase(
        random_body(rng),
        at=_vector(rng.uniform(-1.0, 1.0, 3)),
        turn=turn,
        velocity=_vector(rng.uniform(-1.0, 1.0, 3)),
        rate=_vector(rng.uniform(-1.0, 1.0, 3)),
    )
    inputs = (*arm.inputs, *pushes) if loads else arm.inputs
    return replace(arm, base=base, inputs=inputs, outputs=(*arm.outputs, *seen))


def tumbling(rate: Vector) -> SpatialArm:
    """Return a single body of moments of inertia 1, 2 and 3 kg m^2 that turns freely.

    An arm has a joint: this one carries a rotor alone, which nothing turns.
    """
    rotor = Revolute("rotor", 0, armature=1.0)
    return SpatialArm(
        (rotor,), base=FreeBase(RigidBody(1.0, inertia=(1.0, 2.0, 3.0, 0.0, 0.0, 0.0)), rate=rate)
    )


def coordinates(state: Any) -> tuple[Array, Array]:
    """Return the coordinates of a kernel's state and their rates as the reference has them, (7 + n,) each."""

    def of_base(word: str, parts: str) -> Array:
        return np.array([float(getattr(state, f"base_{word}_{part}")) for part in parts])

    turn = of_base("quaternion", "wxyz")
    turning = 0.5 * product(turn, np.concatenate([[0.0], of_base("omega", "xyz")]))
    y = np.concatenate([of_base("place", "xyz"), turn, state.angle])
    return y, np.concatenate([of_base("velocity", "xyz"), turning, state.rate])


def _vector(values: Array) -> Vector:
    x, y, z = (float(value) for value in values)
    return (x, y, z)
