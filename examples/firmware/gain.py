"""Compute the observer's gain: python gain.py gain.csv. Needs NumPy and the generated kernel.

The model is linearised about the arm held out level, one step of the NumPy kernel at a time, and the Riccati equation
of the Kalman filter is iterated until it stands (Anderson and Moore, Optimal Filtering, 1979, chapter 4). What is
unknown is stated by the three numbers below; the rest follows.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent / "generated"))

import beam5  # generated, found by the line above

TORQUE = 0.2
"""Standard deviation of what else acts on the hub, N m."""
KICK = 1e-3
"""The same of what changes the rate of each link in a step and is not modelled, rad/s."""
COUNT = 2.0 * np.pi / 2**16
"""One count of the encoder, rad: its error is evenly spread over that."""
HOLDING = 9.81 * (0.5 * 0.5 + 0.1 * 1.0)
"""Torque that keeps the arm level, N m: weight of beam and payload times their distances."""

PARTS = ("angle", "rate", "acceleration")
NODES = 1 + beam5.STATIONS
SIZE = len(PARTS) * NODES
CHANGE = 1e-6


def vector(state: beam5.State) -> np.ndarray:
    """Return a state as one column: angles, rates, accelerations, of the hub first."""
    parts = [np.append(getattr(state, f"hub_{part}"), getattr(state, part)) for part in PARTS]
    return np.concatenate(parts)


def from_vector(values: np.ndarray) -> beam5.State:
    """Return the state of a column."""
    rows = dict(zip(PARTS, values.reshape(len(PARTS), NODES), strict=True))
    hub = {f"hub_{part}": row[0] for part, row in rows.items()}
    return beam5.State(**hub, **{part: row[1:] for part, row in rows.items()})


def linearised() -> tuple[np.ndarray, np.ndarray]:
    """Return how a step's result changes with the state, (18, 18), and with the torque, (18,)."""
    model = beam5.prepare()
    rest = vector(beam5.initialise(input=beam5.Input(hub_torque=HOLDING)))

    def after(state: np.ndarray, torque: float) -> np.ndarray:
        return vector(beam5.step(model, from_vector(state), beam5.Input(hub_torque=torque)))

    columns = [
        (after(rest + change, HOLDING) - after(rest - change, HOLDING)) / (2.0 * CHANGE)
        for change in CHANGE * np.eye(SIZE)
    ]
    drive = (after(rest, HOLDING + CHANGE) - after(rest, HOLDING - CHANGE)) / (2.0 * CHANGE)
    return np.column_stack(columns), drive


def stationary_gain() -> np.ndarray:
    """Return by how much each number of the state is corrected per radian that encoder and model differ."""
    transition, drive = linearised()
    kicks = transition[:, NODES + 1 : 2 * NODES]
    unknown = TORQUE**2 * np.outer(drive, drive) + KICK**2 * kicks @ kicks.T
    covariance, gain = unknown, np.zeros(SIZE)
    for _ in range(20_000):
        new = covariance[:, 0] / (covariance[0, 0] + COUNT**2 / 12.0)
        corrected = covariance - np.outer(new, covariance[0])
        covariance = transition @ (0.5 * (corrected + corrected.T)) @ transition.T + unknown
        if np.max(np.abs(new - gain)) < 1e-12 * np.max(np.abs(new)):
            return new
        gain = new
    raise ArithmeticError("the gain does not settle")


def main() -> None:
    """Write the gain: a row for the hub, then one for each link."""
    rows = stationary_gain().reshape(len(PARTS), NODES).T
    lines = [",".join(PARTS), *(",".join(f"{value:.7g}" for value in row) for row in rows)]
    Path(sys.argv[1]).write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
