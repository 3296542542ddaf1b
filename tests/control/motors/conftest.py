"""The arm with two motors, made small: one spring in each beam, a short horizon."""

from __future__ import annotations

from pathlib import Path

import pytest

from tmm_gen.control.bench import Bench
from tmm_gen.scene import Scene, load_scene

ELBOW = Path(__file__).resolve().parents[3] / "scenes" / "elbow.toml"


@pytest.fixture(scope="session")
def elbow() -> Scene:
    """The committed scene with two motors and `[control]`."""
    return load_scene(ELBOW)


@pytest.fixture(scope="session")
def two(elbow: Scene) -> Bench:
    """Four links, eight samples: for what is slow."""
    changes = {"beam.upper.links": 1, "beam.forearm.links": 1, "control.horizon": 8, "control.substeps": 2}
    return Bench.of(elbow.replace(**changes, **{"control.modes": 4}))


@pytest.fixture(scope="session")
def firm_bench(elbow: Scene) -> Bench:
    """With two springs in each beam, since a model of one lets the arm tremble for long."""
    changes = {"beam.upper.links": 2, "beam.forearm.links": 2, "control.horizon": 12, "control.substeps": 2}
    return Bench.of(elbow.replace(**changes))
