"""`tmm-gen integrators`: what is derived about each integrator."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.console import Column, progress, table

if TYPE_CHECKING:
    import sympy as sp

# SymPy is imported inside: `tmm-gen --help` has no use for it.


def _finite(_context: click.Context, _parameter: click.Parameter, value: float) -> float:
    if math.isnan(value):
        raise click.BadParameter("must be a number from 0 to less than 1")
    return value


@click.command("integrators")
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
@click.option(
    "--zeta",
    type=click.FloatRange(0, 1, max_open=True),
    callback=_finite,
    default=0.05,
    show_default=True,
    help="Physical damping ratio of the damped stability limit.",
)
def integrators(json_mode: bool, zeta: float) -> None:
    """Show order, stability and dissipation of every integrator, derived from its declaration."""
    from tmm_gen.api.integrators import derived
    from tmm_gen.derive.integrators.registry import names

    with progress("deriving", total=len(names())) as advance:
        found = derived(zeta, advance=lambda name: advance(1, doing=f"derived {name}"))
    rows = found.rows
    if not json_mode:
        for row, analysis in zip(rows, found, strict=True):
            row |= {key: _rounded(getattr(analysis, key)) for key in ("period_error", "numerical_damping")}
    table(
        rows,
        [
            Column("name", "integrator"),
            "order",
            "stages",
            Column("startup_steps", "start-up"),
            Column("history_depth", "history"),
            "explicit",
            Column("stability_limit", "limit of Ω", _limit, "right"),
            Column("stability_limit_damped", f"limit at ζ = {zeta:g}", _limit, "right"),
            Column("rho_infinity", "ρ at infinity", _radius, "right"),
            Column("period_error", justify="left"),
            Column("numerical_damping", justify="left"),
        ],
        json_mode,
        title="Ω = frequency in rad/s times step; period error and numerical damping ratio: leading terms",
        more={"zeta": zeta},
    )


def _rounded(term: sp.Expr) -> str:
    """Return a leading term with a rounded coefficient."""
    from tmm_gen.derive.integrators.amplification import OMEGA

    coefficient, power = term.as_coeff_exponent(OMEGA)
    if coefficient == 0:
        return "0"
    return f"{float(coefficient):.3g} Ω" + (f"^{power}" if power != 1 else "")


def _limit(value: float) -> str:
    if value == 0:
        return "unstable"
    return "none" if math.isinf(value) else f"{value:.4g}"


def _radius(value: float) -> str:
    return "grows" if math.isinf(value) else f"{value:.3g}"
