"""`tmm-gen calibrate`: fit numbers of a scene to a recorded response."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.errors import UserError

if TYPE_CHECKING:
    from tmm_gen.control.calibration import Calibration
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
    help="Number of the scene to fit, such as tip.mass; `stiffness` and `damping` mean all joints. Repeatable; "
    "by default stiffness and damping.",
)
@click.option(
    "--input",
    "given",
    metavar="NAME=VALUE|NAME=FILE.csv|FILE.csv",
    multiple=True,
    help="An input that is not among the record's columns, as for `tmm-gen run`. Repeatable.",
)
@click.option("--out", type=click.Path(dir_okay=False, path_type=Path), help="Write the calibrated scene.")
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def calibrate(
    scene: Path,
    record: Path,
    keys: tuple[str, ...],
    given: tuple[str, ...],
    out: Path | None,
    json_mode: bool,
) -> None:
    """Fit stiffness and damping of SCENE to a recorded response.

    RECORD.csv has a `time` column (s) and columns named as the scene's inputs and outputs; the arm starts from the
    scene's initial state. Each number is given with the uncertainty the record leaves.
    """
    from tmm_gen.scene import load_scene

    loaded = load_scene(scene)
    with progress(f"fitting {loaded.name}"):
        from tmm_gen.control.calibration import calibrate as fit
        from tmm_gen.measure.given import input_names, read_inputs, read_tables

        names = _columns(loaded, record)
        missing = tuple(item.name for item in loaded.inputs if item.name not in names)
        _, angles = input_names(loaded)
        signals = {**read_tables(record, names, angles), **read_inputs(given, missing, angles)}
        done = fit(loaded, signals, keys or None)
    written = _write(scene, out, done)
    _show(loaded, done, written, json_mode)


def _columns(scene: Scene, record: Path) -> tuple[str, ...]:
    """Return the columns of the record that the scene knows.

    Raises
    ------
    UserError
        If the file cannot be read, or has none.
    """
    from tmm_gen.measure.columns import output_columns

    try:
        with record.open(encoding="utf-8-sig", newline="") as file:
            headings = [cell.strip() for cell in next(csv.reader(file), [])]
    except FileNotFoundError:
        raise UserError(f"{record}: no such file. Check the path.") from None
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise UserError(f"{record}: cannot be read: {error}. Save it as CSV in UTF-8.") from None
    outputs = [column.name for column in output_columns(scene)]
    known = [*(item.name for item in scene.inputs), *outputs]
    found = tuple(name for name in known if name in headings)
    if not set(found) & set(outputs):
        raise UserError(f"{record}:1: has none of the outputs {', '.join(outputs)}. Name a column after one.")
    return found


def _write(scene: Path, out: Path | None, done: Calibration) -> list[Path]:
    """Write the scene's file with the fitted numbers in place of the old ones."""
    if out is None:
        return []
    from tmm_gen.files import write_whole
    from tmm_gen.scene.rewrite import rewritten

    text = scene.read_bytes().decode("utf-8-sig")
    write_whole(out, rewritten(text, str(scene), done.scene, done.changes))
    return [out]


def _show(scene: Scene, done: Calibration, written: list[Path], json_mode: bool) -> None:
    rows: list[dict[str, object]] = []
    for found in done.found:
        low, high = found.interval
        rows.append(
            {
                "key": found.key,
                "given": found.given,
                "value": found.value,
                "deviation": found.deviation,
                "low": low,
                "high": high,
                "change_percent": 100.0 * (found.value / found.given - 1.0),
            }
        )
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
        "correlation": done.correlation,
        "files": written,
    }
    table(rows, columns, json_mode, title=f"{scene.title}: fitted to {done.samples} samples", more=facts)
    if json_mode:
        return
    click.echo(
        f"what is left: {100 * done.misfit:.3g} % of the record's standard deviation, "
        f"{100 * done.misfit_before:.3g} % before"
    )
    for path in written:
        click.echo(f"wrote {path}")
    if not written:
        click.echo("more: --out FILE writes the calibrated scene")
