"""`tmm-gen check`: every backend of a scene against the others and against the exact response."""

from __future__ import annotations

from pathlib import Path

import click

from tmm_gen.cli.console import Column, progress, table

# NumPy, SymPy and CasADi are imported inside: `tmm-gen --help` has no use for them.

_COLUMNS: list[Column | str] = [
    Column("check", form=lambda value: str(value).replace("_", " ")),
    Column("value", form=".2g"),
    Column("bound", "at most", ".2g"),
    Column("passed", "holds"),
    "meaning",
]


@click.command("check")
@click.argument("scene", metavar="SCENE", type=click.Path(path_type=Path))
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def check(scene: Path, json_mode: bool) -> int:
    """Compile SCENE's C and compare every backend with the others and with the exact response.

    The exact response is the matrix exponential of the assembled matrices of the chain, written
    independently of the derivation. Exits with 1 if a comparison exceeds its bound.
    """
    from tmm_gen.scene import load_scene

    loaded = load_scene(scene)
    with progress(f"checking {loaded.name}", total=1.0) as advance:
        from tmm_gen.measure.check import check_scene

        report = check_scene(loaded, advance)
    rows = [
        {
            "check": row.check,
            "value": row.value,
            "bound": row.bound,
            "passed": row.passed,
            "meaning": row.meaning,
        }
        for row in report.rows
    ]
    facts = {"scene": loaded.name, "passed": report.passed, **report.facts}
    table(rows, _COLUMNS, json_mode, title=f"{loaded.title} ({loaded.integrator.name})", more=facts)
    if not json_mode:
        if "ns_per_step" in report.facts:
            click.echo(
                f"one step takes {report.facts['ns_per_step']:.0f} ns in C on this machine, "
                f"{report.facts['operations_per_step']} floating-point operations"
            )
        click.echo("everything holds" if report.passed else "NOT everything holds: see the rows marked 'no'")
    return 0 if report.passed else 1
