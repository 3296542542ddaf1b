"""From a planar arm's scene and integrator to its program."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import sympy as sp

from tmm_gen.derive import planar_chain as chain
from tmm_gen.derive import torsion_chain
from tmm_gen.derive.elements import planar as element
from tmm_gen.derive.integrators.declaration import (
    CONSISTENT_START,
    KINDS,
    STEP,
    Integrator,
    Scheme,
    past,
)
from tmm_gen.derive.integrators.relations import Unknown, affine_motion
from tmm_gen.errors import UserError
from tmm_gen.program.fields import gain_names, living_state
from tmm_gen.program.inputs import input_instants
from tmm_gen.program.passes.hoist import Hoister
from tmm_gen.program.passes.prune import prune
from tmm_gen.program.planar.auto_step import LEAST_TURN, SWEEPS, AutoStep
from tmm_gen.program.planar.energy import heat_after, heat_before
from tmm_gen.program.planar.layout import PlanarLayout, planar_layout
from tmm_gen.program.planar.loads import planar_loads
from tmm_gen.program.planar.output import output_routine
from tmm_gen.program.planar.step import PlanarStep, planar_history
from tmm_gen.program.planar.thesis_step import ThesisStep, start_places
from tmm_gen.program.sensitivities.planar_step import TangentableStep
from tmm_gen.program.sensitivities.planar_tangent import planar_sensitivities
from tmm_gen.program.sensitivities.refusals import require_derivatives
from tmm_gen.program.statements import Assign, Loop, Order, Program, Routine, Section
from tmm_gen.program.variables import Ref, Role, Variable, refs_in
from tmm_gen.scene import Scene


def build_planar(scene: Scene, integrator: Integrator, *, auto: bool = False) -> Program:
    """Build the program of a planar arm (linearisation "newton").

    Parameters
    ----------
    scene : Scene
        Of kind "planar".
    integrator : Integrator
        Its integrator.
    auto : bool
        Whether each stage sweeps until that changes next to nothing, instead of as often as the scene says; without
        sensitivities.

    Raises
    ------
    UnsuitableUnknownError
        If the integrator cannot be solved for the scene's unknown.
    """
    if scene.model.linearisation != "newton":
        _require_one_implicit_stage(scene, integrator)
    layout = planar_layout(scene, integrator)
    derived = scene.emit.sensitivities and not auto
    if derived:
        require_derivatives(scene, integrator, layout)
    unknown: Unknown = scene.model.unknown
    combined = _Combinations(layout)
    hoister = Hoister(names=gain_names(integrator, unknown, layout.step))
    sources, hub_sources = planar_history(layout)
    step_of = AutoStep if auto else TangentableStep if derived else _STEPS[scene.model.linearisation]
    routines: dict[str, Routine] = {}
    # the main scheme first: its factors get the plain names
    for position, scheme in sorted(
        enumerate(integrator.schemes), key=lambda item: item[1] is not integrator.main
    ):
        name = "step" if scheme is integrator.main else f"step_start{position + 1}"
        builder = step_of(
            layout=layout,
            shared=combined.shared,
            impedances=tuple(combined.impedance(scheme, i, unknown) for i in range(len(scheme.stages))),
            loads=tuple(
                planar_loads(scene, layout.inputs, k) for k in range(len(input_instants(scene, scheme)))
            ),
            base=scene.base.kind,
            scheme=scheme,
            unknown=unknown,
            sources=sources,
            hub_sources=hub_sources,
            iterations=scene.model.sweeps,
        )
        doc = "Advance the state by one step." if name == "step" else f"Start-up: take step {position + 1}."
        sections = (
            *heat_before(layout),
            *builder.sections(),
            *_hold(layout, len(scheme.stages)),
            *heat_after(layout),
        )
        routines[name] = hoister.hoist(Routine(name, doc, sections))
        if scheme is integrator.main:
            main_builder = builder
    main = routines.pop("step")
    startup = tuple(routines[f"step_start{k + 1}"] for k in range(len(integrator.startup)))
    output = hoister.hoist(output_routine(scene, layout))
    initialise = _initialise(scene, layout)
    state = living_state(layout.all_state, (*startup, main), output)
    if auto:
        state = (*state, SWEEPS)
        initialise = replace(initialise, sections=(*initialise.sections, _none_swept()))
    wanted = frozenset(state)
    startup = tuple(prune(r, wanted) for r in startup)
    main, initialise = prune(main, wanted), prune(initialise, wanted)
    sensitivities = None
    if isinstance(main_builder, TangentableStep):
        held = _hold(layout, len(integrator.main.stages))
        sensitivities = planar_sensitivities(main_builder, held, state, layout.inputs, hoister)
    derivatives = (sensitivities.linearise, sensitivities.tangent) if sensitivities else ()
    used = frozenset().union(*(r.read() for r in (*startup, main, output, *derivatives)))
    prepare = prune(
        Routine(
            "prepare",
            "Compute what depends on parameters and step alone.",
            (*combined.sections, hoister.section()),
        ),
        used,
    )
    coefficients = (*hoister.coefficients, *combined.coefficients)
    read = prepare.read() | used | initialise.read()
    iterations = f", {scene.model.sweeps} iterations" if scene.model.sweeps > 1 else ""
    if auto:
        iterations = ", as many iterations as it takes"
    return Program(
        name=scene.name,
        title=scene.title,
        stations=scene.stations,
        step=layout.step,
        parameters=tuple(p for p in (*layout.parameters, LEAST_TURN) if p in read),
        coefficients=tuple(c for c in coefficients if c in used),
        state=state,
        inputs=layout.inputs,
        outputs=layout.outputs,
        given=layout.given,
        prepare=prepare,
        initialise=initialise,
        startup=startup,
        main=main,
        output=output,
        stage_instants=tuple(input_instants(scene, scheme) for scheme in integrator.schemes),
        facts={
            "model": "planar arm, large rotations"
            + (", gravity" if layout.gravity else "")
            + (", tip mass" if layout.tip_mass else ""),
            "stations": str(scene.stations),
            "base": scene.base.kind,
            "integrator": integrator.title
            + "".join(f", {k} = {float(v):g}" for k, v in integrator.parameters.items()),
            "linearisation": scene.model.linearisation + iterations,
            "sweep": scene.model.sweep,
            "unknown": scene.model.unknown,
        },
        sensitivities=sensitivities,
    )


def _none_swept() -> Section:
    return Section("no sweep has been taken yet", (Assign(SWEEPS.ref, sp.Integer(0)),))


def _require_one_implicit_stage(scene: Scene, integrator: Integrator) -> None:
    """Refuse integrators that the thesis's step, which derives accelerations from places, has no form for."""
    explicit = any(affine_motion(scheme, 1, "acceleration").gain["q"] == 0 for scheme in integrator.schemes)
    if explicit or any(len(scheme.stages) > 1 for scheme in integrator.schemes):
        raise UserError(
            f"scene '{scene.name}': model.linearisation = '{scene.model.linearisation}' integrates places in one "
            f"implicit stage, which '{integrator.name}' does not have; use linearisation = 'newton', or an "
            "integrator such as 'newmark'"
        )


