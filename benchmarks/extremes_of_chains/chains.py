"""Chains far from the usual: each motion is right, refused, or diverges as derived; nothing else may occur.

Right means: to six digits in double precision, three in single, of the largest angle so far, the compiled kernel's
angles are those of the integrator's own equations solved in more digits (:mod:`recursion`). That is rounding alone:
what the integrator makes of the truth is its own, derived, error.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal, localcontext
from functools import cache
from typing import Any

import numpy as np
from extremes_of_chains.extreme import ChainExtreme
from extremes_of_chains.recursion import Chains, Recursion
from numpy.typing import NDArray

from tmm_gen.derive.integrators.declaration import Integrator
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.digits.product import DIGITS, require_safe_product
from tmm_gen.digits.rounding import Rounding
from tmm_gen.errors import UserError
from tmm_gen.native import NativeKernel, NonFiniteStateError, compile_kernel
from tmm_gen.program.build import build_unchecked
from tmm_gen.scene import SceneError
from tmm_gen.stability.growth import Growth

Array = NDArray[np.float64]

RIGHT, REFUSED, DIVERGED, WRONG = "right", "refused", "diverged as predicted", "wrong"

_BEYOND = 1e3
"""A motion this many times the static deflection has diverged."""

ROUNDING = {"float64": 2.0**-53, "float32": 2.0**-24}
"""Unit roundoff; of increments four times as much a step is what is promised."""

_VISIBLE = 1e-7
"""Growth in a step below this is none: it does nothing in the steps taken."""

_SMALLEST = 1e-300

_PRECISION = 60
"""Digits of the reference."""

_CHECKED = (1, 2, 4, 8, 16, 32)
"""Steps after which all angles are compared."""


@dataclass(frozen=True)
class ChainVerdict:
    """What became of an extreme.

    Parameters
    ----------
    status : str
        `RIGHT`, `REFUSED`, `DIVERGED` or `WRONG`.
    error : float
        Largest difference of an angle, as a share of the largest angle so far; zero where nothing was compared.
    growth : float
        Derived growth in a step, of the chain's fastest motion; zero where there is none.
    said : str
        The refusal, or what was compared.
    """

    status: str
    error: float
    growth: float
    said: str


def judge_all(
    extremes: Sequence[ChainExtreme], advance: Callable[[int], None] = lambda count: None
) -> Iterator[tuple[ChainExtreme, ChainVerdict]]:
    """Judge extremes; those that need the same kernel or the same reference share it.

    Parameters
    ----------
    extremes : sequence of ChainExtreme
        In any order.
    advance : callable, optional
        Called with the number of extremes that are done.
    """
    shared = defaultdict(list)
    for extreme in extremes:
        shared[extreme.links, extreme.integrator, extreme.start, extreme.damping > 0.0].append(extreme)
    for (links, name, _, damped), group in shared.items():
        method, growth, rounding = _tools(name)
        said = {extreme: refusal(extreme, method, rounding) for extreme in group}
        for extreme in group:
            if (why := said[extreme]) is not None:
                yield extreme, ChainVerdict(REFUSED, 0.0, 0.0, why)
                advance(1)
        taken = [extreme for extreme in group if said[extreme] is None]
        same = list(dict.fromkeys(_same_motion(extreme) for extreme in taken))
        references = dict(zip(same, reference(same, method), strict=True)) if same else {}
        for extreme in taken:
            kernel = _kernel(links, name, damped, extreme.real, extreme.sweep, extreme.unknown)
            yield extreme, judge(extreme, growth, kernel, references[_same_motion(extreme)])
            advance(1)


def judge(
    extreme: ChainExtreme, growth: Growth, kernel: NativeKernel, exact: dict[int, Array]
) -> ChainVerdict:
    """Run an extreme that is not refused and compare it.

    Parameters
    ----------
    extreme : ChainExtreme
        What to run.
    growth : Growth
        Of its integrator.
    kernel : NativeKernel
        For chains of its length, number type and sweep.
    exact : dict from int to array, (n,)
        Angles after some numbers of steps.
    """
    grows = derived_growth(extreme, growth)
    try:
        angles = _run(extreme, kernel)
    except NonFiniteStateError as error:
        return ChainVerdict(DIVERGED if grows > 0.0 else REFUSED, 0.0, grows, str(error))
    except (ValueError, ArithmeticError) as error:
        return ChainVerdict(REFUSED, 0.0, grows, str(error))
    worst, largest = 0.0, 0.0
    for count, found in angles.items():
        largest = max(largest, float(np.max(np.abs(exact[count]))))
        worst = max(worst, float(np.max(np.abs(found - exact[count]))) / max(largest, _SMALLEST))
    promised = 10.0 ** -DIGITS[extreme.real]
    if not worst <= promised:
        if ROUNDING[extreme.real] * _grown(grows, extreme.steps) > promised:
            return ChainVerdict(DIVERGED, worst, grows, "rounding errors have grown as derived")
        return ChainVerdict(WRONG, worst, grows, "differs from the integrator's own equations")
    status = DIVERGED if grows > 0.0 and largest > _BEYOND else RIGHT
    return ChainVerdict(status, worst, grows, "follows the integrator's own equations")


@cache
def _tools(name: str) -> tuple[Integrator, Growth, Rounding]:
    method = integrator(name)
    return method, Growth(method), Rounding(method)


@cache
def _kernel(links: int, name: str, damped: bool, real: Any, sweep: Any, unknown: Any) -> NativeKernel:
    """Return the kernel that extremes of a kind share."""
    kind = ChainExtreme(
        links=links, damping=float(damped), real=real, sweep=sweep, unknown=unknown, integrator=name
    )
    return compiled(kind, _tools(name)[0])


def _same_motion(extreme: ChainExtreme) -> ChainExtreme:
    """Return the extreme whose motion is the same but for rounding."""
    return replace(extreme, real="float64", sweep="riccati", unknown="acceleration")


def _grown(growth: float, steps: int) -> float:
    return math.exp(min(steps * math.log1p(growth), 700.0))


def refusal(extreme: ChainExtreme, method: Integrator, rounding: Rounding) -> str | None:
    """Return what tmm-gen says when it will not generate an extreme, None if it will."""
    try:
        scene = extreme.scene()
        require_safe_product(scene, method)
        rounding.require(scene)
    except (UserError, SceneError) as error:
        return str(error)
    return None


def reference(extremes: Sequence[ChainExtreme], method: Integrator) -> list[dict[int, Array]]:
    """Return the angles of chains of equal length and start after some numbers of steps, rad."""
    with localcontext(prec=_PRECISION):
        return _reference(extremes, method)


def _reference(extremes: Sequence[ChainExtreme], method: Integrator) -> list[dict[int, Array]]:
    one = extremes[0]
    stiffness = _decimals([e.stiffness for e in extremes]).T
    inertia = _decimals([e.inertia for e in extremes]).T
    time = _decimals([e.damping * e.period for e in extremes])
    released = one.start == "released"
    recursion = Recursion(
        method,
        Chains(stiffness, stiffness * time, inertia),
        step=_decimals([e.step * e.period for e in extremes]),
        torque=_decimals([0.0 if released else e.torque for e in extremes]),
        angle=_decimals([e.deflection * released for e in extremes]).T,
    )
    found: list[dict[int, Array]] = [{} for _ in extremes]
    for count in range(1, one.steps + 1):
        recursion.advance()
        if count in _CHECKED:
            angle = recursion.angle.astype(float)
            for k in range(len(extremes)):
                found[k][count] = angle[:, k]
    return found


def _decimals(values: list[Any]) -> NDArray[Any]:
    """Return doubles as decimal numbers, exactly."""
    made: NDArray[Any] = np.vectorize(Decimal, otypes=[object])(np.array(values, float))
    return made


def derived_growth(extreme: ChainExtreme, growth: Growth) -> float:
    """Return the spectral radius of a step less 1 for the chain's fastest motion; zero where nothing grows there."""
    from scipy.linalg import eigh_tridiagonal

    stiffness, inertia = extreme.stiffness, extreme.inertia
    diagonal = (stiffness + np.append(stiffness[1:], 0.0)) / inertia
    beside = -stiffness[1:] / np.sqrt(inertia[1:] * inertia[:-1])
    last = extreme.links - 1
    if last:
        squares = eigh_tridiagonal(diagonal, beside, eigvals_only=True, select="i", select_range=(last, last))
    else:
        squares = diagonal
    h = extreme.step * extreme.period
    square = float(squares[-1])
    found = float(growth.radius(square * h * h, square * h * extreme.damping * extreme.period)) - 1.0
    return found if found > _VISIBLE else 0.0


