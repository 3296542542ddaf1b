"""The exact response agrees with closed forms, with a general integrator run to its limit, and with modes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.modal_part import modal_response

from tmm_gen.inputs.signals import Constant, Signal, Sine, Table
from tmm_gen.reference.assembly import assemble
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import Scene

TABLE = Table(np.array([0.2, 0.5, 0.55, 1.1]), np.array([0.0, 1.5, -1.0, 0.5]))
SIGNALS: dict[str, Signal] = {
    "hub": Table(np.array([0.0, 0.4, 0.9]), np.array([0.0, 0.3, -0.1])),
    "inner": Sine(2.0, 7.0, 0.3),
    "outer": TABLE,
}


def by_hand(scene: Scene, signals: dict[str, Signal], times: np.ndarray) -> dict[str, np.ndarray]:
    """Write the torques of each joint out, and leave the rest to a general integrator, from knot to knot."""
    n, base = scene.stations, scene.base.kind
    first = 1 if base == "motor" else 0
    signals = {item.name: signals.get(item.name, Constant(0.0)) for item in scene.inputs}

    def torques(t: float, angles: np.ndarray, rates: np.ndarray) -> np.ndarray:
        found = []
        for j, joint in enumerate(scene.joints):
            outer = first + j
            inner_angle = inner_rate = 0.0
            if outer:
                inner_angle, inner_rate = angles[outer - 1], rates[outer - 1]
            elif base == "prescribed":
                inner_angle, inner_rate = signals["hub"].at(t), signals["hub"].slope(t)
            found.append(
                joint.stiffness * (angles[outer] - inner_angle) + joint.damping * (rates[outer] - inner_rate)
            )
        return np.array(found)

    def accelerations(t: float, angles: np.ndarray, rates: np.ndarray) -> np.ndarray:
        across = torques(t, angles, rates)
        net = np.append(across[1:], 0.0) - across
        for item in scene.inputs:
            if item.at != "base":
                net[(n if item.at == "tip" else item.at) - 1] += signals[item.name].at(t)
        links = net / [link.inertia for link in scene.links]
        if base != "motor":
            return links
        hub = across[0] - scene.base.damping * rates[0] + signals["hub"].at(t)
        return np.concatenate([[hub / scene.base.inertia], links])

    m = n + first
    state = np.array([0.0] * first + list(scene.initial.angles) + [0.0] * first + list(scene.initial.rates))
    stops = np.unique(np.concatenate([[0.0, times[-1]], times, *(s.knots for s in signals.values())]))
    stops = stops[stops <= times[-1]]
    rows = []
    for k, now in enumerate(stops):
        if now in times:
            angles, rates = state[:m], state[m:]
            across = torques(now, angles, rates)
            rows.append(
                {
                    "tip": angles[-1],
                    "speed": rates[first],
                    "jolt": accelerations(now, angles, rates)[first + 1],
                    "joint3": across[2],
                    "base_torque": across[0],
                }
            )
        if k + 1 < len(stops):
            # The slope to the right of the knot holds on the whole piece; its end must not see the next one.
            inside = np.nextafter(stops[k + 1], now)
            done = solve_ivp(
                lambda t, s, inside=inside: np.concatenate(
                    [s[m:], accelerations(min(t, inside), s[:m], s[m:])]
                ),
                (now, stops[k + 1]),
                state,
                method="DOP853",
                rtol=1e-12,
                atol=1e-13,
            )
            state = done.y[:, -1]
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


@pytest.mark.parametrize("base", ["clamp", "motor", "prescribed"])
def test_every_base_and_input_agrees_with_a_general_integrator(
    base: str, chain: Callable[[str], Scene]
) -> None:
    scene = chain(base)
    times = np.array([0.0, 0.03, 0.2, 0.37, 0.5, 0.52, 0.9, 1.0, 1.4])
    expected = by_hand(scene, SIGNALS, times)
    found = exact_response(scene, {k: v for k, v in SIGNALS.items() if k in assemble(scene).inputs}, times)
    assert list(found) == ["tip", "speed", "jolt", "joint3", "base_torque"]
    for name, values in found.items():
        np.testing.assert_allclose(values, expected[name], rtol=0, atol=2e-9, err_msg=name)


def test_one_station_is_the_damped_oscillator(example: Callable[[str], Scene]) -> None:
    text = {"joint": [{"stiffness": 20.0, "damping": 5.0}], "link": [{"inertia": 5.0}]}
    scene = example("thesis2").replace(**text)
    times = np.linspace(0.0, 10.0, 101)
    decay, turn = 0.5, np.sqrt(4.0 - 0.25)
    swing = np.cos(turn * times) + decay / turn * np.sin(turn * times)
    closed = (1.0 - np.exp(-decay * times) * swing) / 20.0
    found = exact_response(scene, {"tip_torque": Constant(1.0)}, times)["tip"]
    np.testing.assert_allclose(found, closed, rtol=0, atol=1e-15)


def test_sampling_does_not_change_the_response(chain: Callable[[str], Scene]) -> None:
    scene = chain("prescribed")
    fine = np.linspace(0.0, 1.5, 301)
    some = np.sort(np.random.default_rng(1).choice(fine, 40, replace=False))
    whole = exact_response(scene, SIGNALS, fine)
    part = exact_response(scene, SIGNALS, some)
    for name in whole:
        np.testing.assert_allclose(part[name], whole[name][np.isin(fine, some)], rtol=0, atol=1e-12)


@pytest.mark.parametrize("name", ["thesis10", "hundred"])
def test_modes_give_the_same(name: str, example: Callable[[str], Scene]) -> None:
    scene = example(name)
    times = np.linspace(0.0, 2.0, 41)
    exact = exact_response(scene, {"tip_torque": Constant(1.0)}, times)
    modal = modal_response(scene, {"tip_torque": 1.0}, times)
    for output, values in modal.items():
        np.testing.assert_allclose(values, exact[output], rtol=0, atol=1e-10 * np.abs(exact[output]).max())


def test_modes_of_a_critically_damped_station(example: Callable[[str], Scene]) -> None:
    text = {"joint": [{"stiffness": 4.0, "damping": 4.0}], "link": [{"inertia": 1.0}]}
    scene = example("thesis2").replace(**text)
    times = np.linspace(0.0, 4.0, 9)
    closed = (1.0 - (1.0 + 2.0 * times) * np.exp(-2.0 * times)) / 4.0
    np.testing.assert_allclose(
        modal_response(scene, {"tip_torque": 1.0}, times)["tip"], closed, rtol=0, atol=1e-15
    )


@pytest.mark.parametrize("base", ["motor", "prescribed", "clamp"])
def test_modes_refuse_what_does_not_decouple(base: str, chain: Callable[[str], Scene]) -> None:
    with pytest.raises(ValueError, match="decoupled"):
        modal_response(chain(base), {}, np.array([1.0]))


def test_static_deflection(chain: Callable[[str], Scene], example: Callable[[str], Scene]) -> None:
    held = assemble(example("thesis10"))
    np.testing.assert_allclose(held.static(np.array([2.0])), [1.0, 2.0], rtol=1e-13)
    turned = assemble(chain("prescribed")).static(np.array([0.3, 0.0, 1.0]))
    np.testing.assert_allclose(turned, [0.3 + 1 / 20 + 1 / 35 + 1 / 10, 0, 0, 1.0, 1.0], atol=1e-13)
    free = assemble(chain("motor"))
    assert free.free
    with pytest.raises(ValueError, match="no static deflection"):
        free.static(np.zeros(3))


@pytest.mark.parametrize("signal", [Constant(0.7), Sine(1.2, 3.0, 0.4), TABLE])
def test_signals_have_the_slope_of_their_values(signal: Signal) -> None:
    for time in (0.05, 0.3, 0.52, 0.8, 1.5):
        difference = (signal.at(time + 1e-6) - signal.at(time - 1e-6)) / 2e-6
        assert signal.slope(time) == pytest.approx(float(difference), abs=1e-8)
    assert signal.at(np.zeros((2, 3))).shape == (2, 3)
