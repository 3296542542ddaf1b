"""`tmm-gen demo`: an arm in motion and what its accuracy costs, or the thesis's samples and integrators."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.cli.outputs import OutputFolder, write_outputs

if TYPE_CHECKING:
    from tmm_gen.report.arm_demo import ArmDemo

# NumPy, SymPy and Matplotlib are imported inside: `tmm-gen --help` has no use for them.

_ARM_COLUMNS: list[Column | str] = [
    "integrator",
    Column("step", "step (ms)", lambda step: f"{1e3 * step:g}"),
    Column("error", "error (mm)", ".1e"),
    Column("step_time", "C: µs per step", ".2f"),
    Column("time", "C: ms per second of motion", ".3f"),
    Column("faster", "times faster than the arm", ".0f"),
]
_ERROR = 0.01
"""mm; the accuracy whose cost is told in words."""

_THESIS_COLUMNS: list[Column | str] = [
    "scene",
    "integrator",
    Column("step", "step (s)", "g"),
    Column("error", "RMS error", ".1e"),
    Column("peak", "peak (rad)", ".4f"),
    Column("settling_time", "within 2 % after (s)", ".2f"),
    Column("c_against_numpy", "C - NumPy", ".0e"),
    Column("ns_per_step", "C: ns per step", ".0f"),
    Column("ns_spread", "± (%)", lambda share: "" if share is None else f"{100 * share:.0f}"),
    Column("operations_per_station", "operations per station", ".0f"),
]


@click.command("demo")
@click.option(
    "--out",
    type=OutputFolder(),
    default=Path("out/demo"),
    show_default=True,
    help="Folder for kernels, table and picture; made if missing.",
)
@click.option(
    "--thesis", is_flag=True, help="The MSc thesis's two samples with its five integrators instead."
)
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def demo(out: Path, thesis: bool, json_mode: bool) -> None:
    """Build an arm of two flexible beams, lift its payload, and measure what accuracy costs.

    The arm of scenes/elbow.toml runs as compiled C with three integrators at several steps. The error is the
    payload's largest distance from where SciPy finds it, on equations written without the generator. Times are
    medians of nine rounds in which all kernels take turns.

    With --thesis, every kernel runs in NumPy and, compiled, in C. The error is that of the tip angle against the
    matrix exponential, relative to the static deflection; settled is what stays within 2 % of it.
    """
    (_thesis if thesis else _arm)(out, json_mode)


def _arm(out: Path, json_mode: bool) -> None:
    with progress("building", total=5) as advance:
        from tmm_gen.csv_text import csv_text
        from tmm_gen.report.arm_demo import run_arm_demo
        from tmm_gen.report.arm_demo_picture import arm_demo_picture

        found = run_arm_demo(advance)
        image = arm_demo_picture(found, _ERROR)
    rows = [{**asdict(point), "faster": point.faster} for point in found.points]
    files = {"picture": out / "arm.png", "table": out / "arm.csv", "kernels": out / "generated"}
    kernels = {out / path: text for path, text in found.files.items()}
    write_outputs({**kernels, files["table"]: csv_text(rows), files["picture"]: image})
    table(rows, _ARM_COLUMNS, json_mode, title=f"{found.scene.title}: the payload lifted in 1 s", more=files)
    if not json_mode:
        click.echo(_in_words(found))
        for what, path in files.items():
            click.echo(f"{what}: {path}")


def _in_words(found: ArmDemo) -> str:
    """Say what the accuracy costs each integrator, the cheapest first."""
    told = [f"{time:.2f} ms with {name}" for name, time in found.times_for(_ERROR).items()]
    return f"for an error of {_ERROR:g} mm, a second of motion takes " + ", ".join(told)


def _thesis(out: Path, json_mode: bool) -> None:
    with progress("deriving", total=10) as advance:
        from tmm_gen.csv_text import csv_text
        from tmm_gen.report.thesis_picture import thesis_picture
        from tmm_gen.report.thesis_samples import THESIS_STEP, run_thesis_samples

        found = run_thesis_samples(advance)
        image = thesis_picture(found.samples)
    files = {
        "picture": out / "thesis.png",
        "table": out / "thesis.csv",
        "kernels": out / "kernels",
    }
    kernels = {out / path: text for path, text in found.kernels.items()}
    write_outputs({**kernels, files["table"]: csv_text(found.rows), files["picture"]: image})
    table(
        found.rows,
        _THESIS_COLUMNS,
        json_mode,
        title="Samples of Gholampour (2018), 1 N m on the tip",
        more=files,
    )
    if not json_mode:
        click.echo(f"'zhou as printed' has the coefficients of table 3-8; at a step of {THESIS_STEP:g} s")
        for what, path in files.items():
            click.echo(f"{what}: {path}")
