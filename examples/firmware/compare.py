"""Hold the firmware's telemetry against NumPy: python compare.py telemetry.csv recording.csv gain.csv.

The firmware's observer computes in single precision, the generated NumPy kernel with the same correction in double:
their difference is rounding. Then both, and the model without correction, against the arm that was recorded.
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent / "generated"))

import beam5  # generated, found by the line above

TOLERANCE = {"hub": 1e-6, "tip_x": 1e-5, "tip_y": 1e-5}
"""rad and m: see README.md."""

PARTS = ("angle", "rate", "acceleration")


def table(path: str) -> dict[str, np.ndarray]:
    """Return the columns of a file, without comments."""
    with Path(path).open(newline="") as stream:
        rows = list(csv.DictReader(line for line in stream if not line.startswith("#")))
    return {key: np.array([float(row[key]) for row in rows]) for key in rows[0]}


def corrected(state: beam5.State, gain: dict[str, np.ndarray], residual: float) -> beam5.State:
    """Return a state moved towards what the encoder says: the gain's first row is the hub's."""
    moved = {}
    for part in PARTS:
        hub, *links = gain[part]
        moved[f"hub_{part}"] = getattr(state, f"hub_{part}") + hub * residual
        moved[part] = getattr(state, part) + np.array(links) * residual
    return beam5.State(**moved)


def observed(recording: dict[str, np.ndarray], gain: dict[str, np.ndarray] | None) -> dict[str, np.ndarray]:
    """Return residual and outputs after each sample, of the observer or, without a gain, of the model alone."""
    model, state = beam5.prepare(), beam5.initialise()
    found: dict[str, list[float]] = {name: [] for name in ("residual", *TOLERANCE)}
    for torque, angle in zip(recording["hub_torque"], recording["hub_angle"], strict=True):
        state = beam5.step(model, state, beam5.Input(hub_torque=torque))
        residual = angle - float(state.hub_angle)
        if gain is not None:
            state = corrected(state, gain, residual)
        output = beam5.output(model, state)
        found["residual"].append(residual)
        for name in TOLERANCE:
            found[name].append(float(getattr(output, name)))
    return {name: np.array(values) for name, values in found.items()}


def report(what: str, found: dict[str, np.ndarray], arm: dict[str, np.ndarray]) -> None:
    """Print how far an estimate is from the arm: its hub from the encoder, its tip from the true one."""
    hub = 1e3 * np.sqrt(np.mean(found["residual"] ** 2))
    tip = 1e3 * np.hypot(found["tip_x"] - arm["tip_x"], found["tip_y"] - arm["tip_y"])
    print(
        f"{what}: encoder less model {hub:.3g} mrad RMS, "
        f"tip {np.sqrt(np.mean(tip**2)):.3g} mm RMS off the true one, {np.max(tip):.3g} mm at most"
    )


def main() -> int:
    """Print the largest differences; return 1 where one is above its tolerance."""
    telemetry, recording, gain = map(table, sys.argv[1:4])
    samples = telemetry["sample"].astype(int) - 1
    arm = {name: recording[name][samples] for name in ("tip_x", "tip_y")}
    alone, double = (
        {name: values[samples] for name, values in observed(recording, used).items()} for used in (None, gain)
    )
    print(f"{len(samples)} messages of {len(recording['time'])} samples")
    wrong = len(samples) != len(recording["time"]) // 10
    for name, tolerance in TOLERANCE.items():
        largest = float(np.max(np.abs(telemetry[name] - double[name])))
        wrong |= not largest <= tolerance
        print(f"{name:6} differs from NumPy by at most {largest:.2g} (allowed {tolerance:g})")
    report("model alone", alone, arm)
    report("observer", telemetry, arm)
    return int(wrong)


if __name__ == "__main__":
    sys.exit(main())
