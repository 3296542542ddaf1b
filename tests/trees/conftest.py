"""Branched arms for the tests of this folder."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import pytest

from tmm_gen.scene import Scene, parse_scene

HEAD = """\
name = "fork"
[model]
kind = "planar"
gravity = 0.0
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "clamp"
"""

STEM = """
[[beam]]
name = "stem"
on = "base"
length = 0.3
bending_stiffness = 2.0
mass_per_length = 0.4
links = 2
damping_time = 1e-3
"""

LEFT = """
[[joint]]
name = "left"
on = "stem"
stiffness = 2.0
damping = 0.01
rest = 0.6
[[link]]
name = "left_arm"
on = "left"
length = 0.15
mass = 0.1
inertia = 2e-4
center = 0.3
[[joint]]
name = "knee"
on = "left_arm"
stiffness = 0.6
damping = 2e-3
rest = -0.4
[[link]]
name = "shin"
on = "knee"
length = 0.1
mass = 0.05
inertia = 5e-5
"""

RIGHT = """
[[motor]]
name = "right"
on = "stem"
rotor_inertia = 1e-5
gear = 10.0
damping = 0.02
[[beam]]
name = "rod"
on = "right"
length = 0.2
bending_stiffness = 0.3
mass_per_length = 0.2
links = 2
[[body]]
name = "weight"
on = "rod"
mass = 0.03
inertia = 1e-5
"""

BACK = """
[[joint]]
name = "back"
on = "stem"
stiffness = 0.9
damping = 3e-3
rest = -1.3
[[link]]
name = "back_arm"
on = "back"
length = 0.12
mass = 0.08
inertia = 1e-4
center = 0.7
"""

PROP = """
[[joint]]
name = "prop"
on = "base"
stiffness = 3.0
damping = 0.005
rest = 2.0
[[link]]
name = "prop_arm"
on = "prop"
length = 0.2
mass = 0.15
inertia = 6e-4
"""

TAIL = """
[[input]]
name = "turn"
at = "right"
acts = "torque"
[[input]]
name = "push"
at = "shin"
acts = "force_y"
[[input]]
name = "twist"
at = "stem"
acts = "torque"
[[output]]
name = "shin"
at = "shin"
of = "position"
[[output]]
name = "weight"
at = "weight"
of = "velocity"
[[output]]
name = "bend"
at = "right"
of = "angle"
[[output]]
name = "left_bend"
at = "left"
of = "angle"
[[output]]
name = "left_force"
at = "left"
of = "force"
[[output]]
name = "right_torque"
at = "right"
of = "torque"
[[output]]
name = "prop_arm"
at = "prop_arm"
of = "angle"
[[output]]
name = "base_torque"
at = "base"
of = "torque"
[[output]]
name = "base_force"
at = "base"
of = "force"
[[output]]
name = "prop_torque"
at = "prop"
of = "torque"
"""

FINGER = """
[[joint]]
name = "{side}"
on = "{on}"
stiffness = 0.8
damping = 1e-3
rest = {rest}
[[link]]
name = "{side}_near"
on = "{side}"
length = 0.1
mass = 0.05
inertia = 4e-5
[[joint]]
name = "{side}_knuckle"
on = "{side}_near"
stiffness = 0.3
damping = 5e-4
rest = {bent}
[[link]]
name = "{side}_far"
on = "{side}_knuckle"
length = 0.06
mass = 0.02
inertia = 1e-5
[[output]]
name = "out_{side}"
at = "{side}_far"
of = "angle"
"""

PALM = """
[[joint]]
name = "wrist"
stiffness = 5.0
[[link]]
name = "palm"
on = "wrist"
length = 0.08
mass = {mass}
inertia = {inertia}
"""

BRANCHES = {"left": LEFT, "right": RIGHT, "back": BACK}
AS_SLACK = {"left_arm": 0.6, "shin": 0.2, "rod": -0.5, "back_arm": -1.3, "prop_arm": 2.0}
"""Absolute angles at the start, rad: as the springs are slack, and a motor without one is turned."""


def fork_text(order: Sequence[str] = tuple(BRANCHES)) -> str:
    """Return a stem that carries branches in some order, beside a prop on the same base."""
    return "".join([HEAD, STEM, *(BRANCHES[name] for name in order), PROP, TAIL])


@pytest.fixture
def fork() -> Callable[..., Scene]:
    """The arm with branches in an order, links by the parts' names at angles, and some keys changed."""

    def made(
        angles: Mapping[str, float] = AS_SLACK, order: Sequence[str] = tuple(BRANCHES), **changes: object
    ) -> Scene:
        text = fork_text(order)
        if changes.get("base", {}).get("kind") == "motor":  # type: ignore[attr-defined]
            text = text.replace('kind = "clamp"', 'kind = "motor"\ninertia = 0.02\ndamping = 0.01')
            text = text.replace('at = "base"\nof = "torque"', 'at = "base"\nof = "angle"')
            text = text.replace('at = "base"\nof = "force"', 'at = "base"\nof = "rate"')
        scene = parse_scene(text)
        start = [angles.get(part.name, 0.0) for part in scene.parts if part.kind in ("beam", "link")]
        return scene.replace(**{"initial.angles": start, **changes})

    return made


@pytest.fixture
def fork_file(tmp_path: Path) -> Path:
    """The arm in a file."""
    path = tmp_path / "fork.toml"
    path.write_text(fork_text())
    return path


def hand_text(mass: float, inertia: float, sides: tuple[str, ...] = ("left", "right")) -> str:
    """Return a palm with two fingers alike, or one finger on the base."""
    palm = PALM.format(mass=mass, inertia=inertia) if len(sides) > 1 else ""
    signs = {"left": 1.0, "right": -1.0}
    on = "palm" if palm else "base"
    fingers = [FINGER.format(side=s, on=on, rest=0.5 * signs[s], bent=0.3 * signs[s]) for s in sides]
    return "".join([HEAD, palm, *fingers])


@pytest.fixture
def hand() -> Callable[..., Scene]:
    """The same as a scene."""
    return lambda *values, **more: parse_scene(hand_text(*values, **more))


@pytest.fixture
def hand_file(tmp_path: Path) -> Path:
    """A palm with two fingers in gravity, in a file."""
    path = tmp_path / "hand.toml"
    path.write_text(hand_text(0.1, 1e-4).replace("gravity = 0.0", "gravity = 9.81"))
    return path
