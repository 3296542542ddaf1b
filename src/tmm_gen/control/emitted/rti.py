"""A nonlinear MPC by real-time iteration as C, with the generated kernel inside."""

from __future__ import annotations

from dataclasses import dataclass

from tmm_gen.control.emitted.rti_data import RtiData, rti_data
from tmm_gen.control.emitted.solver import solver_files
from tmm_gen.control.emitted.text import ControllerText
from tmm_gen.control.rti import RealTimeIteration
from tmm_gen.emit.c import emit_kernel
from tmm_gen.emit.c.real import REALS
from tmm_gen.emit.c_names import bare_names
from tmm_gen.emit.templates import render
from tmm_gen.program.build import build_program


@dataclass(frozen=True, eq=False)
class RtiText(ControllerText):
    """What the templates of a real-time iteration ask for.

    Parameters
    ----------
    data : RtiData
        Tables.
    model : str
        Prefix of the kernel.
    full : bool
        Whether sensitivities are computed along the trajectory.
    stages : int
        Instants of a step at which inputs are read.
    bare_names : list of str
        Inputs and outputs whose members have no prefix.
    """

    data: RtiData
    model: str
    full: bool
    stages: int
    bare_names: list[str]

    @property
    def needs_tangents(self) -> bool:
        """Whether the kernel's derivatives are used."""
        return self.full

    @property
    def outputs(self) -> tuple[str, ...]:
        """What is weighed or bounded."""
        return self.data.outputs

    @property
    def output_names(self) -> str:
        """The same in words."""
        return ", ".join(name.replace("_", " ") for name in self.outputs)

    @property
    def output_weights(self) -> str:
        """Weights of the outputs, a list of numbers."""
        return ", ".join(self.number(value) for value in self.data.weights)

    @property
    def output_targets(self) -> str:
        """Targets of the outputs, a list of numbers."""
        return ", ".join(self.number(value) for value in self.data.targets)

    @property
    def row_kinds(self) -> list[str]:
        """What the rows of the program bound, N each."""
        present = (("rate", self.problem.torque_rate), ("tip", self.problem.tip), ("hub", self.problem.hub))
        return [kind for kind, bound in present if bound is not None]


def emit_rti(name: str, title: str, controller: RealTimeIteration, real: str = "float64") -> dict[str, str]:
    """Write a real-time iteration as C.

    Parameters
    ----------
    name : str
        Prefix of its functions and files, an identifier of C; not the kernel's.
    title : str
        One line for its head.
    controller : RealTimeIteration
        What it is to do. Its filter becomes one of constant gain.
    real : {"float64", "float32"}
        Number type.

    Returns
    -------
    dict of str to str
        Texts by path: ``<name>.h``, ``<name>.c``, the kernel's, and the solver's in ``daqp/``.
    """
    full = not controller.zero_order
    changes = {
        "emit.backends": ["c"],
        "emit.real": real,
        "emit.sensitivities": True,
        "emit.compensated": False,
        "emit.parameters": "free",
    }
    scene = controller.model.scene.replace(**changes)
    program = build_program(scene)
    kind = "nonlinear MPC by real-time iteration, " + ("full sensitivities" if full else "zero order")
    mpc = RtiText(
        name=name,
        title=title,
        problem=controller.problem,
        kind=kind,
        real=REALS[real],
        data=rti_data(controller),
        model=scene.name,
        full=full,
        stages=max(len(instants) for instants in program.stage_instants),
        bare_names=bare_names(program),
    )
    context = {"mpc": mpc, "name": name, "NAME": name.upper()}
    kernel = {path.removeprefix("c/"): text for path, text in emit_kernel(program, scene).items()}
    unused = () if full else (f"{scene.name}_sensitivities.h", f"{scene.name}_sensitivities.c")
    return {
        f"{name}.h": render("control/rti.h.jinja", **context),
        f"{name}.c": render("control/rti.c.jinja", **context),
        **{path: text for path, text in kernel.items() if path not in unused},
        **solver_files(),
    }
