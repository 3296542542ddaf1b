"""Frequency response of the continuous beam, where a scene's signals act at its ends."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.beam.arm import beam_arm
from tmm_gen.scene import Input, Output, Scene, station_of

Complex = NDArray[np.complex128]


def beam_response(scene: Scene, s: Complex, given: Input, read: Output) -> Complex | None:
    """Return an output of the continuous beam for a unit of an input, straight and weightless.

    Parameters
    ----------
    scene : Scene
        With a ``[beam]``.
    s : array, (f,)
        Laplace variable, 1/s.
    given : Input
        A torque at base or tip, or a force across the arm at the tip.
    read : Output
        Position, velocity or acceleration of the tip, or angle or rate of base or tip.

    Returns
    -------
    array, (f,), or None
        The component across the arm (``y``) where there are two. None where the signals are others.
    """
    arm = beam_arm(scene)
    n = scene.stations
    (_, (tip, tip_angle)) = arm.ends[-1]
    angles = {0: arm.ends[0][0][1], n: tip_angle}
    place = station_of(given.at, n)
    force = {"force_y": tip if place == n else -1, "torque": angles.get(place, -1)}.get(given.acts, -1)
    where = station_of(read.at, n)
    across = tip if where == n else -1
    quantity = scene.quantity(read)
    moved = {"motion": angles.get(where, -1), "place": across}.get(quantity.read, -1)
    if force < 0 or moved < 0:
        return None
    load = np.zeros(arm.coordinates)
    load[force] = 1.0
    loads = np.broadcast_to(load[:, None], (len(s), len(load), 1))
    moved_by: Complex = np.asarray(np.linalg.solve(arm.stiffness(s), loads)[:, moved, 0], complex)
    answer: Complex = moved_by * s**quantity.order
    return answer
