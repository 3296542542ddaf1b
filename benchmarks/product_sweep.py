"""What the plain product of transfer matrices loses, beside the Riccati sweep on the same matrices.

    python benchmarks/product_sweep.py --out out/bench

The chain is that of Gholampour (2018), table 4-1 (I = 1, k = 20, c = 5, torque 1 on the tip), with more
or fewer stations. `loss` is the largest difference between both sweeps in any output over the run,
relative to the output's largest value. docs/product-sweep.md shows this table.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path

from thesis.product_safety import ProductLoss, product_loss

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.csv_text import csv_text
from tmm_gen.files import write_whole
from tmm_gen.scene import load_scene

STATIONS = (2, 3, 4, 5, 6, 8, 10, 12, 15, 20, 50)
STEPS = (0.1, 0.01, 0.001)
RUN = 1000
INTEGRATOR = "newmark"
SCENE = Path(__file__).resolve().parents[1] / "scenes" / "thesis10.toml"


def measure(stations: int, step: float) -> ProductLoss:
    """Run both sweeps for a number of stations."""
    changes = {"joint.1.repeat": stations, "link.1.repeat": stations, "integrator.step": step}
    return product_loss(load_scene(SCENE).replace(**changes), {"tip_torque": 1.0}, RUN)


def shown(loss: float) -> str:
    """Write a relative loss, or that nothing is left."""
    if math.isinf(loss):
        return "overflows"
    return f"{loss:.0e}" if loss < 1.0 else f"all ({loss:.0e})"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    out = parser.parse_args().out
    rows = []
    with progress("comparing sweeps", total=len(STATIONS) * len(STEPS)) as advance:
        for stations in STATIONS:
            row: dict[str, object] = {"stations": stations}
            for step in STEPS:
                loss = measure(stations, step)
                key = f"{step:g}".replace(".", "_")
                row |= {
                    f"loss_{key}": loss.measured,
                    f"predicted_{key}": loss.predicted,
                    f"safe_{key}": loss.safe_stations,
                }
                advance(doing=f"{stations} stations, step {step:g} s")
            rows.append(row)
    columns = [Column("stations")]
    for step in STEPS:
        key = f"{step:g}".replace(".", "_")
        columns.append(
            Column(f"loss_{key}", f"loss at {step:g} s (safe: {rows[0][f'safe_{key}']})", shown, "right")
        )
    table(rows, columns, title=f"plain product against Riccati, {INTEGRATOR}, {RUN} steps, double precision")
    write_whole(out / "product_sweep.csv", csv_text(rows))
    print(f"wrote {out / 'product_sweep.csv'}")


if __name__ == "__main__":
    main()
