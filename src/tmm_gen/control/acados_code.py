"""The C that acados takes for discrete dynamics, by the generated tangent: expression, slopes, second derivatives.

acados (R. Verschueren et al., Mathematical Programming Computation 14, 2022) asks CasADi for three functions of a model
``NAME`` with ``phi(x, u, p)``, each in a file of its own, and calls them by these names:

    NAME_dyn_disc_phi_fun           (x, u, p)      -> phi
    NAME_dyn_disc_phi_fun_jac       (x, u, p)      -> phi, (d phi/d(u, x))'
    NAME_dyn_disc_phi_fun_jac_hess  (x, u, lam, p) -> phi, (d phi/d(u, x))', d2 (lam' phi)/d(u, x)2

Torques come before states in all derivatives. A fourth is for those who need second derivatives along few directions:

    NAME_dyn_disc_phi_hess_vec      (x, u, lam, v, p) -> d2 (lam' phi)/d(u, x)2 v
"""

from __future__ import annotations

from typing import Any

from tmm_gen.control.prediction.curvature import HeldSample
from tmm_gen.control.prediction.step_model import StepModel
from tmm_gen.emit.casadi.model import symbol
from tmm_gen.scratch import scratch_folder
from tmm_gen.version import __version__

_CODE: dict[str, Any] = {"with_header": True, "casadi_int": "int", "casadi_real": "double"}
"""As acados generates code; a header beside it."""


def acados_name(model: StepModel, continuous: bool = False) -> str:
    """Return the name of the model, which functions in C begin with."""
    return f"{symbol(model.scene.name)}_{'continuous' if continuous else 'discrete'}"


def acados_functions(model: StepModel, name: str | None = None) -> list[Any]:
    """Return the four functions of the module's head, of CasADi; all results are dense.

    Parameters
    ----------
    model : StepModel
        The generated step: x, (n,), its state, u, (m,), the motors' torques, N m, held over a sample; no parameters p.
    name : str, optional
        What acados calls the model; by default as in :func:`tmm_gen.control.acados.acados_fields`.
    """
    import casadi as ca

    front = f"{name or acados_name(model)}_dyn_disc_phi"
    size, motors = model.size, model.motors.count
    x, u, p = ca.MX.sym("x", size), ca.MX.sym("u", motors), ca.MX.sym("p", 0)
    lam, v = ca.MX.sym("lam", size), ca.MX.sym("v", motors + size)
    held = HeldSample(model)
    phi, slopes = held.slopes(x, u)
    last, along, curved = held.slopes_and_hessian(x, u, lam)
    product = held.hessian_product(x, u, lam, v)
    point, named = [x, u, p], ["x", "u", "p"]
    return [
        ca.Function(f"{front}_fun", point, [held.after(x, u)], named, ["phi"]),
        ca.Function(f"{front}_fun_jac", point, [phi, slopes.T], named, ["phi", "jac_ux_t"]),
        ca.Function(
            f"{front}_fun_jac_hess",
            [x, u, lam, p],
            [last, along.T, curved],
            ["x", "u", "lam", "p"],
            ["phi", "jac_ux_t", "hess_ux"],
        ),
        ca.Function(
            f"{front}_hess_vec", [x, u, lam, v, p], [product], ["x", "u", "lam", "v", "p"], ["product"]
        ),
    ]


def acados_code(model: StepModel, name: str | None = None) -> dict[str, str]:
    """Return the functions of :func:`acados_functions` as C99, each with a header of its own.

    Parameters
    ----------
    model : StepModel
        The generated step.
    name : str, optional
        What acados calls the model.

    Returns
    -------
    dict from str to str
        Texts by file name; each source compiles by itself.
    """
    import casadi as ca

    texts: dict[str, str] = {}
    head = _head(model)
    with scratch_folder() as folder:
        for function in acados_functions(model, name):
            code = ca.CodeGenerator(f"{function.name()}.c", _CODE)
            code.add(function)
            code.generate(f"{folder}/")
            for end in (".c", ".h"):
                file = f"{function.name()}{end}"
                texts[file] = head + (folder / file).read_text(encoding="utf-8")
    return texts


def _head(model: StepModel) -> str:
    lines = [
        f"Discrete dynamics of {model.scene.name} for acados, over {model.problem.sample_time!r} s.",
        f"Written by tmm-gen {__version__} with CasADi. Derivatives are by (u, x).",
        f"u: {', '.join(model.motors.inputs)} (N m)",
        *(f"x[{k}]: {name}" for k, name in enumerate(model.names)),
    ]
    return "".join(f"/* {line} */\n" for line in lines)
