"""From a row and an integrator to the program of a kernel."""

from __future__ import annotations

from dataclasses import dataclass, replace

import sympy as sp

from tmm_gen.derive.integrators.declaration import CONSISTENT_START, KINDS, Integrator, Past, Scheme, past
from tmm_gen.derive.integrators.relations import Unknown
from tmm_gen.program.arm.auto import AutoStep
from tmm_gen.program.arm.collocation import CollocationStep
from tmm_gen.program.arm.combinations import Combinations
from tmm_gen.program.arm.heat import heat_after, heat_before
from tmm_gen.program.arm.layout import Layout, layout_of
from tmm_gen.program.arm.predicted_collocation import PredictedCollocationStep
from tmm_gen.program.arm.readings import output_routine
from tmm_gen.program.arm.step import MakeWalks, StepBuilder
from tmm_gen.program.arm.thesis import start_places
from tmm_gen.program.arm.turns import TURNED, start_unturned, take_turns_out
from tmm_gen.program.arm.walks import Walks
from tmm_gen.program.coupled_motion import first_stages
from tmm_gen.program.fields import gain_names
from tmm_gen.program.finish import NOTHING_PREPARED, START_DOC, Factors, living, prepared, stepped
from tmm_gen.program.inputs import input_instants
from tmm_gen.program.motion import history_values
from tmm_gen.program.passes.early import EarlySets, lifted
from tmm_gen.program.passes.hoist import Hoister
from tmm_gen.program.sensitivities.step import step_sensitivities
from tmm_gen.program.sensitivities.twins import linear_sensitivities
from tmm_gen.program.statements import (
    Assign,
    Program,
    Routine,
    Section,
    Sensitivities,
    Statement,
)
from tmm_gen.program.variables import Role
from tmm_gen.row.row import Row


@dataclass(frozen=True)
class Choices:
    """How a row is solved.

    Parameters
    ----------
    step : float
        The scene's time step, s.
    unknown : str
        What sweeps solve for.
    iterations : int
        Sweeps per stage.
    first_iterations : int, optional
        Iterations of the first step where stages are coupled, if these are others than of all that follow.
    corrections : int
        Behind the sweeps of each stage, with the factors of the last.
    walks : callable
        Makes the walks of a sweep.
    places : bool
        Whether the nodes' places are integrated on their own.
    turns_apart : bool
        Whether the turns of a base that turns on and on are kept apart from angles.
    auto : bool
        Whether each stage sweeps until that changes next to nothing, instead of so many times.
    sensitivities : bool
        Whether the step's derivatives are built too.
    """

    step: float
    unknown: Unknown = "acceleration"
    iterations: int = 1
    first_iterations: int | None = None
    corrections: int = 0
    walks: MakeWalks = Walks
    places: bool = False
    turns_apart: bool = False
    auto: bool = False
    sensitivities: bool = False


def build(row: Row, integrator: Integrator, choices: Choices) -> Program:
    """Build the program of a row.

    Parameters
    ----------
    row : Row
        The arm.
    integrator : Integrator
        With its parameters bound to numbers.
    choices : Choices
        How it is solved.
    """
    return _Assembly(row, integrator, choices).program()


