"""The generated step as a model of do-mpc (S. Lucia et al., Control Engineering Practice 60, 2017)."""

from __future__ import annotations

from typing import Any

from tmm_gen.control.prediction.step_model import StepModel
from tmm_gen.errors import UserError
from tmm_gen.extras import install


def do_mpc_model(model: StepModel) -> Any:
    """Return a discrete ``do_mpc.model.Model``, set up.

    States are those of the kernel by their names, inputs are the motors' torques; ``tip`` and ``hub`` are auxiliary
    expressions for costs and bounds, each with a row per motor.

    Parameters
    ----------
    model : StepModel
        The generated step.

    Raises
    ------
    UserError
        If do-mpc is not installed.
    """
    try:
        from do_mpc.model import Model
    except ImportError:
        raise UserError(f"do-mpc is not installed: {install('do-mpc')}") from None
    import casadi as ca

    made = Model("discrete", "SX")
    x = ca.vertcat(*(made.set_variable("_x", name) for name in model.names))
    u = ca.vertcat(*(made.set_variable("_u", name) for name in model.motors.inputs))
    after = ca.vertsplit(model.sample(x, ca.vertcat(u, u)))
    for name, value in zip(model.names, after, strict=True):
        made.set_rhs(name, value)
    for name, rows in (("tip", model.motors.tip), ("hub", model.motors.hub)):
        made.set_expression(name, ca.mtimes(ca.DM(model.rows(rows, "angle")), x))
    made.setup()
    return made
