"""Runs by steps of chosen length are as right as their tolerance says, and their steps are where they have to be."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest

from tmm_gen.inputs.curve import through
from tmm_gen.inputs.profiles import Step
from tmm_gen.inputs.signals import Constant, Signal, Sine, Table
from tmm_gen.native.python_module import numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.simulate.accuracy import order_of
from tmm_gen.simulate.adaptive.kernel import AnyLength
from tmm_gen.simulate.adaptive.kinks import Kinks
from tmm_gen.simulate.adaptive.length import RATIO, Ladder, landing
from tmm_gen.simulate.adaptive.march import Aim, march
from tmm_gen.simulate.adaptive.passes import ToleranceError
from tmm_gen.simulate.run import simulate
from tmm_gen.simulate.stages import StagePolynomial, stage_polynomial
from tmm_gen.simulate.stepping import Backend, Stepper

CHAIN = """
name = "pair"
[model]
kind = "chain"
[integrator]
name = "newmark"
step = 0.01
tolerance = 1e-4
[base]
kind = "clamp"
[[joint]]
stiffness = 40.0
damping = 0.01
repeat = 2
[[link]]
inertia = 0.01
repeat = 2
[[input]]
name = "push"
at = "tip"
acts = "torque"
[[output]]
name = "tip"
at = "tip"
of = "angle"
[[output]]
name = "inner"
at = 1
of = "angle"
"""
"""Its slow period is 0.16 s."""

ARM = """
name = "bent"
[model]
kind = "planar"
gravity = 9.81
[integrator]
name = "sdirk4"
step = 0.01
tolerance = 1e-5
[base]
kind = "clamp"
[[joint]]
stiffness = 60.0
damping = 0.05
repeat = 2
[[link]]
length = 0.3
mass = 0.2
inertia = 0.0015
repeat = 2
[[input]]
name = "pull"
at = "tip"
acts = "force_y"
[[output]]
name = "tip"
at = "tip"
of = "position"
[[output]]
name = "bend"
at = 1
of = "torque"
"""

LOADS: dict[str, Signal] = {
    "jump": Step(0.0, 2.0, 0.0731),
    "table": Table(np.array([0.0, 0.05, 0.0713, 0.2]), np.array([0.0, 1.0, -1.0, 2.0])),
    "sine": Sine(1.0, 30.0),
}
UNTIL = 0.25


@pytest.fixture(scope="module")
def pair() -> Scene:
    return parse_scene(CHAIN)


@pytest.fixture(scope="module")
def bent() -> Scene:
    return parse_scene(ARM)


def true_error(scene: Scene, load: Signal, backend: Backend = "numpy") -> tuple[float, int]:
    """Return the error of a chain's run over all rows, as a share of its motion, and the steps it took."""
    run = simulate(scene, {"push": load}, UNTIL, backend)
    exact = exact_response(scene, {"push": load}, run.time)
    off = max(float(np.max(np.abs(run.outputs[name] - values))) for name, values in exact.items())
    assert run.accuracy is not None
    assert run.accuracy.error <= scene.integrator.tolerance  # type: ignore[operator]
    return off / max(float(np.max(np.abs(values - values[0]))) for values in exact.values()), run.steps


# -- the tolerance holds ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("load", LOADS)
def test_the_error_of_a_chain_is_its_tolerance(pair: Scene, load: str) -> None:
    error, _ = true_error(pair, LOADS[load])
    assert 1e-6 < error <= 1.2e-4  # a share of it, and what rows between steps may add


@pytest.mark.parametrize("name", ["generalized_alpha", "wilson", "radau3", "gauss2"])
def test_with_other_integrators(pair: Scene, name: str) -> None:
    error, _ = true_error(pair.replace(**{"integrator.name": name}), LOADS["table"])
    assert error <= 1.2e-4


def test_steps_grow_in_number_by_the_order_of_the_integrator(pair: Scene) -> None:
    counts, errors = [], []
    for tolerance in (2e-3, 1e-4):
        error, steps = true_error(pair.replace(**{"integrator.tolerance": tolerance}), LOADS["jump"])
        errors.append(error)
        counts.append(steps)
    slope = np.log(errors[0] / errors[1]) / np.log(counts[1] / counts[0])
    assert slope == pytest.approx(2.0, abs=0.5)
    assert errors[1] <= 1.2e-4


@pytest.mark.compiler
def test_a_violent_release_in_a_plane(bent: Scene) -> None:
    """A force bends the arm, and is let go: a run by another method is the truth, in fine steps that end there."""
    load = {"pull": Step(-15.0, 0.0, 0.1037)}
    run = simulate(bent, load, 0.25, "c", trace=True)
    fine = bent.replace(**{"integrator.name": "gauss2", "integrator.step": 0.1037 / 1000})
    truth = simulate(fine, load, 0.25, "c", fixed=True, judge=False, every=0.01, trace=True)
    assert run.chosen is not None
    assert run.trace is not None
    assert truth.trace is not None
    off = np.max(np.abs(run.trace.angle - truth.trace.angle[: len(run.trace.angle)]))
    assert off <= 2e-5 * np.ptp(truth.trace.angle)
    assert run.chosen.largest > 10 * run.chosen.smallest


@pytest.mark.compiler
def test_both_backends_take_the_same_steps(bent: Scene) -> None:
    loose = bent.replace(**{"integrator.tolerance": 1e-3, "integrator.name": "gauss2"})
    runs = [simulate(loose, {"pull": Constant(3.0)}, 0.1, backend) for backend in ("numpy", "c")]  # type: ignore[arg-type]
    assert runs[0].chosen == runs[1].chosen
    for name, values in runs[0].outputs.items():
        np.testing.assert_allclose(runs[1].outputs[name], values, atol=1e-9)


