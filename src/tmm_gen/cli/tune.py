"""`tmm-gen tune`: the cheapest configuration of a scene within bounds on error and time."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from tmm_gen.cli.changes import changed_scene
from tmm_gen.cli.console import Column, progress, say_written, table
from tmm_gen.cli.given import positive
from tmm_gen.cli.outputs import OutputFile, force_option, require_new, write_outputs
from tmm_gen.cli.study_options import corrections_option, one_of, one_thread, whole_numbers, words

if TYPE_CHECKING:
    from tmm_gen.study.budgets import Allowance
    from tmm_gen.study.tune import Tuning

# NumPy, SymPy and tomlkit are imported inside: `tmm-gen --help` has no use for them.


@click.command("tune")
@click.argument("scene", metavar="SCENE", type=click.Path(path_type=Path))
@click.option(
    "--max-error",
    required=True,
    metavar="E",
    help="Largest error of the output: relative to its travel (1e-3, 0.1%) or with a unit (0.5mm, 1mrad).",
)
@click.option(
    "--max-time",
    required=True,
    metavar="T",
    help="Computing time for a simulated second, of this machine, in s or with a unit (200µs, 200us).",
)
@click.option(
    "--links",
    metavar="auto|N,N",
    help="Choose the number of links of the beam too, in space cells of each; by default the scene's.",
)
@click.option("--integrators", metavar="A,B", callback=words, help="Choose among these; by default all.")
@click.option(
    "--iterations",
    metavar="N,N",
    callback=whole_numbers,
    help="Sweeps per stage, or sweep and corrections; by default the scene's.",
)
@corrections_option
@click.option(
    "--linearisations",
    metavar="A,B",
    callback=one_of("newton", "inertial", "taylor", "frozen"),
    help="Of an arm; by default the scene's.",
)
@click.option(
    "--reals",
    metavar="A,B",
    callback=one_of("float64", "float32"),
    help="Number types of the C; by default the scene's.",
)
@click.option(
    "--input",
    "given",
    metavar="NAME=VALUE|NAME=FILE.csv|FILE.csv",
    multiple=True,
    help="What moves the arm, as in `run`; by default every input acts, smoothly.",
)
@click.option(
    "--until", type=float, callback=positive, help="Time simulated, s; by default five slow periods."
)
@click.option(
    "--output", metavar="NAME", help="Where the error is measured; by default the tip's place or angle."
)
@click.option(
    "--tolerances",
    is_flag=True,
    help="Try steps that a tolerance within the error chooses, too; not for controllers.",
)
@click.option("--target", metavar="NAME", help="Microcontroller that the scene's [emit.budget] is for.")
@click.option("--out", "out_file", type=OutputFile(), metavar="FILE", help="Write the tuned scene.")
@click.option(
    "--rounds", type=click.IntRange(min=1), default=9, show_default=True, help="Measurements of each time."
)
@force_option
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def tune(
    scene: Path,
    max_error: str,
    max_time: str,
    out_file: Path | None,
    force: bool,
    json_mode: bool,
    **options: Any,
) -> int:
    """Find the cheapest way to compute SCENE within an error and a time.

    The error bound holds at every instant of a run under the loads given; the winner is verified by building and
    running it afresh. A plain number bounds the error relative to how far the output travels. Exits with 1 if
    nothing keeps both bounds, and says what comes nearest.
    """
    require_new(out_file, force)
    one_thread()
    tuning, allowed = _search(scene, max_error, max_time, options)
    written = []
    if out_file is not None and tuning.found:
        written.append(_write(scene, out_file, tuning, force))
    _show(tuning, allowed, written, json_mode)
    return 0 if tuning.found else 1


def _search(
    path: Path, max_error: str, max_time: str, options: dict[str, Any]
) -> tuple[Tuning, Allowance | None]:
    from tmm_gen.inputs.given import input_names, read_inputs
    from tmm_gen.study.axes import axes_of
    from tmm_gen.study.bounds import read_error, read_time
    from tmm_gen.study.budgets import allowance, require_target
    from tmm_gen.study.by_tolerance import require_desktop
    from tmm_gen.study.excitation import excitation
    from tmm_gen.study.grid import families
    from tmm_gen.study.tune import tune as search

    bounds = read_error(max_error), read_time(max_time)
    scene = changed_scene(path)
    auto = options["links"] == "auto"
    links = () if auto or options["links"] is None else _links(options["links"])
    axes = axes_of(scene, {**options, "links": links, "steps": (), "backends": ("c",)})
    require_target(options["target"])
    if options["tolerances"]:
        require_desktop(scene, options["target"], auto_links=auto)
    given = read_inputs(options["given"], *input_names(scene))
    went = excitation(scene, given, options["until"], options["output"])
    allowed = allowance(scene, options["target"])
    searched = families(scene, axes)
    units = len(searched) * (1 + auto)
    if options["tolerances"]:
        units += len({family.integrator for family in searched})
    with progress(f"tuning {scene.name}", total=units) as advance:
        tuning = search(
            scene,
            went,
            *bounds,
            axes,
            auto,
            allowed,
            options["rounds"],
            lambda n, doing: advance(n, doing),
            tolerances=options["tolerances"],
        )
    return tuning, allowed


def _links(text: str) -> tuple[int, ...]:
    numbers = [word.strip() for word in text.split(",")]
    if not all(number.isdecimal() and int(number) > 0 for number in numbers):
        raise click.BadParameter(
            f"'{text}' is neither auto nor numbers of links, such as 5,10", param_hint="--links"
        )
    return tuple(map(int, numbers))


def _write(scene: Path, target: Path, tuning: Tuning, force: bool) -> Path:
    from tmm_gen.reading import read_file
    from tmm_gen.study.explain import tuned_text

    write_outputs({target: tuned_text(tuning, read_file(scene).decode("utf-8-sig"))}, force=force)
    return target


_COLUMNS: list[Column | str] = [
    "configuration",
    Column("step", "step (s)", ".4g"),
    Column("error", "time error", ".2e"),
    Column("total_error", form=".2e"),
    Column(
        "ns_per_simulated_second", "µs per simulated s", lambda ns: "-" if ns is None else f"{ns / 1e3:.4g}"
    ),
    Column("fits", "within bounds"),
]


def _show(tuning: Tuning, allowed: Allowance | None, written: list[Path], json_mode: bool) -> None:
    from tmm_gen.study.explain import bounds_of, explained, under

    lines = explained(tuning, allowed)
    table(
        list(tuning.rows()),
        _COLUMNS,
        json_mode,
        title=f"{tuning.scene.title}: {bounds_of(tuning)}",
        more=_facts(tuning, lines, written),
    )
    if json_mode:
        return
    for line in lines:
        click.echo(line)
    click.echo(under(tuning))
    say_written(written, "--out FILE writes the tuned scene" if tuning.found else "")


def _facts(tuning: Tuning, lines: list[str], written: list[Path]) -> dict[str, object]:
    facts: dict[str, object] = {
        "scene": tuning.scene.name,
        "output": tuning.excitation.output,
        "unit": tuning.unit,
        "travel": tuning.travel,
        "until": tuning.excitation.until,
        "excitation": tuning.excitation.told(tuning.scene),
        "max_error": tuning.max_error,
        "max_time": tuning.max_time,
        "found": tuning.found,
        "explanation": lines,
        "files": written,
        "chosen": None,
        "by_tolerance": [{**each.values(), "chosen": each is tuning.cheaper} for each in tuning.by_tolerance],
    }
    point, checked, winner = tuning.chosen, tuning.verified, tuning.of_equal_steps
    if point is not None and checked is not None and winner is not None:
        facts["chosen"] = {
            **point.configuration.values(),
            "error": winner.error,
            "error_in_unit": winner.error * tuning.travel,
            "time_error": checked.error,
            "modelling_error": point.result.modelling_error,
            "seconds_per_simulated_second": 1e-9 * winner.ns_per_second,
            "ns_per_step": checked.ns_per_step,
            "ns_spread": checked.spread,
        }
    return facts
