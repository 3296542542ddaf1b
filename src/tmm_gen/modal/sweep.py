"""The Riccati sweep with numbers, over any row of elements, at many frequencies at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.arm import PIVOT, LinearArm, Placed
from tmm_gen.modal.blocks import Blocks

Complex = NDArray[np.complex128]


@dataclass(frozen=True, eq=False)
class States:
    """Motions and forces along an arm for a unit of each input.

    Parameters
    ----------
    motion, force : array, (elements + 1, f, width, inputs)
        At the inboard side of each element, and at the tip. A load acts at the outboard side of its element,
        before the inboard side of the next.
    before_load : array, (elements + 1, f, width, inputs)
        Forces at the outboard side of the element before, inboard of the load there.
    """

    motion: Complex
    force: Complex
    before_load: Complex


def sweep(arm: LinearArm, s: Complex) -> States:
    """Carry ``force = S motion + e`` from the tip to the base, then motions from the base to the tip.

    With ``k_out = U11 k + U12 f`` and ``f_out = U21 k + U22 f`` the same form holds inboard of an element,
    ``f = (U22 - S U12)^-1 [(S U11 - U21) k + e]``, and outer motions follow from inner ones (Horner & Pilkey 1978).

    Parameters
    ----------
    arm : LinearArm
        The elements.
    s : array, (f,)
        Laplace variable, 1/s; no pole of the arm.
    """
    count, width, inputs = len(arm.elements), arm.width, len(arm.scene.inputs)
    impedance = np.zeros((len(s), width, width), complex)
    bias = np.zeros((len(s), width, inputs), complex)
    impedances, biases = [impedance], [bias]
    gains, offsets = [], []
    known: dict[tuple[str, tuple[float, ...]], Blocks] = {}  # identical elements are computed once
    for placed in reversed(arm.elements):
        if placed.name == PIVOT:
            impedance, bias, gain, offset = _pivot(placed, s, impedance, bias)
            gains.append(gain)
            offsets.append(offset)
            impedances.append(impedance)
            biases.append(bias)
            continue
        key = (placed.name, placed.values)
        if key not in known:
            known[key] = arm.functions(placed).blocks(s, placed.values)
        blocks = known[key]
        bias = bias.copy()
        for number, load in placed.loads:
            bias[:, :, number] -= np.array(load)
        inward = np.linalg.solve(
            blocks.U22 - impedance @ blocks.U12,
            np.concatenate([impedance @ blocks.U11 - blocks.U21, bias], axis=2),
        )
        impedance, bias = inward[:, :, :width], inward[:, :, width:]
        gains.append(blocks.U11 + blocks.U12 @ impedance)
        offsets.append(blocks.U12 @ bias)
        impedances.append(impedance)
        biases.append(bias)
    impedances.reverse()
    biases.reverse()
    gains.reverse()
    offsets.reverse()

    motion = np.zeros((count + 1, len(s), width, inputs), complex)
    motion[0] = _base(arm, impedances[0], biases[0])
    for k in range(count):
        motion[k + 1] = gains[k] @ motion[k] + offsets[k]
    force = np.stack(impedances) @ motion + np.stack(biases)
    before = force.copy()
    for k, placed in enumerate(arm.elements):
        for number, load in placed.loads:
            before[k + 1, :, :, number] -= np.array(load)
    return States(motion, force, before)


def _pivot(
    placed: Placed, s: Complex, impedance: Complex, bias: Complex
) -> tuple[Complex, Complex, Complex, Complex]:
    """Carry impedance and bias over a joint that may turn freely: its outer angle follows from what is beyond.

    With ``M = Z (theta_in - theta_out)`` and ``M = S theta_out + R x + e`` outboard,
    ``theta_out = (Z theta_in - R x - e)/(Z + S)``, and ``M`` the share ``Z/(Z + S)`` of ``S theta_in + R x + e``.

    Returns
    -------
    impedance, bias, gain, offset
        Inboard force by the motion there, and outboard motion by the inboard one.
    """
    stiffness, damping, armature = placed.values
    law = stiffness + damping * s + armature * s**2
    bias = bias.copy()
    for number, load in placed.loads:
        bias[:, :, number] -= np.array(load)
    pivot = law + impedance[:, -1, -1]
    gain = np.broadcast_to(np.eye(impedance.shape[1], dtype=complex), impedance.shape).copy()
    gain[:, -1, :-1] = -impedance[:, -1, :-1] / pivot[:, None]
    gain[:, -1, -1] = law / pivot
    offset = np.zeros_like(bias)
    offset[:, -1] = -bias[:, -1] / pivot[:, None]
    inner, left = impedance @ gain, impedance @ offset + bias
    share = (law / pivot)[:, None]
    inner[:, -1], left[:, -1] = share * impedance[:, -1], share * bias[:, -1]
    return inner, left, gain, offset


def _base(arm: LinearArm, impedance: Complex, bias: Complex) -> Complex:
    """Return the motion of the inner end: free, held, or prescribed."""
    motion = np.zeros_like(bias)
    if arm.prescribed is not None:
        motion[:, -1, arm.prescribed] = 1.0
    free = np.flatnonzero(arm.free)
    if len(free):
        rest = (impedance @ motion + bias)[:, free]
        motion[:, free] = -np.linalg.solve(impedance[:, free[:, None], free[None, :]], rest)
    return motion
