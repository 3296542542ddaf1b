"""Which variables a torsional chain needs: only those its scene and its integrator ask for."""

from __future__ import annotations

from dataclasses import dataclass

from tmm_gen.derive.integrators.declaration import KINDS, Integrator, Kind, Past
from tmm_gen.derive.integrators.history import history
from tmm_gen.program.fields import MOTION_NAMES, parameter, state_variable
from tmm_gen.program.inputs import input_variables
from tmm_gen.program.variables import Role, Variable
from tmm_gen.scene import Scene

OUTPUT_KINDS: dict[str, Kind] = {"angle": "q", "velocity": "v", "acceleration": "a"}


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


def chain_layout(scene: Scene, integrator: Integrator) -> ChainLayout:
    """Choose the variables for a scene."""
    n = scene.stations
    kept = set(history(integrator, scene.model.unknown)) | {Past("q", 0)}
    for output in scene.outputs:
        kinds: tuple[Kind, ...] = ("q", "v") if output.of == "torque" else (OUTPUT_KINDS[output.of],)
        kept |= {Past(kind, 0) for kind in kinds}
    ordered = sorted(kept, key=lambda p: (p.lag, KINDS.index(p.kind)))
    damped = any(joint.damping for joint in scene.joints)
    hubbed = scene.base.kind != "clamp"
    moved = scene.base.kind == "motor"
    return ChainLayout(
        stations=n,
        step=Variable("step", Role.STEP, doc="time step", unit="s", default=scene.integrator.step),
        stiffness=parameter("stiffness", "joint stiffness", "N m/rad", [j.stiffness for j in scene.joints]),
        damping=parameter("damping", "joint damping", "N m s/rad", [j.damping for j in scene.joints])
        if damped
        else None,
        inertia=parameter("inertia", "link inertia", "kg m^2", [link.inertia for link in scene.links]),
        hub_inertia=parameter("hub_inertia", "hub inertia", "kg m^2", [scene.base.inertia])
        if moved
        else None,
        hub_damping=(
            parameter(
                "hub_damping", "viscous damping of the hub to ground", "N m s/rad", [scene.base.damping]
            )
            if moved and scene.base.damping
            else None
        ),
        state={p: state_variable(p, "", n) for p in ordered},
        hub={p: state_variable(p, "hub_", None) for p in ordered if moved or not p.lag} if hubbed else {},
        inputs=input_variables(scene, integrator),
        outputs=tuple(
            Variable(o.name, Role.OUTPUT, doc=f"{o.of} at {_place(o.at)}", unit=_output_unit(o.of))
            for o in scene.outputs
        ),
        given=(
            Variable(
                "initial_angle", Role.GIVEN, n, "angles to start from", "rad", tuple(scene.initial.angles)
            ),
            Variable(
                "initial_rate", Role.GIVEN, n, "rates to start from", "rad/s", tuple(scene.initial.rates)
            ),
        ),
    )


def _place(at: str | int) -> str:
    return f"station {at}" if isinstance(at, int) else f"the {at}"


def _output_unit(of: str) -> str:
    return "N m" if of == "torque" else MOTION_NAMES[OUTPUT_KINDS[of]][1]
