"""Which variables an arm in space needs: only those its joints, its outputs and its integrator ask for."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.integrators.declaration import CONSISTENT_START, KINDS, Integrator, Past, Scheme
from tmm_gen.derive.integrators.history import history
from tmm_gen.derive.space.declaration import AXES
from tmm_gen.program.fields import MOTION_NAMES, stage_accelerations
from tmm_gen.program.space.base_layout import BaseLayout, base_layout
from tmm_gen.program.space.gears import marked_by, set_aside, shafts_of
from tmm_gen.program.space.kernel_parameters import parameters_of
from tmm_gen.program.space.runs import StationTree
from tmm_gen.program.variables import Ref, Role, Variable
from tmm_gen.scene.quantity import INPUT_UNITS
from tmm_gen.scene.signal import ACCELERATION, PRESCRIBED, RATE
from tmm_gen.scene.spatial.arm import ArmInput, ArmOutput, SpatialArm

BASE_MOTION = (("place", "m"), ("velocity", "m/s"), ("acceleration", "m/s^2"))
"""What is said of a base that is moved along."""
_AGO = {1: "one step", 2: "two steps", 3: "three steps"}


@dataclass(frozen=True)
class SpaceLayout:
    """The variables of an arm in space.

    Parameters
    ----------
    tree : StationTree
        The arm's stations.
    parameters : dict from str to Variable
        By the names of the symbols that stand for them.
    state : dict from Past to Variable
        History of the joints' motion, newest first.
    held : dict from str to Variable
        Inputs as they last acted, kept where an output needs them.
    base : BaseLayout or None
        Of a base that floats.
    stages : tuple of Variable
        Accelerations at the stages of the last step, where the next is predicted by them.
    single : bool
        Whether the arm's numbers are of single precision.
    """

    name: str
    title: str
    tree: StationTree
    step: Variable
    parameters: dict[str, Variable]
    state: dict[Past, Variable]
    held: dict[str, Variable]
    inputs: tuple[Variable, ...]
    outputs: tuple[Variable, ...]
    given: tuple[Variable, ...]
    base: BaseLayout | None = None
    stages: tuple[Variable, ...] = ()
    single: bool = False

    @property
    def arm(self) -> SpatialArm:
        """What is modelled."""
        return self.tree.arm

    @property
    def stations(self) -> int:
        """Number of joints."""
        return self.tree.stations

    @property
    def moving(self) -> tuple[Variable, ...]:
        """State of the joints."""
        return tuple(dict.fromkeys((*self.state.values(), *self.stages)))

    def at(self, name: str, index: int | None, offset: int = 0) -> sp.Expr:
        """Return a parameter at a station of a loop, or at one with an index; zero where the arm has none of it."""
        variable = self.parameters.get(name)
        if variable is None:
            return sp.Integer(0)
        return variable.at(offset) if index is None else variable.entry(index)

    def input(self, column: str, stage: int) -> Ref:
        """Return an input at a stage, from 0."""
        return next(v for v in self.inputs if v.name == column).entry(stage)


def layout_of(arm: SpatialArm, name: str, title: str, integrator: Integrator, step: float) -> SpaceLayout:
    """Choose the variables of an arm in space.

    Parameters
    ----------
    name, title : str
        Of the scene.
    step : float
        The scene's, s.
    """
    n = len(arm.joints)
    marked = marked_by(arm)
    shafts = shafts_of(arm, marked)
    arm = set_aside(arm, shafts)
    kept = set(history(integrator, "acceleration")) | {Past(kind, 0) for kind in KINDS}
    ordered = sorted(kept, key=lambda p: (p.lag, KINDS.index(p.kind)))
    given = moves_as_given(arm)
    stages = max(len(instants(scheme, given=given)) for scheme in integrator.schemes)
    also = ", at each stage of the step" if stages > 1 else ""
    torques = {item.joint: item for item in arm.inputs if item.acts == "torque"}
    read = [torques[o.passing] for o in arm.outputs if o.quantity.read == "through" and o.passing in torques]
    base = base_layout(arm.base, ordered, integrator.main) if arm.base is not None else None
    state = {p: _state(p, n) for p in ordered}
    newest = state[Past("a", 0)]
    return SpaceLayout(
        name=name,
        title=title,
        tree=StationTree(arm, marked, shafts),
        step=Variable("step", Role.STEP, doc="time step", unit="s", default=step),
        parameters={v.name: v for v in parameters_of(arm)},
        state=state,
        held={
            column: Variable(f"held_{column}", Role.STATE, doc=f"{column} as it last acted", unit=unit)
            for column, unit in ({item.name: "N m" for item in read} | _loads_held(arm)).items()
        }
        | dict(_base_held(arm)),
        inputs=tuple(
            Variable(column, Role.INPUT, stages if stages > 1 else None, doc + also, unit)
            for item in arm.inputs
            for column, doc, unit in _columns(arm, item)
        ),
        outputs=tuple(
            Variable(column, Role.OUTPUT, doc=doc, unit=o.quantity.unit)
            for o in arm.outputs
            for column, doc in zip(o.columns, _output_docs(arm, o), strict=True)
        ),
        given=(
            Variable(
                "initial_angle",
                Role.GIVEN,
                n,
                "angles to start from",
                "rad",
                tuple(j.angle for j in arm.joints),
            ),
            Variable(
                "initial_rate",
                Role.GIVEN,
                n,
                "rates to start from",
                "rad/s",
                tuple(j.rate for j in arm.joints),
            ),
            *(base.given.values() if base else ()),
        ),
        base=base,
        stages=stage_accelerations(integrator.main, newest, newest.doc),
    )


def instants(scheme: Scheme, *, given: bool) -> tuple[float, ...]:
    """Return the instants of a step, in steps, at which inputs are read: its stages, and its end for what is given."""
    stages = tuple(float(stage.instant) for stage in scheme.stages)
    ends = scheme is CONSISTENT_START or stages[-1] == 1.0 or not given
    return stages if ends else (*stages, 1.0)


def moves_as_given(arm: SpatialArm) -> bool:
    """Whether an input says how anything moves: a joint on the base, or the base itself."""
    return any(joint.given for joint in arm.joints) or any(arm.along)


def _base_held(arm: SpatialArm) -> Iterable[tuple[str, Variable]]:
    """Yield how a base is moved along, by the columns that say it: what is read between steps, and drawn."""
    for axis, item in zip(AXES, arm.along, strict=True):
        for column, (word, unit) in zip(kernel_columns(item), BASE_MOTION, strict=False):
            name = f"base_{word}_{axis}"
            yield column, Variable(name, Role.STATE, doc=f"{word} of the base along {axis}", unit=unit)


def kernel_columns(item: ArmInput | None) -> tuple[str, ...]:
    """Return the columns that say how something moves as given, (3,); none where nothing does."""
    return (item.name, item.name + RATE, item.name + ACCELERATION) if item else ()


def _loads_held(arm: SpatialArm) -> dict[str, str]:
    """Return the columns of forces and moments, with units, where an output is what drives or holds a base."""
    asked = any(
        o.quantity.read == "force" or (o.quantity.read == "through" and arm.joints[o.joint - 1].given)
        for o in arm.outputs
    )
    loads = [item for item in arm.inputs if asked and item.frame is not None and item.frame.joint]
    return {column: INPUT_UNITS[f"{item.acts}_x"] for item in loads for column in item.columns}


def _columns(arm: SpatialArm, item: ArmInput) -> Iterable[tuple[str, str, str]]:
    if item.acts in PRESCRIBED:
        turned = (
            f"of '{arm.joints[item.joint - 1].name}'" if item.joint else f"of the base along {item.acts[-1]}"
        )
        words = (("angle", "rad"), ("rate", "rad/s"), ("acceleration", "rad/s^2"))
        told = zip(kernel_columns(item), words if item.joint else BASE_MOTION, strict=True)
        return [(name, f"{word} {turned}, which is given", unit) for name, (word, unit) in told]
    if item.acts == "torque":
        joint = arm.joints[item.joint - 1]
        geared = f", {joint.gear:g}-fold at the joint" if joint.gear != 1.0 else ""
        return [(item.name, f"torque in '{joint.name}'{geared}", "N m")]
    assert item.frame is not None
    unit = "N" if item.acts == "force" else "N m"
    axes = "world axes" if item.axes == "world" else "its own axes"
    return [(column, f"{item.acts} on '{item.frame.name}', in {axes}", unit) for column in item.columns]


def _output_docs(arm: SpatialArm, output: ArmOutput) -> list[str]:
    """Return what each column of an output is, in the words of `tmm_gen.scene.columns`."""
    quantity, of = output.quantity, output.of.replace("_", " ")
    if output.joint:
        what = f"{of} at '{arm.joints[output.joint - 1].name}'"
    elif output.frame is not None:
        what = f"{of} at '{output.frame.name}'"
    else:
        what = f"{of} of the arm" if quantity.of_arm else f"{of} at the base"
    return [what + f", {part}" for part in quantity.components] if quantity.components else [what]


def _state(past: Past, length: int) -> Variable:
    name, unit = MOTION_NAMES[past.kind]
    age = f"_{past.lag}_ago" if past.lag else ""
    when = f", {_AGO.get(past.lag, f'{past.lag} steps')} ago" if past.lag else ""
    return Variable(f"{name}{age}", Role.STATE, length, f"{name} of each joint, base to tips{when}", unit)
