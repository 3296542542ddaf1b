"""`tmm-gen keys`: every key a scene may have."""

from __future__ import annotations

import click

from tmm_gen.cli.console import Column, table


def header(words: str) -> str:
    """Return a table's header as a file has it."""
    return words.partition(" ")[0]


def name(words: str) -> str:
    """Return the name of a table."""
    return header(words).strip("[]")


@click.command("keys")
@click.argument("wanted", metavar="[TABLE]", required=False)
@click.option("--markdown", is_flag=True, help="As a page of documentation.")
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def keys(wanted: str | None, markdown: bool, json_mode: bool) -> None:
    """List every key of a scene file, or those of one TABLE such as `beam` or `emit.budget`."""
    from tmm_gen.scene import reference

    if markdown:
        if wanted is not None or json_mode:
            raise click.UsageError("--markdown lists everything, and is no JSON.")
        click.echo(reference.markdown(), nl=False)
        return
    every = list(reference.keys())
    rows = [key for key in every if wanted is None or wanted in (header(key.table), name(key.table))]
    if not rows:
        tables = dict.fromkeys(name(key.table) for key in every if key.table)
        raise click.UsageError(f"{wanted}: is no table of a scene; choose from {', '.join(tables)}.")
    table(
        [
            {
                "table": key.table,
                "key": key.key,
                "value": key.value,
                "default": key.default,
                "meaning": key.meaning,
                "example": key.example,
                "required": key.default is None,
            }
            for key in rows
        ],
        [
            *(Column("table"), Column("key"), Column("value"), Column("meaning")),
            Column("default", "if absent", lambda d: "must be there" if d is None else d or "not modelled"),
        ],
        json_mode,
        title="Keys of a scene file",
    )
