"""From a chain's scene and integrator to its program."""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from tmm_gen.derive import torsion_chain as chain
from tmm_gen.derive.elements.torsion import INERTIA
from tmm_gen.derive.integrators.declaration import CONSISTENT_START, KINDS, Integrator, Past, Scheme, past
from tmm_gen.derive.integrators.relations import Unknown, affine_motion
from tmm_gen.program.fields import gain_names, living_state
from tmm_gen.program.inputs import input_instants
from tmm_gen.program.motion import history_values
from tmm_gen.program.passes.hoist import Hoister
from tmm_gen.program.passes.prune import prune
from tmm_gen.program.sensitivities.chain import chain_sensitivities
from tmm_gen.program.sensitivities.refusals import require_derivatives
from tmm_gen.program.statements import Assign, Program, Routine, Section
from tmm_gen.program.torsion.factors import (
    Factors,
    Gains,
    bind,
    gains_of,
    hub_values,
    parameter_values,
    product_factors,
    riccati_factors,
)
from tmm_gen.program.torsion.layout import OUTPUT_KINDS, ChainLayout, chain_layout
from tmm_gen.program.torsion.loads import Loads, loads_of
from tmm_gen.program.torsion.step import StepBuilder
from tmm_gen.program.torsion.turns import start_unturned, take_turns_out, turns_of
from tmm_gen.program.variables import Variable
from tmm_gen.scene import Scene, station_of


def build_chain(scene: Scene, integrator: Integrator) -> Program:
    """Build the program of a torsional chain.

    Parameters
    ----------
    scene : Scene
        With ``model.kind == "chain"``.
    integrator : Integrator
        With its parameters bound to numbers.

    Raises
    ------
    UnsuitableUnknownError
        If the integrator cannot be solved for the scene's unknown.
    """
    if scene.emit.sensitivities:
        require_derivatives(scene, integrator)
    layout = chain_layout(scene, integrator)
    unknown: Unknown = scene.model.unknown
    factors = _FactorSets(layout, scene.model.sweep)
    hoister = Hoister(names=gain_names(integrator, unknown, layout.step))
    routines = {}
    # the main scheme first: its factors get the plain names
    for position, scheme in sorted(
        enumerate(integrator.schemes), key=lambda item: item[1] is not integrator.main
    ):
        name = "step" if scheme is integrator.main else f"step_start{position + 1}"
        builder = StepBuilder(
            layout=layout,
            loads=tuple(loads_of(scene, layout.inputs, k) for k in range(len(input_instants(scene, scheme)))),
            base=scene.base.kind,
            scheme=scheme,
            unknown=unknown,
            factors=tuple(factors.of(affine_and_gains) for affine_and_gains in _stage_gains(scheme, unknown)),
            sources=layout.state,
            hub_sources=history_values(layout.hub, lambda v: v.ref),
        )
        doc = "Advance the state by one step." if name == "step" else f"Start-up: take step {position + 1}."
        routines[name] = hoister.hoist(Routine(name, doc, builder.sections()))
    main = routines.pop("step")
    startup = tuple(routines[f"step_start{k + 1}"] for k in range(len(integrator.startup)))
    initialise = _initialise(layout, loads_of(scene, layout.inputs, 0), scene.base.kind)
    turned = turns_of(scene)
    output = _output(scene, layout, turned)
    if turned is not None:
        main, *others = take_turns_out((main, *startup), layout)
        startup = tuple(others)
        initialise = start_unturned(initialise)
    kept = (*((turned,) if turned is not None else ()), *layout.all_state)
    state = living_state(kept, (*startup, main), output)
    wanted = frozenset(state)
    startup = tuple(prune(r, wanted) for r in startup)
    main = prune(main, wanted)
    initialise = prune(initialise, wanted)
    coefficients = (*hoister.coefficients, *factors.coefficients)
    used = frozenset().union(*(r.read() for r in (*startup, main, output)))
    prepare = prune(
        Routine(
            "prepare",
            "Compute what depends on parameters and step alone.",
            (*factors.sections, hoister.section()),
        ),
        used,
    )
    read = prepare.read() | used | initialise.read()
    return Program(
        name=scene.name,
        title=scene.title,
        stations=scene.stations,
        step=layout.step,
        parameters=tuple(p for p in layout.parameters if p in read),
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
            "model": "torsional chain (linear)",
            "stations": str(scene.stations),
            "base": scene.base.kind,
            "integrator": integrator.title
            + "".join(f", {k} = {float(v):g}" for k, v in integrator.parameters.items()),
            "sweep": scene.model.sweep,
            "unknown": scene.model.unknown,
        },
        sensitivities=chain_sensitivities(main, state, layout.inputs) if scene.emit.sensitivities else None,
    )


