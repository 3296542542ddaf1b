"""Simulations by generated kernels: both backends alike, inputs at the stages' instants, divergence told."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from tmm_gen.inputs.signals import Constant, Signal, Sine, Table
from tmm_gen.reference.duration import default_duration
from tmm_gen.reference.frequency import fastest_mode
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import Scene
from tmm_gen.simulate.divergence import DivergedError, watch
from tmm_gen.simulate.run import number_of_steps, simulate
from tmm_gen.simulate.stepping import Backend

LOADS: dict[str, Signal] = {
    "outer": Sine(1.5, 5.0, 0.4),
    "inner": Table(np.array([0.0, 0.6, 1.0]), np.array([0.5, -1.0, 2.0])),
}


@pytest.mark.compiler
@pytest.mark.parametrize(
    "name", ["newmark", "wilson", "generalized_alpha", "houbolt", "zhou", "bathe", "sdirk4"]
)
def test_both_backends_read_inputs_alike(name: str, chain: Callable[[str], Scene]) -> None:
    scene = chain("clamp").replace(**{"integrator.name": name, "integrator.step": 0.005})
    first, second = (simulate(scene, LOADS, 1.5, backend) for backend in ("numpy", "c"))
    assert (first.backend, second.backend, first.steps) == ("numpy", "c", 300)
    exact = exact_response(scene, LOADS, first.time)
    for output in scene.outputs:
        values = first.outputs[output.name]
        scale = np.abs(values).max()
        np.testing.assert_allclose(second.outputs[output.name], values, rtol=0, atol=1e-12 * scale)
        if output.of != "acceleration":
            assert np.abs(values - exact[output.name]).max() < 0.02 * scale


@pytest.mark.compiler
@pytest.mark.parametrize("backend", ["numpy", "c"])
def test_a_smooth_input_keeps_the_order_of_a_method_with_stages(
    backend: Backend, chain: Callable[[str], Scene]
) -> None:
    load: dict[str, Signal] = {"outer": LOADS["outer"]}
    errors = []
    for step in (0.02, 0.01):
        scene = chain("clamp").replace(**{"integrator.name": "sdirk4", "integrator.step": step})
        found = simulate(scene, load, 1.0, backend)
        errors.append(np.abs(found.outputs["tip"] - exact_response(scene, load, found.time)["tip"]).max())
    assert errors[0] / errors[1] == pytest.approx(16.0, rel=0.1)


def test_progress_counts_every_row(example: Callable[[str], Scene]) -> None:
    counted: list[float] = []
    found = simulate(example("thesis2"), {}, 25.0, advance=counted.append)
    assert sum(counted) == found.steps + 1 == 2501
    assert len(counted) > 1


@pytest.mark.parametrize(
    ("until", "step", "steps"), [(1.0, 0.1, 10), (0.3, 0.1, 3), (0.31, 0.1, 4), (0.01, 0.1, 1)]
)
def test_the_last_step_reaches_the_end(until: float, step: float, steps: int) -> None:
    assert number_of_steps(until, step) == steps


def test_at_rest_only_where_motion_can_die_out(chain: Callable[[str], Scene]) -> None:
    scene = chain("clamp")
    held = simulate(scene, {"outer": Constant(2.0)}, 0.1).rest
    assert held is not None
    assert held["tip"] == pytest.approx(2.0 * (1 / 20 + 1 / 35 + 1 / 10))
    assert (held["speed"], held["jolt"]) == (0.0, 0.0)
    assert simulate(scene, {"outer": LOADS["outer"]}, 0.1).rest is None
    assert simulate(scene, {"inner": LOADS["inner"]}, 0.5).rest is None
    assert simulate(scene, {"inner": LOADS["inner"]}, 1.5).rest is not None
    assert simulate(chain("motor"), {}, 0.1).rest is None


def test_default_duration_is_a_few_slow_periods(
    example: Callable[[str], Scene], chain: Callable[[str], Scene]
) -> None:
    # Lowest frequency of n equal stations behind a clamp: 2 sqrt(k/I) sin(pi / (4 n + 2)).
    for name, ratio, n in (("thesis2", 4.0, 2), ("thesis10", 20.0, 10), ("hundred", 40000.0, 100)):
        period = np.pi / (np.sqrt(ratio) * np.sin(np.pi / (4 * n + 2)))
        assert 5 * period <= default_duration(example(name)) <= 8 * period
    assert default_duration(chain("motor")) < 50.0  # not that of turning as a whole, which is endless


def test_fastest_mode_of_equal_stations(example: Callable[[str], Scene]) -> None:
    mode = fastest_mode(example("thesis10"))
    assert mode.frequency == pytest.approx(2 * np.sqrt(20.0) * np.cos(np.pi / 21))
    assert mode.damping_ratio == pytest.approx(5.0 / 20.0 * mode.frequency / 2)


@pytest.mark.compiler
@pytest.mark.parametrize("backend", ["numpy", "c"])
@pytest.mark.parametrize(
    ("changes", "step", "said"),
    [
        ({"integrator.name": "zhai", "joint.1.damping": 0.0}, 0.3, "2 of zhai. Use a step below 0.22 s"),
        ({"integrator.name": "zhai"}, 0.1, "at its damping ratio of 1.1"),
        ({"integrator.beta": 0.0, "joint.1.damping": 0.0}, 0.3, "limit 2 of newmark"),
        ({"integrator.name": "zhou", "joint.1.damping": 0.0}, 0.3, "motion grows with zhou at any step"),
    ],
)  # fmt: skip
def test_divergence_names_time_station_cause_and_remedy(
    changes: dict[str, object], step: float, said: str, backend: Backend, example: Callable[[str], Scene]
) -> None:
    scene = example("thesis10").replace(**{"integrator.step": step, **changes})
    with pytest.raises(
        DivergedError, match=r"at t = [\d.]+ s the angle of station \d+ has reached"
    ) as caught:
        simulate(scene, {"tip_torque": Constant(1.0)}, 400.0, backend)
    assert said in str(caught.value)
    assert "integrator.name=newmark" in str(caught.value)
    assert caught.value.exit_code == 1


def test_both_backends_tell_the_same_divergence(example: Callable[[str], Scene]) -> None:
    scene = example("hundred").replace(**{"integrator.name": "zhai", "integrator.step": 0.006})
    said = []
    for backend in ("numpy", "c"):
        with pytest.raises(DivergedError) as caught:
            simulate(scene, {"tip_torque": Sine(1.0, 3.0, 1.0)}, 1.0, backend)  # type: ignore[arg-type]
        said.append(str(caught.value))
    assert said[0] == said[1]


def test_growth_that_is_not_the_integrators(example: Callable[[str], Scene]) -> None:
    scene = example("thesis2")
    guard = watch(scene, {"tip_torque": Constant(1.0)}, 20.0, 0.01)
    guard.look(1.0, np.array([0.1, -0.2]))
    with pytest.raises(DivergedError, match="station 2 is no longer a finite number"):
        guard.look(1.0, np.array([0.1, np.nan]))
    with pytest.raises(DivergedError, match="station 1 has reached"):
        guard.look(1.0, np.array([1e6, 0.0]))
    lossy = watch(scene.replace(**{"model.sweep": "product"}), {}, 20.0, 0.01)
    with pytest.raises(DivergedError, match="the plain product loses its digits"):
        lossy.look(1.0, np.array([1.0, 0.0]))


def test_a_resonance_is_no_divergence(example: Callable[[str], Scene]) -> None:
    scene = example("thesis2").replace(
        **{"joint.1.damping": 0.0, "joint.2.damping": 0.0, "integrator.step": 0.05}
    )
    lowest = 4.0 * np.sin(np.pi / 10)
    found = simulate(scene, {"tip_torque": Sine(1.0, lowest)}, 500.0, refuse=False)
    assert np.abs(found.outputs["tip"]).max() > 10.0
