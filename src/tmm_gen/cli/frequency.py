"""`tmm-gen frequency`: frequency response, and how few links a scene requires."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.changes import changed_scene, set_option
from tmm_gen.cli.console import Column, progress, say_written, table
from tmm_gen.cli.given import picture_file, plot_option, positive, resting_input_option
from tmm_gen.cli.links import show_links
from tmm_gen.cli.near import near_option
from tmm_gen.cli.outputs import OutputFile, claim, write_outputs

if TYPE_CHECKING:
    from tmm_gen.modal.answer import Answer

# NumPy, SymPy and Matplotlib are imported inside: `tmm-gen --help` has no use for them.


@click.command("frequency")
@click.argument("scene", metavar="SCENE", type=click.Path(path_type=Path))
@click.option("--from", "source", metavar="INPUT", help="Input; by default the scene's first.")
@click.option("--to", "target", metavar="OUTPUT", help="Output; by default the scene's first.")
@click.option("--low", type=float, metavar="HZ", callback=positive, help="Lowest frequency.")
@click.option("--high", type=float, metavar="HZ", callback=positive, help="Highest frequency.")
@click.option(
    "--points",
    type=click.IntRange(min=2),
    default=1000,
    show_default=True,
    help="Frequencies, evenly in log.",
)
@resting_input_option
@near_option
@set_option
@click.option("--csv", "csv_file", type=OutputFile(), help="Write the response.")
@plot_option("magnitude and phase", "-frequency")
@click.option(
    "--links-for",
    "error",
    type=float,
    metavar="ERROR",
    callback=positive,
    help="Instead: how few links keep natural frequencies within this relative error (0.01 for 1 %)?",
)
@click.option(
    "--band", type=float, metavar="HZ", callback=positive, help="Up to which frequency, with --links-for."
)
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def frequency(
    scene: Path,
    source: str | None,
    target: str | None,
    low: float | None,
    high: float | None,
    points: int,
    given: tuple[str, ...],
    near: tuple[str, ...],
    changes: tuple[str, ...],
    csv_file: Path | None,
    picture: Path | None,
    error: float | None,
    band: float | None,
    json_mode: bool,
) -> None:
    """Show how an output of SCENE answers an input at each frequency.

    With --links-for ERROR --band HZ: how few links does this scene require?
    """
    if (error is None) != (band is None):
        raise click.UsageError("--links-for ERROR and --band HZ belong together.")
    if low is not None and high is not None and low >= high:
        raise click.UsageError(f"--low {low:g} must be less than --high {high:g}.")
    loaded = changed_scene(scene, changes)
    if error is not None and band is not None:
        show_links(loaded, error, band, json_mode)
        return
    claim((csv_file, picture), (scene,))
    from tmm_gen.inputs.given import constant_inputs
    from tmm_gen.modal.near import start_of

    inputs, start = constant_inputs(loaded, given), start_of(loaded, near)
    from tmm_gen.modal.answer import answered, asked

    about = asked(loaded, source, target)
    with progress(f"frequency response of {loaded.name}"):
        answer = answered(loaded, about, (low, high), points, inputs, start)
        written = _write(scene, answer, csv_file, picture)
    _show(answer, written, json_mode)


def _write(scene: Path, answer: Answer, csv_file: Path | None, picture: Path | None) -> list[Path]:
    """Write the files asked for, all or none; return them."""
    files: dict[Path, str | bytes] = {}
    if csv_file is not None:
        files[csv_file] = answer.csv()
    if picture is not None:
        from tmm_gen.modal.picture import bode_picture

        target = picture_file(picture, answer.scene.name, "-frequency")
        files[target] = bode_picture(answer, target.suffix[1:].lower())
    return write_outputs(files, (scene,))


def _show(answer: Answer, written: list[Path], json_mode: bool) -> None:
    import numpy as np

    columns = [
        Column("mode"),
        Column("frequency_hz", "resonance (Hz)", ".6g"),
        Column("damping_ratio", form=".4g"),
    ]
    for name in answer.told:
        suffix = name.removeprefix(answer.read.name)
        text = f" {suffix[1:]}" if suffix else ""
        columns.append(Column(f"magnitude{suffix}", f"magnitude{text} ({answer.unit})", ".5g"))
        columns.append(Column(f"phase{suffix}_deg", f"phase{text} (°)", ".1f"))
    scene = answer.scene
    facts: dict[str, object] = {
        "scene": scene.name,
        "input": answer.given.name,
        "output": answer.read.name,
        "unit": answer.unit,
        "low_hz": answer.hertz[0],
        "high_hz": answer.hertz[-1],
        "files": written,
    }
    if json_mode:
        facts["frequency_hz"] = answer.hertz
        facts["response"] = [
            {"component": name, "magnitude": np.abs(values), "phase_deg": np.degrees(np.angle(values))}
            for name, values in answer.parts.items()
        ]
    band = f"{answer.hertz[0]:.4g} to {answer.hertz[-1]:.4g} Hz"
    title = f"{scene.title}: {answer.read.name} for {answer.given.name}, {band}"
    table(answer.rows, columns, json_mode, title=title, more=facts)
    if json_mode:
        return
    say_written(
        written, "--plot draws it, --csv FILE writes it, --from and --to choose, --low and --high zoom"
    )
