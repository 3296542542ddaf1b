"""A program as a Python module that builds CasADi functions."""

from __future__ import annotations

import re

from tmm_gen.emit.casadi.functions import RESERVED, Functions, flat_names
from tmm_gen.emit.header import header_lines
from tmm_gen.emit.python.lines import comments, listing, prose, text
from tmm_gen.emit.python.names import Names
from tmm_gen.emit.runs import python_items
from tmm_gen.emit.seal import sealed
from tmm_gen.emit.templates import render
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene


def emit_casadi(program: Program, scene: Scene) -> dict[str, str]:
    """Write the CasADi backend.

    Returns
    -------
    dict from str to str
        ``casadi_model.py``.
    """
    functions = Functions(program, Names(program, RESERVED))
    parameters = (program.step, *program.parameters)
    steps = [
        {
            "name": routine.name,
            "summary": routine.doc,
            "body": text(functions.step(routine)),
            "stages": len(instants),
        }
        for routine, instants in zip(program.steps, program.stage_instants, strict=True)
    ]
    several_stages = any(v.length is not None for v in program.inputs)
    held = ", held" if several_stages else ""
    front = symbol(program.name)
    starts = [
        f'_function("{front}_{s["name"]}", _{s["name"]}, STAGE_INSTANTS[{k}]{held})'
        for k, s in enumerate(steps[:-1])
    ]
    rendered = render(
        "casadi/model.py.jinja",
        header=text(comments(header_lines(program, scene))),
        description=text(_description(program)),
        symbol=front,
        stations=program.stations,
        state_names=_names("STATE_NAMES", flat_names(program.state)),
        input_names=_names("INPUT_NAMES", flat_names(program.inputs)),
        output_names=_names("OUTPUT_NAMES", flat_names(program.outputs)),
        parameter_names=_names("PARAMETER_NAMES", flat_names(parameters)),
        stage_instants=repr(program.stage_instants),
        defaults=text(listing("values = ", _defaults(program), "    ")),
        given=[{"name": v.name, "length": v.length, "doc": v.doc, "unit": v.unit} for v in program.given],
        prepare=text(functions.prepare()),
        initialise=text(functions.initialise()),
        initialise_summary=program.initialise.doc,
        startup=steps[:-1],
        main=steps[-1],
        output=text(functions.output()),
        start_functions=text(listing("return ", starts, "    ")),
        several_stages=several_stages,
        sensitivities=None
        if program.sensitivities is None
        else {
            "linearise": text(functions.linearise(program.sensitivities)),
            "tangent": text(functions.tangent(program.sensitivities)),
        },
    )
    return {"casadi_model.py": sealed(rendered)}


def symbol(scene: str) -> str:
    """Return what CasADi's functions have in front, so that those of two models can be in one program of C.

    CasADi takes no name with two underscores in a row.

    Parameters
    ----------
    scene : str
        Name of a scene.
    """
    return re.sub(r"_(?=_|$)", "_0", scene)


def _description(program: Program) -> list[str]:
    return [
        *prose(f'"""{program.name}: {program.title.rstrip(".")}. Functions for optimisation and control.'),
        "",
        *prose(
            "Columns: ``x`` the state (STATE_NAMES), ``u`` the inputs (INPUT_NAMES), ``p`` the step and the "
            "physical parameters (PARAMETER_NAMES), ``y`` the outputs (OUTPUT_NAMES). The same operations in "
            "the same order as in the NumPy kernel; pivots are not checked, since symbols have no sign."
        ),
        '"""',
    ]


def _names(head: str, items: list[str]) -> str:
    return text(listing(f"{head}: tuple[str, ...] = ", items))


def _defaults(program: Program) -> list[str]:
    numbers: list[str] = []
    for variable in (program.step, *program.parameters):
        default = variable.default
        if default is None:
            raise ValueError(f"{variable.name} has no default")
        numbers += python_items([float(x) for x in (default if isinstance(default, tuple) else (default,))])
    return numbers
