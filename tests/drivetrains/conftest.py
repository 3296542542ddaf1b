"""Drivetrains drawn at random, and their equations of motion written apart, part by part."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from tmm_gen.scene import Scene, parse_scene

Array = NDArray[np.float64]
Tables = list[tuple[str, dict[str, Any]]]


def written(tables: Iterable[tuple[str, dict[str, Any]]], name: str = "drawn") -> str:
    """Write tables as TOML."""
    lines = [f'name = "{name}"']
    for header, keys in tables:
        lines += [f"[{header}]", *(f"{key} = {json.dumps(value)}" for key, value in keys.items())]
    return "\n".join(lines) + "\n"


def scene_of(
    parts: Iterable[tuple[str, dict[str, Any]]],
    *,
    base: dict[str, Any] | None = None,
    integrator: str = "newmark",
    step: float = 1e-3,
    signals: Iterable[tuple[str, dict[str, Any]]] = (),
    **model: Any,
) -> Scene:
    """Return a chain of parts, each on the one before it where nothing else is said, with all inputs and outputs."""
    hung: Tables = []
    before = "base"
    for table, keys in parts:
        hung.append((f"[{table}]", {"on": before, **keys}))
        before = keys["name"]
    tables: Tables = [
        ("model", {"kind": "chain", **model}),
        ("integrator", {"name": integrator, "step": step}),
        ("base", base or {"kind": "clamp"}),
        *hung,
        *(signals or _every(hung)),
    ]
    return parse_scene(written(tables))


def _every(hung: Tables) -> Tables:
    """Return an input at every motor and link, and every output that there is."""
    solid = [k["name"] for table, k in hung if table in ("[motor]", "[link]")]
    giving = [k["name"] for table, k in hung if "stiffness" in k]
    found: Tables = [("[input]", {"name": f"on_{n}", "at": n, "acts": "torque"}) for n in solid]
    for of in ("angle", "rate", "acceleration"):
        found += [("[output]", {"name": f"{of}_{n}", "at": n, "of": of}) for n in solid]
    return found + [("[output]", {"name": f"torque_{n}", "at": n, "of": "torque"}) for n in giving]


@dataclass(frozen=True)
class ByHand:
    """``M q'' + C q' + K q = B u``, one coordinate for each shaft that can turn by itself; angles of parts are ``R q``.

    Parameters
    ----------
    mass, damping, stiffness : array, (m, m)
    load : array, (m, parts)
        Of a torque on each part.
    reading : array, (parts, m)
        Angle of each part on its outer side.
    torque : dict from str to (array, float, float)
        Of what gives way: its twist by ``q``, stiffness and damping.
    names : list of str
        Of the parts with inertia.
    """

    mass: Array
    damping: Array
    stiffness: Array
    load: Array
    reading: Array
    torque: dict[str, tuple[Array, float, float]]
    names: list[str]


def by_hand(parts: Tables, base: dict[str, Any] | None = None) -> ByHand:
    """Gather the energies of a row of parts: every gear is a constraint between two angles, put in at once.

    Each part's angle is written by the coordinates: a spring brings a new one, whatever is rigid does not. So no
    inertia or stiffness is ever multiplied by a ratio; the quadratic forms do that.
    """
    kind = (base or {}).get("kind", "clamp")
    turning = kind in ("motor", "free") or parts[0][0] == "motor"
    m = sum("stiffness" in keys for _, keys in parts) + turning
    ground = np.zeros(m)
    if turning:
        ground[0] = 1.0
    number = int(turning)
    mass, damping, stiffness = np.zeros((m, m)), np.zeros((m, m)), np.zeros((m, m))
    if kind == "motor":
        mass += base["inertia"] * np.outer(ground, ground)  # type: ignore[index]
        damping += base.get("damping", 0.0) * np.outer(ground, ground)  # type: ignore[union-attr]
    twists: dict[str, tuple[Array, float, float]] = {}
    names, load, reading = [], [], []
    angles, before = {"base": ground}, "base"
    for table, keys in parts:
        angle = angles[keys.get("on", before)] / keys.get("ratio", 1.0)
        before = keys["name"]
        if "stiffness" in keys:
            twist, damper = np.eye(m)[number] - angle, keys.get("damping", 0.0)
            angle = np.eye(m)[number]
            number += 1
            twists[keys["name"]] = (twist, keys["stiffness"], damper)
            stiffness += keys["stiffness"] * np.outer(twist, twist)
            damping += damper * np.outer(twist, twist)
        if table == "motor":
            rotor = keys.get("gear", 1.0) * angle
            mass += keys["rotor_inertia"] * np.outer(rotor, rotor)
            damping += keys.get("damping", 0.0) * np.outer(angle, angle)
            damping += keys.get("motor_damping", 0.0) * np.outer(rotor, rotor)
        if table == "link":
            mass += keys["inertia"] * np.outer(angle, angle)
        if table in ("motor", "link"):
            names.append(keys["name"])
            load.append(keys.get("gear", 1.0) * angle)
            reading.append(angle)
        angles[keys["name"]] = angle
    return ByHand(mass, damping, stiffness, np.array(load).T, np.array(reading), twists, names)


def drawn_parts(seed: int, count: int, branches: float = 0.0) -> tuple[Tables, dict[str, Any]]:
    """Return a random drivetrain with so many elements that give way, a share of them on a branch, and its base."""
    random = np.random.default_rng(seed)
    parts: Tables = []

    def name() -> str:
        return f"part{len(parts)}"

    def links(most: int) -> None:
        for _ in range(int(random.integers(1, most + 1))):
            parts.append(("link", {"name": name(), "inertia": float(random.uniform(0.02, 0.2))}))
            if random.uniform() < 0.3:
                gear()
                parts.append(("link", {"name": name(), "inertia": float(random.uniform(0.02, 0.2))}))

    def gear(**more: float) -> None:
        ratio = float(random.choice([-1.0, 1.0]) * random.uniform(0.4, 2.5))
        parts.append(("gear", {"name": name(), "ratio": ratio, **more}))

    kind = str(random.choice(["clamp", "rotor", "motor", "free"]))
    base: dict[str, Any] = {"kind": "clamp" if kind == "rotor" else kind}
    if kind == "motor":
        base |= {"inertia": 0.1, "damping": 0.05}
    if kind == "rotor":
        keys = {"rotor_inertia": 0.01, "gear": float(random.uniform(1.0, 4.0)), "damping": 0.02}
        keys["motor_damping"] = 0.003
        parts.append(("motor", {"name": name(), **keys}))
    if kind == "free":
        links(1)
    for _ in range(count):
        solid = [keys["name"] for table, keys in parts if table in ("motor", "link")]
        forks = solid + ["base"] * (base["kind"] in ("clamp", "motor") and kind != "rotor")
        fork, begin = str(random.choice(forks or ["base"])), len(parts)
        if random.uniform() < 0.3:
            gear()
        law = {"stiffness": float(random.uniform(5.0, 80.0)), "damping": float(random.uniform(0.0, 0.3))}
        if random.uniform() < 0.4:
            gear(**law)
        else:
            parts.append(("joint", {"name": name(), **law}))
        if random.uniform() < 0.4:
            gear()
        if branches and random.uniform() < branches:
            parts[begin][1]["on"] = fork
        links(2)
    return parts, base


@pytest.fixture(scope="session")
def chain() -> Callable[..., Scene]:
    """Return a function that makes a scene of parts."""
    return scene_of


@pytest.fixture(scope="session")
def equations() -> Callable[..., ByHand]:
    """Return a function that writes the equations of parts by hand."""
    return by_hand


@pytest.fixture(scope="session")
def drawn() -> Callable[..., tuple[Tables, dict[str, Any]]]:
    """Return a function that draws parts and their base."""
    return drawn_parts
