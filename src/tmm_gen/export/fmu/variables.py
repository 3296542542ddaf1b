"""What a functional mock-up unit shows of a kernel: parameters, initial values, inputs, outputs, motion."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from tmm_gen.c_language.names import PREFIX, member
from tmm_gen.c_language.real import Real
from tmm_gen.program.statements import Program
from tmm_gen.program.variables import Variable

Causality = Literal["parameter", "input", "output", "local"]

_INITIAL = {"parameter": "exact", "output": "calculated", "local": "calculated"}
_MOTION = ("angle", "rate", "acceleration")
"""Ends of the names of states that are motion; what else a state holds is the integrator's own history."""


@dataclass(frozen=True)
class FmuVariable:
    """A variable of the unit.

    Parameters
    ----------
    name : str
        Structured: ``parameters.stiffness``, ``initial.angle[3]``; inputs and outputs as in the scene.
    member : str
        Where it lies in C.
    causality : {"parameter", "input", "output", "local"}
        What an importer may do with it.
    unit, doc : str
        SI unit, "1" where there is none; one line.
    start : tuple of float
        Value at first, one per element; empty for results.
    length : int or None
        Number of elements; None for a single number.
    literals : str
        The start values in C; empty for results.
    """

    name: str
    member: str
    causality: Causality
    unit: str
    doc: str
    start: tuple[float, ...] = ()
    length: int | None = None
    literals: str = ""

    def attributes(self, reference: int) -> dict[str, str]:
        """Return what both versions of FMI say of it, by their words."""
        found = {
            "name": self.name,
            "valueReference": str(reference),
            "description": self.doc,
            "causality": self.causality,
            "variability": "fixed" if self.causality == "parameter" else "continuous",
        }
        if self.causality in _INITIAL:
            found["initial"] = _INITIAL[self.causality]
        return found

    @property
    def kind(self) -> str:
        """Role in C."""
        return {"parameter": "PARAMETER", "input": "INPUT"}.get(self.causality, "RESULT")

    @property
    def initial(self) -> bool:
        """Whether C has to set the start values itself: parameters come from the kernel, inputs start at zero."""
        return self.name.startswith("initial.")

    def elements(self) -> Iterator[FmuVariable]:
        """Yield the elements as variables of their own, numbered from 1."""
        if self.length is None:
            yield self
            return
        for k in range(self.length):
            start = self.start[k : k + 1]
            literals = self.literals.split(", ")[k] if self.literals else ""
            yield FmuVariable(
                f"{self.name}[{k + 1}]",
                f"{self.member}[{k}]",
                self.causality,
                self.unit,
                f"{self.doc}, number {k + 1}",
                start,
                None,
                literals,
            )


def fmu_variables(program: Program, real: Real, followed: Sequence[str]) -> tuple[FmuVariable, ...]:
    """Return the variables of a program's unit, arrays whole, in the order of their numbers from 1.

    Parameters
    ----------
    program : Program
        As built for the scene.
    real : Real
        Number type of the kernel.
    followed : sequence of str
        Inputs that are gone to smoothly, instead of being held: angle, rate and acceleration of a prescribed base.
    """
    return (
        *(_known(v, f"parameters.{v.name}", f"params.{v.name}", real) for v in program.parameters),
        *(_known(v, f"initial.{v.name.removeprefix('initial_')}", v.name, real) for v in program.given),
        *(_input(v, v.name in followed, program.name) for v in program.inputs),
        *(_result(v, v.name, f"outputs.{member(v, program.name)}", "output") for v in program.outputs),
        *(_result(v, f"state.{v.name}", f"state.{v.name}", "local") for v in program.state if _is_motion(v)),
    )


def _is_motion(variable: Variable) -> bool:
    return variable.name in _MOTION or variable.name in {f"hub_{name}" for name in _MOTION}


def _known(variable: Variable, name: str, member: str, real: Real) -> FmuVariable:
    length = variable.length or 1
    values = variable.default if isinstance(variable.default, tuple) else (variable.default or 0.0,) * length
    literals = ", ".join(real.literal(value) for value in values)
    return FmuVariable(
        name, member, "parameter", variable.unit, variable.doc, values, variable.length, literals
    )


def _input(variable: Variable, followed: bool, scene: str) -> FmuVariable:
    place = f"inputs.{member(variable, scene)}" + ("[0]" if variable.length else "")
    doc = variable.doc.partition(", at each stage")[0]
    if followed:
        place = f"{PREFIX}{variable.name}_target"
        doc += ", reached at the end of a communication step"
    return FmuVariable(variable.name, place, "input", variable.unit, doc, (0.0,))


def _result(variable: Variable, name: str, member: str, causality: Causality) -> FmuVariable:
    return FmuVariable(name, member, causality, variable.unit, variable.doc, (), variable.length)