@pytest.mark.compiler
def test_what_no_step_can_keep_is_refused_with_a_remedy_that_works(pair: Scene) -> None:
    single = pair.replace(**{"emit.real": "float32", "integrator.tolerance": 1e-8})
    with pytest.raises(ToleranceError, match="however short steps are") as caught:
        simulate(single, {"push": LOADS["sine"]}, 0.2, "c")
    larger = float(str(caught.value).split("--tolerance ")[1].split(";")[0])
    simulate(single.replace(**{"integrator.tolerance": larger}), {"push": LOADS["sine"]}, 0.2, "c")


# -- where steps end --------------------------------------------------------------------------------------------------


def kernel_of(scene: Scene) -> AnyLength:
    module = numpy_module(scene, build_program(scene, auto=scene.model.auto))
    return AnyLength(Stepper("numpy", module), {})


def test_steps_end_at_kinks_and_are_rungs_elsewhere(pair: Scene) -> None:
    kernel, load = kernel_of(pair), LOADS["table"]
    kinks = Kinks({"push": load}, UNTIL)
    run = march(pair, kernel, kinks, {}, Aim(1e-6, 2.0, 0.05, 1e-3), lambda share: None)
    assert set(load.knots[1:]) <= set(run.times)
    assert run.times[-1] == UNTIL
    assert np.all(np.diff(run.times) > 0.0)
    rungs = np.log(np.array(run.came) / pair.integrator.step) / np.log(RATIO)
    whole = np.abs(rungs - np.round(rungs)) < 1e-9
    assert np.mean(whole) > 0.9  # two steps before each kink are not
    # a rung and its half are prepared once
    assert kernel.lengths <= 2 * len(set(np.round(rungs[whole]))) + 2 * np.sum(~whole)


def test_inputs_are_read_on_their_own_side_of_a_kink() -> None:
    base = through(Table(np.array([0.0, 0.5, 1.0]), np.array([0.0, 1.0, 0.0])))
    kinks = Kinks({"step": Step(1.0, 5.0, 0.25), "base": base}, 2.0)
    assert kinks.stops.tolist() == [0.25, 0.5, 1.0, 2.0]
    found = kinks.read(np.array([0.2, 0.25, 0.3]), kinks.next(0.1))
    assert found["step"].tolist() == [1.0, 1.0, 1.0]
    assert found["base"] == pytest.approx([0.4, 0.5, 0.6])
    assert kinks.read(np.array([0.25, 0.3]), kinks.next(0.25))["step"].tolist() == [5.0, 5.0]
    assert [kinks.jumps(stop) for stop in kinks.stops[:3]] == [True, False, False]


def test_a_landing_leaves_no_tiny_step() -> None:
    assert landing(0.1, 0.1 + 1e-12) == (0.1 + 1e-12, True)
    assert landing(0.1, 0.11) == (0.055, False)
    assert landing(0.1, 0.21) == (0.1, False)


def test_small_changes_of_length_add_up_to_a_rung() -> None:
    ladder = Ladder(0.01, 2.0)
    wanted = 0.01
    for _ in range(200):
        wanted = ladder.accepted(ladder.rung(wanted), wanted, 0.05 * (ladder.rung(wanted) / 0.01) ** 3)
    assert 0.2 < 0.05 * (ladder.rung(wanted) / 0.01) ** 3 < 1.0


# -- what is carried from step to step --------------------------------------------------------------------------------


@pytest.mark.parametrize("rho", [None, 0.0, 0.8])
def test_accelerations_settle_behind_a_jump(pair: Scene, rho: float | None) -> None:
    if rho is not None:
        pair = pair.replace(**{"integrator.name": "generalized_alpha", "integrator.rho_inf": rho})
    kernel = kernel_of(pair)
    still, pushed = ({"push": np.array([value])} for value in (0.0, 2.0))
    found = kernel.settled(kernel.start(still, {}), None, 1e-7, pushed)
    wanted = kernel.start(pushed, {})
    np.testing.assert_allclose(
        found["acceleration"], wanted["acceleration"], atol=1e-6 * np.max(wanted["acceleration"])
    )
    assert np.all(found["angle"] == 0.0)


def test_stages_of_another_length_lie_on_the_polynomial_of_the_last_step(bent: Scene) -> None:
    nodes = (0.2, 0.7, 1.0)
    polynomial = StagePolynomial(nodes, ("acceleration",))

    def values(begin: float, span: float) -> Mapping[str, np.ndarray]:
        return {
            name: np.array([3.0 - t + 2.0 * t**2, t**2])
            for name, t in zip(
                polynomial.names("acceleration"), (begin + span * c for c in nodes), strict=True
            )
        }

    found = polynomial.over(values(0.0, 1.0), 1.0 - 1.7, 1.7)
    assert list(found) == ["acceleration_stage1", "acceleration_stage2", "acceleration"]
    for name, value in values(1.0 - 1.7, 1.7).items():
        np.testing.assert_allclose(found[name], value, atol=1e-13)
    assert stage_polynomial(bent, ["angle", "acceleration"]) is None


def test_the_order_relied_on_is_derived(pair: Scene) -> None:
    from tmm_gen.derive.integrators.order import order
    from tmm_gen.derive.integrators.registry import integrator

    for name in ("fox_euler", "newmark", "sdirk4", "radau3"):
        assert order_of(pair.replace(**{"integrator.name": name})) == order(integrator(name)), name
