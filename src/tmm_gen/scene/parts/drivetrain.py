"""From parts of a drivetrain to the joints and links of a chain: what rigid gears join turns as one.

Each link of the chain is the first [[link]] behind an element that gives way, with all that turns with it by rigid
gears, referred to its own angle. A rigid gear beside a spring changes the joint's ratio instead.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction

from tmm_gen.scene.exact import exact, nearest
from tmm_gen.scene.initial import Initial, InitialTable, Values, in_order
from tmm_gen.scene.model import Base
from tmm_gen.scene.parts.order import BASE, Entry, Hanging
from tmm_gen.scene.parts.placed import Expansion, PlacedPart
from tmm_gen.scene.parts.tables import ChainJointPart, ChainLinkPart, GearPart, MotorPart
from tmm_gen.scene.signal import FileInput, FileOutput, Input, Of, Output, Place
from tmm_gen.scene.station import Joint, Link

OF_LINKS: dict[str, Of] = {
    "angle": "angle",
    "rate": "velocity",
    "velocity": "velocity",
    "acceleration": "acceleration",
}
"""What links and motors of a chain have as outputs, and what chains call it."""


@dataclass(frozen=True)
class Drivetrain(Expansion):
    """What the parts of a chain make.

    Parameters
    ----------
    turns : dict from str to float
        Turns of each part, on its outer side, per turn of its link or of the base.
    gears : dict from str to float
        Of each motor, its own turns per turn of what hangs on it.
    """

    turns: dict[str, float] = field(default_factory=dict)
    gears: dict[str, float] = field(default_factory=dict)

    def inputs(self, items: Sequence[FileInput]) -> tuple[Input, ...]:
        """Return torques referred to the links that they act on."""
        return tuple(self._input(item) for item in items)

    def outputs(self, items: Sequence[FileOutput]) -> tuple[Output, ...]:
        """Return outputs as multiples of what the chain's links and joints have."""
        return tuple(self._output(item) for item in items)

    def initial(self, table: InitialTable) -> Initial:
        """Return the motion at time zero of each link."""
        angles, rates = (self._first(each) for each in (table.angles, table.rates))
        return Initial(angles, rates)

    def _first(self, values: Values) -> tuple[float, ...]:
        """Return one number for each link of the chain: that of the first part which turns as one with it."""
        values = in_order(values, [part.name for part in self.solid])
        if not isinstance(values, tuple):
            return (values,) * len(self.links)
        found = {p.last: value for value, p in reversed(list(zip(values, self.solid, strict=True)))}
        return tuple(found[k + 1] for k in range(len(self.links)))

    def _place(self, part: PlacedPart | None) -> Place:
        if part is None or part.last == 0:
            return "base"
        return "tip" if part.last == len(self.links) else part.last

    def _input(self, item: FileInput) -> Input:
        part = self._part(str(item.at))
        name = part.name if part else ""
        factor = self.turns.get(name, 1.0) * self.gears.get(name, 1.0)
        return Input(name=item.name, at=self._place(part), acts=item.acts, part=name, factor=factor)

    def _output(self, item: FileOutput) -> Output:
        part = self._part(str(item.at))
        name = part.name if part else ""
        if part is not None and part.joint:
            # what a chain calls its torque is that of the outer side on the inner one
            return Output(
                name=item.name, at=part.joint, of="torque", part=name, factor=-1.0 / self.turns[name]
            )
        of, factor = OF_LINKS[item.of], self.turns.get(name, 1.0)
        return Output(name=item.name, at=self._place(part), of=of, part=name, factor=factor)

    def _part(self, name: str) -> PlacedPart | None:
        return self.solid[-1] if name == "tip" else self.by_name.get(name)


@dataclass(frozen=True)
class _Spring:
    """What gives way between two links: ``stiffness (outer theta_out - inner theta_in)``, in their own angles."""

    part: Entry
    stiffness: Fraction
    damping: Fraction
    inner: Fraction
    outer: Fraction = Fraction(1)

    @property
    def joint(self) -> Joint:
        """The same seen from the outer link."""
        return Joint.model_construct(
            stiffness=nearest(self.stiffness * self.outer**2),
            damping=nearest(self.damping * self.outer**2),
            ratio=nearest(self.outer / self.inner),
        )


@dataclass(frozen=True)
class _Shaft:
    """The outer side of a part: turns per turn of a link (0: of the base), or of what the next link will be."""

    link: int
    turns: Fraction = Fraction(1)
    spring: _Spring | None = None


def drivetrain(hung: Hanging, base: Base) -> Drivetrain:
    """Expand the parts of a chain that keep all rules.

    Parameters
    ----------
    hung : Hanging
        The parts.
    base : Base
        As the file has it.
    """
    kind, inertia, damping = base.kind, [exact(base.inertia)], exact(base.damping)
    joints: list[Joint] = []
    hosts: list[int] = []
    parts: list[PlacedPart] = []
    turns: dict[str, float] = {}
    gears: dict[str, float] = {}
    first: dict[int, str] = {}
    shafts = {BASE: _Shaft(0)}
    for entry in hung.outward():
        part, shaft = entry.part, shafts[hung.host(entry)]
        if isinstance(part, MotorPart):
            kind, gears[part.name] = "motor", part.gear
            inertia[0] += exact(part.gear) ** 2 * exact(part.rotor_inertia)
            damping += exact(part.damping) + exact(part.gear) ** 2 * exact(part.motor_damping)
            parts.append(PlacedPart(part.name, entry.table))
        elif isinstance(part, ChainJointPart):
            law = exact(part.stiffness), exact(part.damping)
            shaft = replace(shaft, spring=_Spring(entry, *law, shaft.turns))
        elif isinstance(part, GearPart):
            shaft = _behind_gear(shaft, entry, part)
        elif isinstance(part, ChainLinkPart):
            if (spring := shaft.spring) is not None:
                joints.append(spring.joint)
                hosts.append(shaft.link)
                inertia.append(Fraction(0))
                turns[spring.part.name] = nearest(spring.outer)
                parts.append(PlacedPart(spring.part.name, spring.part.table, joint=len(joints)))
                shaft = _Shaft(len(joints))
            inertia[shaft.link] += exact(part.inertia) * shaft.turns**2
            turns[part.name] = nearest(shaft.turns)
            one = first.setdefault(shaft.link, part.name)
            fixed = one if one != part.name else ""
            parts.append(PlacedPart(part.name, entry.table, first=shaft.link, last=shaft.link, fixed=fixed))
        shafts[entry.name] = shaft
    hub = Base.model_construct(kind=kind, inertia=nearest(inertia[0]), damping=nearest(damping))
    links = tuple(Link.model_construct(inertia=nearest(each)) for each in inertia[1:])
    return Drivetrain(tuple(joints), links, None, tuple(parts), tuple(hosts), hub, turns, gears)


def _behind_gear(shaft: _Shaft, entry: Entry, part: GearPart) -> _Shaft:
    """Return the outer side of a gear."""
    ratio = exact(part.ratio)
    if part.stiffness is not None:
        law = exact(part.stiffness), exact(part.damping)
        return replace(shaft, spring=_Spring(entry, *law, shaft.turns / ratio))
    if shaft.spring is not None:
        return replace(shaft, spring=replace(shaft.spring, outer=shaft.spring.outer * ratio))
    return replace(shaft, turns=shaft.turns / ratio)
