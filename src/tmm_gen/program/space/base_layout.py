"""Which variables a base that floats needs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace

import sympy as sp

from tmm_gen.derive.integrators.declaration import Kind, Past, Scheme
from tmm_gen.derive.space.declaration import AXES, PAIRS
from tmm_gen.derive.space.pattern import Pattern
from tmm_gen.program.fields import stage_accelerations
from tmm_gen.program.space.runs import body_pattern
from tmm_gen.program.space.turns import quaternion_of
from tmm_gen.program.variables import Role, Variable
from tmm_gen.scene.spatial.arm import FreeBase

PARTS = "wxyz"
_AGO = {0: "", 1: ", one step ago", 2: ", two steps ago", 3: ", three steps ago"}
History = dict[str, dict[Past, Variable]]
"""By component, newest first."""


@dataclass(frozen=True)
class BaseLayout:
    """The variables of a base that floats.

    Parameters
    ----------
    pattern : Pattern
        What its body has; the rest of it stands for nothing.
    parameters : dict from str to Variable
        By the names of the symbols that stand for them.
    place : dict
        Place, velocity and acceleration along the axes of the world.
    quaternion, omega, alpha : dict
        Of its axes, and angular velocity and acceleration in them.
    given : dict from str to Variable
        What it starts from.
    place_stages, alpha_stages : dict from str to tuple of Variable
        Accelerations and angular accelerations at the stages of the last step, by component, where the next is
        predicted by them.
    """

    pattern: Pattern
    parameters: dict[str, Variable]
    place: History
    quaternion: History
    omega: History
    alpha: History
    given: dict[str, Variable]
    place_stages: dict[str, tuple[Variable, ...]] = field(default_factory=dict)
    alpha_stages: dict[str, tuple[Variable, ...]] = field(default_factory=dict)

    @property
    def lags(self) -> tuple[int, ...]:
        """How many steps ago instants are kept, 0 first."""
        return tuple(sorted({p.lag for p in next(iter(self.omega.values()))}))

    @property
    def start(self) -> sp.Matrix:
        """Quaternion where a step begins."""
        return sp.Matrix([history[Past("q", 0)].ref for history in self.quaternion.values()])

    def newest(self, kind: Kind, history: History) -> sp.Matrix:
        """Return the newest values of a kind."""
        return sp.Matrix([variables[Past(kind, 0)].ref for variables in history.values()])

    @property
    def newest_only(self) -> BaseLayout:
        """The same without what is kept of earlier instants."""
        now = (
            {c: {p: v for p, v in history.items() if p.lag == 0} for c, history in histories.items()}
            for histories in (self.place, self.quaternion, self.omega, self.alpha)
        )
        place, quaternion, omega, alpha = now
        return replace(self, place=place, quaternion=quaternion, omega=omega, alpha=alpha)

    @property
    def state(self) -> tuple[Variable, ...]:
        """All that is kept from step to step."""
        every = (self.place, self.quaternion, self.omega, self.alpha)
        kept = [v for histories in every for history in histories.values() for v in history.values()]
        ahead = [
            v for stages in (self.place_stages, self.alpha_stages) for found in stages.values() for v in found
        ]
        return tuple(dict.fromkeys((*kept, *ahead)))

    @property
    def always(self) -> frozenset[str]:
        """Names of what is kept even where no output reads it: where the base is."""
        newest = (*self.newest("q", self.place), *self.newest("q", self.quaternion))
        return frozenset(ref.variable.name for ref in newest)


def base_numbers(base: FreeBase) -> list[tuple[str, str, str, float]]:
    """Return what a base has that floats: name, words, unit, value."""
    body = base.body
    return [
        ("mass", "mass of the base", "kg", body.mass),
        *(
            (f"center_{axis}", f"centre of mass of the base along {axis}", "m", value)
            for axis, value in zip(AXES, body.center, strict=True)
        ),
        *(
            (
                f"center_inertia_{pair}",
                f"inertia of the base about its centre of mass, {pair}",
                "kg m^2",
                value,
            )
            for pair, value in zip(PAIRS, body.inertia, strict=True)
        ),
    ]


def base_layout(base: FreeBase, kept: Iterable[Past], scheme: Scheme) -> BaseLayout:
    """Choose the variables of a base that floats.

    Parameters
    ----------
    kept : iterable of Past
        History that the integrator needs.
    scheme : Scheme
        What it steps with, but for the start.

    Raises
    ------
    ValueError
        If nothing is fixed to the base that has mass and inertia about every axis.
    """
    body = base.body
    if not body.mass > 0.0 or not all(moment > 0.0 for moment in body.inertia[:3]):
        raise ValueError("a base that floats needs mass and inertia about every axis")
    lags = sorted({p.lag for p in kept} | {0})
    places: tuple[tuple[Kind, str, str], ...] = (
        ("q", "place", "m"),
        ("v", "velocity", "m/s"),
        ("a", "acceleration", "m/s^2"),
    )
    place: History = {
        axis: {
            Past(kind, lag): _state(word, axis, lag, f"{word} of the base along {axis} of the world", unit)
            for lag in lags
            for kind, word, unit in places
        }
        for axis in AXES
    }
    alpha = _turning("a", "alpha", "angular acceleration", "rad/s^2", lags)
    return BaseLayout(
        pattern=body_pattern(body),
        parameters={
            name: Variable(f"base_{name}", Role.PARAMETER, None, doc, unit, value)
            for name, doc, unit, value in base_numbers(base)
            if value != 0.0
        },
        place=place,
        quaternion={
            part: {
                Past("q", lag): _state("quaternion", part, lag, f"quaternion of the base's axes, {part}", "1")
                for lag in lags
            }
            for part in PARTS
        },
        omega=_turning("v", "omega", "angular velocity", "rad/s", lags),
        alpha=alpha,
        given=_given(base),
        place_stages=_at_stages(scheme, place),
        alpha_stages=_at_stages(scheme, alpha),
    )


def _at_stages(scheme: Scheme, histories: History) -> dict[str, tuple[Variable, ...]]:
    """Return where a coupled scheme keeps accelerations at its stages."""
    newest = {component: history[Past("a", 0)] for component, history in histories.items()}
    return {component: stage_accelerations(scheme, v, v.doc) for component, v in newest.items()}


def _turning(kind: Kind, name: str, words: str, unit: str, lags: Iterable[int]) -> History:
    doc = f"{words} of the base in its own axes"
    return {
        axis: {Past(kind, lag): _state(name, axis, lag, f"{doc}, {axis}", unit) for lag in lags}
        for axis in AXES
    }


def _state(word: str, component: str, lag: int, doc: str, unit: str) -> Variable:
    age = f"_{lag}_ago" if lag else ""
    when = _AGO.get(lag, f", {lag} steps ago")
    return Variable(f"base_{word}_{component}{age}", Role.STATE, None, doc + when, unit)


def _given(base: FreeBase) -> dict[str, Variable]:
    table = (
        ("place", "place of the base to start from, in world axes", "m", base.at),
        (
            "quaternion",
            "quaternion of its axes to start from, w first, of any length",
            "1",
            quaternion_of(base.turn),
        ),
        ("velocity", "velocity of the base to start from, in world axes", "m/s", base.velocity),
        ("omega", "angular velocity of the base to start from, in its own axes", "rad/s", base.rate),
    )
    return {
        name: Variable(f"initial_base_{name}", Role.GIVEN, len(values), doc, unit, tuple(values))
        for name, doc, unit, values in table
    }
