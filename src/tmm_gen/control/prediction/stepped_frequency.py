"""The frequency at which an integrator lets an oscillator swing, and its inverse."""

from __future__ import annotations

import numpy as np

from tmm_gen.scene import Integrator


def model_frequency(integrator: Integrator, step: float, wanted: float) -> float:
    """Return the frequency an undamped oscillator must have to swing at a wanted one when stepped.

    Parameters
    ----------
    integrator : Integrator
        Of a scene.
    step : float
        s.
    wanted : float
        rad/s.

    Returns
    -------
    float
        rad/s; the wanted frequency itself where the integrator cannot reach it, near half a turn per step.
    """
    import sympy as sp
    from scipy.optimize import brentq

    from tmm_gen.derive.integrators.amplification import OMEGA, ZETA, amplification
    from tmm_gen.derive.integrators.registry import integrator as declared

    made = declared(integrator.name, **integrator.parameters)
    matrix = sp.lambdify(OMEGA, amplification(made.main).expression.subs(ZETA, 0), "numpy", cse=True)
    goal = wanted * step

    def stepped(omega: float) -> float:
        poles = np.linalg.eigvals(np.array(matrix(omega), float)).astype(complex)
        return float(abs(np.angle(poles[np.argmax(np.abs(poles))])))

    grid = goal * np.linspace(0.5, 3.0, 101)
    above = next((k for k, omega in enumerate(grid) if stepped(omega) >= goal), 0)
    if above == 0:
        return wanted
    return float(brentq(lambda omega: stepped(omega) - goal, grid[above - 1], grid[above])) / step
