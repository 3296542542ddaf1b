"""What of an arm moves in a mode: shares of each joint's own, gathered by part and way."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.space.still import Still
from tmm_gen.scene.spatial.beam import CellName, Way

Array = NDArray[np.float64]

_WORDS: dict[Way, str] = {"bend_y": "bends about y", "bend_z": "bends about z", "twist": "twists"}


@dataclass(frozen=True)
class Share:
    """A part's share of a mode.

    Parameters
    ----------
    what : str
        "forearm bends about z", "shoulder turns".
    share : float
        Of one.
    """

    what: str
    share: float


def shares(still: Still, shape: Array) -> tuple[Share, ...]:
    """Return what moves in a mode, the largest share first.

    Each joint counts by the energy of its own angle, as if all others stood still: of what resists it, or of its motion
    where nothing does.

    Parameters
    ----------
    still : Still
        Where the arm rests.
    shape : array, (6 + n,)
        Of the mode: base and joints.
    """
    if not np.any(shape[6:]):  # all of the arm as one
        ways = [f"base {word} {axis}" for word in ("moves along", "turns about") for axis in "xyz"]
        return tuple(Share(way, 1.0) for way, size in zip(ways, shape[:6].tolist(), strict=True) if size)
    shape = shape[6:]
    held = (still.numbers.stiffness + np.abs(np.diag(still.geometric))) * shape**2
    if not np.any(held > 0.0):
        held = np.diag(still.mass) * shape**2
    parts = {frame.name for frame in still.numbers.arm.frames}
    found: dict[str, float] = {}
    for joint, energy in zip(still.numbers.arm.joints, held.tolist(), strict=True):
        cell = None if joint.name in parts else CellName.of(joint.name)
        what = f"{cell.beam} {_WORDS[cell.way]}" if cell else f"{joint.name} turns"
        found[what] = found.get(what, 0.0) + energy / float(held.sum())
    ordered = sorted(found.items(), key=lambda item: -item[1])
    return tuple(Share(what, share) for what, share in ordered)
