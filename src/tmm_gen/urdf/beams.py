"""Links that become beams: the line each runs along, its numbers, and what stands on which of its ends."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tmm_gen.urdf.entries import Entry
from tmm_gen.urdf.faults import Faults
from tmm_gen.urdf.flexibility import LinkGives
from tmm_gen.urdf.placement import Floats, Place
from tmm_gen.urdf.robot import RobotJoint, RobotLink
from tmm_gen.urdf.weights import own_inertia

_ALONG = 0.9
"""Cosine of the angle to the line from which on an axis is no good to say how a beam stands about it."""


@dataclass(frozen=True, eq=False)
class BeamLine:
    """The line of a beam in the frame of its link.

    Parameters
    ----------
    end : array, shape (3,)
        From the link's origin, m.
    length : float
        m.
    turn : Place
        The beam's axes: x along the line.
    across : str
        Axis of the link that the beam's y axis follows.
    to : str
        What is at the end, in words.
    """

    end: Floats
    length: float
    turn: Place
    across: str
    to: str

    def nearer_end(self, joint: RobotJoint) -> bool:
        """Whether a joint stands nearer to the beam's outer end than to its root."""
        at = joint.origin.at
        return bool(np.linalg.norm(at - self.end) <= np.linalg.norm(at))

    def beyond(self, joint: RobotJoint) -> Place:
        """Return a joint's place in the frame of the beam's outer end."""
        back = self.turn.turn.T
        if np.array_equal(back, np.eye(3)):
            return Place(joint.origin.at - self.end, joint.origin.turn, joint.origin.rpy)
        return Place(back @ (joint.origin.at - self.end), back @ joint.origin.turn)


def beam_line(
    link: RobotLink, gives: LinkGives, leaving: Sequence[RobotJoint], faults: Faults
) -> BeamLine | None:
    """Return the line of a link that bends, None where there is none, which is a fault."""
    key = f"link.{link.name}"
    chosen = [joint for joint in leaving if gives.to in (None, joint.name)]
    if gives.end is not None:
        end, to = np.array(gives.end), "the end given"
    elif len(chosen) == 1:
        end, to = chosen[0].origin.at, f"joint '{chosen[0].name}'"
    elif chosen:
        listed = ", ".join(joint.name for joint in chosen)
        faults.add(
            gives.line,
            key,
            f"carries several joints: {listed}",
            f'Say to which the beam reaches: `to = "{chosen[0].name}"`.',
        )
        return None
    else:
        faults.add(
            gives.line,
            key,
            "carries no joint that would say where the beam ends",
            "Write its end in the link's frame, for example `end = [0.3, 0.0, 0.0]`.",
        )
        return None
    length = float(np.linalg.norm(end))
    if length == 0.0:
        faults.add(
            gives.line,
            key,
            f"has no length: {to} is where it begins",
            "Write the end of the beam in the link's frame, for example `end = [0.3, 0.0, 0.0]`.",
        )
        return None
    along = end / length
    number = 1 if abs(along[1]) <= _ALONG else 2
    across = np.eye(3)[number] - along[number] * along
    across /= np.linalg.norm(across)
    turn = np.column_stack([along, across, np.cross(along, across)])
    return BeamLine(end, length, Place(np.zeros(3), turn), "xyz"[number], to)


def beam_entry(link: RobotLink, gives: LinkGives, line: BeamLine, faults: Faults) -> Entry:
    """Return the table of a beam, all but its name and where it hangs; without mass it is a fault."""
    entry, key = Entry("[[beam]]"), f"link.{link.name}"
    mass = 0.0 if link.inertial is None else link.inertial.mass
    if mass == 0.0:
        faults.add(
            gives.line,
            key,
            "has no mass in the URDF, and a beam's mass is that of its link",
            "Give the link an <inertial> with a mass, or leave it rigid.",
        )
    entry.decisions += [
        f"link '{link.name}' bends: a beam from its joint to {line.to}",
        f"its y axis follows the link's {line.across} axis",
        f"its mass, {mass:g} kg as in the URDF, is spread evenly; centre and inertia of the <inertial> are not used",
    ]
    entry.put("length", line.length)
    entry.put("bending_stiffness", gives.bending)
    entry.put("mass_per_length", mass / line.length)
    if gives.torsion is not None:
        entry.put("torsional_stiffness", gives.torsion)
        polar = gives.polar
        if polar is None and gives.gyration is not None:
            polar = gives.gyration * mass / line.length
            entry.decisions.append("polar inertia from section and mass")
        elif polar is None and link.inertial is not None:
            along = line.turn.turn[:, 0]
            polar = float(along @ own_inertia(link.inertial) @ along) / line.length
            entry.decisions.append(
                "polar inertia from the <inertial>, about the line through its centre of mass"
            )
        if not polar or polar < 0.0:
            faults.add(
                gives.line,
                key,
                "twists and has no inertia about its line",
                "Add for example `polar_inertia_per_length = 1e-4`.",
            )
        else:
            entry.put("polar_inertia_per_length", polar)
    else:
        entry.decisions.append("no twist: neither G nor torsional_stiffness is given")
    entry.put("links", gives.links)
    if gives.damping_time:
        entry.put("damping_time", gives.damping_time)
    return entry
