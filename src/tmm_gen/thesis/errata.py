"""The thesis's printed coefficients beside the derived ones, and what each disagreement does."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from itertools import combinations

import numpy as np
import sympy as sp

from tmm_gen.derive.integrators.declaration import Integrator
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.derive.integrators.relations import DiscreteCoefficients, discrete_coefficients
from tmm_gen.thesis.response import Response, exact_tip, settling_time, simulate
from tmm_gen.thesis.tables import PRINTED_B, TABLES, PrintedTable

COEFFICIENTS = ("A", "B", "D", "E")
STEP_OF_EFFECTS = 0.1
"""Seconds; the step at which the thesis's curves are reproduced."""


@dataclass(frozen=True)
class ErratumRow:
    """One printed coefficient.

    Parameters
    ----------
    table, coefficient : str
        Number in the thesis; "A", "B", "D" or "E".
    printed, derived : sympy.Expr
        In the symbols of :mod:`tmm_gen.thesis.tables`.
    agrees : bool
        They are equal for every step, history and parameter.
    effect : str
        What replacing this coefficient alone does to the two-station sample at a step of 0.1 s.
    rms_error : float
        Of the tip over 20 s with it replaced, relative to the static deflection; infinite if it diverges.
    derived_rms_error : float
        The same with the derived coefficient.
    note : str
        Where the text prints the same coefficient otherwise.
    """

    table: str
    coefficient: str
    printed: sp.Expr
    derived: sp.Expr
    agrees: bool
    effect: str
    rms_error: float
    derived_rms_error: float
    note: str


@dataclass(frozen=True)
class Headline:
    """What table 3-8 as printed makes of the proposed method: the thesis reports that it settles after 3 s.

    Parameters
    ----------
    step : float
        Seconds.
    printed, derived : Response
        Of the sample, with all of table 3-8 as printed and as derived.
    exact_settling_time : float
        Seconds until the exact response stays within 5 % of the static deflection.
    cause : tuple of str
        The fewest printed coefficients that give the same response as the whole printed table.
    """

    step: float
    printed: Response
    derived: Response
    exact_settling_time: float
    cause: tuple[str, ...]


def printed_table(number: str) -> PrintedTable:
    """Return a table of coefficients as the thesis prints it.

    Parameters
    ----------
    number : str
        "3-1" or "3-3" to "3-8".

    Raises
    ------
    ValueError
        If the thesis has no such table of coefficients.
    """
    for table in TABLES:
        if table.number == number:
            return table
    raise ValueError(f"no table of coefficients {number!r}; there are {', '.join(t.number for t in TABLES)}")


def derived_coefficients(table: str) -> DiscreteCoefficients:
    """Return what a table should print, in the same open parameters."""
    printed = printed_table(table)
    method = integrator(printed.integrator, **printed.parameters)
    return discrete_coefficients(method.schemes[printed.scheme])


def errata_rows() -> tuple[ErratumRow, ...]:
    """Return one row for each printed coefficient, in the order of the thesis."""
    return tuple(_row(table, name) for table in TABLES for name in COEFFICIENTS)


def headline(step: float) -> Headline:
    """Run the proposed method with all of table 3-8 as printed, and find the coefficients to blame.

    Parameters
    ----------
    step : float
        Seconds; a divisor of 20 s.
    """
    table = printed_table("3-8")
    method = integrator(table.integrator)

    def with_printed(chosen: tuple[str, ...]) -> Response:
        return simulate(method, step, {table.scheme: {name: table.coefficients[name] for name in chosen}})

    whole = with_printed(COEFFICIENTS)
    cause = next(
        chosen
        for count in range(len(COEFFICIENTS) + 1)
        for chosen in combinations(COEFFICIENTS, count)
        if _same(with_printed(chosen), whole)
    )
    return Headline(
        step=step,
        printed=whole,
        derived=simulate(method, step),
        exact_settling_time=settling_time(exact_tip(step), step),
        cause=cause,
    )


def _row(table: PrintedTable, name: str) -> ErratumRow:
    derived = derived_coefficients(table.number)
    printed, expected = table.coefficients[name], getattr(derived, name)
    complete = printed.subs(PRINTED_B, derived.B)
    agrees = sp.simplify(complete - expected) == 0
    reference = _reference(table.integrator)
    changed = reference
    if not agrees:
        method = integrator(table.integrator)
        values = {symbol: method.parameters[key] for key, symbol in table.parameters.items()}
        changed = simulate(method, STEP_OF_EFFECTS, {table.scheme: {name: complete.subs(values)}})
    return ErratumRow(
        table=table.number,
        coefficient=name,
        printed=printed,
        derived=expected,
        agrees=agrees,
        effect="none" if agrees else _effect(changed, reference),
        rms_error=changed.rms_error,
        derived_rms_error=reference.rms_error,
        note=table.notes.get(name, ""),
    )


def _effect(changed: Response, reference: Response) -> str:
    """Say in words what a replaced coefficient does."""
    if changed.diverged_at is not None:
        return f"diverges (|tip| > 1e6 rad at t = {changed.diverged_at:.1f} s)"
    error = (
        f"RMS error {changed.rms_error:#.2g} of the static deflection (derived: {reference.rms_error:#.2g})"
    )
    if changed.settling_time == reference.settling_time:
        return error
    if np.isinf(changed.settling_time):
        return f"{error}, ends at {changed.final:.3g} of it and does not settle within 20 s"
    return f"{error}, settles in {changed.settling_time:.1f} s instead of {reference.settling_time:.1f} s"


def _same(one: Response, other: Response) -> bool:
    return one.tip.shape == other.tip.shape and bool(np.allclose(one.tip, other.tip, rtol=0, atol=1e-9))


@cache
def _reference(name: str) -> Response:
    """Return the response with all coefficients derived."""
    method: Integrator = integrator(name)
    return simulate(method, STEP_OF_EFFECTS)