_STEPS: dict[str, Callable[..., PlanarStep]] = {
    "newton": PlanarStep,
    "taylor": partial(ThesisStep, follows=True),
    "frozen": partial(ThesisStep, follows=False),
}


class _Combinations:
    """Combinations of parameters that every step needs, computed by prepare where they take any arithmetic."""

    def __init__(self, layout: PlanarLayout) -> None:
        self._layout = layout
        self._assigns: dict[Variable, sp.Expr] = {}
        self._impedances: dict[sp.Expr, sp.Expr] = {}
        law = chain.link_law()
        self._symbols = {
            element.LENGTH: layout.length.at(),
            element.MASS: layout.mass.at(),
            element.INERTIA: layout.inertia.at(),
            element.CENTER: layout.center.at(),
            element.STIFFNESS: layout.stiffness.at(),
            element.DAMPING: layout.damping.at() if layout.damping else sp.Integer(0),
            STEP: layout.step.ref,
        }
        carried = self._keep("carried_mass", law.carried_mass, "mass acting at a link's outer end", "kg")
        inner = self._keep(
            "inner_mass", element.MASS - law.carried_mass, "mass acting at a link's inner end", "kg"
        )
        pin = self._keep("pin_inertia", law.pin_inertia, "inertia of a link about its inner end", "kg m^2")
        self.shared: dict[sp.Symbol, sp.Expr] = {
            chain.CARRIED_MASS: carried,
            element.MASS - chain.CARRIED_MASS: inner,
            chain.PIN_INERTIA: pin,
        }

    def impedance(self, scheme: Scheme, index: int, unknown: Unknown) -> sp.Expr:
        """Return the joint impedance of a stage; stages with equal gains share it."""
        motion = affine_motion(scheme, index + 1, unknown)
        gains = {torsion_chain.GAINS[k]: motion.gain[k] for k in KINDS}
        law = chain.joint_sweep().impedance.subs(gains)
        if law not in self._impedances:
            suffix = f"_{len(self._impedances) + 1}" if self._impedances else ""
            self._impedances[law] = self._keep(
                f"joint_impedance{suffix}", law, "torque of a joint per difference of unknowns", "SI"
            )
        return self._impedances[law]

    def _keep(self, name: str, expression: sp.Expr, doc: str, unit: str) -> sp.Expr:
        value = sp.sympify(expression).subs(self._symbols)
        if value.is_number or isinstance(value, Ref):
            return value
        per_station = any(ref.offset is not None for ref in refs_in(value))
        variable = Variable(name, Role.COEFFICIENT, self._layout.stations if per_station else None, doc, unit)
        self._assigns[variable] = value
        return variable.at()

    @property
    def sections(self) -> tuple[Section, ...]:
        """Statements of prepare."""
        scalars = tuple(Assign(v.ref, e) for v, e in self._assigns.items() if v.length is None)
        arrays = tuple(Assign(v.at(), e) for v, e in self._assigns.items() if v.length is not None)
        loop = (Loop(Order.OUTWARD, 0, self._layout.stations, arrays),) if arrays else ()
        return (Section("Masses by the ends they act at, and joint impedances", (*scalars, *loop)),)

    @property
    def coefficients(self) -> tuple[Variable, ...]:
        """Variables kept in the model."""
        return tuple(self._assigns)


