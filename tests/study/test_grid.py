"""The grid has every combination once, and nothing that cannot be."""

from __future__ import annotations

from tmm_gen.scene import INTEGRATOR_NAMES, Scene
from tmm_gen.study.configuration import own
from tmm_gen.study.grid import Axes, configurations, default_steps, families


def test_default_grid_is_all_integrators_at_ten_steps_and_the_scene_itself(chain: Scene) -> None:
    grid = configurations(chain, Axes(), until=5.0)
    assert len(grid) == len(INTEGRATOR_NAMES) * 10 + 1
    assert grid[-1] == own(chain)
    assert grid[-1].apply(chain) == chain
    assert {each.step for each in grid[:-1]} == set(default_steps(5.0))


def test_a_scene_that_is_in_the_grid_is_there_once(chain: Scene) -> None:
    grid = configurations(chain, Axes(integrators=("newmark",), steps=(0.02, 0.01)), until=5.0)
    assert len(grid) == 2


def test_sweeps_belong_to_newton_and_float32_to_c(arm: Scene) -> None:
    axes = Axes(
        integrators=("newmark",),
        linearisations=("newton", "taylor"),
        iterations=(1, 2),
        reals=("float64", "float32"),
        backends=("c", "numpy"),
    )
    found = families(arm, axes)
    # C: two number types, NumPy: one; for each Newton with one and two sweeps, and Taylor
    assert len(found) == 3 * 3
    assert {each.iterations for each in found if each.linearisation == "taylor"} == {1}
    assert {each.real for each in found if each.backend == "numpy"} == {"float64"}


def test_corrections_belong_to_newton(arm: Scene) -> None:
    axes = Axes(
        integrators=("newmark",), linearisations=("newton", "taylor"), corrections=(0, 1), steps=(0.01,)
    )
    grid = configurations(arm, axes, 1.0)
    tried = [(each.family.linearisation, each.family.corrections) for each in grid]
    assert tried[:3] == [("newton", 0), ("newton", 1), ("taylor", 0)]
    assert grid[1].family.label == "newmark, 3 links, 1 correction"
    assert grid[1].apply(arm).model.corrections == 1


def test_a_configuration_is_the_scene_with_its_keys_changed(arm: Scene) -> None:
    axes = Axes(integrators=("sdirk4",), steps=(0.01,), links=(5,), iterations=(2,), reals=("float32",))
    changed = configurations(arm, axes, 1.0)[0].apply(arm)
    assert (changed.integrator.name, changed.integrator.step) == ("sdirk4", 0.01)
    assert (changed.stations, changed.model.iterations, changed.emit.real) == (5, 2, "float32")


def test_parameters_stay_with_the_scenes_own_integrator(chain: Scene) -> None:
    scene = chain.replace(**{"integrator.beta": 0.3})
    grid = configurations(scene, Axes(integrators=("newmark", "wilson"), steps=(0.1,)), 1.0)
    assert grid[0].apply(scene).integrator.parameters == {"beta": 0.3}
    assert grid[1].apply(scene).integrator.parameters == {}


def test_steps_of_a_configuration_are_all_alike(chain: Scene) -> None:
    scene = chain.replace(**{"integrator.tolerance": 1e-6})
    for configuration in configurations(scene, Axes(integrators=("newmark", "houbolt"), steps=(0.1,)), 1.0):
        assert configuration.apply(scene).integrator.tolerance is None
