"""`tmm-gen modes` of an arm in space."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from tmm_gen.cli.console import Column, progress, say_written, table
from tmm_gen.cli.given import picture_file
from tmm_gen.cli.modes_table import say_unsure
from tmm_gen.cli.outputs import write_outputs

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from tmm_gen.modal.space.situation import RestingArm
    from tmm_gen.scene import Scene

_STRAIGHT = 1e-9
"""rad."""


def show_space_modes(
    scene: Scene,
    count: int,
    inputs: dict[str, float],
    start: NDArray[np.float64] | None,
    picture: Path | None,
    json_mode: bool,
) -> None:
    """Find and show the modes of an arm in space."""
    import numpy as np

    with progress(f"finding modes of {scene.name}"), np.errstate(all="ignore"):  # what overflows is refused
        from tmm_gen.modal.mode_rows import space_mode_row
        from tmm_gen.modal.space.situation import resting_in_space

        resting = resting_in_space(scene, inputs, start)
        found = resting.modes(count)
        rows = [space_mode_row(resting, number, mode) for number, mode in enumerate(found)]
        files: list[Path] = []
        if picture is not None:
            from tmm_gen.report.space_modes import space_mode_picture

            target = picture_file(picture, scene.name, "-modes")
            files = write_outputs({target: space_mode_picture(resting, found, target.suffix[1:].lower())})
    _show(resting, rows, files, json_mode)


def _show(resting: RestingArm, rows: list[dict[str, Any]], files: list[Path], json_mode: bool) -> None:
    scene, rest = resting.scene, resting.still.angles
    columns = [
        Column("mode"),
        Column("frequency_hz", "frequency (Hz)", ".6g"),
        Column("damping_ratio", "damping ratio", ".4g"),
        Column("mostly", "what moves, by energy"),
    ]
    if any(row["motion"] != "swings" for row in rows):
        columns.append(Column("motion"))
    facts: dict[str, object] = {
        "scene": scene.name,
        "kind": scene.model.kind,
        "stations": scene.stations,
        "joint_names": [joint.name for joint in resting.arm.joints],
        "stable": not any(row["motion"] == "falls over" for row in rows),
        "rest_angles": rest,
        "files": files,
    }
    count = len(rest)
    title = f"{scene.title}: {count} joint{'s' * (count > 1)}"
    table(rows, columns, json_mode, title=title, more=facts)
    if json_mode:
        return
    if float(max(abs(rest))) > _STRAIGHT:
        from tmm_gen.modal.near import parts_that_turn

        turned = [(name, math.degrees(rest[number - 1])) for number, name in parts_that_turn(resting.arm)]
        told = ", ".join(f"{name} {round(angle, 3):g}" for name, angle in turned if round(angle, 3))
        click.echo("about the static equilibrium" + (f", in degrees: {told}" if told else ""))
    say_unsure(rows)
    say_written(files, "--plot draws the mode shapes, --count N shows more or fewer")
