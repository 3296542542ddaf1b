"""The controllers there are, by name."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Controller
from tmm_gen.control.goals.way import Way, shaped_way, stepped_way
from tmm_gen.control.goals.window import Window
from tmm_gen.control.laws.inverse_dynamics import quintic_way
from tmm_gen.control.laws.linear_mpc import LinearMpc
from tmm_gen.control.laws.lqr import Regulator
from tmm_gen.control.laws.pd import PdController
from tmm_gen.control.laws.pd_gains import usual_gains
from tmm_gen.control.laws.rti import RealTimeIteration
from tmm_gen.control.laws.shaper import Kind, shaper, slowest_vibration
from tmm_gen.control.quadratic.qp import require_daqp
from tmm_gen.control.quadratic.walls import keeps_no_walls
from tmm_gen.scene.control import Baselines
from tmm_gen.scene.each import Each, by_names

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ControllerKind:
    """How to make a controller.

    Parameters
    ----------
    name : str
        As on the command line.
    title : str
        A few words.
    make : callable
        From a bench to a controller.
    default : bool
        Whether it is compared unless others are chosen.
    quadratic : bool
        Whether it solves quadratic programs, for which an extra is needed.
    arms_by_parts : bool
        Whether it is compared by default where motors are parts by name.
    follows : bool
        Whether it can follow a trajectory.
    keeps : bool or None
        Whether it keeps walls; None of a baseline, which knows of no bounds and is compared as it is.
    """

    name: str
    title: str
    make: Callable[[Bench], Controller]
    default: bool = True
    quadratic: bool = False
    arms_by_parts: bool = False
    keeps: bool | None = None

    def compared(self, bench: Bench) -> bool:
        """Return whether it is compared on an arm unless others are chosen."""
        if bench.problem.keeps and self.keeps is False:
            return False
        return self.default or (self.arms_by_parts and not bench.problem.motors.on_hub)

    def require_able(self, bench: Bench) -> None:
        """Refuse walls that it cannot keep.

        Raises
        ------
        UserError
            If the scene has such and it cannot.
        """
        if bench.problem.keeps and self.keeps is False:
            others = ", ".join(kind.name for kind in CONTROLLERS if kind.keeps)
            raise keeps_no_walls(bench.scene, self.name, others)


def _gains(bench: Bench, gains: Each[tuple[float, float]] | None) -> tuple[Array, Array]:
    """Return gains, (m,) each; see :mod:`tmm_gen.control.laws.pd_gains` for those that are not told."""
    if gains is not None:
        proportional, derivative = np.array(by_names(gains, bench.problem.motors.names)).T
        return proportional, derivative
    return usual_gains(bench)


def _baselines(bench: Bench) -> Baselines:
    control = bench.scene.control
    return control.baselines if control is not None else Baselines()


def make_pd(
    bench: Bench, gains: Each[tuple[float, float]] | None, shaping: Kind | None = None
) -> PdController:
    """Return a PD controller, with references shaped for the closed loop's slowest vibration if asked for."""
    proportional, derivative = _gains(bench, gains)
    model, problem = bench.modes, bench.problem
    shapers = None
    if shaping is not None:
        frequency, damping = slowest_vibration(model, problem, proportional, derivative)
        shapers = [shaper(shaping, frequency, damping, problem.sample_time)] * problem.count
    if bench.course is None:
        return _pd(bench, proportional, derivative, stepped_way(model.goal.torque, shapers))
    angles, rates, _ = Window.of(bench.course.angles, problem.sample_time).motion
    torque = np.array([model.lift.torque(model.goal, each) for each in angles])
    return _pd(bench, proportional, derivative, shaped_way(angles, rates, torque, shapers))


def make_inverse_dynamics(bench: Bench, gains: Each[tuple[float, float]] | None) -> PdController:
    """Return a PD controller along a quintic, with the torques of the rigid arm given beforehand."""
    model, problem = bench.modes, bench.problem
    if bench.course is not None:
        angles, rates, growth = Window.of(bench.course.angles, problem.sample_time).motion
        torque = arm_of(bench.assumed).rigid_torques(angles, rates, growth)
        return _pd(bench, *_gains(bench, gains), shaped_way(angles, rates, torque))
    way = quintic_way(bench.assumed, problem, model.start_hub, model.goal)
    return _pd(bench, *_gains(bench, gains), way)


def _pd(bench: Bench, proportional: Array, derivative: Array, way: Way) -> PdController:
    model = bench.modes
    inertia = np.where(np.isfinite(bench.inertia), bench.inertia, 0.0)
    return PdController(bench.problem, proportional, derivative, model.goal, way, inertia, model.start_torque)


def _nmpc(bench: Bench) -> Controller:
    from tmm_gen.control.laws.full_nmpc import FullNmpc

    return FullNmpc(bench.step, bench.links, bench.inertia)


CONTROLLERS: tuple[ControllerKind, ...] = (
    ControllerKind("pd", "PD on the hub", lambda b: make_pd(b, _baselines(b).pd)),
    ControllerKind("pd-zv", "PD, ZV shaper", lambda b: make_pd(b, _baselines(b).pd_zv, "zv")),
    ControllerKind("pd-zvd", "PD, ZVD shaper", lambda b: make_pd(b, _baselines(b).pd_zvd, "zvd")),
    ControllerKind(
        "pd-id",
        "PD, inverse dynamics",
        lambda b: make_inverse_dynamics(b, _baselines(b).pd_id),
        default=False,
        arms_by_parts=True,
    ),
    ControllerKind(
        "lqr", "LQR, modes", lambda b: Regulator(b.modes, b.problem, _baselines(b).lqr, b.inertia)
    ),
    ControllerKind(
        "mpc-links",
        "linear MPC, links",
        lambda b: LinearMpc(b.links, b.problem, b.inertia),
        quadratic=True,
        keeps=False,
    ),
    ControllerKind(
        "mpc-modes",
        "linear MPC, modes",
        lambda b: LinearMpc(b.modes, b.problem, b.inertia),
        quadratic=True,
        keeps=False,
    ),
    ControllerKind(
        "rti-zero",
        "RTI, zero order",
        lambda b: RealTimeIteration(b.step, b.links, b.inertia, True),
        quadratic=True,
        keeps=True,
    ),
    ControllerKind(
        "rti",
        "RTI, full",
        lambda b: RealTimeIteration(b.step, b.links, b.inertia),
        quadratic=True,
        keeps=True,
    ),
    ControllerKind("nmpc", "NMPC to convergence", _nmpc, default=False, keeps=True),
)

BY_NAME = {kind.name: kind for kind in CONTROLLERS}


def require_solvers(kinds: Iterable[ControllerKind]) -> None:
    """Refuse to go on where a controller's solver is missing: models take long, and would be built in vain.

    Raises
    ------
    UserError
        If DAQP is needed and not installed.
    """
    if any(kind.quadratic for kind in kinds):
        require_daqp()
