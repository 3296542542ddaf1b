"""Other people's solvers on a planar arm that falls: Runge and Kutta's steps in C, CVODES, SciPy, MuJoCo."""

from __future__ import annotations

import contextlib
import tempfile
import time
from functools import cached_property
from typing import Any

import casadi as ca
import mujoco
import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from peers.articulated import accelerations, inputs_of
from peers.joint_arm import JointArm

Array = NDArray[np.float64]


def slopes(arm: JointArm) -> ca.Function:
    """Return what the motion of an arm whose motors rest changes by, ``slope(x)``; ``x`` holds angles and rates."""
    x = ca.SX.sym("x", 2 * len(arm.lengths))
    return ca.Function("slope", [x], [ca.cse(_slope(arm, x, ca.SX.zeros(arm.gears.shape[1])))])


def _slope(arm: JointArm, x: ca.SX, u: ca.SX) -> ca.SX:
    angle, rate = ca.vertsplit(x, len(arm.lengths))
    torque = ca.mtimes(ca.SX(ca.sparsify(ca.DM(arm.gears))), u)
    torque = torque - arm.stiffness * (angle - arm.slack) - arm.damping * rate
    return ca.vertcat(rate, accelerations(arm, angle, rate, torque, arm.rotors))


def rk4_function(arm: JointArm, *, any_step: bool = False) -> ca.Function:
    """Return a step of the classical method of Runge and Kutta, ``x_next = step(x, u)``, torques held.

    With ``any_step`` the last entry of ``u`` is its length, s.
    """
    given, u, h = inputs_of(arm, any_step=any_step)
    x = ca.SX.sym("x", 2 * len(arm.lengths))
    first = _slope(arm, x, u)
    second = _slope(arm, x + 0.5 * h * first, u)
    third = _slope(arm, x + 0.5 * h * second, u)
    last = _slope(arm, x + h * third, u)
    end = x + h / 6.0 * (first + 2.0 * second + 2.0 * third + last)
    return ca.Function("arm_step", [x, given], [ca.cse(end)])


class Cvodes:
    """CVODES (BDF with exact Jacobians) by way of CasADi, with equations compiled.

    Parameters
    ----------
    arm : JointArm
    times : array, (k,)
        When the motion is wanted, s.
    """

    def __init__(self, arm: JointArm, times: Array) -> None:
        self._slope, self._times, self._size = slopes(arm), times, 2 * len(arm.lengths)
        self._made: dict[float, ca.Function] = {}

    def at_tolerance(self, tolerance: float) -> tuple[Array, float]:
        """Return angles of the joints at the times, (k, n), and the seconds that took."""
        if tolerance not in self._made:
            self._made[tolerance] = self._solver(tolerance)
        solver, start = self._made[tolerance], ca.DM.zeros(self._size)
        begun = time.thread_time()
        found = solver(x0=start)["xf"]
        return np.array(found).T[:, : self._size // 2], time.thread_time() - begun

    def _solver(self, tolerance: float) -> ca.Function:
        x = ca.SX.sym("x", self._size)
        options: dict[str, Any] = {
            "reltol": tolerance,
            "abstol": tolerance,
            "jit": True,
            "compiler": "shell",
            "jit_cleanup": False,  # the folder goes as a whole
            "jit_options": {"flags": ["-O3", "-march=native"], "cleanup": False},
            "max_num_steps": 1_000_000,
        }
        equations = {"x": x, "ode": self._slope(x)}
        # CasADi leaves its texts there
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            return ca.integrator("solver", "cvodes", equations, 0.0, self._times, options)


class Scipy:
    """SciPy's ``solve_ivp`` on slopes that CasADi computes.

    Parameters
    ----------
    arm : JointArm
    times : array, (k,)
        When the motion is wanted, s.
    method : str
        As SciPy calls it.
    """

    def __init__(self, arm: JointArm, times: Array, method: str) -> None:
        self._slope, self._times, self._method = slopes(arm), times, method
        self._size = 2 * len(arm.lengths)

    def at_tolerance(self, tolerance: float) -> tuple[Array, float]:
        """Return angles of the joints at the times, (k, n), and the seconds that took."""
        bound: tuple[Any, Any] = self._slope.buffer()
        buffer, run = bound
        given, found = np.zeros(self._size), np.zeros(self._size)
        buffer.set_arg(0, given.data)
        buffer.set_res(0, found.data)

        def slope(_: float, x: Array) -> Array:
            given[:] = x
            run()
            return found.copy()

        begun = time.thread_time()
        solved = solve_ivp(
            slope,
            (0.0, float(self._times[-1])),
            np.zeros(self._size),
            method=self._method,
            t_eval=self._times,
            rtol=max(tolerance, 3e-14),
            atol=tolerance,
        )
        seconds = time.thread_time() - begun
        return solved.y.T[:, : self._size // 2], seconds


class Mujoco:
    """MuJoCo on the same arm.

    Parameters
    ----------
    arm : JointArm
    method : str
        Its integrator, as its files call it.
    """

    def __init__(self, arm: JointArm, method: str) -> None:
        self._arm, self._method = arm, method

    @cached_property
    def _model(self) -> mujoco.MjModel:
        return mujoco.MjModel.from_xml_string(mjcf(self._arm, self._method))

    def advance(self, step: float, between: int, times: int) -> tuple[Array, float]:
        """Take so many steps between so many instants; return angles of the joints there, and the seconds it took."""
        model = self._model
        mujoco.set_mju_user_warning(lambda _: None)  # what is unstable shows in its errors
        model.opt.timestep = step
        data, found = mujoco.MjData(model), []
        begun = time.thread_time()
        for _ in range(times):
            mujoco.mj_step(model, data, nstep=between)
            found.append(data.qpos.copy())
        return np.array(found), time.thread_time() - begun


def mjcf(arm: JointArm, method: str) -> str:
    """Return an arm on a clamp as MuJoCo reads it, turning about its y so that x is ours and z is our y."""
    inner = []
    place = 0.0
    for k, length in enumerate(arm.lengths):
        centre = arm.first_moments[k] / arm.masses[k]
        own = arm.inertias[k] - arm.masses[k] * centre**2
        inner.append(
            f'<body pos="{place:.17g} 0 0"><joint type="hinge" axis="0 -1 0" stiffness="{arm.stiffness[k]:.17g}" '
            f'damping="{arm.damping[k]:.17g}" springref="{np.degrees(arm.slack[k]):.17g}" '
            f'armature="{arm.rotors[k]:.17g}"/>'
            f'<inertial pos="{centre:.17g} 0 0" mass="{arm.masses[k]:.17g}" '
            f'diaginertia="{own:.17g} {own:.17g} {own:.17g}"/>'
        )
        place = length
    return (
        f'<mujoco><option gravity="0 0 {-arm.gravity:.17g}" integrator="{method}"><flag contact="disable"/></option>'
        f"<worldbody>{''.join(inner)}{'</body>' * len(inner)}</worldbody></mujoco>"
    )
