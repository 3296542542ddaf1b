"""The tasks, one step of the kernel per sample of 20 ms.

In the plane a flexible arm swings by one radian, 30 samples looked ahead; in space the arm beside a wall of
`examples/space/wall3.toml` moves up to it, 31 samples looked ahead.
"""

from __future__ import annotations

from pathlib import Path

from tmm_gen.scene import Scene, load_scene

ROOT = Path(__file__).resolve().parents[2]
SWING, WALL = ROOT / "scenes" / "swing.toml", ROOT / "examples" / "space" / "wall3.toml"
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


def arm_in_space(cells: tuple[int, int], walled: bool = True, **changes: object) -> Scene:
    """Return the arm with so many cells in its two links, each two joints beside the motors' three; or without wall."""
    links: dict[str, object] = {
        f"beam.{name}.links": count for name, count in zip(("upper", "forearm"), cells, strict=True)
    }
    if not walled:
        links["control.keep"] = []
    return load_scene(WALL).replace(**links, **changes)
