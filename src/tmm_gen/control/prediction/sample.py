"""A sample of the generated step: its steps one after the other, with a torque that may change on the way."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from tmm_gen.control.prediction.compiled import compiled
from tmm_gen.control.prediction.step_slopes import step_slopes

if TYPE_CHECKING:
    from tmm_gen.control.prediction.step_model import StepModel


def after_sample(model: StepModel, x: Any, w: Any, p: Any) -> Any:
    """Return the state after a sample.

    Parameters
    ----------
    model : StepModel
        Whose step.
    x, w, p : casadi.SX
        State, torques before and then, parameters of the kernel.
    """
    step = model.module.step_function()
    for torque in _torques(model, w):
        x = step(x, model.inputs(torque), p)[0]
    return x


def sample_slopes(model: StepModel, x: Any, w: Any, p: Any) -> list[Any]:
    """Return the state after a sample and its slopes by state and torques; of MX, so that one step's code serves all.

    Parameters
    ----------
    model : StepModel
        Whose step.
    x, w, p : casadi.MX
        State, torques before and then, parameters of the kernel.
    """
    import casadi as ca

    step, driven = step_slopes(model.module), ca.DM(model.acting)
    by_state, by_torques = ca.MX.eye(model.size), ca.MX.zeros(model.size, 2 * model.motors.count)
    for torque in _torques(model, w):
        x, slope, by_inputs = step(x, model.inputs(torque), p)
        by_state = ca.mtimes(slope, by_state)
        shares = ca.densify(ca.jacobian(torque, w))
        by_torques = ca.mtimes(slope, by_torques) + ca.mtimes(ca.mtimes(by_inputs, driven), shares)
    return [x, ca.densify(by_state), ca.densify(by_torques)]


def rollout(model: StepModel) -> Callable[[Any, Any], Any]:
    """Return ``(x, w (2 m, N)) -> states after each sample``, compiled; see :attr:`StepModel.rollout`."""
    import casadi as ca

    x, w, p = (ca.SX.sym(name, size) for name, size in _sizes(model))
    one = ca.Function("sample", [x, w, p], [after_sample(model, x, w, p)])
    return _along(model, "rollout", one.mapaccum(model.problem.horizon), 1)


def rollout_slopes(model: StepModel) -> Callable[[Any, Any], Any]:
    """Return states and slopes after a sample at each of N points, compiled; see :attr:`StepModel.rollout_slopes`."""
    import casadi as ca

    x, w, p = (ca.MX.sym(name, size) for name, size in _sizes(model))
    one = ca.Function("sample_slopes", [x, w, p], sample_slopes(model, x, w, p))
    return _along(model, "rollout_slopes", one.map(model.problem.horizon), model.problem.horizon)


def _torques(model: StepModel, w: Any) -> list[Any]:
    """Return the torques of each step of a sample, m at a time."""
    count = model.motors.count
    before, then = w[:count], w[count:]
    shares = model.delay.shares(model.problem.substeps)
    return [then if share == 0.0 else share * before + (1.0 - share) * then for share in shares]


def _sizes(model: StepModel) -> list[tuple[str, int]]:
    return [("x", model.size), ("w", 2 * model.motors.count), ("p", len(model.parameters))]


def _along(model: StepModel, name: str, many: Any, states: int) -> Callable[[Any, Any], Any]:
    """Return a function of states and torques, compiled with parameters open: one library for all arms alike."""
    import casadi as ca

    width, horizon = 2 * model.motors.count, model.problem.horizon
    x, w = ca.MX.sym("x", model.size, states), ca.MX.sym("w", width, horizon)
    p = ca.MX.sym("p", len(model.parameters))
    results = many(x, w, ca.repmat(p, 1, horizon))
    run = compiled(ca.Function(name, [x, w, p], [*results] if states > 1 else [results]))
    parameters = model.parameters
    return lambda states, torques: run(states, torques, parameters)
