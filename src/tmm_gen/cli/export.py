"""`tmm-gen export`: the same arm for other tools."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.changes import changed_scene
from tmm_gen.cli.console import print_json, progress
from tmm_gen.cli.outputs import OutputFile, claim, write_outputs
from tmm_gen.errors import UserError

if TYPE_CHECKING:
    from tmm_gen.scene import Scene

# SymPy, FMPy and the rest are imported inside: `tmm-gen --help` has no use for them.

_SUFFIX = {"fmu": ".fmu", "mjcf": ".xml", "urdf": ".urdf"}


@click.command("export")
@click.argument("scene", metavar="SCENE", type=click.Path(path_type=Path))
@click.option(
    "--to",
    type=click.Choice(sorted(_SUFFIX)),
    required=True,
    help="Functional mock-up unit, MuJoCo, or URDF of arms in space.",
)
@click.option("--out", type=OutputFile(), help="File to write; by default NAME with the ending of its kind.")
@click.option("--fmi", type=click.Choice(["2", "3"]), help="Version of FMI; by default 2.")
@click.option("--cc", default="gcc", show_default=True, help="Compiler of the unit's binary.")
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a report.")
def export(scene: Path, to: str, out: Path | None, fmi: str | None, cc: str, json_mode: bool) -> None:
    """Write SCENE for another tool.

    `--to fmu`: a functional mock-up unit for co-simulation, FMI 2.0 or 3.0, with sources and a binary for this
    machine, validated by FMPy. `--to mjcf`: a model for MuJoCo. `--to urdf`: of an arm in space what URDF can hold;
    the rest is told.
    """
    claim((out,), (scene,))
    if fmi is not None and to != "fmu":
        raise UserError(f"--fmi {fmi}: is for --to fmu only. Leave it out.")
    chosen = changed_scene(scene)
    target = out or Path(f"{chosen.name}{_SUFFIX[to]}")
    if target.suffix.lower() != _SUFFIX[to]:
        raise UserError(f"--out {target}: must end in {_SUFFIX[to]}, or the other tool will not know it.")
    with progress(f"exporting {chosen.name}"):
        if to == "fmu":
            facts, report = _fmu(chosen, target, fmi or "2", cc)
        else:
            facts, report = (_mjcf if to == "mjcf" else _urdf)(chosen, target)
    if json_mode:
        print_json({"scene": chosen.name, "to": to, "file": target, **facts})
        return
    click.echo(f"wrote {target}: {report[0]}")
    for line in report[1:]:
        click.echo(f"  {line}")


def _fmu(scene: Scene, target: Path, fmi: str, cc: str) -> tuple[dict[str, object], list[str]]:
    """Write a unit; return what JSON and what a person is told."""
    from tmm_gen.export.fmu import fmu

    content = fmu(scene, 3 if fmi == "3" else 2, cc)
    write_outputs({target: content})
    step = scene.integrator.step
    facts: dict[str, object] = {
        "fmi": f"{fmi}.0",
        "step": step,
        "bytes": len(content),
        "real": scene.emit.real,
    }
    report = [
        f"FMI {fmi}.0 for co-simulation, {len(content)} bytes, validated by FMPy",
        f"communication steps are multiples of {step:g} s",
    ]
    return facts, report


def _mjcf(scene: Scene, target: Path) -> tuple[dict[str, object], list[str]]:
    """Write a model; return what JSON and what a person is told."""
    from tmm_gen.export.mjcf import KEYFRAME, mujoco_model

    model = mujoco_model(scene)
    write_outputs({target: model.text})
    facts: dict[str, object] = {
        "timestep": model.timestep,
        "keyframe": KEYFRAME,
        "outputs": [
            {
                "name": reading.name,
                "constant": reading.constant,
                "terms": [
                    {"sensor": sensor, "component": component, "factor": factor}
                    for sensor, component, factor in reading.terms
                ],
            }
            for reading in model.readings
        ],
        "left_out": model.left_out,
    }
    report = [
        f"a MuJoCo model, RK4 with steps of {model.timestep:g} s; start from the keyframe '{KEYFRAME}'",
        *map(str, model.readings),
        *model.left_out,
    ]
    return facts, report


def _urdf(scene: Scene, target: Path) -> tuple[dict[str, object], list[str]]:
    """Write a robot; return what JSON and what a person is told."""
    from tmm_gen.export.urdf import urdf_model

    model = urdf_model(scene)
    write_outputs({target: model.text})
    facts: dict[str, object] = {"joints": model.joints, "links": model.links, "left_out": model.left_out}
    left = [f"left out: {reason}" for reason in model.left_out]
    return facts, [f"a URDF robot of {model.links} links and {model.joints} joints", *left]
