"""The articulated-body algorithm of a planar arm and one Newmark step about it, in CasADi, as C."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from peers.joint_arm import FLAGS, JointArm, pointer
from tmm_gen.native.compiler import compile_library

Array = NDArray[np.float64]
LOOP = Path(__file__).with_name("articulated_loop.c")


def accelerations(arm: JointArm, angles: ca.SX, rates: ca.SX, torques: ca.SX, armature: Any) -> ca.SX:
    """Return accelerations of the joints (rad/s^2): Featherstone's recursion in axes of the world, linear in links.

    A body's inertia about its joint is kept as its six entries for (turn, x, y); gravity is the base's acceleration.
    """
    turned, spun = ca.cumsum(angles), ca.cumsum(rates)
    cosine, sine = ca.cos(turned), ca.sin(turned)
    stations = range(len(arm.lengths))
    square = [spun[j] * spun[j] for j in stations]
    outward = [(arm.lengths[j] * cosine[j], arm.lengths[j] * sine[j]) for j in stations]
    inertia, bias = [], []
    for j in stations:
        lever, mass = arm.first_moments[j], arm.masses[j]
        mx, my = lever * cosine[j], lever * sine[j]
        inertia.append([arm.inertias[j], -my, mx, mass, 0.0, mass])
        bias.append([0.0, -square[j] * mx, -square[j] * my])
    answers = []
    for j in reversed(stations):
        (tt, tx, ty, xx, xy, yy), (pt, px, py) = inertia[j], bias[j]
        over = 1.0 / (tt + armature[j])
        drive = (torques[j] - pt) * over
        gt, gx, gy = tt * over, tx * over, ty * over
        answers.append((drive, gt, gx, gy))
        if j == 0:
            break
        dx, dy = outward[j - 1]
        att, atx, aty = tt - gt * tt, tx - gx * tt, ty - gy * tt
        axx, axy, ayy = xx - gx * tx, xy - gx * ty, yy - gy * ty
        cx, cy = -square[j - 1] * dx, -square[j - 1] * dy
        ft = pt + tt * drive + atx * cx + aty * cy
        fx = px + tx * drive + axx * cx + axy * cy
        fy = py + ty * drive + axy * cx + ayy * cy
        moved_x, moved_y = axy * dx - axx * dy, ayy * dx - axy * dy
        inner = inertia[j - 1]
        inner[0] += att + 2.0 * (aty * dx - atx * dy) + moved_y * dx - moved_x * dy
        inner[1] += atx + moved_x
        inner[2] += aty + moved_y
        inner[3] += axx
        inner[4] += axy
        inner[5] += ayy
        bias[j - 1] = [bias[j - 1][0] + ft + dx * fy - dy * fx, bias[j - 1][1] + fx, bias[j - 1][2] + fy]
    found = []
    turn, ax, ay = 0.0, 0.0, arm.gravity
    for j, (drive, gt, gx, gy) in zip(stations, reversed(answers), strict=True):
        own = drive - gt * turn - gx * ax - gy * ay
        found.append(own)
        turn = turn + own
        dx, dy = outward[j]
        ax, ay = ax - turn * dy - square[j] * dx, ay + turn * dx - square[j] * dy
    together: ca.SX = ca.vertcat(*found)
    return together


def inputs_of(arm: JointArm, *, any_step: bool) -> tuple[ca.SX, ca.SX, ca.SX]:
    """Return what a step is given: torques of motors and, if of any length, that; and both on their own."""
    u = ca.SX.sym("u", arm.gears.shape[1])
    h = ca.SX.sym("h") if any_step else ca.SX(arm.step)
    return (ca.vertcat(u, h) if any_step else u), u, h


def step_function(arm: JointArm, *, any_step: bool = False) -> ca.Function:
    """Return one step of Newmark (1/4, 1/2) as ``x_next = step(x, u)``; ``x`` holds angles, rates, accelerations.

    Springs and dampers are implicit, which a recursion takes as armatures. Levers and centrifugal forces are those of
    the motion predicted with the last acceleration: of second order, with one pass of the recursion a step.
    With ``any_step`` the last entry of ``u`` is its length, s.
    """
    n = len(arm.lengths)
    given, u, h = inputs_of(arm, any_step=any_step)
    x = ca.SX.sym("x", 3 * n)
    armature = arm.rotors + 0.5 * h * arm.damping + 0.25 * h**2 * arm.stiffness
    angle, rate, last = ca.vertsplit(x, n)
    rate_ahead = rate + h * last
    angle_ahead = angle + h * (rate + 0.5 * h * last)
    without_angle = angle_ahead - 0.25 * h**2 * last
    without_rate = rate_ahead - 0.5 * h * last
    torque = ca.mtimes(ca.SX(ca.sparsify(ca.DM(arm.gears))), u)
    torque = torque - arm.stiffness * (without_angle - arm.slack) - arm.damping * without_rate
    new = accelerations(arm, angle_ahead, rate_ahead, torque, armature)
    found = ca.vertcat(without_angle + 0.25 * h**2 * new, without_rate + 0.5 * h * new, new)
    return ca.Function("arm_step", [x, given], [ca.cse(found)])


def start_function(arm: JointArm) -> ca.Function:
    """Return accelerations of the joints as ``a = start(angles, rates, u)``."""
    n = len(arm.lengths)
    angle, rate, u = ca.SX.sym("q", n), ca.SX.sym("v", n), ca.SX.sym("u", arm.gears.shape[1])
    torque = ca.mtimes(ca.SX(ca.DM(arm.gears)), u)
    torque = torque - arm.stiffness * (angle - arm.slack) - arm.damping * rate
    return ca.Function("start", [angle, rate, u], [accelerations(arm, angle, rate, torque, arm.rotors)])


def c_text(function: ca.Function) -> str:
    """Return a function as CasADi writes it in C."""
    generator = ca.CodeGenerator("arm_step.c", {"with_header": False})
    generator.add(function)
    return generator.dump()


class Articulated:
    """The compiled step.

    Parameters
    ----------
    arm : JointArm
        Its numbers become part of the code.
    torques : array, (inputs,)
        Of the motors, constant, N m.
    step : callable
        Makes the function that is compiled, called ``arm_step``.
    """

    def __init__(
        self,
        arm: JointArm,
        torques: Array,
        step: Callable[[JointArm], ca.Function] = step_function,
    ) -> None:
        self.joints = len(arm.lengths)
        self.function = step(arm)
        self._start = start_function(arm)
        self._torques = np.asarray(torques, float)
        sources = {"arm_step.c": c_text(self.function), "loop.c": LOOP.read_text()}
        self._handle = ctypes.CDLL(str(compile_library(sources, "gcc", FLAGS)))
        self._handle.peer_seconds.restype = ctypes.c_double

    def started(self, angles: Array, rates: Array, torques: Array | None = None) -> Array:
        """Return angles, rates and accelerations of the joints at the start, (3 n,), under torques, or its own."""
        torques = self._torques if torques is None else torques
        return np.concatenate([angles, rates, np.array(self._start(angles, rates, torques)).ravel()])

    def advance(self, motion: Array, steps: int, given: Array | None = None) -> tuple[Array, float]:
        """Take so many steps with what is given, or its own torques; return the motion then, and the seconds."""
        final, given = np.empty_like(motion), self._torques if given is None else given
        seconds = self._handle.peer_seconds(
            pointer(motion), pointer(final), pointer(given), len(motion), ctypes.c_long(steps)
        )
        return final, seconds
