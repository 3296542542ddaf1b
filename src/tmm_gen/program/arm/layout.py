"""Which variables a row needs: only those its elements, its readings and its integrator ask for."""

from __future__ import annotations

from dataclasses import dataclass, field

from tmm_gen.derive.integrators.declaration import KINDS, Integrator, Past, Scheme
from tmm_gen.derive.integrators.history import history
from tmm_gen.derive.integrators.relations import Unknown
from tmm_gen.program.fields import stage_accelerations, state_variable
from tmm_gen.program.inputs import input_instants
from tmm_gen.program.variables import Role, Variable
from tmm_gen.row.row import Parameter, Row


@dataclass(frozen=True)
class Layout:
    """The variables of a row.

    Parameters
    ----------
    parameters : dict from str to Variable
        By the names of the symbols that stand for them.
    state, hub : dict from Past to Variable
        History of the stations' motion and of the base's, newest first.
    places : dict from str to dict from Past to Variable
        History of the nodes' places by coordinate, only where a linearisation integrates them.
    floating : dict from str to dict from Past to Variable
        History of the base's place by coordinate, only where it floats.
    held : dict from str to Variable
        Inputs as they last acted, kept where a reading needs them.
    dissipated : Variable or None
        Energy turned to heat, where it is counted.
    stages, hub_stages : tuple of Variable
        Accelerations at the stages of the last step, of the stations and of the base, where the next is predicted by
        them. A stage at the end of the step has those of the history.
    floating_stages : dict from str to tuple of Variable
        The same of the base's place by coordinate, where it floats.
    """

    row: Row
    step: Variable
    parameters: dict[str, Variable]
    state: dict[Past, Variable]
    hub: dict[Past, Variable]
    places: dict[str, dict[Past, Variable]]
    floating: dict[str, dict[Past, Variable]]
    held: dict[str, Variable]
    dissipated: Variable | None
    inputs: tuple[Variable, ...]
    outputs: tuple[Variable, ...]
    given: tuple[Variable, ...]
    stages: tuple[Variable, ...] = ()
    hub_stages: tuple[Variable, ...] = ()
    floating_stages: dict[str, tuple[Variable, ...]] = field(default_factory=dict)

    @property
    def stations(self) -> int:
        """Number of stations."""
        return len(self.row.stations)

    @property
    def all_state(self) -> tuple[Variable, ...]:
        """State variables, hub first."""
        places = (v for kept in (*self.floating.values(), *self.places.values()) for v in kept.values())
        counted = (self.dissipated,) if self.dissipated else ()
        moving = (*self.hub.values(), *self.state.values(), *self.hub_stages, *self.stages)
        floating = (v for kept in self.floating_stages.values() for v in kept)
        return (*dict.fromkeys((*moving, *places, *floating)), *self.held.values(), *counted)


def layout_of(row: Row, integrator: Integrator, step: float, unknown: Unknown, *, places: bool) -> Layout:
    """Choose the variables of a row.

    Parameters
    ----------
    step : float
        The scene's.
    places : bool
        Whether the nodes' places are integrated too.
    """
    n = len(row.stations)
    ordered = _ordered(integrator, unknown)
    instants = max((input_instants(row, scheme) for scheme in integrator.schemes), key=len)
    stages = len(instants)
    also = ", at each stage of the step" if stages > 1 else ""
    if stages > max(len(scheme.stages) for scheme in integrator.schemes):
        also += " and at its end"
    carried = [c.name for c in row.coordinates if not c.integrated]
    state = {p: state_variable(p, "", n) for p in ordered}
    hub = (
        {p: state_variable(p, "hub_", None) for p in ordered if row.boundary == "free" or not p.lag}
        if row.boundary != "held"
        else {}
    )
    floating = {axis: _floating(axis, integrator) for axis in carried} if row.floats else {}
    return Layout(
        row=row,
        step=Variable("step", Role.STEP, doc="time step", unit="s", default=step),
        parameters={p.name: _parameter(p) for p in row.parameters},
        state=state,
        hub=hub,
        places={axis: {p: _place(axis, p, n) for p in ordered} for axis in carried} if places else {},
        floating=floating,
        held={name: Variable(s.name, Role.STATE, doc=s.doc, unit=s.unit) for name, s in row.held.items()},
        dissipated=Variable("dissipated", Role.STATE, doc="energy turned to heat since the start", unit="J")
        if row.counts_heat
        else None,
        inputs=tuple(
            Variable(s.name, Role.INPUT, stages if stages > 1 else None, s.doc + also, s.unit)
            for s in row.inputs
        ),
        outputs=tuple(
            Variable(s.name, Role.OUTPUT, doc=s.doc, unit=s.unit) for r in row.readings for s in r.targets
        ),
        given=(
            Variable("initial_angle", Role.GIVEN, n, "angles to start from", "rad", row.angles),
            Variable("initial_rate", Role.GIVEN, n, "rates to start from", "rad/s", row.rates),
        ),
        stages=_stages(row, integrator.main, state, "of each link, base to tip"),
        hub_stages=_stages(row, integrator.main, hub, "of the hub") if row.boundary == "free" else (),
        floating_stages={
            axis: _stages(row, integrator.main, kept, f"of the base along {axis}")
            for axis, kept in floating.items()
        },
    )


def _stages(row: Row, scheme: Scheme, history: dict[Past, Variable], of: str) -> tuple[Variable, ...]:
    """Return where a coupled scheme keeps the accelerations of its stages for the next step's prediction."""
    if row.about != "prediction":
        return ()
    return stage_accelerations(scheme, history[Past("a", 0)], f"acceleration {of}")


def _parameter(found: Parameter) -> Variable:
    """Return a scalar where all values are alike, an array otherwise."""
    if len(set(found.values)) == 1:
        doc = found.doc + (", the same everywhere" if len(found.values) > 1 else "")
        return Variable(found.name, Role.PARAMETER, None, doc, found.unit, found.values[0])
    doc = found.doc + ", base to tip"
    return Variable(found.name, Role.PARAMETER, len(found.values), doc, found.unit, found.values)


def _floating(axis: str, integrator: Integrator) -> dict[Past, Variable]:
    """Return the history that an integrator needs of a base's place, by its acceleration."""
    found: dict[Past, Variable] = {}
    words = {"q": ("place", "m"), "v": ("velocity", "m/s"), "a": ("acceleration", "m/s^2")}
    for p in _ordered(integrator, "acceleration"):
        word, unit = words[p.kind]
        age = f"_{p.lag}_ago" if p.lag else ""
        doc = f"{word} of the base along {axis}{age.replace('_', ' ')}"
        found[p] = Variable(f"base_{word}_{axis}{age}", Role.STATE, None, doc, unit)
    return found


def _ordered(integrator: Integrator, unknown: Unknown) -> list[Past]:
    """Return the history to keep, newest first."""
    # the newest motion predicts the next; what nothing reads is dropped later
    kept = set(history(integrator, unknown)) | {Past(kind, 0) for kind in KINDS}
    return sorted(kept, key=lambda p: (p.lag, KINDS.index(p.kind)))


def _place(axis: str, past: Past, length: int) -> Variable:
    suffix = {"q": "", "v": "_rate", "a": "_acceleration"}[past.kind]
    unit = {"q": "m", "v": "m/s", "a": "m/s^2"}[past.kind]
    age = f"_{past.lag}_ago" if past.lag else ""
    doc = f"place of each link's outer end along {axis}{suffix.replace('_', ', ')}"
    return Variable(f"place_{axis}{suffix}{age}", Role.STATE, length, doc, unit)
