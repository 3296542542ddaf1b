"""A base that floats, where outputs are read off: its place, axes and motion from what is kept between steps."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.space.base_motion import FACING as FOUND_FACING
from tmm_gen.derive.space.declaration import AXES, OMEGA, VELOCITY, vector
from tmm_gen.derive.space.pose import FACING, PLACE, QUATERNION, quaternion_axes
from tmm_gen.derive.space.sheet import Sheet
from tmm_gen.derive.station.lets import Line, Update

AT, GOES, SPINS = (vector(f"base_{word}") for word in ("at", "goes", "spins"))
"""Place and velocity of its origin in world axes, angular velocity in its own."""
STANDS = sp.Matrix(sp.symbols("base_stands_w base_stands_x base_stands_y base_stands_z", real=True))
"""Quaternion of its axes."""


def quaternion_line() -> tuple[Line, ...]:
    """Return what begins a walk that carries quaternions."""
    return (Update(dict(zip(QUATERNION, STANDS, strict=True))),)


def facing_line(*, place: bool = False) -> tuple[Line, ...]:
    """Return what begins a walk that carries axes, and places if asked for."""
    facing = quaternion_axes(STANDS).T
    begun = dict(zip(FACING, facing, strict=True))
    return (Update({**begun, **(dict(zip(PLACE, AT, strict=True)) if place else {})}),)


def velocity_lines() -> tuple[Line, ...]:
    """Return what begins a walk that carries velocity and angular velocity in the section's axes."""
    sheet = Sheet()
    facing = quaternion_axes(STANDS).T
    named = sp.Matrix(3, 3, lambda i, j: sheet.named(f"base_axes_{AXES[i]}{AXES[j]}", facing[i, j]))
    begun = zip((*VELOCITY, *OMEGA), (*(named * GOES), *SPINS), strict=True)
    return (*sheet.lets, Update(dict(begun)))


def found_facing_line() -> tuple[Line, ...]:
    """Return what begins a walk that carries axes within a step, where those of the base are found already."""
    return (Update(dict(zip(FACING, FOUND_FACING, strict=True))),)
