"""The L-stable SDIRK method of order 4 with five stages."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.integrators.declaration import Integrator
from tmm_gen.derive.integrators.dirk import dirk_scheme, tableau


def sdirk4() -> Integrator:
    """Return the L-stable SDIRK method of order 4 with 5 stages and diagonal 1/4.

    References
    ----------
    E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed. (1996), table IV.6.5.
    """
    r = sp.Rational
    table = tableau(
        [
            [r(1, 4)],
            [r(1, 2), r(1, 4)],
            [r(17, 50), r(-1, 25), r(1, 4)],
            [r(371, 1360), r(-137, 2720), r(15, 544), r(1, 4)],
            [r(25, 24), r(-49, 48), r(125, 16), r(-85, 12), r(1, 4)],
        ]
    )
    return Integrator(
        name="sdirk4",
        title="SDIRK, order 4, 5 stages (Hairer & Wanner 1996)",
        source="Hairer & Wanner (1996), table IV.6.5",
        main=dirk_scheme(table),
        tableau=table,
    )
