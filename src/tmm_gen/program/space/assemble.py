"""From an arm in space and an integrator to the program of a kernel."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import sympy as sp

from tmm_gen.derive.integrators.declaration import CONSISTENT_START, Integrator, Past, Scheme, past
from tmm_gen.program.coupled_motion import first_stages
from tmm_gen.program.fields import gain_names
from tmm_gen.program.finish import NOTHING_PREPARED, START_DOC, Factors, living, prepared, stepped
from tmm_gen.program.motion import history_values
from tmm_gen.program.passes.early import EarlySets, lifted
from tmm_gen.program.passes.hoist import Hoister
from tmm_gen.program.passes.zeros import without_zeros
from tmm_gen.program.sensitivities.differentiated import differentiated
from tmm_gen.program.space.base import BaseStep, earlier, history_sources
from tmm_gen.program.space.base_start import start_of_base, unit_start
from tmm_gen.program.space.bodies import Bodies
from tmm_gen.program.space.collocation import SpaceCollocation
from tmm_gen.program.space.collocation_vectors import VectorCollocation, in_vectors
from tmm_gen.program.space.layout import SpaceLayout, instants, layout_of, moves_as_given
from tmm_gen.program.space.outputs import output_routine
from tmm_gen.program.space.step import SpaceStep
from tmm_gen.program.statements import Assign, Program, Routine, Section, Vectors
from tmm_gen.program.variables import Role
from tmm_gen.scene.spatial.arm import SpatialArm


@dataclass(frozen=True)
class SpaceChoices:
    """How an arm in space is solved.

    Parameters
    ----------
    step : float
        The scene's time step, s.
    iterations : int
        One sweep and so many less one corrections per stage.
    held : bool
        Whether stages are predicted with the newest acceleration; otherwise with none.
    auto : bool
        Whether corrections go on until one changes next to nothing.
    exact : bool
        Whether all sweeps are Newton's own.
    sensitivities : bool
        Whether the step's tangent is wanted; not of one that corrects until that changes next to nothing.
    vectors : bool
        Whether the step is wanted in vectors too, where the integrator's stages are solved at once.
    single : bool
        Whether the arm's numbers are of single precision: turns then spare no operations that cost digits.
    facts : tuple of (str, str)
        For headers.
    """

    step: float
    iterations: int = 2
    held: bool = False
    auto: bool = False
    exact: bool = False
    sensitivities: bool = False
    vectors: bool = False
    single: bool = False
    facts: tuple[tuple[str, str], ...] = ()


def predicts_held(stages: int, rounds: int, *, auto: bool = False) -> bool:
    """Return whether stages are best predicted with the newest acceleration instead of none.

    A prediction without acceleration forgives long steps, and a correction makes up for it; more stages, or a sweep
    alone, would lose orders.

    Parameters
    ----------
    stages : int
        Of the integrator's step.
    rounds : int
        A sweep and its corrections.
    auto : bool
        Whether corrections go on until one changes next to nothing.
    """
    return stages > 1 or not (auto or rounds > 1)


def build_in_space(
    arm: SpatialArm, name: str, title: str, integrator: Integrator, choices: SpaceChoices
) -> Program:
    """Build the program of an arm in space.

    Parameters
    ----------
    arm : SpatialArm
        What is modelled.
    name, title : str
        Of the scene.
    integrator : Integrator
        With its parameters bound to numbers.
    choices : SpaceChoices
        How it is solved.
    """
    layout = replace(layout_of(arm, name, title, integrator, choices.step), single=choices.single)
    return _Assembly(layout, integrator, choices).program()


def _without_zeros(program: Program) -> Program:
    """Return a program whose steps and start do without what is always zero."""
    return replace(
        program,
        startup=tuple(without_zeros(routine) for routine in program.startup),
        main=without_zeros(program.main),
        initialise=without_zeros(program.initialise),
        output=without_zeros(program.output),
    )


def _whole(sections: list[Section], _then: Section) -> list[Section]:
    """Return the sections of a sweep as they are."""
    return sections


class _Assembly:
    """Gathers the routines of the program."""

    def __init__(self, layout: SpaceLayout, integrator: Integrator, choices: SpaceChoices) -> None:
        self.layout, self.integrator, self.choices = layout, integrator, choices
        self.bodies = Bodies(layout, Role.COEFFICIENT)
        self.early = EarlySets()
        self.hoister = Hoister(names=gain_names(integrator, "acceleration", layout.step))

    def program(self) -> Program:
        """Build the program."""
        layout, base = self.layout, self.layout.base
        main, startup = stepped(self.integrator, self.hoister, self._step)
        output = self.hoister.hoist(output_routine(layout, self.bodies))
        factors = Factors(
            self.bodies.section, tuple(self.bodies.variables.values()), self.early, self.hoister
        )
        whole = Program(
            name=layout.name,
            title=layout.title,
            stations=layout.stations,
            step=layout.step,
            parameters=(*layout.parameters.values(), *(base.parameters.values() if base else ())),
            coefficients=factors.coefficients,
            state=(
                *layout.moving,
                *(base.state if base else ()),
                *layout.held.values(),
            ),
            inputs=layout.inputs,
            outputs=layout.outputs,
            given=layout.given,
            prepare=NOTHING_PREPARED,
            initialise=factors.unlike(self._initialise()),
            startup=startup,
            main=main,
            output=output,
            stage_instants=tuple(instants(scheme, given=self._given) for scheme in self.integrator.schemes),
            facts=dict(self.choices.facts),
        )
        # between steps a base's place follows from its velocity, and pictures show it
        moved = frozenset(
            v.name for v in layout.held.values() if v.name.startswith(("base_place", "base_velocity"))
        )
        always = base.always if base else moved
        alive = living(_without_zeros(whole), auto=self.choices.auto, always=always)
        if self.choices.sensitivities:
            alive = replace(alive, sensitivities=differentiated(alive, self.hoister))
        if self.choices.vectors and self.integrator.main.coupled:
            alive = replace(alive, vectors=self._in_vectors(alive))
        return prepared(alive, factors)

    @property
    def _given(self) -> bool:
        """Whether inputs say how anything moves."""
        return moves_as_given(self.layout.arm)

    def _step(self, scheme: Scheme) -> tuple[Section, ...]:
        """Return the sections of a scheme's step."""
        layout = self.layout
        step = self._coupled(scheme) if scheme.coupled else self._stepped(scheme)
        before = earlier(layout.base) if layout.base else []
        known = (Section("where the base was before", tuple(before)),) if before else ()
        return (*known, *step.sections(), *self._hold(len(instants(scheme, given=self._given))))

    def _coupled(self, scheme: Scheme) -> SpaceCollocation:
        """Return what builds a step whose stages are solved at once."""
        rounds, auto = self.choices.iterations, self.choices.auto
        return SpaceCollocation(self.layout, self.bodies, scheme, rounds, auto, self._split)

    def _in_vectors(self, program: Program) -> Vectors:
        """Return the step in vectors, which takes all it needs of parameters and bodies by itself."""
        scheme, rounds, auto = self.integrator.main, self.choices.iterations, self.choices.auto
        step = VectorCollocation(self.layout, self.bodies, scheme, rounds, auto, _whole)
        return in_vectors(program, step, self._hold(len(instants(scheme, given=self._given))))

    def _stepped(self, scheme: Scheme) -> SpaceStep:
        """Return what builds a step whose stages are solved one after another."""
        layout = self.layout
        return SpaceStep(
            layout,
            self.bodies,
            scheme,
            history_values(layout.state, lambda v: v.at()),
            iterations=self.choices.iterations,
            held=self.choices.held,
            auto=self.choices.auto,
            exact=self.choices.exact,
            split=self._split,
            base=self._base(scheme),
        )

    @property
    def _split(self) -> Callable[[list[Section], Section], list[Section]]:
        # what a given joint does not set of an array would be left open in the model
        return _whole if self._given else self.early.split

    def _base(self, scheme: Scheme) -> BaseStep | None:
        base = self.layout.base
        if base is None:
            return None
        return BaseStep(base, self.layout.step, scheme, history_sources(base), base.start)

    def _hold(self, stages: int) -> tuple[Section, ...]:
        """Remember inputs for outputs that need them."""
        assigns = tuple(
            Assign(variable.ref, self.layout.input(name, stages - 1))
            for name, variable in self.layout.held.items()
        )
        return (Section("inputs as they last acted", assigns),) if assigns else ()

    def _held_first(self) -> tuple[Section, ...]:
        """Let the first step be predicted by the acceleration at the start."""
        layout, base = self.layout, self.layout.base
        kept = list(first_stages(layout.stages, layout.state[Past("a", 0)]))
        if base:
            for stages, history in ((base.place_stages, base.place), (base.alpha_stages, base.alpha)):
                for component, found in stages.items():
                    kept += first_stages(found, history[component][Past("a", 0)])
        return (Section("the first step is predicted by this acceleration", tuple(kept)),) if kept else ()

    def _initialise(self) -> Routine:
        """Build the start: given motion, and the acceleration that satisfies the equations of motion."""
        layout = self.layout
        bodies = Bodies(layout, Role.WORK)
        angle, rate = layout.given[:2]
        newest = replace(layout, state={p: v for p, v in layout.state.items() if p.lag == 0})
        step = SpaceStep(
            newest,
            bodies,
            CONSISTENT_START,
            {past("q"): angle.at(), past("v"): rate.at(), past("a"): sp.Integer(0)},
            base=start_of_base(layout.base, layout.step) if layout.base else None,
        )
        before = unit_start(layout.base) if layout.base else []
        given = (Section("where the base starts", tuple(before)),) if before else ()
        swept = lifted(list(step.sections()), ask=True)
        sections = (bodies.section, *given, *swept, *self._held_first(), *self._hold(1))
        return Routine("initialise", START_DOC, tuple(s for s in sections if s.statements))
