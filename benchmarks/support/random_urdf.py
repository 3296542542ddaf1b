"""Robots drawn at random, as URDF: any axes, turns and full inertias, fixed joints, branches, odd names, any order."""

from __future__ import annotations

from dataclasses import dataclass, field
from xml.sax.saxutils import quoteattr

import numpy as np

QUARTER = np.pi / 2
ODD = ("joint-{}", "arm/joint.{}", "{}th joint", "joint{}", "J{}", "gelenk_ä_{}")


@dataclass
class _Drawing:
    rng: np.random.Generator
    links: list[str] = field(default_factory=list)
    joints: list[str] = field(default_factory=list)
    ends: list[str] = field(default_factory=list)

    def turn(self) -> np.ndarray:
        """None, a quarter turn or two, or any."""
        kind = self.rng.integers(4)
        if kind == 0:
            return np.zeros(3)
        if kind == 1:
            return QUARTER * self.rng.integers(-1, 3, 3)
        return self.rng.uniform(-np.pi, np.pi, 3)

    def axis(self) -> np.ndarray:
        """A frame axis, its opposite, or any vector of any length."""
        kind = self.rng.integers(3)
        if kind == 2:
            drawn: np.ndarray = self.rng.normal(size=3) * 10.0 ** self.rng.uniform(-1, 1)
            return drawn
        along: np.ndarray = np.eye(3)[self.rng.integers(3)] * (1.0 if kind == 0 else -1.0)
        return along

    def link(self, name: str, weighs: bool) -> None:
        """A link with the inertia of some point masses, in turned axes; or without any."""
        inner = ""
        if weighs:
            masses = self.rng.uniform(0.05, 0.5, 5)
            points = self.rng.normal(scale=0.1, size=(5, 3))
            points -= masses @ points / masses.sum()
            inertia = sum(
                m * (p @ p * np.eye(3) - np.outer(p, p)) for m, p in zip(masses, points, strict=True)
            )
            numbers = " ".join(
                f'i{"xyz"[i]}{"xyz"[j]}="{float(inertia[i, j])!r}"' for i in range(3) for j in range(i, 3)
            )
            place = _origin(self.rng.normal(scale=0.1, size=3), self.turn())
            inner = (
                f'<inertial>{place}<mass value="{float(masses.sum())!r}"/><inertia {numbers}/></inertial>'
                '<visual><geometry><sphere radius="0.1"/></geometry></visual>'
            )
        self.links.append(f"<link name={quoteattr(name)}>{inner}</link>")

    def joint(self, name: str, kind: str, parent: str, child: str, extra: str = "") -> None:
        place = _origin(self.rng.normal(scale=0.3, size=3), self.turn())
        ends = f"<parent link={quoteattr(parent)}/><child link={quoteattr(child)}/>"
        self.joints.append(f'<joint name={quoteattr(name)} type="{kind}">{place}{ends}{extra}</joint>')


def _origin(xyz: np.ndarray, rpy: np.ndarray) -> str:
    parts = [f'xyz="{_numbers(xyz)}"'] + ([f'rpy="{_numbers(rpy)}"'] if rpy.any() else [])
    return f"<origin {' '.join(parts)}/>"


def _numbers(values: np.ndarray) -> str:
    return " ".join(repr(float(value)) for value in values)


def random_urdf(seed: int, count: int | None = None, massless: bool = True) -> str:
    """Return a robot as URDF.

    Parameters
    ----------
    seed : int
        Of what is drawn.
    count : int or None
        Joints that turn; None for 3 to 20.
    massless : bool
        Whether some links between two joints have no mass.
    """
    rng = np.random.default_rng(seed)
    count = int(rng.integers(3, 21)) if count is None else count
    drawing = _Drawing(rng)
    drawing.link("world", False)
    hosts = ["world"]
    for number in range(count):
        # mostly on the newest link: rows with branches
        parent = hosts[-1] if rng.random() < 0.75 else hosts[rng.integers(len(hosts))]
        if rng.random() < 0.4:
            flange = f"flange {number}"
            drawing.link(flange, bool(rng.random() < 0.5))
            drawing.joint(f"fixed {number}", "fixed", parent, flange)
            parent = flange
        child = f"link{number}"
        # two joints in a row without mass between them are a universal joint; three could leave a direction without
        weighs = number == count - 1 or not massless or bool(rng.random() < 0.8)
        turning = f'<axis xyz="{_numbers(drawing.axis())}"/>'
        if rng.random() < 0.5:
            turning += f'<dynamics damping="{rng.uniform(0.1, 1.0)!r}" friction="0.1"/>'
        continuous = rng.random() < 0.3
        if not continuous:
            turning += '<limit lower="-3" upper="3" effort="10" velocity="5"/>'
        kind = "continuous" if continuous else "revolute"
        drawing.joint(ODD[rng.integers(len(ODD))].format(number), kind, parent, child, turning)
        drawing.link(child, weighs)
        hosts.append(child)
        if not weighs or rng.random() < 0.2:
            payload = f"payload {number}"
            drawing.joint(f"bolt {number}", "fixed", child, payload)
            drawing.link(payload, True)
    parts = drawing.links + drawing.joints
    rng.shuffle(parts)
    return f'<?xml version="1.0"?>\n<robot name="drawn {seed}">\n' + "\n".join(parts) + "\n</robot>\n"
