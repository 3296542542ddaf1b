"""`tmm-gen playground`: a page on which the reader plays with an arm."""

from __future__ import annotations

from pathlib import Path

import click

from tmm_gen.cli.changes import changed_scene, set_option
from tmm_gen.cli.console import progress
from tmm_gen.cli.given import positive
from tmm_gen.cli.outputs import OutputFile, claim, write_outputs
from tmm_gen.cli.study_options import words

# NumPy and SymPy are imported inside: `tmm-gen --help` has no use for them.


@click.command("playground")
@click.argument("scene", metavar="SCENE", type=click.Path(path_type=Path))
@click.option(
    "--out",
    "target",
    metavar="FILE.html",
    type=OutputFile(".html"),
    help="The page; by default NAME-playground.html.",
)
@click.option(
    "--integrators",
    metavar="A,B",
    callback=words,
    help="To choose from, besides the scene's own and sdirk4; by default newmark, bathe, houbolt and zhai.",
)
@click.option(
    "--until",
    type=float,
    callback=positive,
    help="Length of a run, s; by default five slow periods, or 5000 steps if that is shorter.",
)
@set_option
def playground(
    scene: Path,
    target: Path | None,
    integrators: tuple[str, ...],
    until: float | None,
    changes: tuple[str, ...],
) -> None:
    """Write one page on which the reader plays with SCENE: its C code as WebAssembly.

    Sliders change stiffness, payload, load, step and integrator; the arm moves beside what a fine step says, with its
    error and its cost. The page works offline, on a telephone too, and needs nothing else.
    """
    from tmm_gen.playground.webassembly import require_compiler

    loaded = changed_scene(scene, changes)
    file = target or Path(f"{loaded.name}-playground.html")
    claim((file,), (scene,))
    require_compiler()

    from tmm_gen.playground.page import playground as page
    from tmm_gen.playground.page import served_names

    count = len(served_names(loaded, integrators))
    with progress(f"building {loaded.name}", total=count) as advance:
        text = page(loaded, integrators, until, lambda doing: advance(1, doing))
    for path in write_outputs({file: text}, (scene,)):
        click.echo(f"wrote {path}: {count} integrators, {len(text.encode()) / 1e3:.0f} kB")
