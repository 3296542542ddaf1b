"""`tmm-gen stability`: where a scene stands against the limits of stability, and whether its kernel agrees."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.changes import changed_scene, set_option
from tmm_gen.cli.console import Column, progress, say_written, table
from tmm_gen.cli.given import picture_file, plot_option
from tmm_gen.cli.near import near_option
from tmm_gen.cli.outputs import claim, write_outputs

if TYPE_CHECKING:
    from tmm_gen.api.stability import Stability
    from tmm_gen.stability.map import GrowthMap
    from tmm_gen.stability.motion import SmallMotion

# NumPy, SymPy and Matplotlib are imported inside: `tmm-gen --help` has no use for them.


@click.command("stability")
@click.argument("scene", metavar="SCENE", type=click.Path(path_type=Path))
@click.option(
    "--map",
    "mapped",
    metavar="INTEGRATOR",
    multiple=True,
    help="Integrator whose growth is measured over step and stiffness. Repeatable; by default the scene's own.",
)
@click.option(
    "--cells",
    type=click.IntRange(min=0),
    metavar="N",
    help="Steps of a map, for two thirds as many stiffnesses; 0 leaves maps out. By default what takes seconds.",
)
@plot_option("the maps, measured beside derived", "-stability")
@near_option
@set_option
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def stability(
    scene: Path,
    mapped: tuple[str, ...],
    cells: int | None,
    picture: Path | None,
    near: tuple[str, ...],
    changes: tuple[str, ...],
    json_mode: bool,
) -> int:
    """Show where SCENE stands against the limit of stability of every integrator.

    Limits and growth are derived: the largest eigenvalue, over all modes of the scene with their own damping, of the
    amplification matrix of a step. Arms move about their static equilibrium, or the one near the angles of --near. Then
    the same growth is measured by running the generated kernel over a map of steps and stiffnesses; exit code 1 where
    it differs.
    """
    loaded = changed_scene(scene, changes)
    from tmm_gen.modal.near import start_of
    from tmm_gen.stability.rows import mapped_integrators

    start = start_of(loaded, near)
    chosen = mapped_integrators(mapped or (loaded.integrator.name,))
    claim((picture,), (scene,))
    if picture is not None and cells == 0:
        raise click.UsageError("--plot draws maps: leave out --cells 0.")
    with progress(f"modes of {loaded.name}", total=len(loaded.integrators)) as advance:
        from tmm_gen.api.stability import Stability, stands
        from tmm_gen.stability.motion import small_motion

        motion = small_motion(loaded, start)
        standings = stands(motion, lambda name: advance(1, doing=f"derived {name}"))
    found = Stability(motion, standings, _measured(motion, chosen, cells))
    _show(found, _draw(found.maps, picture, loaded.name), json_mode)
    return int(not found.agrees)


def _measured(motion: SmallMotion, names: list[str], cells: int | None) -> tuple[GrowthMap, ...]:
    """Derive and measure maps; none for zero cells."""
    if cells == 0:
        return ()
    from tmm_gen.api.stability import measured
    from tmm_gen.stability.map import map_cells, sensible_columns

    columns = cells or sensible_columns(motion.scene)
    with progress("measuring growth", total=2 * map_cells(columns) * len(names)) as advance:
        return measured(motion, names, columns, lambda done: advance(done))


def _draw(maps: tuple[GrowthMap, ...], file: Path | None, name: str) -> list[Path]:
    if file is None:
        return []
    from tmm_gen.stability.picture import map_picture

    target = picture_file(file, name, "-stability")
    with progress("drawing"):
        image = map_picture(maps, target.suffix[1:].lower())
    return write_outputs({target: image})


def _show(found: Stability, files: list[Path], json_mode: bool) -> None:
    motion, maps = found.motion, found.maps
    scene, highest = motion.scene, motion.highest
    h = scene.integrator.step
    zeta = highest.damping_ratio or 0.0
    facts: dict[str, object] = {
        "scene": scene.name,
        "step": h,
        "highest_frequency": highest.frequency,
        "highest_hertz": highest.hertz,
        "highest_damping_ratio": highest.damping_ratio,
        "omega_step": highest.frequency * h,
        "falls_over": motion.falling,
        "coupled_damping": motion.mixed,
        "maps": [_map_facts(each) for each in maps],
        "files": files,
    }
    title = (
        f"{scene.title}\nhighest natural frequency {highest.frequency:.6g} rad/s, damping ratio {zeta:.3g}; "
        f"times the step of {h:g} s: Ω = {highest.frequency * h:.4g}"
    )
    columns = [
        Column("own", " ", lambda own: "*" if own else ""),
        Column("integrator"),
        Column("order"),
        Column("limit", "limit of Ω", _limit, "right"),
        Column("limit_damped", f"at ζ = {zeta:.3g}", _limit, "right"),
        Column("growth_per_step", "growth in a step", _growth, "right"),
        Column("largest_step", "largest stable step (s)", _step, "right"),
        Column("margin", "margin", _margin, "right"),
        Column("verdict"),
    ]
    table(found.rows, columns, json_mode, title=title, more=facts)
    if json_mode:
        return
    for note in found.notes:
        click.echo(note)
    say_written(files, "--plot draws the map, --map INTEGRATOR measures another" if maps else "")


def _map_facts(each: GrowthMap) -> dict[str, object]:
    return {
        "integrator": each.scene.integrator.name,
        "steps": each.steps,
        "factors": each.factors,
        "derived": each.derived,
        "measured": each.measured,
        "cells": each.differs.size,
        "cells_that_differ": int(each.differs.sum()),
        "largest_difference": float(abs(each.difference[each.worst_cell])),
    }


def _limit(value: float) -> str:
    if value == 0:
        return "always grows"
    return "none" if math.isinf(value) else f"{value:.4g}"


def _growth(value: float) -> str:
    if math.isinf(value):
        return "overflows"
    return "0" if value == 0.0 else f"{value:+.2g}"


def _step(value: float) -> str:
    return "any" if math.isinf(value) else f"{value:.4g}"


def _margin(value: float) -> str:
    return "-" if math.isinf(value) else f"{value:.3g} x"
