"""Arms by parts for the tests of this folder."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
import pytest

from tmm_gen.scene import Scene, parse_scene

ELBOW = """\
name = "bent"

[model]
kind = "planar"
gravity = 9.81

[integrator]
name = "newmark"
step = 1e-3

[base]
kind = "clamp"

[[motor]]
name = "shoulder"
rotor_inertia = 2e-5
gear = 100
damping = 0.02

[[beam]]
name = "upper"
on = "shoulder"
length = 0.5
bending_stiffness = 14.0
mass_per_length = 0.16
links = 2
damping_time = 2e-3

[[body]]
name = "housing"
on = "upper"
mass = 0.2
inertia = 1e-4

[[motor]]
name = "elbow"
on = "upper"
rotor_inertia = 1e-5
gear = 50
damping = 0.01

[[link]]
name = "forearm"
on = "elbow"
length = 0.3
mass = 0.2
inertia = 2e-3
center = 0.4

[[joint]]
name = "hinge"
on = "forearm"
stiffness = 3.0
rest = 0.2

[[link]]
name = "hand"
on = "hinge"
length = 0.1
mass = 0.05
inertia = 1e-4

[[body]]
name = "tool"
on = "hand"
mass = 0.1
inertia = 1e-4

[[input]]
name = "shoulder_torque"
at = "shoulder"
acts = "torque"

[[input]]
name = "elbow_torque"
at = "elbow"
acts = "torque"

[[input]]
name = "hinge_torque"
at = "hinge"
acts = "torque"

[[input]]
name = "push"
at = "forearm"
acts = "force_y"

