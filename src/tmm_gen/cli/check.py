"""`tmm-gen check`: every backend of a scene against the others and against the exact response."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.changes import changed_scene, set_option
from tmm_gen.cli.check_lint import check_lint
from tmm_gen.cli.check_proof import check_proof
from tmm_gen.cli.check_target import TARGETS, check_target
from tmm_gen.cli.console import Column, progress, table
from tmm_gen.cli.given import positive
from tmm_gen.cli.hints import hinted

if TYPE_CHECKING:
    from tmm_gen.inputs.signals import Signal
    from tmm_gen.scene import Scene

# NumPy, SymPy and CasADi are imported inside: `tmm-gen --help` has no use for them.

_COLUMNS: list[Column | str] = [
    Column("check", form=lambda value: str(value).replace("_", " ")),
    Column("value", form=".2g"),
    Column("bound", "at most", ".2g"),
    Column("passed", "holds"),
    "meaning",
]

_COMPENSATED = {
    "emit.real": "float32",
    "emit.compensated": True,
    "emit.trigonometry": "own",
    "emit.favour": "size",
}


@click.command("check")
@click.argument("scene", metavar="SCENE", type=click.Path(path_type=Path))
@click.option(
    "--target", type=click.Choice(TARGETS), help="Run the C on an emulated microcontroller instead."
)
@click.option(
    "--prove", "prove_mode", is_flag=True, help="Prove the C free of faults within [emit.box] instead."
)
@click.option("--lint", "lint_mode", is_flag=True, help="Show the C to compilers and analysers instead.")
@click.option(
    "--real", type=click.Choice(["float64", "float32"]), help="Number type of the C, not the scene's."
)
@click.option(
    "--compensated",
    is_flag=True,
    help="float32 with each number as the sum of two, and own sines: [emit] compensated.",
)
@click.option("--step", type=float, callback=positive, help="Time step, s; by default the scene's.")
@click.option(
    "--input",
    "given",
    metavar="NAME=VALUE|NAME=PROFILE|FILE.csv",
    multiple=True,
    help="A force or torque of the run that is compared, as for `tmm-gen run`; by default each is 1. Repeatable.",
)
@set_option
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def check(
    scene: Path,
    target: str | None,
    prove_mode: bool,
    lint_mode: bool,
    real: str | None,
    compensated: bool,
    step: float | None,
    given: tuple[str, ...],
    changes: tuple[str, ...],
    json_mode: bool,
) -> int:
    """Compile SCENE's C and compare every backend with the others and with the exact response.

    The exact response is the matrix exponential of the assembled matrices of the chain, written
    independently of the derivation. Exits with 1 if a comparison exceeds its bound.

    With --target the C is compiled for a microcontroller and run in an emulator: bits are compared with
    this machine's, instructions, code, memory and stack with [emit.budget].

    With --prove Frama-C shows that for all states and inputs within [emit.box] no index leaves its array,
    nothing is read before it is written, nothing is divided by zero, and no number becomes infinite.

    With --lint gcc and clang compile the C with all warnings, gcc's analyser and cppcheck with its MISRA
    addon look at it, and its own test is run under sanitizers.
    """
    loaded = changed_scene(scene, changes, step)
    if compensated and real == "float64":
        raise click.UsageError("--compensated is a way of computing in float32: leave --real out")
    if real is not None:
        loaded = loaded.replace(**{"emit.real": real, "emit.compensated": False})
    if compensated:
        loaded = loaded.replace(**_COMPENSATED)
    if (target is not None) + prove_mode + lint_mode > 1:
        raise click.UsageError("--target, --prove and --lint are checks of their own: name one")
    loads = _loads(loaded, given)
    if given and (target is not None or prove_mode or lint_mode):
        raise click.UsageError(
            "--input is for the comparison of runs: leave it, or --target, --prove and --lint, out"
        )
    hints = hinted(loaded, json_mode)
    if lint_mode:
        return check_lint(loaded, json_mode)
    if prove_mode:
        return check_proof(loaded, json_mode)
    if target is not None:
        return check_target(loaded, target, json_mode)
    with progress(f"checking {loaded.name}", total=1.0) as advance:
        from tmm_gen.verify.check import check_scene

        report = check_scene(loaded, advance, loads)
    rows = [
        {
            "check": row.check,
            "value": row.value,
            "bound": row.bound,
            "passed": row.passed,
            "meaning": row.meaning,
        }
        for row in report.rows
    ]
    facts = {
        "scene": loaded.name,
        "passed": report.passed,
        "why": report.why or None,
        "hints": hints,
        **report.facts,
    }
    table(rows, _COLUMNS, json_mode, title=f"{loaded.title} ({loaded.integrator.name})", more=facts)
    if not json_mode:
        if "ns_per_step" in report.facts:
            click.echo(
                f"one step takes {report.facts['ns_per_step']:.0f} ns in C on this machine "
                f"(± {100 * float(str(report.facts['ns_spread'])):.0f} %), "
                f"{report.facts['operations_per_step']} floating-point operations"
            )
        if report.why:
            click.echo(report.why)
        click.echo("everything holds" if report.passed else "NOT everything holds: see the rows marked 'no'")
    return 0 if report.passed else 1


def _loads(scene: Scene, given: tuple[str, ...]) -> dict[str, Signal]:
    """Return the forces and torques that are given.

    Raises
    ------
    UserError
        If a name is unknown, or that of an angle: a prescribed base is moved by the check itself.
    """
    if not given:
        return {}
    from tmm_gen.inputs.given import read_inputs
    from tmm_gen.scene.signal import PRESCRIBED

    return read_inputs(given, tuple(item.name for item in scene.inputs if item.acts not in PRESCRIBED))
