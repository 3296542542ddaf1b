"""An arm in small motion as matrices: ``x' = A x + B u``, ``y = C x + D u``."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, repr=False)
class LinearModel:
    """``x' = drift + A (x - x0) + B (u - u0)`` and ``y = y0 + C (x - x0) + D (u - u0)``.

    Parameters
    ----------
    name : str
        Of the scene.
    A : array, (s, s)
        By states.
    B : array, (s, m)
        By inputs.
    C : array, (k, s)
        Of outputs by states.
    D : array, (k, m)
        Of outputs by inputs.
    states : tuple of str
        Names as the generated kernel has them: coordinates, rad or m, then their rates. The turn of a base that floats
        in space is counted about its own axes, from where it stands.
    inputs : tuple of str
        Names as the kernel has them: a prescribed base has its angle, its rate and its acceleration.
    outputs : tuple of str
        Columns of the outputs but energies, which go with the square of the motion.
    x0 : array, (s,)
        Where the arm stands.
    u0 : array, (m,)
        What acts there.
    y0 : array, (k,)
        Outputs there.
    drift : array, (s,)
        ``x'`` there; zero but for rounding in an equilibrium.
    """

    name: str
    A: Array
    B: Array
    C: Array
    D: Array
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    x0: Array
    u0: Array
    y0: Array
    drift: Array

    @cached_property
    def poles(self) -> NDArray[np.complex128]:
        """Eigenvalues of ``A``, 1/s, (s,), the slowest first."""
        found = np.linalg.eigvals(self.A).astype(complex)
        order: NDArray[np.complex128] = found[np.argsort(np.abs(found), kind="stable")]
        return order

    def __repr__(self) -> str:
        """Say how large it is."""
        counts = {"state": self.states, "input": self.inputs, "output": self.outputs}
        said = (f"{len(names)} {what}{'s' * (len(names) != 1)}" for what, names in counts.items())
        return f"<LinearModel of {self.name}: {', '.join(said)}>"

    def state_space(self) -> Any:
        """Return it as a ``scipy.signal.StateSpace`` in continuous time."""
        from scipy.signal import StateSpace  # slow to import

        return StateSpace(self.A, self.B, self.C, self.D)
