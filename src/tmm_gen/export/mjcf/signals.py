"""Inputs of a scene as actuators, outputs as sensors."""

from __future__ import annotations

from dataclasses import dataclass, field
from xml.etree import ElementTree as Xml

from tmm_gen.export.mjcf.bodies import Bodies, joint_names, text_of
from tmm_gen.export.mjcf.readings import Reading
from tmm_gen.scene import Input, Output, Scene, station_of

_AXES = {"force_x": (1, 0), "force_y": (0, 1)}


@dataclass
class Signals:
    """Adds what a scene's inputs and outputs need to a model, each helper once.

    Parameters
    ----------
    root : Element
        The model.
    scene : Scene
        What is exported.
    bodies : Bodies
        Where signals are tied to.
    """

    root: Xml.Element
    scene: Scene
    bodies: Bodies
    readings: list[Reading] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)
    _sites: dict[str, str] = field(default_factory=dict)
    _sums: dict[int, str] = field(default_factory=dict)

    def add(self) -> None:
        """Add actuators, sensors, and the sites and tendons they work on."""
        tendons = Xml.SubElement(self.root, "tendon")
        actuators = Xml.SubElement(self.root, "actuator")
        sensors = Xml.SubElement(self.root, "sensor")
        self._tendons, self._sensors = tendons, sensors
        for item in self.scene.inputs:
            self._act(actuators, item)
        for output in self.scene.outputs:
            self._measure(output)
        for empty in [each for each in (tendons, actuators, sensors) if len(each) == 0]:
            self.root.remove(empty)

    def _act(self, actuators: Xml.Element, item: Input) -> None:
        station = station_of(item.at, self.scene.stations)
        if item.acts == "drive":
            joint, gear = self._joint(station), self.scene.joints[station - 1].gear
            Xml.SubElement(actuators, "motor", name=item.name, joint=joint, gear=text_of(gear))
            return
        if item.acts == "torque":
            # on a body, against ground: it turns with the sum of the hinges up to there
            turning = {"tendon": self._angle(station), "gear": f"{item.factor:.17g}"}
            Xml.SubElement(actuators, "motor", turning, name=item.name)
            return
        x, y = _AXES[item.acts]
        Xml.SubElement(
            actuators,
            "general",
            name=item.name,
            site=self._end(station),
            refsite=self._site("ground", self.bodies.ground, 0.0),
            gear=text_of(x, y, 0, 0, 0, 0),
        )

    def _measure(self, output: Output) -> None:
        name, quantity = output.name, self.scene.quantity(output)
        station = station_of(output.at, self.scene.stations)
        beyond = self.scene.tip is not None and output.at == "tip"
        if quantity.energy == "kinetic":
            Xml.SubElement(self._sensors, "e_kinetic", name=name)
            self._read(name, (name, 0, 1.0))
        elif quantity.of_arm:
            self._leave_out(output, "MuJoCo knows the sum of elastic and gravitational energy only")
        elif quantity.read == "bend":
            kind, host = ("jointpos", "jointvel")[quantity.order], self.scene.host(station)
            Xml.SubElement(self._sensors, kind, name=name, joint=self._joint(station))
            terms = [(name, 0, 1.0)]
            if self.scene.inner(station) != host:
                Xml.SubElement(self._sensors, kind, name=f"{name}_motor", joint=self._joint(host))
                terms.append((f"{name}_motor", 0, 1.0))
            self._read(name, *terms)
        elif quantity.read == "through":
            self._through(name, self.scene.joints_of(output))
        elif quantity.read == "motion" and quantity.order < 2:
            kind = ("tendonpos", "tendonvel")[quantity.order]
            Xml.SubElement(self._sensors, kind, name=name, tendon=self._angle(station))
            self._read(name, (name, 0, output.factor))
        elif quantity.read == "motion":
            end = self._end(station)
            Xml.SubElement(self._sensors, "frameangacc", name=name, objtype="site", objname=end)
            self._read(name, (name, 2, output.factor))
        elif quantity.read == "place":
            kind = ("framepos", "framelinvel", "framelinacc")[quantity.order]
            Xml.SubElement(self._sensors, kind, name=name, objtype="site", objname=self._end(station))
            # like an accelerometer, the sensor takes gravity for an acceleration upward
            falling = -(self.scene.model.gravity or 0.0) if quantity.order == 2 else 0.0
            self._read(f"{name}_x", (name, 0, 1.0))
            self._read(f"{name}_y", (name, 1, 1.0), constant=falling)
        elif quantity.read == "own" and not beyond:
            self._joint_torque(name, max(station, 1), output.factor)
        elif quantity.read == "force" and output.at == "base" and not self._pushed:
            # what link 1 and all beyond it do to the ground, in the axes of the ground
            site = self._site("ground", self.bodies.ground, 0.0)
            Xml.SubElement(self._sensors, "force", name=name, site=site)
            self._read(f"{name}_x", (name, 0, 1.0))
            self._read(f"{name}_y", (name, 1, 1.0))
        else:
            self._leave_out(output, "no sensor of MuJoCo measures it in the axes of the ground")

    @property
    def _pushed(self) -> bool:
        """Whether forces act: MuJoCo's joints then seem to carry them, as if actuators stood on the arm."""
        return any(item.acts in _AXES for item in self.scene.inputs)

    def _joint_torque(self, name: str, station: int, factor: float) -> None:
        joint, shafts = self.scene.joints[station - 1], self.scene.drivetrain
        over = {"tendon": joint_names(self.scene)[station - 1]} if shafts else {"joint": self._joint(station)}
        terms = []
        for part, kind, value in (("spring", "pos", joint.stiffness), ("damper", "vel", joint.damping)):
            if value:
                kind = ("tendon" if shafts else "joint") + kind
                Xml.SubElement(self._sensors, kind, over, name=f"{name}_{part}")
                terms.append((f"{name}_{part}", 0, factor * value))
        self._read(name, *terms)

    def _through(self, name: str, joints: tuple[int, ...]) -> None:
        """Read what joints' inner sides exert on the outer ones: motor, spring, damper, less what the rotor takes."""
        terms: list[tuple[str, int, float]] = []

        def measured(part: str, kind: str, factor: float, index: int = 0, **of: str) -> None:
            Xml.SubElement(self._sensors, kind, {"name": f"{name}_{part}", **of})
            terms.append((f"{name}_{part}", index, factor))

        for station in joints:
            joint, at = self.scene.joints[station - 1], self._joint(station)
            for item in self.scene.inputs:
                if item.acts == "drive" and item.at == station:
                    measured(item.name, "actuatorfrc", joint.gear, actuator=item.name)
            if joint.stiffness:
                measured(f"spring_of_{at}", "jointpos", -joint.stiffness, joint=at)
            if joint.damping:
                measured(f"damper_of_{at}", "jointvel", -joint.damping, joint=at)
            if joint.rotor_inertia:
                for side, number, sign in (
                    ("outer", station, -1.0),
                    ("inner", self.scene.host(station), 1.0),
                ):
                    if number:
                        site = {"objtype": "site", "objname": self._end(number)}
                        measured(f"{side}_of_{at}", "frameangacc", sign * joint.armature, 2, **site)
        slack = sum(self.scene.joints[k - 1].stiffness * self.scene.joints[k - 1].rest for k in joints)
        self._read(name, *terms, constant=slack)

    def _way_to(self, station: int) -> list[int]:
        """Return the numbers of the joints whose angles add up to a link's, inward; the hub's is 0."""
        if self.scene.drivetrain:
            return [station]
        found = []
        while station > 0:
            found.append(station)
            station = self.scene.host(station)
        return [*found, 0] if self.scene.hub else found

    def _joint(self, station: int) -> str:
        return self.bodies.joints[station - 1 + self.scene.hub]

    def _angle(self, station: int) -> str:
        """Return the tendon whose length is the absolute angle of a station, 0 for the hub."""
        if station not in self._sums:
            label = "angle_of_hub" if station == 0 else f"angle_of_link{station}"
            tendon = Xml.SubElement(self._tendons, "fixed", name=label)
            for number in reversed(self._way_to(station)):
                Xml.SubElement(
                    tendon, "joint", joint=self.bodies.joints[number - 1 + self.scene.hub], coef="1"
                )
            self._sums[station] = label
        return self._sums[station]

    def _end(self, station: int) -> str:
        """Return a site at the outer end of a link."""
        if station == 0:
            if self.scene.floats:
                return self._site("hub", self.bodies.base, 0.0)
            return self._site("ground", self.bodies.ground, 0.0)
        if station == self.scene.stations:
            return self._site("tip", self.bodies.tip, 0.0)
        link = self.scene.links[station - 1]
        return self._site(f"end{station}", self.bodies.links[station - 1], link.length)

    def _site(self, name: str, body: Xml.Element, along: float) -> str:
        if name not in self._sites:
            Xml.SubElement(body, "site", name=name, pos=text_of(along, 0.0, 0.0))
            self._sites[name] = name
        return name

    def _read(self, name: str, *terms: tuple[str, int, float], constant: float = 0.0) -> None:
        self.readings.append(Reading(name, terms, constant))

    def _leave_out(self, output: Output, why: str) -> None:
        self.left_out.append(f"{output.name}: {output.of} at {output.part or output.at} is left out, {why}")
