"""What is said to be saved is the difference of two programs, counted."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from tmm_gen.explain.cost import footprint
from tmm_gen.explain.explain import explain
from tmm_gen.explain.explanation import Explained, Explanation
from tmm_gen.explain.terms import terms_of
from tmm_gen.scene import Scene

pytestmark = pytest.mark.xdist_group("explanations")  # scenes are explained once


@pytest.fixture(scope="module")
def explained(example: Callable[[str], Scene]) -> dict[str, Explanation]:
    return {
        "thesis10": explain(example("thesis10")),
        "zhou": explain(example("thesis10").replace(**{"integrator.name": "zhou"})),
        "houbolt": explain(example("thesis10").replace(**{"integrator.name": "houbolt"})),
        "arm2": explain(example("arm2")),
    }


def term(explanation: Explanation, name: str) -> Explained:
    (found,) = [each for each in explanation.terms if each.term == name]
    return found


def test_joint_damping_costs_what_the_scene_without_it_lacks(
    explained: dict[str, Explanation], example: Callable[[str], Scene]
) -> None:
    found = term(explained["thesis10"], "joint damping")
    assert found.modelled
    without = footprint(example("thesis10").replace(**{"joint.1.damping": 0.0}))
    assert found.worth.step == explained["thesis10"].own.step - without.step == 30
    undamped = explain(example("thesis10").replace(**{"joint.1.damping": 0.0}))
    absent = term(undamped, "joint damping")
    assert not absent.modelled
    assert "no joint has damping" in absent.why
    assert absent.worth.step == 30


def test_identical_joints_share_one_number(
    explained: dict[str, Explanation], example: Callable[[str], Scene]
) -> None:
    found = term(explained["thesis10"], "joints of their own")
    assert not found.modelled
    assert found.worth.model_bytes == 2 * 9 * 8  # ten stiffnesses and dampings instead of one
    assert term(explain(example("drivetrain")), "joints of their own").modelled


def test_history_that_no_step_reads_is_not_kept(explained: dict[str, Explanation]) -> None:
    name = "history that no step reads"
    assert term(explained["thesis10"], name).worth.state_bytes == 0  # newmark reads all it has
    # zhou: of the last but one instant the acceleration alone
    assert term(explained["zhou"], name).worth.state_bytes == 2 * 10 * 8
    assert term(explained["houbolt"], name).worth.state_bytes > 0


@pytest.mark.parametrize("integrator", ["radau2", "gauss3"])
def test_a_polynomial_of_accelerations_is_read_whole(
    integrator: str, example: Callable[[str], Scene]
) -> None:
    scene = example("arm2").replace(**{"integrator.name": integrator})
    assert term(explain(scene), "history that no step reads").worth.state_bytes == 0


def test_a_step_that_prepared_itself_would_repeat_prepare(explained: dict[str, Explanation]) -> None:
    found = explained["thesis10"]
    hoisted = term(found, "parameters that change between steps")
    assert hoisted.worth.step == found.own.prepare == 69
    assert hoisted.worth.model_bytes < 0  # what prepare computes has to be kept


def test_outputs_cost_nothing_in_a_step(explained: dict[str, Explanation]) -> None:
    (found,) = [each for each in explained["thesis10"].terms if each.term.endswith("as outputs")]
    assert found.worth.step == 0
    assert found.worth.output > 0


def test_arms_side_by_side_cost_their_memory_alone(
    explained: dict[str, Explanation], example: Callable[[str], Scene]
) -> None:
    plain = explained["arm2"]
    found = explain(example("arm2").replace(**{"emit.batch": 8, "emit.trigonometry": "own"}))
    worth = term(found, "arms side by side").worth
    assert (worth.step, worth.state_bytes, worth.model_bytes) == (
        0,
        7 * plain.own.state_bytes,
        7 * plain.own.model_bytes,
    )
    assert found.own == plain.own
    assert not [each for each in plain.terms if each.term == "arms side by side"]


def test_planar_terms(explained: dict[str, Explanation], example: Callable[[str], Scene]) -> None:
    found = explained["arm2"]
    scene = found.scene
    assert term(found, "gravity").modelled == bool(scene.model.gravity)
    assert term(found, "a second sweep in each stage").worth.step > 0.8 * found.own.step
    assert term(found, "a hub that turns").modelled == (scene.base.kind != "clamp")
    assert term(found, "counting energy turned to heat").worth.state_bytes == 8


def test_everything_at_once_is_more_than_the_scene(explained: dict[str, Explanation]) -> None:
    for explanation in explained.values():
        assert explanation.everything.step > explanation.own.step
        assert explanation.everything.state_bytes >= explanation.own.state_bytes


@pytest.mark.parametrize("name", ["thesis2", "drivetrain", "arm2", "hundred"])
def test_terms_can_be_put_in_and_taken_out_of_every_scene(name: str, example: Callable[[str], Scene]) -> None:
    """Out and in again is where it was."""
    scene = example(name)
    for each in terms_of(scene):
        changed = each.other(scene)
        assert changed != scene, each.name
        again = {other.name: other for other in terms_of(changed)}
        if each.name in again and not each.name.startswith(("torques", "position", "angle")):
            expected = not each.modelled
            if each.name == "counting energy turned to heat" and "nothing turns" in again[each.name].why:
                expected = False
            assert again[each.name].modelled == expected, each.name


def test_it_is_counted_once(
    example: Callable[[str], Scene], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """What was counted is remembered, by what the scene says and how; what is damaged is not believed."""
    monkeypatch.setenv("TMM_GEN_CACHE", str(tmp_path))
    scene = example("thesis2")
    first = explain(scene)
    (entry,) = (tmp_path / "explain").iterdir()

    def refused(scene: Scene, advance: object) -> None:
        raise AssertionError("counted again")

    with monkeypatch.context() as patched:
        patched.setattr("tmm_gen.explain.counting.counted", refused)
        assert explain(example("thesis2")) == first
        with pytest.raises(AssertionError):
            explain(scene.replace(**{"integrator.step": 0.02}))
    entry.write_text(entry.read_text().replace('"step": ', '"step": 1'))
    assert explain(scene) == first
