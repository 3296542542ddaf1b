"""A scene: everything a user says about an arm, checked and expanded to joints and links."""

from __future__ import annotations

from dataclasses import dataclass, field, fields, replace
from functools import cached_property

from tmm_gen.scene import integrator as methods
from tmm_gen.scene.beam import Beam, BeamEntry, Tip
from tmm_gen.scene.change import changed
from tmm_gen.scene.control import Control
from tmm_gen.scene.digest import content_digest
from tmm_gen.scene.document import Document
from tmm_gen.scene.emit import Emit
from tmm_gen.scene.initial import Initial, broadcast
from tmm_gen.scene.integrator import Integrator, underscored
from tmm_gen.scene.model import Base, FloatingBase, Model
from tmm_gen.scene.parts.document import PartsDocument
from tmm_gen.scene.parts.placed import PlacedPart
from tmm_gen.scene.quantity import Quantity, quantities
from tmm_gen.scene.signal import PRESCRIBED, Input, Output, station_of
from tmm_gen.scene.source import Source
from tmm_gen.scene.spatial.arm import SpatialArm
from tmm_gen.scene.spatial.document import CLAMP, SpatialDocument
from tmm_gen.scene.spatial.reach import longest_way
from tmm_gen.scene.spatial.scalars import arm_inputs, arm_outputs
from tmm_gen.scene.station import Joint, Link


@dataclass(frozen=True, eq=False)
class Scene:
    """A checked scene. Two scenes are equal if they say the same, however they are written.

    Parameters
    ----------
    name : str
        Identifier; also that of the generated package.
    title : str
        One line; the name where the scene has none.
    model : Model
        What is derived and how it is solved.
    integrator : Integrator
        Time integration.
    base : Base
        What the arm stands on.
    joints : tuple of Joint, length n
        Joint i stands inboard of link i.
    links : tuple of Link, length n
        Base to tip.
    beam : Beam or None
        The beam that joints and links came from.
    tip : Tip or None
        Body at the tip.
    inputs : tuple of Input
        In the order of the file, which is that of the vector u.
    outputs : tuple of Output
        In the order of the file, which is that of the vector y.
    initial : Initial
        Motion at time zero.
    emit : Emit
        What is generated.
    control : Control or None
        Controller of the arm.
    parts : tuple of PlacedPart
        The parts by name that joints and links came from, base to tip; none where the file writes no parts.
    hosts : tuple of int
        Number of the link on whose outer end each joint stands, 0 for the base; empty where each link carries the next.
    spatial : SpatialArm or None
        The arm of a scene in space, which has joints and frames instead of links; else None.
    """

    name: str
    title: str
    model: Model
    integrator: Integrator
    base: Base
    joints: tuple[Joint, ...]
    links: tuple[Link, ...]
    beam: Beam | None
    tip: Tip | None
    inputs: tuple[Input, ...]
    outputs: tuple[Output, ...]
    initial: Initial
    emit: Emit
    control: Control | None
    source: Source = field(repr=False)
    parts: tuple[PlacedPart, ...] = ()
    hosts: tuple[int, ...] = ()
    spatial: SpatialArm | None = None

    @cached_property
    def digest(self) -> str:
        """Fingerprint of the content, which is all fields but the source."""
        told = [item.name for item in fields(self) if item.name != "source"]
        told = [name for name in told if name not in ("parts", "hosts", "spatial") or getattr(self, name)]
        return content_digest({name: getattr(self, name) for name in told})

    @property
    def stations(self) -> int:
        """Number of links, n; in space that of joints."""
        return len(self.spatial.joints if self.spatial else self.links)

    @property
    def hub(self) -> int:
        """Coordinates before that of link 1: 1 of a hub that turns freely, 0 where the base is held or prescribed."""
        return int(self.base.turns)

    @property
    def floats(self) -> bool:
        """Whether nothing holds a planar arm, so that its base moves along x and y too."""
        return isinstance(self.base, FloatingBase)

    @property
    def sweeps(self) -> int:
        """Sweeps per stage of a kernel, a sweep and its corrections in space, or iterations of coupled stages."""
        method = methods.method_named(self.integrator.name)
        if method is None or not (self.model.auto and self.model.in_plane):
            return self.model.sweeps
        return method.sweeps

    @property
    def coupled(self) -> bool:
        """Whether its integrator solves all stages at once."""
        method = methods.method_named(self.integrator.name)
        return method is not None and method.coupled

    @property
    def integrators(self) -> tuple[str, ...]:
        """Names of the integrators that serve it: those whose stages are coupled go with one linearisation."""
        in_space = self.spatial is not None and self.model.linearisation == "newton"
        return tuple(method.name for method in methods.METHODS if not (method.coupled and in_space))

    @property
    def drivetrain(self) -> bool:
        """Whether it is a chain of parts by name: there may be gears between them."""
        return self.model.linear and bool(self.parts)

    @property
    def turns(self) -> tuple[float, ...]:
        """Turns of the base's shaft per turn of each link, length n; 1 where there are no gears."""
        found = [1.0]
        for number, joint in enumerate(self.joints, start=1):
            found.append(joint.ratio * found[self.host(number)])
        return tuple(found[1:])

    def host(self, joint: int) -> int:
        """Return the number of the link on whose outer end a joint stands, 0 for the base; both count from 1."""
        return self.hosts[joint - 1] if self.hosts else joint - 1

    def joints_of(self, output: Output) -> tuple[int, ...]:
        """Return the numbers of the joints whose torque or force an output is: at the base those of all on it."""
        number = station_of(output.at, self.stations)
        if number or not self.parts:
            return (max(number, 1),)
        return tuple(k for k in range(1, self.stations + 1) if self.host(k) == 0)

    def inner(self, joint: int) -> int:
        """Return the number of the link that a joint turns against: a shaft behind an elastic gear is passed over."""
        host = self.host(joint)
        return self.host(host) if host and self.links[host - 1].massless else host

    @property
    def reach(self) -> float:
        """The longest way from the base to the outer end of a link, m; in space to that of a part."""
        if self.spatial:
            return longest_way(self.spatial)
        ways = [0.0]
        for joint, link in enumerate(self.links, start=1):
            ways.append(ways[self.host(joint)] + link.length)
        return max(ways)

    @property
    def prescribed(self) -> Input | None:
        """The input that is the base's angle, if there is one."""
        return next((item for item in self.inputs if item.acts == "angle"), None)

    @property
    def motions(self) -> tuple[Input, ...]:
        """The inputs that say how a prescribed base moves: its angle, and in space its place."""
        return tuple(item for item in self.inputs if item.acts in PRESCRIBED)

    def quantity(self, output: Output) -> Quantity:
        """Return what an output is."""
        return quantities(self.model.kind)[output.of]

    def replace(self, **changes: object) -> Scene:
        """Return a scene with some keys of its file changed, checked again.

        Parameters
        ----------
        **changes : object
            New values by dotted key: ``scene.replace(**{"integrator.name": "zhou", "link.2.inertia": 3.0})``,
            tables counted from 1, or by name: ``motor.elbow.gear``. None removes a key. Where the integrator's
            name changes, parameters of the former one are dropped.

        Returns
        -------
        Scene
            The changed scene; this one is left as it is.

        Raises
        ------
        SceneError
            If the result is not a valid scene.
        """
        source = changed(self.source, changes)
        return source.check(source)

    def __eq__(self, other: object) -> bool:
        """Compare what the scenes say."""
        return self.digest == other.digest if isinstance(other, Scene) else NotImplemented

    def __hash__(self) -> int:
        """Hash what the scene says."""
        return hash(self.digest)


