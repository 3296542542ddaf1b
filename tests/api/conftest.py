"""Small arms of every kind, derived once."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import pytest

import tmm_gen as tg
from tmm_gen.cli import main

PLANAR: dict[str, Any] = {
    "name": "rod",
    "model": {"kind": "planar", "gravity": 9.81},
    "integrator": {"name": "newmark", "step": 2e-3},
    "base": {"kind": "motor", "inertia": 0.1, "damping": 0.1},
    "beam": {
        "length": 1.0,
        "bending_stiffness": 20.0,
        "mass_per_length": 0.3,
        "links": 2,
        "damping_time": 0.01,
    },
    "input": [
        {"name": "push", "at": "tip", "acts": "force_y"},
        {"name": "hub_torque", "at": "base", "acts": "torque"},
    ],
    "output": [
        {"name": "tip", "at": "tip", "of": "position"},
        {"name": "root", "at": "base", "of": "torque"},
        {"name": "moving", "at": "arm", "of": "kinetic_energy"},
    ],
    "initial": {"angles": -1.5},
}

CHAIN: dict[str, Any] = {
    "name": "shafts",
    "model": {"kind": "chain"},
    "integrator": {"name": "sdirk4", "step": 1e-2},
    "base": {"kind": "prescribed"},
    "joint": [{"stiffness": 30.0, "damping": 0.3}, {"stiffness": 20.0, "damping": 0.1}],
    "link": [{"inertia": 0.2}, {"inertia": 0.1}],
    "input": [
        {"name": "drive", "at": "base", "acts": "angle"},
        {"name": "brake", "at": "tip", "acts": "torque"},
    ],
    "output": [
        {"name": "end", "at": "tip", "of": "acceleration"},
        {"name": "twist", "at": "base", "of": "torque"},
    ],
}

AFLOAT: dict[str, Any] = {
    "name": "probe",
    "model": {"kind": "spatial"},
    "integrator": {"name": "newmark", "step": 1e-3},
    "base": {"kind": "free", "turn": [0.3, -0.2, 0.7], "rate": [0.3, -0.2, 0.5]},
    "body": [
        {"name": "hull", "on": "base", "mass": 2.0, "center": [0.02, 0, 0.01], "inertia": [0.1, 0.15, 0.2]},
        {
            "name": "weight",
            "on": "boom",
            "mass": 0.5,
            "center": [0.4, 0.05, 0],
            "inertia": [1e-3, 2e-3, 3e-3],
        },
    ],
    "joint": [
        {"name": "boom", "on": "hull", "at": [0.1, 0, 0], "axis": "y", "stiffness": 3.0, "damping": 0.02}
    ],
    "input": [{"name": "thrust", "at": "hull", "acts": "force", "in": "body"}],
    "output": [
        {"name": "weight", "at": "weight", "of": "position"},
        {"name": "facing", "at": "hull", "of": "orientation"},
    ],
}


@pytest.fixture(scope="session")
def rod() -> tg.Arm:
    return tg.Arm(**PLANAR)


@pytest.fixture(scope="session")
def shafts() -> tg.Arm:
    return tg.Arm(CHAIN)


@pytest.fixture(scope="session")
def probe() -> tg.Arm:
    return tg.Arm(AFLOAT)


@pytest.fixture
def said(capsys: pytest.CaptureFixture[str]) -> Callable[..., list[dict[str, Any]]]:
    """Return the rows that a command prints as JSON."""

    def command(*words: object) -> list[dict[str, Any]]:
        capsys.readouterr()
        assert main([*map(str, words), "--json"]) == 0
        found: list[dict[str, Any]] = json.loads(capsys.readouterr().out)["rows"]
        return found

    return command


@pytest.fixture
def agree(said: Callable[..., list[dict[str, Any]]]) -> Callable[..., None]:
    """Hold that rows are those of a command, to the last bit, but for columns that a clock fills, by how they begin."""

    def plain(row: Mapping[str, Any], clocked: tuple[str, ...]) -> dict[str, Any]:
        # JSON has no infinity
        finite = {k: None if isinstance(v, float) and not math.isfinite(v) else v for k, v in row.items()}
        kept = {k: v for k, v in finite.items() if not k.startswith(clocked)}
        plain_one: dict[str, Any] = json.loads(json.dumps(kept, default=str))
        return plain_one

    def agreeing(found: Iterable[Mapping[str, Any]], *words: object, but: tuple[str, ...] = ()) -> None:
        rows = [plain(row, but) for row in said(*words)]
        assert rows
        assert [plain(row, but) for row in found] == rows

    return agreeing
