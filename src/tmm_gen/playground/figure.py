"""What a page needs to draw an arm from its state: how places follow from angles."""

from __future__ import annotations

from typing import Any

from tmm_gen.scene import Scene
from tmm_gen.scene.spatial.arm import SpatialArm
from tmm_gen.simulate.places import ends
from tmm_gen.simulate.skeleton import Skeleton


def figure_of(scene: Scene) -> dict[str, Any]:
    """Return how an arm is drawn, ready for JSON.

    Returns
    -------
    dict
        ``kind``, ``reach`` in m, ``unit`` of an error; ``tips``, the points of which the farthest off counts. Of an arm
        in a plane and of a chain: ``hosts`` (number of the link that each stands on, 0 for the base), ``lengths`` in m,
        whether it ``floats`` and whether its base ``turns``. Of an arm in space: ``joints`` (host, place, turn by rows,
        axis), ``spots`` (number of the body, place on it), ``lines`` through spots, and the ``axes`` of the view by
        rows, the third upward; and whether its base ``floats``.
    """
    if scene.spatial is not None:
        return {"kind": "spatial", "unit": "m", "reach": scene.reach, **_in_space(scene.spatial)}
    numbers = range(1, scene.stations + 1)
    chain = scene.model.linear
    return {
        "kind": "chain" if chain else "planar",
        "unit": "rad" if chain else "m",
        "reach": scene.reach or float(scene.stations),
        "hosts": [scene.host(number) for number in numbers],
        "lengths": [link.length for link in scene.links],
        "floats": scene.floats,
        "turns": not chain and not scene.floats and bool(scene.hub),
        "tips": list(ends(scene)),
    }


def _in_space(arm: SpatialArm) -> dict[str, Any]:
    skeleton = Skeleton(arm)
    return {
        "floats": arm.base is not None,
        "joints": [
            {"host": joint.host, "at": joint.at, "turn": joint.turn, "axis": joint.axis}
            for joint in arm.joints
        ],
        "spots": [{"body": spot.body, "at": spot.at} for spot in skeleton.spots],
        "lines": skeleton.lines,
        "tips": [tip.spot for tip in skeleton.tips],
        "axes": _upright(arm),
    }


def _upright(arm: SpatialArm) -> list[list[int]]:
    """Return right-handed axes by rows, the third against gravity."""
    up = max(range(3), key=lambda axis: (abs(arm.gravity[axis]), axis))
    sign = 1 if arm.gravity[up] <= 0.0 else -1
    first, second = ((up + 1) % 3, (up + 2) % 3)[::sign]
    axes = [[0] * 3 for _ in range(3)]
    axes[0][first] = axes[1][second] = 1
    axes[2][up] = sign
    return axes
