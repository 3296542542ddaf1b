"""`tmm-gen run`: simulate a scene with its generated kernel."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.changes import changed_scene, set_option
from tmm_gen.cli.console import Column, progress, table
from tmm_gen.cli.given import picture_file, plot_option
from tmm_gen.cli.hints import hinted
from tmm_gen.cli.outputs import OutputFile, claim, write_outputs
from tmm_gen.errors import UserError

if TYPE_CHECKING:
    from tmm_gen.simulate.adaptive.chosen import Chosen
    from tmm_gen.simulate.simulation import Simulation
    from tmm_gen.simulate.stepping import Backend

# NumPy, SymPy and Matplotlib are imported inside: `tmm-gen --help` has no use for them.

_MOVING = (".gif", ".html")
_PROFILES = """\b
Profiles; times in s (or 0.8s, 800ms), what is in brackets may be absent:
  step:FROM:TO[:AT]                 a jump, at 0 s or AT
  ramp:FROM:TO:TIME[:START]         straight from value to value in a time
  smooth:FROM:TO:TIME[:START]       the same, at rest at both ends (degree five)
  sine:AMPLITUDE:FREQUENCY[:PHASE]  FREQUENCY in Hz, PHASE in rad (or 90deg)
  chirp:AMPLITUDE:FIRST:LAST:TIME   from one frequency (Hz) to another in a time
