"""The generated model as plain CasADi expressions with the names acados gives them.

from acados_template import AcadosModel
model = AcadosModel()
for name, value in acados_fields(scene).items():
setattr(model, name, value)
"""

from __future__ import annotations

from typing import Any

import numpy as np

from tmm_gen.control.acados_code import acados_name
from tmm_gen.control.prediction.step_model import StepModel


def acados_fields(model: StepModel, continuous: bool = False) -> dict[str, Any]:
    """Return the fields of an ``AcadosModel``.

    Parameters
    ----------
    model : StepModel
        The generated step.
    continuous : bool
        Whether to give ``f_expl_expr`` and ``f_impl_expr`` of the angles and rates instead of ``disc_dyn_expr`` of the
        kernel's state over a sample.

    Returns
    -------
    dict from str to object
        ``name``; symbols ``x``, ``u`` (the motors' torques), ``p`` (none), and ``xdot``; the expressions; ``x_labels``,
        ``u_labels`` and ``cost_y_expr`` = angles of the tips, then of the hubs.
    """
    import casadi as ca

    names = list(model.motors.inputs)
    u = ca.vertcat(*(ca.SX.sym(name) for name in names))
    common: dict[str, Any] = {
        "name": acados_name(model, continuous),
        "u": u,
        "p": ca.SX.sym("p", 0),
        "u_labels": names,
    }
    if not continuous:
        x = ca.vertcat(*(ca.SX.sym(name) for name in model.names))
        return common | {
            "x": x,
            "disc_dyn_expr": model.sample(x, ca.vertcat(u, u)),
            "x_labels": list(model.names),
            "cost_y_expr": _angles(model, x),
        }
    motion = [*model.places("angle"), *model.places("rate")]
    labels = [model.names[place] for place in motion]
    x, rates = (ca.vertcat(*(ca.SX.sym(before + name) for name in labels)) for before in ("", "d_"))
    state = ca.SX.zeros(model.size)
    for k, place in enumerate(motion):
        state[place] = x[k]
    derivative = ca.vertcat(x[len(motion) // 2 :], accelerations(model, state, u))
    return common | {
        "x": x,
        "xdot": rates,
        "f_expl_expr": derivative,
        "f_impl_expr": rates - derivative,
        "x_labels": labels,
        "cost_y_expr": _angles(model, state),
    }


def accelerations(model: StepModel, state: Any, torques: Any) -> Any:
    """Return the accelerations of hub and links at a state under torques, as an expression.

    They are those of a generated step of no length: it leaves angles and rates as they are and solves the equations of
    motion there.
    """
    import casadi as ca

    parameters = ca.SX(model.parameters)
    parameters[0] = 0.0
    after = model.module.step_function()(state, model.inputs(torques), parameters)[0]
    return after[model.places("acceleration")]


def _angles(model: StepModel, state: Any) -> Any:
    """Return angles of tips and hubs."""
    import casadi as ca

    return ca.mtimes(ca.DM(model.rows(np.vstack([model.motors.tip, model.motors.hub]), "angle")), state)
