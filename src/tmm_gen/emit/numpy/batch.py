"""A generated package's way to many arms at once: the C code beside it, from NumPy arrays."""

from __future__ import annotations

from tmm_gen.c_language.real import Real, real_of
from tmm_gen.emit.c.structs import COUNTER, Struct, structs_of
from tmm_gen.emit.python.fields import given_argument
from tmm_gen.emit.python.lines import comments, prose, text
from tmm_gen.emit.seal import sealed
from tmm_gen.emit.templates import render
from tmm_gen.program.inputs import prescribed_names
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene

STATUSES = (
    "ok",
    "an argument is not finite",
    "the time step is not a positive number",
    "a pivot is not positive",
    "the motion has outgrown the number type",
    "an angle or an intermediate result is out of range",
    "a pointer is NULL",
    "parameters or step are too large or too small for the number type",
)
"""What the statuses of the C code say."""
BATCH_EXPORTS = ("BatchResult", "simulate_batch")
"""What the package shows of it."""


def has_batch(scene: Scene) -> bool:
    """Whether a package has C code for many arms beside the NumPy kernel."""
    return scene.emit.batch is not None and {"c", "numpy"} <= set(scene.emit.backends)


def emit_batch_module(program: Program, scene: Scene, header: list[str]) -> str:
    """Write ``batch.py``."""
    real = real_of(scene.emit)
    prescribed = prescribed_names(program.inputs)
    names = {"INPUT_NAMES", "OUTPUT_NAMES", "Params", "STAGE_INSTANTS", "STEP"}
    names |= {v.name.upper() for v in program.given} | ({"_difference"} if prescribed else set())
    told = f'"""{program.name}: many arms at once, by the C code beside this file, from NumPy arrays."""'
    return sealed(
        render(
            "numpy/batch.py.jinja",
            header=text(comments(header[:5])),
            description=text(prose(told)),
            imports=sorted(names, key=lambda n: (not n.isupper(), n.startswith("_"), n)),
            name=program.name,
            real="float32" if real.size == 4 else "float64",
            statuses=STATUSES,
            structs=[(each.name, _fields(each, real)) for each in structs_of(program)[:4]],
            given=[
                {"name": v.name, "length": v.length, "default": given_argument(v).default}
                for v in program.given
            ],
            prescribed=prescribed,
        )
    )


def _fields(struct: Struct, real: Real) -> list[str]:
    """Return the members of a struct as NumPy lays them out."""
    kind = f'"f{real.size}"'
    fields = [
        f'("{v.name}", {kind})' if v.length is None else f'("{v.name}", {kind}, ({v.length},))'
        for v in struct.variables
    ] or [f'("none", {kind})']
    return [*fields, f'("{COUNTER}", "i4")'] if struct.counter else fields
