"""Frequencies keep their digits from one link to thousands, and at any ratio of stiffness."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tmm_gen.modal import undamped
from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.beam import beam_arm, natural_frequencies
from tmm_gen.modal.discretised import straight_frequencies, with_links
from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.modes import find_modes, modes_up_to
from tmm_gen.modal.rest import rest_at
from tmm_gen.modal.situation import resting_arm
from tmm_gen.modal.springs import springs_of
from tmm_gen.modal.undamped import undamped_modes
from tmm_gen.scene import Initial, Scene, parse_scene

MOTOR = 'kind = "motor"\ninertia = 0.05\ndamping = 0.3'


@pytest.mark.parametrize("base", ['kind = "clamp"', 'kind = "motor"\ninertia = 0.05', 'kind = "prescribed"'])
def test_thousands_of_links_follow_the_error_that_few_have(
    base: str, beam_scene: Callable[..., Scene]
) -> None:
    """The error is a series in 1/n^2, known from 100 and 200 links, whose matrices lose no digits in any form."""
    drive = '[[input]]\nname = "turn"\nat = "base"\nacts = "angle"' if "prescribed" in base else ""
    scene = beam_scene(base=base, inputs=drive)
    exact = natural_frequencies(beam_arm(scene), 4)
    swinging = exact > 0.0

    def error(links: int) -> np.ndarray:
        return straight_frequencies(scene, links, count=4)[swinging] / exact[swinging] - 1.0

    few, more = (error(links) * links**2 for links in (100, 200))
    first, second = (4 * more - few) / 3, (few - more) / (1 / 100**2 - 1 / 200**2)
    for links in (300, 1000, 3000):
        np.testing.assert_allclose(
            error(links), first / links**2 + second / links**4, rtol=0, atol=3e-12 + 1e-8 / links
        )


@given(st.integers(1, 3000))
@settings(max_examples=15, deadline=None)
def test_a_uniform_chain_of_any_length_has_its_closed_form(links: int) -> None:
    """w_j = 2 sqrt(k/I) sin((2j - 1) pi / (4n + 2)), zeta = c w / (2 k)."""
    modes = find_modes(matrices(linear_arm(chain((700.0,) * links, (0.03,) * links, 0.7))), 5)
    count = np.arange(1, len(modes) + 1)
    exact = 2 * np.sqrt(700.0 / 0.03) * np.sin((2 * count - 1) * np.pi / (4 * links + 2))
    np.testing.assert_allclose([mode.frequency for mode in modes], exact, rtol=1e-11)
    np.testing.assert_allclose([mode.damping_ratio or 0.0 for mode in modes], 0.7 * exact / 1400, rtol=1e-11)
    place = np.arange(1, links + 1)
    shape = np.sin(place * np.pi / (2 * links + 1))
    np.testing.assert_allclose(np.abs(modes[0].shape), shape / shape.max(), rtol=0, atol=1e-11)
    assert all(mode.bound < 1e-9 for mode in modes)


@pytest.mark.parametrize("soft", [1e-3, 1e-9, 1e-15])
def test_a_soft_joint_hides_nothing(soft: float) -> None:
    """Held by next to nothing, a uniform chain swings as one that is free: w_j = 2 sqrt(k/I) sin(j pi / 2n)."""
    scene = chain((soft, *(700.0,) * 149), (0.03,) * 150, 0.0)
    modes = find_modes(matrices(linear_arm(scene)), 4)
    exact = 2 * np.sqrt(700.0 / 0.03) * np.sin(np.arange(1, 4) * np.pi / 300)
    np.testing.assert_allclose([mode.frequency for mode in modes[1:]], exact, rtol=soft + 1e-9)
    assert modes[0].frequency == pytest.approx(np.sqrt(soft / (150 * 0.03)), rel=soft + 1e-9)


decades = st.floats(-7, 7).map(lambda power: 10.0**power)


@given(st.data(), st.integers(1, 9), st.booleans(), st.booleans())
@settings(max_examples=15, deadline=None)
def test_stiff_and_soft_joints_in_one_arm(data: st.DataObject, links: int, hub: bool, planar: bool) -> None:
    """All frequencies against Jacobi's method on the textbook's matrices, in 80 digits; none off by more than told."""
    springs = tuple(data.draw(decades) for _ in range(links))
    scene = (planar_arm if planar else chain)(springs, (0.3,) * links, 0.0, hub)
    found = undamped_modes(matrices(linear_arm(scene)))
    exact = exact_frequencies(scene, np.zeros(links))
    np.testing.assert_allclose(np.sqrt(found.squares), exact, rtol=1e-10)
    assert np.sum(found.squares == 0.0) == hub
    last_bit = np.finfo(float).eps
    swings = slice(int(hub), None)
    off = np.abs(np.sqrt(found.squares[swings]) / exact[swings] - 1)
    assert np.all(off <= found.bounds[swings] + 4 * last_bit)
    # the stiffest joint's bend is known to the last bit of its angles only, and weighs as the root of its stiffness
    known = last_bit * np.sqrt(max(springs) / min(springs))
    assert np.all(found.bounds[swings][:1] <= 4 * links * known)


@given(st.data(), st.integers(2, 7), st.booleans())
@settings(max_examples=8, deadline=None)
def test_bent_arms_under_gravity(data: st.DataObject, links: int, hub: bool) -> None:
    """About any configuration, hanging or toppling, with springs over many decades."""
    springs = tuple(data.draw(st.floats(-2, 7).map(lambda power: 10.0**power)) for _ in range(links))
    angles = np.array([data.draw(st.floats(-3, 3)) for _ in range(links)])
    scene = planar_arm(springs, (0.3,) * links, 0.0, hub, gravity=9.81)
    free = np.append(0.2, angles) if hub else angles
    linear = matrices(linear_arm(scene, rest_at(scene, free)))
    found, exact = undamped_modes(linear).squares, exact_squares(scene, angles)
    assert np.sum(found < 0.0) == np.sum(exact < 0.0) == springs_of(linear.parts).negative
    np.testing.assert_allclose(found, exact, rtol=1e-6)
    lowest = np.argmin(np.abs(exact))
    np.testing.assert_allclose(found[lowest], exact[lowest], rtol=1e-8)


@pytest.mark.parametrize("base", ['kind = "clamp"', MOTOR])
def test_few_modes_of_a_long_arm_are_those_of_all(
    base: str, beam_scene: Callable[..., Scene], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Hanging, damped, 90 links: Lanczos and the projection against dense matrices, poles and shapes alike."""
    scene = beam_scene(links=90, base=base, gravity=9.81, damping=3e-3, tip="[tip]\nmass = 0.1")
    linear = matrices(resting_arm(scene))
    few = find_modes(linear, 3)
    monkeypatch.setattr(undamped, "DENSE", 1000)
    every = find_modes(linear)
    for one, other in zip(few, every, strict=False):
        # dense matrices know less: by their own bounds, which are of first order
        assert other.bound < 2e-8
        np.testing.assert_allclose(one.poles, other.poles, rtol=2.0 * (one.bound + other.bound))
        np.testing.assert_allclose(np.abs(one.shape), np.abs(other.shape), rtol=0, atol=1e-8)
        assert one.bound < 1e-9
    band = modes_up_to(linear, every[20].frequency * 1.001)
    assert len([mode for mode in band if mode.frequency <= every[20].frequency * 1.001]) == 21


