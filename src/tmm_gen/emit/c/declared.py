"""What the header of a kernel in C declares, documents and says in words."""

from __future__ import annotations

from dataclasses import dataclass

from tmm_gen.c_language.names import bare_names, macros
from tmm_gen.c_language.wrap import comment
from tmm_gen.emit.c.circle import has_angles
from tmm_gen.emit.c.constants import constants, default_step, defaults
from tmm_gen.emit.c.emitted import Emitted
from tmm_gen.emit.c.given import given_tables
from tmm_gen.emit.c.members import member_lines
from tmm_gen.emit.c.pair import pair_literal
from tmm_gen.emit.c.structs import described, dimension
from tmm_gen.emit.c.words import head, instants, out_of_range, statuses
from tmm_gen.emit.runs import Run
from tmm_gen.program.variables import Variable


@dataclass(frozen=True)
class Declared(Emitted):
    """A program lowered for C, as its header tells of it."""

    def comment(self, lead: str, *paragraphs: str) -> str:
        """Return the head of a file and paragraphs behind it, every line with a lead."""
        return head(self.header, lead, paragraphs)

    def doxygen(self, text: str) -> str:
        """Return a comment on lines of its own."""
        return "\n".join(comment(text, 0, "/**"))

    @property
    def stages(self) -> int:
        """Number of instants of a step at which inputs are read."""
        return max(len(instants) for instants in self.program.stage_instants)

    @property
    def instants(self) -> str:
        """The instants of a step at which inputs are read, in words; first steps that differ are told apart."""
        *early, main = self.program.stage_instants
        told = [f"in step {k} {instants(at)}" for k, at in enumerate(early, start=1) if at != main]
        return ", ".join([*told, f"{'then ' if told else ''}{instants(main)}"])

    @property
    def when(self) -> str:
        """When the inputs of a step act, in words."""
        return f"at {self.instants}" if self.stages == 1 else "at each stage of the step"

    @property
    def statuses_of_step(self) -> str:
        """What a step may return, in words."""
        fenced = any(self.fences.get(r.name) for r in self.program.steps)
        fenced = fenced or (self.circle is not None and any(map(has_angles, self.program.steps)))
        return statuses(*self.program.steps, ranged=fenced)

    @property
    def statuses_of_start(self) -> str:
        """What initialise may return, in words."""
        start = self.program.initialise
        fenced = bool(self.fences.get(start.name)) or (self.circle is not None and has_angles(start))
        return statuses(start, ranged=fenced)

    def members(self, which: str, number: str = "") -> list[str]:
        """Return the members of a struct, documented beside, or above where that is too wide.

        Parameters
        ----------
        which : str
            Name of the struct.
        number : str, optional
            Type of its numbers, behind the kernel's name; by default its own.
        """
        return member_lines(self.structs[which], self.program, self.real, number)

    @property
    def bare_names(self) -> list[str]:
        """Inputs and outputs whose members have no prefix in the sources emitted for the scene."""
        return bare_names(self.program)

    @property
    def given(self) -> list[tuple[str, str, str]]:
        """Name, length in brackets and description of what initialise starts from."""
        return [(v.name, dimension(v, self.program), described(v)) for v in self.program.given]

    @property
    def starts_from_step(self) -> bool:
        """Whether initialise takes the time step."""
        return not self.bound and self.program.step in self.program.initialise.read()

    @property
    def range_doc(self) -> str:
        """The comment on the status OUT_OF_RANGE."""
        largest = f"{macros(self.program.name)}_LARGEST_ANGLE"
        return out_of_range(largest if self.circle is not None else None, fenced=self.fenced)

    @property
    def copied(self) -> list[tuple[str, str, str]]:
        """Parameters the model keeps: member, its source, its length in brackets."""
        kept = [v for v in (self.program.step, *self.program.parameters) if v in self.program.model]
        return [(v.name, self._argument(v), dimension(v, self.program)) for v in kept]

    def _argument(self, variable: Variable) -> str:
        return variable.name if variable is self.program.step else f"params->{variable.name}"

    def constants(self) -> list[str]:
        """Return declarations of what is bound at generation and read when the kernel runs."""
        return list(constants(self.program, self.real))

    def defaults(self) -> list[tuple[Variable, list[str], tuple[Run, ...] | None]]:
        """Return the scene's parameters as literals, those of arrays in lines that fit, and their long runs."""
        return list(defaults(self.program, self.real))

    def parameter(self, value: float) -> str:
        """Return a parameter's value as an expression."""
        return f"(pair){pair_literal(value)}" if self.real.pair else self.real.literal(value)

    @property
    def default_step(self) -> str:
        """The scene's time step as a literal."""
        return default_step(self.program, self.real)

    @property
    def given_tables(self) -> list[str]:
        """Return declarations of the scene's start, for callers who give none."""
        return list(given_tables(self.program, self.real))
