"""What a sweep finds at a base that moves freely: it turns about a fixed point, or floats."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.station.frame import RESIDUAL, UNKNOWN, Frame, change, force, impedance, lacking
from tmm_gen.derive.station.lets import Coordinate, Let, Line, Pivot, Update, composed
from tmm_gen.derive.station.station import inward
from tmm_gen.program.variables import Ref, local
from tmm_gen.row.row import Elements


def turning_base(base: Elements, frame: Frame, at_base: frozenset[sp.Symbol]) -> list[Line]:
    """Solve for the unknown of a base that turns about a point which stays where it is.

    Parameters
    ----------
    base : tuple of Element
    at_base : frozenset of sympy.Symbol
        What is known to be zero of what arrives there.
    """
    own = frame.coordinates[frame.own]
    derived = inward(base, frame, at_base, moved=True)
    left = composed(derived.lines)
    stiffness, bias = left.get(impedance(own, own), impedance(own, own)), left.get(force(own), force(own))
    if impedance(own, own) in at_base:
        stiffness = stiffness.subs(impedance(own, own), 0)
    sign = sp.Integer(frame.sign)
    constant = sp.expand(sign * (stiffness - stiffness.coeff(impedance(own, own)) * impedance(own, own)))
    lines: list[Line] = []
    if not constant.is_Atom:
        named = sp.Symbol("hub_impedance", real=True)
        lines.append(Let(named, constant, "torque of the hub per unknown", frame.impedance_unit))
        constant = named
    pivot = sp.Symbol("hub_pivot", real=True)
    carried = sign * impedance(own, own) if stiffness.has(impedance(own, own)) else sp.Integer(0)
    lines += [Let(pivot, carried + constant, "pivot of the hub"), Pivot(pivot)]
    known = sp.expand(-sign * bias)
    if frame.residual:
        known += RESIDUAL
    if frame.about == "known":
        admittance = sp.Symbol("hub_admittance", real=True)
        lines.append(Let(admittance, 1 / pivot, "inverse pivot of the hub"))
        return [*lines, Update({UNKNOWN: admittance * known})]
    return [*lines, Update({UNKNOWN: known / pivot})]


@dataclass(frozen=True)
class Balance:
    """What nothing holds: ``S k + e = 0`` by elimination, what it is pushed along first; its pivots are masses there.

    Parameters
    ----------
    factors : tuple of Line
        Of ``S``, and its pivots.
    forces : tuple of Line
        ``e``, eliminated with them.
    answers : tuple of Line
        The unknown of the base, and the changes of its acceleration.
    """

    factors: tuple[Line, ...]
    forces: tuple[Line, ...]
    answers: tuple[Line, ...]

    @property
    def lines(self) -> tuple[Line, ...]:
        """All of them."""
        return (*self.factors, *self.forces, *self.answers)

    @property
    def kept(self) -> dict[str, tuple[str, str]]:
        """Factors by name that forces and answers read, with words and unit."""
        read = {s for line in self.forces if isinstance(line, Let) for s in line.value.free_symbols}
        for line in self.answers:
            assert isinstance(line, Update)
            read |= {s for value in line.values.values() for s in value.free_symbols}
        lets = [line for line in self.factors if isinstance(line, Let)]
        return {let.symbol.name: (let.doc, let.unit) for let in lets if let.symbol in read}


def floating_base(
    base: Elements, frame: Frame, at_base: frozenset[sp.Symbol], *, named: bool = False
) -> Balance:
    """Balance a base that floats.

    Parameters
    ----------
    base : tuple of Element
    at_base : frozenset of sympy.Symbol
        What is known to be zero of what arrives there.
    named : bool
        Whether factors have names of their own though they are what has arrived.
    """
    c = sorted(frame.coordinates, key=lambda coordinate: coordinate.integrated)
    left = composed(inward(base, frame, at_base, moved=True).lines)
    nothing = dict.fromkeys(at_base, sp.Integer(0))
    factors: list[Line] = []
    forces: list[Line] = []

    def let(into: list[Line], name: str, value: sp.Expr, doc: str) -> sp.Expr:
        if value.is_number or (value.is_Atom and not named):
            return value
        symbol = sp.Symbol(name, real=True)
        into.append(Let(symbol, value, doc))
        return symbol

    def entry(symbol: sp.Symbol) -> sp.Expr:
        value = left.get(symbol, symbol).subs(nothing)
        return let(factors, f"whole_{symbol.name}", value, "of the arm with its base")

    def bias(a: Coordinate) -> sp.Expr:
        lacks = sp.Integer(frame.sign) * lacking(a) if frame.residual else sp.Integer(0)
        value = left.get(force(a), force(a)).subs(nothing) - lacks
        return let(forces, f"whole_{force(a).name}", value, "of the arm with its base")

    s = {(a, b): entry(impedance(a, b)) for a in c for b in c}
    e = {a: bias(a) for a in c}
    for index, a in enumerate(c):
        factors.append(Pivot(s[a, a]))
        freed = f"where nothing holds it along {a.name}"
        for b in c[index + 1 :]:
            doc = f"of the balance of {a.force} in that of {b.force}"
            share = let(factors, f"share_{b.name}{a.name}", s[b, a] / s[a, a], doc)
            for k in c[index + 1 :]:
                name = f"impedance_{b.name}{k.name}_freed_{a.name}"
                s[b, k] = let(factors, name, s[b, k] - share * s[a, k], freed)
            e[b] = let(forces, f"{b.force}_freed_{a.name}", e[b] - share * e[a], freed)
    answers: list[Line] = []
    solved: dict[Coordinate, sp.Expr] = {}
    for index, a in reversed(list(enumerate(c))):
        others = sp.Add(*(s[a, b] * solved[b] for b in c[index + 1 :]))
        solved[a] = UNKNOWN if a.integrated else change(a)
        answers.append(Update({solved[a]: -(e[a] + others) / s[a, a]}))
    return Balance(tuple(factors), tuple(forces), tuple(answers))


def base_acceleration(coordinate: Coordinate) -> Ref:
    """Return the acceleration of a base that floats, as it is known so far in a stage."""
    doc = f"acceleration of the base along {coordinate.name}, as known so far"
    return local(f"trial_acceleration_{coordinate.name}", doc, coordinate.unit)


def base_change(coordinate: Coordinate) -> Ref:
    """Return the change of that acceleration which a sweep has found."""
    doc = f"change of the base's acceleration along {coordinate.name}"
    return local(f"base_change_{coordinate.name}", doc, coordinate.unit)
