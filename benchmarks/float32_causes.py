"""Which roundings make single precision drift: scenes/hundred.toml with each of them alone.

    python benchmarks/float32_causes.py

The step of the generated kernel, written once more with a number type for each of four things: the parameters and the
time step; what prepare derives from them; results of the sweep; the state and what is added to it. Each is `float` in
turn, rounded where it is stored, while all else is `double`. A million steps of 1 ms under 1 N m at 2 rad/s; the tip
against all `double`.
"""

from __future__ import annotations

import argparse
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from support.float32_error import SingleError

from tmm_gen.cli.console import Column, progress, table

STEPS = 1_000_000
WINDOWS = 20
SOURCE = r"""
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
enum { N = 100 };
int main(int count, char **words)
{
    const long steps = count > 1 ? atol(words[1]) : 0;
    const GIVEN given[4] = {(GIVEN)400.0, (GIVEN)0.02, (GIVEN)0.01, (GIVEN)1e-3};
    const DERIVED k = (DERIVED)given[0], c = (DERIVED)given[1], inertia = (DERIVED)given[2], h = (DERIVED)given[3];
    const DERIVED rate_gain = (DERIVED)0.5 * h, angle_gain = (DERIVED)0.25 * (h * h);
    const DERIVED joint = (DERIVED)0.5 * c * h + (DERIVED)0.25 * (h * h) * k;
    DERIVED admittance[N], transmission[N], reflection[N], impedance = 0;
    for (int j = N - 1; j >= 0; --j) {
        impedance -= inertia;
        admittance[j] = 1 / (joint - impedance);
        transmission[j] = admittance[j] * joint;
        reflection[j] = -admittance[j] * impedance;
        impedance *= transmission[j];
    }
    static STATE angle[N + 1], rate[N + 1], acceleration[N + 1]; /* the clamp first */
    static SWEEP correction[N + 1];
    for (long n = 0; n < steps; ++n) {
        SWEEP bias = (SWEEP)(float)sin(2.0 * 1e-3 * (double)(n + 1)), unknown = 0;
        for (int j = 1; j <= N; ++j) {
            angle[j] = (STATE)(angle[j] + acceleration[j] * angle_gain + rate[j] * h);
            rate[j] = (STATE)(rate[j] + acceleration[j] * rate_gain);
        }
        for (int j = N; j >= 1; --j) {
            const SWEEP torque = (SWEEP)(c * (rate[j] - rate[j - 1]) + k * (angle[j] - angle[j - 1]));
            correction[j] = (SWEEP)(admittance[j - 1] * (bias - torque));
            bias = (SWEEP)(bias * transmission[j - 1] + torque * reflection[j - 1]);
        }
        for (int j = 1; j <= N; ++j) {
            unknown = (SWEEP)(correction[j] + transmission[j - 1] * unknown);
            acceleration[j] = (STATE)unknown;
            angle[j] = (STATE)(angle[j] + angle_gain * unknown);
            rate[j] = (STATE)(rate[j] + rate_gain * unknown);
        }
        const double tip = (double)angle[N];
        fwrite(&tip, sizeof tip, 1, stdout);
    }
    return 0;
}
"""
PLACES = ("GIVEN", "DERIVED", "SWEEP", "STATE")
CASES = {
    "parameters and step": {"GIVEN"},
    "factors that prepare derives": {"DERIVED"},
    "results of the sweep": {"SWEEP"},
    "state and what is added to it": {"STATE"},
    "all of them": set(PLACES),
    "all but parameters and factors": {"SWEEP", "STATE"},
}


def tip(singles: set[str]) -> np.ndarray:
    """Return the tip angle after each step, some things in single precision."""
    types = [f"-D{place}={'float' if place in singles else 'double'}" for place in PLACES]
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder, "run")
        Path(folder, "run.c").write_text(SOURCE)
        words = [
            "gcc",
            "-std=c99",
            "-O2",
            "-ffp-contract=off",
            *types,
            f"{program}.c",
            "-o",
            str(program),
            "-lm",
        ]
        subprocess.run(words, check=True)
        done = subprocess.run([program, str(STEPS)], check=True, capture_output=True)
    return np.frombuffer(done.stdout)


def main() -> None:
    argparse.ArgumentParser(description=__doc__).parse_args()
    right, rows = tip(set()), []
    peak = float(np.max(np.abs(right)))
    with progress("simulating", total=len(CASES)) as advance:
        for name, singles in CASES.items():
            advance(0, doing=name)
            parts = np.array_split((tip(singles) - right) / peak, WINDOWS)
            squares = np.array([np.sqrt(np.mean(part**2)) for part in parts])
            error = SingleError(
                "tip",
                peak,
                float(max(np.max(np.abs(p)) for p in parts)),
                np.arange(WINDOWS, dtype=float) + 0.5,
                squares,
            )
            last = float(np.sqrt(np.mean(squares[-2:] ** 2)))
            rows.append({"in float": name, "last": last, "growth": error.growth})
            advance()
    columns: list[Column | str] = [
        "in float",
        Column("last", "RMS, last tenth", ".1e"),
        Column("growth", form="+.2f"),
    ]
    table(rows, columns, title=f"hundred, {STEPS} steps, relative to the peak")


if __name__ == "__main__":
    main()
