"""Integrators a scene may name: the one declaration of their parameters, defaults and ranges, as plain data.

Their formulas are in :mod:`tmm_gen.derive.integrators`, which takes parameters from here; reading a scene must not
wait for SymPy.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Annotated

from pydantic import AfterValidator, ConfigDict, Field

from tmm_gen.scene.digest import UNSAID
from tmm_gen.scene.table import Positive, Table, fault

FINEST, COARSEST = 1e-10, 0.05
"""Least and largest tolerance: what double precision leaves of a motion, and what any run may be wrong by."""

_SHORTEST = 1e-300
"""s; from there on steps and their parts keep all digits."""


@dataclass(frozen=True)
class Parameter:
    """A number by which a method is chosen from its family.

    Parameters
    ----------
    name : str
        Key in ``[integrator]``.
    default : float
        Value where the key is absent.
    low, high : float
        Range, its ends included unless ``open``.
    open : bool
        The ends are excluded.
    """

    name: str
    default: float
    low: float = -math.inf
    high: float = math.inf
    open: bool = False

    def admits(self, value: float) -> bool:
        """Return whether a finite value is in range."""
        inside = self.low < value < self.high if self.open else self.low <= value <= self.high
        return inside and math.isfinite(value)

    @property
    def range(self) -> str:
        """The range in words, to be read after "must be"."""
        if self.open:
            return f"between {self.low:g} and {self.high:g}, ends excluded"
        if math.isfinite(self.low) and math.isfinite(self.high):
            return f"between {self.low:g} and {self.high:g}"
        return f"at least {self.low:g}" if math.isfinite(self.low) else "finite"


@dataclass(frozen=True)
class Method:
    """What a scene may say of an integrator.

    Parameters
    ----------
    name : str
        Name in scenes, with underscores.
    parameters : tuple of Parameter
        Its own parameters.
    explicit_at : dict from str to float, optional
        Parameter values at which it is explicit and motion follows from accelerations only; empty where it
        always is, None where it never is.
    coupled : bool
        All its stages are solved at once (collocation), by accelerations.
    sweeps : int
        What kernels of planar arms take where the scene does not say: what keeps its order.
    multistep : bool
        It reads instants before the last one, all a step apart, so that its step cannot change on the way.
    """

    name: str
    parameters: tuple[Parameter, ...] = ()
    explicit_at: dict[str, float] | None = field(default=None, hash=False)
    coupled: bool = False
    sweeps: int = 1
    multistep: bool = False

    def explicit(self, given: dict[str, float]) -> bool:
        """Return whether the method is explicit with the given parameters, others at their defaults."""
        if self.explicit_at is None:
            return False
        values = {parameter.name: parameter.default for parameter in self.parameters} | given
        return all(values[name] == value for name, value in self.explicit_at.items())


METHODS: tuple[Method, ...] = (
    Method("fox_euler"),
    Method("newmark", (Parameter("beta", 0.25, 0.0, 1.0), Parameter("gamma", 0.5, 0.0, 1.0)), {"beta": 0.0}),
    Method("wilson", (Parameter("theta", 1.4, 1.0),)),
    Method("houbolt", multistep=True),
    Method("zhou", (Parameter("g1", 1 / 3), Parameter("g2", 1 / 2)), {"g2": 2.0}, multistep=True),
    Method("generalized_alpha", (Parameter("rho_inf", 0.8, 0.0, 1.0),)),
    Method("bathe", (Parameter("gamma", 0.5, 0.0, 1.0, open=True),)),
    Method("park", multistep=True),
    Method("zhai", (Parameter("psi", 0.5), Parameter("phi", 0.5)), {}, multistep=True),
    Method("mixed", (Parameter("delta", 0.0, 0.0, 0.03125),), multistep=True),
    Method("sdirk2"),
    Method("sdirk4"),
    Method("radau2", coupled=True),
    Method("radau3", coupled=True),
    Method("gauss2", coupled=True),
    Method("gauss3", coupled=True, sweeps=2),
)
"""All methods a scene may name, in the order tables show them."""

INTEGRATOR_NAMES: tuple[str, ...] = tuple(method.name for method in METHODS)


def method_named(name: str) -> Method | None:
    """Return the method of a name, hyphens and underscores alike, or None."""
    wanted = underscored(name)
    return next((method for method in METHODS if method.name == wanted), None)


def underscored(name: str) -> str:
    """Return an integrator's name as it is kept: ``fox-euler`` is ``fox_euler``."""
    return name.replace("-", "_")


def _divisible(step: float) -> float:
    """Reject a step that runs cannot divide: what is left of it would be zero."""
    if step < _SHORTEST:
        raise fault("is so short that a part of it is no number any more", "Write for example `step = 1e-3`.")
    return step


class IntegratorTable(Table):
    """``[integrator]`` as written; which further keys are allowed depends on the name."""

    model_config = ConfigDict(frozen=True, extra="allow")

    name: str = Field(description="method of time integration", examples=['"newmark"'])
    step: Annotated[Positive, AfterValidator(_divisible)] = Field(
        description="time step in s", examples=["0.001"]
    )
    tolerance: Annotated[float, Field(strict=True, allow_inf_nan=False, ge=FINEST, le=COARSEST)] | None = (
        Field(
            default=None,
            description="largest error of a run, as a share of its motion: `run` then chooses its steps, and `step` is "
            "how far rows are apart",
            examples=["1e-6"],
            json_schema_extra={"absent": "steps are all alike"},
        )
    )


@dataclass(frozen=True)
class Integrator:
    """The integrator of a scene.

    Parameters
    ----------
    name : str
        With underscores.
    step : float
        Default time step, s, positive.
    parameters : dict from str to float
        Those the scene gives; absent ones have the defaults of the method.
    tolerance : float, optional
        Error that a run may have, as a share of the motion; its steps are then chosen by that, and `step` is how far
        rows are apart.
    """

    name: str
    step: float
    parameters: dict[str, float] = field(default_factory=dict, hash=False)
    tolerance: float | None = field(default=None, metadata=UNSAID)
