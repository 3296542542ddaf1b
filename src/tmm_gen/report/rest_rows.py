"""What is known of each static equilibrium, as rows of a table."""

from __future__ import annotations

from typing import Any

import numpy as np

from tmm_gen.modal.equilibria import Equilibrium
from tmm_gen.modal.near import FROM_START, joint_name, parts_that_turn
from tmm_gen.modal.space.equilibria import SpaceEquilibrium
from tmm_gen.scene import Scene
from tmm_gen.scene.spatial.arm import SpatialArm
from tmm_gen.simulate.places import ends, node_places


def named_ends(scene: Scene) -> list[tuple[int, str]]:
    """Return the links that carry nothing, with names: "tip" of an arm without branches, else that of the last part."""
    names = {part.last: part.name for part in scene.parts}
    found = ends(scene)
    return [(end, "tip" if len(found) == 1 else names[end]) for end in found]


def rest_row(scene: Scene, number: int, each: Equilibrium, origin: str) -> dict[str, Any]:
    """Return what is known of an equilibrium of a planar arm; an origin says from where it was looked for."""
    at = each.rest
    place = np.concatenate(node_places(scene, at.angles[None]))
    angles = np.concatenate([[at.hub], at.angles])
    turned = at.angles - angles[[scene.inner(joint) for joint in range(1, scene.stations + 1)]]
    return {
        **_judged(number, each, origin),
        "hub_angle": at.hub,
        "angles": at.angles,
        "nodes": place.T,
        "parts": [
            {"name": part.name, "x": x, "y": y, "angle": float(at.angles[part.last - 1])}
            for part in scene.parts
            if part.last and not part.fixed
            for x, y in [place[:, part.last].tolist()]
        ],
        "joints": [
            {
                "name": joint_name(scene, joint),
                "angle": float(turned[joint - 1]),
                "torque": float(at.inner[joint - 1, 2]),
            }
            for joint, link in enumerate(scene.links, start=1)
            if not link.massless  # of an elastic gear, whose shaft is in between, the outer side is told
        ],
    }


def space_rest_row(arm: SpatialArm, number: int, each: SpaceEquilibrium, origin: str) -> dict[str, Any]:
    """Return what is known of an equilibrium of an arm in space."""
    rest = each.rest
    return {
        **_judged(number, each, origin),
        "angles": rest.angles,
        "frames": [
            {"name": frame.name, **dict(zip("xyz", rest.place(frame).tolist(), strict=True))}
            for frame in arm.frames
        ],
        "joints": [
            {"name": name, "angle": float(rest.angles[k - 1]), "torque": float(rest.passed[k - 1])}
            for k, name in parts_that_turn(arm)
        ],
    }


def _judged(number: int, each: Equilibrium | SpaceEquilibrium, origin: str) -> dict[str, Any]:
    return {
        "equilibrium": number,
        "state": each.told(origin),
        "stable": each.stable,
        "from_start": each.reached and origin == FROM_START,
        "from_near": each.reached and origin != FROM_START,
        "falls": each.falls,
        "idle": each.idle.shape[1],
    }
