"""The L-stable Radau IIA method of order 3 with two stages."""

from __future__ import annotations

from tmm_gen.derive.integrators.collocation import collocated, radau_nodes
from tmm_gen.derive.integrators.declaration import Integrator


def radau2() -> Integrator:
    """Return the Radau IIA method with 2 stages.

    References
    ----------
    E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed. (1996), section IV.5.
    """
    return collocated(
        name="radau2",
        title="Radau IIA, order 3, 2 coupled stages (Hairer & Wanner 1996)",
        source="Hairer & Wanner (1996), section IV.5",
        nodes=radau_nodes(2),
    )
