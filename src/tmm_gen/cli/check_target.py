"""`tmm-gen check --target`: a scene's C on an emulated microcontroller."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.console import Column, progress, table

if TYPE_CHECKING:
    from tmm_gen.scene import Scene
    from tmm_gen.target import Measurement

TARGETS = ("cortex-m4f", "cortex-m7", "rv32imafdc")

_COLUMNS: list[Column | str] = [
    Column("figure", form=lambda value: str(value).replace("_", " ")),
    "value",
    Column("bound", "budget"),
    Column("passed", "holds"),
    "meaning",
]


def check_target(scene: Scene, target: str, json_mode: bool) -> int:
    """Measure a scene on a target and hold it against its budget.

    Returns
    -------
    int
        1 if a bound is exceeded or bits differ that must not, else 0.
    """
    with progress(f"compiling {scene.name} for {target}"):
        from tmm_gen.target import against_budget, measure

        found = measure(scene, target)
    rows = against_budget(found, scene.emit.budget)
    passed = all(row.passed for row in rows) and (found.bits_equal or found.library_functions)
    if json_mode:
        table(
            [{**asdict(row), "passed": row.passed} for row in rows],
            _COLUMNS,
            json_mode,
            more={"scene": scene.name, "passed": passed, **asdict(found)},
        )
        return 0 if passed else 1
    table(
        [{**asdict(row), "passed": row.passed if row.bound is not None else None} for row in rows],
        _COLUMNS,
        title=f"{scene.title}: {scene.emit.real}{', compensated,' if scene.emit.compensated else ''} on {found.title}",
    )
    click.echo(_bits(found))
    for row in rows:
        if not row.passed:
            click.echo(f"over budget: {row.excess}")
    if scene.emit.real not in found.hardware_reals:
        click.echo(f"{found.title} computes {scene.emit.real} in software: see [emit] real")
    return 0 if passed else 1


def _bits(found: Measurement) -> str:
    if found.bits_equal:
        return f"all {found.steps} steps give the bits they give on this machine"
    apart = (
        f"the state differs from this machine's by {found.difference.last_step:.1e} of its largest number after "
        f"{found.steps} steps"
        if found.difference.last_step
        else f"after {found.steps} steps the state is this machine's to the bit, but not all outputs on the way were"
    )
    libraries = [name for name in found.library_functions if not name.startswith("__aeabi_")]
    if libraries:
        names = ", ".join(libraries)
        return f'{apart}: {names} differ between C libraries; write trigonometry = "own" under [emit]'
    if found.library_functions:
        # gcc 12's 0xbcf0000000000004 less 0xbf00000000000004, say, is one unit in the last place off
        return (
            f"{apart}: gcc's own arithmetic for double, in software, rounds some differences the wrong way; write "
            'real = "float32" under [emit]'
        )
    return f"{apart}; the first difference is at {found.difference.first}: bits are NOT equal"
