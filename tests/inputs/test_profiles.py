"""Profiles: what each is, that slope and curvature are its derivatives, and how they are written."""

from __future__ import annotations

import re

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st

from tmm_gen.cli.run import run
from tmm_gen.errors import UserError
from tmm_gen.inputs.given import read_inputs
from tmm_gen.inputs.profiles import PROFILES, profile
from tmm_gen.inputs.signals import Signal, Sine
from tmm_gen.inputs.waveforms import Chirp, Smooth, Step

values = st.floats(-10.0, 10.0)
times = st.floats(0.1, 3.0)
smooth_signals = st.one_of(
    st.builds(Smooth, values, values, times, st.floats(0.0, 1.0)),
    st.builds(Sine, values, st.floats(0.1, 20.0), values),
    st.builds(Chirp, values, st.floats(0.0, 5.0), st.floats(0.0, 5.0), times),
)


@settings(max_examples=60, deadline=None)
@given(signal=smooth_signals, time=st.floats(0.0, 4.0))
def test_slope_and_curvature_are_the_derivatives(signal: Signal, time: float) -> None:
    if np.min(np.abs(signal.knots - time), initial=1.0) < 1e-4:
        return
    apart = 1e-5
    before, after = time - apart, time + apart
    scale = 10.0 * (1.0 + 2.0 * np.pi * 30.0) ** 3 * apart**2 + 1e-4
    slope = (signal.at(after) - signal.at(before)) / (2.0 * apart)
    curvature = (signal.slope(after) - signal.slope(before)) / (2.0 * apart)
    assert float(signal.slope(time)) == pytest.approx(float(slope), abs=scale)
    assert float(signal.curvature(time)) == pytest.approx(float(curvature), abs=scale * 1e3)


@settings(max_examples=30, deadline=None)
@given(before=values, after=values, duration=times, start=st.floats(0.0, 1.0))
def test_smooth_goes_from_rest_to_rest(before: float, after: float, duration: float, start: float) -> None:
    signal = Smooth(before, after, duration, start)
    ends = np.array([0.0, start, start + duration, start + duration + 1.0])
    np.testing.assert_allclose(signal.at(ends), [before, before, after, after], rtol=0, atol=1e-12)
    size = abs(after - before) / duration**2
    np.testing.assert_allclose(signal.slope(ends), 0.0, atol=1e-9 * size * duration)
    np.testing.assert_allclose(signal.curvature(ends), 0.0, atol=1e-6 * size)
    # its largest rate is 15/8 of the mean one
    fine = start + duration * np.linspace(0.0, 1.0, 1001)
    assert np.max(np.abs(signal.slope(fine))) == pytest.approx(
        15 / 8 * abs(after - before) / duration, rel=1e-9
    )


def test_a_chirp_has_its_frequencies() -> None:
    chirp = Chirp(2.0, 1.0, 5.0, 3.0)
    crossings = np.flatnonzero(np.diff(np.sign(chirp.at(np.linspace(1e-6, 3.0, 100001)))) != 0)
    assert len(crossings) == pytest.approx(2 * 3.0 * (1.0 + 5.0) / 2, abs=1)
    later = np.linspace(3.0, 5.0, 100001)
    crossings = np.flatnonzero(np.diff(np.sign(chirp.at(later + 1e-6))) != 0)
    assert len(crossings) == pytest.approx(2 * 2.0 * 5.0, abs=1)


@pytest.mark.parametrize(
    ("text", "at", "value"),
    [
        ("step:0:2:0.1s", [0.0, 0.0999, 0.1, 5.0], [0, 0, 2, 2]),
        ("step:1:3", [0.0], [3]),
        ("ramp:0:2:500ms", [0.0, 0.25, 0.5, 1.0], [0, 1, 2, 2]),
        ("ramp:1:-1:1:2s", [0.0, 2.0, 2.5, 3.0], [1, 1, 0, -1]),
        ("smooth:0:1.5:0.8s", [0.0, 0.4, 0.8], [0, 0.75, 1.5]),
        ("sine:0.5:2Hz", [0.0, 0.125, 0.25], [0, 0.5, 0]),
        ("sine:0.5:2:90deg", [0.0, 0.125], [0.5, 0]),
        ("sine:1:0.001kHz", [0.25], [1]),
        ("chirp:1:1Hz:1Hz:1s", [0.25, 1.25], [1, 1]),
    ],
)
def test_texts_and_their_values(text: str, at: list[float], value: list[float]) -> None:
    signal = read_inputs([f"load={text}"], ("load",))["load"]
    np.testing.assert_allclose(signal.at(at), value, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("smoth:0:1:1", "no profile is named 'smoth'; there are step, ramp, smooth, sine, chirp"),
        ("smooth:0:1", "smooth does not take 2 numbers. Write smooth:FROM:TO:TIME[:START]"),
        ("smooth:0:1:1:1:1", "smooth does not take 5 numbers"),
        ("smooth:0:1:0s", "TIME must be positive, not 0"),
        ("smooth:0:1:-1s", "TIME must be positive, not -1"),
        ("smooth:0:1:1:-1", "START must be zero or more"),
        ("sine:1:-3Hz", "FREQUENCY must be zero or more"),
        ("sine:1:3s", "'3s' is not a finite number (Hz or kHz)"),
        ("smooth:0:1:1 min", "'1 min' is not a finite number (s or ms)"),
        ("smooth:0:x:1", "'x' is not a finite number. Write smooth:"),
        ("step:0:inf", "'inf' is not a finite number"),
        ("ramp", "ramp does not take 0 numbers"),
    ],
)
def test_what_is_refused(text: str, said: str) -> None:
    with pytest.raises(UserError, match=re.escape(said)):
        read_inputs([f"load={text}"], ("load",))


@pytest.mark.parametrize("name", PROFILES)
def test_the_help_names_each_profile_and_the_examples_work(name: str) -> None:
    shown = CliRunner().invoke(run, ["--help"]).output
    assert f"{name}{PROFILES[name].parameters}" in shown
    assert profile(PROFILES[name].example, "x").at(0.0).shape == ()


def test_a_step_is_one_value_then_another() -> None:
    step = Step(1.0, 2.0, 0.5)
    assert step.ends == 0.5
    assert step.slope([0.1, 0.5]).tolist() == step.curvature([0.1, 0.5]).tolist() == [0.0, 0.0]
