"""The exact sweep about rest with numbers, at many frequencies at once.

What a section does beyond rest are its proper acceleration, seen in axes that turn along, and its small turn; forces
behind it change by ``S k + e``. A joint turns by what its own law lacks over one pivot, as in the kernels' exact sweep
with gains ``1, s, s^2`` for angle, rate and acceleration.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.space.loads import unit_loads
from tmm_gen.modal.space.still import Still

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True, eq=False)
class Inputs:
    """What a unit of each column of an arm's inputs does.

    Parameters
    ----------
    columns : tuple of str
        In the order of the scene.
    torque : array, (n, m)
        In each joint, N m.
    force : array, (n, 6, m)
        On each body: force and moment about its joint's point, in its own axes.
    """

    columns: tuple[str, ...]
    torque: Array
    force: Array


def inputs_of(still: Still) -> Inputs:
    """Return the inputs of an arm where it rests."""
    numbers = still.numbers
    columns = tuple(column for item in numbers.arm.inputs for column in item.columns)
    torque, force = np.zeros((numbers.size, len(columns))), np.zeros((numbers.size, 6, len(columns)))
    for item in numbers.arm.inputs:
        if item.acts == "torque":
            gear = numbers.arm.joints[item.joint - 1].gear
            torque[item.joint - 1, columns.index(item.name)] += gear
    for load in unit_loads(numbers.arm):
        force[load.body, :, columns.index(load.column)] += load.arm @ load.on_body(still.facing[load.body])
    return Inputs(columns, torque, force)


def swept(still: Still, s: Complex, inputs: Inputs) -> Complex:
    """Return the angles of the joints for a unit of each input, (f, n, m), rad.

    Parameters
    ----------
    still : Still
        Where the arm rests.
    s : array, (f,)
        Laplace variable, 1/s; no pole of the arm.
    inputs : Inputs
        Of the arm.
    """
    numbers, square = still.numbers, (s * s)[:, None]
    law = (
        numbers.stiffness[:, None] + numbers.damping[:, None] * s + numbers.armature[:, None] * s * s
    )  # (n, f)
    pushes, following = _pushes(still), _following(still)
    slopes: list[Complex | None] = [None] * numbers.size
    biases: list[Complex | None] = [None] * numbers.size
    kept: list[tuple[Complex, Complex]] = []
    for j in reversed(range(numbers.size)):
        row, push = int(numbers.rows[j]), pushes[j]
        beyond, biased = slopes[j], biases[j]
        own = _own(still, j, square)
        slope = own if beyond is None else own + beyond
        bias = np.broadcast_to(-inputs.force[j], (len(s), 6, len(inputs.columns))).astype(complex)
        if biased is not None:
            bias += biased
        about = slope[:, row]
        given = slope @ push
        admittance = 1.0 / (law[j] + given[:, row])
        lacking = (bias[:, row] - inputs.torque[j]) * admittance[:, None]
        giving = given + following[j]
        freed = slope - giving[:, :, None] * (admittance[:, None] * about)[:, None, :]
        left = bias - giving[:, :, None] * lacking[:, None, :]
        # what a joint passes on about its axis is what its own law says: no small difference of large numbers
        freed[:, row] = (law[j] * admittance)[:, None] * about
        left[:, row] = law[j][:, None] * lacking + inputs.torque[j]
        kept.append((admittance[:, None] * about, lacking))
        host = numbers.hosts[j]
        if host >= 0:
            back = still.through[j].T
            passed, carried = back @ _moved(still, j, freed, square), back @ left
            before, biased = slopes[host], biases[host]
            slopes[host] = passed if before is None else before + passed
            biases[host] = carried if biased is None else biased + carried
    kept.reverse()
    return _outward(still, square, pushes, kept, len(inputs.columns))


def _pushes(still: Still) -> Array:
    """Return what a section does as its own joint turns, (n, 6): weight is seen in axes that turn."""
    numbers = still.numbers
    found = np.zeros((numbers.size, 6))
    found[:, 3:] = numbers.pushes[:, 3:]
    before = np.array([still.weight[h] if h >= 0 else -np.array(numbers.arm.gravity) for h in numbers.hosts])
    found[:, :3] = (still.turned[:, :3, :3] @ before[:, :, None])[:, :, 0]
    return found


def _following(still: Still) -> Array:
    """Return how the forces behind each joint change, seen from its inner side, as they turn with it, (n, 6)."""
    turned = np.swapaxes(still.turned, -1, -2) @ still.forces[:, :, None]
    return np.asarray(np.linalg.solve(np.swapaxes(still.through, -1, -2), turned)[:, :, 0], float)


def _own(still: Still, j: int, square: Complex) -> Complex:
    """Return what a body takes, (f, 6, 6), per proper acceleration and small turn of its section."""
    body = still.numbers.bodies[j]
    found = np.empty((len(square), 6, 6), complex)
    found[:, :, :3] = body[:, :3]
    found[:, :, 3:] = square[:, :, None] * body[:, 3:] + still.loaded[j]
    return found


def _moved(still: Still, j: int, slope: Complex, square: Complex) -> Complex:
    """Return slopes by what the section inside of a joint does, (f, 6, 6), where the joint itself stands still."""
    turn, swing = still.through[j, :3, :3], still.through[j, :3, 3:]
    found = np.empty_like(slope)
    found[:, :, :3] = slope[:, :, :3] @ turn
    found[:, :, 3:] = square[:, :, None] * (slope[:, :, :3] @ swing) + slope[:, :, 3:] @ turn
    return found


def _outward(
    still: Still, square: Complex, pushes: Array, kept: list[tuple[Complex, Complex]], columns: int
) -> Complex:
    """Return what each joint does, base to tips."""
    numbers = still.numbers
    moved = np.zeros((numbers.size, len(square), 6, columns), complex)
    found = np.empty((len(square), numbers.size, columns), complex)
    for j, (about, lacking) in enumerate(kept):
        host, through = numbers.hosts[j], still.through[j]
        unknown: Complex = -lacking
        if host >= 0:
            inner = moved[host]
            turn, swing = through[:3, :3], through[:3, 3:]
            moved[j, :, :3] = turn @ inner[:, :3] + square[:, :, None] * (swing @ inner[:, 3:])
            moved[j, :, 3:] = turn @ inner[:, 3:]
            unknown = unknown - (about[:, None, :] @ moved[j])[:, 0]
        found[:, j] = unknown
        moved[j] += pushes[j][:, None] * unknown[:, None, :]
    return found
