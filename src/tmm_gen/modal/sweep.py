"""The Riccati sweep with numbers, over any arm of elements, at many frequencies at once."""

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
    motion : array, (elements + 1, f, width, inputs)
        At the base, and at the outboard side of each element.
    force : array, (elements, f, width, inputs)
        At the inboard side of each element. A load acts at the outboard side of its element, before the inboard side
        of the next.
    """

    motion: Complex
    force: Complex


def sweep(arm: LinearArm, s: Complex) -> States:
    """Carry ``force = S motion + e`` to the base, where arms branch as a sum, then motions from the base outward.

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
    none = np.zeros((len(s), width, width), complex), np.zeros((len(s), width, inputs), complex)
    beyond: list[tuple[Complex, Complex] | None] = [None] * (count + 1)  # at the base and behind each element
    carried: list[Carried] = []
    known: dict[tuple[str, tuple[float, ...]], Blocks] = {}  # identical elements are computed once
    for k, placed in reversed(list(enumerate(arm.elements))):
        impedance, bias = beyond[k + 1] or none
        bias = bias.copy()
        for number, load in placed.loads:
            bias[:, :, number] -= np.array(load)
        if placed.name == PIVOT:
            found = _pivot(placed, s, impedance, bias)
        else:
            key = (placed.name, placed.values)
            if key not in known:
                known[key] = arm.functions(placed).blocks(s, placed.values)
            found = _over(known[key], impedance, bias)
        carried.append(found)
        other = beyond[arm.inner[k]]
        here = found.impedance, found.bias
        beyond[arm.inner[k]] = here if other is None else (other[0] + here[0], other[1] + here[1])
    carried.reverse()

    motion = np.zeros((count + 1, len(s), width, inputs), complex)
    motion[0] = _base(arm, *(beyond[0] or none))
    force = np.empty((count, len(s), width, inputs), complex)
    for k, (inner, each) in enumerate(zip(arm.inner, carried, strict=True)):
        motion[k + 1] = each.gain @ motion[inner] + each.offset
        force[k] = each.impedance @ motion[inner] + each.bias
    return States(motion, force)


@dataclass(frozen=True, eq=False)
class Carried:
    """``force = impedance motion + bias`` inboard of an element, and ``gain motion + offset`` moving outboard of it."""

    impedance: Complex
    bias: Complex
    gain: Complex
    offset: Complex


def _over(blocks: Blocks, impedance: Complex, bias: Complex) -> Carried:
    width = impedance.shape[1]
    right = np.concatenate([impedance @ blocks.U11 - blocks.U21, bias], axis=2)
    both: Complex = np.asarray(np.linalg.solve(blocks.U22 - impedance @ blocks.U12, right), complex)
    inner, left = both[:, :, :width], both[:, :, width:]
    return Carried(inner, left, blocks.U11 + blocks.U12 @ inner, blocks.U12 @ left)


def _pivot(placed: Placed, s: Complex, impedance: Complex, bias: Complex) -> Carried:
    """Carry impedance and bias over a joint that may turn freely: its outer angle follows from what is beyond.

    With ``M = Z (theta_in - theta_out)`` and ``M = S theta_out + R x + e`` outboard,
    ``theta_out = (Z theta_in - R x - e)/(Z + S)``, and ``M`` the share ``Z/(Z + S)`` of ``S theta_in + R x + e``.
    """
    stiffness, damping, armature = placed.values
    law = stiffness + damping * s + armature * s**2
    pivot = law + impedance[:, -1, -1]
    gain = np.broadcast_to(np.eye(impedance.shape[1], dtype=complex), impedance.shape).copy()
    gain[:, -1, :-1] = -impedance[:, -1, :-1] / pivot[:, None]
    gain[:, -1, -1] = law / pivot
    offset = np.zeros_like(bias)
    offset[:, -1] = -bias[:, -1] / pivot[:, None]
    inner, left = impedance @ gain, impedance @ offset + bias
    share = (law / pivot)[:, None]
    inner[:, -1], left[:, -1] = share * impedance[:, -1], share * bias[:, -1]
    return Carried(inner, left, gain, offset)


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
