"""From how many directions on it takes less to gather a step's slopes first, and to carry changes by them."""

from __future__ import annotations

from tmm_gen.emit.c.gathered import Gathered
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.emit.c.reached import Reached
from tmm_gen.emit.c.sensitivities import LANES
from tmm_gen.program.count import count_routine
from tmm_gen.program.sensitivities.reduced import Reduced
from tmm_gen.program.statements import Routine, Sensitivities


def many_directions(kernel: Kernel, most: int) -> int | None:
    """Return the number of directions beyond which slopes are to be gathered; None where it never takes less.

    Parameters
    ----------
    kernel : Kernel
        Lowered, with sensitivities.
    most : int
        Directions that are ever carried.
    """
    found = kernel.program.sensitivities
    if found is None or found.reduced is None:
        return None
    plain = count_routine(found.tangent).total
    saved = plain - Gathered(kernel, found.reduced, len(found.inputs)).cost
    gathering = _cost_to_gather(found, found.reduced, kernel.program.stations)
    blocks = next((b for b in range(-(-most // LANES)) if (b + 1) * saved > gathering), None)
    return None if blocks is None else blocks * LANES


def _cost_to_gather(found: Sensitivities, reduced: Reduced, stations: int) -> int:
    """Return the operations in a lane of all blocks: walks that no direction of a block reaches are left out."""
    lanes = [variable for variable in reduced.predicted for _ in range(stations)]
    follows = [*({v} for v in lanes), *(set() for _ in found.inputs)]
    sections = [
        (set(s.follows) if isinstance(s, Reached) else None, count_routine(Routine("", "", (s,))).total)
        for s in found.tangent.sections
    ]
    total = 0
    for first in range(0, len(follows), LANES):
        moved = set().union(*follows[first : first + LANES])
        total += sum(cost for of, cost in sections if of is None or of & moved)
    return total
