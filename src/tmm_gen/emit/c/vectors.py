"""Test vectors: what the program gives in 30 digits, and how far rounding can take a kernel from it."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import mpmath

from tmm_gen.emit.c.estimate import FUNCTIONS, Estimate, estimate_of
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.emit.c.pair import is_pair, pair_literal, parts
from tmm_gen.emit.c.real import FLOAT, Real
from tmm_gen.emit.c_names import element_name
from tmm_gen.program.evaluate import Values, VanishingPivotError, allocate, execute, key
from tmm_gen.program.statements import Program
from tmm_gen.program.variables import Ref, Variable

DIGITS = 30
STEPS = 3
"""Steps after the start-up."""
SHOWN = 10
"""Stations whose state is compared, spread from base to tip."""
_SAFETY = 8.0
"""By how much rounding errors may exceed the largest of their samples."""


@dataclass(frozen=True)
class Expected:
    """A number to compare.

    Parameters
    ----------
    what : str
        Its name in C, behind ``state.`` or ``outputs.``.
    value : str
        Literal.
    tolerance : str
        Literal: how far it may be off.
    """

    what: str
    value: str
    tolerance: str


@dataclass(frozen=True)
class Step:
    """One step of the test: inputs as (member, literal), outputs after it."""

    inputs: tuple[tuple[str, str], ...]
    outputs: tuple[Expected, ...]


@dataclass(frozen=True)
class Vectors:
    """A short simulation.

    Parameters
    ----------
    start : tuple of (str, str)
        Members of the input and literals at the initial instant.
    steps : tuple of Step
        In order.
    state : tuple of Expected
        After the last.
    spread : int
        Divisor of the initial values, and an eighth of it that of the inputs.
    """

    start: tuple[tuple[str, str], ...]
    steps: tuple[Step, ...]
    state: tuple[Expected, ...]
    spread: int


SPREADS = (64, 4096, 2**18, 2**24)
"""Divisors of the initial values, from lively to gentle: a stiff arm does not survive being bent at random."""
WORTHLESS = 1e-3
"""Share of its size beyond which a bound of rounding tells nothing."""


def vectors(kernel: Kernel) -> Vectors:
    """Simulate a program in 30 digits with parameters rounded to the kernel's number type."""
    program, real = kernel.source, kernel.real
    shown = [ref for v in program.state for ref in _shown(v)]
    for spread in SPREADS:
        with suppress(VanishingPivotError):
            records = _simulate(program, real, shown, spread)
            tolerance = _tolerances(records, real)
            if spread == SPREADS[-1] or _telling(records, tolerance):
                break
    else:
        raise ArithmeticError(f"{program.name}: no initial state leads to a step that can be solved")

    def expected(ref: Ref, record: dict[Ref, Estimate]) -> Expected:
        pair = real.pair and is_pair(ref.variable)
        value = _literal(record[ref].value, real, pair)
        return Expected(element_name(ref, program.name), value, real.literal(tolerance[ref.variable]))

    steps = tuple(
        Step(_inputs(program, k + 1, spread, real), tuple(expected(v.ref, record) for v in program.outputs))
        for k, record in enumerate(records)
    )
    state = tuple(expected(ref, records[-1]) for ref in shown)
    return Vectors(_inputs(program, 0, spread, real), steps, state, spread)


def _telling(records: list[dict[Ref, Estimate]], tolerance: dict[Variable, float]) -> bool:
    """Whether the bounds of rounding are small beside the largest value of each variable."""
    size: dict[Variable, float] = {}
    for record in records:
        for ref, estimate in record.items():
            size[ref.variable] = max(size.get(ref.variable, 0.0), abs(float(estimate.value)))
    return all(bound <= WORTHLESS * size[variable] for variable, bound in tolerance.items() if size[variable])


def initial_value(j: int, spread: int) -> float:
    """Return where station ``j`` starts, angle and rate: the same formula stands in the template."""
    return ((7 * j + 3) % 16 - 8) / spread


