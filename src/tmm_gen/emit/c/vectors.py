"""Test vectors: what the program gives in 30 digits, and how far rounding can take a kernel from it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from decimal import ROUND_CEILING, Context
from typing import Any

import mpmath
import numpy as np

from tmm_gen.c_language.names import element_name
from tmm_gen.c_language.real import FLOAT, Real
from tmm_gen.emit.c.estimate import FUNCTIONS, Estimate, estimate_of
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.emit.c.pair import is_pair, pair_literal, parts
from tmm_gen.program.evaluate import Values, allocate, execute, key
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
    origin : Start
        Where it starts.
    """

    start: tuple[tuple[str, str], ...]
    steps: tuple[Step, ...]
    state: tuple[Expected, ...]
    origin: Start


@dataclass(frozen=True)
class Start:
    """Where a simulation starts, and how strongly it is driven.

    Parameters
    ----------
    spread : int
        An eighth of it divides the inputs.
    bent : bool
        Whether stations start at random, divided by `spread`; at rest otherwise.
    """

    spread: int
    bent: bool = True

    def value(self, j: int) -> float:
        """Return where station ``j`` starts, angle and rate: the same formula stands in the template."""
        return ((7 * j + 3) % 16 - 8) / self.spread if self.bent else 0.0

    def input(self, which: int, k: int, stage: int) -> float:
        """Return an input at a stage of step ``k``, a number that every type holds exactly."""
        return ((5 * k + 3 * which + 2 * stage + 1) % 9 - 4) / (self.spread / 8)


_SPREADS = (64, 4096, 2**18, 2**24)
STARTS = (
    *(Start(spread) for spread in _SPREADS),
    *(Start(spread, bent=False) for spread in (*_SPREADS, 2**40)),
    *(Start(spread) for spread in (2**40, 2**60)),
)
"""From lively to gentle: neither a stiff arm nor one of many links survives being bent at random.

At rest the arm grows into its motion under its inputs and its weight. What has neither does not move then, so that the
last starts are bent again, by next to nothing.
"""
WORTHLESS = 1e-3
"""Share of its size beyond which a bound of rounding tells nothing."""


def vectors(kernel: Kernel) -> Vectors | None:
    """Simulate a program in 30 digits with parameters rounded to the kernel's number type.

    Returns
    -------
    Vectors or None
        None if from no start a few steps can be taken within the range of the number type.
    """
    program, real = kernel.source, kernel.real
    shown = [ref for v in program.state for ref in _shown(v)]
    best: _Motion | None = None
    for start in STARTS:
        if not _solvable(program, real, start):
            continue
        motion = _motion(program, real, shown, start)
        if motion is not None:
            best = motion
            if _telling(motion.records, motion.tolerance):
                break
    return _written(program, real, shown, best) if best else None


@dataclass(frozen=True)
class _Motion:
    """A simulation from a start, and what rounding explains."""

    start: Start
    records: list[dict[Ref, Estimate]]
    tolerance: dict[Variable, float]


def _motion(program: Program, real: Real, shown: list[Ref], start: Start) -> _Motion | None:
    """Return the motion from a start; None if it cannot be computed in the number type."""
    try:
        records = _simulate(program, real, shown, start)
        tolerance = _tolerances(records, real)
    except (ArithmeticError, ValueError):  # a pivot, a division, a number beyond all bounds
        return None
    largest = max((abs(estimate.value) for record in records for estimate in record.values()), default=0)
    bounds = (*tolerance.values(), largest)
    return _Motion(start, records, tolerance) if all(b < real.largest for b in bounds) else None


def _solvable(program: Program, real: Real, start: Start) -> bool:
    """Whether plain numbers get through the motion: a quick look before the long one."""
    try:
        _run(program, lambda value: real.round(float(value)), "math", start, lambda values: None)
    except (ArithmeticError, ValueError):
        return False
    return True


