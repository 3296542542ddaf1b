"""Poles of simulated releases beside those of `modes`, for every integrator: the table in docs/modes.md.

    python benchmarks/time_and_frequency.py

A two-station chain with light damping is let go; the poles of the recorded motion differ from the exact ones by the
integrator's period error and numerical damping, which its own analysis predicts.
"""

from __future__ import annotations

import argparse

import numpy as np
from support.identify import identify_poles

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.derive.integrators.accuracy import principal_exponent
from tmm_gen.derive.integrators.amplification import amplification
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.modes import find_modes
from tmm_gen.scene import INTEGRATOR_NAMES, parse_scene
from tmm_gen.simulate.run import simulate

STEP = 0.02
UNTIL = 9.0
DROPPED = 40
CHAIN = """
name = "release"
[model]
kind = "chain"
[integrator]
name = "{name}"
step = {step}
[base]
kind = "clamp"
[[joint]]
stiffness = 30.0
damping = 0.03
[[link]]
inertia = 1.0
[[joint]]
stiffness = 20.0
damping = 0.02
[[link]]
inertia = 0.7
[initial]
angles = [0.01, 0.03]
[[output]]
name = "tip"
at = "tip"
of = "angle"
"""


def main() -> None:
    argparse.ArgumentParser(description=__doc__).parse_args()
    rows = []
    with progress("letting go", total=len(INTEGRATOR_NAMES)) as advance:
        for name in INTEGRATOR_NAMES:
            scene = parse_scene(CHAIN.format(name=name, step=STEP))
            mode = find_modes(matrices(linear_arm(scene)))[1]
            zeta = mode.damping_ratio
            assert zeta is not None
            linear = amplification(integrator(name).main)
            predicted = principal_exponent(linear, mode.frequency * STEP, zeta) / STEP
            found = identify_poles(
                simulate(scene, {}, UNTIL, refuse=False, judge=False).outputs["tip"][DROPPED:], STEP
            )
            pole = found[np.argmin(np.abs(found - predicted))]
            rows.append(
                {
                    "integrator": name,
                    "period": 100.0 * (mode.poles[0].imag / pole.imag - 1.0),
                    "period_derived": 100.0 * (mode.poles[0].imag / predicted.imag - 1.0),
                    "damping": -pole.real / abs(pole) - zeta,
                    "damping_derived": -predicted.real / abs(predicted) - zeta,
                    "difference": abs(pole - predicted) / mode.frequency,
                }
            )
            advance(doing=name)
    columns = [
        Column("integrator"),
        Column("period", "period error (%)", ".5f"),
        Column("period_derived", "derived", ".5f"),
        Column("damping", "numerical damping", ".3e"),
        Column("damping_derived", "derived", ".3e"),
        Column("difference", "difference of poles", ".0e"),
    ]
    table(rows, columns, title=f"second mode, Omega = {mode.frequency * STEP:.3f}")


if __name__ == "__main__":
    main()
