"""`tmm-gen trade`: error against cost over integrators, steps, links and number types."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from tmm_gen.cli.changes import changed_scene
from tmm_gen.cli.console import Column, progress, say_written, table
from tmm_gen.cli.given import picture_file, plot_option
from tmm_gen.cli.grid_options import grid_options
from tmm_gen.cli.outputs import OutputFile, claim, write_outputs
from tmm_gen.cli.study_options import one_of, one_thread, whole_numbers

if TYPE_CHECKING:
    from tmm_gen.study.findings import Finding
    from tmm_gen.study.study import Study

# NumPy, SymPy, Dask and Matplotlib are imported inside: `tmm-gen --help` has no use for them.

REPORT = "report"
"""What ``--report`` without a file stands for."""


def _report_option(context: click.Context, parameter: click.Parameter, value: str | None) -> Path | None:
    if value in (None, REPORT):
        return None if value is None else Path(value)
    return OutputFile().convert(value, parameter, context)


@click.command("trade")
@click.argument("scene", metavar="SCENE", type=click.Path(path_type=Path))
@grid_options
@click.option(
    "--links",
    metavar="N,N",
    callback=whole_numbers,
    help="Links of a beam, in space cells of each; by default the scene's.",
)
@click.option("--backends", metavar="A,B", callback=one_of("c", "numpy"), help="c, numpy; by default c.")
@click.option("--csv", "csv_file", type=OutputFile(), help="Write all configurations.")
@plot_option("error against cost", "-trade")
@click.option(
    "--report",
    "report_file",
    metavar="[FILE.html]",
    is_flag=False,
    flag_value=REPORT,
    callback=_report_option,
    help="Write one page that needs no other file; by default NAME-trade.html.",
)
@click.option("--all", "show_all", is_flag=True, help="Show all configurations, not only the best.")
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def trade(
    scene: Path,
    links: tuple[int, ...],
    backends: tuple[str, ...],
    csv_file: Path | None,
    picture: Path | None,
    report_file: Path | None,
    show_all: bool,
    json_mode: bool,
    **common: Any,
) -> None:
    """Measure what accuracy costs: SCENE over integrators, steps, links and number types.

    Errors are those of the output against an independent reference, at any instant, relative to how far the
    output travels. Costs are those of the generated C, compiled and run on this machine. Shown are the
    configurations that no other beats in both.
    """
    claim((csv_file, picture, report_file), (scene,))
    one_thread()
    study = run(scene, {"links": links, "backends": backends, **common})
    if picture or report_file:
        from tmm_gen.study.figures import require_finished

        require_finished(study)
    written = _write(scene, study, csv_file, picture, report_file)
    _show(study, written, show_all, json_mode)


def run(path: Path, options: dict[str, Any]) -> Study:
    """Read a scene and study it."""
    from tmm_gen.inputs.given import input_names, read_inputs
    from tmm_gen.study.axes import axes_of
    from tmm_gen.study.excitation import excitation
    from tmm_gen.study.executors import executor
    from tmm_gen.study.grid import configurations
    from tmm_gen.study.study import run_study

    scene = changed_scene(path)
    computes = executor(options["workers"], options["scheduler"])
    given = read_inputs(options["given"], *input_names(scene))
    went = excitation(scene, given, options["until"], options["output"])
    grid = configurations(scene, axes_of(scene, options), went.until)
    rounds, tolerances = options["rounds"], options["tolerances"]
    more = len(tolerances) * len({each.family.integrator for each in grid})
    with progress(f"studying {scene.name}", total=1 + len(grid) + rounds + more) as advance:
        return run_study(
            scene,
            went,
            grid,
            computes,
            options["store"],
            rounds,
            advance=lambda n, doing: advance(n, doing),
            tolerances=tolerances,
        )


def _write(
    scene: Path, study: Study, csv_file: Path | None, picture: Path | None, report_file: Path | None
) -> list[Path]:
    """Write the files asked for, all or none; return them."""
    from tmm_gen.csv_text import csv_text

    files: dict[Path, str | bytes] = {}
    if csv_file is not None:
        files[csv_file] = csv_text([point.values() for point in study.points])
    if picture is not None:
        from tmm_gen.study.figures import trade_picture

        target = picture_file(picture, study.scene.name, "-trade")
        with progress("drawing"):
            files[target] = trade_picture(study, target.suffix[1:].lower())
    if report_file is not None:
        from tmm_gen.study.report import report

        target = Path(f"{study.scene.name}-trade.html") if report_file == Path(REPORT) else report_file
        with progress("writing the page"):
            files[target] = report(study)
    return write_outputs(files, (scene,))


_COLUMNS: list[Column | str] = [
    "configuration",
    Column("step", "step (s)", ".3g"),
    "outcome",
    Column("error", "time error", ".2e"),
    Column("modelling_error", form=".1e"),
    Column(
        "ns_per_simulated_second", "µs per simulated s", lambda ns: "-" if ns is None else f"{ns / 1e3:.4g}"
    ),
    Column("ns_spread", "± (%)", lambda share: "-" if share is None else f"{100 * share:.0f}"),
    Column("operations", "operations per step"),
    Column("code_bytes", "code (bytes)"),
    Column("state_bytes", "state (bytes)"),
]


def _show(study: Study, written: list[Path], show_all: bool, json_mode: bool) -> None:
    from tmm_gen.study.excitation import unit
    from tmm_gen.study.findings import equal_steps, findings, summary
    from tmm_gen.study.single_precision import single_precision

    scene, went, single = study.scene, study.excitation, single_precision(study)
    rows = study.rows(study.points if show_all or json_mode else study.front())
    more = {
        "scene": scene.name,
        "output": went.output,
        "unit": unit(scene, went.output),
        "travel": study.travel,
        "until": went.until,
        "excitation": went.told(scene),
        "findings": [_finding(each) for each in findings(study)],
        "float32": None if single is None else asdict(single),
        "stored": study.stored,
        "by_tolerance": [{**each.values(), "equal_steps": equal_steps(study, each)} for each in study.chosen],
        "modelling": [
            {"links": each.links, "error": each.error, "order": each.order}
            for each in study.modelling.values()
        ],
        "files": written,
    }
    columns = (
        _COLUMNS if study.modelling else [c for c in _COLUMNS if getattr(c, "key", "") != "modelling_error"]
    )
    table(rows, columns, json_mode, title=f"{scene.title}: error of '{went.output}' against cost", more=more)
    if json_mode:
        return
    for sentence in summary(study):
        click.echo(sentence)
    say_written(written, "--report writes a page, --plot draws it, --csv FILE writes all, --all shows all")


def _finding(finding: Finding) -> dict[str, object]:
    best = finding.ways[0] if finding.ways else None
    return {
        "error": finding.level,
        "sentence": finding.sentence(),
        "winner": best.family.label if best and not finding.rivals else None,
        "time_factor_over_newmark": finding.factor(best) if best else None,
        "operations_factor_over_newmark": finding.operations_factor(best) if best else None,
        "ways": [
            {
                "configuration": way.family.label,
                "step": way.step,
                "step_known": way.known,
                "ns_per_simulated_second": way.ns,
                "operations_per_simulated_second": way.operations,
                "time_factor_over_newmark": finding.factor(way),
                "operations_factor_over_newmark": finding.operations_factor(way),
            }
            for way in finding.ways
        ],
    }
