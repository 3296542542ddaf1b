"""Make the recording: python record.py recording.csv.

A finer arm than the observer's model, ten links at a quarter of a millisecond, takes the place of the real one: a
torque lifts it, lets go, catches it and lets it fall, an encoder of 16 bits a turn reads its hub. Where its tip was
is written beside, for compare.py alone: no sensor tells. Needs tmm-gen.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from tmm_gen.native import compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.scene import load_scene

HERE = Path(__file__).resolve().parent
SAMPLES = 3000
PERIOD = 1e-3
SUBSTEPS = 4
COUNT = 2.0 * np.pi / 2**16
TORQUES = (
    *((0.0, 5.0), (0.25, 1.5), (0.45, 4.0), (0.7, 2.5), (0.85, 3.5)),
    *((1.0, -1.0), (1.5, 0.5), (2.0, -0.5), (2.5, 1.0)),
)
"""From a time on, s: N m."""


def main() -> None:
    """Write time, torque, encoder angle and true tip at every sample."""
    scene = load_scene(HERE / "beam5.toml").replace(
        **{
            "beam.links": 10,
            "integrator.step": PERIOD / SUBSTEPS,
            "emit.real": "float64",
            "emit.parameters": "free",
        }
    )
    plant = compile_kernel(build_program(scene), scene)
    plant.prepare()
    plant.initialise()
    lines = ["time,hub_torque,hub_angle,tip_x,tip_y"]
    for sample in range(1, SAMPLES + 1):
        time = sample * PERIOD
        torque = [value for start, value in TORQUES if start < time][-1]
        for _ in range(SUBSTEPS):
            plant.step({"hub_torque": torque})
        found = plant.output()
        angle = COUNT * round(found["hub"] / COUNT)
        lines.append(f"{time:.3f},{torque:g},{angle:.7f},{found['tip_x']:.6f},{found['tip_y']:.6f}")
    Path(sys.argv[1]).write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
