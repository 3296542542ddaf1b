"""The generated step as a model of do-mpc (S. Lucia et al., Control Engineering Practice 60, 2017)."""

from __future__ import annotations

from typing import Any

from tmm_gen.control.step_model import StepModel
from tmm_gen.errors import UserError
from tmm_gen.extras import install


def do_mpc_model(model: StepModel) -> Any:
    """Return a discrete ``do_mpc.model.Model``, set up.

    States are those of the kernel by their names, the input is the hub's torque; ``tip`` and ``hub`` are auxiliary
    expressions for costs and bounds.

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
    u = made.set_variable("_u", model.problem.input_name)
    after = ca.vertsplit(model.sample(x, ca.vertcat(u, u)))
    for name, value in zip(model.names, after, strict=True):
        made.set_rhs(name, value)
    made.set_expression("tip", ca.dot(ca.DM(model.mean_row("angle")), x))
    made.set_expression("hub", ca.dot(ca.DM(model.hub_row("angle")), x))
    made.setup()
    return made
