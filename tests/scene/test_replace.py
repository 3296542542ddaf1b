"""Changing keys of a scene."""

from __future__ import annotations

import pytest

from tmm_gen.scene import INTEGRATOR_NAMES, SceneError, parse_scene


class NumpyLike:
    """What `replace` sees of a NumPy scalar or array."""

    def __init__(self, value: object) -> None:
        self.value = value

    def tolist(self) -> object:
        return self.value


def test_one_key(chain: str) -> None:
    scene = parse_scene(chain)
    changed = scene.replace(**{"integrator.step": 0.5})
    assert changed.integrator.step == 0.5
    assert changed == parse_scene(chain.replace("0.01", "0.5"))
    assert scene == parse_scene(chain)


def test_no_change(chain: str) -> None:
    assert parse_scene(chain).replace() == parse_scene(chain)


def test_parameters_of_the_former_integrator_are_dropped(chain: str) -> None:
    scene = parse_scene(chain)
    assert scene.replace(**{"integrator.name": "zhou"}).integrator.parameters == {}
    changed = scene.replace(**{"integrator.theta": 1.5, "integrator.name": "wilson", "integrator.step": 0.1})
    assert (changed.integrator.step, changed.integrator.parameters) == (0.1, {"theta": 1.5})


@pytest.mark.parametrize("name", INTEGRATOR_NAMES)
def test_every_integrator(chain: str, name: str) -> None:
    changed = parse_scene(chain).replace(**{"integrator.name": name.replace("_", "-")})
    assert changed.integrator.name == name


def test_parameters_stay_where_the_integrator_stays(chain: str) -> None:
    changed = parse_scene(chain).replace(**{"integrator.name": "newmark", "integrator.gamma": 0.6})
    assert changed.integrator.parameters == {"beta": 0.25, "gamma": 0.6}


def test_tables_that_were_absent_are_made(chain: str) -> None:
    changed = parse_scene(chain).replace(
        **{"initial.angles": (0.1, 0.2), "emit.real": "float32", "emit.budget.flash": 900}
    )
    assert changed.initial.angles == (0.1, 0.2)
    assert changed.emit.budget is not None
    assert changed.emit.budget.flash == 900


def test_stations_are_counted_from_one(chain: str) -> None:
    changed = parse_scene(chain).replace(**{"link.2.inertia": 7.0, "joint.1.damping": 0.0})
    assert [link.inertia for link in changed.links] == [1.0, 7.0]
    assert changed.joints[0].damping == 0.0


def test_tables_are_found_by_name_and_as_errors_have_them(chain: str) -> None:
    name = parse_scene(chain).outputs[-1].name
    last = len(parse_scene(chain).outputs)
    right = parse_scene(chain).replace(**{f"output.{last}.of": "velocity"})
    assert right.outputs[-1].of == "velocity"
    assert parse_scene(chain).replace(**{f"output.{name}.of": "velocity"}) == right
    assert parse_scene(chain).replace(**{f"output[{last}].of": "velocity"}) == right
    with pytest.raises(SceneError, match=r"output\.nothing\.of: is not in this scene"):
        parse_scene(chain).replace(**{"output.nothing.of": "velocity"})


def test_none_removes_a_key(chain: str, planar: str) -> None:
    assert parse_scene(chain).replace(**{"integrator.beta": None}).integrator.parameters == {}
    assert parse_scene(planar).replace(tip=None).tip is None
    assert parse_scene(planar).replace(control=None) == parse_scene(planar)


def test_beam_is_expanded_anew(planar: str) -> None:
    changed = parse_scene(planar).replace(**{"beam.links": 20})
    assert changed.stations == 20
    assert [link.length for link in changed.links] == pytest.approx([1.0 / 19.5] * 19 + [0.5 / 19.5])


def test_numpy_values(chain: str) -> None:
    changed = parse_scene(chain).replace(
        **{"integrator.step": NumpyLike(0.5), "initial.rates": NumpyLike([1.0, 2.0])}
    )
    assert (changed.integrator.step, changed.initial.rates) == (0.5, (1.0, 2.0))


@pytest.mark.parametrize(
    ("key", "value", "line", "shown", "remedy"),
    [
        ("integrator.step", -1.0, 10, "integrator.step", "greater than 0"),
        ("model.unknown", "displacment", 4, "model.unknown", "'displacement'?"),
        ("base.inertia", 1.0, 13, "base.inertia", '"motor"'),
        ("link.3.inertia", 1.0, 20, "link[3].inertia", "counted from 1"),
        ("link.0.inertia", 1.0, 20, "link[0].inertia", "counted from 1"),
        ("name.first", 1.0, 1, "name.first", "counted from 1"),
        ("link.1", None, 20, "link[1]", "counted from 1"),
        ("gravity", 1.0, 1, "gravity", "[model]"),
    ],
)
def test_bad_changes_are_located(
    chain: str, key: str, value: object, line: int, shown: str, remedy: str
) -> None:
    with pytest.raises(SceneError) as caught:
        parse_scene(chain, "arm.toml").replace(**{key: value})
    (problem,) = caught.value.problems
    assert problem.file.startswith(f"arm.toml (with {key} = ")
    assert (problem.line, problem.key) == (line, shown)
    assert remedy in str(problem)
