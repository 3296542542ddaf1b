"""A step's tangent by fewer directions than its state has: what is predicted, and inputs.

A step of one stage predicts angles and rates from angles, rates and accelerations, and finds accelerations at which
all is in balance; the motion behind it follows from both, joint by joint. So what it finds, by each of what it is
predicted to do and by each input, says all of its derivative. Where more directions are carried over a step than there
are of these, products with these slopes take less than sweeps.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section, Sensitivities
from tmm_gen.program.variables import Role, Variable, refs_in

_Values = dict[Variable, sp.Expr]
"""Of arrays at any station, by what was found there, what was predicted there, and the state before the step."""


@dataclass(frozen=True)
class Reduced:
    """How a tangent is carried by slopes of what the step finds, by what it is predicted to do and by inputs.

    Parameters
    ----------
    predicted : tuple of Variable
        Arrays of the tangent: with the inputs' changes, all that the step follows.
    answer : Variable
        The part of the state's change that is what the step finds.
    seeds : tuple of tuple of (Variable, sympy.Expr)
        For each that is predicted, the changes of the state before the step, at a station, that make it one there and
        all else zero.
    carry : Routine
        Two sections: from the state's change to what is predicted, and, when what the step finds is known, to the
        state's change behind it.
    """

    predicted: tuple[Variable, ...]
    answer: Variable
    seeds: tuple[tuple[tuple[Variable, sp.Expr], ...], ...]
    carry: Routine


def reduced(found: Sensitivities, stations: int) -> Reduced | None:
    """Return how a tangent is carried by slopes of what it finds; None where that is not as above.

    Parameters
    ----------
    found : Sensitivities
        Of a step, whose tangent is as differentiated.
    stations : int
        Of the arm.
    """
    sections = found.tangent.sections
    if not found.inputs or not sections or any(v.length is not None for v in found.inputs):
        return None
    ahead = sections[0]
    predicted = tuple(sorted(_targets(ahead), key=lambda v: v.name))
    if not _of_every_station(ahead, stations) or not all(v.length == stations for v in found.state):
        return None
    if any(v.role is not Role.WORK for v in predicted) or _reads(sections[1:], found.state):
        return None
    behind = _behind(found, predicted, stations)
    own = _own(ahead, found.state)
    if behind is None or own is None:
        return None
    answer, values = behind
    seeds = _seeds(own, predicted, answer)
    if seeds is None:
        return None
    loop = Loop(Order.OUTWARD, 0, stations, tuple(Assign(v.at(), e) for v, e in values.items()))
    title = "change of: motion at the end of the step"
    carry = Routine("carry", "Carry changes by gathered slopes.", (ahead, Section(title, (loop,))))
    return Reduced(predicted, answer, seeds, carry)


def _targets(section: Section) -> set[Variable]:
    return {a.target.variable for a in Routine("", "", (section,)).assignments()}


def _reads(sections: tuple[Section, ...], variables: tuple[Variable, ...]) -> bool:
    return any(v in Routine("", "", sections).read() for v in variables)


def _of_every_station(section: Section, stations: int) -> bool:
    """Whether a section is one loop over all stations, each by itself."""
    loops = section.statements
    return len(loops) == 1 and all(
        isinstance(s, Loop) and s.parallel and (s.start, s.stop) == (0, stations) for s in loops
    )


def _own(ahead: Section, state: tuple[Variable, ...]) -> _Values | None:
    """Return what is predicted by the state before the step."""
    values: _Values = {}
    for assign in Routine("", "", (ahead,)).assignments():
        values[assign.target.variable] = sp.expand(_in_terms(assign.value, values))
    known = {v.at() for v in state}
    if any(
        r not in known and not r.variable.role.bound_at_prepare for e in values.values() for r in refs_in(e)
    ):
        return None
    return values


def _in_terms(value: sp.Expr, values: Mapping[Variable, sp.Expr]) -> sp.Expr:
    return value.xreplace({r: values[r.variable] for r in refs_in(value) if r.variable in values})


def _behind(
    found: Sensitivities, predicted: tuple[Variable, ...], stations: int
) -> tuple[Variable, _Values] | None:
    """Return which part of the state is what the step finds, and all of it by that and what was predicted.

    What the walks leave at each station is a number of its own each time; loops over all stations say what becomes of
    it.
    """
    values: _Values = {v: v.at() for v in predicted}
    for number, section in enumerate(found.tangent.sections[1:]):
        whole = _of_every_station(section, stations)
        for assign in Routine("", "", (section,)).assignments():
            target = assign.target.variable
            if whole:
                values[target] = sp.expand(_in_terms(assign.value, values))
            elif target.length is not None:
                values[target] = sp.Symbol(f"{target.name} {number}")
    state = {v: values.get(v) for v in found.state}
    if any(e is None for e in state.values()):
        return None
    for answer, whole_answer in state.items():
        if any(r.variable in predicted for r in refs_in(whole_answer)):
            continue
        others = _by_answer(answer, state, predicted)
        if others is not None:
            return answer, others
    return None


def _by_answer(
    answer: Variable, state: Mapping[Variable, sp.Expr | None], predicted: tuple[Variable, ...]
) -> _Values | None:
    """Return the state by one part of it and what was predicted, if it is a multiple of that and these."""
    found: _Values = {}
    terms = state[answer]
    assert terms is not None
    symbols = sorted(terms.free_symbols - set(refs_in(terms)), key=str)
    for variable, value in state.items():
        if variable == answer:
            continue
        assert value is not None
        times = value.coeff(symbols[0]) / terms.coeff(symbols[0]) if symbols else sp.nan
        left = sp.expand(value - times * terms)
        if not all(r.variable in predicted or r.variable.role.bound_at_prepare for r in refs_in(left)):
            return None
        if left.free_symbols - set(refs_in(left)) or not times.is_finite:
            return None
        found[variable] = left + times * answer.at()
    return found


def _seeds(
    own: _Values, predicted: tuple[Variable, ...], answer: Variable
) -> tuple[tuple[tuple[Variable, sp.Expr], ...], ...] | None:
    """Return, for each of what is predicted, changes of the state that make it one and all else zero."""
    moved = [v for v in _state_of(own) if v != answer]
    if len(moved) != len(predicted):
        return None
    matrix = sp.Matrix([[own[p].coeff(s.at()) for s in moved] for p in predicted])
    if matrix.det() == 0:
        return None
    inverse = matrix.inv()
    return tuple(
        tuple((s, inverse[row, column]) for row, s in enumerate(moved) if inverse[row, column] != 0)
        for column in range(len(predicted))
    )


def _state_of(own: _Values) -> list[Variable]:
    found = {r.variable for e in own.values() for r in refs_in(e) if r.variable.role is Role.TANGENT}
    return sorted(found, key=lambda v: v.name)
