"""What all sensors of an arm show, by the state of its generated kernel."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tmm_gen.control.prediction.step_model import StepModel


def sensors_of(model: StepModel) -> Any:
    """Return ``h(x)``, a CasADi function: hubs' angles, accelerations across the last links at the tips, root moments.

    Accelerometers measure what gravity does to a proof mass too: at rest, ``g cos(q_n)``.

    Parameters
    ----------
    model : StepModel
        The generated step.
    """
    import casadi as ca

    x, count = ca.SX.sym("x", model.size), model.motors.count
    hubs = ca.mtimes(ca.sparsify(ca.DM(model.rows(model.motors.hub, "angle"))), x)
    if model.motors.on_hub:
        y = model.module.step_function()(x, model.inputs(ca.DM.zeros(count)), model.parameters)[1]
        behind = _on_hub(model, x, y)
    else:
        motion = (x[model.places(quantity)] for quantity in ("angle", "rate", "acceleration"))
        behind = model.sensing.shown(*motion)
    return ca.Function("sensors", [x], [ca.vertcat(hubs, behind)], ["x"], ["hubs_and_others"])


def _on_hub(model: StepModel, x: Any, y: Any) -> Any:
    """Return what accelerometer and gauge of an arm on a hub show, by its state and the outputs of its kernel."""
    import casadi as ca

    names = model.module.OUTPUT_NAMES
    across, up, root = (y[names.index(name)] for name in ("tip_acceleration_x", "tip_acceleration_y", "root"))
    angle = x[model.places("angle")[-1]]
    gravity = model.scene.model.gravity or 0.0
    return ca.vertcat(-across * ca.sin(angle) + (up + gravity) * ca.cos(angle), root)
