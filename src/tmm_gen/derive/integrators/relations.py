"""From a stage's two declared relations to affine maps of one unknown, and to A, B, D, E.

A sweep solves for one number per node and stage: the displacement itself, its increment over the step, or
the acceleration. Whatever is chosen, ``q = gain_q*u + offset_q`` and likewise ``v`` and ``a``, where gains
depend on the step alone and offsets on history and earlier stages.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Literal

import sympy as sp

from tmm_gen.derive.integrators.declaration import KINDS, STEP, Kind, Scheme, past, stage
from tmm_gen.derive.partial import partial

Unknown = Literal["displacement", "increment", "acceleration"]

UNKNOWN = sp.Symbol("u", real=True)
"""The number a sweep solves for at each node and stage."""


class UnsuitableUnknownError(ValueError):
    """The integrator does not determine motion from this unknown (explicit methods and displacements)."""


@dataclass(frozen=True)
class AffineMotion:
    """``q, v, a`` of one stage as affine functions of the unknown.

    Parameters
    ----------
    gain : mapping from kind to sympy.Expr
        Factor of the unknown; depends on the step and the integrator's parameters only.
    offset : mapping from kind to sympy.Expr
        The rest: history and earlier stages.
    """

    gain: Mapping[Kind, sp.Expr]
    offset: Mapping[Kind, sp.Expr]


@dataclass(frozen=True)
class DiscreteCoefficients:
    """The thesis's linearisation (3-1, 3-2): ``a = A q + B``, ``v = D q + E``."""

    A: sp.Expr
    B: sp.Expr
    D: sp.Expr
    E: sp.Expr


@cache
def affine_motion(scheme: Scheme, index: int, unknown: Unknown) -> AffineMotion:
    """Express motion at stage ``index`` (from 1) by the unknown of the sweep.

    Raises
    ------
    UnsuitableUnknownError
        If the stage's relations leave the motion undetermined by that unknown.
    """
    if scheme.coupled:
        return _coupled_motion(scheme, index, unknown)
    motion = [stage(kind, index) for kind in KINDS]
    q, _, a = motion
    definition = {"displacement": q, "increment": q - past("q"), "acceleration": a}[unknown] - UNKNOWN
    equations = [*scheme.stages[index - 1].relations, definition]
    matrix, right = sp.linear_eq_to_matrix(equations, motion)
    if sp.cancel(matrix.det()) == 0:
        raise UnsuitableUnknownError(
            f"an explicit stage cannot be solved for the {unknown}; use unknown = 'acceleration'"
        )
    solution = matrix.LUsolve(right)
    gain: dict[Kind, sp.Expr] = {}
    offset: dict[Kind, sp.Expr] = {}
    for kind, value in zip(KINDS, solution, strict=True):
        gain[kind] = _simple(partial(value, UNKNOWN))
        offset[kind] = _collect(value.subs(UNKNOWN, 0))
    return AffineMotion(gain, offset)


def _coupled_motion(scheme: Scheme, index: int, unknown: Unknown) -> AffineMotion:
    """Return motion at a stage whose offsets read all other stages, later ones too."""
    if unknown != "acceleration":
        raise UnsuitableUnknownError(
            "stages that are solved all at once are solved for their accelerations; use unknown = 'acceleration'"
        )
    place, speed = scheme.stages[index - 1].relations
    q, v, a = (stage(kind, index) for kind in KINDS)
    rate = sp.expand(speed + v)
    angle = sp.expand((place + q).subs(v, rate))
    gain: dict[Kind, sp.Expr] = {"q": angle.coeff(a), "v": rate.coeff(a), "a": sp.S.One}
    offset: dict[Kind, sp.Expr] = {"q": angle.subs(a, 0), "v": rate.subs(a, 0), "a": sp.S.Zero}
    return AffineMotion(gain, offset)


def coupled_weights(scheme: Scheme) -> tuple[sp.ImmutableMatrix, sp.ImmutableMatrix]:
    """Return the weights of accelerations in the rates of a coupled scheme's stages, and in the new rate.

    Returns
    -------
    matrix : sympy.ImmutableMatrix, (s, s)
        In steps, as those of the tableau.
    row : sympy.ImmutableMatrix, (1, s)
    """
    accelerations = [stage("a", j + 1) for j in range(len(scheme.stages))]

    def weights(rate: sp.Expr) -> list[sp.Expr]:
        return [partial(rate, symbol) / STEP for symbol in accelerations]

    matrix = [weights(declared.relations[1]) for declared in scheme.stages]
    rate = sp.sympify(scheme.update["v"])
    return sp.ImmutableMatrix(matrix), sp.ImmutableMatrix(
        [matrix[-1] if rate == stage("v", len(matrix)) else weights(rate)]
    )


def discrete_coefficients(scheme: Scheme, index: int = 1) -> DiscreteCoefficients:
    """Derive A, B, D, E of stage ``index`` (3-1, 3-2).

    Raises
    ------
    UnsuitableUnknownError
        For explicit stages, which have no such form.
    """
    motion = affine_motion(scheme, index, "displacement")
    return DiscreteCoefficients(motion.gain["a"], motion.offset["a"], motion.gain["v"], motion.offset["v"])


def _collect(expression: sp.Expr) -> sp.Expr:
    """Return a sum of (factored coefficient) * (history or stage value), each value once."""
    values = sorted(
        (s for s in expression.free_symbols if "_past" in s.name or "_stage" in s.name), key=lambda s: s.name
    )
    coefficients = [_simple(partial(expression, value)) for value in values]
    rest = _simple(expression.subs(dict.fromkeys(values, 0)))
    if rest != 0 or any(c.free_symbols & set(values) for c in coefficients):
        raise ValueError(f"relations are not linear and homogeneous in history: {expression}")
    return sum((c * value for c, value in zip(coefficients, values, strict=True)), sp.Integer(0))


def _simple(coefficient: sp.Expr) -> sp.Expr:
    """Factor a coefficient; square roots leave the denominator, so that equals look equal."""
    if coefficient.has(sp.Pow) and any(
        p.exp.is_Rational and not p.exp.is_Integer for p in coefficient.atoms(sp.Pow)
    ):
        return sp.factor(sp.expand(sp.radsimp(sp.cancel(coefficient, extension=True))))
    return sp.factor(coefficient)
