"""What an output can be: its unit and shape, in a chain and in a planar arm."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Quantity:
    """A kind of output.

    Parameters
    ----------
    unit : str
        SI.
    vector : bool
        Whether it has an x and a y component.
    of_arm : bool
        Whether it belongs to the arm as a whole (``at = "arm"``) and to no place on it.
    """

    unit: str
    vector: bool = False
    of_arm: bool = False


CHAIN = {
    "angle": Quantity("rad"),
    "velocity": Quantity("rad/s"),
    "acceleration": Quantity("rad/s^2"),
    "torque": Quantity("N m"),
}
"""Quantities of a torsional chain: velocity and acceleration are those of the angle."""

PLANAR = {
    "position": Quantity("m", vector=True),
    "angle": Quantity("rad"),
    "rate": Quantity("rad/s"),
    "velocity": Quantity("m/s", vector=True),
    "acceleration": Quantity("m/s^2", vector=True),
    "torque": Quantity("N m"),
    "force": Quantity("N", vector=True),
    "kinetic_energy": Quantity("J", of_arm=True),
    "elastic_energy": Quantity("J", of_arm=True),
    "gravitational_energy": Quantity("J", of_arm=True),
    "dissipated_energy": Quantity("J", of_arm=True),
    "joint_angle": Quantity("rad"),
    "joint_rate": Quantity("rad/s"),
    "joint_torque": Quantity("N m"),
}
"""Quantities of a planar arm: velocity and acceleration are those of a link's outer end; what
joints have between their sides is asked for by their names."""


def quantities(kind: str) -> dict[str, Quantity]:
    """Return the quantities of a kind of model, by the word a scene uses."""
    return CHAIN if kind == "chain" else PLANAR
