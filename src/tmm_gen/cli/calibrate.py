"""`tmm-gen calibrate`: fit numbers of a scene to a recorded response."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import click

from tmm_gen.cli.changes import changed_scene
from tmm_gen.cli.console import Column, progress, say_written, table
from tmm_gen.cli.given import finite, positive
from tmm_gen.cli.outputs import OutputFile, force_option, require_new, write_outputs
from tmm_gen.reading import read_file

if TYPE_CHECKING:
    from tmm_gen.calibration.calibrate import Calibration
    from tmm_gen.scene import Scene

# NumPy and SciPy are imported inside: `tmm-gen --help` has no use for them.


@click.command("calibrate")
@click.argument("scene", metavar="SCENE", type=click.Path(path_type=Path))
@click.argument("record", metavar="RECORD.csv", type=click.Path(path_type=Path))
@click.option(
    "--fit",
    "keys",
    metavar="KEY",
    multiple=True,
    help="Number of the scene to fit, such as tip.mass or beam.upper.bending_stiffness; `stiffness` and `damping` mean "
    "all springs and all dampers. Repeatable; by default stiffness and damping, of each part by itself.",
)
@click.option(
    "--input",
    "given",
    metavar="NAME=VALUE|NAME=FILE.csv|FILE.csv",
    multiple=True,
    help="An input that is not among the record's columns, as for `tmm-gen run`. Repeatable.",
)
@click.option(
    "--time-unit",
    type=click.Choice(["s", "ms", "us", "ns"]),
    default="s",
    show_default=True,
    help="What the `time` columns of all files count.",
)
@click.option(
    "--start",
    type=float,
    metavar="T",
    callback=finite,
    help="When the arm was in the scene's initial state, in the unit of `time`; by default where the clock starts.",
)
@click.option(
    "--loss",
    type=click.Choice(["linear", "huber"]),
    default="linear",
    show_default=True,
    help="Least squares, or Huber's loss, which gives single wrong samples less weight.",
)
@click.option(
    "--max-misfit",
    "most_misfit",
    type=float,
    default=0.5,
    show_default=True,
    callback=positive,
    help="What may be left, as a share of the record's standard deviation; more is a failure (exit code 1).",
)
@click.option("--out", type=OutputFile(), help="Write the calibrated scene.")
@force_option
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def calibrate(
    scene: Path,
    record: Path,
    keys: tuple[str, ...],
    given: tuple[str, ...],
    time_unit: str,
    start: float | None,
    loss: Literal["linear", "huber"],
    most_misfit: float,
    out: Path | None,
    force: bool,
    json_mode: bool,
) -> None:
    """Fit stiffness and damping of SCENE to a recorded response.

    RECORD.csv has a `time` column and columns named as the scene's inputs and outputs; an empty cell is a sample that
    is missing. The arm starts from the scene's initial state where the clock starts, be that at zero or not; other
    files have the same clock. Each number is given with the uncertainty the record leaves.
    """
    require_new(out, force)
    loaded = changed_scene(scene)
    with progress(f"fitting {loaded.name}"):
        from tmm_gen.calibration.calibrate import calibrate as fit
        from tmm_gen.calibration.record import headings_of, missing_inputs, read_record, unread
        from tmm_gen.inputs.clock import UNITS, from_start
        from tmm_gen.inputs.given import input_names, read_inputs

        signals = read_record(loaded, record)
        signals |= read_inputs(given, missing_inputs(loaded, signals), input_names(loaded)[1])
        unit = UNITS[time_unit]
        done = fit(
            loaded,
            from_start(signals, 0.0, unit),
            keys or None,
            start=None if start is None else unit * start,
            loss=loss,
            most_misfit=most_misfit,
        )
        done = replace(done, unread=unread(loaded, headings_of(record)))
    written = _write(scene, out, done, force)
    _show(loaded, done, written, json_mode)


def _write(scene: Path, out: Path | None, done: Calibration, force: bool) -> list[Path]:
    """Write the scene's file with the fitted numbers in place of the old ones."""
    if out is None:
        return []
    from tmm_gen.scene.rewrite import rewritten

    text = read_file(scene).decode("utf-8-sig")
    return write_outputs({out: rewritten(text, str(scene), done.scene, done.changes)}, force=force)


def _show(scene: Scene, done: Calibration, written: list[Path], json_mode: bool) -> None:
    columns: list[Column | str] = [
        "key",
        Column("given", form=".6g"),
        Column("value", "fitted", ".6g"),
        Column("deviation", "standard deviation", ".2g"),
        Column("low", "95 % from", ".6g"),
        Column("high", "to", ".6g"),
        Column("change_percent", "change (%)", "+.2f"),
    ]
    facts = {
        "scene": scene.name,
        "misfit_before": done.misfit_before,
        "misfit": done.misfit,
        "samples": done.samples,
        "outliers": done.outliers,
        "start": done.start,
        "correlation": done.correlation,
        "unread": done.unread,
        "files": written,
    }
    table(
        list(done.rows()),
        columns,
        json_mode,
        title=f"{scene.title}: fitted to {done.samples} samples",
        more=facts,
    )
    if json_mode:
        return
    for line in done.sentences():
        click.echo(line)
    say_written(written, "--out FILE writes the calibrated scene")