class _FactorSets:
    """Factors by gains: stages with equal gains share one set."""

    def __init__(self, layout: ChainLayout, sweep: str) -> None:
        self._layout = layout
        self._build = riccati_factors if sweep == "riccati" else product_factors
        self._sets: dict[Gains, Factors] = {}

    def of(self, gains: Gains) -> Factors:
        if gains not in self._sets:
            suffix = f"_{len(self._sets) + 1}" if self._sets else ""
            self._sets[gains] = self._build(self._layout, gains, suffix)
        return self._sets[gains]

    @property
    def sections(self) -> tuple[Section, ...]:
        return tuple(f.section for f in self._sets.values())

    @property
    def coefficients(self) -> tuple[Variable, ...]:
        return tuple(v for f in self._sets.values() for v in f.coefficients)


def _stage_gains(scheme: Scheme, unknown: Unknown) -> list[Gains]:
    return [gains_of(affine_motion(scheme, i + 1, unknown)) for i in range(len(scheme.stages))]


def _initialise(layout: ChainLayout, loads: Loads, base: str) -> Routine:
    """Build the start: given motion, consistent acceleration, an older history that nothing reads yet."""
    angle, rate = layout.given
    sources = {Past("q", 0): angle, Past("v", 0): rate}
    motion = affine_motion(CONSISTENT_START, 1, "acceleration")
    gains = dict(zip(chain.GAINS.values(), gains_of(motion), strict=True))
    law = chain.riccati_station()
    pivot = bind(law.pivot.subs(chain.JOINT_IMPEDANCE, 0), {}, layout).subs(
        chain.IMPEDANCE, law.link_impedance.subs(chain.IMPEDANCE, 0).subs(gains)
    )
    hub_admittance = None
    if layout.hub_inertia is not None:
        hub = chain.hub_law().pivot.subs(chain.IMPEDANCE, 0).subs(gains)
        hub_admittance = 1 / bind(hub, hub_values(layout), layout)
    factors = Factors(
        section=Section("", ()),
        coefficients=(),
        admittance=1 / pivot.subs(INERTIA, parameter_values(layout)[INERTIA]),
        hub_admittance=hub_admittance,
    )
    hub_start = {past(kind): sp.Integer(0) for kind in KINDS}
    builder = StepBuilder(
        layout=replace(
            layout,
            state={p: v for p, v in layout.state.items() if p.lag == 0},
            hub={p: v for p, v in layout.hub.items() if p.lag == 0},
        ),
        loads=(loads,),
        base=base,
        scheme=CONSISTENT_START,
        unknown="acceleration",
        factors=(factors,),
        sources=sources,
        hub_sources=hub_start,
    )
    older = tuple(Assign(v.ref, sp.Integer(0)) for p, v in layout.hub.items() if p.lag)
    return Routine(
        "initialise",
        "Start from given angles and rates with the acceleration that satisfies the equations of motion.",
        (*builder.sections(), *((Section("older history of the hub", older),) if older else ())),
    )


def _output(scene: Scene, layout: ChainLayout, turned: Variable | None) -> Routine:
    """Build the outputs from the state."""
    assignments = []
    for described, variable in zip(scene.outputs, layout.outputs, strict=True):
        link = station_of(described.at, scene.stations)
        if described.of == "torque":
            value = _joint_torque(layout, max(link, 1))
        else:
            value = _motion(layout, link, Past(OUTPUT_KINDS[described.of], 0))
            if described.of == "angle" and turned is not None:
                value = turned.ref + value
        assignments.append(Assign(variable.ref, value))
    sections = (Section("outputs", tuple(assignments)),) if assignments else ()
    return Routine("output", "Read the outputs off the state.", sections)


def _motion(layout: ChainLayout, link: int, which: Past) -> sp.Expr:
    """Return the motion of a link, counted from 1; 0 is the base."""
    if link:
        return layout.state[which].entry(link - 1)
    return layout.hub[which].ref if layout.hub else sp.Integer(0)


def _joint_torque(layout: ChainLayout, joint: int) -> sp.Expr:
    law = chain.joint_law().known_torque
    symbols = {}
    for kind in ("q", "v"):
        if Past(kind, 0) in layout.state:
            symbols[chain.INNER[kind]] = _motion(layout, joint - 1, Past(kind, 0))
            symbols[chain.OUTER[kind]] = _motion(layout, joint, Past(kind, 0))
    value = bind(law.subs(symbols), parameter_values(layout), layout)
    at_joint = {
        v.at(): v.entry(joint - 1)
        for v in (layout.stiffness, layout.damping)
        if v is not None and v.length is not None
    }
    return value.xreplace(at_joint)
