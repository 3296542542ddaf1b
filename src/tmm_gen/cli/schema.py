"""`tmm-gen schema`: a JSON schema of scene files, for editors."""

from __future__ import annotations

import json
from pathlib import Path

import click

from tmm_gen.cli.outputs import OutputFile, write_outputs


@click.command("schema")
@click.option(
    "--out",
    "target",
    metavar="FILE.json",
    type=OutputFile(".json"),
    help="Write it into a file; by default it is printed.",
)
def schema(target: Path | None) -> None:
    """Print a JSON schema of scene files, by which editors complete and check them.

    Write it into the folder of your scenes as tmm-gen.schema.json: scenes that `tmm-gen new` writes there point to it
    in their first line. Into your own scenes, put `#:schema tmm-gen.schema.json` as the first line.
    """
    from tmm_gen.scene.schema import scene_schema

    text = json.dumps(scene_schema(), indent=1, sort_keys=True) + "\n"
    if target is None:
        click.echo(text, nl=False)
        return
    for path in write_outputs({target: text}):
        click.echo(f"wrote {path}")
