"""What tangents need of a sweep, and the variables that keep it."""

from __future__ import annotations

from tmm_gen.derive.station.frame import (
    node,
)
from tmm_gen.derive.station.inward import Inward, back
from tmm_gen.derive.station.lets import Let, Pivot, Update
from tmm_gen.derive.station.motion import Outward
from tmm_gen.derive.station.tangent import Tangent, beyond, solved_node
from tmm_gen.program.variables import Role, Variable


def kept_symbols(tangents: list[tuple[int, int, Inward, Outward, Tangent]]) -> dict[str, tuple[str, str]]:
    """Return what is kept at the point of linearisation, with its description and unit."""
    every: dict[str, tuple[str, str]] = {}
    for _, _, derived, out, tangent in tangents:
        found: dict[str, tuple[str, str]] = {}
        for let in (
            *out.lets,
            *(x for x in derived.lines if isinstance(x, Let)),
            *tangent.keep_out,
            *(x for x in tangent.keep_in if isinstance(x, Let)),
        ):
            found.setdefault(let.symbol.name, (let.doc, let.unit))
        read: set[str] = set()
        for line in (*tangent.outward, *tangent.inward, *back(derived)):
            values = (
                line.values.values()
                if isinstance(line, Update)
                else ()
                if isinstance(line, Pivot)
                else (line.value,)
            )
            read |= {s.name for v in values for s in v.free_symbols}
        own = {"answer_own", "unknown", *(let.symbol.name for let in derived.known)}
        own |= {
            line.symbol.name
            for line in derived.lines
            if isinstance(line, Let) and line.symbol.name.endswith("_impedance")
        }
        own |= {beyond(s(c)).name for c in out.frame.coordinates for s in (node, solved_node)}
        every |= {name: words for name, words in found.items() if name in read and name not in own}
    every["hub_inverse_pivot"] = ("inverse of the hub's pivot", "1")
    return every


def solved_acceleration(axis: str, n: int) -> Variable:
    """Return the accelerations of the nodes along an axis as the sweep has found them."""
    doc = f"acceleration of the nodes along {axis} as solved"
    return Variable(f"solved_acceleration_{axis}", Role.WORK, n + 1, doc, "m/s^2")
