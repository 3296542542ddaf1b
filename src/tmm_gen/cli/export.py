"""`tmm-gen export`: the same arm for other tools."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.changes import changed_scene
from tmm_gen.cli.console import print_json, progress
from tmm_gen.cli.outputs import OutputOf, claim, force_option, write_outputs
from tmm_gen.errors import UserError

if TYPE_CHECKING:
    from tmm_gen.scene import Scene

# SymPy, FMPy and the rest are imported inside: `tmm-gen --help` has no use for them.

_FOLDER = "acados"
"""What is written as a folder of files."""
_SUFFIX = {"fmu": ".fmu", "mjcf": ".xml", "urdf": ".urdf"}


@click.command("export")
@click.argument("scene", metavar="SCENE", type=click.Path(path_type=Path))
@click.option(
    "--to",
    type=click.Choice(sorted([*_SUFFIX, _FOLDER])),
    required=True,
    is_eager=True,
    help="Functional mock-up unit, MuJoCo, URDF of arms in space, or discrete dynamics in C for acados.",
)
@click.option(
    "--out",
    metavar="PATH",
    type=OutputOf("to", (_FOLDER,)),
    help="File to write, by default NAME with the ending of its kind; for acados a folder, NAME_discrete_model.",
)
@click.option("--fmi", type=click.Choice(["2", "3"]), help="Version of FMI; by default 2.")
@click.option(
    "--controller",
    metavar="NAME",
    help="With --to fmu: a unit of this controller of the scene's [control], such as rti-zero, not of the arm.",
)
@click.option("--cc", default="gcc", show_default=True, help="Compiler of the unit's binary.")
@force_option
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a report.")
def export(
    scene: Path,
    to: str,
    out: Path | None,
    fmi: str | None,
    controller: str | None,
    cc: str,
    force: bool,
    json_mode: bool,
) -> None:
    """Write SCENE for another tool.

    `--to fmu`: a functional mock-up unit for co-simulation, FMI 2.0 or 3.0, with sources and a binary for this
    machine, validated by FMPy; with `--controller` of a controller instead. `--to mjcf`: a model for MuJoCo.
    `--to urdf`: of an arm in space what URDF can hold; the rest is told. `--to acados`: what a scene's [control]
    predicts with, in C, with first and second derivatives.
    """
    claim((out,), (scene,))
    if fmi is not None and to != "fmu":
        raise UserError(f"--fmi {fmi}: is for --to fmu only. Leave it out.")
    if controller is not None and to != "fmu":
        raise UserError(f"--controller {controller}: is for --to fmu only. Leave it out.")
    if force and to != _FOLDER:
        raise UserError("--force: is for --to acados only. Leave it out: a former result is replaced.")
    chosen = changed_scene(scene)
    if to == _FOLDER:
        _acados(chosen, out, force, json_mode)
        return
    stem = f"{chosen.name}_{controller.replace('-', '_')}" if controller else chosen.name
    target = out or Path(f"{stem}{_SUFFIX[to]}")
    if target.suffix.lower() != _SUFFIX[to]:
        raise UserError(f"--out {target}: must end in {_SUFFIX[to]}, or the other tool will not know it.")
    with progress(f"exporting {chosen.name}"):
        if controller is not None:
            facts, report = _controller(chosen, controller, target, fmi or "2", cc)
        elif to == "fmu":
            facts, report = _fmu(chosen, target, fmi or "2", cc)
        else:
            facts, report = (_mjcf if to == "mjcf" else _urdf)(chosen, target)
    if json_mode:
        print_json({"scene": chosen.name, "to": to, "file": target, **facts})
        return
    click.echo(f"wrote {target}: {report[0]}")
    for line in report[1:]:
        click.echo(f"  {line}")


def _acados(scene: Scene, out: Path | None, force: bool, json_mode: bool) -> None:
    """Write what acados calls, all files or none, and say what they are."""
    from tmm_gen.control.acados_code import acados_code, acados_name
    from tmm_gen.control.bench import Bench
    from tmm_gen.control.task.extremes import naming_extremes

    with progress(f"exporting {scene.name}"), naming_extremes(scene):
        step = Bench.of(scene).step
        texts = acados_code(step)
    name = acados_name(step)
    folder = out or Path(f"{name}_model")
    written = {folder / file: text for file, text in texts.items()}
    write_outputs(dict(written), force=force)
    if json_mode:
        facts = {
            "name": name,
            "sample_time": step.problem.sample_time,
            "x": step.names,
            "u": step.motors.inputs,
        }
        files = [{"file": path, "bytes": len(text.encode())} for path, text in written.items()]
        print_json({"scene": scene.name, "to": _FOLDER, "folder": folder, **facts, "files": files})
        return
    click.echo(f"wrote {folder}: discrete dynamics of {name} in {len(written)} files")
    click.echo(f"  {step.size} states, {step.motors.count} torques held over {step.problem.sample_time:g} s")
    click.echo(f"  copy them over those acados generates in c_generated_code/{name}_model/ and build")


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


def _controller(
    scene: Scene, controller: str, target: Path, fmi: str, cc: str
) -> tuple[dict[str, object], list[str]]:
    """Write a unit of a controller; return what JSON and what a person is told."""
    from tmm_gen.control.bench import Bench
    from tmm_gen.control.task.extremes import naming_extremes
    from tmm_gen.onboard.unit import controller_unit

    with naming_extremes(scene):
        bench = Bench.of(scene)
        content = controller_unit(bench, controller, 3 if fmi == "3" else 2, cc)
    write_outputs({target: content})
    step = bench.problem.sample_time
    facts: dict[str, object] = {
        "controller": controller,
        "fmi": f"{fmi}.0",
        "step": step,
        "bytes": len(content),
        "real": scene.emit.real,
    }
    report = [
        f"{controller} as FMI {fmi}.0 for co-simulation, {len(content)} bytes, validated by FMPy",
        f"samples every {step:g} s; communication steps of that size, or parts of it that end there",
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
