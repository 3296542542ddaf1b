"""A nonlinear MPC by real-time iteration as C, with the generated kernel inside."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace

from tmm_gen.c_language.names import bare_names
from tmm_gen.c_language.real import REALS
from tmm_gen.control.rti import RealTimeIteration
from tmm_gen.emit.c import emit_kernel
from tmm_gen.emit.templates import render
from tmm_gen.onboard.example_arm import ExampleArm
from tmm_gen.onboard.folder import complete
from tmm_gen.onboard.rti_data import RtiData, rti_data
from tmm_gen.onboard.solver import solver_files
from tmm_gen.onboard.text import ControllerText
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
    inputs : tuple of str
        Names of the kernel's, in their order. The C asks for none of them by its name, which a macro may have.
    bare_names : list of str
        Inputs and outputs whose members have no prefix.
    """

    data: RtiData
    model: str
    full: bool
    stages: int
    inputs: tuple[str, ...]
    bare_names: list[str]

    @property
    def torque_at(self) -> int:
        """Where the hub's torque is among the kernel's inputs, in numbers."""
        return self.stages * self.inputs.index(self.problem.input_name)

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


def emit_rti(
    name: str, title: str, controller: RealTimeIteration, arm: ExampleArm, real: str = "float64"
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
        inputs=tuple(item.name for item in scene.inputs),
        bare_names=bare_names(program),
    )
    context = {"mpc": mpc, "name": name, "NAME": mpc.NAME}
    kernel = {path.removeprefix("c/"): text for path, text in emit_kernel(program, scene).items()}
    unused = () if full else (f"{kernel_name}_sensitivities.h", f"{kernel_name}_sensitivities.c")
    kernel = {path: text for path, text in kernel.items() if path not in unused}
    files = {
        f"{name}.h": render("control/rti.h.jinja", **context),
        f"{name}.c": render("control/rti.c.jinja", **context),
        **kernel,
        **short_names(plain.name, kernel_name, kernel),
        **solver_files(name, mpc.single),
    }
    return complete(mpc, files, arm)


def short_names(scene: str, kernel: str, files: Mapping[str, str]) -> dict[str, str]:
    """Return a header that gives the kernel inside a controller the names it has when the scene is built.

    Parameters
    ----------
    scene : str
        Prefix of the short names.
    kernel : str
        Prefix of the others.
    files : mapping of str to str
        The kernel's.
    """
    headers = sorted(path for path in files if path.endswith(".h"))
    words = {word for path in headers for word in re.findall(rf"\b{kernel}_\w+", files[path], re.IGNORECASE)}
    names = [
        (_shortened(word, scene, kernel), word) for word in sorted(words) if not word.endswith(("_H", "_h"))
    ]
    text = render("control/short_names.h.jinja", scene=scene, kernel=kernel, headers=headers, names=names)
    return {f"{scene}.h": text} if f"{scene}.h" not in files else {}


def _shortened(word: str, scene: str, kernel: str) -> str:
    prefix = scene if word.startswith(kernel) else scene.upper()
    return prefix + word[len(kernel) :]
