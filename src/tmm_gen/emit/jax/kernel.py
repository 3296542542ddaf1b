"""A program as a Python module of pure functions that JAX compiles, differentiates and maps over many arms."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

from tmm_gen.emit.header import header_lines
from tmm_gen.emit.jax.statements import RoutineText
from tmm_gen.emit.python.fields import Field, given_argument, input_field, parameter_field, value_field
from tmm_gen.emit.python.lines import call, comments, listing, prose, text
from tmm_gen.emit.python.names import Names
from tmm_gen.emit.runs import python_items
from tmm_gen.emit.seal import sealed
from tmm_gen.emit.templates import render
from tmm_gen.program.statements import Program, Repeat, Routine
from tmm_gen.program.variables import Variable
from tmm_gen.scene import Scene

_INDENT = "    "
_RESERVED = (
    *(
        "Any",
        "Model",
        "Output",
        "STATIONS",
        "State",
        "along",
        "carry",
        "dtype",
        "good",
        "here",
        "input",
        "jnp",
    ),
    *("lax", "made", "model", "new", "params", "state"),
)
"""Names that generated functions use beside those of variables."""


def emit_jax(program: Program, scene: Scene) -> dict[str, str]:
    """Write the JAX backend.

    Returns
    -------
    dict from str to str
        ``jax_kernel.py``.

    Raises
    ------
    UserError
        If a loop of the program cannot be written without numbers that stations hand on in arrays.
    """
    body = _Bodies(program, Names(program, _RESERVED))
    steps = [
        {"name": routine.name, "summary": routine.doc, "body": body.step(routine), "stages": len(instants)}
        for routine, instants in zip(program.steps, program.stage_instants, strict=True)
    ]
    rendered = render(
        "jax/kernel.py.jinja",
        header=text(comments(header_lines(program, scene))),
        summary=text(prose(f'"""{program.name}: {program.title.rstrip(".")}.')),
        stations=program.stations,
        step=repr(program.step.default),
        input_names=text(listing("INPUT_NAMES: tuple[str, ...] = ", [f'"{v.name}"' for v in program.inputs])),
        output_names=text(
            listing("OUTPUT_NAMES: tuple[str, ...] = ", [f'"{v.name}"' for v in program.outputs])
        ),
        stage_instants=repr(program.stage_instants),
        arrays=any(isinstance(v.default, tuple) for v in program.parameters),
        parameters=[_parameter(v) for v in program.parameters],
        model=[value_field(v, "") for v in program.model],
        state=[value_field(v, "") for v in program.state],
        inputs=[input_field(v, "") for v in program.inputs],
        outputs=[value_field(v, "") for v in program.outputs],
        given=[given_argument(v, "") for v in program.given],
        prepare=body.prepare(),
        initialise=body.initialise(),
        initialise_summary=program.initialise.doc,
        starts_from_step=program.step in program.initialise.read(),
        startup=steps[:-1],
        main=steps[-1],
        output=body.output(),
        repeats=any(isinstance(s, Repeat) for routine in program.steps for s in routine.statements()),
        several_stages=any(v.length is not None for v in program.inputs),
    )
    return {"jax_kernel.py": sealed(rendered)}


def _parameter(variable: Variable) -> Field:
    """Return a field of the parameters: its default is an array, as derivatives by it are."""
    if not isinstance(variable.default, tuple):
        return parameter_field(variable, "")
    plain = parameter_field(replace(variable, default=0.0), "")
    values = python_items([float(x) for x in variable.default])
    return replace(plain, declaration=text(call(f"{variable.name}: ArrayLike = _stations", values, _INDENT)))


class _Bodies:
    """Writes the bodies of a program's functions: take variables in, compute, give results back."""

    def __init__(self, program: Program, names: Names) -> None:
        self._program, self._names = program, names

    def prepare(self) -> str:
        program = self._program
        bound = (program.step, *program.parameters)
        given = {"": (program.step,), "params.": program.parameters}
        result = self._result("Model", program.model)
        return self._body(program.prepare, result, given=given, known=bound)

    def initialise(self) -> str:
        program, routine = self._program, self._program.initialise
        start = (program.step, *program.given)
        given = {"": start, "params.": program.parameters, "input.": program.inputs}
        absent = [v for v in program.state if v not in routine.written()]
        zeros = [f"{v.name}=jnp.zeros({v.length or '()'}, dtype)" for v in absent]
        count = ["steps_taken=0"] * bool(program.startup)
        state = [v for v in program.state if v not in absent]
        return self._body(routine, self._result("State", state, [*zeros, *count]), given=given)

    def step(self, routine: Routine) -> str:
        program = self._program
        count = ["steps_taken=state.steps_taken + 1"] * bool(program.startup)
        result = self._result("State", program.state, count)
        return self._body(routine, result, given={"input.": program.inputs}, held=True, known=program.state)

    def output(self) -> str:
        results = [f"{v.name}=jnp.asarray({self._names[v]}, dtype)" for v in self._program.outputs]
        return self._body(self._program.output, call("return Output", results, _INDENT), held=True)

    def _body(
        self,
        routine: Routine,
        result: list[str],
        given: Mapping[str, Sequence[Variable]] = MappingProxyType({}),
        held: bool = False,
        known: Sequence[Variable] = (),
    ) -> str:
        """Write what a user gives, what these functions gave back before, the statements and the result."""
        program = self._program
        wanted = routine.read() | {v for v in known if v in (*program.model, *program.state)}
        lines: list[str] = []
        for owner, variables in given.items():
            for v in (v for v in variables if v in wanted):
                items = [f"{owner}{v.name}", str(v.length), "dtype"]
                lines += call(f"{self._names[v]} = _given", items, _INDENT)
        for owner, variables in (("model", program.model), ("state", program.state)) if held else ():
            lines += [f"{_INDENT}{v.name} = {owner}.{v.name}" for v in variables if v in wanted]
        lines += RoutineText(routine, self._names, program.stations).lines(known)
        return text([*lines, "", *result])

    def _result(self, name: str, variables: Sequence[Variable], more: Sequence[str] = ()) -> list[str]:
        fields = [f"{v.name}={v.name}" for v in variables]
        return [
            *call(f"found: {name} = _judged", [name, "good", "dtype", *fields, *more], _INDENT),
            f"{_INDENT}return found",
        ]
