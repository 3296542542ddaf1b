"""Which controllers can be written in C, and their files."""

from __future__ import annotations

import numpy as np

from tmm_gen.control.bench import Bench
from tmm_gen.control.estimators.kalman import present_sensors
from tmm_gen.control.laws.linear_mpc import LinearMpc
from tmm_gen.control.laws.rti import RealTimeIteration
from tmm_gen.control.quadratic.condensed import Condensed
from tmm_gen.control.quadratic.walls import keeps_no_walls
from tmm_gen.control.task.where import where
from tmm_gen.errors import UserError
from tmm_gen.onboard.example_arm import example_arm
from tmm_gen.onboard.linear import emit_linear_mpc
from tmm_gen.onboard.loop_arm import loop_arm
from tmm_gen.onboard.rti import emit_rti

EMITTED = ("mpc-links", "mpc-modes", "rti-zero", "rti")
"""Names of the controllers that can be written in C."""
LINEAR = ("mpc-links", "mpc-modes")
"""Those of them that are linear."""

MOST_BEHIND = 6
"""Sensors behind the encoders that an emitted controller may read: its filter has a gain for each set of them."""

_MOST_LOST = 10.0
"""Rounding of the largest curvature of the cost over the least one. Single precision does with 3, not with 100."""


def usual_controller(bench: Bench) -> str:
    """Return the controller written in C unless another is chosen: the cheapest there is for the arm and its walls."""
    return "mpc-modes" if bench.problem.motors.on_hub else "rti-zero"


def emit_controller(
    bench: Bench, controller: str, real: str = "float64", name: str | None = None, real_time: bool = False
) -> tuple[str, dict[str, str]]:
    """Write a controller of a scene in C.

    Parameters
    ----------
    bench : Bench
        Of the scene.
    controller : str
        One of `EMITTED`.
    real : {"float64", "float32"}
        Number type.
    name : str, optional
        Prefix of its functions and files, by default those of the scene and of the controller.
    real_time : bool
        Whether to write a loop in real time too, with an arm to move, whose kernel takes time to derive in space.

    Returns
    -------
    name : str
        Prefix of its functions and files.
    files : dict of str to str
        Texts by path.

    Raises
    ------
    UserError
        If that controller cannot be written in C.
    """
    if controller not in EMITTED:
        raise UserError(
            f"the controller '{controller}' cannot be written in C; these can: {', '.join(EMITTED)}"
        )
    if bench.problem.keeps and controller in LINEAR:
        raise keeps_no_walls(
            bench.scene, controller, ", ".join(each for each in EMITTED if each not in LINEAR)
        )
    name = name or f"{bench.scene.name}_{controller.replace('-', '_')}"
    taken = {"daqp": "the solver's files", bench.scene.name: "the arm's own functions"}
    if name in taken and (name == "daqp" or controller not in LINEAR):
        raise UserError(
            f"--name {name}: is the prefix of {taken[name]}. Take another, such as {name}_control."
        )
    _require_few(bench)
    arm, moved = example_arm(bench), loop_arm(bench) if real_time else None
    title = bench.scene.title
    if controller in ("rti", "rti-zero"):
        made = RealTimeIteration(bench.step, bench.links, bench.inertia, controller == "rti-zero")
        _require_digits(bench, made.prepared, real)
        return name, emit_rti(name, title, made, arm, real, moved)
    model = bench.links if controller == "mpc-links" else bench.modes
    linear = LinearMpc(model, bench.problem, bench.inertia)
    _require_digits(bench, linear.condensed, real)
    return name, emit_linear_mpc(name, title, linear, arm, real, moved)


def _require_few(bench: Bench) -> None:
    """Refuse more sensors than there can be a gain for each set of."""
    names, problem = bench.problem.motors.names, bench.problem
    behind = len(present_sensors(problem)) - problem.count
    if behind > MOST_BEHIND:
        raise UserError(
            f"{where(bench.scene, 'control.sensors')}: {behind} accelerometers and gauges: a controller in C "
            f"reads at most {MOST_BEHIND}, as its filter has a gain for each set of them. Name fewer motors, such as "
            f"`accelerometer = {{ {names[-1]} = 0.1 }}`."
        )


def _require_digits(bench: Bench, condensed: Condensed, real: str) -> None:
    """Refuse single precision where rounding leaves nothing of how little the least of all torques is weighed."""
    curved = np.linalg.eigvalsh(condensed.input_hessian)
    lost = float(curved[-1] / curved[0] * np.finfo(np.float32).eps)
    if real == "float32" and not lost <= _MOST_LOST:
        raise UserError(
            f"{where(bench.scene, 'control.weights')}: in float32 rounding leaves nothing of the weights of "
            f"torques. Write it in float64, or make `torque` and `torque_step` some {lost:.0f} times as large."
        )
