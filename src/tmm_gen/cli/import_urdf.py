"""`tmm-gen import`: a scene from a URDF file."""

from __future__ import annotations

import shlex
from pathlib import Path

import click

from tmm_gen.cli.console import print_json
from tmm_gen.cli.outputs import OutputFile, claim, force_option, require_new, write_outputs

# Readers are imported inside: `tmm-gen --help` has no use for them.


@click.command("import")
@click.argument("urdf", metavar="ROBOT.urdf", type=click.Path(path_type=Path))
@click.option(
    "--flex",
    type=click.Path(path_type=Path),
    help="TOML file that says which joints and links give way, and which joints stay where they are.",
)
@click.option("--out", type=OutputFile(".toml"), help="Scene to write; by default NAME.toml.")
@force_option
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a report.")
def import_urdf(urdf: Path, flex: Path | None, out: Path | None, force: bool, json_mode: bool) -> None:
    """Write the scene that a URDF file makes, with every decision in a comment.

    Revolute and continuous joints become motors, links become bodies, fixed joints are merged. With --flex,
    `[joint.NAME]` gives a joint a gear (stiffness, damping, rotor_inertia, gear) or locks it (lock), and `[link.NAME]`
    makes a beam of a link (links, E, G and section, or bending_stiffness and torsional_stiffness).
    """
    from tmm_gen.scene import load_scene
    from tmm_gen.urdf.scene_text import imported_scene

    claim((out,), (urdf, flex))
    require_new(out, force)
    scene = imported_scene(urdf, flex)
    target = out or Path(f"{scene.name}.toml")
    write_outputs({target: scene.text}, (urdf, *((flex,) if flex else ())), force=force)
    load_scene(target)  # what only the whole can tell is told of the scene, which is there to be mended
    if json_mode:
        print_json(
            {
                "scene": scene.name,
                "file": target,
                "motors": [{"joint": joint, "name": name} for joint, name in scene.motors.items()],
                "gears": scene.gears,
                "bodies": scene.bodies,
                "beams": scene.beams,
                "inputs": scene.inputs,
                "outputs": scene.outputs,
                "decisions": scene.decisions,
            }
        )
        return
    counted = {
        "motor": len(scene.motors),
        "gear that gives way": len(scene.gears),
        "body": len(scene.bodies),
        "beam": len(scene.beams),
    }
    several = {"gear that gives way": "gears that give way", "body": "bodies"}
    parts = [f"{n} {what if n == 1 else several.get(what, what + 's')}" for what, n in counted.items() if n]
    rigid = "" if scene.gears or scene.beams else ", all rigid"
    click.echo(f"wrote {target}: {', '.join(parts)}{rigid}")
    click.echo(f"{len(scene.decisions)} decisions stand in its comments")
    named = shlex.quote(str(target))
    click.echo(f"next: read them, then `tmm-gen build {named}` and `tmm-gen run {named}`")
