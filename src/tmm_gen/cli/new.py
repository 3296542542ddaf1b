"""`tmm-gen new`: a commented scene to start from."""

from __future__ import annotations

import shlex
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.outputs import OutputFolder, write_outputs
from tmm_gen.errors import UserError

if TYPE_CHECKING:
    from tmm_gen.scene.model import Kind

# The scene package is imported inside: it loads pydantic, which `tmm-gen --help` has no use for.

_NOT_TO_START_WITH: Mapping[tuple[str, str], str] = {
    ("--control", "chain"): "a chain has no motor to be controlled. Add --kind planar.",
    (
        "--control",
        "spatial",
    ): "a new arm in space has no [control] yet. Add --kind planar, or write the table yourself.",
    ("--motors", "chain"): "a chain has no motors at its joints. Add --kind planar.",
    ("--motors", "spatial"): "an arm in space starts with two. Leave it out, or add --kind planar.",
}
"""Why a new scene of a kind does not begin with what an option of `new` asks for."""


@click.command("new")
@click.argument("name")
@click.option(
    "--kind",
    type=click.Choice(["chain", "planar", "spatial"]),
    default="chain",
    show_default=True,
    help="Torsional chain, or arm in a plane or in space.",
)
@click.option(
    "--out",
    type=OutputFolder(),
    default=Path("scenes"),
    show_default=True,
    help="Folder to write to; made if missing.",
)
@click.option("--control", is_flag=True, help="With [control], for `tmm-gen mpc`; planar only.")
@click.option(
    "--motors",
    type=click.IntRange(1, 20),
    help="An arm of parts with so many motors, a beam on each; planar only.",
)
@click.option("--force", is_flag=True, help="Replace a scene of that name.")
def new(name: str, kind: Kind, out: Path, control: bool, motors: int | None, force: bool) -> None:
    """Write a commented scene NAME.toml to start from."""
    from tmm_gen.scene.identifier import scene_name_fault
    from tmm_gen.scene.problem import show_value
    from tmm_gen.scene.schema import DIRECTIVE, SCHEMA_FILE
    from tmm_gen.scene.template import template

    if fault := scene_name_fault(name):
        raise UserError(f"NAME: {fault[0]} (got {show_value(name)}). {fault[1]}")
    for option, given in (("--control", control), ("--motors", motors)):
        if given and (refusal := _NOT_TO_START_WITH.get((option, kind))):
            raise UserError(f"{option}: {refusal}")
    target = out / f"{name}.toml"
    if target.is_symlink() or target.exists():
        if target.is_dir():
            raise UserError(f"{target}: is a directory. Choose another name.")
        if not force:
            raise UserError(f"{target}: exists already. Choose another name, or replace it with --force.")
    # editors look for the schema beside the scene
    first = DIRECTIVE if (out / SCHEMA_FILE).is_file() else ""
    write_outputs({target: first + template(name, kind, control, motors or 0)}, force=force)
    click.echo(f"wrote {target}")
    then = "mpc" if control else "run"
    named = shlex.quote(str(target))
    click.echo(f"next: edit it, then `tmm-gen build {named}` and `tmm-gen {then} {named}`")
