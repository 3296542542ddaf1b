"""Maps of growth, measured by running kernels, agree with the derived ones; and where they do not, it is said."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.scene import Scene
from tmm_gen.stability.map import GrowthMap, growth_map
from tmm_gen.stability.motion import small_motion
from tmm_gen.stability.picture import map_picture

PLANAR = {"beam.links": 3}


def mapped(scene: Scene, name: str, columns: int = 9) -> GrowthMap:
    return growth_map(small_motion(scene), integrator(name), columns)


@pytest.mark.parametrize("name", ["newmark", "zhou", "zhai", "houbolt", "wilson"])
def test_a_chain_grows_as_derived(name: str, example: Callable[[str], Scene]) -> None:
    found = mapped(example("thesis10"), name)
    assert not found.differs.any()
    assert np.max(np.abs(found.difference)) < 1e-11
    assert found.grows.any() == (name in ("zhou", "zhai"))


def test_so_does_one_with_coupled_damping_and_a_free_hub(example: Callable[[str], Scene]) -> None:
    assert not mapped(example("drivetrain"), "generalized_alpha").differs.any()


@pytest.mark.parametrize(("scene", "name"), [("fall10", "newmark"), ("arm10", "zhou")])
def test_a_planar_arm_about_its_rest_grows_as_derived(
    scene: str, name: str, example: Callable[[str], Scene]
) -> None:
    found = mapped(example(scene).replace(**PLANAR), name, 6)
    assert not found.differs.any()


@pytest.fixture(scope="module")
def thesis_steps(example: Callable[[str], Scene]) -> dict[str, GrowthMap]:
    scene = example("fall10").replace(**PLANAR)
    return {
        name: mapped(scene.replace(**{"model.linearisation": name}), "newmark", 6)
        for name in ("frozen", "taylor")
    }


def test_the_frozen_step_grows_everywhere_though_its_integrator_does_not(
    thesis_steps: dict[str, GrowthMap],
) -> None:
    found = thesis_steps["frozen"]
    assert found.differs.all()
    assert not found.grows.any()
    assert np.min(found.measured) > 1.1
    step, factor, measured, derived = found.worst
    assert step in found.steps
    assert factor in found.factors
    assert measured > 10.0 > 1.0 >= derived
    assert map_picture([found]).startswith(b"\x89PNG")


def test_the_taylor_step_has_places_that_never_come_to_rest(thesis_steps: dict[str, GrowthMap]) -> None:
    found = thesis_steps["taylor"]
    assert found.differs.any()
    np.testing.assert_allclose(found.measured[found.differs], 1.0, atol=1e-3)
    assert np.all(found.derived[found.differs] < 1.0)


def test_unknown_and_sweep_do_not_matter(example: Callable[[str], Scene]) -> None:
    few = {"joint.1.repeat": 3, "link.1.repeat": 3}
    maps = [
        mapped(example("thesis10").replace(**few, **changes), "newmark", 6)
        for changes in (
            {},
            {"model.unknown": "increment"},
            {"model.sweep": "product", "integrator.step": 0.1},
        )
    ]
    assert not any(each.differs.any() for each in maps)
