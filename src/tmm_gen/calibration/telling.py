"""Which numbers a record tells apart, and which combinations of them it does not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_FLAT = 1e12
"""Condition number of the normal equations beyond which the record does not tell the parameters apart."""

_SHARE = 1e-3
"""Of the largest share in a combination: smaller ones are rounding, and are not named."""

_CLOSE = 0.99
"""Correlation beyond which two numbers are said to be hardly told apart."""


@dataclass(frozen=True)
class Told:
    """What a record tells of the numbers that are fitted.

    Parameters
    ----------
    apart : tuple of int
        Those that it tells apart: all, or what is left when what blurs them is taken out.
    unseen : tuple of int
        Those that nothing recorded depends on.
    blurred : tuple of array, (p,)
        Combinations that it does not see: changes of logarithms that undo each other, the largest 1.
    """

    apart: tuple[int, ...]
    unseen: tuple[int, ...]
    blurred: tuple[Array, ...]

    @classmethod
    def of(cls, normal: Array) -> Told:
        """Read off the matrix of the normal equations of the numbers' logarithms, (p, p), what it tells."""
        diagonal = np.sqrt(np.diag(normal))
        left = [k for k in range(len(diagonal)) if diagonal[k] > 0.0]
        unseen = tuple(k for k in range(len(diagonal)) if k not in left)
        blurred = []
        while left:
            scaled = (normal / np.outer(diagonal, diagonal).clip(min=1e-300))[np.ix_(left, left)]
            if np.linalg.cond(scaled) <= _FLAT:
                break
            along = np.linalg.eigh(scaled)[1][:, 0]
            change = np.zeros(len(diagonal))
            change[left] = along / diagonal[left]
            blurred.append(change / change[np.argmax(np.abs(change))])
            left.pop(int(np.argmax(np.abs(along))))
        return cls(tuple(left), unseen, tuple(blurred))

    def near_given(self, logarithms: Array) -> Array:
        """Return where fitted numbers are as near to the given ones as the record allows, (p,), as logarithms."""
        near = np.array(logarithms)
        near[list(self.unseen)] = 0.0
        if self.blurred:
            along = np.array(self.blurred).T
            near -= along @ np.linalg.lstsq(along, near, rcond=None)[0]
        return near

    def remedy(self, keys: Sequence[str]) -> str:
        """Say what the record does not tell of some keys, and what can be fitted in their place."""
        without = " and ".join(key for k, key in enumerate(keys) if k not in self.apart)
        livelier = "record a livelier motion"
        if not self.apart and not self.blurred:
            return f"Nothing recorded depends on them: {livelier}."
        said = [_undone(keys, change) for change in self.blurred]
        if self.unseen:
            said.append(f"Nothing recorded depends on {' and '.join(keys[k] for k in self.unseen)}.")
        kept = " ".join(f"--fit {keys[k]}" for k in self.apart)
        return f"{' '.join(said)} Leave out {without}: {kept}; or {livelier}."


def _undone(keys: Sequence[str], change: Array) -> str:
    """Say which changes leave the record as it is: "1 % more of a and 2 % less of b"."""
    order = [int(k) for k in np.argsort(-np.abs(change), kind="stable") if abs(change[k]) > _SHARE]
    first, *others = order
    more = f"1 % more of {keys[first]}"
    if not others:
        return f"{more} leaves the record as it is."
    rest = [f"{abs(change[k]):.3g} % {'more' if change[k] > 0 else 'less'} of {keys[k]}" for k in others]
    return f"{more} and {' and '.join(rest)} together leave the record as it is."


def hardly_apart(keys: Sequence[str], correlation: Array) -> list[str]:
    """Say which pairs of fitted numbers a record hardly tells apart.

    Parameters
    ----------
    keys : sequence of str, length p
        The numbers.
    correlation : array, (p, p)
        Of their logarithms.
    """
    pairs = [(i, j) for j in range(len(keys)) for i in range(j) if abs(correlation[i, j]) > _CLOSE]
    return [
        f"the record hardly tells {keys[i]} from {keys[j]}: their correlation is {correlation[i, j]:+.4f}"
        for i, j in pairs
    ]
