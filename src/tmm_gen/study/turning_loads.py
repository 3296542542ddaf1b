"""Loads of a study that together turn an arm by about a radian: one in space, or one that floats in a plane."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from tmm_gen.scene import Scene
from tmm_gen.study.from_rest import swung
from tmm_gen.study.small_motions import small_motion


def turning_loads(
    scene: Scene, frequencies: Mapping[str, float], until: float, turn: float
) -> dict[str, float]:
    """Return amplitudes for each column of the inputs, in N, or N m of the motor's own side.

    They are measured by what they do to the arm from rest, in small motion about where it starts. Springs, dampers,
    inertia and a base that gives way all have their share: a free joint costs no absurd torque, a stiff one no absurd
    motion, and what floats does not fly away.

    Parameters
    ----------
    scene : Scene
        In space, or in a plane on a base that floats.
    frequencies : mapping from str to float
        With which each column of a torque, force or moment acts, rad/s.
    until : float
        How long, s.
    turn : float
        What some body of the arm turns by at most where all columns act, rad; one that floats may move along by as much
        of its reach instead. None turns it further alone.
    """
    columns = list(frequencies)
    if not columns:
        return {}
    moving = small_motion(scene)
    pushes = np.stack([moving.push(column) for column in columns], axis=1)
    swings = np.array([frequencies[column] for column in columns])
    motions = list(swung(*moving.matrices, pushes, swings, until))
    alone = dict(zip(columns, np.max([moving.turned(q) for q in motions], axis=0).tolist(), strict=True))
    sizes: dict[str, float] = {}
    for together in _loads(scene, columns):
        # what pushes along an arm hardly turns it, however strong: components act as the strongest of them does
        largest = max(alone[column] for column in together)
        sizes |= dict.fromkeys(together, turn / largest if largest > 0.0 else 1.0)
    mixed = np.array([[sizes[column]] for column in columns])
    whole = max(float(moving.turned(q @ mixed)[0]) for q in motions)
    return {column: size * min(1.0, turn / whole if whole > 0.0 else 1.0) for column, size in sizes.items()}


def _loads(scene: Scene, columns: list[str]) -> list[tuple[str, ...]]:
    """Return the columns of each load."""
    if scene.spatial is None:
        return [(column,) for column in columns]
    loads = (tuple(column for column in item.columns if column in columns) for item in scene.spatial.inputs)
    return [together for together in loads if together]
