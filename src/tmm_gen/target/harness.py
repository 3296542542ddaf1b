"""The program that runs a kernel on a board and on this machine, so that both can be compared."""

from __future__ import annotations

from dataclasses import dataclass

from tmm_gen.c_language.names import element_name
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.emit.c.structs import dimension
from tmm_gen.emit.templates import render
from tmm_gen.program.variables import Variable
from tmm_gen.scene import Scene
from tmm_gen.scene.signal import kernel_names

STEPS = 256
"""Steps of a run: two waves of every input."""
_GENTLE = 320.0
"""Amplitude of a prescribed acceleration, 1/s^2; rate and angle swing by this times the step and its square."""


@dataclass(frozen=True)
class Wave:
    """How an input swings.

    Parameters
    ----------
    members : tuple of str
        Of the struct of inputs; several where a step has stages.
    which : int
        Position among the inputs.
    middle, half : str
        Literals.
    """

    members: tuple[str, ...]
    which: int
    middle: str
    half: str


def harness(kernel: Kernel, counter: str, steps: int = STEPS) -> str:
    """Write the harness of a kernel.

    Parameters
    ----------
    kernel : Kernel
        Prepared for C.
    counter : str
        "systick", "instret" or, where nothing is counted, "none".
    steps : int
        How many steps it takes.
    """
    program = kernel.program
    return render(
        "target/harness.c.jinja",
        kernel=kernel,
        name=program.name,
        counter=counter,
        steps=steps + len(program.startup),
        startup=len(program.startup),
        inputs=[_wave(kernel, which, variable) for which, variable in enumerate(program.inputs)],
        given=[(v.name, dimension(v, program), _start(kernel, v)) for v in program.given],
    )


def _wave(kernel: Kernel, which: int, variable: Variable) -> Wave:
    low, high = swing(kernel.scene, variable.name)
    members = tuple(
        element_name(variable.entry(stage), kernel.program.name) for stage in range(variable.length or 1)
    )
    literal = kernel.real.literal
    return Wave(members, which, literal((low + high) / 2.0), literal((high - low) / 2.0))


def swing(scene: Scene, name: str) -> tuple[float, float]:
    """Return the bounds between which the harness moves an input: those of the scene's box, or 1 either way."""
    if scene.emit.box and name in scene.emit.box:
        return scene.emit.box[name]
    names = next((n for item in scene.motions if name in (n := kernel_names(item))), ())
    if not names:
        return -1.0, 1.0
    half = _GENTLE * scene.integrator.step ** (2 - names.index(name))
    return -half, half


def _start(kernel: Kernel, variable: Variable) -> str:
    values = variable.default if isinstance(variable.default, tuple) else (variable.default or 0.0,)
    length = variable.length or 1
    numbers = values if len(values) == length else values * length
    return ", ".join(kernel.real.literal(float(value)) for value in numbers)
