"""`tmm-gen rest`: static equilibria of an arm in a plane or in space."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from tmm_gen.cli.changes import changed_scene, set_option
from tmm_gen.cli.console import Column, print_json, progress, say_written, table
from tmm_gen.cli.given import picture_file, plot_option, resting_input_option
from tmm_gen.cli.near import near_option
from tmm_gen.cli.outputs import claim, write_outputs
from tmm_gen.cli.rest_table import say_starts, six, title_of
from tmm_gen.cli.space_rest import show_space_rest

if TYPE_CHECKING:
    from tmm_gen.modal.equilibria import Equilibria
    from tmm_gen.scene import Scene

# NumPy, SymPy and Matplotlib are imported inside: `tmm-gen --help` has no use for them.


@click.command("rest")
@click.argument("scene", metavar="SCENE", type=click.Path(path_type=Path))
@resting_input_option
@near_option
@set_option
@plot_option("the arm in each equilibrium", "-rest")
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def rest(
    scene: Path,
    given: tuple[str, ...],
    near: tuple[str, ...],
    changes: tuple[str, ...],
    picture: Path | None,
    json_mode: bool,
) -> None:
    """Show the static equilibria of SCENE, an arm in a plane or in space, under gravity and constant inputs.

    Where a descent from the scene's start ends comes first, or what is found near the angles of --near. Others are
    looked for from every quadrant of each joint that turns freely, as motors without a torque do. Angles of joints are
    those of the outer side against the inner one, torques what the inner side exerts on the outer one.
    """
    loaded = changed_scene(scene, changes)
    from tmm_gen.inputs.given import constant_inputs
    from tmm_gen.modal.near import FROM_START, NEAR, start_of
    from tmm_gen.modal.situation import require_weight

    require_weight(loaded)
    inputs = constant_inputs(loaded, given)
    start = start_of(loaded, near)
    claim((picture,), (scene,))
    if loaded.spatial is not None:
        show_space_rest(loaded, inputs, start, picture, json_mode)
        return
    with progress(f"balancing {loaded.name}") as advance:
        from tmm_gen.modal.equilibria import equilibria

        held = equilibria(loaded, inputs, advance, start)
        files: list[Path] = []
        if picture is not None:
            from tmm_gen.report.rest_picture import rest_picture

            target = picture_file(picture, loaded.name, "-rest")
            files = write_outputs({target: rest_picture(loaded, held, target.suffix[1:].lower())})
    _show(loaded, inputs, held, FROM_START if start is None else NEAR, files, json_mode)


def _show(
    scene: Scene,
    inputs: dict[str, float],
    held: Equilibria,
    origin: str,
    files: list[Path],
    json_mode: bool,
) -> None:
    from tmm_gen.modal.equilibria import free_joints
    from tmm_gen.modal.near import joint_name
    from tmm_gen.report.rest_rows import named_ends, rest_row

    names = {number: joint_name(scene, number) for number in free_joints(scene)}
    rows = [rest_row(scene, number, each, origin) for number, each in enumerate(held.found, start=1)]
    if json_mode:
        facts = {
            "scene": scene.name,
            "inputs": [{"name": name, "value": value} for name, value in inputs.items()],
            "free_joints": list(names.values()),
            "starts": held.starts,
            "files": files,
        }
        print_json({**facts, "rows": rows})
        return
    columns = [Column("equilibrium"), Column("state")]
    for end, name in named_ends(scene):
        columns += [Column(f"{axis}{end}", f"{name} {axis} (m)", six, "right") for axis in "xy"]
    for name in [part.name for part in scene.parts if part.joint] or ["joint 1"]:
        columns.append(Column(f"{name} angle", f"{name} angle (rad)", six, "right"))
        columns.append(Column(f"{name} torque", "torque (N m)", six, "right"))
    table([_flat(scene, row) for row in rows], columns, title=title_of(scene, len(rows)))
    if names:
        motors = any(part.kind == "motor" for part in scene.parts) or (scene.hub and not scene.floats)
        turning = f"{', '.join(names.values())} turn{'s' * (len(names) == 1)} freely"
        click.echo(f"{turning}: motors hold no torque but that of --input" if motors else turning)
    say_starts(held.starts)
    say_written(files, "--plot draws them, --json has every node, angle and torque")


def _flat(scene: Scene, row: dict[str, Any]) -> dict[str, object]:
    """Return a row of the table: of joints those that have a column."""
    from tmm_gen.report.rest_rows import named_ends

    places = row["nodes"]
    flat = {"equilibrium": row["equilibrium"], "state": row["state"]}
    for end, _ in named_ends(scene):
        flat |= {f"x{end}": places[end][0], f"y{end}": places[end][1]}
    for joint in row["joints"]:
        flat |= {f"{joint['name']} {key}": joint[key] for key in ("angle", "torque")}
    return flat
