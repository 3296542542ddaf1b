"""What a sweep finds at a base that moves freely: it turns about a fixed point, or floats."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.station.frame import UNKNOWN, Frame, change, force, impedance
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
    if frame.about == "known":
        admittance = sp.Symbol("hub_admittance", real=True)
        lines.append(Let(admittance, 1 / pivot, "inverse pivot of the hub"))
        return [*lines, Update({UNKNOWN: admittance * known})]
    return [*lines, Update({UNKNOWN: known / pivot})]


def floating_base(base: Elements, frame: Frame, at_base: frozenset[sp.Symbol]) -> list[Line]:
    """Solve for the unknown of a base that floats, and for the changes of its acceleration.

    Nothing holds it: ``S k + e = 0``, by elimination, what it is pushed along first. Its pivots are masses there.

    Parameters
    ----------
    base : tuple of Element
    at_base : frozenset of sympy.Symbol
        What is known to be zero of what arrives there.
    """
    c = sorted(frame.coordinates, key=lambda coordinate: coordinate.integrated)
    left = composed(inward(base, frame, at_base, moved=True).lines)
    nothing = dict.fromkeys(at_base, sp.Integer(0))
    lines: list[Line] = []

    def named(symbol: sp.Symbol, value: sp.Expr, doc: str) -> sp.Expr:
        if value.is_Atom:
            return value
        lines.append(Let(symbol, value, doc))
        return symbol

    def entry(symbol: sp.Symbol) -> sp.Expr:
        value = left.get(symbol, symbol).subs(nothing)
        return named(sp.Symbol(f"whole_{symbol.name}", real=True), value, "of the arm with its base")

    s = {(a, b): entry(impedance(a, b)) for a in c for b in c}
    e = {a: entry(force(a)) for a in c}
    for index, a in enumerate(c):
        lines.append(Pivot(s[a, a]))
        for b in c[index + 1 :]:
            share = sp.Symbol(f"share_{b.name}{a.name}", real=True)
            share = named(share, s[b, a] / s[a, a], f"of the balance of {a.force} in that of {b.force}")
            for k in c[index + 1 :]:
                value = s[b, k] - share * s[a, k]
                rest = sp.Symbol(f"impedance_{b.name}{k.name}_freed_{a.name}", real=True)
                s[b, k] = named(rest, value, f"where nothing holds it along {a.name}")
            rest = sp.Symbol(f"{b.force}_freed_{a.name}", real=True)
            e[b] = named(rest, e[b] - share * e[a], f"where nothing holds it along {a.name}")
    solved: dict[Coordinate, sp.Expr] = {}
    for index, a in reversed(list(enumerate(c))):
        others = sp.Add(*(s[a, b] * solved[b] for b in c[index + 1 :]))
        target = UNKNOWN if a.integrated else change(a)
        lines.append(Update({target: -(e[a] + others) / s[a, a]}))
        solved[a] = target
    return lines


def base_acceleration(coordinate: Coordinate) -> Ref:
    """Return the acceleration of a base that floats, as it is known so far in a stage."""
    doc = f"acceleration of the base along {coordinate.name}, as known so far"
    return local(f"trial_acceleration_{coordinate.name}", doc, coordinate.unit)


def base_change(coordinate: Coordinate) -> Ref:
    """Return the change of that acceleration which a sweep has found."""
    doc = f"change of the base's acceleration along {coordinate.name}"
    return local(f"base_change_{coordinate.name}", doc, coordinate.unit)
