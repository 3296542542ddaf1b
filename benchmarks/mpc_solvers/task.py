"""The task: swing a flexible arm by one radian, 30 samples of 20 ms looked ahead, one step of the kernel per sample."""

from __future__ import annotations

from pathlib import Path

from tmm_gen.scene import Scene, load_scene

SWING = Path(__file__).resolve().parents[2] / "scenes" / "swing.toml"
WEIGHTS = {
    **{"tip": 1.0, "hub": 0.2, "tip_rate": 0.02, "torque": 1e-3, "torque_step": 5e-3},
    **{"overshoot": 1e3, "hub_bound": 1e3},
}


def arm(links: int) -> Scene:
    """Return the task with so many links."""
    changes = {
        "beam.links": links,
        "control.substeps": 1,
        "integrator.step": 0.02,
        "control.weights": WEIGHTS,
        "control.payload": 1.0,
    }
    # Newmark's step answers half a step late: with a delay of as much, inputs need no correction
    return load_scene(SWING).replace(**changes, **{"control.delay": 0.01})
