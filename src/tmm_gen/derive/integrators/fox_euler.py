"""The Fox-Euler method: acceleration constant over the step and equal to its end value."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.integrators.declaration import STEP, Integrator, Scheme, Stage, end_of_step, past, stage

h = STEP


def fox_euler() -> Integrator:
    """Return the Fox-Euler method.

    References
    ----------
    A. S. Kumar, T. S. Sankar, A new transfer matrix method for response analysis of large dynamic systems,
    Computers & Structures 23 (1986); Gholampour (2018), eqs. 3-42 and 3-46.
    """
    q, v, a = past("q"), past("v"), stage("a", 1)
    only = Stage(
        instant=sp.Integer(1),
        relations=(q + h * v + h**2 / 2 * a - stage("q", 1), v + h * a - stage("v", 1)),
    )
    return Integrator(
        name="fox_euler",
        title="Fox-Euler",
        source="Kumar & Sankar (1986); Gholampour (2018), eqs. 3-42, 3-46",
        main=Scheme((only,), end_of_step()),
    )
