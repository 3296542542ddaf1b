"""`tmm-gen mpc --tune`: gains and weights of all controllers, found by one optimiser."""

from __future__ import annotations

from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.console import Column, progress, say_written, table
from tmm_gen.cli.outputs import write_outputs
from tmm_gen.errors import UserError
from tmm_gen.reading import read_file

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from tmm_gen.cli.console import Advance
    from tmm_gen.closed_loop.knobs import Tunable
    from tmm_gen.closed_loop.tuning import Tuned
    from tmm_gen.control.bench import Bench
    from tmm_gen.scene import Scene

EVERYTHING = "all"
"""What is tuned unless something is named."""


def tuned(
    file: Path,
    bench: Bench,
    names: tuple[str, ...],
    evaluations: int,
    seed: int,
    workers: int,
    refine: bool,
    out: Path | None,
    force: bool,
    json_mode: bool,
) -> None:
    """Tune what is named, one after the other, and write the scene with the numbers found.

    Parameters
    ----------
    file : Path
        Of the scene.
    bench : Bench
        Of the scene.
    names : tuple of str
        Of tunables, or `EVERYTHING`.
    evaluations, seed : int
        Of the search, for each.
    workers : int
        Processes that run closed loops.
    refine : bool
        Whether to begin at the scene's numbers.
    out : Path, optional
        Where the tuned scene is written.
    force : bool
        Whether to replace a file that is there.
    json_mode : bool
        Whether to print JSON.

    Raises
    ------
    UserError
        If there is no tunable of that name, or the file has no line for a number that is to be found.
    """
    from tmm_gen.closed_loop.chosen import chosen
    from tmm_gen.closed_loop.figures import STILL
    from tmm_gen.closed_loop.pricing import OneByOne, side_by_side
    from tmm_gen.closed_loop.search import require_cma
    from tmm_gen.closed_loop.tunables import tunables_of
    from tmm_gen.closed_loop.tuning import tune
    from tmm_gen.control.controllers import BY_NAME, require_solvers
    from tmm_gen.control.task.where import where

    if bench.follows:
        raise UserError(
            f"--tune: {file}: tunes for a reference that is reached once, and this arm follows control.trajectory. "
            "Take the table out while you tune."
        )
    if max(abs(bench.problem.reference - bench.problem.start)) <= STILL:
        raise UserError(
            f"--tune: {where(bench.scene, 'control.reference')} is where the arm starts, and a tuning is judged by the "
            "way there. Set another `reference`, or a start elsewhere under [initial]."
        )
    known = {tunable.name: tunable for tunable in tunables_of(bench)}
    wanted = [*known.values()] if EVERYTHING in names else chosen("--tune", names, known)
    require_cma()
    require_solvers(BY_NAME[name] for tunable in wanted for name in tunable.controllers)
    if out is not None:  # what cannot be written is better known before the search than after it
        _text(file, bench.scene, wanted)
    found: list[Tuned] = []
    with (
        nullcontext(OneByOne(bench)) if workers == 1 else side_by_side(workers) as pricing,
        progress(f"tuning {bench.scene.name}", total=len(wanted) * evaluations) as advance,
    ):
        scene = bench.scene
        for tunable in wanted:
            report = _report(advance, tunable.title)
            found.append(tune(scene, tunable, evaluations, seed, report, pricing, refine))
            scene = found[-1].scene
    written = []
    if out is not None:
        better = [item.tunable for item in found if not item.kept]
        written = write_outputs({out: _text(file, found[-1].scene, better)}, force=force)
    _show(found, evaluations, seed, written, json_mode)


def _report(advance: Advance, title: str) -> Callable[[float], None]:
    """Return what is called after each evaluation with the lowest price so far."""
    return lambda price: advance(1, f"{title}: {price:.3f}")


def _text(file: Path, scene: Scene, tunables: Iterable[Tunable]) -> str:
    """Return the text of a scene's file with the numbers of another scene in place of those that are tuned."""
    from tmm_gen.closed_loop.knobs import number
    from tmm_gen.scene.rewrite import rewritten

    keys = dict.fromkeys(key for tunable in tunables for key in tunable.keys)
    text = read_file(file).decode("utf-8-sig")
    return rewritten(text, str(file), scene, {tuple(key.split(".")): number(scene, key) for key in keys})


def _show(found: list[Tuned], evaluations: int, seed: int, files: list[Path], json_mode: bool) -> None:
    from tmm_gen.closed_loop.knobs import told

    rows: list[dict[str, object]] = []
    for item in found:
        for key in item.tunable.keys:
            rows.append({"tuned": item.tunable.name, "key": key, "value": told(item.scene, key)})
    prices = [
        {
            "tuned": item.tunable.name,
            "price": item.price,
            "price_before": item.price_before,
            "kept": item.kept,
        }
        for item in found
    ]
    facts = {"evaluations": evaluations, "seed": seed, "prices": prices, "files": files}
    columns: list[Column | str] = ["tuned", "key", Column("value", form=_written)]
    table(rows, columns, json_mode, title=f"{evaluations} evaluations each, seed {seed}", more=facts)
    if json_mode:
        return
    for item in found:
        before = f"{item.price_before:.3f} with the numbers the scene had"
        if item.kept:
            click.echo(f"{item.tunable.name}: {before}, which stay: nothing better was found")
        else:
            click.echo(f"{item.tunable.name}: {item.price:.3f}, {before}")
    say_written(files, "--out FILE writes the tuned scene")


def _written(value: object) -> str:
    from tmm_gen.scene.rewrite import as_written

    if value is None:
        return "by default"
    return as_written(value) if isinstance(value, tuple | dict) else str(value)
