"""A robot's kinematics and mass matrix by its URDF alone, read by other means and worked out in world axes.

Nothing of tmm-gen is used: links are placed one by one, fixed ones as all others, and the mass matrix is the sum over
links of what their Jacobians make of masses and inertias.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from xml.etree import ElementTree

import numpy as np
from scipy.spatial.transform import Rotation


def _child(element: ElementTree.Element, tag: str) -> ElementTree.Element:
    found = element.find(tag)
    assert found is not None, tag
    return found


def _numbers(element: ElementTree.Element | None, name: str, default: str) -> np.ndarray:
    text = default if element is None else element.get(name, default)
    return np.array([float(word) for word in text.split()])


def _origin(element: ElementTree.Element) -> tuple[np.ndarray, np.ndarray]:
    origin = element.find("origin")
    # capital letters: about axes that turn along; z y x of those is x y z of fixed ones
    roll, pitch, yaw = _numbers(origin, "rpy", "0 0 0")
    return _numbers(origin, "xyz", "0 0 0"), Rotation.from_euler("ZYX", [yaw, pitch, roll]).as_matrix()


@dataclass
class UrdfTruth:
    """A robot.

    Parameters
    ----------
    text : str
        Its URDF: a tree of fixed joints and such that turn.
    """

    text: str

    def __post_init__(self) -> None:
        self.root = ElementTree.fromstring(self.text)
        self.joints = {joint.attrib["name"]: joint for joint in self.root.findall("joint")}
        self.turning = [n for n, j in self.joints.items() if j.get("type") in ("revolute", "continuous")]
        self.carrier = {_child(j, "child").attrib["link"]: j for j in self.joints.values()}

    def places(self, angles: dict[str, float]) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """Return position and rotation of each link's frame in world axes, by its name."""
        found: dict[str, tuple[np.ndarray, np.ndarray]] = {}

        def place(link: str) -> tuple[np.ndarray, np.ndarray]:
            if link not in found:
                joint = self.carrier.get(link)
                if joint is None:
                    found[link] = (np.zeros(3), np.eye(3))
                else:
                    at, turn = place(_child(joint, "parent").attrib["link"])
                    xyz, rotation = _origin(joint)
                    turned = Rotation.from_rotvec(self.axis(joint) * angles.get(joint.attrib["name"], 0.0))
                    found[link] = (at + turn @ xyz, turn @ rotation @ turned.as_matrix())
            return found[link]

        for link in self.root.findall("link"):
            place(link.attrib["name"])
        return found

    def axis(self, joint: ElementTree.Element) -> np.ndarray:
        """Return the axis of a joint in its own frame, a unit vector."""
        axis = _numbers(joint.find("axis"), "xyz", "1 0 0")
        unit: np.ndarray = axis / np.linalg.norm(axis)
        return unit

    def behind(self, link: str) -> set[str]:
        """Return the names of joints that move a link."""
        found = set()
        while (joint := self.carrier.get(link)) is not None:
            found.add(joint.attrib["name"])
            link = _child(joint, "parent").attrib["link"]
        return found

    def mass_matrix(self, angles: dict[str, float]) -> np.ndarray:
        """Return the mass matrix, joints in the order of `turning`."""
        matrix = np.zeros((len(self.turning),) * 2)
        for mass, center, inertia, moves, spins in self._links(angles):
            del center
            matrix += mass * moves.T @ moves + spins.T @ inertia @ spins
        return matrix

    def weight(self, angles: dict[str, float], gravity: np.ndarray) -> np.ndarray:
        """Return the torque of gravity in each joint, in the order of `turning`."""
        return sum(
            (mass * moves.T @ gravity for mass, _, _, moves, _ in self._links(angles)),
            np.zeros(len(self.turning)),
        )

    def _links(
        self, angles: dict[str, float]
    ) -> Iterator[tuple[float, np.ndarray, np.ndarray, np.ndarray, np.ndarray]]:
        """Yield mass, centre, inertia in world axes and both Jacobians of each link that weighs."""
        places = self.places(angles)
        for link in self.root.findall("link"):
            inertial = link.find("inertial")
            if inertial is None:
                continue
            at, turn = places[link.attrib["name"]]
            xyz, rotation = _origin(inertial)
            center, axes = at + turn @ xyz, turn @ rotation
            given = {k: float(v) for k, v in _child(inertial, "inertia").attrib.items()}
            own = np.array([[given.get(f"i{min(a, b)}{max(a, b)}", 0.0) for b in "xyz"] for a in "xyz"])
            moves, spins = (np.zeros((3, len(self.turning))) for _ in range(2))
            behind = self.behind(link.attrib["name"])
            for k, name in enumerate(self.turning):
                if name in behind:
                    joint = self.joints[name]
                    point, frame = places[_child(joint, "child").attrib["link"]]
                    spins[:, k] = frame @ self.axis(joint)
                    moves[:, k] = np.cross(spins[:, k], center - point)
            yield float(_child(inertial, "mass").attrib["value"]), center, axes @ own @ axes.T, moves, spins
