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
from tmm_gen.modal.space.still import Still, small_turns

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
    on_base : array, (6, m)
        The same on a base that floats.
    base : array, (6, m)
        How a base that moves as an input says moves and turns, in its own axes.
    """

    columns: tuple[str, ...]
    torque: Array
    force: Array
    on_base: Array
    base: Array


@dataclass(frozen=True, eq=False)
class Swept:
    """What an arm does for a unit of each input.

    Parameters
    ----------
    moved : array, (f, 6 + n, m)
        How the base moves and turns, in its axes, and the joints turn.
    taken : array, (f, 6, m)
        By how much force and moment change that what holds or moves the base exerts on it, in axes that turn with it;
        none, but for rounding, on a base that floats.
    """

    moved: Complex
    taken: Complex


def inputs_of(still: Still) -> Inputs:
    """Return the inputs of an arm where it rests."""
    numbers = still.numbers
    columns = tuple(column for item in numbers.arm.inputs for column in item.columns)
    torque, force = np.zeros((numbers.size, len(columns))), np.zeros((numbers.size, 6, len(columns)))
    for item in numbers.arm.inputs:
        if item.acts == "torque":
            gear = numbers.arm.joints[item.joint - 1].gear
            torque[item.joint - 1, columns.index(item.name)] += gear
    on_base, base = np.zeros((2, 6, len(columns)))
    for load in unit_loads(numbers.arm):
        on, facing = (
            (force[load.body], still.facing[load.body]) if load.body >= 0 else (on_base, numbers.base_facing)
        )
        on[:, columns.index(load.column)] += load.arm @ load.on_body(facing)
    if numbers.turning is not None:
        base[:, columns.index(numbers.turning.column)] = numbers.turning.coordinates
    for axis, push in enumerate(numbers.arm.along):
        if push is not None:
            base[axis, columns.index(push.name)] = 1.0
    return Inputs(columns, torque, force, on_base, base)


def swept(still: Still, s: Complex, inputs: Inputs) -> Swept:
    """Return what an arm does for a unit of each input.

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
    whole = _own(numbers.base_body, np.zeros((6, 3)), square)
    left_over = np.broadcast_to(-inputs.on_base, (len(s), *inputs.on_base.shape)).astype(complex)
    for j in reversed(range(numbers.size)):
        row, push = int(numbers.rows[j]), pushes[j]
        beyond, biased = slopes[j], biases[j]
        own = _own(numbers.bodies[j], still.loaded[j], square)
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
        back = still.through[j].T
        passed, carried = back @ _moved(still, j, freed, square), back @ left
        if host < 0:
            whole, left_over = whole + passed, left_over + carried
            continue
        before, biased = slopes[host], biases[host]
        slopes[host] = passed if before is None else before + passed
        biases[host] = carried if biased is None else biased + carried
    kept.reverse()
    base = _floating(whole, left_over, square) if numbers.floats else _turning(still, inputs, square)
    return Swept(_outward(still, square, pushes, kept, base), whole @ base[0] + left_over)


def _floating(whole: Complex, left: Complex, square: Complex) -> tuple[Complex, Complex]:
    """Return what a base does that nothing holds, (f, 6, m): as a section, and how it moves and turns."""
    section = np.asarray(-np.linalg.solve(whole, left), complex)
    return section, np.concatenate([section[:, :3] / square[:, :, None], section[:, 3:]], axis=1)


def _turning(still: Still, inputs: Inputs, square: Complex) -> tuple[Complex, Complex]:
    """Return what a base does that is held or moves as an input says, (f, 6, m), in the same two ways.

    Its axes are those of the world: weight is seen in axes that turn.
    """
    moved = np.broadcast_to(inputs.base, (len(square), *inputs.base.shape)).astype(complex)
    section = moved.copy()
    section[:, :3] = square[:, :, None] * moved[:, :3] + small_turns(-still.numbers.gravity) @ inputs.base[3:]
    return section, moved


def _pushes(still: Still) -> Array:
    """Return what a section does as its own joint turns, (n, 6): weight is seen in axes that turn."""
    numbers = still.numbers
    found = np.zeros((numbers.size, 6))
    found[:, 3:] = numbers.pushes[:, 3:]
    before = np.array([still.weight[h] if h >= 0 else -numbers.gravity for h in numbers.hosts])
    found[:, :3] = (still.turned[:, :3, :3] @ before[:, :, None])[:, :, 0]
    return found


def _following(still: Still) -> Array:
    """Return how the forces behind each joint change, seen from its inner side, as they turn with it, (n, 6)."""
    turned = np.swapaxes(still.turned, -1, -2) @ still.forces[:, :, None]
    return np.asarray(np.linalg.solve(np.swapaxes(still.through, -1, -2), turned)[:, :, 0], float)


def _own(body: Array, loaded: Array, square: Complex) -> Complex:
    """Return what a body takes, (f, 6, 6), per proper acceleration and small turn of its section."""
    found = np.empty((len(square), 6, 6), complex)
    found[:, :, :3] = body[:, :3]
    found[:, :, 3:] = square[:, :, None] * body[:, 3:] + loaded
    return found


def _moved(still: Still, j: int, slope: Complex, square: Complex) -> Complex:
    """Return slopes by what the section inside of a joint does, (f, 6, 6), where the joint itself stands still."""
    turn, swing = still.through[j, :3, :3], still.through[j, :3, 3:]
    found = np.empty_like(slope)
    found[:, :, :3] = slope[:, :, :3] @ turn
    found[:, :, 3:] = square[:, :, None] * (slope[:, :, :3] @ swing) + slope[:, :, 3:] @ turn
    return found


def _outward(
    still: Still,
    square: Complex,
    pushes: Array,
    kept: list[tuple[Complex, Complex]],
    base: tuple[Complex, Complex],
) -> Complex:
    """Return what the base and each joint do, base to tips."""
    numbers = still.numbers
    section, coordinates = base
    moved = np.empty((numbers.size, *section.shape), complex)
    found = np.empty((len(square), 6 + numbers.size, section.shape[-1]), complex)
    found[:, :6] = coordinates
    for j, (about, lacking) in enumerate(kept):
        host, through = numbers.hosts[j], still.through[j]
        inner = moved[host] if host >= 0 else section
        turn, swing = through[:3, :3], through[:3, 3:]
        moved[j, :, :3] = turn @ inner[:, :3] + square[:, :, None] * (swing @ inner[:, 3:])
        moved[j, :, 3:] = turn @ inner[:, 3:]
        unknown = -lacking - (about[:, None, :] @ moved[j])[:, 0]
        found[:, 6 + j] = unknown
        moved[j] += pushes[j][:, None] * unknown[:, None, :]
    return found
