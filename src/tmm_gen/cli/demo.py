"""`tmm-gen demo`: the thesis's samples and integrators, in one table and one picture."""

from __future__ import annotations

from pathlib import Path

import click

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.cli.outputs import write_outputs

# NumPy, SymPy and Matplotlib are imported inside: `tmm-gen --help` has no use for them.

_COLUMNS: list[Column | str] = [
    "scene",
    "integrator",
    Column("step", "step (s)", "g"),
    Column("error", "RMS error", ".1e"),
    Column("peak", "peak (rad)", ".4f"),
    Column("settling_time", "settles (s)", ".2f"),
    Column("c_against_numpy", "C - NumPy", ".0e"),
    Column("ns_per_step", "C: ns per step", ".0f"),
    Column("ns_spread", "± (%)", lambda share: "" if share is None else f"{100 * share:.0f}"),
    Column("operations_per_station", "operations per station", ".0f"),
]


@click.command("demo")
@click.option(
    "--out",
    type=click.Path(file_okay=False, path_type=Path),
    default=Path("out/demo"),
    show_default=True,
    help="Folder for kernels, table and picture; made if missing.",
)
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def demo(out: Path, json_mode: bool) -> None:
    """Build, run and compare the thesis's two samples with its five integrators.

    Every kernel runs in NumPy and, compiled, in C. The error is that of the tip angle against the matrix
    exponential, relative to the static deflection; settled is what stays within 2 % of it. Times are medians of nine
    rounds in which all kernels take turns, with half the distance of the quartiles.
    """
    with progress("deriving", total=10) as advance:
        from tmm_gen.csv_text import csv_text
        from tmm_gen.report.demo import THESIS_STEP, run_demo
        from tmm_gen.report.demo_picture import demo_picture

        found = run_demo(advance)
        image = demo_picture(found.samples)
    files = {
        "picture": out / "thesis.png",
        "table": out / "thesis.csv",
        "kernels": out / "kernels",
    }
    kernels = {out / path: text for path, text in found.kernels.items()}
    write_outputs({**kernels, files["table"]: csv_text(found.rows), files["picture"]: image})
    table(found.rows, _COLUMNS, json_mode, title="Samples of Gholampour (2018), 1 N m on the tip", more=files)
    if not json_mode:
        click.echo(f"'zhou as printed' has the coefficients of table 3-8; at a step of {THESIS_STEP:g} s")
        for what, path in files.items():
            click.echo(f"{what}: {path}")
