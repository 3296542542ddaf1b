"""`tmm-gen modes`: natural frequencies, damping ratios and mode shapes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from tmm_gen.cli.changes import changed_scene, set_option
from tmm_gen.cli.console import Column, progress, say_written, table
from tmm_gen.cli.given import picture_file, plot_option, resting_input_option
from tmm_gen.cli.modes_table import say_unsure
from tmm_gen.cli.near import near_option
from tmm_gen.cli.outputs import claim, write_outputs
from tmm_gen.cli.space_modes import show_space_modes

if TYPE_CHECKING:
    from tmm_gen.modal.arm import LinearArm
    from tmm_gen.modal.beside import Beside
    from tmm_gen.modal.modes import Mode
    from tmm_gen.scene import Scene

# NumPy, SymPy and Matplotlib are imported inside: `tmm-gen --help` has no use for them.


@click.command("modes")
@click.argument("scene", metavar="SCENE", type=click.Path(path_type=Path))
@click.option(
    "--count",
    type=click.IntRange(min=1),
    default=6,
    show_default=True,
    help="How many modes; those of a base that floats in space come besides.",
)
@resting_input_option
@near_option
@set_option
@plot_option("the mode shapes", "-modes")
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def modes(
    scene: Path,
    count: int,
    given: tuple[str, ...],
    near: tuple[str, ...],
    changes: tuple[str, ...],
    picture: Path | None,
    json_mode: bool,
) -> None:
    """Show natural frequencies, damping ratios and mode shapes of SCENE.

    An arm in a plane or in space swings about its static equilibrium: the one that it reaches from its [initial]
    angles, or that near the angles of --near. A planar arm made from a [beam] is shown beside the exact continuous
    beam, straight and weightless.
    """
    loaded = changed_scene(scene, changes)
    from tmm_gen.inputs.given import constant_inputs
    from tmm_gen.modal.near import start_of

    inputs, start = constant_inputs(loaded, given), start_of(loaded, near)
    claim((picture,), (scene,))
    if loaded.spatial is not None:
        show_space_modes(loaded, count, inputs, start, picture, json_mode)
        return
    with progress(f"finding modes of {loaded.name}"):
        from tmm_gen.modal.beside import Beside
        from tmm_gen.modal.matrices import matrices
        from tmm_gen.modal.mode_rows import mode_row
        from tmm_gen.modal.modes import find_modes
        from tmm_gen.modal.situation import resting_arm

        arm = resting_arm(loaded, inputs, start)
        found = find_modes(matrices(arm), count)
        beside = Beside.of(arm, found)
        rows = [mode_row(number, mode) | beside.row(mode) for number, mode in enumerate(found)]
        files = _draw(picture, arm, found, beside)
    _show(loaded, arm, rows, beside, files, json_mode)


def _draw(picture: Path | None, arm: LinearArm, found: tuple[Mode, ...], beside: Beside) -> list[Path]:
    if picture is None:
        return []
    from tmm_gen.modal.picture import mode_picture

    target = picture_file(picture, arm.scene.name, "-modes")
    exact = None if beside.beam is None else (beside.beam, beside.exact)
    return write_outputs({target: mode_picture(arm, found, exact, target.suffix[1:].lower())})


def _ends_at_rest(scene: Scene, angles: Sequence[float]) -> str:
    """Say where the last link rests, or the last of each branch by the part's name."""
    from tmm_gen.simulate.places import ends

    turned = {number: f"{math.degrees(angles[number - 1]):.3f}" for number in ends(scene)}
    if not scene.hosts:
        return f"the last link rests at {turned[scene.stations]}"
    names = {part.last: part.name for part in reversed(scene.parts)}
    return "ends rest at " + ", ".join(f"{angle} ('{names[number]}')" for number, angle in turned.items())


def _show(
    scene: Scene,
    arm: LinearArm,
    rows: list[dict[str, Any]],
    beside: Beside,
    files: list[Path],
    json_mode: bool,
) -> None:
    columns = [
        Column("mode"),
        Column("frequency_hz", "frequency (Hz)", ".6g"),
        Column("damping_ratio", "damping ratio", ".4g"),
    ]
    if beside.beam is not None:
        if not beside.straight:
            columns.append(Column("straight_hz", "straight, weightless (Hz)", ".6g"))
        columns += [
            Column("exact_hz", "continuous beam (Hz)", ".6g"),
            Column("exact_damping_ratio", "its damping ratio", ".4g"),
            Column("error_percent", "error (%)", "+.3g"),
        ]
    if any(row["motion"] != "swings" for row in rows):
        columns.append(Column("motion"))
    facts: dict[str, object] = {
        "scene": scene.name,
        "kind": scene.model.kind,
        "stations": scene.stations,
        "stable": not any(row["motion"] == "falls over" for row in rows),
        "rest_angles": None if arm.rest is None else arm.rest.angles,
        "hub_angle": arm.rest.hub if arm.rest is not None and arm.hub else None,
        "files": files,
    }
    title = f"{scene.title}: {scene.stations} station{'s' * (scene.stations > 1)}"
    table(rows, columns, json_mode, title=title, more=facts)
    if json_mode:
        return
    if arm.rest is not None and not beside.straight:
        click.echo(f"about the static equilibrium: {_ends_at_rest(scene, arm.rest.angles.tolist())} degrees")
    say_unsure(rows)
    say_written(files, "--plot draws the mode shapes, --count N shows more or fewer")
