"""A program prepared for the templates of C."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from tmm_gen.c_language.names import macros
from tmm_gen.c_language.wrap import INDENT
from tmm_gen.emit.c.body import Body
from tmm_gen.emit.c.declared import Declared
from tmm_gen.emit.c.emitted import vectors_of
from tmm_gen.emit.c.fence import Fence
from tmm_gen.emit.c.finite import finite_checks, model_checks
from tmm_gen.emit.c.given import given_checks
from tmm_gen.emit.c.pair import functions_in
from tmm_gen.emit.c.vector_body import VectorBody
from tmm_gen.program.statements import Routine
from tmm_gen.program.variables import Variable


@dataclass(frozen=True)
class Kernel(Declared):
    """What the templates of C ask for: what headers tell, and the bodies of functions."""

    def body(self, routine: Routine, kind: str) -> Body:
        """Return the body of a function.

        Parameters
        ----------
        routine : Routine
            Lowered.
        kind : str
            Key of :data:`tmm_gen.emit.c.sources.SOURCES`.
        """
        of = self.program.main.name if kind == "linearise" else routine.name
        fence = self.fences.get(of, Fence())
        judged = kind in ("initialise", "step", "linearise")
        in_vectors = self.vectors is not None and kind == "step"
        return (VectorBody if in_vectors else Body)(
            self.program,
            routine,
            kind,
            self.real,
            self.circle is not None,
            fence,
            self.bound,
            judged,
            self.fast and self.scene.spatial is None,
        )

    @cached_property
    def prepare(self) -> Body:
        """The body of prepare."""
        return self.body(self.program.prepare, "prepare")

    @cached_property
    def initialise(self) -> Body:
        """The body of initialise."""
        return self.body(self.program.initialise, "initialise")

    @cached_property
    def output(self) -> Body:
        """The body of output."""
        return self.body(self.program.output, "output")

    @cached_property
    def main(self) -> Body:
        """The body of the step."""
        found = vectors_of(self.program, self.scene)
        return self.body(self.program.main if found is None else found.step, "step")

    @cached_property
    def startup(self) -> list[Body]:
        """The bodies of the start-up steps."""
        return [self.body(routine, "step") for routine in self.program.startup]

    def checks(self, pointer: str, variables: tuple[Variable, ...], failure: str) -> str:
        """Return statements that leave a function with ``failure`` unless all variables are finite."""
        pairs = self.real.pair and pointer in ("params->", "state->")
        return "\n".join(
            finite_checks(pointer, variables, self.program, failure, self.real.literal(0), pairs)
        )

    def model_check(self) -> str:
        """Return statements that leave prepare unless the sum of the model is finite."""
        return "\n".join(model_checks(self.program, self.real))

    def given_checks(self) -> str:
        """Return statements that leave initialise where what it is given is not finite."""
        return "\n".join(given_checks(self.program, f"{macros(self.program.name)}_NON_FINITE_INPUT"))

    def absent(self, *names: str | None) -> str:
        """Return statements that leave a function where one of some pointers is NULL."""
        condition = " || ".join(f"{name} == NULL" for name in self.pointers(*names))
        failure = f"{macros(self.program.name)}_NULL_POINTER"
        return f"{INDENT}if ({condition}) {{\n{INDENT * 2}return {failure};\n{INDENT}}}"

    @property
    def pair_functions(self) -> frozenset[str]:
        """Functions of pairs that the kernel calls; none where its numbers are single."""
        if not self.real.pair:
            return frozenset()
        bodies = [self.initialise, self.main, self.output, *self.startup]
        texts = [body.text() for body in (bodies if self.bound else [self.prepare, *bodies])]
        if self.circle is not None:
            texts.append("pair_of( minus( plus( times( scaled(")
        return functions_in("\n".join(texts))
