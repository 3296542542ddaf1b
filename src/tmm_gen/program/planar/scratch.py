"""Scratch of a planar arm's step: what the sweeps write and read, under the names the generated code has."""

from __future__ import annotations

from tmm_gen.derive.integrators.declaration import Kind
from tmm_gen.program.fields import MOTION_NAMES
from tmm_gen.program.variables import Role, Variable, local

BASE = 0
"""Index of the base among nodes; link j lies between nodes j and j + 1."""

IMPEDANCE = [[local(f"impedance_{i}{k}") for k in "xyu"] for i in "xyu"]
"""``S``: change of the force beyond a joint per change of the motion at it."""
FORCE = [
    local("force_x", "force beyond this joint", "N"),
    local("force_y", unit="N"),
    local("torque", unit="N m"),
]
"""``e``: the force if nothing changed."""
INNER_IMPEDANCE = [[local(f"link_{i}{k}") for k in "xyu"] for i in "xyu"]
"""``S`` at a link's inner end, before its joint is crossed."""
UNKNOWN = local("unknown", "increment of the unknown")
CHANGE_X, CHANGE_Y = local("change_x", unit="m/s^2"), local("change_y", unit="m/s^2")
"""Changes of a node's accelerations, on the way out."""
HUB_UNKNOWN = local("hub_unknown", "increment of the hub's unknown")


def predicted(kind: Kind, n: int) -> Variable:
    """Return the scratch array of predicted angles, rates or accelerations of nodes, base first."""
    name, unit = MOTION_NAMES[kind]
    return Variable(f"predicted_{name}", Role.WORK, n + 1, f"{name} of base and links as predicted", unit)


def solved(n: int) -> Variable:
    """Return the scratch array of increments."""
    return Variable("solved", Role.WORK, n, "increment of each link's unknown")


def lever(which: str, n: int) -> Variable:
    """Return the scratch array of a link's length times the sine or cosine of its predicted angle."""
    return Variable(f"lever_{which}", Role.WORK, n, f"length times {which} of the predicted angle", "m")


def node(axis: str, n: int) -> Variable:
    """Return the scratch array of the nodes' accelerations along an axis, base first."""
    return Variable(
        f"acceleration_{axis}", Role.WORK, n + 1, f"acceleration of the nodes along {axis}", "m/s^2"
    )


def swing(axis: str, n: int) -> Variable:
    """Return the scratch array of how a link's outer end answers to its unknown."""
    return Variable(
        f"swing_{axis}", Role.WORK, n, f"change of the outer end's acceleration along {axis} per unknown", "m"
    )


def joint_torque(n: int) -> Variable:
    """Return the scratch array of the joints' torques at the predicted motion."""
    return Variable(
        "joint_torque", Role.WORK, n, "torque of each joint on its outer link as predicted", "N m"
    )


def answer(name: str, n: int) -> Variable:
    """Return the scratch array of what the inward sweep keeps of a joint for the outward one."""
    words = {
        "own": "increment of the unknown if the inner side kept its motion",
        "x": "answer to the joint's acceleration along x",
        "y": "answer to the joint's acceleration along y",
        "from_inner": "answer to the inner link's unknown",
    }
    return Variable(f"answer_{name}", Role.WORK, n, words[name])