def _written(program: Program, real: Real, shown: list[Ref], motion: _Motion) -> Vectors:
    """Write a motion as literals."""
    start, records, tolerance = motion.start, motion.records, motion.tolerance

    def expected(ref: Ref, record: dict[Ref, Estimate]) -> Expected:
        pair = real.pair and is_pair(ref.variable)
        value = _literal(record[ref].value, real, pair)
        return Expected(element_name(ref, program.name), value, real.literal(tolerance[ref.variable]))

    steps = tuple(
        Step(_inputs(program, k + 1, start, real), tuple(expected(v.ref, record) for v in program.outputs))
        for k, record in enumerate(records)
    )
    state = tuple(expected(ref, records[-1]) for ref in shown)
    return Vectors(_inputs(program, 0, start, real), steps, state, start)


def _telling(records: list[dict[Ref, Estimate]], tolerance: dict[Variable, float]) -> bool:
    """Whether the bounds of rounding are small beside the largest value of each variable."""
    size: dict[Variable, float] = {}
    for record in records:
        for ref, estimate in record.items():
            size[ref.variable] = max(size.get(ref.variable, 0.0), abs(float(estimate.value)))
    return all(bound <= WORTHLESS * size[variable] for variable, bound in tolerance.items() if size[variable])


def _simulate(program: Program, real: Real, shown: list[Ref], start: Start) -> list[dict[Ref, Estimate]]:
    """Return outputs after every step, and the state that is shown."""

    def number(value: float) -> Estimate:
        return Estimate(mpmath.mpf(sum(parts(value)) if real.pair else real.round(value)))

    wanted = (*(v.ref for v in program.outputs), *shown)
    records = []

    def record(values: Values) -> None:
        records.append({ref: _value(values, ref) for ref in wanted})

    with mpmath.workdps(DIGITS), np.errstate(all="ignore"):  # of motion without bounds, which holds no test
        _run(program, number, FUNCTIONS, start, record)
    return records


def _run(
    program: Program,
    number: Callable[[float], Any],
    modules: Any,
    start: Start,
    record: Callable[[Values], None],
) -> None:
    """Take the steps in a type of number; `record` sees the values after each."""
    variables = (program.step, *program.parameters, *program.state, *program.inputs, *program.outputs)
    values = allocate(variables, number)
    for given in program.given:
        values[given.name] = [number(start.value(j)) for j in range(given.length or 1)]
    _apply(program, values, 0, start, number)
    for routine in (program.prepare, program.initialise):
        execute(routine, values, number, modules)
    for k in range(len(program.startup) + STEPS):
        _apply(program, values, k + 1, start, number)
        for routine in (program.steps[min(k, len(program.startup))], program.output):
            execute(routine, values, number, modules)
        record(values)


def _apply(program: Program, values: Values, k: int, start: Start, number: Callable[[float], Any]) -> None:
    for which, variable in enumerate(program.inputs):
        numbers = [number(start.input(which, k, stage)) for stage in range(variable.length or 1)]
        values[key(variable)] = numbers[0] if variable.length is None else numbers


def _inputs(program: Program, k: int, start: Start, real: Real) -> tuple[tuple[str, str], ...]:
    members = [
        (which, stage, variable.entry(stage))
        for which, variable in enumerate(program.inputs)
        for stage in range(variable.length or 1)
    ]
    return tuple(
        (element_name(ref, program.name), real.literal(start.input(which, k, stage)))
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
    # below the smallest normal number roundings are absolute
    bounds = {v: max(_SAFETY * unit * (largest or 1.0), real.smallest) for v, largest in error.items()}
    if real.pair:  # what callers get is rounded, and so is what it is compared with
        for ref, estimate in (item for record in records for item in record.items()):
            if not is_pair(ref.variable):
                bounds[ref.variable] = max(bounds[ref.variable], FLOAT.epsilon * abs(float(estimate.value)))
    return {v: _two_digits_up(bound) for v, bound in bounds.items()}


def _two_digits_up(value: float) -> float:
    return float(Context(prec=2, rounding=ROUND_CEILING).create_decimal(value))


def _literal(value: Any, real: Real, pair: bool) -> str:
    """Write a reference value; what the type cannot tell from zero is zero."""
    number = 0.0 if abs(value) < FLOAT.smallest else float(value)
    return f"(pair){pair_literal(number)}" if pair else real.literal(number)
