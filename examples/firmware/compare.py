"""Hold the firmware's telemetry against the NumPy kernel: python compare.py telemetry.csv recording.csv.

The firmware computes in single precision, the NumPy kernel in double: their difference is rounding, and it stays where
it is as the motion goes on. Needs NumPy.
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent / "generated"))

import beam5  # generated, found by the line above

TOLERANCE = {"hub": 5e-6, "tip_x": 5e-6, "tip_y": 5e-6}
"""rad and m: see README.md."""


def rows(path: str) -> list[dict[str, float]]:
    """Return the rows of a file, without comments."""
    with Path(path).open(newline="") as stream:
        lines = [line for line in stream if not line.startswith("#")]
    return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]


def simulated(torques: list[float]) -> list[dict[str, float]]:
    """Return the outputs of the NumPy kernel after each sample."""
    model = beam5.prepare()
    state = beam5.initialise()
    found = []
    for torque in torques:
        state = beam5.step(model, state, beam5.Input(hub_torque=torque))
        output = beam5.output(model, state)
        found.append({name: float(getattr(output, name)) for name in TOLERANCE})
    return found


def main() -> int:
    """Print the largest differences; return 1 where one is above its tolerance."""
    telemetry, recording = rows(sys.argv[1]), rows(sys.argv[2])
    expected = simulated([row["hub_torque"] for row in recording])
    sampled = [expected[int(row["sample"]) - 1] for row in telemetry]
    wrong = len(telemetry) != len(recording) // 10
    print(f"{len(telemetry)} messages of {len(recording)} samples")
    for name, tolerance in TOLERANCE.items():
        pairs = zip(telemetry, sampled, strict=True)
        largest = float(np.max([abs(sent[name] - double[name]) for sent, double in pairs]))
        wrong |= not largest <= tolerance
        print(f"{name:6} differs from NumPy by at most {largest:.2g} (allowed {tolerance:g})")
    residual = np.sqrt(np.mean([row["residual"] ** 2 for row in telemetry]))
    print(f"encoder less model: {1e3 * residual:.3g} mrad RMS")
    return int(wrong)


if __name__ == "__main__":
    sys.exit(main())
