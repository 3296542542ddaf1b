"""What an integrator is: its defining formulas, declared as data.

One step of any linear time integrator is a sequence of *stages*. Each stage imposes equilibrium at its own
instant ``t + instant*h`` and carries exactly two linear relations among its displacement ``q``, velocity
``v`` and acceleration ``a``, the history, and the stages before it. An *update* then states the values at
``t + h``. Everything else (A, B, D, E, order, stability, dissipation, history depth) is derived from that
declaration.

Symbols are plain SymPy symbols made by :func:`past` and :func:`stage`, so that two declarations share them.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, cast

import sympy as sp

Kind = Literal["q", "v", "a"]
KINDS: tuple[Kind, ...] = ("q", "v", "a")

STEP = sp.Symbol("h", positive=True)
"""The time step, s."""


@dataclass(frozen=True, order=True)
class Past:
    """A value of the history: derivative ``kind`` at ``t - lag*h`` (lag 0 is the newest known instant)."""

    kind: Kind
    lag: int


def past(kind: Kind, lag: int = 0) -> sp.Symbol:
    """Return the symbol of displacement, velocity or acceleration at ``t - lag*h``."""
    return sp.Symbol(f"{kind}_past{lag}", real=True)


def stage(kind: Kind, index: int) -> sp.Symbol:
    """Return the symbol of displacement, velocity or acceleration at stage ``index`` (from 1)."""
    return sp.Symbol(f"{kind}_stage{index}", real=True)


def pasts_in(expression: sp.Expr) -> frozenset[Past]:
    """Return the history values on which an expression depends."""
    found = set()
    for symbol in expression.free_symbols:
        if match := re.fullmatch(r"([qva])_past(\d+)", symbol.name):
            found.add(Past(cast(Kind, match[1]), int(match[2])))
    return frozenset(found)


@dataclass(frozen=True)
class Stage:
    """One equilibrium of a step.

    Parameters
    ----------
    instant : sympy.Expr
        Equilibrium is imposed (and inputs are read) at ``t + instant*h``.
    relations : tuple of two sympy.Expr
        Each vanishes: linear relations among this stage's ``q, v, a``, the history and earlier stages; where the
        scheme is coupled, later ones too.
    """

    instant: sp.Expr
    relations: tuple[sp.Expr, sp.Expr]


@dataclass(frozen=True)
class Scheme:
    """One step: its stages and the values at ``t + h`` they lead to.

    Parameters
    ----------
    stages : tuple of Stage
        In order of solution.
    update : mapping from kind to sympy.Expr
        ``q``, ``v``, ``a`` at ``t + h`` in terms of stage values and history.
    """

    stages: tuple[Stage, ...]
    update: Mapping[Kind, sp.Expr]

    def __hash__(self) -> int:
        """Hash by the stages: a mapping has no hash, and what follows from a scheme is remembered by it."""
        return hash(self.stages)

    @cached_property
    def coupled(self) -> bool:
        """Whether a stage reads later ones, so that all must be solved at once."""
        for index, declared in enumerate(self.stages, start=1):
            later = {stage(kind, i) for kind in KINDS for i in range(index + 1, len(self.stages) + 1)}
            if any(relation.free_symbols & later for relation in declared.relations):
                return True
        return False


@dataclass(frozen=True)
class Tableau:
    """A Runge-Kutta method: ``matrix`` (lower triangular where diagonally implicit), ``weights``, ``nodes``."""

    matrix: sp.ImmutableMatrix
    weights: sp.ImmutableMatrix
    nodes: sp.ImmutableMatrix


@dataclass(frozen=True)
class Integrator:
    """A time integrator with its parameters bound to numbers (or left symbolic for a derivation).

    Parameters
    ----------
    name : str
        Identifier used in scenes.
    title : str
        Name with author and year.
    source : str
        Where the defining formulas come from.
    main : Scheme
        The step used once enough history is known.
    startup : tuple of Scheme
        The first steps, one scheme each; the k-th may use only lags below k.
    parameters : mapping from str to sympy.Expr
        The method's own parameters and the values they are bound to.
    tableau : Tableau, optional
        The Butcher tableau, for methods declared by one.
    """

    name: str
    title: str
    source: str
    main: Scheme
    startup: tuple[Scheme, ...] = ()
    parameters: Mapping[str, sp.Expr] = field(default_factory=dict)
    tableau: Tableau | None = None

    @property
    def schemes(self) -> tuple[Scheme, ...]:
        """Start-up schemes in order, then the main one."""
        return (*self.startup, self.main)


def end_of_step(index: int = 1) -> dict[Kind, sp.Expr]:
    """Return the update of methods whose stage ``index`` already stands at ``t + h``."""
    return {kind: stage(kind, index) for kind in KINDS}


CONSISTENT_START = Scheme(
    stages=(
        Stage(
            instant=sp.Integer(0),
            relations=(stage("q", 1) - past("q"), stage("v", 1) - past("v")),
        ),
    ),
    update=end_of_step(),
)
"""Not a step: equilibrium at the initial instant, which yields the consistent initial acceleration."""
