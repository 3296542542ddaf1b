"""The one table of what an output can be: its unit, what it is read off and how, in a chain and in a planar arm.

Rows, references, the frequency domain, columns and exports all look here; none of them knows outputs by name.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Read = Literal["motion", "bend", "place", "own", "through", "force", "energy"]


@dataclass(frozen=True)
class Quantity:
    """A kind of output.

    Parameters
    ----------
    unit : str
        SI.
    axis : str
        What the axis of a picture says.
    read : {"motion", "bend", "place", "own", "through", "force", "energy"}
        What it is read off: the turning of hub or link; that of one side of a joint against the other; the motion of a
        link's outer end; a joint's own torque; the torque that a joint passes on, its motor's included; the force in a
        joint; an energy.
    order : int
        How often a motion is differentiated by time.
    energy : str
        Which energy.
    accumulates : bool
        Whether it depends on the way to the present state too.
    parts : str
        Letters of its components where they are not x and y.
    """

    unit: str
    axis: str
    read: Read
    order: int = 0
    energy: str = ""
    accumulates: bool = False
    parts: str = ""

    @property
    def vector(self) -> bool:
        """Whether it has components."""
        return self.read in ("place", "force")

    @property
    def components(self) -> str:
        """Letters of its components, in order; none of a scalar."""
        return self.parts or ("xy" if self.vector else "")

    @property
    def of_arm(self) -> bool:
        """Whether it belongs to the arm as a whole (``at = "arm"``) and to no place on it."""
        return self.read == "energy"

    @property
    def in_joint(self) -> bool:
        """Whether it is what a joint carries: at a link, in the joint inboard of it."""
        return self.read in ("own", "force")

    def columns(self, name: str) -> tuple[str, ...]:
        """Return the columns of an output: its name, with ``_x``, ``_y`` and so on for a vector."""
        return tuple(f"{name}_{part}" for part in self.components) or (name,)


_TORQUE = Quantity("N m", "torque", "own")

CHAIN = {
    "angle": Quantity("rad", "angle", "motion"),
    "velocity": Quantity("rad/s", "rate", "motion", 1),
    "acceleration": Quantity("rad/s^2", "acceleration", "motion", 2),
    "torque": _TORQUE,
}
"""Quantities of a torsional chain: velocity and acceleration are those of the angle."""

PLANAR = {
    "position": Quantity("m", "position", "place"),
    "angle": Quantity("rad", "angle", "motion"),
    "rate": Quantity("rad/s", "rate", "motion", 1),
    "velocity": Quantity("m/s", "velocity", "place", 1),
    "acceleration": Quantity("m/s^2", "acceleration", "place", 2),
    "torque": _TORQUE,
    "force": Quantity("N", "force", "force"),
    "kinetic_energy": Quantity("J", "energy", "energy", energy="kinetic"),
    "elastic_energy": Quantity("J", "energy", "energy", energy="elastic"),
    "gravitational_energy": Quantity("J", "energy", "energy", energy="gravitational"),
    "dissipated_energy": Quantity("J", "energy", "energy", energy="dissipated", accumulates=True),
    "joint_angle": Quantity("rad", "angle", "bend"),
    "joint_rate": Quantity("rad/s", "rate", "bend", 1),
    "joint_torque": Quantity("N m", "torque", "through"),
}
"""Quantities of a planar arm: velocity and acceleration are those of a link's outer end; what
joints have between their sides is asked for by their names."""


SPATIAL = {
    "angle": Quantity("rad", "angle", "bend"),
    "rate": Quantity("rad/s", "rate", "bend", 1),
    "acceleration": Quantity("rad/s^2", "acceleration", "bend", 2),
    "torque": Quantity("N m", "torque", "through"),
    "force": Quantity("N", "force", "force", parts="xyz"),
    "position": Quantity("m", "position", "place", parts="xyz"),
    "velocity": Quantity("m/s", "velocity", "place", 1, parts="xyz"),
    "orientation": Quantity("1", "orientation", "place", parts="wxyz"),
    "kinetic_energy": Quantity("J", "energy", "energy", energy="kinetic"),
    "elastic_energy": Quantity("J", "energy", "energy", energy="elastic"),
    "gravitational_energy": Quantity("J", "energy", "energy", energy="gravitational"),
}
"""Quantities of an arm in space: those of joints between their two sides, those of frames, and the force
of a base that something holds, in world axes."""

_KINDS = {"chain": CHAIN, "planar": PLANAR, "spatial": SPATIAL}


def quantities(kind: str) -> dict[str, Quantity]:
    """Return the quantities of a kind of model, by the word a scene uses."""
    return _KINDS[kind]


INPUT_UNITS = {
    "torque": "N m",
    "drive": "N m",
    **dict.fromkeys(("force_x", "force_y", "force_z"), "N"),
    **dict.fromkeys(("moment_x", "moment_y", "moment_z"), "N m"),
    "angle": "rad",
    **dict.fromkeys(("place_x", "place_y", "place_z"), "m"),
}
"""Units of inputs, by what they act as."""
