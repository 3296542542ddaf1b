"""The motion about which a stage is linearised: predicted from the last instant, or what of it is known."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, Kind, Scheme, past, stage
from tmm_gen.derive.integrators.relations import AffineMotion
from tmm_gen.program.fields import MOTION_NAMES
from tmm_gen.program.variables import Ref, Role, Variable

KNOWN_RATE = sp.Symbol("known_rate", real=True)
_WORDS = {"prediction": ("predicted", "as predicted"), "known": ("known", "without the unknown's share")}


@dataclass(frozen=True)
class StartingPoint:
    """Motion of a stage before its sweep, by history and earlier stages; rates may stand in displacements."""

    values: Mapping[Kind, sp.Expr]

    @property
    def still(self) -> frozenset[str]:
        """Kinds that are zero."""
        return frozenset(k for k in KINDS if self.values[k] == 0)


def starting_point(motion: AffineMotion, index: int, about: str, *, held: bool = True) -> StartingPoint:
    """Return the motion about which a stage (from 0) is linearised.

    Parameters
    ----------
    held : bool
        Whether a prediction takes the acceleration to be that of the instant solved before; otherwise to be none.
    """
    values = dict(motion.offset)
    if about == "prediction":
        newest = stage("a", index) if index else past("a")
        latest = newest if held else sp.Integer(0)
        guess = (latest - motion.offset["a"]) / motion.gain["a"]
        values = {k: sp.expand(motion.offset[k] + motion.gain[k] * guess) for k in KINDS}
    return StartingPoint(_short(values, motion))


def _short(values: dict[Kind, sp.Expr], motion: AffineMotion) -> dict[Kind, sp.Expr]:
    """Write the displacement by the rate where that takes fewer terms (Runge-Kutta stages)."""
    rate = values["v"]
    if motion.gain["v"] == 0 or rate == 0:
        return values
    ratio = sp.cancel(motion.gain["q"] / motion.gain["v"])
    rest = sp.expand(values["q"] - ratio * rate)
    if len(sp.Add.make_args(rest)) + 1 >= len(sp.Add.make_args(sp.expand(values["q"]))):
        return values
    return {**values, "q": rest + ratio * KNOWN_RATE}


def motion_variable(kind: Kind, about: str, stations: int) -> Variable:
    """Return the scratch array of motion before the sweep, base first."""
    name, unit = MOTION_NAMES[kind]
    prefix, words = _WORDS[about]
    return Variable(f"{prefix}_{name}", Role.WORK, stations + 1, f"{name} of base and links {words}", unit)


@dataclass(frozen=True)
class Held:
    """Motion that stands where it was: no copy of it is made.

    Parameters
    ----------
    stations : Ref
        At station j of a loop.
    base : sympy.Expr
        Of the base.
    """

    stations: Ref
    base: sp.Expr

    def at(self, offset: int = 0) -> sp.Expr:
        """Return the motion of node ``j + offset``; that of an inner node may be the base's, elsewhere."""
        if offset != 1:
            raise ValueError("only a station's own motion stands where it was")
        return self.stations

    def entry(self, index: int) -> sp.Expr:
        """Return the motion of a node, base first."""
        return self.stations.variable.entry(index - 1) if index else self.base


Moving = Variable | Held
"""Motion of all nodes, base first: an array of its own, or where it stands already."""


@dataclass(frozen=True)
class StageOf:
    """A stage of a scheme.

    Parameters
    ----------
    scheme : Scheme
    index : int
        From 1.
    motion : AffineMotion
        By its unknown.
    sources : mapping from sympy.Symbol to sympy.Expr
        Where the history of stations is read from.
    """

    scheme: Scheme
    index: int
    motion: AffineMotion
    sources: Mapping[sp.Symbol, sp.Expr]