"""
"""What ``--input NAME=`` takes besides numbers and files; click leaves lines behind its mark as they are."""

_COLUMNS: list[Column | str] = [
    "output",
    Column("what", ""),
    "unit",
    Column("final", form=".6g"),
    Column("rest", "at rest", ".6g"),
    Column("peak", form=".6g"),
    Column("peak_time", "at (s)", ".4g"),
    Column("overshoot_percent", "overshoot (%)", ".1f"),
    Column("settling_time", "within 2 % after (s)", ".4g"),
]


def _time(_context: click.Context, parameter: click.Parameter, value: float | None) -> float | None:
    if value is not None and not 0.0 < value < math.inf:
        raise click.BadParameter("must be a positive number of seconds", param=parameter)
    return value


def _interval(_context: click.Context, parameter: click.Parameter, value: str | None) -> float | None:
    if value is None:
        return None
    number, factor = (value[:-2], 1e-3) if value.endswith("ms") else (value.removesuffix("s"), 1.0)
    try:
        seconds = float(number) * factor
    except ValueError:
        seconds = math.nan
    if not 0.0 < seconds < math.inf:
        raise click.BadParameter("must be a positive time, such as 1ms, 0.001s or 0.001", param=parameter)
    return seconds


def _tolerance(_context: click.Context, parameter: click.Parameter, value: float | None) -> float | None:
    from tmm_gen.scene.integrator import COARSEST, FINEST

    if value is not None and not FINEST <= value <= COARSEST:
        raise click.BadParameter(f"must be between {FINEST:g} and {COARSEST:g}", param=parameter)
    return value


def _sweeps(_context: click.Context, parameter: click.Parameter, value: str | None) -> str | int | None:
    if value is None or value == "auto":
        return value
    if not (value.isdecimal() and int(value) >= 1):
        raise click.BadParameter("must be auto or a whole number from 1", param=parameter)
    return int(value)


@click.command("run", epilog=_PROFILES)
@click.argument("scene", metavar="SCENE", type=click.Path(path_type=Path))
@click.option(
    "--until", type=float, callback=_time, help="Time to simulate, s; by default five slow periods."
)
@click.option("--step", type=float, callback=_time, help="Time step, s; by default the scene's.")
@click.option(
    "--tolerance",
    type=float,
    callback=_tolerance,
    help="Choose steps so that the error is at most this share of the motion (1e-10 to 0.05); rows stay as they are.",
)
@click.option(
    "--every",
    metavar="TIME",
    callback=_interval,
    help="How far rows are apart, such as 1ms, whatever the steps; by default a step.",
)
@click.option(
    "--input",
    "given",
    metavar="NAME=VALUE|NAME=PROFILE|NAME=FILE.csv|FILE.csv",
    multiple=True,
    help="An input: a constant, a profile, a column of a file, or all from one file. Repeatable; the rest is zero.",
)
@set_option
@click.option(
    "--iterations",
    metavar="auto|N",
    callback=_sweeps,
    help="Sweeps per stage, corrections counted, of an arm in a plane or in space; by default the scene's, or else as "
    "many as it takes.",
)
@click.option("--backend", type=click.Choice(["numpy", "c"]), default="numpy", show_default=True)
@click.option("--csv", "csv_file", type=OutputFile(), help="Write the outputs over time.")
@click.option(
    "--with-inputs",
    is_flag=True,
    help="Let --csv hold the inputs too, as columns before the outputs: a record that `calibrate` reads.",
)
@plot_option("inputs and outputs")
@click.option(
    "--animate",
    "animated",
    metavar="FILE.gif|FILE.html",
    type=OutputFile(*_MOVING),
    help="Show an arm in motion; in space, a page lets it be turned.",
)
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def run(
    scene: Path,
    until: float | None,
    step: float | None,
    tolerance: float | None,
    every: float | None,
    given: tuple[str, ...],
    changes: tuple[str, ...],
    iterations: str | int | None,
    backend: Backend,
    csv_file: Path | None,
    with_inputs: bool,
    picture: Path | None,
    animated: Path | None,
    json_mode: bool,
) -> None:
    """Simulate SCENE with its generated kernel.

    Files of inputs have a `time` column and a column for each input; between rows values are linear, and the
    last one stays. The angle of a prescribed base goes smoothly through its rows, with its rate and acceleration;
    where the rows have a corner its rate jumps. Columns NAME_rate and NAME_acceleration tell them exactly.

    With --tolerance, or `tolerance` in [integrator], steps are as long as the error allows and end where inputs have
    kinks. Rows are then, as with --every, between the ends of steps.

    A profile is for example --input base_angle=smooth:0:1.5:0.8s; a prescribed base cannot jump.
    """
    from tmm_gen.inputs.clock import refuse_other_clock
    from tmm_gen.inputs.given import input_names, read_inputs, table_files
    from tmm_gen.reference.duration import default_duration
    from tmm_gen.simulate.rows import row_instants
    from tmm_gen.simulate.run import number_of_steps, simulate

    chosen = changed_scene(scene, changes, step)
    if tolerance is not None:
        chosen = chosen.replace(**{"integrator.tolerance": tolerance})
    if iterations is not None:
        chosen = chosen.replace(**{"model.iterations": iterations})
    read = (scene, *table_files(given))
    signals = read_inputs(given, *input_names(chosen))
    shaped = not chosen.model.linear
    if animated is not None and not shaped:
        raise UserError(f"--animate {animated}: a chain has no shape to show. Use --plot.")
    if with_inputs and csv_file is None:
        raise UserError("--with-inputs: adds columns to what --csv writes. Add --csv FILE.")
    claim((csv_file, picture, animated), read)
    hints = hinted(chosen, json_mode)
    duration = until or default_duration(chosen)
    refuse_other_clock(signals, duration)
    steps = number_of_steps(duration, chosen.integrator.step)
    if every is not None and chosen.integrator.tolerance is not None:
        steps = len(row_instants(duration, every)) - 1
    with progress(f"simulating {chosen.name}", total=steps) as advance:
        drawn = shaped and (picture is not None or animated is not None)
        simulation = simulate(
            chosen,
            signals,
            duration,
            backend,
            advance,
            trace=drawn,
            substeps=not _step_given(step, changes),
            every=every,
        )
    written = _write(simulation, csv_file, with_inputs, picture, animated, read)
    _show(simulation, written, hints, json_mode)


def _step_given(step: float | None, changes: Sequence[str]) -> bool:
    """Whether the step was asked for with this command, so that no other is to be taken."""
    return step is not None or any(c.partition("=")[0].strip() == "integrator.step" for c in changes)


def _write(
    simulation: Simulation,
    csv_file: Path | None,
    with_inputs: bool,
    picture: Path | None,
    animated: Path | None,
    read: Sequence[Path],
) -> list[Path]:
    """Write the files asked for, all or none; return them."""
    files: dict[Path, str | bytes] = {}
    if csv_file is not None:
        files[csv_file] = simulation.csv(with_inputs)
    if picture is not None:
        from tmm_gen.report.plots import response_picture

        target = picture_file(picture, simulation.scene.name)
        with progress("drawing"):
            files[target] = response_picture(simulation, target.suffix[1:].lower())
    if animated is not None:
        from tmm_gen.report.moving import moving

        with progress("drawing the arm in motion"):
            files[animated] = moving(simulation, animated.suffix[1:].lower())
    return write_outputs(files, read)


def _show(simulation: Simulation, written: list[Path], hints: list[str], json_mode: bool) -> None:
    """Print the figures, what was done, and what could be done next."""
    from tmm_gen.simulate.trust import divided, trusted

    scene, last, accuracy = simulation.scene, float(simulation.time[-1]), simulation.accuracy
    chosen = simulation.chosen
    facts = {**simulation.facts(), "hints": hints, "files": written}
    of = f"of {scene.integrator.step:g} s" if chosen is None else "as its tolerance asks"
    done = f"{last:g} s in {simulation.steps} steps {of} by {scene.integrator.name}"
    rows = list(simulation.rows())
    table(rows, _telling(rows), json_mode, title=f"{scene.title}: {done}", more=facts)
    if json_mode:
        return
    if chosen is not None and not simulation.still:
        click.echo(_chosen(chosen))
    if simulation.substeps.count > 1:
        click.echo(divided(simulation))
    if accuracy is not None and not simulation.still:
        click.echo(trusted(simulation))
    for note in simulation.notes:
        click.echo(note)
    for path in written:
        click.echo(f"wrote {path}")
    if simulation.still and scene.inputs:
        click.echo(f"nothing moves, as all inputs are zero: try --input {scene.inputs[0].name}=1")
    elif not written:
        click.echo("more: --plot draws it, --csv FILE writes it, --until and --step change it")


def _chosen(chosen: Chosen) -> str:
    """Say what steps a tolerance has chosen."""
    runs = f"; run {chosen.runs} times, each by what the last one had shown" if chosen.runs > 1 else ""
    again = f"{chosen.refused} taken again shorter" if chosen.refused else "none taken again"
    return (
        f"chose {chosen.steps} steps for a tolerance of {chosen.tolerance:g}: from {chosen.smallest:.3g} to "
        f"{chosen.largest:.3g} s, {again}{runs}"
    )


def _telling(rows: list[dict[str, object]]) -> list[Column | str]:
    """Return the columns in which something stands."""
    return [c for c in _COLUMNS if any(row[c if isinstance(c, str) else c.key] is not None for row in rows)]