def _simulate(program: Program, real: Real, shown: list[Ref], spread: int) -> list[dict[Ref, Estimate]]:
    """Return outputs after every step, and the state that is shown."""

    def number(value: float) -> Estimate:
        return Estimate(mpmath.mpf(sum(parts(value)) if real.pair else real.round(value)))

    with mpmath.workdps(DIGITS):
        variables = (program.step, *program.parameters, *program.state, *program.inputs, *program.outputs)
        values = allocate(variables, number)
        for given in program.given:
            values[given.name] = [number(initial_value(j, spread)) for j in range(given.length or 1)]
        _apply(program, values, 0, spread, number)
        for routine in (program.prepare, program.initialise):
            execute(routine, values, number, FUNCTIONS)
        records = []
        for k in range(len(program.startup) + STEPS):
            _apply(program, values, k + 1, spread, number)
            for routine in (program.steps[min(k, len(program.startup))], program.output):
                execute(routine, values, number, FUNCTIONS)
            records.append({ref: _value(values, ref) for ref in (*(v.ref for v in program.outputs), *shown)})
        return records


def _apply(
    program: Program, values: Values, k: int, spread: int, number: Callable[[float], Estimate]
) -> None:
    for which, variable in enumerate(program.inputs):
        numbers = [number(_input(which, k, stage, spread)) for stage in range(variable.length or 1)]
        values[key(variable)] = numbers[0] if variable.length is None else numbers


def _input(which: int, k: int, stage: int, spread: int) -> float:
    """Return an input at a stage of step ``k``, a number that every type holds exactly."""
    return ((5 * k + 3 * which + 2 * stage + 1) % 9 - 4) / (spread / 8)


def _inputs(program: Program, k: int, spread: int, real: Real) -> tuple[tuple[str, str], ...]:
    members = [
        (which, stage, variable.entry(stage))
        for which, variable in enumerate(program.inputs)
        for stage in range(variable.length or 1)
    ]
    return tuple(
        (element_name(ref, program.name), real.literal(_input(which, k, stage, spread)))
        for which, stage, ref in members
    )


def _shown(variable: Variable) -> list[Ref]:
    if variable.length is None:
        return [variable.ref]
    last = variable.length - 1
    entries = {round(k * last / (SHOWN - 1)) for k in range(SHOWN)}
    return [variable.entry(k) for k in sorted(entries)]


def _value(values: Values, ref: Ref) -> Estimate:
    held = values[key(ref.variable)]
    return estimate_of(held if ref.variable.length is None else held[ref.entry])


def _tolerances(records: list[dict[Ref, Estimate]], real: Real) -> dict[Variable, float]:
    """Return, for each variable, what rounding explains."""
    error: dict[Variable, float] = {}
    for record in records:
        for ref, estimate in record.items():
            error[ref.variable] = max(error.get(ref.variable, 0.0), estimate.error)
    unit = real.epsilon / 2
    bounds = {v: _SAFETY * unit * (largest or 1.0) for v, largest in error.items()}
    if real.pair:  # what callers get is rounded, and so is what it is compared with
        for ref, estimate in (item for record in records for item in record.items()):
            if not is_pair(ref.variable):
                bounds[ref.variable] = max(bounds[ref.variable], FLOAT.epsilon * abs(float(estimate.value)))
    return {v: _two_digits_up(bound) for v, bound in bounds.items()}


def _two_digits_up(value: float) -> float:
    exponent = math.floor(math.log10(value)) - 1
    return float(f"{math.ceil(value / 10.0**exponent)}e{exponent}")


def _literal(value: Any, real: Real, pair: bool) -> str:
    """Write a reference value; what the type cannot tell from zero is zero."""
    number = 0.0 if abs(value) < 2.0**-126 else float(value)
    return f"(pair){pair_literal(number)}" if pair else real.literal(number)
