"""`tmm-gen explain`: what a scene makes the generator model, and what it leaves out."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.changes import changed_scene, set_option
from tmm_gen.cli.console import Column, progress, table
from tmm_gen.cli.hints import hinted

if TYPE_CHECKING:
    from tmm_gen.api.explained import Explained

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
    loaded = changed_scene(scene, changes)
    found_hints = hinted(loaded, json_mode)
    with progress(f"counting {loaded.name}") as advance:
        from tmm_gen.api.explained import explained

        found = explained(loaded, lambda term: advance(1, doing=f"counted {term}"))
    _show(found, found_hints, json_mode)


def _show(found: Explained, hints: list[str], json_mode: bool) -> None:
    from tmm_gen.explain.rows import beam_rows, beam_sentences, headline, whole_sentence

    scene, own, everything = found.explanation.scene, found.cost, found.everything
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
        "beams": beam_rows(scene),
    }
    columns = [
        Column("status"),
        Column("term"),
        Column("why"),
        Column("operations_per_step", "operations a step", "+d"),
        Column("operations_per_output", "an output", "+d"),
        Column("state_bytes", "bytes of state", "+d"),
        Column("model_bytes", "of model", "+d"),
    ]
    table(found.rows, columns, json_mode, title=headline(found.explanation), more=facts)
    if json_mode:
        return
    for line in beam_sentences(scene):
        click.echo(line)
    click.echo("modelled: what the term costs; left out: what it would cost, and leaving it out saves")
    click.echo(whole_sentence(found.explanation))
