"""Mass, first moment and inertia of what is rigidly joined, in exact numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from tmm_gen.scene.exact import exact, nearest
from tmm_gen.scene.spatial.arm import RigidBody
from tmm_gen.scene.spatial.geometry import (
    LEVEL,
    NOWHERE,
    Matrix,
    Point,
    Pose,
    applied,
    dot,
    plus,
    point,
    product,
    times,
    transposed,
    vector,
)

EMPTY: Matrix = (NOWHERE, NOWHERE, NOWHERE)

_UPPER = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
"""Where the six numbers of an inertia stand in its matrix."""


@dataclass(frozen=True)
class Weight:
    """A rigid body in some frame.

    Parameters
    ----------
    mass : Fraction
        kg.
    moment : tuple of Fraction, length 3
        Mass times place of its centre, kg m.
    inertia : tuple of tuple of Fraction
        About the frame's origin, kg m^2.
    """

    mass: Fraction = Fraction(0)
    moment: Point = NOWHERE
    inertia: Matrix = EMPTY

    def __add__(self, other: Weight) -> Weight:
        """Return both as one body."""
        if self is NOTHING:
            return other
        x, y, z = (plus(a, b) for a, b in zip(self.inertia, other.inertia, strict=True))
        return Weight(self.mass + other.mass, plus(self.moment, other.moment), (x, y, z))

    def at(self, pose: Pose) -> Weight:
        """Return the same body seen from the frame in which its own has a pose."""
        if self is NOTHING or (pose.at is NOWHERE and pose.turn is LEVEL):
            return self
        turned = product(product(pose.turn, self.inertia), transposed(pose.turn))
        moment = applied(pose.turn, self.moment)
        moved = _moved(turned, self.mass, moment, pose.at)
        return Weight(self.mass, plus(moment, times(self.mass, pose.at)), moved)

    def body(self) -> RigidBody:
        """Return it by its centre, in floats."""
        if self.mass == 0:
            return RigidBody(inertia=_six(self.inertia))
        center = times(1 / self.mass, self.moment)
        about = _less(self.inertia, _steiner(self.mass, center))
        return RigidBody(nearest(self.mass), vector(center), _six(about))


NOTHING = Weight()


def weight(mass: float, center: Sequence[float], inertia: Sequence[float]) -> Weight:
    """Return a body by mass, centre and the inertia about that: xx, yy, zz, and maybe xy, xz, yz of the matrix."""
    place, m = point(center), exact(mass)
    six = [*map(exact, inertia), *(Fraction(0),) * (6 - len(inertia))]
    xx, yy, zz, xy, xz, yz = six
    about = (xx, xy, xz), (xy, yy, yz), (xz, yz, zz)
    return Weight(m, times(m, place), _more(about, _steiner(m, place)))


def rod(mass: Fraction, length: Fraction, polar: Fraction) -> Weight:
    """Return a thin rod from the origin along x: ``m l^2/12`` across about its centre, and a polar inertia.

    Parameters
    ----------
    mass, length, polar : Fraction
        kg, m, and kg m^2 about x.
    """
    across, none = mass * length**2 / 12, Fraction(0)
    about = (polar, none, none), (none, across, none), (none, none, across)
    center = (length / 2, none, none)
    return Weight(mass, times(mass, center), _more(about, _steiner(mass, center)))


def _steiner(mass: Fraction, a: Point) -> Matrix:
    """Return the inertia of a point mass at a."""
    square = dot(a, a)
    x, y, z = (
        (
            mass * ((square if row == 0 else 0) - a[row] * a[0]),
            mass * ((square if row == 1 else 0) - a[row] * a[1]),
            mass * ((square if row == 2 else 0) - a[row] * a[2]),
        )
        for row in range(3)
    )
    return x, y, z


def _moved(inertia: Matrix, mass: Fraction, moment: Point, by: Point) -> Matrix:
    """Return an inertia about the origin after the body has moved by a vector."""
    both = 2 * dot(moment, by)
    shared = tuple(
        tuple((both if i == j else 0) - moment[i] * by[j] - by[i] * moment[j] for j in range(3))
        for i in range(3)
    )
    return _more(_more(inertia, shared), _steiner(mass, by))  # type: ignore[arg-type]


def _more(a: Matrix, b: Matrix) -> Matrix:
    x, y, z = map(plus, a, b)
    return x, y, z


def _less(a: Matrix, b: Matrix) -> Matrix:
    x, y, z = (plus(row, times(Fraction(-1), other)) for row, other in zip(a, b, strict=True))
    return x, y, z


def _six(inertia: Matrix) -> tuple[float, float, float, float, float, float]:
    xx, yy, zz, xy, xz, yz = (nearest(inertia[i][j]) for i, j in _UPPER)
    return xx, yy, zz, xy, xz, yz
