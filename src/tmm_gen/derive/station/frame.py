"""The symbols in which a station's recursion is written, and how values there follow its unknown."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import sympy as sp

from tmm_gen.derive.partial import partial
from tmm_gen.derive.station.law import KINDS
from tmm_gen.derive.station.lets import Coordinate

SINE, COSINE = sp.symbols("sine cosine", real=True)
"""Of a station's angle."""
SQUARE = sp.Symbol("square", real=True)
"""Of its rate."""
INNER = {kind: sp.Symbol(f"inner_{kind}", real=True) for kind in KINDS}
OUTER = {kind: sp.Symbol(f"outer_{kind}", real=True) for kind in KINDS}
"""Motion of the integrated coordinate at both sides of a station, at the point about which it is linearised."""
MOUNT = {kind: sp.Symbol(f"mount_{kind}", real=True) for kind in KINDS}
"""Motion of what a station's shaft is mounted on; the shaft's own is what is at the inner side."""
GAINS = {kind: sp.Symbol(f"P_{kind}", real=True) for kind in KINDS}
"""Change of that motion per unknown."""
UNKNOWN = sp.Symbol("unknown", real=True)
RESIDUAL = sp.Symbol("residual", real=True)
"""Own force of the element that gives way at a station, less that beyond it: what its equation leaves over."""


def of_shaft(symbol: sp.Symbol) -> sp.Symbol:
    """Return what stands for a shaft's own parameter or load in the station that it turns."""
    return sp.Symbol(f"shaft_{symbol.name}")


def node(coordinate: Coordinate) -> sp.Symbol:
    """Return the acceleration at the inner side in a coordinate that is not integrated."""
    return sp.Symbol(f"node_{coordinate.name}", real=True)


def change(coordinate: Coordinate) -> sp.Symbol:
    """Return the change of that acceleration, on the way out."""
    return sp.Symbol(f"change_{coordinate.name}", real=True)


def impedance(row: Coordinate, column: Coordinate) -> sp.Symbol:
    """Return the change of the force beyond a place per change of the motion at it."""
    return sp.Symbol(f"impedance_{row.name}{column.name}".rstrip("_"), real=True)


def force(coordinate: Coordinate) -> sp.Symbol:
    """Return the force beyond a place if nothing changed."""
    return sp.Symbol(coordinate.force, real=True)


def predicted_force(coordinate: Coordinate) -> sp.Symbol:
    """Return the force beyond a place at the point of linearisation."""
    return sp.Symbol(f"predicted_{coordinate.force}", real=True)


def lacking(coordinate: Coordinate) -> sp.Symbol:
    """Return what the equations of a base that moves freely leave over."""
    return RESIDUAL if coordinate.integrated else sp.Symbol(f"residual_{coordinate.name}", real=True)


@dataclass(frozen=True)
class Frame:
    """What a recursion is derived for.

    Parameters
    ----------
    coordinates : tuple of Coordinate
        Of every station; one of them is integrated.
    gain : tuple of 3 sympy.Expr
        Of displacement, rate and acceleration: a number, or the symbol of ``GAINS``.
    still : frozenset of str
        Kinds of motion that are zero at the point of linearisation.
    about : str
        "prediction": unknowns are small changes of predicted motion; "known": they are the motion itself, but for
        what is known of it beforehand.
    sign : int
        1 where forces are those the inner side exerts on the outer one, -1 otherwise.
    turning : sympy.Expr
        1 where sines follow the angle, 0 where they are frozen.
    square_slope : sympy.Expr
        Derivative of the squared rate by the rate.
    followed : sympy.Expr, optional
        Where nodes have motions of their own: share in which their accelerations follow the unknown as lever arms turn.
    predicted : bool
        Whether slopes are taken at the forces as predicted, instead of those the sweep has found.
    corrected : bool
        Whether corrections follow the sweep, which read its factors.
    residual : bool
        Whether what the equations leave over is given at each station (``RESIDUAL``): forces are changes then.
    """

    coordinates: tuple[Coordinate, ...]
    gain: tuple[sp.Expr, sp.Expr, sp.Expr]
    still: frozenset[str] = frozenset()
    about: str = "prediction"
    sign: int = 1
    turning: sp.Expr = sp.S.One
    square_slope: sp.Expr = 2 * OUTER["v"]
    followed: sp.Expr | None = None
    predicted: bool = False
    corrected: bool = False
    residual: bool = False

    @property
    def gains(self) -> dict[str, sp.Expr]:
        """Gains by kind of motion."""
        return dict(zip(KINDS, self.gain, strict=True))

    @property
    def own(self) -> int:
        """The integrated coordinate."""
        (index,) = [i for i, c in enumerate(self.coordinates) if c.integrated]
        return index

    @property
    def impedance_unit(self) -> str:
        """Unit of a torque per unknown."""
        return "kg m^2" if self.gain[2] == 1 else "N m/rad"

    @property
    def swing_unit(self) -> str:
        """Unit of an acceleration of a node per unknown."""
        return "m" if self.gain[2] == 1 else "m/s^2"

    def slope(self, value: sp.Expr, kind: str) -> sp.Expr:
        """Differentiate by displacement, rate or acceleration of the station."""
        return _slope(value, kind, self.turning, self.square_slope)

    def along(self, value: sp.Expr) -> sp.Expr:
        """Differentiate by the unknown: displacement, rate and acceleration move together."""
        return sp.Add(*(self.gains[kind] * self.slope(value, kind) for kind in KINDS))

    def settled(self, value: sp.Expr) -> sp.Expr:
        """Put zero where nothing is known to move."""
        return value.xreplace(
            {symbols[kind]: sp.S.Zero for kind in self.still for symbols in (MOUNT, INNER, OUTER)}
        )


@lru_cache(maxsize=1 << 12)  # each gain asks for the slopes of the same laws
def _slope(value: sp.Expr, kind: str, turning: sp.Expr, square_slope: sp.Expr) -> sp.Expr:
    if kind == "q":
        turned = partial(value, SINE) * COSINE - partial(value, COSINE) * SINE
        return sp.expand(turning * turned + partial(value, OUTER["q"]))
    if kind == "v":
        return sp.expand(partial(value, OUTER["v"]) + partial(value, SQUARE) * square_slope)
    return sp.expand(partial(value, OUTER["a"]))


def primitive(value: sp.Expr) -> sp.Expr:
    """Write sines and squares of the station's motion by symbols of their own."""
    angle, rate = OUTER["q"], OUTER["v"]
    named = {sp.sin(angle): SINE, sp.cos(angle): COSINE, rate**2: SQUARE}
    return sp.expand(value).xreplace(named)
