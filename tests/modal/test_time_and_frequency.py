"""Poles of simulated releases against `modes`, shifted as each integrator's own analysis says."""

from __future__ import annotations

import numpy as np
import pytest
from support.identify import identify_poles

from tmm_gen.derive.integrators.accuracy import leading_terms, principal_exponent
from tmm_gen.derive.integrators.amplification import OMEGA, amplification
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.modes import find_modes
from tmm_gen.scene import INTEGRATOR_NAMES, Scene, parse_scene
from tmm_gen.simulate.run import simulate

STEP = 0.02
DROPPED = 40
"""Steps: by then start-up formulas and the parasitic solutions of multistep methods are gone."""

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


def release(name: str, step: float = STEP) -> Scene:
    return parse_scene(CHAIN.format(name=name, step=step))


def test_identification_of_known_poles() -> None:
    step = 0.01
    time = step * np.arange(400)
    poles = [-0.1 + 5j, -0.5 + 17j, -3.0 + 0j]
    motion = sum(np.real((1 + 0.5j) * np.exp(pole * time)) for pole in poles)
    found = identify_poles(motion, step)
    for pole in poles:
        assert np.min(np.abs(found - pole)) < 1e-8


@pytest.mark.parametrize("name", INTEGRATOR_NAMES)
def test_time_domain_agrees_with_modes(name: str) -> None:
    scene = release(name)
    modes = find_modes(matrices(linear_arm(scene)))
    motion = simulate(scene, {}, 9.0, refuse=False, judge=False).outputs["tip"][DROPPED:]
    found = identify_poles(motion, STEP)
    linear = amplification(integrator(name).main)
    terms = leading_terms(linear)
    for mode in modes:
        assert mode.damping_ratio is not None
        omega = mode.frequency * STEP
        shifted = principal_exponent(linear, omega, mode.damping_ratio) / STEP
        identified = found[np.argmin(np.abs(found - shifted))]
        # the same pole but for rounding
        assert abs(identified - shifted) < 1e-9 * mode.frequency
        # and it differs from that of `modes` by the derived period error and numerical damping
        period, damping = (float(term.subs(OMEGA, omega)) for term in terms)
        measured_period = mode.poles[0].imag / identified.imag - 1.0
        measured_damping = -identified.real / abs(identified) - mode.damping_ratio
        slack = 1e-6 + 0.25 * max(abs(period), abs(damping)) + mode.damping_ratio * omega**2
        assert abs(measured_period - period) < slack
        assert abs(measured_damping - damping) < slack


def test_smaller_steps_approach_modes() -> None:
    """Newmark's period error goes with the square of the step."""
    scene = release("newmark")
    first = find_modes(matrices(linear_arm(scene)))[0].poles[0]
    errors = []
    for step in (0.04, 0.02, 0.01):
        motion = simulate(release("newmark", step), {}, 9.0, refuse=False, judge=False).outputs["tip"]
        found = identify_poles(motion, step)
        errors.append(np.min(np.abs(found - first)))
    assert np.diff(np.log2(errors)) == pytest.approx([-2, -2], abs=0.05)
