"""Which variables a torsional chain needs: only those its scene and its integrator ask for."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from tmm_gen.derive.integrators.declaration import KINDS, Integrator, Kind, Past, Scheme, pasts_in
from tmm_gen.derive.integrators.relations import Unknown, affine_motion
from tmm_gen.program.variables import Role, Variable
from tmm_gen.scene import Scene

MOTION_NAMES: dict[Kind, tuple[str, str]] = {
    "q": ("angle", "rad"),
    "v": ("rate", "rad/s"),
    "a": ("acceleration", "rad/s^2"),
}
OUTPUT_KINDS: dict[str, Kind] = {"angle": "q", "velocity": "v", "acceleration": "a"}
_AGO = {1: "one step", 2: "two steps", 3: "three steps"}


@dataclass(frozen=True)
class ChainLayout:
    """The variables of a chain.

    Parameters
    ----------
    step, stiffness, damping, inertia, hub_inertia, hub_damping : Variable or None
        Parameters; None where the scene does not model the thing. Scalars where all stations are alike.
    state : dict from Past to Variable
        History of the links, newest first.
    hub : dict from Past to Variable
        History of the hub, empty for a clamp.
    inputs, outputs, given : tuple of Variable
        Named inputs and outputs; angles and rates to start from.
    """

    stations: int
    step: Variable
    stiffness: Variable
    damping: Variable | None
    inertia: Variable
    hub_inertia: Variable | None
    hub_damping: Variable | None
    state: dict[Past, Variable]
    hub: dict[Past, Variable]
    inputs: tuple[Variable, ...]
    outputs: tuple[Variable, ...]
    given: tuple[Variable, ...]

    @property
    def parameters(self) -> tuple[Variable, ...]:
        """Physical parameters that are modelled."""
        candidates = (self.stiffness, self.damping, self.inertia, self.hub_inertia, self.hub_damping)
        return tuple(v for v in candidates if v is not None)

    @property
    def all_state(self) -> tuple[Variable, ...]:
        """State variables, hub first."""
        return (*self.hub.values(), *self.state.values())


def history(schemes: Iterable[Scheme], unknown: Unknown) -> frozenset[Past]:
    """Return the history that schemes read when solved for an unknown, closed under ageing."""
    needed: set[Past] = set()
    for scheme in schemes:
        for index in range(1, len(scheme.stages) + 1):
            for offset in affine_motion(scheme, index, unknown).offset.values():
                needed |= pasts_in(offset)
        for value in scheme.update.values():
            needed |= pasts_in(value)
    return frozenset(Past(p.kind, lag) for p in needed for lag in range(p.lag + 1))


def chain_layout(scene: Scene, integrator: Integrator) -> ChainLayout:
    """Choose the variables for a scene."""
    n = scene.stations
    kept = set(history(integrator.schemes, scene.model.unknown)) | {Past("q", 0)}
    for output in scene.outputs:
        kinds = ("q", "v") if output.of == "torque" else (OUTPUT_KINDS[output.of],)
        kept |= {Past(kind, 0) for kind in kinds}
    ordered = sorted(kept, key=lambda p: (p.lag, KINDS.index(p.kind)))
    damped = any(joint.damping for joint in scene.joints)
    hubbed = scene.base.kind != "clamp"
    moved = scene.base.kind == "motor"
    return ChainLayout(
        stations=n,
        step=Variable("step", Role.STEP, doc="time step", unit="s", default=scene.integrator.step),
        stiffness=_parameter("stiffness", "joint stiffness", "N m/rad", [j.stiffness for j in scene.joints]),
        damping=_parameter("damping", "joint damping", "N m s/rad", [j.damping for j in scene.joints]) if damped else None,
        inertia=_parameter("inertia", "link inertia", "kg m^2", [link.inertia for link in scene.links]),
        hub_inertia=_parameter("hub_inertia", "hub inertia", "kg m^2", [scene.base.inertia]) if moved else None,
        hub_damping=(
            _parameter("hub_damping", "viscous damping of the hub to ground", "N m s/rad", [scene.base.damping])
            if moved and scene.base.damping
            else None
        ),
        state={p: _state(p, "", n) for p in ordered},
        hub={p: _state(p, "hub_", None) for p in ordered} if hubbed else {},
        inputs=tuple(
            Variable(i.name, Role.INPUT, doc=_input_doc(i.at, i.acts), unit="rad" if i.acts == "angle" else "N m")
            for i in scene.inputs
        ),
        outputs=tuple(
            Variable(o.name, Role.OUTPUT, doc=f"{o.of} at {_place(o.at)}", unit=_output_unit(o.of)) for o in scene.outputs
        ),
        given=(
            Variable("initial_angle", Role.GIVEN, n, "angles to start from", "rad", tuple(scene.initial.angles)),
            Variable("initial_rate", Role.GIVEN, n, "rates to start from", "rad/s", tuple(scene.initial.rates)),
        ),
    )


def _parameter(name: str, doc: str, unit: str, values: list[float]) -> Variable:
    """Return a scalar where all values are alike, an array otherwise."""
    if len(set(values)) == 1:
        return Variable(name, Role.PARAMETER, None, doc + (", the same everywhere" if len(values) > 1 else ""), unit, values[0])
    return Variable(name, Role.PARAMETER, len(values), doc + ", base to tip", unit, tuple(values))


def _state(past: Past, prefix: str, length: int | None) -> Variable:
    name, unit = MOTION_NAMES[past.kind]
    age = f"_{past.lag}_ago" if past.lag else ""
    when = f", {_AGO.get(past.lag, f'{past.lag} steps')} ago" if past.lag else ""
    what = f"hub {name}" if prefix else f"{name} of each link, base to tip"
    return Variable(f"{prefix}{name}{age}", Role.STATE, length, what + when, unit)


def _place(at: str | int) -> str:
    return f"station {at}" if isinstance(at, int) else f"the {at}"


def _input_doc(at: str | int, acts: str) -> str:
    return f"{acts} acting at {_place(at)}" if acts != "angle" else "prescribed base angle"


def _output_unit(of: str) -> str:
    return "N m" if of == "torque" else MOTION_NAMES[OUTPUT_KINDS[of]][1]

