"""A program prepared for the templates of C."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

from tmm_gen.c_language.names import bare_names, declared, macros, signal
from tmm_gen.c_language.real import Real, real_of
from tmm_gen.c_language.wrap import INDENT, WIDTH, comment, statement
from tmm_gen.emit.c.bind import bind
from tmm_gen.emit.c.body import TOTAL, Body
from tmm_gen.emit.c.box import complete_box
from tmm_gen.emit.c.circle import Circle, PairCircle, has_angles, uses_circle
from tmm_gen.emit.c.fence import Fence, fence_of
from tmm_gen.emit.c.finite import check, finite_checks
from tmm_gen.emit.c.given import given_checks, given_tables
from tmm_gen.emit.c.lower import lower
from tmm_gen.emit.c.pair import functions_in, pair_literal
from tmm_gen.emit.c.pair_outputs import rounded_last
from tmm_gen.emit.c.structs import COUNTER, Struct, described, dimension, structs_of
from tmm_gen.emit.header import header_lines
from tmm_gen.emit.runs import Run, runs
from tmm_gen.program.passes.dependence import written_elements
from tmm_gen.program.statements import Assign, Loop, Mark, Program, Require, Routine
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
        lowered = lower(program, apart=scene.emit.favour == "speed")
        counted = program
        if scene.emit.favour == "speed":  # there, a few operations more make chains shorter
            counted = replace(program, startup=lowered.startup, main=lowered.main)
        lines = (*header_lines(counted, scene), f"number type: {number}", f"bytes of the structs: {sizes}")
        if real.pair:
            lowered = replace(lowered, output=rounded_last(lowered.output))
        return cls(program, lowered, real, lines, structs, scene)

    def comment(self, lead: str, *paragraphs: str) -> str:
        """Return the head of a file and paragraphs behind it, every line with a lead."""
        width = WIDTH - len(lead) - 1
        wrapped: list[str] = []
        for line in self.header:
            wrapped += textwrap.wrap(line, width, subsequent_indent=INDENT) or [""]
        for paragraph in paragraphs:
            wrapped += ["", *textwrap.wrap(paragraph, width)]
        return "\n".join(f"{lead} {line}".rstrip() for line in wrapped)

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
        """The instants of the main step at which inputs are read, in words."""
        named = [_instant(x) for x in self.program.stage_instants[-1]]
        return named[0] if len(named) == 1 else f"{', '.join(named[:-1])} and {named[-1]}"

    @property
    def when(self) -> str:
        """When the inputs of a step act, in words."""
        return f"at {self.instants}" if self.stages == 1 else "at each stage of the step"

    @property
    def statuses_of_step(self) -> str:
        """What a step may return, in words."""
        fenced = any(self.fences.get(r.name) for r in self.program.steps)
        fenced = fenced or (self.circle is not None and any(map(has_angles, self.program.steps)))
        return _statuses(*self.program.steps, ranged=fenced)

    @property
    def statuses_of_start(self) -> str:
        """What initialise may return, in words."""
        start = self.program.initialise
        fenced = bool(self.fences.get(start.name)) or (self.circle is not None and has_angles(start))
        return _statuses(start, ranged=fenced)

    def members(self, which: str, number: str = "") -> list[str]:
        """Return the members of a struct, documented beside, or above where that is too wide.

        Parameters
        ----------
        which : str
            Name of the struct.
        number : str, optional
            Type of its numbers, behind the kernel's name; by default its own.
        """
        struct = self.structs[which]
        number = number or ("pair" if struct.holds_pairs(self.real) else "real")
        number = f"{self.program.name}_{number}"
        chosen = which in ("inputs", "outputs")
        members = [
            (number, signal(f.name, self.program.name) if chosen else f.name, f.dimension, f.doc)
            for f in struct.fields
        ]
        if not members:
            members = [(number, "none", "", "unused: C has no empty structs")]
            chosen = False
        if struct.counter:
            of_each = f"[{macros(self.program.name)}_BATCH]" if number.endswith("_many") else ""
            members.append(
                ("int", COUNTER, of_each, "how many of the integrator's first steps, which differ, are done")
            )
        widest = max(
            len(f"{INDENT}{kind} {name}{length}; /**< {doc} */") for kind, name, length, doc in members
        )
        lines: list[str] = []
        for kind, name, length, doc in members:
            head, tail, remark = f"{INDENT}{kind} ", f"{length};", f" /**< {doc} */"
            if widest > WIDTH:
                lines += comment(doc, 1, "/**")
                remark = ""
            lines += declared(name, head, tail, remark) if chosen else [f"{head}{name}{tail}{remark}"]
        return lines

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
        what = []
        if self.circle is not None:
            what.append(f"an angle is beyond {macros(self.program.name)}_LARGEST_ANGLE")
        if self.fenced:
            what.append("an intermediate result is beyond what the box of the scene can lead to")
        text = f"{', or '.join(what)}; nothing was changed."
        return "\n".join(comment(text[:1].upper() + text[1:], 1, "/**"))

    # -- bodies of functions ------------------------------------------------------------------------

    def body(self, routine: Routine, kind: str) -> Body:
        """Return the body of a function.

        Parameters
        ----------
        routine : Routine
            Lowered.
        kind : str
            Key of :data:`tmm_gen.emit.c.body.SOURCES`.
        """
        of = self.program.main.name if kind == "linearise" else routine.name
        fence = self.fences.get(of, Fence())
        judged = kind in ("initialise", "step", "linearise")
        return Body(
            self.program,
            routine,
            kind,
            self.real,
            self.circle is not None,
            fence,
            self.bound,
            judged,
            self.fast,
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
        return self.body(self.program.main, "step")

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
        failure = f"{macros(self.program.name)}_NON_FINITE_MODEL"
        sums = "(model->{0}.high + model->{0}.low)" if self.real.pair else "model->{0}"
        single: list[str] = []
        by_stations: dict[tuple[int, str], list[str]] = {}
        checked = (self.program.step, *self.program.parameters)
        for variable in (v for v in self.program.model if v not in checked):
            if variable.length is None:
                single.append(sums.format(variable.name))
            for start, stop in written_elements(self.program.prepare, variable):
                whole = dimension(variable, self.program)[1:-1]
                stations = (start, whole if stop == variable.length else str(stop))
                by_stations.setdefault(stations, []).append(variable.name)
        lines: list[str] = []
        if by_stations:
            lines.append(
                f"{INDENT}real {TOTAL} = {self.real.literal(0)}; /* of the model: is all of it finite? */"
            )
            single.append(TOTAL)
        for (start, end), names in by_stations.items():
            lines.append(f"{INDENT}for (int j = {start}; j < {end}; ++j) {{")
            lines += statement(f"{TOTAL} += {' + '.join(sums.format(f'{name}[j]') for name in names)};", 2)
            lines.append(f"{INDENT}}}")
        return "\n".join([*lines, *(check([" + ".join(single)], failure, 1) if single else ())])

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
        routines = (self.program.initialise, *self.program.steps, self.program.output)
        read = frozenset().union(*(routine.read() for routine in routines))
        lines = []
        for variable, values in bind(self.program, self.real).items():
            if variable in read:
                lines += self._constant(variable, values)
        return lines

    def _constant(self, variable: Variable, values: tuple[float, ...]) -> list[str]:
        remark = comment(described(variable), 0)
        literal = pair_literal if self.real.pair else self.real.shortest
        head = f"static const {self.number} {variable.name}{dimension(variable, self.program)} ="
        if variable.length is None:
            line = f"{head} {literal(values[0])};"
            beside = f"{line} {remark[0]}"
            return [beside] if len(remark) == 1 and len(beside) <= WIDTH else [*remark, line]
        numbers = textwrap.wrap(", ".join(map(literal, values)), WIDTH - len(INDENT))
        return [*remark, f"{head} {{", *(INDENT + line for line in numbers), "};"]

    def defaults(self) -> list[tuple[Variable, list[str], tuple[Run, ...] | None]]:
        """Return the scene's parameters as literals, those of arrays in lines that fit, and their long runs."""
        return [(v, self._literals(v), _runs(v)) for v in self.program.parameters]

    def parameter(self, value: float) -> str:
        """Return a parameter's value as an expression."""
        return f"(pair){pair_literal(value)}" if self.real.pair else self.real.literal(value)

    @property
    def default_step(self) -> str:
        """The scene's time step as a literal."""
        assert isinstance(self.program.step.default, float)
        if self.real.pair:
            return f"(({self.program.name}_pair){pair_literal(self.program.step.default)})"
        return self.real.literal(self.program.step.default)

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

    def _literals(self, variable: Variable) -> list[str]:
        values = variable.default if isinstance(variable.default, tuple) else (variable.default,)
        literal = pair_literal if self.real.pair else self.real.literal
        numbers = [literal(value) for value in values if value is not None]
        return textwrap.wrap(", ".join(numbers), WIDTH - 2 * len(INDENT))


def _runs(variable: Variable) -> tuple[Run, ...] | None:
    return runs(variable.default) if isinstance(variable.default, tuple) else None


def _flat(routine: Routine) -> Iterator[Assign | Require | Mark]:
    for top in routine.statements():
        yield from top.body if isinstance(top, Loop) else (top,)


def _statuses(*routines: Routine, ranged: bool) -> str:
    required = any(isinstance(s, Require) for r in routines for s in _flat(r))
    names = [
        "OK",
        "NON_FINITE_INPUT",
        "NULL_POINTER",
        *(["VANISHING_PIVOT"] if required else []),
        "NON_FINITE_STATE",
    ]
    names += ["OUT_OF_RANGE"] if ranged else []
    return f"{', '.join(names[:-1])} or {names[-1]}"


def _instant(at: float) -> str:
    if at == 1:
        return "the end of the step"
    return "its beginning" if at == 0 else f"{at:.6g} of the step"