def _hold(layout: PlanarLayout, stages: int) -> tuple[Section, ...]:
    """Remember force inputs for outputs that need them."""
    by_name = {v.name: v for v in layout.inputs}
    assigns = tuple(Assign(v.ref, by_name[name].entry(stages - 1)) for name, v in layout.held.items())
    return (Section("forces as they last acted", assigns),) if assigns else ()


def _initialise(scene: Scene, layout: PlanarLayout) -> Routine:
    """Build the start: given motion, consistent acceleration, an older history that nothing reads yet."""
    combined = _Combinations(layout)
    inline = {v.at(): e for v, e in combined._assigns.items()}
    angle, rate = layout.given
    loads = planar_loads(scene, layout.inputs, 0)
    builder = PlanarStep(
        layout=replace(
            layout,
            state={p: v for p, v in layout.state.items() if p.lag == 0},
            hub={p: v for p, v in layout.hub.items() if p.lag == 0},
        ),
        shared={k: sp.sympify(v).subs(inline) for k, v in combined.shared.items()},
        impedances=(sp.Integer(0),),
        loads=(loads,),
        base=scene.base.kind,
        scheme=CONSISTENT_START,
        unknown="acceleration",
        sources={past("q"): angle.at(), past("v"): rate.at(), past("a"): sp.Integer(0)},
        hub_sources={past(kind): sp.Integer(0) for kind in KINDS},
        iterations=1,  # exact: at given angles and rates the equations are linear in accelerations
    )
    cold = Assign(layout.dissipated.ref, sp.Integer(0)) if layout.dissipated else None
    older = [Assign(v.ref, sp.Integer(0)) for p, v in layout.hub.items() if p.lag]
    return Routine(
        "initialise",
        "Start from given angles and rates with the acceleration that satisfies the equations of motion.",
        (
            *builder.sections(),
            *((start_places(layout),) if layout.places else ()),
            *((Section("older history of the hub", tuple(older)),) if older else ()),
            *_hold(layout, 1),
            *((Section("nothing has turned to heat yet", (cold,)),) if cold else ()),
        ),
    )
