"""Bodies of the generated functions: take the variables in, compute, give the results back."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from tmm_gen.emit.numpy.statements import RoutineText
from tmm_gen.emit.python.lines import call, listing
from tmm_gen.emit.python.names import Names
from tmm_gen.program.statements import Program, Routine
from tmm_gen.program.variables import Role, Variable

_INDENT = "    "

RESERVED = frozenset(
    {
        "Model",
        "Output",
        "STATIONS",
        "State",
        "arrays",
        "batch",
        "dtype",
        "good",
        "input",
        "j",
        "model",
        "np",
        "numbers",
    }
    | {"params", "range", "reversed", "stages", "state"}
)
"""Names that generated functions use beside those of variables."""


@dataclass(frozen=True)
class Functions:
    """Writes the bodies of a program's functions.

    Parameters
    ----------
    program : Program
        What to write.
    names : Names
        Names of variables inside functions.
    """

    program: Program
    names: Names

    @property
    def several_stages(self) -> bool:
        """Whether inputs are given for each stage of a step."""
        return any(variable.length is not None for variable in self.program.inputs)

    def prepare(self) -> list[str]:
        """Return the body of ``prepare``."""
        program = self.program
        taken = (program.step, *program.parameters)
        body = RoutineText(program.prepare, self.names, program.stations)
        what = '"parameters or step are too large or too small for the number type"'
        several = (v for v in taken if v.length is not None)
        single = (v for v in taken if v.length is None)
        return [
            *self._checked(taken, {program.step: "step"}, "params."),
            f"{_INDENT}good = _positive(step)",
            *self._align(taken, body),
            *self._allocate(body),
            *body.lines(),
            *self._judged((*program.model, *single, *several), what),
            *call("return Model", [self._result(v, "()") for v in program.model], _INDENT),
        ]

    def initialise(self) -> list[str]:
        """Return the body of ``initialise``."""
        program, routine = self.program, self.program.initialise
        body = RoutineText(routine, self.names, program.stations)
        parameters = [v for v in program.parameters if v in routine.read()]
        step = [program.step] if program.step in routine.read() else []
        inputs = [v for v in program.inputs if v in routine.read()]
        taken = (*step, *parameters, *program.given)
        sources = {v: v.name for v in (*step, *program.given)}
        # What the start does not say is zero.
        open_state = [v for v in program.state if v not in routine.written() or v in body.filled]
        return [
            *([f"{_INDENT}stages = (input,)"] if self.several_stages and inputs else []),
            f"{_INDENT}good: Any = True",
            *self._inputs(inputs),
            *self._checked(taken, sources, "params."),
            *self._align((*inputs, *taken), body, open_state),
            *self._allocate(body, open_state),
            *body.lines(),
            *self._return_state(""),
        ]

    def step(self, routine: Routine, stages: int) -> list[str]:
        """Return the body of a step."""
        program = self.program
        body = RoutineText(routine, self.names, program.stations)
        read = routine.read()
        model = [v for v in program.model if v in read]
        inputs = [v for v in program.inputs if v in read]
        partly = [v for v in program.state if v in body.filled]
        return [
            f"{_INDENT}good: Any = True",
            *([f"{_INDENT}stages = _stages(input, {stages})"] if self.several_stages and inputs else []),
            *self._inputs(inputs),
            *self._taken(model, "model"),
            *self._taken(program.state, "state"),
            *self._align((*inputs, *model, *program.state), body),
            *(f"{_INDENT}{v.name} = {v.name}.copy()" for v in partly),
            *self._allocate(body),
            *body.lines(),
            *self._return_state("state.steps_taken + 1" if program.startup else ""),
        ]

    def output(self) -> list[str]:
        """Return the body of ``output``."""
        program, routine = self.program, self.program.output
        if any(v.role is Role.INPUT for v in routine.read()):
            raise NotImplementedError("outputs that depend on inputs directly")
        body = RoutineText(routine, self.names, program.stations)
        model = [v for v in program.model if v in routine.read()]
        results = [f"{v.name}=_spread({self.names[v]}, batch, False)" for v in program.outputs]
        return [
            *self._taken(model, "model"),
            *self._taken(program.state, "state"),
            *self._align((*model, *program.state), body),
            *self._allocate(body),
            *body.lines(),
            *call("return Output", results, _INDENT),
        ]

    # -- taking variables in

    def _checked(self, variables: Sequence[Variable], sources: dict[Variable, str], owner: str) -> list[str]:
        lines: list[str] = []
        for variable in variables:
            source = sources.get(variable, f"{owner}{variable.name}")
            length = "None" if variable.length is None else self._count(variable)
            lines += call(f"{variable.name} = _array", [source, length, f'"{variable.name}"'], _INDENT)
        return lines

    def _inputs(self, inputs: Sequence[Variable]) -> list[str]:
        lines: list[str] = []
        for variable in inputs:
            name, read = self.names[variable], variable.name
            if variable.length is None:
                lines += call(f"{name} = _array", [f"input.{read}", "None", f'"input {read}"'], _INDENT)
            else:
                lines += call(f"{name} = _at_stages", ["stages", f'"{read}"'], _INDENT)
        return lines

    def _taken(self, variables: Iterable[Variable], owner: str) -> list[str]:
        lines: list[str] = []
        for variable in variables:
            source = f"{owner}.{variable.name}"
            value = source if variable.length is None else f"np.asarray({source})"
            lines.append(f"{_INDENT}{variable.name} = {value}")
        return lines

    def _align(
        self, variables: Sequence[Variable], body: RoutineText, absent: Sequence[Variable] = ()
    ) -> list[str]:
        """Bring everything to the batch they have in common."""
        numbers: list[str] = []
        arrays: list[str] = []
        for variable in variables:
            several = variable.length is not None
            if variable.role is Role.INPUT:
                numbers.append(f"*{self.names[variable]}" if several else self.names[variable])
            else:
                (arrays if several else numbers).append(variable.name)
        allocates = any(v.length is not None for v in (*body.filled, *absent))
        lines = [
            *listing("numbers: tuple[Any, ...] = ", numbers, _INDENT),
            *listing("arrays: tuple[Any, ...] = ", arrays, _INDENT),
            f"{_INDENT}batch, {'dtype' if allocates else '_'} = _common(numbers, arrays)",
        ]
        for variable in variables:
            if variable.role is Role.STATE:
                whole = f"_spread({variable.name}, batch, {variable.length is not None})"
                lines.append(f"{_INDENT}{variable.name} = {whole}")
            elif variable.role is not Role.INPUT and variable.length is not None:
                lines.append(f"{_INDENT}{variable.name} = _align({variable.name}, batch)")
        return lines

    def _allocate(self, body: RoutineText, absent: Iterable[Variable] = ()) -> list[str]:
        """Make the arrays that are written element by element, and what is absent."""
        made = {v for v in body.filled if v.role is not Role.STATE} | set(absent)
        zeros = {v.name: f"np.zeros(({self._count(v)}, *batch), dtype)" for v in made if v.length is not None}
        lines = [f"{_INDENT}{name} = {zeros.get(name, '0.0')}" for name in sorted(v.name for v in made)]
        return [*lines, ""]

    def _count(self, variable: Variable) -> str:
        over = (variable.length or 0) - self.program.stations
        return {0: "STATIONS", 1: "STATIONS + 1"}.get(over, str(variable.length))

    # -- giving results back

    def _return_state(self, steps_taken: str) -> list[str]:
        fields = [self._result(v, "batch") for v in self.program.state]
        if steps_taken:
            fields.append(f"steps_taken={steps_taken}")
        judged = self._judged(self.program.state, '"the motion has outgrown the number type"')
        return [*judged, *call("return State", fields, _INDENT)]

    def _judged(self, variables: Sequence[Variable], what: str) -> list[str]:
        """Find the arms of which all numbers are finite."""
        several: dict[str, None] = {v.name: None for v in variables if v.length is not None}
        single: dict[str, None] = {v.name: None for v in variables if v.length is None}
        return [
            "",
            *listing("numbers = ", list(single), _INDENT),
            *listing("arrays = ", list(several), _INDENT),
            f"{_INDENT}good = _judged(good, numbers, arrays, {what})",
        ]

    def _result(self, variable: Variable, batch: str) -> str:
        """Give a variable back, NaN for arms that are not good; of a model, in the batch it has."""
        stations = variable.length is not None
        whole = f"_spread({variable.name}, batch, {stations})" if batch == "batch" else variable.name
        return f"{variable.name}=_kept({whole}, good, {stations})"
