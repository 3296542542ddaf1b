"""A sweep outward that looks one station ahead.

A station's unknown follows from the last one's directly and through the change of motion that all before have
brought about: ``u = own - a c + t u``, then ``c = c + s u``. That second way is a chain of two products and two sums or
more from unknown to unknown. With the last station's part of ``c`` put in, ``u = (own - a c) + (t - a s) u``, where the
first bracket needs nothing of the last station and the second is at hand before the sweep begins: the chain is one
product and one sum, at four operations more per station of a planar arm.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import sympy as sp

from tmm_gen.program.passes.dependence import carried_scalars, dead_after
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
            if sweep is not None and all(dead_after(c, tuple(later)) for c in sweep.changes):
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
    unknown : Assign
        What gives the unknown.
    changes : dict from Variable to sympy.Expr
        Sums over stations: what each station adds for one unit of its unknown.
    kept : tuple of Assign
        Copies of the unknown.
    """

    loop: Loop
    unknown: Assign
    changes: dict[Variable, sp.Expr]
    kept: tuple[Assign, ...]

    @classmethod
    def of(cls, loop: Loop) -> _Sweep | None:
        """Return what a loop is made of, or None if it is another."""
        if loop.order is not Order.OUTWARD or loop.stride > 1 or len(loop.visits) < 2:
            return None
        if not all(isinstance(line, Assign) for line in loop.body):
            return None
        first, *rest = (line for line in loop.body if isinstance(line, Assign))
        unknown, carried = first.target, carried_scalars(loop)
        updates = [line for line in rest if line.target.variable in carried]
        kept = tuple(line for line in rest if line.target.variable not in carried)
        changes = {line.target.variable: sp.expand(line.value - line.target) / unknown for line in updates}
        if unknown.variable not in carried or carried != {unknown.variable, *changes} or not changes:
            return None
        if len(changes) < len(updates) or any(
            line.value != unknown or line.target.variable.role is not Role.WORK for line in kept
        ):
            return None
        own = {v.ref for v in carried}
        if any(refs_in(gain) & own or not _fixed(gain, loop) for gain in changes.values()):
            return None
        if not _affine(first.value, own) or not _fixed(first.value, loop, but=own):
            return None
        return cls(loop, first, changes, kept)

    def ahead(self, taken: set[str]) -> list[Statement]:
        """Return the factors of all stations but the first, the first station, and the sweep over the others."""
        target = self.unknown.target
        share = _named(f"{target.variable.name}_passed_on", taken, self.loop.stop)
        before = {v: gain.xreplace(_moved(refs_in(gain), -1)) for v, gain in self.changes.items()}
        value = sp.expand(self.unknown.value)
        direct = sp.Add(value.coeff(target), *(value.coeff(v.ref) * gain for v, gain in before.items()))
        without = value.xreplace({target: sp.S.Zero})
        rest = Variable(
            _named(f"{target.variable.name}_rest", taken).name, Role.LOCAL, doc="", unit=target.variable.unit
        )
        start = self.loop.start
        factors = Loop(Order.OUTWARD, start + 1, self.loop.stop, (Assign(share.at(), direct),))
        body = (
            Assign(rest.ref, without),
            *(Assign(v.ref, v.ref + gain * target) for v, gain in before.items()),
            Assign(target, rest.ref + share.at() * target),
            *self.kept,
        )
        at_first = [_at(line, start) for line in (self.unknown, *self.kept)]
        return [factors, *at_first, Loop(Order.OUTWARD, start + 1, self.loop.stop, body)]


def _fixed(value: sp.Expr, loop: Loop, but: Iterable[Ref] = ()) -> bool:
    """Whether the loop writes nothing of what an expression reads."""
    written = {line.target.variable for line in loop.body if isinstance(line, Assign)}
    return not {ref.variable for ref in refs_in(value) - set(but)} & written


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
