"""Which variables a planar arm needs: only those its scene and its integrator ask for."""

from __future__ import annotations

from dataclasses import dataclass

from tmm_gen.derive.integrators.declaration import KINDS, Integrator, Past
from tmm_gen.derive.integrators.history import history
from tmm_gen.program.fields import parameter, state_variable
from tmm_gen.program.inputs import UNITS, input_variables
from tmm_gen.program.variables import Role, Variable
from tmm_gen.scene import Output, Scene, station_of
from tmm_gen.scene.quantity import PLANAR


@dataclass(frozen=True)
class PlanarLayout:
    """The variables of a planar arm; None where the scene does not model the thing.

    Parameters
    ----------
    state, hub : dict from Past to Variable
        History of the links' angles and of the hub's, newest first.
    places : dict from "x", "y" to dict from Past to Variable
        History of the nodes' places, only where a linearisation integrates them.
    held : dict from str to Variable
        Force inputs as they last acted, kept where a force is an output.
    dissipated : Variable or None
        Energy turned to heat, counted where it is an output and something turns energy to heat.
    """

    stations: int
    step: Variable
    length: Variable
    mass: Variable
    inertia: Variable
    center: Variable
    stiffness: Variable
    damping: Variable | None
    gravity: Variable | None
    hub_inertia: Variable | None
    hub_damping: Variable | None
    tip_mass: Variable | None
    tip_inertia: Variable | None
    state: dict[Past, Variable]
    hub: dict[Past, Variable]
    places: dict[str, dict[Past, Variable]]
    held: dict[str, Variable]
    dissipated: Variable | None
    inputs: tuple[Variable, ...]
    outputs: tuple[Variable, ...]
    given: tuple[Variable, ...]

    @property
    def parameters(self) -> tuple[Variable, ...]:
        """Physical parameters that are modelled."""
        every = (
            self.length,
            self.mass,
            self.inertia,
            self.center,
            self.stiffness,
            self.damping,
            self.gravity,
            self.hub_inertia,
            self.hub_damping,
            self.tip_mass,
            self.tip_inertia,
        )
        return tuple(v for v in every if v is not None)

    @property
    def all_state(self) -> tuple[Variable, ...]:
        """State variables, hub first."""
        places = (v for history in self.places.values() for v in history.values())
        counted = (self.dissipated,) if self.dissipated else ()
        return (*self.hub.values(), *self.state.values(), *places, *self.held.values(), *counted)


def planar_layout(scene: Scene, integrator: Integrator) -> PlanarLayout:
    """Choose the variables for a scene."""
    n = scene.stations
    # the newest acceleration predicts the next one
    kept = set(history(integrator, scene.model.unknown)) | {Past(kind, 0) for kind in KINDS}
    ordered = sorted(kept, key=lambda p: (p.lag, KINDS.index(p.kind)))
    moved = scene.base.kind == "motor"
    hubbed = scene.base.kind != "clamp"
    tip = scene.tip
    links, joints = scene.links, scene.joints

    def optional(name: str, doc: str, unit: str, value: float | None) -> Variable | None:
        return parameter(name, doc, unit, [value]) if value else None

    damped = any(j.damping for j in joints)
    return PlanarLayout(
        stations=n,
        step=Variable("step", Role.STEP, doc="time step", unit="s", default=scene.integrator.step),
        length=parameter("length", "link length", "m", [link.length for link in links]),
        mass=parameter("mass", "link mass", "kg", [link.mass for link in links]),
        inertia=parameter(
            "inertia", "link inertia about its centre of mass", "kg m^2", [x.inertia for x in links]
        ),
        center=parameter(
            "center", "centre of mass along the link, 0 to 1", "1", [link.center for link in links]
        ),
        stiffness=parameter("stiffness", "joint stiffness", "N m/rad", [j.stiffness for j in joints]),
        damping=parameter("damping", "joint damping", "N m s/rad", [j.damping for j in joints])
        if damped
        else None,
        gravity=optional("gravity", "gravity along -y", "m/s^2", scene.model.gravity),
        hub_inertia=optional("hub_inertia", "hub inertia", "kg m^2", scene.base.inertia if moved else None),
        hub_damping=optional(
            "hub_damping",
            "viscous damping of the hub to ground",
            "N m s/rad",
            scene.base.damping if moved else None,
        ),
        tip_mass=optional("tip_mass", "mass at the tip", "kg", tip.mass if tip else None),
        tip_inertia=optional("tip_inertia", "inertia at the tip", "kg m^2", tip.inertia if tip else None),
        state={p: state_variable(p, "", n) for p in ordered},
        hub={p: state_variable(p, "hub_", None) for p in ordered if moved or not p.lag} if hubbed else {},
        places={axis: {p: _place(axis, p, n) for p in ordered} for axis in "xy"}
        if scene.model.linearisation != "newton"
        else {},
        held=_held(scene),
        dissipated=_dissipated(scene),
        inputs=input_variables(scene, integrator),
        outputs=tuple(v for o in scene.outputs for v in output_variables(o)),
        given=(
            Variable(
                "initial_angle", Role.GIVEN, n, "angles to start from", "rad", tuple(scene.initial.angles)
            ),
            Variable(
                "initial_rate", Role.GIVEN, n, "rates to start from", "rad/s", tuple(scene.initial.rates)
            ),
        ),
    )


