"""What speed is compared with is the same arm, and a method of the same order."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from elbow_speed import TORQUES, elbow, theirs, tip_of
from peers.articulated import Articulated
from peers.joint_arm import joint_arm

from tmm_gen.inputs.signals import Constant
from tmm_gen.reference.planar_arm import Arm

pytestmark = pytest.mark.compiler
LINKS, UNTIL = 2, 0.2


def lagrange(step: float) -> Arm:
    """Return the arm with its motors driven."""
    signals = {name: Constant(value) for name, value in TORQUES.items()}
    return Arm(elbow(LINKS).replace(**{"integrator.step": step}), signals)


def test_articulated_bodies_move_as_lagrange_says_to_second_order() -> None:
    errors = []
    for step in (1e-3, 5e-4):
        arm = lagrange(step)
        angles, _, _ = arm.trajectory(UNTIL).at(np.array([UNTIL]))
        found = theirs(Articulated(joint_arm(arm.scene), np.array(list(TORQUES.values()))), arm)
        errors.append(np.linalg.norm(found.tip - tip_of(arm, angles[0])))
    assert 1.9 < np.log2(errors[0] / errors[1]) < 2.1
    assert errors[1] < 1e-5


def test_another_arm_is_not_compared_with() -> None:
    arm = lagrange(1e-3)
    jointed = joint_arm(arm.scene)
    other = replace(jointed, masses=jointed.masses * (1.0 + 1e-6))
    with pytest.raises(AssertionError, match="another arm"):
        theirs(Articulated(other, np.array(list(TORQUES.values()))), arm)