[[output]]
name = "tool"
at = "tool"
of = "position"
"""


@pytest.fixture(scope="session")
def elbow_text() -> str:
    """Return a scene with a part of every kind."""
    return ELBOW


def written(tables: Iterable[tuple[str, dict[str, Any]]], name: str = "drawn") -> str:
    """Write tables as TOML."""
    lines = [f'name = "{name}"']
    for header, keys in tables:
        lines += [f"[{header}]", *(f"{key} = {json.dumps(value)}" for key, value in keys.items())]
    return "\n".join(lines) + "\n"


def drawn_arm(
    seed: int,
    count: int,
    *,
    integrator: str = "newmark",
    step: float = 1e-3,
    branching: bool = False,
    floating: bool = False,
    **model: Any,
) -> Scene:
    """Return a random arm of so many parts, in shuffled order, with every input and output."""
    random = np.random.default_rng(seed)
    hung: list[tuple[str, dict[str, Any]]] = []
    turning, solid = [], []
    on = "base"
    kind = str(random.choice(["clamp", "motor", "prescribed"], p=[0.6, 0.2, 0.2]))
    kind = "free" if floating else kind
    for number in range(count):
        name = f"part{number}"
        if number % 2 == 0:
            if branching:
                on = str(random.choice(["base", *solid]))
            on = _turns(random, hung, name, on, elastic=branching)
            turning.append(name)
        else:
            on = _solid(random, hung, name, on)
            solid.append(name)
    if count % 2:
        solid.append("last")
        on = _solid(random, hung, "last", on)
    for name in solid:
        if random.uniform() < 0.4:
            mass, inertia = random.uniform(0.05, 0.4), random.uniform(0.0, 1e-3)
            hung.append(("[body]", {"name": f"body_{name}", "on": name, "mass": mass, "inertia": inertia}))
    if floating:
        hub = {"mass": random.choice([0.0, random.uniform(0.1, 2.0)]), "inertia": random.uniform(1e-3, 0.02)}
        hung.append(("[body]", {"name": "hub", "on": "base", **hub}))
    random.shuffle(hung)  # type: ignore[arg-type]
    base: dict[str, Any] = {"kind": kind} | ({"inertia": 0.05, "damping": 0.1} if kind == "motor" else {})
    inputs = [(f"torque_{name}", name, "torque") for name in turning]
    inputs += [("push", solid[0], "force_x"), ("twist", solid[-1], "torque"), ("lift", solid[-1], "force_y")]
    inputs += [("hub_push", "base", "force_x"), ("hub_lift", "base", "force_y")] * floating
    inputs += [("hub_turn", "base", "torque")] * (kind in ("motor", "free")) + [
        ("hub_angle", "base", "angle")
    ] * (kind == "prescribed")
    outputs = [
        (f"{of}_in_{name}", name, of) for name in turning for of in ("angle", "rate", "torque", "force")
    ]
    motions = ("position", "angle", "rate", "velocity", "acceleration")
    outputs += [(f"{of}_{name}", name, of) for name in (solid[0], solid[-1]) for of in motions]
    outputs += [
        (f"{what}_energy", "arm", f"{what}_energy") for what in ("kinetic", "elastic", "gravitational")
    ]
    outputs += [("heat", "arm", "dissipated_energy")]
    of_base = motions if floating else ("torque", "force") if branching and kind != "motor" else ()
    outputs += [(f"{of}_at_base", "base", of) for of in of_base]
    start = {key: random.uniform(-0.4, 0.4, len(solid)).round(3).tolist() for key in ("angles", "rates")}
    tables = [
        ("model", {"kind": "planar", "gravity": 9.81, **model}),
        ("integrator", {"name": integrator, "step": step}),
        ("base", base),
        *hung,
        *(("[input]", {"name": n, "at": at, "acts": acts}) for n, at, acts in inputs),
        *(("[output]", {"name": n, "at": at, "of": of}) for n, at, of in dict.fromkeys(outputs)),
        ("initial", start),
    ]
    return parse_scene(written(tables))


def _turns(random: np.random.Generator, hung: list[Any], name: str, on: str, *, elastic: bool) -> str:
    keys: dict[str, Any] = {"name": name, "on": on}
    if random.uniform() < 0.2:
        keys["damping"] = 0.0
    else:
        keys["damping"] = random.uniform(0.01, 0.2)
    if random.uniform() < 0.5:
        keys |= {"rotor_inertia": random.uniform(0.0, 3e-5), "gear": float(random.choice([1.0, 20.0, 100.0]))}
        if elastic and random.uniform() < 0.5:
            keys |= {
                "rotor_inertia": 1e-5 if keys["gear"] > 1.0 else 1e-2,
                "stiffness": random.uniform(50, 500),
            }
            keys |= {"damping_time": 0.001, "motor_damping": 1e-6}
        hung.append(("[motor]", keys))
    else:
        keys |= {"stiffness": float(random.choice([0.0, random.uniform(3.0, 30.0)]))}
        keys |= {"rest": float(random.choice([0.0, random.uniform(-0.4, 0.4)]))}
        hung.append(("[joint]", keys))
    return name


def _solid(random: np.random.Generator, hung: list[Any], name: str, on: str) -> str:
    length = random.uniform(0.2, 0.5)
    if random.uniform() < 0.4:
        keys = {"bending_stiffness": random.uniform(2.0, 10.0), "mass_per_length": random.uniform(0.2, 0.6)}
        keys |= {"links": int(random.integers(1, 4)), "damping_time": 0.002}
        hung.append(("[beam]", {"name": name, "on": on, "length": length, **keys}))
    else:
        mass = random.uniform(0.1, 0.6)
        keys = {
            "mass": mass,
            "inertia": random.uniform(0.05, 0.2) * mass * length**2,
            "center": random.uniform(),
        }
        hung.append(("[link]", {"name": name, "on": on, "length": length, **keys}))
    return name


@pytest.fixture(scope="session")
def drawn() -> Callable[..., Scene]:
    """Return a function that draws arms."""
    return drawn_arm


@pytest.fixture(scope="session")
def hanging() -> Callable[[int], Scene]:
    """Return a function that makes a chain of 1 m of n links on free hinges, hanging."""

    def make(n: int, **changes: object) -> Scene:
        tables: list[tuple[str, dict[str, Any]]] = [
            ("model", {"kind": "planar", "gravity": 9.81}),
            ("integrator", {"name": "newmark", "step": 1e-3}),
            ("base", {"kind": "clamp"}),
        ]
        length, mass = 1.0 / n, 0.5 / n
        for k in range(n):
            on = f"link{k - 1}" if k else "base"
            tables.append(("[joint]", {"name": f"hinge{k}", "on": on}))
            keys = {"length": length, "mass": mass, "inertia": mass * length**2 / 12}
            tables.append(("[link]", {"name": f"link{k}", "on": f"hinge{k}", **keys}))
        tables.append(("[output]", {"name": "tip", "at": f"link{n - 1}", "of": "position"}))
        tables.append(("initial", {"angles": -np.pi / 2}))
        return parse_scene(written(tables, "hanging")).replace(**changes)

    return make
