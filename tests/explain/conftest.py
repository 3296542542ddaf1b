"""Scenes the tests of this folder look at."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from tmm_gen.scene import Scene, load_scene

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def example() -> Callable[[str], Scene]:
    """Load a scene of the folder of examples."""
    return lambda name: load_scene(ROOT / "scenes" / f"{name}.toml")
