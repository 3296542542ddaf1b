"""Loads of arms that nothing holds: what the arm can take by the reference's motion, alike in a plane and in space."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tmm_gen.reference.planar_arm import Arm
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.scene import Scene, load_scene, parse_scene
from tmm_gen.study.excitation import excitation
from tmm_gen.study.from_rest import swung
from tmm_gen.study.turning_loads import turning_loads

SCENES = Path(__file__).resolve().parents[2] / "scenes"
FREQUENCIES = {"torque": 30.0, "thrust_x": 45.0, "thrust_y": 60.0}


def afloat(kind: str) -> Scene:
    """Return a light hub with an arm on an elastic gear and a latched panel, bent at first; in a plane or in space."""
    in_space = kind == "spatial"
    axis = 'axis = "z"\n' if in_space else ""
    forces = (
        '[[input]]\nname = "thrust"\nat = "base"\nacts = "force"\n'
        if in_space
        else "".join(f'[[input]]\nname = "thrust_{x}"\nat = "base"\nacts = "force_{x}"\n' for x in "xy")
    )

    def inertia(about_z: float) -> str:
        return f"[1e-4, {about_z}, {about_z}]" if in_space else f"{about_z}"

    return parse_scene(
        f'name = "panel"\nmodel = {{ kind = "{kind}" }}\nintegrator = {{ name = "newmark", step = 2e-3 }}\n'
        f'base = {{ kind = "free" }}\n'
        f'[[body]]\nname = "hub"\non = "base"\nmass = 2.0\ninertia = {inertia(0.05)}\n'
        f'[[motor]]\nname = "drive"\non = "base"\n{axis}rotor_inertia = 2e-5\ngear = 50\nstiffness = 40.0\n'
        "damping_time = 1e-3\nmotor_damping = 1e-4\n"
        f'[[link]]\nname = "yoke"\non = "drive"\nlength = 0.3\nmass = 0.2\ninertia = {inertia(2e-3)}\n'
        f'[[joint]]\nname = "hinge"\non = "yoke"\n{axis}stiffness = 6.0\ndamping = 5e-3\nrest = 0.4\n'
        f'[[link]]\nname = "panel"\non = "hinge"\nlength = 0.5\nmass = 0.4\ninertia = {inertia(8e-3)}\n'
        f'[[input]]\nname = "torque"\nat = "drive"\nacts = "torque"\n{forces}'
        f"[initial]\nangles = {{ {'hinge' if in_space else 'yoke = 0.0, panel'} = 0.4 }}\n"
        '[[output]]\nname = "end"\nat = "panel"\nof = "position"\n'
    )


def test_motion_from_rest_is_that_of_closed_forms() -> None:
    """A free mass, one on a damper, one on a spring at resonance and one held hard."""
    mass, w, c, hard, until = 0.3, 7.0, 5.0, 1e9, 2.0
    dampers, springs = np.diag([0.0, c * mass, 0.0, 0.0]), np.diag([0.0, 0.0, mass * w * w, hard])
    pushes, swings = np.eye(4), np.full(4, w)
    motions = [np.diag(q) for q in swung(mass * np.eye(4), dampers, springs, pushes, swings, until)]
    t = until * np.arange(1, len(motions) + 1) / len(motions)
    sine, cosine = np.sin(w * t), np.cos(w * t)
    damped = c * (1.0 - cosine) / w - sine + w * (1.0 - np.exp(-c * t)) / c
    exact = [
        (w * t - sine) / (mass * w * w),
        damped / (mass * (c * c + w * w)),
        (sine - w * t * cosine) / (2.0 * mass * w * w),
        sine / hard,
    ]
    for found, wanted in zip(np.transpose(motions), exact, strict=True):
        # of resonance the phase: (w h)^2 / 12 for each radian
        assert np.max(np.abs(found - wanted)) < 2e-2 * np.max(np.abs(wanted))


def test_an_arm_afloat_in_a_plane_gets_what_it_gets_in_space() -> None:
    """By other equations: about the centre of mass by absolute angles, and by joints on a base."""
    for name, frequency in FREQUENCIES.items():
        flat, deep = (
            turning_loads(afloat(kind), {name: frequency}, 0.3, 1.0) for kind in ("planar", "spatial")
        )
        assert flat == pytest.approx(deep, rel=1e-9)


@pytest.mark.parametrize("until", [0.3, 2.0])
def test_loads_move_what_floats_by_about_a_radian(until: float) -> None:
    """By the reference's own motion: the satellite in a plane, whose latches and panels were bent beyond all sense."""
    scene = load_scene(SCENES / "cube.toml")
    found = excitation(scene, until=until)
    q, _, _ = Arm(scene, found.signals).trajectory(until).at(np.linspace(0.0, until, 101))
    assert float(np.max(np.abs(q - q[0]))) == pytest.approx(1.0, rel=0.4)
    places = planar_response(scene, found.signals, np.linspace(0.0, until, 101))
    assert np.hypot(np.ptp(places["hub_x"]), np.ptp(places["hub_y"])) < 1.1 * scene.reach
