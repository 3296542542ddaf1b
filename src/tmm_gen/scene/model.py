"""Which equations are derived, and how they are solved."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BeforeValidator, Field

from tmm_gen.scene.table import Count, NonNegative, Positive, Table, fault

Kind = Literal["chain", "planar", "spatial"]
Linearisation = Literal["newton", "taylor", "frozen", "inertial"]
Sweep = Literal["riccati", "product"]
Rounds = Annotated[int, Field(strict=True, ge=0)]
Unknown = Literal["acceleration", "increment", "displacement"]
MOST_SWEEPS = 12
"""A stage that so many sweeps do not solve is not solved by more; each of them is code of its own in a kernel."""


def sweeps_or_auto(value: object) -> object:
    """Reject what is neither a number of sweeps that makes sense nor "auto"."""
    number = isinstance(value, int) and not isinstance(value, bool) and value >= 1
    if number and isinstance(value, int) and value > MOST_SWEEPS:
        raise fault(
            f"is more than {MOST_SWEEPS}, and what so many sweeps leave unsolved more do not solve",
            f'Write {MOST_SWEEPS} or less, or `iterations = "auto"` and shorter steps.',
        )
    if number or value == "auto":
        return value
    raise fault('must be "auto" or a whole number from 1', 'Write for example `iterations = "auto"`.')


class Model(Table):
    """``[model]``.

    Parameters
    ----------
    kind : {"chain", "planar", "spatial"}
        Torsional chain, linear; or arm with large rotations, in a plane or in space.
    gravity : float, optional
        m/s^2 along -y, not negative; planar only. In space it is a vector, of the arm.
    linearisation : {"newton", "taylor", "frozen", "inertial"}
        Of arms; "taylor" and "frozen" are for the plane, "inertial" is for space.
    iterations : int or "auto"
        Sweeps per stage, or a sweep and its corrections; with ``newton`` and ``inertial`` only. "auto": a simulation
        sweeps as often as it takes, kernels once.
    corrections : int
        Of each stage behind its sweeps, of arms in a plane with ``newton``: they carry forces and keep the last
        sweep's factors.
    unsolved : float, optional
        Most work of what sweeps leave unsolved, as a share of the energy that moves; absent, what the step leaves by
        itself (:mod:`tmm_gen.simulate.tolerance`). With ``newton`` only.
    accuracy : float, optional
        Largest error of a run, as a share of how far the motion goes (:mod:`tmm_gen.simulate.accuracy`); absent, 0.05.
    sweep : {"riccati", "product"}
        How the stations' matrices are combined.
    unknown : {"acceleration", "increment", "displacement"}
        Number a sweep solves for at each station.
    """

    kind: Kind = Field(description="family of models", examples=['"chain"'])
    gravity: NonNegative | None = Field(
        default=None, description="gravity along -y in m/s^2", examples=["9.81"]
    )
    linearisation: Linearisation = Field(default="newton", description="linearisation", examples=['"newton"'])
    iterations: Annotated[Count | Literal["auto"], BeforeValidator(sweeps_or_auto)] = Field(
        default="auto",
        description='sweeps per stage; with "auto", `run` takes as many as it needs and kernels take one',
        examples=['"auto"', "2"],
    )
    corrections: Rounds = Field(
        default=0,
        description="corrections per stage behind its sweeps, each for less than half the work of a sweep",
        examples=["1"],
    )
    unsolved: Positive | None = Field(
        default=None,
        description="most work of what sweeps leave unsolved, as a share of the energy that moves",
        examples=["1e-3"],
        json_schema_extra={"absent": "follows the step's own error"},
    )
    accuracy: Positive | None = Field(
        default=None,
        description="largest error of a run, as a share of the motion",
        examples=["0.2"],
        json_schema_extra={"absent": "0.05"},
    )
    sweep: Sweep = Field(default="riccati", description="sweep", examples=['"riccati"'])
    unknown: Unknown = Field(
        default="acceleration", description="unknown of the sweep", examples=['"acceleration"']
    )

    @property
    def linear(self) -> bool:
        """Whether the equations of motion are linear: those of a chain are, those of links that turn far are not."""
        return self.kind == "chain"

    @property
    def in_plane(self) -> bool:
        """Whether the arm has a shape: nodes with places in a plane."""
        return self.kind == "planar"

    @property
    def iterates(self) -> bool:
        """Whether a stage's equations are solved by iteration."""
        return not self.linear and self.linearisation in ("newton", "inertial")

    @property
    def sweeps(self) -> int:
        """Sweeps per stage of a kernel."""
        return 1 if self.iterations == "auto" else self.iterations

    @property
    def auto(self) -> bool:
        """Whether a simulation sweeps as often as it takes."""
        return self.iterates and self.iterations == "auto"


class FlatModel(Model):
    """``[model]`` of what moves in a plane or twists."""

    linearisation: Literal["newton", "taylor", "frozen"] = Field(
        default="newton", description="linearisation", examples=['"newton"']
    )


class Base(Table):
    """``[base]``: what the inboard end stands on.

    Parameters
    ----------
    kind : {"clamp", "motor", "prescribed", "free"}
        Ground; a hub that turns freely under torques; a hub whose angle is an input; or nothing at all.
    inertia : float
        Of the hub, kg m^2; positive for a motor, 0 for a clamp; where nothing holds the arm, of its first part.
    damping : float
        Viscous, from hub to ground, N m s/rad, not negative.
    """

    kind: Literal["clamp", "motor", "prescribed", "free"] = Field(
        description="kind of base", examples=['"clamp"']
    )
    inertia: NonNegative = Field(
        default=0.0, description="inertia of the hub in kg m^2, above 0 for a motor", examples=["0.05"]
    )
    damping: NonNegative = Field(
        default=0.0, description="damping of the hub in N m s/rad", examples=["0.01"]
    )

    @property
    def moves(self) -> bool:
        """Whether it turns at all: freely, or as prescribed."""
        return self.kind != "clamp"

    @property
    def turns(self) -> bool:
        """Whether it turns freely, so that its angle is one more coordinate."""
        return self.kind in ("motor", "free")


class FloatingBase(Base):
    """The base of a planar arm that nothing holds: the bodies on it, which turn and move freely.

    Parameters
    ----------
    mass : float
        kg, not negative.
    """

    mass: NonNegative = 0.0
