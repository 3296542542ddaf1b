"""Inputs of an arm in space as actuators, its outputs as sensors."""

from __future__ import annotations

from dataclasses import dataclass, field
from xml.etree import ElementTree as Xml

from tmm_gen.export.mjcf.bodies import text_of
from tmm_gen.export.mjcf.readings import Reading
from tmm_gen.export.mjcf.space import quaternion_text
from tmm_gen.scene.spatial.arm import UPRIGHT, ArmInput, ArmOutput, Frame, SpatialArm

_GROUND = Frame("ground", 0)
_SENSORS = {("xyz", 0): "framepos", ("wxyz", 0): "framequat", ("xyz", 1): "framelinvel"}
"""By the components of a frame's motion, and how often it is differentiated."""


@dataclass
class SpaceSignals:
    """Adds what an arm's inputs and outputs need to a model, each helper once.

    Parameters
    ----------
    root : Element
        The model.
    arm : SpatialArm
        What is exported.
    bodies : dict of int to Element
        The base by 0, and bodies by the numbers of the joints that carry them.
    """

    root: Xml.Element
    arm: SpatialArm
    bodies: dict[int, Xml.Element]
    readings: list[Reading] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)
    _sites: dict[Frame, str] = field(default_factory=dict)

    def add(self) -> None:
        """Add actuators and sensors, and the sites they work on."""
        actuators, sensors = Xml.Element("actuator"), Xml.Element("sensor")
        for item in self.arm.inputs:
            self._act(actuators, item)
        for output in self.arm.outputs:
            self._measure(sensors, output)
        self.root.extend(each for each in (actuators, sensors) if len(each))

    def _act(self, actuators: Xml.Element, item: ArmInput) -> None:
        if item.frame is None:
            joint = self.arm.joints[item.joint - 1]
            Xml.SubElement(actuators, "motor", name=item.name, joint=joint.name, gear=text_of(joint.gear))
            return
        if not item.frame.joint and self.arm.base is None:
            self.left_out.append(f"{item.name}: acts on the base, which does not move")
            return
        for number, name in enumerate(item.columns):
            wrench = [0.0] * 6
            wrench[number + 3 * (item.acts == "moment")] = 1.0
            general = Xml.SubElement(
                actuators, "general", name=name, site=self._site(item.frame), gear=text_of(*wrench)
            )
            if item.axes == "world":
                general.set("refsite", self._world())

    def _measure(self, sensors: Xml.Element, output: ArmOutput) -> None:
        name, quantity = output.name, output.quantity
        if quantity.energy == "kinetic":
            Xml.SubElement(sensors, "e_kinetic", name=name)
            self.readings.append(Reading(name, ((name, 0, 1.0),)))
        elif quantity.of_arm:
            self.left_out.append(f"{name}: MuJoCo knows the sum of elastic and gravitational energy only")
        elif quantity.read == "through":
            self._torque(sensors, output)
        elif quantity.read == "force":
            self.left_out.append(f"{name}: MuJoCo measures the forces of single bodies on the base only")
        elif output.frame is not None:
            site = self._site(output.frame)
            kind = _SENSORS[quantity.components, quantity.order]
            Xml.SubElement(sensors, kind, name=name, objtype="site", objname=site)
            self.readings += [
                Reading(column, ((name, number, 1.0),)) for number, column in enumerate(output.columns)
            ]
            if quantity.components == "wxyz":
                self.left_out.append(
                    f"{name}: all four numbers may have the other sign, the same orientation"
                )
        elif quantity.order > 1:
            told = " and ".join(f"'{self.arm.joints[number - 1].name}'" for number in output.turning)
            of = f"the sum of those of joints {told}" if output.gear else f"that of joint {told}"
            self.left_out.append(f"{name}: no sensor measures it; as qacc it is {of}")
        else:
            kind = ("jointpos", "jointvel")[quantity.order]
            joints = [self.arm.joints[number - 1].name for number in output.turning]
            names = [name, f"{name}_{joints[-1]}"][: len(joints)]
            for sensor, joint in zip(names, joints, strict=True):
                Xml.SubElement(sensors, kind, name=sensor, joint=joint)
            self.readings.append(Reading(name, tuple((sensor, 0, 1.0) for sensor in names)))

    def _torque(self, sensors: Xml.Element, output: ArmOutput) -> None:
        """Read what a joint passes on: its motor's torque, less its spring's and its damper's."""
        joint, name = self.arm.joints[output.passing - 1], output.name
        terms: list[tuple[str, int, float]] = []
        for item in self.arm.inputs:
            if item.joint == output.passing:
                Xml.SubElement(sensors, "actuatorfrc", name=f"{name}_{item.name}", actuator=item.name)
                terms.append((f"{name}_{item.name}", 0, joint.gear))
        for part, kind, factor in (
            ("spring", "jointpos", joint.stiffness),
            ("damper", "jointvel", joint.damping),
        ):
            if factor:
                Xml.SubElement(sensors, kind, name=f"{name}_{part}", joint=joint.name)
                terms.append((f"{name}_{part}", 0, -factor))
        self.readings.append(Reading(name, tuple(terms), joint.stiffness * joint.rest))

    def _world(self) -> str:
        """Return a site with the axes of the world."""
        if self.arm.base is None:
            return self._site(_GROUND)
        world = self.root.find("worldbody")
        assert world is not None
        if _GROUND not in self._sites:
            Xml.SubElement(world, "site", name=_GROUND.name)
            self._sites[_GROUND] = _GROUND.name
        return self._sites[_GROUND]

    def _site(self, frame: Frame) -> str:
        if frame not in self._sites:
            site = Xml.SubElement(self.bodies[frame.joint], "site", name=frame.name, pos=text_of(*frame.at))
            if frame.turn != UPRIGHT:
                site.set("quat", quaternion_text(frame.turn))
            self._sites[frame] = frame.name
        return self._sites[frame]