class _Assembly:
    """Gathers the routines of a row's program; see :func:`build`."""

    def __init__(self, row: Row, integrator: Integrator, choices: Choices) -> None:
        self.row, self.integrator, self.choices = row, integrator, choices
        self.layout = layout_of(row, integrator, choices.step, choices.unknown, places=choices.places)
        self.combinations = Combinations(self.layout, Role.COEFFICIENT)
        self.early = EarlySets()
        self.hoister = Hoister(names=gain_names(integrator, choices.unknown, self.layout.step))

    def program(self) -> Program:
        """Build the program."""
        layout = self.layout
        main, startup = stepped(self.integrator, self.hoister, self._step)
        instants = tuple(input_instants(self.row, scheme) for scheme in self.integrator.schemes)
        if self.choices.first_iterations is not None:
            startup, instants = (self.hoister.hoist(self._first_step()),), (*instants, instants[-1])
        turned = TURNED if self.choices.turns_apart else None
        output = self.hoister.hoist(output_routine(layout, turned))
        combined = tuple(self.combinations.variables.values())
        factors = Factors(self.combinations.section, combined, self.early, self.hoister)
        initialise = factors.unlike(self._initialise())
        if turned is not None:
            main, *others = take_turns_out((main, *startup), layout)
            startup = tuple(others)
            initialise = start_unturned(initialise)
        whole = Program(
            name=self.row.name,
            title=self.row.title,
            stations=layout.stations,
            step=layout.step,
            parameters=tuple(layout.parameters.values()),
            coefficients=factors.coefficients,
            state=(*((turned,) if turned is not None else ()), *layout.all_state),
            inputs=layout.inputs,
            outputs=layout.outputs,
            given=layout.given,
            prepare=NOTHING_PREPARED,
            initialise=initialise,
            startup=startup,
            main=main,
            output=output,
            stage_instants=instants,
            facts=self._facts(),
        )
        alive = living(whole, auto=self.choices.auto)
        return prepared(replace(alive, sensitivities=self._sensitivities(alive)), factors)

    def _first_step(self) -> Routine:
        """Return a first step of coupled stages, which no last step's polynomial leads into."""
        iterations = self.choices.first_iterations
        assert iterations is not None
        scheme = self.integrator.main
        sections = self._around(self._coupled(scheme, iterations).sections(), scheme)
        return Routine("step_start1", "Start-up: take step 1.", sections)

    def _step(self, scheme: Scheme) -> tuple[Section, ...]:
        """Return the sections of a scheme's step."""
        iterations = self.choices.iterations
        builder = self._coupled(scheme, iterations) if scheme.coupled else self._builder(scheme)
        if scheme is self.integrator.main and isinstance(builder, StepBuilder):
            self._main_builder = builder
        return self._around(builder.sections(), scheme)

    def _around(self, sections: tuple[Section, ...], scheme: Scheme) -> tuple[Section, ...]:
        """Return a step with what it counts and holds besides motion."""
        return (
            *heat_before(self.layout),
            *sections,
            *hold(self.layout, len(scheme.stages)),
            *heat_after(self.layout),
        )

    def _builder(self, scheme: Scheme) -> StepBuilder:
        """Return what builds a step whose stages are solved one after another."""
        layout = self.layout
        return (AutoStep if self.choices.auto else StepBuilder)(
            layout=layout,
            prepared=self.combinations.variables,
            scheme=scheme,
            unknown=self.choices.unknown,
            sources=history_values(layout.state, lambda v: v.at()),
            hub_sources=history_values(layout.hub, lambda v: v.ref),
            base_sources={
                axis: history_values(kept, lambda v: v.ref) for axis, kept in layout.floating.items()
            },
            iterations=self.choices.iterations,
            corrections=self.choices.corrections,
            split=self.early.split,
            walks=self.choices.walks,
        )

    def _coupled(self, scheme: Scheme, iterations: int) -> CollocationStep:
        """Return what builds a step whose stages are solved at once."""
        known = self.row.about == "known"
        return (CollocationStep if known else PredictedCollocationStep)(
            layout=self.layout,
            prepared=self.combinations.variables,
            scheme=scheme,
            iterations=iterations,
            auto=self.choices.auto,
            split=self.early.split,
        )

    def _facts(self) -> dict[str, str]:
        facts = dict(self.row.facts)
        if self.choices.auto:
            facts["linearisation"] = "newton, as many iterations as it takes"
        return facts

    def _sensitivities(self, program: Program) -> Sensitivities | None:
        if not self.choices.sensitivities:
            return None
        if self.row.about == "known":
            return linear_sensitivities(program.main, program.state, self.layout.inputs)
        held = hold(self.layout, len(self.integrator.main.stages))
        return step_sensitivities(self._main_builder, held, program.state, self.layout.inputs, self.hoister)

    def _initialise(self) -> Routine:
        """Build the start: given motion, consistent acceleration, an older history that nothing reads yet."""
        layout = self.layout
        combined = Combinations(layout, Role.WORK)
        angle, rate = layout.given
        still = {past(kind): sp.Integer(0) for kind in KINDS}
        builder = StepBuilder(
            layout=replace(
                layout,
                state={p: v for p, v in layout.state.items() if p.lag == 0},
                hub={p: v for p, v in layout.hub.items() if p.lag == 0},
                floating={
                    axis: {p: v for p, v in kept.items() if p.lag == 0}
                    for axis, kept in layout.floating.items()
                },
            ),
            prepared=combined.variables,
            scheme=CONSISTENT_START,
            unknown="acceleration",
            sources={past("q"): angle.at(), past("v"): rate.at(), past("a"): sp.Integer(0)},
            hub_sources=still,
            base_sources=dict.fromkeys(layout.floating, still),
        )
        of_base = (layout.hub, *layout.floating.values())
        older = tuple(Assign(v.ref, sp.Integer(0)) for kept in of_base for p, v in kept.items() if p.lag)
        cold = (Assign(layout.dissipated.ref, sp.Integer(0)),) if layout.dissipated else ()
        sections = (
            combined.section,
            *lifted(list(builder.sections()), ask=self.row.about == "prediction"),
            *((start_places(layout),) if layout.places else ()),
            Section(f"older history of the {'base' if self.row.floats else 'hub'}", older),
            *self._first_stages(),
            *hold(layout, 1),
            Section("nothing has turned to heat yet", cold),
        )
        return Routine("initialise", START_DOC, tuple(s for s in sections if s.statements))

    def _first_stages(self) -> tuple[Section, ...]:
        """Let the first step be predicted by the acceleration at the start."""
        layout = self.layout
        kept: list[Statement] = []
        of_base = [(layout.floating_stages[axis], history) for axis, history in layout.floating.items()]
        for stages, history in (
            (layout.hub_stages, layout.hub),
            *of_base,
            (layout.stages, layout.state),
        ):
            if not stages:
                continue
            kept += first_stages(stages, history[Past("a", 0)])
        return (Section("the first step is predicted by this acceleration", tuple(kept)),) if kept else ()


def hold(layout: Layout, stages: int) -> tuple[Section, ...]:
    """Remember inputs for outputs that need them."""
    by_name = {v.name: v for v in layout.inputs}
    assigns = tuple(Assign(v.ref, by_name[name].entry(stages - 1)) for name, v in layout.held.items())
    return (Section("forces as they last acted", assigns),) if assigns else ()
