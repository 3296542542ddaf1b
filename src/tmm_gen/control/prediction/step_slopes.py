"""A generated CasADi step with its derivatives: by the factors of its own sweep, or one direction after the other."""

from __future__ import annotations

from types import ModuleType
from typing import Any


def step_slopes(module: ModuleType) -> Any:
    """Return ``(x, u, p) -> x_next, d x_next/dx, d x_next/du``, a CasADi function; exact derivatives of the step.

    Of arms in a plane that is generated. In space the step is differentiated by CasADi along each direction in turn, by
    one piece of code for all of them: all at once it would be half a million lines for fifteen joints.

    Parameters
    ----------
    module : module
        The generated module.
    """
    if hasattr(module, "jacobian_function"):
        return module.jacobian_function()
    import casadi as ca

    step = module.step_function()
    x, u, p = (ca.SX.sym(name, step.size1_in(k)) for k, name in enumerate("xup"))
    size, inputs = x.numel(), u.numel()
    along = ca.SX.sym("along", size + inputs)
    after = step(x, u, p)[0]
    change = ca.jtimes(after, ca.vertcat(x, u), along)
    one = ca.Function("along", [x, u, p, along], [change])
    at = [ca.MX.sym(name, count) for name, count in zip("xup", (size, inputs, p.numel()), strict=True)]
    many = size + inputs
    columns = one.map(many)(*(ca.repmat(each, 1, many) for each in at), ca.DM.eye(many))
    slopes = [columns[:, :size], columns[:, size:]]
    return ca.Function("step_slopes", at, [ca.Function("step", [x, u, p], [after])(*at), *slopes])
