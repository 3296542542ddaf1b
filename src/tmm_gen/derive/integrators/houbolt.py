"""Houbolt's method: the cubic through the last four displacements, differentiated at the newest."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.integrators.declaration import Integrator, Scheme, Stage, end_of_step
from tmm_gen.derive.integrators.interpolation import Datum, known, motion_relations


def houbolt() -> Integrator:
    """Return Houbolt's method; its start-up takes the newest data that determine a cubic.

    References
    ----------
    J. C. Houbolt, A recurrence matrix solution for the dynamic response of elastic aircraft, J. Aeronaut.
    Sci. 17 (1950); start-up as in Gholampour (2018), tables 3-5 and 3-6.
    """
    return Integrator(
        name="houbolt",
        title="Houbolt 1950",
        source="Houbolt (1950); Gholampour (2018), eqs. 3-67 to 3-69, tables 3-5 to 3-7",
        main=_cubic_through(known("q", 2), known("q", 1), known("q", 0)),
        startup=(
            _cubic_through(known("q", 0), known("v", 0), known("a", 0)),
            _cubic_through(known("a", 1), known("q", 1), known("q", 0)),
        ),
    )


def _cubic_through(*data: Datum) -> Scheme:
    return Scheme((Stage(sp.Integer(1), motion_relations(data)),), end_of_step())
