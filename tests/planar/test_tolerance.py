"""What sweeps may leave unsolved follows the step's own error, unless the scene says a number."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from tmm_gen.scene import Scene
from tmm_gen.simulate.tolerance import LARGEST, SMALLEST, UnsolvedError, refuse_unsolved, to_accept, tolerance


@pytest.fixture(scope="module")
def scene(falling: Callable[..., Scene]) -> Scene:
    return falling(2, **{"model.iterations": 1})


@pytest.mark.parametrize(
    ("step_error", "most"), [(0.0, SMALLEST), (1e-9, SMALLEST), (3e-6, 3e-6), (0.02, LARGEST), (1.0, LARGEST)]
)
def test_it_follows_the_step_within_limits(scene: Scene, step_error: float, most: float) -> None:
    assert tolerance(scene, step_error) == most


@pytest.mark.parametrize("given", [1e-12, 0.5])
def test_a_number_in_the_scene_goes_before_the_step(scene: Scene, given: float) -> None:
    assert tolerance(scene.replace(**{"model.unsolved": given}), 1e-5) == given


@pytest.mark.parametrize("share", [1.01e-4, 2.0e-4, 0.37, 9.99e-3, 1e-4])
def test_the_number_that_is_offered_accepts(scene: Scene, share: float) -> None:
    offered = to_accept(scene, share, 1e-6)
    assert offered is not None
    assert share < offered <= 2.1 * share
    assert to_accept(scene.replace(**{"model.unsolved": offered}), share, 1e-6) is None


def test_nothing_is_offered_where_nothing_is_refused(scene: Scene) -> None:
    assert to_accept(scene, 1e-6, 1e-6) is None
    assert to_accept(scene, None, None) is None
    refuse_unsolved(scene, 1e-6, 1e-6)


@pytest.mark.parametrize(
    ("share", "step_error", "changes", "said"),
    [
        (
            2e-5,
            3e-6,
            {},
            "is 2.0e-05 of the energy that moves, more than the step's own error explains, 3.0e-06:",
        ),
        (2e-5, 3e-12, {}, "and the step's own error explains but 3.0e-12 (1e-07 would pass):"),
        (2e-3, 0.02, {}, "more than the 0.0001 that any step may leave (the error of this one is 2.0e-02):"),
        (2e-5, 1.0, {"model.unsolved": 1e-6}, "more than model.unsolved = 1e-06:"),
        (2e-5, 0.0, {"model.iterations": 3}, "3 sweeps per stage left"),
        (2e-5, 0.0, {"model.iterations": 3}, "Sweep as often as it takes, --iterations auto;"),
        (2e-5, 0.0, {"model.iterations": "auto"}, "even many sweeps left"),
        (2e-5, 0.0, {"model.iterations": "auto"}, "Take shorter steps, --step 0.0001;"),
        (2e-5, 0.0, {}, "--step 0.0001;"),
    ],
)
def test_the_refusal_says_what_was_exceeded(
    scene: Scene, share: float, step_error: float, changes: dict[str, object], said: str
) -> None:
    with pytest.raises(UnsolvedError) as refusal:
        refuse_unsolved(scene.replace(**changes), share, step_error)
    assert said in str(refusal.value)
