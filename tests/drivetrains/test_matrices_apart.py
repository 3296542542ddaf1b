"""What a drivetrain expands to, held against its energies written by hand: matrices, frequencies, responses."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import eigh

from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.modes import find_modes
from tmm_gen.modal.response import frequency_response
from tmm_gen.modal.situation import resting_arm
from tmm_gen.reference.assembly import assemble
from tmm_gen.reference.duration import slowest_swing
from tmm_gen.reference.frequency import fastest_mode
from tmm_gen.scene import Scene

Chain = Callable[..., Scene]

MOTOR: tuple[str, dict[str, Any]] = ("motor", {"name": "motor", "rotor_inertia": 2e-3, "gear": 3.0})


def test_two_discs_with_a_gear_between_two_shafts(chain: Chain) -> None:
    """Thomson, Theory of Vibration, sec. 5.5: n^2 k and n^2 J on the shaft of the first disc; here N = 1/n turns."""
    first, second, ratio = 0.4, 0.05, 3.0
    k, more = 120.0, 35.0
    scene = chain(
        [
            ("link", {"name": "a", "inertia": first}),
            ("joint", {"name": "s", "stiffness": k}),
            ("link", {"name": "pinion", "inertia": 1e-3}),
            ("gear", {"name": "g", "ratio": ratio}),
            ("link", {"name": "wheel", "inertia": 9e-3}),
            ("joint", {"name": "t", "stiffness": more}),
            ("link", {"name": "b", "inertia": second}),
        ],
        base={"kind": "free"},
    )
    mass = np.diag([first, 1e-3 + 9e-3 / ratio**2, second / ratio**2])
    referred = more / ratio**2
    stiffness = np.array([[k, -k, 0.0], [-k, k + referred, -referred], [0.0, -referred, referred]])
    right = np.sqrt(np.maximum(eigh(stiffness, mass, eigvals_only=True), 0.0))
    found = np.array([mode.frequency for mode in find_modes(matrices(resting_arm(scene)))])
    assert found[0] == 0.0
    assert found[1:] == pytest.approx(right[1:], rel=1e-9)


def test_light_gears_put_two_shafts_in_series(chain: Chain) -> None:
    """Den Hartog, Mechanical Vibrations, sec. 5.2: w^2 = k_eq (1/J1 + n^2/J2) with all on one shaft."""
    first, second, ratio, k, more, tooth = 0.3, 0.7, -4.0, 200.0, 900.0, 1e-9
    scene = chain(
        [
            ("link", {"name": "a", "inertia": first}),
            ("joint", {"name": "s", "stiffness": k}),
            ("gear", {"name": "g", "ratio": ratio}),
            ("link", {"name": "wheel", "inertia": tooth}),
            ("joint", {"name": "t", "stiffness": more}),
            ("link", {"name": "b", "inertia": second}),
        ],
        base={"kind": "free"},
    )
    series = 1.0 / (1.0 / k + ratio**2 / more)
    slow = np.sqrt(series * (1.0 / first + ratio**2 / second))
    assert find_modes(matrices(resting_arm(scene)))[1].frequency == pytest.approx(slow, rel=1e-7)


def test_a_motor_at_a_held_load_swings_with_its_geared_rotor(chain: Chain) -> None:
    scene = chain(
        [MOTOR, ("joint", {"name": "s", "stiffness": 50.0}), ("link", {"name": "load", "inertia": 1e9})]
    )
    assert find_modes(matrices(resting_arm(scene)))[1].frequency == pytest.approx(
        np.sqrt(50.0 / (9.0 * 2e-3)), rel=1e-9
    )


@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 10_000), count=st.integers(1, 6))
def test_frequencies_are_those_of_the_energies(
    seed: int,
    count: int,
    chain: Chain,
    drawn: Callable[..., Any],
    equations: Callable[..., Any],
) -> None:
    parts, base = drawn(seed, count, 0.4)
    scene, right = chain(parts, base=base), equations(parts, base)
    squares = eigh(right.stiffness, right.mass, eigvals_only=True)
    frequencies = np.sqrt(np.maximum(squares, 0.0))[scene.hub :]
    found = find_modes(matrices(resting_arm(_undamped(scene))))
    assert np.array([m.frequency for m in found])[scene.hub :] == pytest.approx(frequencies, rel=1e-9)
    assert slowest_swing(scene) == pytest.approx(frequencies[0], rel=1e-9)
    assert fastest_mode(scene).frequency == pytest.approx(frequencies[-1], rel=1e-9)


def _undamped(scene: Scene) -> Scene:
    quiet: dict[str, object] = {}
    for part in scene.parts:
        if part.joint or part.kind == "motor":
            quiet[f"{part.kind}.{part.name}.damping"] = 0.0
        if part.kind == "motor":
            quiet[f"motor.{part.name}.motor_damping"] = 0.0
    if scene.base.damping and not any(part.kind == "motor" for part in scene.parts):
        quiet["base.damping"] = 0.0
    return scene.replace(**quiet)


@settings(max_examples=60, deadline=None)
@given(seed=st.integers(0, 10_000), count=st.integers(1, 6))
def test_responses_are_those_of_the_energies(
    seed: int,
    count: int,
    chain: Chain,
    drawn: Callable[..., Any],
    equations: Callable[..., Any],
) -> None:
    """From every torque to every angle and torque, in the coordinates of each part; the reference's too."""
    parts, base = drawn(seed, count, 0.4)
    scene, right = chain(parts, base=base), equations(parts, base)
    points = 1j * np.array([2.0, 20.0, 90.0])
    swept, assembly = frequency_response(resting_arm(scene), points), assemble(scene)
    for k, s in enumerate(points):
        motion = np.linalg.solve(s * s * right.mass + s * right.damping + right.stiffness, right.load)
        wanted = {f"angle_{n}": right.reading[i] @ motion for i, n in enumerate(right.names)}
        wanted |= {f"rate_{n}": s * wanted[f"angle_{n}"] for n in right.names}
        wanted |= {f"acceleration_{n}": s * s * wanted[f"angle_{n}"] for n in right.names}
        wanted |= {
            f"torque_{n}": -(stiffness + s * damper) * (twist @ motion)
            for n, (twist, stiffness, damper) in right.torque.items()
        }
        turned = np.linalg.solve(
            s * s * assembly.mass + s * assembly.damping + assembly.stiffness, assembly.load
        )
        read = assembly.from_angle + s * assembly.from_rate + s * s * assembly.from_acceleration
        for row, output in enumerate(scene.outputs):
            size = np.max(np.abs(wanted[output.name]))
            # what rounding leaves of a resonance: both systems are as close to singular
            assert np.abs(swept[output.name][k] - wanted[output.name]).max() < 1e-9 * size, output.name
            assert np.abs(read[row] @ turned - wanted[output.name]).max() < 1e-9 * size, output.name
