"""``[model]`` and ``[base]`` of an arm in space."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BeforeValidator, Field

from tmm_gen.scene.model import Model, sweeps_or_auto
from tmm_gen.scene.spatial.arm import ZERO
from tmm_gen.scene.spatial.values import AxisVector, Gravity, Place
from tmm_gen.scene.table import Count, Finite, Table, fault

SWEEPS = {"sdirk4": 3, "radau3": 3, "gauss3": 4}
"""Sweep and corrections that give a method its order with the inertial linearisation; two for the other methods."""


class SettledModel(Model):
    """The model of an arm in space, whose kernels correct as often as suits their integrator.

    Parameters
    ----------
    usual : int
        Sweep and corrections, or sweeps, per stage of a kernel where the scene leaves them open.
    """

    usual: int

    @property
    def sweeps(self) -> int:
        """Sweep and corrections per stage of a kernel."""
        return self.usual if self.iterations == "auto" else self.iterations


def corrections_counted(value: object) -> object:
    """Reject a key of planar arms: in space another one counts corrections."""
    more = value if isinstance(value, int) and not isinstance(value, bool) and value >= 0 else 1
    raise fault(
        "is for arms in a plane: in space `iterations` counts the sweep and its corrections",
        f"Remove it, and write `iterations = {more + 1}`.",
    )


class SpatialModel(Model):
    """``[model]`` in space.

    Parameters
    ----------
    gravity : tuple of float, length 3
        m/s^2 in world axes, which are those of a clamp.
    linearisation : {"inertial", "newton"}
        One symmetric sweep and corrections, or exact sweeps.
    iterations : int or "auto"
        The sweep and its corrections, or sweeps, per stage. "auto": a simulation corrects as often as it takes, kernels
        as often as suits the integrator.
    """

    kind: Literal["spatial"] = Field(description="family of models", examples=['"spatial"'])
    gravity: Gravity = Field(  # type: ignore[assignment]
        default=ZERO,
        description="gravity in m/s^2, in world axes, which are those of a clamp",
        examples=["[0, 0, -9.81]"],
        json_schema_extra={"absent": "none"},
    )
    linearisation: Literal["inertial", "newton"] = Field(
        default="inertial", description="linearisation", examples=['"inertial"']
    )
    iterations: Annotated[Count | Literal["auto"], BeforeValidator(sweeps_or_auto)] = Field(
        default="auto",
        description='sweep and corrections per stage; with "auto", `run` takes as many as it needs and kernels 2, with '
        "sdirk4 and radau3 3, with gauss3 4, with newton 1",
        examples=['"auto"', "2"],
    )
    corrections: Annotated[int, BeforeValidator(corrections_counted)] = Field(
        default=0, json_schema_extra={"hidden": True}
    )
    sweep: Literal["riccati"] = Field(default="riccati", description="sweep", examples=['"riccati"'])
    unknown: Literal["acceleration"] = Field(
        default="acceleration", description="unknown of the sweep", examples=['"acceleration"']
    )

    def settled(self, integrator: str) -> Model:
        """Return it as scenes have it: gravity is the arm's, and kernels know how often they correct."""
        return SettledModel.model_construct(
            kind="spatial",
            linearisation=self.linearisation,
            iterations=self.iterations,
            usual=SWEEPS.get(integrator, 2) if self.linearisation == "inertial" else 1,
            unsolved=self.unsolved,
            accuracy=self.accuracy,
        )


_OTHER_BASES = {
    "motor": (
        "is a short form for arms in a plane",
        'Write `kind = "clamp"`, and hang a [[motor]] on it.',
    ),
    "floating": ("is no kind of base", 'Write `kind = "free"`.'),
}


def _kind(value: object) -> object:
    """Reject kinds of bases that others have, in words of their own."""
    if isinstance(value, str) and value in _OTHER_BASES:
        what, remedy = _OTHER_BASES[value]
        raise fault(f'{what}: arms in space have "clamp", "free" and "prescribed"', remedy)
    return value


class SpatialBase(Table):
    """``[base]`` in space.

    Parameters
    ----------
    kind : {"clamp", "free", "prescribed"}
        One that never moves, one that floats: the bodies on it; or one that moves as inputs say. Others are refused
        in words of their own.
    axis : tuple of float, length 3
        What a prescribed base turns about; of any length but 0.
    at, turn : tuple of float, length 3
        Of a base that floats: where it is at first, m, and its turn about x, then y, then z of the world, rad.
    velocity, rate : tuple of float, length 3
        How it moves at first: in world axes, m/s, and about its own axes, rad/s.
    """

    kind: Annotated[Literal["clamp", "free", "prescribed"], BeforeValidator(_kind)] = Field(
        description='kind of base: "clamp", "free" for one that floats, "prescribed" for one that moves as told',
        examples=['"clamp"'],
    )
    axis: AxisVector = Field(
        default=(0.0, 0.0, 1.0),
        description='of a prescribed base: what it turns about, "x", "y", "z" or a vector',
        examples=['"z"'],
        json_schema_extra={"absent": '"z"'},
    )
    at: Place = Field(
        default=ZERO,
        description="of a base that floats: where it is at first, in m",
        examples=["[0.0, 0.0, 0.0]"],
        json_schema_extra={"absent": "the origin"},
    )
    turn: Place = Field(
        default=ZERO,
        description="of a base that floats: how it is turned at first, in rad about x, then y, then z of the world",
        examples=["[0.0, 0.0, 0.5]"],
        json_schema_extra={"absent": "not at all"},
    )
    velocity: Place = Field(
        default=ZERO,
        description="of a base that floats: its velocity at first in m/s, in world axes",
        examples=["[0.0, 0.1, 0.0]"],
        json_schema_extra={"absent": "at rest"},
    )
    rate: Place = Field(
        default=ZERO,
        description="of a base that floats: its angular velocity at first in rad/s, in its own axes",
        examples=["[0.0, 0.0, 0.02]"],
        json_schema_extra={"absent": "at rest"},
    )
    inertia: Finite | None = Field(default=None, json_schema_extra={"hidden": True})
    damping: Finite | None = Field(default=None, json_schema_extra={"hidden": True})

    @property
    def floats(self) -> bool:
        """Whether nothing holds it."""
        return self.kind == "free"

    @property
    def moves(self) -> bool:
        """Whether what is fixed to it moves."""
        return self.kind != "clamp"


FLOATING_KEYS = ("at", "turn", "velocity", "rate")
"""Keys of a base that floats alone."""
