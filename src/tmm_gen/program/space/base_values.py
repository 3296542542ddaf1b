"""Where the base of an arm in space is, and how it moves, when its state is read."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.space.base_pose import AT, GOES, SPINS, STANDS
from tmm_gen.derive.space.declaration import BASE_ACCEL, BASE_PLACE, BASE_VELOCITY
from tmm_gen.program.space.layout import BASE_MOTION, SpaceLayout, kernel_columns


def base_values(layout: SpaceLayout) -> dict[sp.Symbol, sp.Expr]:
    """Return what symbols of a base that floats, or is moved as given, stand for."""
    base = layout.base
    if base is None:
        told = zip(
            (BASE_PLACE, BASE_VELOCITY, BASE_ACCEL), ("place", "velocity", "acceleration"), strict=True
        )
        return {
            s: moved(layout, word, k)
            for symbols, word in told
            for k, s in enumerate(symbols)
            if layout.arm.along[k]
        }
    symbols = (*AT, *GOES, *STANDS, *SPINS)
    values = (
        *base.newest("q", base.place),
        *base.newest("v", base.place),
        *base.start,
        *base.newest("v", base.omega),
    )
    return dict(zip(symbols, values, strict=True))


def moved(layout: SpaceLayout, word: str, k: int) -> sp.Expr:
    """Return the place, velocity or acceleration of a base along an axis, as it is moved; zero where it is not."""
    item = layout.arm.along[k]
    if item is None:
        return sp.Integer(0)
    order = [name for name, _ in BASE_MOTION].index(word)
    return layout.held[kernel_columns(item)[order]].ref