def test_a_drooping_arm_of_a_thousand_links(beam_scene: Callable[..., Scene]) -> None:
    """The same series in 1/n^2, with gravity and damping."""
    scene = beam_scene(gravity=9.81, bending=1.0, damping=1e-3)

    def poles(links: int) -> np.ndarray:
        # `with_links` leaves the loads out, not the gravity
        return np.array(
            [mode.poles[0] for mode in find_modes(matrices(resting_arm(with_links(scene, links))), 3)]
        )

    few, more, many = (poles(links) for links in (125, 250, 1000))
    limit = (4 * more - few) / 3
    np.testing.assert_allclose(many, limit + (few - more) / 3 / 16, rtol=2e-8)


def test_an_arm_turns_freely_only_where_nothing_holds_it(beam_scene: Callable[..., Scene]) -> None:
    """Decided by what there is: a hub, and no gravity; not by how small a number came out."""
    for stiffness in (1e-12, 1.0, 1e12):
        for gravity in (0.0, 1e-12, 9.81):
            scene = beam_scene(links=4, base=MOTOR, bending=stiffness, gravity=gravity)
            rest = rest_at(scene, np.full(5, -np.pi / 2))
            squares = undamped_modes(matrices(linear_arm(scene, rest))).squares
            assert np.sum(squares == 0.0) == (gravity == 0.0)
            assert np.all(squares[1:] > 0.0)


@pytest.mark.parametrize("kernels", ["Prescott", "SkylakeX"])
def test_other_processors_find_the_same(kernels: str) -> None:
    """OpenBLAS for other processors rounds otherwise; one that this machine cannot run is left out."""
    program = (
        "from tests.modal.test_digits import *\n"
        "for hub in (False, True):\n"
        "    arm = planar_arm((1e9, 1.0, 1e-5, 1e7), (0.3,) * 4, 0.0, hub)\n"
        "    print(*undamped_modes(matrices(linear_arm(arm))).squares.tolist())\n"
    )
    ran = subprocess.run(
        [sys.executable, "-c", program],
        env={**os.environ, "OPENBLAS_CORETYPE": kernels},
        capture_output=True,
        text=True,
        check=False,
    )
    if ran.returncode < 0:
        pytest.skip(f"this processor has not the instructions of {kernels}")
    assert ran.stderr == ""
    for hub, line in zip((False, True), ran.stdout.splitlines(), strict=True):
        exact = exact_squares(planar_arm((1e9, 1.0, 1e-5, 1e7), (0.3,) * 4, 0.0, hub), np.zeros(4))
        np.testing.assert_allclose(np.array(line.split(), float), exact, rtol=1e-10, atol=1e-30)


