"""A linear MPC as C."""

from __future__ import annotations

from tmm_gen.c_language.real import REALS
from tmm_gen.control.laws.linear_mpc import LinearMpc
from tmm_gen.emit.templates import render
from tmm_gen.onboard.example_arm import ExampleArm
from tmm_gen.onboard.folder import complete
from tmm_gen.onboard.linear_data import linear_mpc_data
from tmm_gen.onboard.linear_text import LinearText
from tmm_gen.onboard.loop_arm import LoopArm
from tmm_gen.onboard.solver import solver_files


def emit_linear_mpc(
    name: str,
    title: str,
    controller: LinearMpc,
    arm: ExampleArm,
    real: str = "float64",
    real_time: LoopArm | None = None,
) -> dict[str, str]:
    """Write a linear MPC as C.

    Parameters
    ----------
    name : str
        Prefix of its functions and files, an identifier of C.
    title : str
        One line for its head.
    controller : LinearMpc
        What it is to do.
    arm : ExampleArm
        For its example.
    real : {"float64", "float32"}
        Number type.
    real_time : LoopArm, optional
        For its loop in real time; by default it has none.

    Returns
    -------
    dict of str to str
        Texts by path: ``<name>.h``, ``<name>.c``, the solver's in ``daqp/``, an example and how to build all.
    """
    data = linear_mpc_data(controller)
    mpc = LinearText(name, title, controller.problem, "linear MPC, condensed", REALS[real], data)
    context = {"mpc": mpc, "name": name, "NAME": mpc.NAME}
    files = {
        f"{name}.h": render("control/linear_mpc.h.jinja", **context),
        f"{name}.c": render("control/linear_mpc.c.jinja", **context),
        **solver_files(name, mpc.single),
    }
    return complete(mpc, files, arm, real_time)
