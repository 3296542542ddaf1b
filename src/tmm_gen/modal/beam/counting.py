"""How many natural frequencies lie below a frequency, after Wittrick and Williams: none is missed.

A Riccati sweep from the tip to the base, in which beams and springs enter by their compliance. A stiffness would add
a stiff part to a soft one, or to an inertia, and lose the smaller one's digits; what is rigid has the compliance zero.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.modal.beam.arm import BeamArm
from tmm_gen.modal.beam.member import Member
from tmm_gen.modal.beam.stiffness import Integers, SeenInboard, clamped_count, seen_inboard

Array = NDArray[np.float64]


def modes_below(arm: BeamArm, omega: ArrayLike) -> Integers:
    """Return how many undamped natural frequencies lie below each frequency, rigid-body motions included.

    The modes of the beams with all nodes held, plus the negative eigenvalues of the dynamic stiffness of the
    nodes (Wittrick & Williams 1971, Q. J. Mech. Appl. Math. 24, 263-284), one node after the other.

    Parameters
    ----------
    arm : BeamArm
        Its damping is left out.
    omega : array_like, (f,)
        rad/s, positive.
    """
    points = np.atleast_1d(np.asarray(omega, float))
    counted = np.zeros(len(points), np.int64)
    known: dict[Member, tuple[SeenInboard, Integers]] = {}
    stiffness = np.zeros((len(points), 2, 2))  # of all that is outboard, against w and psi
    for k, (member, body) in reversed(list(enumerate(zip(arm.members, arm.bodies, strict=True)))):
        if body.joint_stiffness is not None and k + 1 < len(arm.members):
            stiffness, negative = _through_spring(stiffness, body.joint_stiffness)
            counted += negative
        stiffness[:, 0, 0] -= body.mass * points**2
        stiffness[:, 1, 1] -= body.inertia * points**2
        if member not in known:
            known[member] = seen_inboard(member, points), clamped_count(member, points)
        beam, held = known[member]
        stiffness, negative = _through_beam(stiffness, beam)
        counted += held + negative
    if arm.base.turns:
        counted += stiffness[:, 1, 1] + arm.base.stiffness - arm.base.inertia * points**2 < 0.0
    return counted


def rigid_motions(arm: BeamArm) -> int:
    """Return in how many ways the arm moves without resistance: about a hub, and about each hinge.

    Told from how the arm is made, not from its numbers: however stiff or soft a spring is, it is there.
    """
    hub = arm.base.turns and arm.base.stiffness == 0.0
    return int(hub) + sum(body.joint_stiffness == 0.0 for body in arm.bodies[:-1])


def _through_spring(stiffness: Array, spring: float) -> tuple[Array, Integers]:
    """Return the stiffness before a joint from that behind it, and how many eigenvalues of it are negative.

    The angle behind the joint is eliminated; its stiffness there is ``turning + spring``.
    """
    turning = stiffness[:, 1, 1]
    if spring == 0.0:
        negative = turning < 0.0
        passed = softened = np.zeros_like(turning)
        yielding = np.divide(1.0, turning, out=np.zeros_like(turning), where=turning != 0.0)
    else:
        compliance = 1.0 / spring
        factor = 1.0 + compliance * turning
        negative = factor < 0.0
        passed, softened, yielding = 1.0 / factor, turning / factor, compliance / factor
    found = np.empty_like(stiffness)
    found[:, 0, 0] = stiffness[:, 0, 0] - yielding * stiffness[:, 0, 1] ** 2
    found[:, 0, 1] = found[:, 1, 0] = passed * stiffness[:, 0, 1]
    found[:, 1, 1] = softened
    return found, negative.astype(np.int64)


def _through_beam(stiffness: Array, beam: SeenInboard) -> tuple[Array, Integers]:
    """Return the stiffness at the inboard end from that at the outboard one, and how many eigenvalues are negative.

    The outboard motions are eliminated together with the forces there, each of which brings a negative eigenvalue of
    its own for a positive compliance (Sylvester).
    """
    one = np.broadcast_to(np.eye(2), stiffness.shape)
    outboard = np.concatenate(
        [np.concatenate([stiffness, one], axis=2), np.concatenate([one, -beam.compliance], axis=2)], axis=1
    )
    negative = np.sum(np.linalg.eigvalsh(balanced(outboard)) < 0.0, axis=-1)
    positive = np.sum(np.linalg.eigvalsh(balanced(beam.compliance)) > 0.0, axis=-1)
    softened = np.linalg.solve(one + stiffness @ beam.compliance, stiffness @ beam.carry)
    found = beam.inertia + beam.carry.transpose(0, 2, 1) @ softened
    return 0.5 * (found + found.transpose(0, 2, 1)), negative - positive


def balanced(matrices: Array) -> Array:
    """Scale rows and columns alike so that the largest entry of each is one.

    The signs of the eigenvalues stay (Sylvester), and a heavy hub no longer hides a light beam.

    Parameters
    ----------
    matrices : array, (f, n, n)
        Symmetric.
    """
    found = matrices
    for _ in range(3):
        scale = 1.0 / np.sqrt(np.maximum(np.max(np.abs(found), axis=-1), np.finfo(float).tiny))
        found = found * scale[:, :, None] * scale[:, None, :]
    return found
