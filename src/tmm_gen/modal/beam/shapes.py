"""Mode shapes of an arm of beams."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.beam.arm import BeamArm
from tmm_gen.modal.beam.conditions import amplitudes
from tmm_gen.modal.beam.motions import inside

Array = NDArray[np.float64]


def beam_shape(arm: BeamArm, omega: float, points: int = 101) -> tuple[Array, Array]:
    """Return the deflection of the arm in one mode, scaled to a largest deflection of one.

    Parameters
    ----------
    arm : BeamArm
        Its damping is left out.
    omega : float
        A natural frequency, rad/s; zero for the rigid-body motion about a hub.
    points : int
        Places along each member.

    Returns
    -------
    place, deflection : array, (members * points,)
        m from the base; the deflection is positive at the tip.
    """
    still = arm.undamped()
    s = np.array([1j * omega])
    at = np.linspace(0.0, 1.0, points)
    places, deflections, start = [], [], 0.0
    for member, amplitude in zip(still.members, amplitudes(still, 1j * omega), strict=True):
        deflections.append(inside(member, s, at)[:, 0, 0] @ amplitude)
        places.append(start + member.length * at)
        start += member.length
    place, deflection = np.concatenate(places), np.concatenate(deflections)
    largest = deflection[np.argmax(np.abs(deflection))]
    real = (deflection / largest).real
    return place, -real if real[-1] < 0.0 else real