def output_variables(output: Output) -> tuple[Variable, ...]:
    """Return the variables of an output: two for a vector, one otherwise."""
    place = f"station {output.at}" if isinstance(output.at, int) else f"the {output.at}"
    quantity = PLANAR[output.of]
    what = f"{output.of.replace('_', ' ')} {'of' if quantity.of_arm else 'at'} {place}"
    if not quantity.vector:
        return (Variable(output.name, Role.OUTPUT, doc=what, unit=quantity.unit),)
    return tuple(
        Variable(f"{output.name}_{axis}", Role.OUTPUT, doc=f"{what}, {axis}", unit=quantity.unit)
        for axis in "xy"
    )


def _place(axis: str, past: Past, length: int) -> Variable:
    """Return the variable of one value of the history of the nodes' places."""
    suffix = {"q": "", "v": "_rate", "a": "_acceleration"}[past.kind]
    unit = {"q": "m", "v": "m/s", "a": "m/s^2"}[past.kind]
    age = f"_{past.lag}_ago" if past.lag else ""
    doc = f"place of each link's outer end along {axis}{suffix.replace('_', ', ')}"
    return Variable(f"place_{axis}{suffix}{age}", Role.STATE, length, doc, unit)


def _held(scene: Scene) -> dict[str, Variable]:
    """Return a variable for each load beyond a joint, or on the tip's body, whose force or torque is an output."""
    n = scene.stations
    inmost = min((max(station_of(o.at, n), 1) for o in scene.outputs if o.of == "force"), default=n + 1)
    held = [i for i in scene.inputs if i.acts in ("force_x", "force_y") and station_of(i.at, n) >= inmost]
    if any(o.of == "torque" and o.at == "tip" for o in scene.outputs):
        held += [i for i in scene.inputs if i.acts == "torque" and station_of(i.at, n) == n]
    return {
        i.name: Variable(f"held_{i.name}", Role.STATE, doc=f"{i.name} as it last acted", unit=UNITS[i.acts])
        for i in held
    }


def _dissipated(scene: Scene) -> Variable | None:
    """Return the variable that counts energy turned to heat, if an output asks for it and anything does."""
    damped = any(j.damping for j in scene.joints) or (scene.base.kind == "motor" and scene.base.damping > 0.0)
    if not damped or all(o.of != "dissipated_energy" for o in scene.outputs):
        return None
    return Variable("dissipated", Role.STATE, doc="energy turned to heat since the start", unit="J")
