"""What a program costs: operations counted in its routines, bytes of its structs."""

from __future__ import annotations

from tmm_gen.c_language.real import Real, real_of
from tmm_gen.emit.c.structs import structs_of
from tmm_gen.explain.footprint import Footprint
from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene


def footprint(scene: Scene) -> Footprint:
    """Build a scene's program and count."""
    return footprint_of(build_program(scene), real_of(scene.emit))


def footprint_of(program: Program, real: Real) -> Footprint:
    """Count a program; its bytes are those of C with a number type."""
    size = {struct.name: struct.size(real) for struct in structs_of(program)}
    return Footprint(
        step=count_routine(program.main).total,
        output=count_routine(program.output).total,
        prepare=count_routine(program.prepare).total,
        state_bytes=size["state"],
        model_bytes=size["model"],
    )
