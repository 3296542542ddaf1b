"""What stands at the top of every generated file: the same lines in every language, never a date."""

from __future__ import annotations

from tmm_gen.emit.places import places
from tmm_gen.emit.seal import PLACEHOLDER
from tmm_gen.program.count import Operations, count_routine
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene
from tmm_gen.version import __version__


def header_lines(program: Program, scene: Scene) -> list[str]:
    """Return the lines, without comment signs; the hash is filled in by :func:`tmm_gen.emit.seal.sealed`."""
    return [
        f"{program.name}: {program.title}",
        "",
        f"Written by tmm-gen {__version__}. Do not edit: change the scene and run `tmm-gen build`.",
        f"scene digest: {scene.digest}",
        PLACEHOLDER,
        "",
        *(f"{fact}: {value}" for fact, value in program.facts.items()),
        *(f"{what} in arrays, from 0: {whose}" for what, whose in places(scene).items()),
        *(f"operations of {place}: {cost}" for place, cost in _costs(program)),
    ]


def _costs(program: Program) -> list[tuple[str, str]]:
    startup = [(f"start-up step {k + 1}", routine) for k, routine in enumerate(program.startup)]
    costs = [("a step", program.main), *startup, ("prepare", program.prepare)]
    return [(place, _cost(count_routine(routine), program.stations)) for place, routine in costs]


def _cost(operations: Operations, stations: int) -> str:
    kinds = {
        "additions": operations.additions,
        "multiplications": operations.multiplications,
        "divisions": operations.divisions,
        "sines and cosines": operations.functions,
    }
    parts = ", ".join(f"{count} {kind}" for kind, count in kinds.items() if count) or "none"
    return f"{operations.total}, {operations.total / stations:.4g} per station ({parts})"
