"""A program as a Python module that needs NumPy alone."""

from __future__ import annotations

from tmm_gen.emit.header import header_lines
from tmm_gen.emit.numpy.batch import BATCH_EXPORTS, emit_batch_module, has_batch
from tmm_gen.emit.numpy.functions import RESERVED, Functions
from tmm_gen.emit.python.fields import given_argument, input_field, parameter_field, value_field
from tmm_gen.emit.python.lines import comments, listing, prose, text
from tmm_gen.emit.python.names import Names
from tmm_gen.emit.seal import sealed
from tmm_gen.emit.templates import render
from tmm_gen.program.inputs import prescribed_names
from tmm_gen.program.statements import Loop, Program, Require, Routine
from tmm_gen.program.variables import Variable
from tmm_gen.scene import Scene

EXPORTS = (
    *("INPUT_NAMES", "OUTPUT_NAMES", "STAGE_INSTANTS", "STATIONS", "STEP"),
    *("Input", "Model", "Output", "Params", "Result", "State", "VanishingPivotError"),
    *("initialise", "output", "prepare", "simulate", "step"),
)
"""What the package shows, in the order in which imports are sorted."""


def emit_numpy(program: Program, scene: Scene) -> dict[str, str]:
    """Write the NumPy backend.

    Returns
    -------
    dict from str to str
        Text by path inside the package: ``kernel.py``, an ``__init__.py`` that shows its names, and ``batch.py``
        where C code for many arms stands beside them.
    """
    header = header_lines(program, scene)
    exports = [name for name in EXPORTS if name != "VanishingPivotError" or _requires(program)]
    init = render(
        "numpy/init.py.jinja",
        header=text(comments(header[:5])),
        description=text(prose(f'"""{_summary(program)}"""')),
        modules={**({"batch": BATCH_EXPORTS} if has_batch(scene) else {}), "kernel": exports},
        exports=exports + (list(BATCH_EXPORTS) if has_batch(scene) else []),
    )
    files = {"__init__.py": sealed(init), "kernel.py": sealed(_kernel(program, header))}
    return files | ({"batch.py": emit_batch_module(program, scene, header)} if has_batch(scene) else {})


def _kernel(program: Program, header: list[str]) -> str:
    functions = Functions(program, Names(program, RESERVED))
    stages = [len(instants) for instants in program.stage_instants]
    steps = [
        {
            "name": routine.name if routine is not program.main else "step_main",
            "summary": routine.doc,
            "body": text(functions.step(routine, count)),
        }
        for routine, count in zip(program.steps, stages, strict=True)
    ]
    reads_step = program.step in program.initialise.read()
    start = ["params", "read(0.0)", *(f"{v.name}={v.name}" for v in program.given)]
    if reads_step:
        start.append("step=step")
    return render(
        "numpy/kernel.py.jinja",
        header=text(comments(header)),
        description=text(_description(program)),
        stations=program.stations,
        step=repr(program.step.default),
        input_names=_names("INPUT_NAMES", program.inputs),
        output_names=_names("OUTPUT_NAMES", program.outputs),
        stage_instants=repr(program.stage_instants),
        parameters=[parameter_field(v) for v in program.parameters],
        model=[value_field(v) for v in program.model],
        state=[value_field(v) for v in program.state],
        inputs=[input_field(v) for v in program.inputs],
        outputs=[value_field(v) for v in program.outputs],
        given=[given_argument(v) for v in program.given],
        prepare=text(functions.prepare()),
        initialise=text(functions.initialise()),
        initialise_summary=program.initialise.doc,
        initialise_reads_step=reads_step,
        startup=steps[:-1],
        steps=steps,
        output=text(functions.output()),
        simulate_start=", ".join(start),
        several_stages=functions.several_stages,
        prescribed=prescribed_names(program.inputs),
        requires=_requires(program),
        initialise_requires=_has_require(program.initialise),
        step_requires=any(_has_require(routine) for routine in program.steps),
    )


def _description(program: Program) -> list[str]:
    return [
        *prose(f'"""{_summary(program)}'),
        "",
        *prose(
            "A state goes in, a new one comes out: ``model = prepare(params, step)``, "
            "``state = initialise(params, input)``, ``state = step(model, state, input)``, "
            "``y = output(model, state)``; or ``simulate(duration, inputs)`` for all of them. Arrays are "
            "never written in place."
        ),
        "",
        *prose(
            "All arrays may have further axes behind, those of a batch: many arms at once, each with its own "
            "parameters, inputs and state. What is one number for an arm then has the batch's shape; what "
            "differs between stations has the stations first, base to tip. An arm "
            "with numbers that are not finite, or a step or pivot that is not positive, is NaN; errors are left "
            "for where no other arm is left."
        ),
        '"""',
    ]


def _summary(program: Program) -> str:
    return f"{program.name}: {program.title.rstrip('.')}."


def _names(head: str, variables: tuple[Variable, ...]) -> str:
    return text(listing(f"{head}: tuple[str, ...] = ", [f'"{v.name}"' for v in variables]))


def _requires(program: Program) -> bool:
    return any(_has_require(r) for r in (program.prepare, program.initialise, *program.steps, program.output))


def _has_require(routine: Routine) -> bool:
    return any(
        isinstance(inner, Require)
        for statement in routine.statements()
        for inner in (statement.body if isinstance(statement, Loop) else (statement,))
    )
