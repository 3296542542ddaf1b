"""`tmm-gen mpc`: a scene's controllers on a finer arm, side by side; and as C."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.changes import changed_scene
from tmm_gen.cli.console import progress
from tmm_gen.cli.given import plot_option, positive
from tmm_gen.cli.mpc_tune import EVERYTHING, tuned
from tmm_gen.cli.outputs import OutputFile, OutputFolder, claim, force_option, require_new
from tmm_gen.cli.study_options import one_thread

if TYPE_CHECKING:
    from tmm_gen.closed_loop.compare import Trial
    from tmm_gen.control.bench import Bench
    from tmm_gen.control.condition import Condition
    from tmm_gen.control.controllers import ControllerKind
    from tmm_gen.scene import Scene

# SciPy, CasADi and Matplotlib are imported inside: `tmm-gen --help` has no use for them.

_MOVING = (".gif", ".html")


@click.command("mpc")
@click.argument("scene", metavar="SCENE", type=click.Path(path_type=Path))
@click.option(
    "--controller",
    "controllers",
    metavar="NAME",
    multiple=True,
    help="Only this controller. Repeatable; --list shows them.",
)
@click.option(
    "--condition",
    "conditions",
    metavar="NAME",
    multiple=True,
    help="Only under this condition. Repeatable; --list shows them.",
)
@click.option("--list", "listed", is_flag=True, help="List controllers, conditions and what can be tuned.")
@click.option("--until", type=float, callback=positive, default=2.5, show_default=True, help="Duration, s.")
@click.option(
    "--seed",
    type=int,
    default=0,
    show_default=True,
    help="Of the sensors' noise, or of the search by --tune.",
)
@click.option("--compiled", is_flag=True, help="Run the controllers that exist as C as compiled C.")
@plot_option("tip angles and torques", "-mpc")
@click.option(
    "--animate",
    "animated",
    metavar="FILE.gif|FILE.html",
    type=OutputFile(*_MOVING),
    help="Show the arm in motion: the last controller under the last condition.",
)
@click.option(
    "--emit",
    "folder",
    metavar="DIR",
    type=OutputFolder(),
    help="Write the controller as C for a microcontroller, for a hub mpc-modes, for motors by name rti-zero unless "
    "one is chosen; no comparison.",
)
@click.option(
    "--real",
    type=click.Choice(["float64", "float32"]),
    default="float64",
    show_default=True,
    help="Number type of the C code.",
)
@click.option(
    "--name",
    metavar="NAME",
    help="Prefix of the C code's functions and files, by default SCENE_CONTROLLER: one controller twice in a program "
    "needs two.",
)
@click.option(
    "--tune",
    "tunables",
    metavar="[NAME]",
    multiple=True,
    is_flag=False,
    flag_value=EVERYTHING,
    help="Tune gains and weights, all or those of one name (--list shows them; repeatable); no comparison. The "
    "numbers in SCENE play no part in the search, unless --refine is given, and stay where it finds nothing better.",
)
@click.option(
    "--evaluations",
    type=click.IntRange(min=20),
    default=1000,
    show_default=True,
    help="How many tunings to try, each in several closed loops.",
)
@click.option("--refine", is_flag=True, help="Let --tune begin at the numbers in SCENE, and nowhere else.")
@click.option(
    "--workers",
    type=click.IntRange(min=1),
    default=1,
    show_default=True,
    help="Processes --tune runs closed loops in; the numbers found are the same.",
)
@click.option(
    "--out",
    type=OutputFile(),
    help="Where --tune writes the tuned scene.",
)
@force_option
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def mpc(
    scene: Path,
    controllers: tuple[str, ...],
    conditions: tuple[str, ...],
    listed: bool,
    until: float,
    seed: int,
    compiled: bool,
    picture: Path | None,
    animated: Path | None,
    folder: Path | None,
    real: str,
    name: str | None,
    tunables: tuple[str, ...],
    evaluations: int,
    refine: bool,
    workers: int,
    out: Path | None,
    force: bool,
    json_mode: bool,
) -> None:
    """Control the arm of SCENE as its [control] says, and compare controllers.

    The arm that is controlled is finer than the scene's model and integrated by another method; its encoder
    rounds and its other sensors are noisy. Conditions change it in ways the controllers do not know, except for
    gravity and delay.
    """
    from tmm_gen.cli.mpc_report import emit, list_all, require_free, show, write_files

    one_thread()
    loaded = changed_scene(scene)
    claim((picture, animated), (scene,))
    require_new(out, force)
    from tmm_gen.closed_loop.chosen import chosen
    from tmm_gen.control.condition import CONDITIONS
    from tmm_gen.control.controllers import BY_NAME, CONTROLLERS, require_solvers

    kinds = chosen("--controller", controllers, {kind.name: kind for kind in CONTROLLERS})
    cases = chosen("--condition", conditions, {case.name: case for case in CONDITIONS})
    if listed:
        list_all(json_mode)
        return
    if folder is not None and not tunables:
        require_free(folder, force)
    from tmm_gen.control.bench import Bench
    from tmm_gen.control.goals.course import begins_elsewhere
    from tmm_gen.control.laws.pd_gains import unstable_pd
    from tmm_gen.control.plant.differing import conditions_of
    from tmm_gen.control.predicted_swing import swings_too_fast
    from tmm_gen.control.quadratic.walls import far_behind
    from tmm_gen.control.task.extremes import naming_extremes

    with naming_extremes(loaded):
        bench = Bench.of(loaded)
        for said in far_behind(loaded, bench.problem):
            click.echo(said, err=True)
        if tunables:
            tuned(scene, bench, tunables, evaluations, seed, workers, refine, out, force, json_mode)
            return
        if folder is not None:
            from tmm_gen.onboard.emit import usual_controller

            kinds = kinds or [BY_NAME[usual_controller(bench)]]
            require_solvers(kinds)
            for said in swings_too_fast(bench, [kind.name for kind in kinds]):
                click.echo(said, err=True)
            emit(bench, [kind.name for kind in kinds], folder, real, name, force, json_mode)
            return
        kinds = kinds or [kind for kind in CONTROLLERS if kind.compared(bench)]
        require_solvers(kinds)
        names = [kind.name for kind in kinds]
        for said in (*unstable_pd(bench, names), *swings_too_fast(bench, names)):
            click.echo(said, err=True)
        if bench.course is not None and (begun := begins_elsewhere(loaded, bench.problem, bench.course)):
            click.echo(begun, err=True)
        trials = _trials(loaded, bench, kinds, cases or [*conditions_of(loaded)], until, seed, compiled)
        show(loaded, trials, until, write_files(bench, trials, picture, animated), json_mode)


def _trials(
    scene: Scene,
    bench: Bench,
    kinds: list[ControllerKind],
    cases: list[Condition],
    until: float,
    seed: int,
    compiled: bool,
) -> list[Trial]:
    """Return the trials of all controllers under all conditions."""
    from tmm_gen.closed_loop.compare import compare

    done: list[Trial] = []
    with progress(f"controlling {scene.name}", total=len(kinds) * len(cases)) as advance:
        for trial in compare(bench, kinds, cases, until, seed, compiled):
            done.append(trial)
            advance(1, f"{trial.kind.title}, {trial.condition.title}")
    return done
