"""`tmm-gen explain`: what a scene makes the generator model, and what it leaves out."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.changes import changed_scene, set_option
from tmm_gen.cli.console import Column, progress, table
from tmm_gen.cli.hints import hinted
from tmm_gen.cli.kinds import require_served

if TYPE_CHECKING:
    from tmm_gen.explain.explanation import Explained, Explanation
    from tmm_gen.scene import Scene
    from tmm_gen.scene.spatial.tables import SpatialBeam

# SymPy is imported inside: `tmm-gen --help` has no use for it.


@click.command("explain")
@click.argument("scene", metavar="SCENE", type=click.Path(path_type=Path))
@set_option
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def explain(scene: Path, changes: tuple[str, ...], json_mode: bool) -> None:
    """Show what SCENE makes the generator model, what it leaves out and why, and what that saves.

    Each figure is counted: the program of the scene against that of the same scene with the term put in or taken
    out. Operations are floating-point operations, bytes are those of the C structs.
    """
    loaded = require_served("explain", changed_scene(scene, changes))
    found_hints = hinted(loaded, json_mode)
    with progress(f"counting {loaded.name}") as advance:
        from tmm_gen.explain.explanation import explain as explained

        found = explained(loaded, lambda term: advance(1, doing=f"counted {term}"))
    _show(found, found_hints, json_mode)


def _show(found: Explanation, hints: list[str], json_mode: bool) -> None:
    scene, own, everything = found.scene, found.own, found.everything
    facts = {
        "scene": scene.name,
        "stations": scene.stations,
        "real": scene.emit.real,
        "operations_per_step": own.step,
        "operations_per_output": own.output,
        "operations_of_prepare": own.prepare,
        "state_bytes": own.state_bytes,
        "model_bytes": own.model_bytes,
        "everything_operations_per_step": everything.step,
        "everything_state_bytes": everything.state_bytes,
        "hints": hints,
        "beams": (beams := _beams(scene)),
    }
    title = (
        f"{scene.title}: {own.step} operations a step, {own.state_bytes} bytes of state, "
        f"{own.model_bytes} of model"
    )
    columns = [
        Column("status"),
        Column("term"),
        Column("why"),
        Column("operations_per_step", "operations a step", "+d"),
        Column("operations_per_output", "an output", "+d"),
        Column("state_bytes", "bytes of state", "+d"),
        Column("model_bytes", "of model", "+d"),
    ]
    table([_row(each) for each in found.terms], columns, json_mode, title=title, more=facts)
    if json_mode:
        return
    for beam in beams:
        if beam["from_section"]:
            click.echo(
                f"{beam['beam']}: {_bending(beam)} and {beam['mass_per_length']:.6g} kg/m, "
                "as material and section have it"
            )
    click.echo("modelled: what the term costs; left out: what it would cost, and leaving it out saves")
    click.echo(
        f"all that was left out put in at once: {everything.step} operations a step "
        f"({everything.step / max(own.step, 1):.1f} times as many), {everything.state_bytes} bytes of state"
    )


def _beams(scene: Scene) -> list[dict[str, object]]:
    """Return the numbers of each beam, given or as they follow from its material and section."""
    from tmm_gen.scene.check import document_of
    from tmm_gen.scene.spatial.document import SpatialDocument

    document = document_of(scene.source)
    if isinstance(document, SpatialDocument):
        return [_in_space(beam) for beam in document.beam]
    found: list[dict[str, object]] = []
    for beam in document.beams().values():
        name, (stiffness, mass) = getattr(beam, "name", ""), beam.stiffness_and_mass()
        found.append(
            {
                "beam": f"beam '{name}'" if name else "beam",
                "bending_stiffness": stiffness,
                "mass_per_length": mass,
                "from_section": beam.section is not None,
            }
        )
    return found


def _in_space(beam: SpatialBeam) -> dict[str, object]:
    """Return the numbers of a beam in space: EI about its y and z axes, GJ where it twists."""
    from tmm_gen.scene.spatial.beam import per_length

    numbers = per_length(beam)
    return {
        "beam": f"beam '{beam.name}'",
        "bending_stiffness": [float(each) for each in numbers.bending],
        "torsional_stiffness": None if numbers.twisting is None else float(numbers.twisting),
        "mass_per_length": float(numbers.mass),
        "from_section": beam.section is not None,
    }


def _bending(beam: dict[str, object]) -> str:
    """Return the stiffnesses of a beam in words."""
    bending, twisting = beam["bending_stiffness"], beam.get("torsional_stiffness")
    if not isinstance(bending, list):
        return f"EI = {bending:.6g} N m^2"
    y, z = bending
    told = f"EI = {y:.6g} and {z:.6g} N m^2 about y and z"
    return told if twisting is None else f"{told}, GJ = {twisting:.6g} N m^2"


def _row(explained: Explained) -> dict[str, object]:
    worth = explained.worth
    return {
        "term": explained.term,
        "status": "modelled" if explained.modelled else "left out",
        "why": explained.why,
        "operations_per_step": worth.step,
        "operations_per_output": worth.output,
        "operations_of_prepare": worth.prepare,
        "state_bytes": worth.state_bytes,
        "model_bytes": worth.model_bytes,
    }
