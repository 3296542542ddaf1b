"""What of a joint and its body is there at all: joints of one pattern share one derivation and one piece of code."""

from __future__ import annotations

from dataclasses import dataclass, replace

import sympy as sp

from tmm_gen.derive.space.declaration import (
    ACCEL,
    ALPHA,
    BASE_ACCEL,
    BASE_PLACE,
    BASE_VELOCITY,
    FIRST_MOMENT,
    INERTIA,
    MASS,
    OFFSET,
    OMEGA,
    TURN,
)

Flags = tuple[bool, ...]


@dataclass(frozen=True)
class Pattern:
    """Structure of one station: offset, constant turn, hinge, body.

    Parameters
    ----------
    axis : int
        0, 1 or 2: of the hinge.
    offset : tuple of bool, length 3
        Which components are not zero.
    turn : tuple of tuple of (int or None)
        Entries that are 0, 1 or -1 for good; None for any other.
    massive : bool
        Whether the body has any mass or inertia.
    mass : bool
    first_moment : tuple of bool, length 3
    inertia : tuple of bool, length 6
    falls : tuple of bool, length 3
        On the base: along which axes gravity acts or the base is moved. Empty elsewhere.
    moved : tuple of bool, length 3
        On the base: along which axes it is moved as given. Empty elsewhere.
    tip : bool
        Whether nothing hangs on it.
    given : bool
        Whether its motion is given: on the base, and nothing that it carries changes it.
    driven : bool
        Whether it stands on such a joint.
    loaded : bool
        Whether a force or a moment acts on it though nothing there has mass.
    """

    axis: int
    offset: Flags
    turn: tuple[tuple[int | None, ...], ...]
    mass: bool
    first_moment: Flags
    inertia: Flags
    falls: Flags = ()
    moved: Flags = ()
    tip: bool = False
    given: bool = False
    driven: bool = False
    loaded: bool = False

    @property
    def massive(self) -> bool:
        """Whether its body takes any force to move."""
        return self.mass or any(self.inertia)

    @property
    def acted(self) -> bool:
        """Whether there is any force to be passed on: what its body takes, or what acts on it."""
        return self.massive or self.loaded

    @property
    def freed(self) -> Pattern:
        """Itself where no motion is given: all of its motion and of its forces is asked for."""
        return replace(self, given=False, driven=False)

    @property
    def rooted(self) -> bool:
        """Whether it stands on the base, which rests or moves as given."""
        return bool(self.falls)

    @property
    def unyielding(self) -> bool:
        """Whether what it stands on does not give way, so that no forces need to be passed on."""
        return self.rooted or self.driven

    @property
    def symbols(self) -> dict[str, sp.Matrix]:
        """Offset, turn and first moment by symbols, or zeros and ones."""
        return {
            "offset": _masked(OFFSET, self.offset),
            "turn": sp.Matrix(
                3,
                3,
                lambda i, j: TURN[i, j] if self.turn[i][j] is None else sp.Integer(self.turn[i][j]),
            ),
            "first_moment": _masked(FIRST_MOMENT, self.first_moment),
        }

    @property
    def mass_symbol(self) -> sp.Expr:
        """The mass, or zero."""
        return MASS if self.mass else sp.Integer(0)

    @property
    def inertia_symbols(self) -> tuple[sp.Expr, ...]:
        """Entries of the inertia, or zeros."""
        return tuple(s if there else sp.Integer(0) for s, there in zip(INERTIA, self.inertia, strict=True))

    @property
    def inner_motion(self) -> tuple[sp.Matrix, sp.Matrix, sp.Matrix]:
        """Angular velocity, angular acceleration and proper acceleration at the inner side."""
        if not self.rooted:
            return OMEGA, ALPHA, ACCEL
        return sp.zeros(3, 1), sp.zeros(3, 1), _masked(BASE_ACCEL, self.falls)

    @property
    def base_place(self) -> sp.Matrix:
        """Where the base is that it stands on, in world axes."""
        return _masked(BASE_PLACE, self.moved)

    @property
    def base_velocity(self) -> sp.Matrix:
        """How fast that is."""
        return _masked(BASE_VELOCITY, self.moved)


def _masked(vector: sp.Matrix, there: Flags) -> sp.Matrix:
    return sp.Matrix([s if flag else 0 for s, flag in zip(vector, there, strict=True)])
