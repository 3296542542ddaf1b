"""`tmm-gen errata`: the thesis's printed coefficients beside the derived ones."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from tmm_gen.cli.console import progress, table

if TYPE_CHECKING:
    import sympy as sp

    from tmm_gen.thesis.errata import ErratumRow

# SymPy and SciPy are imported inside: `tmm-gen --help` has no use for them.


@click.command("errata")
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def errata(json_mode: bool) -> None:
    """Compare what Gholampour (2018) prints with the derived.

    That is every coefficient of tables 3-1 and 3-3 to 3-8, and the transfer functions 2-90 to 2-100. The effect is
    what that entry alone, as printed, does to the thesis's two-station sample (at a step of 0.1 s).
    """
    with progress("deriving"):
        from tmm_gen.thesis.errata import STEP_OF_EFFECTS, errata_rows, headline
        from tmm_gen.thesis.errata_frequency import frequency_errata_rows

        rows = [_row(row) for row in (*frequency_errata_rows(), *errata_rows())]
        whole = headline(STEP_OF_EFFECTS)
    finding = (
        f"All of table 3-8 as printed settles in {whole.printed.settling_time:.1f} s "
        f"at h = {whole.step:g} s instead of {whole.exact_settling_time:.1f} s: "
        f"the cause is {' and '.join(whole.cause)} together."
    )
    table(
        rows,
        ["table", "coefficient", "printed", "derived", "agrees", "effect", "note"],
        json_mode,
        title=f"Gholampour (2018); effect on its two-station sample at h = {STEP_OF_EFFECTS:g} s",
        more={"headline": finding},
    )
    if not json_mode:
        click.echo(finding)


def _row(row: ErratumRow) -> dict[str, object]:
    return {
        "table": row.table,
        "coefficient": row.coefficient,
        "printed": _readable(row.printed),
        "derived": _readable(row.derived),
        "agrees": row.agrees,
        "effect": row.effect,
        "rms_error": row.rms_error,
        "derived_rms_error": row.derived_rms_error,
        "note": row.note,
    }


def _readable(expression: sp.Expr) -> str:
    """Write history as ``q[i-1]``, as the thesis counts steps."""
    import sympy as sp

    from tmm_gen.derive.integrators.declaration import past, pasts_in

    names = {past(p.kind, p.lag): sp.Symbol(f"{p.kind}[i-{p.lag + 1}]") for p in pasts_in(expression)}
    return str(expression.subs(names)).replace("**", "^")
