"""`tmm-gen check --lint`: a scene's C before compilers and analysers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from tmm_gen.cli.console import Column, progress, table

if TYPE_CHECKING:
    from tmm_gen.scene import Scene

_COLUMNS: list[Column | str] = [
    Column("check", form=lambda value: str(value).replace("_", " ")),
    Column("passed", "holds"),
    "meaning",
]


def check_lint(scene: Scene, json_mode: bool) -> int:
    """Run every named check of a scene's C.

    Returns
    -------
    int
        1 if one of them has something to say, else 0.
    """
    with progress(f"looking at {scene.name}"):
        from tmm_gen.emit.c import emit_c
        from tmm_gen.program.build import build_program
        from tmm_gen.target.lint import lint

        found = lint(emit_c(build_program(scene), scene), scene.emit.real)
    passed = all(row.passed for row in found)
    rows = [
        {"check": row.check, "passed": row.passed, "meaning": row.meaning, "said": row.said} for row in found
    ]
    table(rows, _COLUMNS, json_mode, title=scene.title, more={"scene": scene.name, "passed": passed})
    if not json_mode:
        for row in found:
            if not row.passed:
                click.echo(f"{row.check}: {row.said}")
    return 0 if passed else 1
