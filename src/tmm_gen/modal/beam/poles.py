"""Damped poles of an arm of beams, followed from its undamped frequencies."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from tmm_gen.modal.beam.arm import BeamArm
from tmm_gen.modal.beam.conditions import refine


def damped_pole(arm: BeamArm, omega: float, stages: int = 8) -> complex | None:
    """Return the pole with positive imaginary part that grows out of an undamped natural frequency.

    Parameters
    ----------
    arm : BeamArm
        With its damping, which is raised in stages from none.
    omega : float
        rad/s, positive.
    stages : int
        Stages of damping.

    Returns
    -------
    complex or None
        1/s; None where the motion no longer swings.
    """
    s = 1j * omega
    if arm == arm.undamped():
        return s
    for stage in range(1, stages + 1):
        s = refine(_with_damping(arm, stage / stages), s)
        if not (np.isfinite(s) and s.imag > 0.0):
            return None
    return s


def _with_damping(arm: BeamArm, share: float) -> BeamArm:
    return BeamArm(
        tuple(replace(member, damping_time=share * member.damping_time) for member in arm.members),
        replace(arm.base, damping=share * arm.base.damping),
        tuple(replace(body, joint_damping=share * body.joint_damping) for body in arm.bodies),
    )