def chain(
    springs: tuple[float, ...], inertias: tuple[float, ...], damping: float, hub: bool = False
) -> Scene:
    """Return a chain of joints and links, on a clamp or behind a motor of inertia 0.05."""
    scene = parse_scene(
        'name = "a"\n[model]\nkind = "chain"\n[integrator]\nname = "newmark"\nstep = 1e-3\n[base]\n'
        + ('kind = "motor"\ninertia = 0.05\n' if hub else 'kind = "clamp"\n')
        + '[[joint]]\nstiffness = 1.0\n[[link]]\ninertia = 1.0\n[[output]]\nname = "o"\nat = "tip"\nof = "angle"\n'
    )
    joints = tuple(scene.joints[0].model_copy(update={"stiffness": k, "damping": damping}) for k in springs)
    links = tuple(scene.links[0].model_copy(update={"inertia": i}) for i in inertias)
    still = (0.0,) * len(springs)
    return replace(scene, joints=joints, links=links, initial=Initial(still, still))


def planar_arm(
    springs: tuple[float, ...],
    masses: tuple[float, ...],
    damping: float,
    hub: bool = False,
    gravity: float = 0.0,
) -> Scene:
    """Return an arm of links of 0.4 m."""
    scene = parse_scene(
        f'name = "a"\n[model]\nkind = "planar"\ngravity = {gravity}\n[integrator]\nname = "newmark"\nstep = 1e-3\n'
        + "[base]\n"
        + ('kind = "motor"\ninertia = 0.05\n' if hub else 'kind = "clamp"\n')
        + "[[joint]]\nstiffness = 1.0\n[[link]]\nlength = 0.4\nmass = 1.0\ninertia = 1.0\n"
        + '[[output]]\nname = "o"\nat = "tip"\nof = "angle"\n'
    )
    joints = tuple(scene.joints[0].model_copy(update={"stiffness": k, "damping": damping}) for k in springs)
    links = tuple(scene.links[0].model_copy(update={"mass": m, "inertia": m * 0.16 / 12}) for m in masses)
    still = (0.0,) * len(springs)
    return replace(scene, joints=joints, links=links, initial=Initial(still, still))


def exact_frequencies(scene: Scene, angles: np.ndarray) -> np.ndarray:
    found: np.ndarray = np.sqrt(np.maximum(exact_squares(scene, angles), 0.0))
    return found


def exact_squares(scene: Scene, angles: np.ndarray) -> np.ndarray:
    """Return all squares from Lagrange's equations, written out here, in 80 digits."""
    n, hub = scene.stations, int(scene.base.kind == "motor")
    with mpmath.workdps(80):
        mass, stiffness = mpmath.zeros(n + hub), mpmath.zeros(n + hub)
        if hub:
            mass[0, 0] = mpmath.mpf(scene.base.inertia)
        for i, joint in enumerate(scene.joints):
            bend = mpmath.zeros(1, n + hub)
            bend[i + hub] = 1
            if i + hub:
                bend[i + hub - 1] = -1
            stiffness += bend.T * bend * mpmath.mpf(joint.stiffness)
        for i, link in enumerate(scene.links):
            mass[i + hub, i + hub] += mpmath.mpf(link.inertia)
            if scene.model.kind == "chain":
                continue
            weight, arm = mpmath.mpf(link.mass), mpmath.zeros(2, n + hub)
            for j in range(i + 1):
                length = mpmath.mpf(scene.links[j].length) * (mpmath.mpf(link.center) if j == i else 1)
                arm[0, j + hub] = -length * mpmath.sin(angles[j])
                arm[1, j + hub] = length * mpmath.cos(angles[j])
                # gravity's potential is m g y, and y'' = -length sin
                height = weight * mpmath.mpf(scene.model.gravity or 0.0)
                stiffness[j + hub, j + hub] -= height * length * mpmath.sin(angles[j])
            mass += arm.T * arm * weight
        lower = mpmath.cholesky(mass) ** -1
        squares = sorted(mpmath.eigsy(lower * stiffness * lower.T, eigvals_only=True))
        return np.array([0.0 if abs(s) < mpmath.mpf(10) ** -40 else float(s) for s in squares])
