"""A whole period in very many steps: what rounding adds up to, in compiled C."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from extremes_of_chains.chains import REFUSED, RIGHT, ROUNDING, WRONG, compiled
from extremes_of_chains.extreme import ChainExtreme, Real, Unknown
from numpy.typing import NDArray

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.digits.product import DIGITS
from tmm_gen.digits.rounding import require_digits
from tmm_gen.errors import UserError
from tmm_gen.native import NativeKernel

Array = NDArray[np.float64]

_CHUNK = 1_000_000
_LOOKS = 50
"""Looks at the motion in each chunk."""


@dataclass(frozen=True)
class Endured:
    """What rounding does to a chain let go from its static deflection, undamped, over one first period.

    Parameters
    ----------
    links : int
        Alike.
    real, unknown : str
        Number type and unknown of the sweep.
    steps : int
        That the period takes.
    error : float or None
        Largest error of the tip, as a share of the deflection; None where it is refused.
    status : str
        `RIGHT`, `REFUSED` or `WRONG`.
    """

    links: int
    real: str
    unknown: str
    steps: int
    error: float | None
    status: str


ENDURED: tuple[ChainExtreme, ...] = tuple(
    ChainExtreme(links=links, step=1.0 / steps, real=real, unknown=unknown, start="released")
    for real in ("float64", "float32")
    for unknown in ("acceleration", "increment")
    for links in (1, 3)
    for steps in (100, 1000, 10_000, 100_000, 1_000_000, 10_000_000)
)
"""What `benchmarks/extremes.py` tries."""


def endure(extreme: ChainExtreme, done: Callable[[], None] = lambda: None) -> Endured:
    """Run an undamped chain of identical stations for one period and compare it with Newmark's exact recursion.

    Parameters
    ----------
    extreme : ChainExtreme
        With Newmark's integrator, released, without damping.
    done : callable, optional
        Called at the end.
    """
    count = round(1.0 / extreme.step)
    found = Endured(extreme.links, extreme.real, extreme.unknown, count, None, REFUSED)
    try:
        require_digits(extreme.scene(), integrator(extreme.integrator))
    except UserError:
        done()
        return found
    error = period_error(extreme, count)
    done()
    limit = 10.0 ** -DIGITS[extreme.real]
    if extreme.unknown == "increment":
        limit = max(limit, 4.0 * ROUNDING[extreme.real] * count)
    return replace(found, error=error, status=RIGHT if error <= limit else WRONG)


@cache
def _kernel(links: int, real: Real, unknown: Unknown) -> NativeKernel:
    extreme = ChainExtreme(links=links, real=real, unknown=unknown)
    return compiled(extreme, integrator("newmark"))


def period_error(extreme: ChainExtreme, steps: int) -> float:
    """Return the largest error of the tip over some steps, as a share of the deflection."""
    kernel = _kernel(extreme.links, extreme.real, extreme.unknown)
    h = extreme.step * extreme.period
    values = {"stiffness": extreme.stiffness, "inertia": extreme.inertia}
    kernel.prepare({k: v if extreme.links > 1 else float(v[0]) for k, v in values.items()}, h)
    kernel.initialise(initial_angle=extreme.deflection)
    size = min(steps, _CHUNK)
    inputs, outputs = (kernel.types["inputs"] * size)(), (kernel.types["outputs"] * size)()
    buffer: Any = outputs
    tip = np.frombuffer(buffer, dtype=extreme.real)
    looks = np.unique(np.linspace(0, size - 1, _LOOKS).astype(int))
    exact = _exact_tip(extreme, h)
    worst = 0.0
    for taken in range(0, steps - size + 1, size):
        kernel.run(inputs, outputs)
        worst = max(worst, float(np.max(np.abs(tip[looks] - exact(taken + looks + 1)))))
    return worst


def _exact_tip(extreme: ChainExtreme, h: float) -> Callable[[Array], Array]:
    """Return the tip's angle after some steps of Newmark's method: modes turn by ``2 atan(w h / 2)`` a step."""
    from scipy.linalg import eigh

    k, inertia = extreme.stiffness, extreme.inertia
    stiffness = np.diag(k + np.append(k[1:], 0.0)) - np.diag(k[1:], 1) - np.diag(k[1:], -1)
    squares, shapes = eigh(stiffness, np.diag(inertia))
    turn = 2.0 * np.arctan(np.sqrt(squares) * h / 2.0)
    share = shapes[-1] * (shapes.T @ (inertia * extreme.deflection))
    return lambda steps: np.asarray(np.cos(np.outer(steps, turn)) @ share, float)
