"""A nonlinear MPC by real-time iteration as C, with the generated kernel inside."""

from __future__ import annotations

from dataclasses import replace

from tmm_gen.c_language.names import bare_names
from tmm_gen.c_language.real import REALS
from tmm_gen.control.laws.rti import RealTimeIteration
from tmm_gen.emit.c import emit_kernel
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.emit.templates import render
from tmm_gen.onboard.example_arm import ExampleArm
from tmm_gen.onboard.folder import complete
from tmm_gen.onboard.gathering import many_directions
from tmm_gen.onboard.loop_arm import LoopArm
from tmm_gen.onboard.rti_data import rti_data
from tmm_gen.onboard.rti_text import RtiText
from tmm_gen.onboard.sensing_text import SensingText
from tmm_gen.onboard.short_names import short_names
from tmm_gen.onboard.solver import solver_files
from tmm_gen.program.build import build_program


def emit_rti(
    name: str,
    title: str,
    controller: RealTimeIteration,
    arm: ExampleArm,
    real: str = "float64",
    real_time: LoopArm | None = None,
) -> dict[str, str]:
    """Write a real-time iteration as C.

    Parameters
    ----------
    name : str
        Prefix of its functions and files, an identifier of C; not the kernel's.
    title : str
        One line for its head.
    controller : RealTimeIteration
        What it is to do. Its filter becomes one of constant gain.
    arm : ExampleArm
        For its example.
    real : {"float64", "float32"}
        Number type.
    real_time : LoopArm, optional
        For its loop in real time; by default it has none.

    Returns
    -------
    dict of str to str
        Texts by path: ``<name>.h``, ``<name>.c``, the kernel's, which has the controller's name too, the solver's in
        ``daqp/``, an example and how to build all.
    """
    full = not controller.zero_order
    plain, kernel_name = controller.model.scene, f"{name}_kernel"
    changes = {
        "emit.backends": ["c"],
        "emit.real": real,
        "emit.sensitivities": True,
        "emit.compensated": False,
        "emit.parameters": "free",
        "emit.trigonometry": None,  # tangents are of the library's
    }
    # a name of its own, so that several controllers are in one program
    scene = replace(plain.replace(**changes), name=kernel_name)
    program = build_program(scene)
    kind = "nonlinear MPC by real-time iteration, " + ("full sensitivities" if full else "zero order")
    mpc = RtiText(
        name=name,
        title=title,
        problem=controller.problem,
        kind=kind,
        real=REALS[real],
        data=rti_data(controller),
        model=kernel_name,
        full=full,
        stages=max(len(instants) for instants in program.stage_instants),
        inputs_of_kernel=tuple(item.name for item in scene.inputs),
        bare_names=bare_names(program),
    )
    if full:
        directions = mpc.inputs_planned + len(mpc.data.sensors)
        mpc = replace(mpc, many=many_directions(Kernel.of(program, scene), directions))
    if mpc.many is None and program.sensitivities is not None:  # nobody gathers slopes
        program = replace(program, sensitivities=replace(program.sensitivities, reduced=None))
    sensing = None
    if mpc.several:
        sensing = SensingText(controller.model.sensing, mpc.data.sensors)
    context = {"mpc": mpc, "name": name, "NAME": mpc.NAME, "sensing": sensing}
    kernel = {path.removeprefix("c/"): text for path, text in emit_kernel(program, scene).items()}
    unused = (
        () if mpc.needs_tangents else (f"{kernel_name}_sensitivities.h", f"{kernel_name}_sensitivities.c")
    )
    kernel = {path: text for path, text in kernel.items() if path not in unused}
    files = {
        f"{name}.h": render("control/rti.h.jinja", **context),
        f"{name}.c": render("control/rti.c.jinja", **context),
        **kernel,
        **short_names(plain.name, kernel_name, kernel),
        **solver_files(name, mpc.single),
    }
    return complete(mpc, files, arm, real_time)
