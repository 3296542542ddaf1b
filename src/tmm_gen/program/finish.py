"""From the routines of a kernel to its program: what nothing reads falls away, prepare computes what is kept.

Every kind of model ends here: it builds sections of steps, an output and a start, and says what combinations of
parameters these need.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from tmm_gen.derive.integrators.declaration import Integrator, Scheme
from tmm_gen.program.fields import living_state
from tmm_gen.program.passes.early import EarlySets
from tmm_gen.program.passes.hoist import Hoister
from tmm_gen.program.passes.prune import prune
from tmm_gen.program.passes.rewrite import renamed_scratch
from tmm_gen.program.statements import Program, Routine, Section
from tmm_gen.program.sweeps import LEAST_TURN, SWEEPS, none_taken
from tmm_gen.program.variables import Role, Variable

NOTHING_PREPARED = Routine("prepare", "Compute what depends on parameters and step alone.", ())
"""What a program's prepare is until :func:`prepared` fills it."""

START_DOC = "Start from given angles and rates with the acceleration that satisfies the equations of motion."


@dataclass(frozen=True)
class Factors:
    """What prepare computes and the model keeps.

    Parameters
    ----------
    combined : Section
        Combinations of parameters.
    variables : tuple of Variable
        Those that it sets.
    early : EarlySets
        What has left sweeps.
    hoister : Hoister
        Single factors.
    """

    combined: Section
    variables: tuple[Variable, ...]
    early: EarlySets
    hoister: Hoister

    @property
    def coefficients(self) -> tuple[Variable, ...]:
        """All of it, in the order in which the model has it."""
        return (*self.hoister.coefficients, *self.variables, *self.early.coefficients)

    @property
    def sections(self) -> tuple[Section, ...]:
        """Statements of prepare."""
        return (self.combined, *self.early.sections, self.hoister.section())

    def unlike(self, initialise: Routine) -> Routine:
        """Call scratch of a start otherwise than what prepare keeps: bound parameters make constants of that."""
        return renamed_scratch(initialise, {v.name: f"start_{v.name}" for v in self.coefficients})


def stepped(
    integrator: Integrator, hoister: Hoister, sections: Callable[[Scheme], tuple[Section, ...]]
) -> tuple[Routine, tuple[Routine, ...]]:
    """Return the step, and those of the start-up.

    Parameters
    ----------
    sections : callable
        Builds a scheme's step.
    """
    routines: dict[str, Routine] = {}
    # the main scheme first: its factors get the plain names
    for position, scheme in sorted(
        enumerate(integrator.schemes), key=lambda item: item[1] is not integrator.main
    ):
        main = scheme is integrator.main
        name = "step" if main else f"step_start{position + 1}"
        doc = "Advance the state by one step." if main else f"Start-up: take step {position + 1}."
        routines[name] = hoister.hoist(Routine(name, doc, sections(scheme)))
    return routines.pop("step"), tuple(routines[f"step_start{k + 1}"] for k in range(len(integrator.startup)))


def living(program: Program, *, auto: bool, always: frozenset[str] = frozenset()) -> Program:
    """Return a program without state that no output depends on, and without what is computed for nothing else.

    Parameters
    ----------
    auto : bool
        Whether each stage sweeps until that changes next to nothing; its sweeps are counted then.
    always : frozenset of str
        Names of state that stays whatever reads it.
    """
    kept = program.state
    state, steps = living_state(kept, program.steps, program.output, always)
    initialise = program.initialise
    if auto:
        state, initialise = (*state, SWEEPS), none_taken(initialise)
        program = replace(program, parameters=(*program.parameters, LEAST_TURN))
    wanted = frozenset(state)
    if auto:
        steps = tuple(prune(routine, wanted) for routine in program.steps)
    *startup, main = steps
    return replace(
        program,
        state=state,
        startup=tuple(startup),
        main=main,
        initialise=prune(_without(initialise, kept, wanted), wanted),
    )


def _without(initialise: Routine, kept: tuple[Variable, ...], wanted: frozenset[Variable]) -> Routine:
    """Return the start with scratch in place of state that is not kept, but read there."""
    names = {v.name: f"first_{v.name}" for v in kept if v not in wanted and v in initialise.read()}
    return renamed_scratch(initialise, names, roles=(Role.STATE,)) if names else initialise


def prepared(program: Program, factors: Factors) -> Program:
    """Return a program whose prepare computes what the others read, and nothing else."""
    derivatives = program.sensitivities
    later = (*program.steps, program.output)
    if derivatives is not None:
        later += (derivatives.linearise, derivatives.tangent)
    if program.vectors is not None:
        later += (program.vectors.step,)
    used = frozenset().union(*(routine.read() for routine in later))
    prepare = prune(replace(program.prepare, sections=factors.sections), used)
    read = prepare.read() | used | program.initialise.read()
    return replace(
        program,
        prepare=prepare,
        parameters=tuple(p for p in program.parameters if p in read),
        coefficients=tuple(c for c in factors.coefficients if c in used),
    )
