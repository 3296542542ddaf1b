"""A sweep outward that looks one station ahead.

A station's unknown follows from the last one's directly and through the change of motion that all before have
brought about: ``u = own - a c + t u``, then ``c = c + s u``. That second way is a chain of two products and two sums or
more from unknown to unknown. With the last station's part of ``c`` put in, ``u = (own - a c) + (t - a s) u``, where the
first bracket needs nothing of the last station and the second is at hand before the sweep begins: the chain is one
product and one sum, at four operations more per station of a planar arm. Several systems go out side by side, and of a
complex one both parts of the unknown make both.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import sympy as sp

from tmm_gen.program.motion import in_order
from tmm_gen.program.passes.lifetimes import carried_scalars, dead_after
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section, Statement
from tmm_gen.program.variables import Ref, Role, Variable, refs_in


def one_ahead(routine: Routine) -> Routine:
    """Return a routine whose sweeps outward wait for one product and one sum from station to station."""
    later = list(routine.statements())
    taken = {v.name for v in routine.read() | routine.written()}
    sections = []
    for section in routine.sections:
        statements: list[Statement] = []
        for statement in section.statements:
            later = later[1:]
            sweep = _Sweep.of(statement) if isinstance(statement, Loop) else None
            if sweep is not None and all(dead_after(c.variable, tuple(later)) for c in sweep.changes):
                statements += sweep.ahead(taken)
            else:
                statements.append(statement)
        sections.append(Section(section.title, tuple(statements)))
    return replace(routine, sections=tuple(sections))


@dataclass(frozen=True)
class _Sweep:
    """A loop of the form above.

    Parameters
    ----------
    loop : Loop
        As it was.
    unknowns : dict from Ref to sympy.Expr
        Scalars that hold unknowns, and what gives each by what all scalars were at the last station.
    changes : dict from Ref to dict from Ref to sympy.Expr
        Sums over stations: what each station adds for one unit of each of its unknowns.
    kept : tuple of Assign
        Copies of unknowns.
    """

    loop: Loop
    unknowns: dict[Ref, sp.Expr]
    changes: dict[Ref, dict[Ref, sp.Expr]]
    kept: tuple[Assign, ...]

    @classmethod
    def of(cls, loop: Loop) -> _Sweep | None:
        """Return what a loop is made of, or None if it is another."""
        if loop.order is not Order.OUTWARD or loop.stride > 1 or len(loop.visits) < 2:
            return None
        carried = {v.ref for v in carried_scalars(loop)}
        now: dict[Ref, sp.Expr] = {}
        """What scalars hold, if not what they did at the last station: an unknown, by a symbol of its own."""
        solved: dict[Ref, sp.Expr] = {}
        changes: dict[Ref, dict[Ref, sp.Expr]] = {}
        copies: list[tuple[Ref, Ref]] = []
        for line in loop.body:
            if not isinstance(line, Assign) or refs_in(line.value) & changes.keys():
                return None
            value = line.value.xreplace(now)
            new = refs_in(value) & solved.keys()
            if value in solved:
                if line.target.offset is None:
                    now[line.target] = value
                elif line.target.variable.role is Role.WORK:
                    copies.append((line.target, value))
                else:
                    return None
            elif new:
                gains = _gains(value - line.target, new)
                if line.target not in carried or gains is None or not _fixed(gains.values(), loop):
                    return None
                changes[line.target] = gains
            elif (
                line.target.offset is None and _affine(value, carried) and _fixed([value], loop, but=carried)
            ):
                symbol = Variable(f"{line.target.variable.name} new", Role.LOCAL).ref
                solved[symbol] = value
                now[line.target] = symbol
            else:
                return None
        holds = {symbol: ref for ref, symbol in now.items() if ref in carried}
        if not changes or holds.keys() != solved.keys() or carried != {*holds.values(), *changes}:
            return None
        return cls(
            loop,
            {holds[symbol]: value for symbol, value in solved.items()},
            {c: {holds[symbol]: gain for symbol, gain in gains.items()} for c, gains in changes.items()},
            tuple(Assign(target, holds[symbol]) for target, symbol in copies),
        )

    def ahead(self, taken: set[str]) -> list[Statement]:
        """Return the factors of all stations but the first, the first station, and the sweep over the others."""
        before = {
            c: {u: gain.xreplace(_moved(refs_in(gain), -1)) for u, gain in gains.items()}
            for c, gains in self.changes.items()
        }
        shares: dict[sp.Expr, Ref] = {}
        rests: list[Assign] = []
        new: list[Assign] = []
        for target, value in self.unknowns.items():
            value = sp.expand(value)
            terms: list[sp.Expr] = []
            for u in self.unknowns:
                reached = (value.coeff(c) * gains.get(u, 0) for c, gains in before.items())
                direct = sp.expand(sp.Add(value.coeff(u), *reached))
                if direct == 0:
                    continue
                if -direct in shares:
                    terms.append(-shares[-direct] * u)
                    continue
                if direct not in shares:
                    name = f"{target.variable.name}_passed_on"
                    shares[direct] = _named(name, taken, self.loop.stop).at()
                terms.append(shares[direct] * u)
            rest = _named(f"{target.variable.name}_rest", taken)
            rest = replace(rest, doc="", unit=target.variable.unit)
            rests.append(Assign(rest.ref, value.xreplace(dict.fromkeys(self.unknowns, sp.S.Zero))))
            new.append(Assign(target, sp.Add(rest.ref, *terms)))
        start = self.loop.start
        factors = Loop(
            Order.OUTWARD, start + 1, self.loop.stop, tuple(Assign(s, v) for v, s in shares.items())
        )
        changed = [
            Assign(c, sp.Add(c, *(gain * u for u, gain in gains.items()))) for c, gains in before.items()
        ]
        body = (*rests, *changed, *in_order(new), *self.kept)
        first = in_order([Assign(u, value) for u, value in self.unknowns.items()])
        at_first = [_at(line, start) for line in (*first, *self.kept)]
        return [factors, *at_first, Loop(Order.OUTWARD, start + 1, self.loop.stop, body)]


def _gains(added: sp.Expr, unknowns: Iterable[Ref]) -> dict[Ref, sp.Expr] | None:
    """Return what a sum has for one unit of each of some unknowns, or None if it holds anything else."""
    added = sp.expand(added)
    gains = {u: added.coeff(u) for u in unknowns}
    return gains if sp.expand(added - sp.Add(*(gain * u for u, gain in gains.items()))) == 0 else None


def _fixed(values: Iterable[sp.Expr], loop: Loop, but: Iterable[Ref] = ()) -> bool:
    """Whether the loop writes nothing of what expressions read."""
    written = {line.target.variable for line in loop.body if isinstance(line, Assign)}
    return not {ref.variable for value in values for ref in refs_in(value) - set(but)} & written


def _affine(value: sp.Expr, refs: set[Ref]) -> bool:
    return all(
        sum(factor in refs for factor in sp.Mul.make_args(term)) <= 1
        and all(factor in refs or not refs_in(factor) & refs for factor in sp.Mul.make_args(term))
        for term in sp.Add.make_args(value)
    )


def _moved(refs: Iterable[Ref], by: int) -> dict[Ref, Ref]:
    return {r: r.variable.at(r.offset + by) for r in refs if r.offset is not None}


def _at(line: Assign, station: int) -> Assign:
    places = {
        r: r.variable.entry(station + r.offset)
        for r in (line.target, *refs_in(line.value))
        if r.offset is not None
    }
    return Assign(places.get(line.target, line.target), line.value.xreplace(places))


def _named(name: str, taken: set[str], length: int | None = None) -> Variable:
    number, unique = 2, name
    while unique in taken:
        unique, number = f"{name}_{number}", number + 1
    taken.add(unique)
    return Variable(
        unique,
        Role.WORK if length else Role.LOCAL,
        length,
        "share of its neighbour's unknown in a station's own",
    )
