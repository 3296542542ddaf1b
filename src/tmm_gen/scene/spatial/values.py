"""Vectors, axes and inertias as a scene file writes them."""

from __future__ import annotations

from typing import Annotated

from pydantic import PlainValidator

from tmm_gen.scene.spatial.arm import Vector
from tmm_gen.scene.table import fault, is_finite_number

AXES: dict[str, Vector] = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}

Inertia = tuple[float, ...]
"""Three numbers or six: xx, yy, zz, and maybe xy, xz, yz of the inertia matrix."""


def _numbers(value: object, lengths: tuple[int, ...]) -> tuple[float, ...] | None:
    if isinstance(value, list | tuple) and len(value) in lengths and all(map(is_finite_number, value)):
        return tuple(map(float, value))
    return None


def _vector(value: object) -> Vector:
    found = _numbers(value, (3,))
    if found is None:
        raise fault("must be three finite numbers", "Write for example `[0.0, 0.0, 0.2]`.")
    return found  # type: ignore[return-value]


def _gravity(value: object) -> Vector:
    found = _numbers(value, (3,))
    if found is not None:
        return found  # type: ignore[return-value]
    down = abs(value) if is_finite_number(value) and value else 9.81
    raise fault(
        "must be a vector in space: three finite numbers, m/s^2",
        f"Write for example `gravity = [0, 0, -{down:g}]`, or leave the key out for none.",
    )


def _axis(value: object) -> Vector:
    if isinstance(value, str) and value in AXES:
        return AXES[value]
    found = _numbers(value, (3,))
    if found is None or not any(found):
        raise fault(
            'must be "x", "y", "z" or a vector other than zero',
            'Write for example `axis = "z"` or `axis = [0, 1, 1]`.',
        )
    return found  # type: ignore[return-value]


def _inertia(value: object) -> Inertia:
    found = _numbers(value, (3, 6))
    if found is None:
        raise fault(
            "must be three finite numbers, or six: xx, yy, zz and maybe xy, xz, yz of the inertia matrix",
            "Write for example `inertia = [1e-3, 1e-3, 5e-4]` (kg m^2, about the centre of mass).",
        )
    if min(found[:3]) < 0.0:
        raise fault(
            "has a negative moment of inertia", "Write numbers that are not negative before the products."
        )
    return found


def _limits(value: object) -> tuple[float, float]:
    found = _numbers(value, (2,))
    if found is None or not found[0] < found[1]:
        raise fault(
            "must be two finite numbers, the lower first", "Write for example `limits = [-2.0, 2.0]`."
        )
    return found  # type: ignore[return-value]


def _both(value: object) -> tuple[float, float]:
    """Return the stiffness about both axes; one number is that of both."""
    found = (float(value),) * 2 if is_finite_number(value) else _numbers(value, (2,))
    if found is None or min(found) <= 0.0:
        raise fault(
            "must be a number greater than 0, or two: about the beam's y axis and about its z axis",
            "Write for example `bending_stiffness = [15.0, 15.0]` (EI in N m^2).",
        )
    return found  # type: ignore[return-value]


Place = Annotated[Vector, PlainValidator(_vector)]
Gravity = Annotated[Vector, PlainValidator(_gravity)]
AxisVector = Annotated[Vector, PlainValidator(_axis)]
SixInertia = Annotated[Inertia, PlainValidator(_inertia)]
Limits = Annotated[tuple[float, float], PlainValidator(_limits)]
BothStiffnesses = Annotated[tuple[float, float], PlainValidator(_both)]
