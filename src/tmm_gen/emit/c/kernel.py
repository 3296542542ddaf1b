"""A program prepared for the templates of C."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

from tmm_gen.c_language.names import bare_names, macros
from tmm_gen.c_language.real import Real, real_of
from tmm_gen.c_language.wrap import INDENT, comment
from tmm_gen.emit.c.body import Body
from tmm_gen.emit.c.box import complete_box
from tmm_gen.emit.c.circle import Circle, PairCircle, has_angles, uses_circle
from tmm_gen.emit.c.constants import constants, default_step, defaults
from tmm_gen.emit.c.fence import Fence, fence_of
from tmm_gen.emit.c.finite import finite_checks, model_checks
from tmm_gen.emit.c.given import given_checks, given_tables
from tmm_gen.emit.c.lower import lower
from tmm_gen.emit.c.members import member_lines
from tmm_gen.emit.c.pair import functions_in, pair_literal
from tmm_gen.emit.c.pair_outputs import rounded_last
from tmm_gen.emit.c.structs import Struct, described, dimension, structs_of
from tmm_gen.emit.c.vector_body import VectorBody
from tmm_gen.emit.c.vector_type import VectorType
from tmm_gen.emit.c.words import head, instants, out_of_range, statuses
from tmm_gen.emit.header import header_lines
from tmm_gen.emit.runs import Run
from tmm_gen.program.statements import Program, Routine, Vectors
from tmm_gen.program.variables import Variable
from tmm_gen.scene import Scene


@dataclass(frozen=True)
class Kernel:
    """What the templates of C ask for.

    Parameters
    ----------
    source : Program
        As built, for reference values.
    program : Program
        Lowered.
    real : Real
        Number type.
    header : tuple of str
        Lines for the head of every file.
    structs : dict from str to Struct
        By name: params, model, state, inputs, outputs.
    scene : Scene
        What is emitted.
    """

    source: Program
    program: Program
    real: Real
    header: tuple[str, ...]
    structs: dict[str, Struct]
    scene: Scene

    @classmethod
    def of(cls, program: Program, scene: Scene) -> Kernel:
        """Prepare a program for a scene's number type."""
        real = real_of(scene.emit)
        structs = {struct.name: struct for struct in structs_of(program)}
        if scene.emit.parameters == "bound":
            structs = {name: struct for name, struct in structs.items() if name not in ("params", "model")}
        sizes = ", ".join(f"{name} {struct.size(real)}" for name, struct in structs.items())
        number = f"sums of two of type {real.c}" if real.pair else real.c
        apart = scene.emit.favour == "speed" and scene.spatial is None
        lowered = lower(program, apart=apart)
        counted, facts = program, []
        if apart:  # there, a few operations more make chains shorter
            counted = replace(program, startup=lowered.startup, main=lowered.main)
        if (vectors := _vectors_of(lowered, scene)) is not None:
            counted = replace(program, main=vectors.step)
            facts = [f"vectors: of {vectors.parts} numbers; what does all of one is one operation"]
        lines = (
            *header_lines(counted, scene),
            *facts,
            f"number type: {number}",
            f"bytes of the structs: {sizes}",
        )
        if real.pair:
            lowered = replace(lowered, output=rounded_last(lowered.output))
        return cls(program, lowered, real, lines, structs, scene)

    def comment(self, lead: str, *paragraphs: str) -> str:
        """Return the head of a file and paragraphs behind it, every line with a lead."""
        return head(self.header, lead, paragraphs)

    def doxygen(self, text: str) -> str:
        """Return a comment on lines of its own."""
        return "\n".join(comment(text, 0, "/**"))

    @property
    def bound(self) -> bool:
        """Whether parameters and step are bound at generation, so that there are neither params nor model."""
        return self.scene.emit.parameters == "bound"

    @property
    def fast(self) -> bool:
        """Whether the kernel is to be fast on processors with vectors, rather than small."""
        return self.scene.emit.favour == "speed"

    @property
    def vectors(self) -> VectorType | None:
        """The type of vectors, where the step is in vectors."""
        found = _vectors_of(self.program, self.scene)
        return None if found is None else VectorType(self.real, found.parts)

    @property
    def functions(self) -> tuple[str, ...]:
        """What the kernel offers, without its name in front."""
        phases = ("initialise", "step", "output")
        return phases if self.bound else ("default_params", "prepare", *phases)

    def pointers(self, *names: str | None) -> tuple[str, ...]:
        """Return those of some arguments that the kernel's functions have."""
        absent = ("params", "model") if self.bound else ()
        return tuple(name for name in names if name and name not in absent)

    # -- pieces of the header -----------------------------------------------------------------------

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

    # -- own functions and bounds -------------------------------------------------------------------

    @cached_property
    def circle(self) -> Circle | None:
        """Own sine and cosine, where the scene asks for them and its arm needs them."""
        own = self.scene.emit.trigonometry == "own" and uses_circle(self.program)
        if not own:
            return None
        return PairCircle(self.real) if self.real.pair else Circle(self.real, self.fast)

    @cached_property
    def fences(self) -> dict[str, Fence]:
        """Bounds of intermediate results by routine, where the scene states a box."""
        box = complete_box(self.scene, self.program)
        if box is None:
            return {}
        return {
            routine.name: fence_of(self.program, box, routine, in_space=self.scene.spatial is not None)
            for routine in (self.program.initialise, *self.program.steps)
        }

    @property
    def fenced(self) -> bool:
        """Whether some intermediate result has bounds."""
        return any(self.fences.values())

    @property
    def range_doc(self) -> str:
        """The comment on the status OUT_OF_RANGE."""
        largest = f"{macros(self.program.name)}_LARGEST_ANGLE"
        return out_of_range(largest if self.circle is not None else None, fenced=self.fenced)

    # -- bodies of functions ------------------------------------------------------------------------

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
        found = _vectors_of(self.program, self.scene)
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

    @property
    def given_tables(self) -> list[str]:
        """Return declarations of the scene's start, for callers who give none."""
        return list(given_tables(self.program, self.real))

    def absent(self, *names: str | None) -> str:
        """Return statements that leave a function where one of some pointers is NULL."""
        condition = " || ".join(f"{name} == NULL" for name in self.pointers(*names))
        failure = f"{macros(self.program.name)}_NULL_POINTER"
        return f"{INDENT}if ({condition}) {{\n{INDENT * 2}return {failure};\n{INDENT}}}"

    @property
    def sources(self) -> list[str]:
        """The files of C to compile, without the test."""
        name = self.program.name
        more = {"_sensitivities": self.program.sensitivities, "_batch": self.scene.emit.batch}
        return [f"{name}.c", *(f"{name}{end}.c" for end, asked in more.items() if asked)]

    @property
    def copied(self) -> list[tuple[str, str, str]]:
        """Parameters the model keeps: member, its source, its length in brackets."""
        kept = [v for v in (self.program.step, *self.program.parameters) if v in self.program.model]
        return [(v.name, self._argument(v), dimension(v, self.program)) for v in kept]

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
    def number(self) -> str:
        """Type of parameters, model and state within the source."""
        return "pair" if self.real.pair else "real"

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

    def _argument(self, variable: Variable) -> str:
        return variable.name if variable is self.program.step else f"params->{variable.name}"


def _vectors_of(program: Program, scene: Scene) -> Vectors | None:
    """Return the step in vectors, where the kernel takes it: of several arms at once, each has the bits of its own."""
    return program.vectors if scene.emit.favour == "speed" and scene.emit.batch is None else None
