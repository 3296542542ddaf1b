"""What a run of an arm says of its error where longer steps tell little of it: made-up motions with known errors."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
import pytest
from extremes_of_arms.verdict import SAYS

from tmm_gen.inputs.signals import Constant
from tmm_gen.scene import parse_scene
from tmm_gen.simulate.accuracy import Accuracy
from tmm_gen.simulate.arm_accuracy import arm_accuracy
from tmm_gen.simulate.planar_divergence import free_watch
from tmm_gen.simulate.stepping import Course, Stepper
from tmm_gen.simulate.trace import Trace

Array = np.ndarray
Error = Callable[[float, Array], Array]
"""What steps of a length make wrong over time, s, (k,): rad, (k,)."""

SCENE = parse_scene("""
name = "turning"
[model]
kind = "planar"
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "motor"
inertia = 1.0
[[joint]]
stiffness = 100.0
[[link]]
mass = 1.0
length = 1.0
inertia = 0.1
[[output]]
name = "tip"
at = "tip"
of = "position"
""")
STEP, STEPS = 1e-3, 2000
UNTIL = STEP * STEPS
AMOUNT = 1e-2
"""rad; small beside the radians that the link turns by, and as many metres at its tip."""


@dataclass(eq=False)
class _MadeUp(Stepper):
    """Has the link turn by a radian a second, and errs as it is told."""

    error: Error = lambda _, time: 0.0 * time

    def take(self, course: Course) -> Iterator[Array]:
        time = course.step * np.arange(course.steps + 1)
        angle = (time + self.error(course.step, time))[:, None]
        if course.moved is not None:
            angle = angle + course.moved
        assert course.trace is not None
        course.trace.extend({"angle": angle, "rate": np.ones_like(angle)})
        yield np.zeros((course.steps + 1, 2))


def said(error: Error) -> Accuracy:
    """Return what is said of a run with such an error."""
    course = Course(
        SCENE,
        {"none": Constant(0.0)},
        STEPS,
        STEP,
        free_watch(SCENE, STEP),
        Trace.empty(SCENE, STEPS + 1),
    )
    stepper = _MadeUp("numpy", None, error=error)
    list(stepper.take(course))
    return arm_accuracy(course, stepper, 0.0)


def true(error: Error) -> float:
    """Return the error of the run, as a share of how far the tip goes."""
    time = STEP * np.arange(STEPS + 1)
    off = 2.0 * np.abs(np.sin(0.5 * error(STEP, time)))
    way = 2.0 * np.abs(np.sin(0.5 * time))
    return float(np.max(off) / np.max(way))


def by_order(order: float) -> Error:
    return lambda step, time: AMOUNT * (step / STEP) ** order * (time / UNTIL) ** 2


def left_by_a_ring(step: float, time: Array) -> Array:
    """A vibration that dies soon leaves a wrong speed for good, the same with all steps too long to follow it."""
    ringing = 0.02 * UNTIL  # begins after the first few steps
    return AMOUNT * (step >= STEP) * np.maximum(0.0, time - ringing) / UNTIL


def amid(shares: dict[float, float]) -> Error:
    """Return an error that comes in the middle of the run, by how many times as long steps are."""
    return lambda step, time: AMOUNT * shares.get(step / STEP, 0.0) * (time > 0.5 * UNTIL)


def test_errors_that_fall_by_their_order_are_said_as_they_are() -> None:
    assert said(by_order(2.0)).error == pytest.approx(true(by_order(2.0)), rel=0.02)


def test_a_drift_that_longer_steps_have_too_is_said() -> None:
    """Steps of twice and of four times the length change nothing."""
    assert true(left_by_a_ring) > 5e-3
    assert said(left_by_a_ring).error == pytest.approx(true(left_by_a_ring), rel=0.1)


@pytest.mark.parametrize("double", [0.5, -0.5, 1.5])
@pytest.mark.parametrize("four", [0.0, 1.0, 1.2])
def test_differences_that_do_not_fall_by_the_order_count_in_full(double: float, four: float) -> None:
    """As of modes that no step follows, whose phase is right or wrong by chance."""
    error = amid({1.0: 1.0, 2.0: double, 4.0: four})
    assert true(error) <= SAYS * said(error).error
    assert said(error).error <= SAYS * true(error)


def test_errors_that_fall_by_a_lower_order_are_between() -> None:
    found = said(by_order(1.0)).error
    assert true(by_order(1.0)) / SAYS < found < true(by_order(1.0))
    assert found > 1.5 * true(by_order(1.0)) / 3.0


def test_what_shorter_steps_change_alone_is_looked_at_where_longer_ones_fail() -> None:
    class Failing(_MadeUp):
        def take(self, course: Course) -> Iterator[Array]:
            if course.step > 3.0 * STEP:
                raise ArithmeticError("no pivot")
            return super().take(course)

    error = amid({1.0: 1.0, 2.0: 0.9})
    course = Course(SCENE, {}, STEPS, STEP, free_watch(SCENE, STEP), Trace.empty(SCENE, STEPS + 1))
    stepper = Failing("numpy", None, error=error)
    list(stepper.take(course))
    found = arm_accuracy(course, stepper, 0.0).error
    assert true(error) / 2.0 < found < 2.0 * true(error)
