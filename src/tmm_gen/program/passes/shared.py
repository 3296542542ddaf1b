"""What two walks compute alike: the later one takes arrays that are there already.

A sweep about motion at which another walk has been needs the same levers and accelerations of nodes. What both set by
the same lines, of nothing that differs, stays with the earlier one.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import replace

from tmm_gen.program.statements import Assign, Loop, Order, Require, Section, Statement
from tmm_gen.program.variables import Ref, Variable, refs_in

_Place = tuple[Order, int, int, int] | None
"""Which stations a loop visits, and how; None outside loops."""


def shared_arrays(earlier: Sequence[Section], later: Sequence[Section]) -> frozenset[Variable]:
    """Return the arrays that both write alike.

    Parameters
    ----------
    earlier, later : sequence of Section
        Of one form: what is set under one name in both is one thing, if all that it is set by is the same.
    """
    there, here = _settings(earlier), _settings(later)
    alike = {v for v in here if there.get(v) == here[v]}
    while True:
        apart = {
            v
            for v in alike
            if any(
                r.variable in here and r.variable not in alike for _, s in here[v] for r in refs_in(s.value)
            )
        }
        if not apart:
            return frozenset(v for v in alike if v.length is not None)
        alike -= apart


def taken_over(
    sections: Sequence[Section], shared: frozenset[Variable], place: Callable[[Ref], Ref]
) -> list[Section]:
    """Return sections that read shared arrays where others have written them.

    Parameters
    ----------
    shared : frozenset of Variable
        What they do not write any more.
    place : callable
        Says where what a reference means is found.
    """

    def lines(statements: Sequence[Statement]) -> list[Statement]:
        found: list[Statement] = []
        for statement in statements:
            if isinstance(statement, Loop):
                body = lines(statement.body)
                if body:
                    found.append(replace(statement, body=tuple(body)))  # type: ignore[arg-type]
            elif isinstance(statement, Assign | Require):
                if isinstance(statement, Assign) and statement.target.variable in shared:
                    continue
                there = {ref: place(ref) for ref in refs_in(statement.value)}
                found.append(replace(statement, value=statement.value.xreplace(there)))
            else:
                found.append(statement)
        return found

    return [replace(s, statements=tuple(lines(s.statements))) for s in sections]


def _settings(sections: Sequence[Section]) -> dict[Variable, list[tuple[_Place, Assign]]]:
    found: dict[Variable, list[tuple[_Place, Assign]]] = defaultdict(list)
    for section in sections:
        for top in section.statements:
            place = (top.order, top.start, top.stop, top.stride) if isinstance(top, Loop) else None
            for inner in top.body if isinstance(top, Loop) else (top,):
                if isinstance(inner, Assign):
                    found[inner.target.variable].append((place, inner))
    return found