def scene_of(document: Document, source: Source) -> Scene:
    """Expand a document that keeps all rules into a scene.

    Parameters
    ----------
    document : Document
        Checked document.
    source : Source
        Where it came from.

    Returns
    -------
    Scene
        The scene.
    """
    if isinstance(document, SpatialDocument):
        return _spatial_scene(document, source)
    if isinstance(document, PartsDocument):
        made = document.expansion
        return replace(
            _scene_of(
                document,
                source,
                made.inputs(document.input),
                made.outputs(document.output),
                made.initial(document.initial),
            ),
            base=made.base or document.base,
            tip=made.tip,
            parts=made.parts,
            hosts=made.hosts if made.hosts != tuple(range(len(made.hosts))) else (),
        )
    inputs = tuple(Input(name=item.name, at=item.at, acts=item.acts) for item in document.input)
    outputs = tuple(Output(name=item.name, at=item.at, of=item.of) for item in document.output)
    given, n = document.initial, document.stations
    initial = Initial(broadcast(given.angles, n), broadcast(given.rates, n))
    return _scene_of(document, source, inputs, outputs, initial)


def _spatial_scene(document: SpatialDocument, source: Source) -> Scene:
    arm = document.arm
    initial = Initial(tuple(j.angle for j in arm.joints), tuple(j.rate for j in arm.joints))
    made = _scene_of(document, source, arm_inputs(arm), arm_outputs(arm), initial)
    model = document.model.settled(made.integrator.name)
    return replace(made, model=model, base=CLAMP, spatial=arm)


def _scene_of(
    document: Document,
    source: Source,
    inputs: tuple[Input, ...],
    outputs: tuple[Output, ...],
    initial: Initial,
) -> Scene:
    table = document.integrator
    return Scene(
        name=document.name,
        title=document.title or document.name,
        model=document.model,
        integrator=Integrator(
            name=underscored(table.name),
            step=table.step,
            parameters={key: float(value) for key, value in sorted((table.model_extra or {}).items())},
            tolerance=table.tolerance,
        ),
        base=document.base,
        joints=document.joints(),
        links=document.links(),
        beam=document.beam.expanded() if isinstance(document.beam, BeamEntry) else None,
        tip=document.tip,
        inputs=inputs,
        outputs=outputs,
        initial=initial,
        emit=document.emit,
        control=document.control,
        source=source,
    )
