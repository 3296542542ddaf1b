"""The scene to be controlled, with its models made once."""

from __future__ import annotations

from pathlib import Path

import pytest

from tmm_gen.control.bench import Bench
from tmm_gen.scene import Scene, load_scene

SCENES = Path(__file__).resolve().parents[2] / "scenes"


@pytest.fixture(scope="session")
def swing() -> Scene:
    """The committed scene with `[control]`."""
    return load_scene(SCENES / "swing.toml")


@pytest.fixture(scope="session")
def bench(swing: Scene) -> Bench:
    """Its models: five links by Newmark in four steps, three modes."""
    return Bench.of(swing)


@pytest.fixture(scope="session")
def small(swing: Scene) -> Bench:
    """Two links, one step and eight samples: for what is slow."""
    return Bench.of(swing.replace(**{"beam.links": 2, "control.substeps": 1, "control.horizon": 8}))
