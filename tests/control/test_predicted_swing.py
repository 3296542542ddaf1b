"""What is said where an arm swings slower than predicted is what makes it tremble, and the remedy serves."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tmm_gen.closed_loop.compare import compare
from tmm_gen.control.bench import Bench
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.predicted_swing import swings, swings_too_fast
from tmm_gen.modal.beam import natural_frequencies
from tmm_gen.modal.discretised import continuous
from tmm_gen.scene import Scene, load_scene, parse_scene
from tmm_gen.scene.template import template

SWING = Path(__file__).resolve().parents[2] / "scenes" / "swing.toml"


def trembles(bench: Bench) -> float:
    """Return what is left of the swinging of the arm as the scene says, mrad."""
    (trial,) = compare(bench, [BY_NAME["rti-zero"]], [CONDITIONS[0]], 2.0, 0, False)
    return float(str(trial.row()["residual_mrad"]))


def two_motors(links: int) -> Scene:
    """Return an arm with two motors, its beams cut into so many cells, and plain weights."""
    scene = parse_scene(template("two", "planar", control=True, motors=2), "two.toml")
    beams = scene.source.data["beam"]
    assert isinstance(beams, list)
    return scene.replace(
        **{f"beam.{each['name']}.links": links for each in beams},
        **{"control.weights": None, "control.substeps": 4},
    )


def test_too_long_a_step_is_told_of_and_shorter_ones_serve() -> None:
    scene = load_scene(SWING)
    long, short = (Bench.of(scene.replace(**{"control.substeps": count})) for count in (1, 2))
    (line,) = swings_too_fast(long, ["lqr", "rti-zero"])
    at = SWING.read_text().split("[control]")[0].count("\n")
    assert line.startswith(f"{SWING}:")
    assert int(line[len(f"{SWING}:") :].split(":")[0]) > at
    assert ": control.substeps: a vibration of 29.8" in line
    assert line.endswith("rti-zero may tremble. Write more control.substeps.")
    assert swings_too_fast(long, ["lqr", "pd", "mpc-modes"]) == []
    assert swings_too_fast(short, ["rti-zero", "rti", "mpc-links"]) == []
    assert trembles(long) > 1.5 * trembles(short)


def test_too_few_cells_are_told_of_and_more_serve() -> None:
    few, more = Bench.of(two_motors(1)), Bench.of(two_motors(2))
    (line,) = swings_too_fast(few, ["rti-zero"])
    assert line.startswith("two.toml:")
    assert line.endswith("rti-zero may tremble. Cut beams into more `links`.")
    assert swings_too_fast(more, ["rti-zero"]) == []
    assert trembles(few) > 3.0 * trembles(more)


def test_vibrations_are_those_of_the_arm() -> None:
    """The first of the beam on its free hub; damping hardly changes it."""
    bench = Bench.of(load_scene(SWING))
    beam = continuous(bench.assumed)
    assert beam is not None
    first = float(natural_frequencies(beam, 2)[1])
    found = np.min(np.abs(swings(bench.modes, bench.problem.sample_time)))
    assert found == pytest.approx(first, rel=2e-3)