def compiled(extreme: ChainExtreme, method: Integrator) -> NativeKernel:
    """Compile a kernel for chains of a length, whose stations may all differ."""
    unlike = replace(extreme, stiffness_ratio=2.0, inertia_ratio=2.0, pattern="halves", step=1e-3)
    scene = unlike.scene(
        "_".join(("extreme", str(extreme.links), extreme.real, extreme.sweep, extreme.unknown))
    )
    return compile_kernel(build_unchecked(scene, method), scene)


def _run(extreme: ChainExtreme, kernel: NativeKernel) -> dict[int, Array]:
    """Return the kernel's angles after some numbers of steps, rad.

    Raises
    ------
    ArithmeticError, ValueError
        As the kernel's functions do.
    """
    values: dict[str, Any] = {"stiffness": extreme.stiffness, "inertia": extreme.inertia}
    if extreme.damping:
        values["damping"] = extreme.stiffness * (extreme.damping * extreme.period)
    if extreme.links == 1:
        values = {name: float(value[0]) for name, value in values.items()}
    released = extreme.start == "released"
    torque = 0.0 if released else extreme.torque
    load: Any = torque
    kernel.prepare(values, extreme.step * extreme.period)
    kernel.initialise(
        {"tip_torque": load}, initial_angle=extreme.deflection if released else np.zeros(extreme.links)
    )
    found = {}
    for count in range(1, extreme.steps + 1):
        kernel.step({"tip_torque": load})
        if count in _CHECKED:
            found[count] = np.asarray(kernel.state["angle"], float)
    return found
