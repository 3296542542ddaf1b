"""`tmm-gen rest` of an arm in space."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from tmm_gen.cli.console import Column, print_json, progress, say_written, table
from tmm_gen.cli.given import picture_file
from tmm_gen.cli.outputs import write_outputs
from tmm_gen.cli.rest_table import say_starts, six, title_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from tmm_gen.modal.space.equilibria import SpaceEquilibria
    from tmm_gen.scene import Scene
    from tmm_gen.scene.spatial.arm import SpatialArm

_ALL = 4
"""Joints up to which a table shows all angles and torques."""


def show_space_rest(
    scene: Scene,
    inputs: dict[str, float],
    start: NDArray[np.float64] | None,
    picture: Path | None,
    json_mode: bool,
) -> None:
    """Find and show the equilibria of an arm in space."""
    import numpy as np

    # what overflows is refused
    with progress(f"balancing {scene.name}") as advance, np.errstate(all="ignore"):
        from tmm_gen.modal.near import FROM_START, NEAR
        from tmm_gen.modal.space.equilibria import equilibria_in_space
        from tmm_gen.modal.space.situation import arm_numbers

        numbers = arm_numbers(scene, inputs)
        arm = numbers.arm
        held = equilibria_in_space(numbers, inputs, scene.name, advance, start)
        files: list[Path] = []
        if picture is not None:
            from tmm_gen.report.space_rest import space_rest_picture

            target = picture_file(picture, scene.name, "-rest")
            files = write_outputs(
                {target: space_rest_picture(arm, scene.title, held, target.suffix[1:].lower())}
            )
    _show(scene, arm, inputs, held, FROM_START if start is None else NEAR, files, json_mode)


def _show(
    scene: Scene,
    arm: SpatialArm,
    inputs: dict[str, float],
    held: SpaceEquilibria,
    origin: str,
    files: list[Path],
    json_mode: bool,
) -> None:
    from tmm_gen.modal.near import parts_that_turn
    from tmm_gen.report.rest_rows import space_rest_row
    from tmm_gen.simulate.skeleton import Skeleton

    free = [joint.name for joint in arm.joints if joint.stiffness == 0.0]
    rows = [space_rest_row(arm, number, each, origin) for number, each in enumerate(held.found, start=1)]
    if json_mode:
        facts = {
            "scene": scene.name,
            "inputs": [{"name": name, "value": value} for name, value in inputs.items()],
            "free_joints": free,
            "joint_names": [joint.name for joint in arm.joints],
            "starts": held.starts,
            "files": files,
        }
        print_json({**facts, "rows": rows})
        return
    tips = [tip.name for tip in Skeleton(arm).tips]
    flat = [_flat(row) for row in rows]
    columns = [Column("equilibrium"), Column("state")]
    for name in tips:
        shown = "tip" if len(tips) == 1 else name
        columns += [Column(f"{name} {axis}", f"{shown} {axis} (m)", six, "right") for axis in "xyz"]
    joints = parts_that_turn(arm)
    for _, name in joints:
        for what, heading in (("angle", f"{name} angle (rad)"), ("torque", f"{name} torque (N m)")):
            key = f"{name} {what}"
            # what is nought throughout is left out where a table would be too wide
            if len(joints) <= _ALL or any(six(row[key]) != "0" for row in flat):
                columns.append(Column(key, heading, six, "right"))
    table(flat, columns, title=title_of(scene, len(rows)))
    if free:
        turning = f"{', '.join(free)} turn{'s' * (len(free) == 1)} freely"
        driven = {arm.joints[item.joint - 1].name for item in arm.inputs if item.acts == "torque"}
        motors = "motors hold no torque but that of --input"
        click.echo(f"{turning}: {motors}" if driven & set(free) else turning)
    if arm.base is not None:
        click.echo(
            "nothing holds the base: it stays where it starts, and falls with all it carries under gravity"
        )
    say_starts(held.starts)
    say_written(files, "--plot draws them, --json has every frame, angle and torque")


def _flat(row: dict[str, Any]) -> dict[str, Any]:
    """Return a row of the table."""
    flat = {"equilibrium": row["equilibrium"], "state": row["state"]}
    for frame in row["frames"]:
        flat |= {f"{frame['name']} {axis}": frame[axis] for axis in "xyz"}
    for joint in row["joints"]:
        flat |= {f"{joint['name']} {key}": joint[key] for key in ("angle", "torque")}
    return flat
