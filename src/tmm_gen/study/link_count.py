"""How few links a beam needs for an error."""

from __future__ import annotations

import math

from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.study.cells import cut_into
from tmm_gen.study.excitation import Excitation
from tmm_gen.study.modelling import depends_on_links, modelling_errors
from tmm_gen.study.references import References

MOST = 120
"""Links tried at most: the reference of more takes minutes."""

_SHARES = (0.8, 0.4)
"""Shares of the error that few links may make: few links and short steps, or the other way round."""


def fewest_links(
    scene: Scene, excitation: Excitation, bound: float, references: References
) -> dict[int, float]:
    """Return numbers of links worth trying, with their modelling errors, relative to the travel.

    Raises
    ------
    UserError
        If the number of links cannot be chosen, or no number up to `MOST` is enough.
    """
    first = cut_into(scene)
    if first is None or not depends_on_links(scene, excitation):
        raise UserError(
            f"--links auto: the links of scene '{scene.name}' cannot be chosen. That takes a [beam], and loads, "
            "initial motion and output that are not given link by link; in space as many cells in all beams."
        )
    found = modelling_errors([first], references.of)
    if not found:
        raise UserError(
            f"--links auto: motions of scene '{scene.name}' with more and more links do not approach each other. "
            "Simulate a shorter time (--until)."
        )
    known = {first: found[first].error}
    order = found[first].order
    chosen: dict[int, float] = {}
    for share in _SHARES:
        n = _enough(known, order, share * bound, references)
        if n is not None:
            chosen[n] = known[n]
    if not chosen:
        best = min(known, key=lambda n: known[n])
        raise UserError(
            f"--links auto: an error of {bound:.2g} of the travel takes more than {MOST} links; {best} links leave "
            f"{known[best]:.2g}. Allow a larger error, or leave --links out to bound the time error alone."
        )
    return chosen


def _enough(known: dict[int, float], order: float, target: float, references: References) -> int | None:
    """Return the least number of links found whose modelling error is within a target."""
    for _ in range(6):
        near = min(known, key=lambda n: abs(math.log(known[n] / target)))
        guess = max(1, math.ceil(near * math.pow(known[near] / target, 1.0 / order)))
        if guess in known:
            if known[guess] <= target:
                return guess
            guess += 1
        if guess > MOST:
            return None
        if guess not in known:
            known[guess] = modelling_errors([guess], references.of)[guess].error
    good = [n for n, error in known.items() if error <= target]
    return min(good) if good else None
