"""Members of structs as lines of C, each with what it is."""

from __future__ import annotations

from tmm_gen.c_language.names import declared, macros, signal
from tmm_gen.c_language.real import Real
from tmm_gen.c_language.wrap import INDENT, WIDTH, comment
from tmm_gen.emit.c.structs import COUNTER, Struct
from tmm_gen.program.statements import Program


def member_lines(struct: Struct, program: Program, real: Real, number: str = "") -> list[str]:
    """Return the members of a struct, documented beside, or above where that is too wide.

    Parameters
    ----------
    struct : Struct
        Whose members.
    program : Program
        Whose name stands before types and macros.
    real : Real
        Number type.
    number : str, optional
        Type of its numbers, behind the kernel's name; by default its own.
    """
    number = number or ("pair" if struct.holds_pairs(real) else "real")
    number = f"{program.name}_{number}"
    chosen = struct.name in ("inputs", "outputs")
    members = [
        (number, signal(f.name, program.name) if chosen else f.name, f.dimension, f.doc)
        for f in struct.fields
    ]
    if not members:
        members = [(number, "none", "", "unused: C has no empty structs")]
        chosen = False
    if struct.counter:
        of_each = f"[{macros(program.name)}_BATCH]" if number.endswith("_many") else ""
        members.append(
            ("int", COUNTER, of_each, "how many of the integrator's first steps, which differ, are done")
        )
    widest = max(len(f"{INDENT}{kind} {name}{length}; /**< {doc} */") for kind, name, length, doc in members)
    lines: list[str] = []
    for kind, name, length, doc in members:
        head, tail, remark = f"{INDENT}{kind} ", f"{length};", f" /**< {doc} */"
        if widest > WIDTH:
            lines += comment(doc, 1, "/**")
            remark = ""
        lines += declared(name, head, tail, remark) if chosen else [f"{head}{name}{tail}{remark}"]
    return lines
