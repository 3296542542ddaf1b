"""The L-stable SDIRK method of order 2 with two stages."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.integrators.declaration import Integrator
from tmm_gen.derive.integrators.dirk import dirk_scheme, tableau


def sdirk2() -> Integrator:
    """Return the L-stable SDIRK method of order 2 with 2 stages and diagonal ``1 - 1/sqrt(2)``.

    References
    ----------
    R. Alexander, Diagonally implicit Runge-Kutta methods for stiff ODEs, SIAM J. Numer. Anal. 14 (1977).
    """
    g = 1 - 1 / sp.sqrt(2)
    table = tableau([[g], [1 - g, g]])
    return Integrator(
        name="sdirk2",
        title="SDIRK, order 2, 2 stages (Alexander 1977)",
        source="Alexander (1977)",
        main=dirk_scheme(table),
        tableau=table,
    )
