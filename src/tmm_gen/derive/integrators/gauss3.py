"""Gauss's method of order 6 with three stages."""

from __future__ import annotations

from tmm_gen.derive.integrators.collocation import collocated, gauss_nodes
from tmm_gen.derive.integrators.declaration import Integrator


def gauss3() -> Integrator:
    """Return the Gauss method with 3 stages, which neither damps nor grows.

    References
    ----------
    E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed. (1996), section IV.5.
    """
    return collocated(
        name="gauss3",
        title="Gauss, order 6, 3 coupled stages (Hairer & Wanner 1996)",
        source="Hairer & Wanner (1996), section IV.5",
        nodes=gauss_nodes(3),
    )
