"""What `tmm-gen mpc` prints and writes."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.console import Column, progress, say_written, table
from tmm_gen.cli.given import picture_file
from tmm_gen.cli.outputs import write_outputs
from tmm_gen.errors import UserError

if TYPE_CHECKING:
    from tmm_gen.closed_loop.compare import Trial
    from tmm_gen.control.bench import Bench
    from tmm_gen.scene import Scene


_ALONG = (
    Column("off_rms_mm", "off, rms (mm)", ".2f"),
    Column("off_most_mm", "at most (mm)", ".2f"),
    Column("at_stops_mm", "trembles at stops (mm)", ".2f"),
)
"""Of a trajectory."""


def list_all(json_mode: bool) -> None:
    """Print controllers, conditions, and what can be tuned."""
    from tmm_gen.closed_loop.tunables import titles
    from tmm_gen.control.condition import CONDITIONS
    from tmm_gen.control.controllers import CONTROLLERS
    from tmm_gen.onboard.emit import EMITTED

    rows: list[dict[str, object]] = [
        {"what": "controller", "name": kind.name, "title": kind.title, "c": kind.name in EMITTED}
        for kind in CONTROLLERS
    ]
    rows += [{"what": "condition", "name": case.name, "title": case.title, "c": None} for case in CONDITIONS]
    rows += [{"what": "tunable", "name": name, "title": title, "c": None} for name, title in titles().items()]
    table(rows, ["what", "name", Column("title", ""), Column("c", "as C")], json_mode)


def show(scene: Scene, trials: list[Trial], until: float, files: list[Path], json_mode: bool) -> None:
    """Print the figures, and what could be done next."""
    from tmm_gen.closed_loop.figures import BAND, RESIDUAL_FROM

    reached = (
        Column("settling_s", f"settles to {100 * BAND:g} % (s)", ".3f"),
        Column("overshoot_percent", "overshoot (%)", ".2f"),
        Column("residual_mrad", "residual (mrad)", ".2f"),
        Column("offset_mrad", "offset (mrad)", ".2f"),
    )
    columns: list[Column | str] = [
        "controller",
        "condition",
        *(_ALONG if trials[0].tracking is not None else reached),
        *([Column("to_wall_mm", "to the wall (mm)", ".4g")] if trials[0].nearest is not None else []),
        Column("solve_us_median", "solve (µs)", ".0f"),
        Column("solve_us_max", "at most (µs)", ".0f"),
    ]
    rows = [trial.row() for trial in trials]
    if any(row["fallbacks"] for row in rows):
        columns.append("fallbacks")
    facts = {
        "scene": scene.name,
        "until": until,
        "band_percent": 100.0 * BAND,
        "residual_from_s": RESIDUAL_FROM,
        "files": files,
    }
    table(rows, columns, json_mode, title=scene.title, more=facts)
    if json_mode:
        return
    say_written(files, "--plot draws it, --animate FILE.gif shows it, --emit DIR writes a controller in C")


def write_files(bench: Bench, trials: list[Trial], picture: Path | None, animated: Path | None) -> list[Path]:
    """Write the pictures asked for, all or none; return them."""
    files: dict[Path, str | bytes] = {}
    if picture is not None:
        from tmm_gen.closed_loop.pictures import comparison_picture

        target = picture_file(picture, bench.scene.name, "-mpc")
        with progress("drawing"):
            files[target] = comparison_picture(trials, bench.problem, target.suffix[1:].lower())
    if animated is not None:
        from tmm_gen.closed_loop.motion import motion
        from tmm_gen.report.moving import moving

        with progress("drawing the arm in motion"):
            files[animated] = moving(motion(bench.scene, trials[-1]), animated.suffix[1:].lower())
    return write_outputs(files)


def require_free(folder: Path, force: bool) -> None:
    """Refuse a folder that has a controller, before one is made.

    Raises
    ------
    UserError
        If there is one, unless forced.
    """
    from tmm_gen.onboard.folder import CMAKE, EXAMPLE

    taken = next((name for name in (CMAKE, EXAMPLE) if (folder / name).exists()), None)
    if taken and not force:
        raise UserError(
            f"--emit {folder}: there is a {taken} already. Name another folder, or replace what is there with --force."
        )


def emit(
    bench: Bench, names: list[str], folder: Path, real: str, prefix: str | None, force: bool, json_mode: bool
) -> None:
    """Write a controller as C, in place of another one that was written there.

    Raises
    ------
    UserError
        If there is none of that name in C, more than one is asked for, the prefix is no name, or another is there.
    """
    from tmm_gen.onboard.emit import EMITTED, emit_controller
    from tmm_gen.onboard.former import former_files
    from tmm_gen.scene.identifier import scene_name_fault

    if len(names) != 1 or names[0] not in EMITTED:
        raise UserError(
            f"--emit: cannot write {' and '.join(names)}. Choose one by --controller: {', '.join(EMITTED)}."
        )
    if prefix is not None and (fault := scene_name_fault(prefix)):
        raise UserError(f"--name {prefix}: {fault[0]}. {fault[1]}")
    with progress(f"writing {names[0]}"):
        name, files = emit_controller(bench, names[0], real, prefix, real_time=True)
    written = {folder / path: text for path, text in files.items()}
    left = former_files(folder, written)
    if left and not force:
        raise UserError(
            f"--emit {folder}: has {left[0].name} of another controller, which would be compiled with this one. Name "
            "another folder, or replace what is there with --force."
        )
    write_outputs(dict(written), force=force)
    for path in left:
        path.unlink()
    rows: list[dict[str, object]] = [
        {"file": path, "bytes": len(text.encode())} for path, text in written.items()
    ]
    facts = {
        "scene": bench.scene.name,
        "controller": names[0],
        "name": name,
        "real": real,
        "removed": [*left],
    }
    title = f"{bench.scene.title}: {names[0]} as C"
    table(rows, ["file", Column("bytes", form="d")], json_mode, title=title, more=facts)
    if not json_mode:
        if left:
            click.echo(f"removed of another controller: {', '.join(str(path) for path in left)}")
        click.echo(f"call {name}_command() once per sample; {folder / (name + '.h')} says how")
        place = shlex.quote(str(folder))
        click.echo(f"try it: cd {place} && cc -O2 example/example.c *.c daqp/*.c -lm && ./a.out")
        click.echo(f"in real time: cd {place} && cc -O2 example/loop.c *.c plant/*.c daqp/*.c -lm && ./a.out")
