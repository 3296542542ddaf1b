"""Drivetrains that branch: one motor, several loads, each on its own shaft."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.linalg import eigh

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.digits.rounding import Rounding, first_period
from tmm_gen.inputs.signals import Constant, Sine
from tmm_gen.reference.assembly import assemble
from tmm_gen.reference.chain_motion import exact_angles
from tmm_gen.reference.duration import slowest_swing
from tmm_gen.reference.frequency import fastest_mode
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import Scene, SceneError

Chain = Callable[..., Scene]

TWO_LOADS: list[tuple[str, dict[str, Any]]] = [
    ("motor", {"name": "motor", "rotor_inertia": 0.02, "damping": 0.03}),
    ("joint", {"name": "coupling", "stiffness": 30.0, "damping": 0.1}),
    ("link", {"name": "pinion", "inertia": 0.01}),
    ("gear", {"name": "left", "ratio": -4.0}),
    ("link", {"name": "wheel", "inertia": 0.2}),
    ("joint", {"name": "left_shaft", "stiffness": 90.0, "damping": 0.2}),
    ("link", {"name": "left_load", "inertia": 1.5}),
    ("gear", {"name": "right", "on": "pinion", "ratio": 3.0, "stiffness": 700.0, "damping": 0.6}),
    ("link", {"name": "right_load", "inertia": 0.8}),
]


def test_what_hangs_on_what(chain: Chain) -> None:
    scene = chain(TWO_LOADS)
    # the pinion with the wheel, four times slower, carries both loads
    assert scene.hosts == (0, 1, 1)
    assert scene.links[0].inertia == pytest.approx(0.01 + 0.2 / 16.0)
    assert [joint.ratio for joint in scene.joints] == [1.0, -4.0, 3.0]
    assert scene.turns == (1.0, -4.0, 3.0)


@pytest.mark.parametrize("seed", range(12))
def test_numbers_that_steps_are_judged_by(
    seed: int, chain: Chain, drawn: Callable[..., Any], equations: Callable[..., Any]
) -> None:
    parts, base = drawn(seed, 5, 0.7)
    scene, right = chain(parts, base=base), equations(parts, base)
    frequencies = np.sqrt(np.maximum(eigh(right.stiffness, right.mass, eigvals_only=True), 0.0))[scene.hub :]
    assert slowest_swing(scene) == pytest.approx(frequencies[0], rel=1e-9)
    assert fastest_mode(scene).frequency == pytest.approx(frequencies[-1], rel=1e-9)
    period = 0.0 if scene.hub else 2.0 * np.pi / frequencies[0]
    assert first_period(scene) == pytest.approx(period, rel=0.05)
    found, assembly = Rounding(integrator("newmark")), assemble(scene)
    step = scene.integrator.step
    impedance = 0.25 * step**2 * assembly.stiffness + 0.5 * step * assembly.damping
    largest = float(np.max(np.diag(impedance) / np.diag(assembly.mass)))
    assert found.step_stiffness(scene) == pytest.approx(largest, rel=1e-9)


@pytest.mark.parametrize("kind", ["motor", "prescribed"])
def test_runs_are_judged_by_the_motion_of_every_branch(kind: str, chain: Chain) -> None:
    parts = TWO_LOADS if kind == "motor" else [("gear", {"name": "first", "ratio": 2.0}), *TWO_LOADS[1:]]
    parts = parts if kind == "motor" else [*parts[:1], ("joint", {**parts[1][1], "on": "first"}), *parts[2:]]
    names = [keys["name"] for table, keys in parts if table in ("motor", "link")]
    signals = [("[output]", {"name": f"angle_{n}", "at": n, "of": "angle"}) for n in names]
    acts = ("motor", "torque") if kind == "motor" else ("base", "angle")
    signals += [("[input]", {"name": "drive", "at": acts[0], "acts": acts[1]})]
    signals += [("[input]", {"name": "load", "at": "left_load", "acts": "torque"})]
    base = {"kind": "clamp" if kind == "motor" else kind}
    scene = chain(parts, base=base, signals=signals)
    moving = {"drive": Sine(0.7, 11.0), "load": Constant(-2.0)}
    exact = exact_angles(scene, moving, 1e-3, np.array([0, 100, 200]))
    right = exact_response(scene, moving, np.array([0.0, 0.1, 0.2]))
    columns = [*(["motor"] if kind == "motor" else []), "pinion", "left_load", "right_load"]
    for column, name in enumerate(columns):
        assert exact[:, column] == pytest.approx(right[f"angle_{name}"], rel=1e-9, abs=1e-12), name
    assert np.ptp(exact[-1]) > 0.01


def test_both_loads_settle_on_a_turned_base(chain: Chain) -> None:
    """Two springs on a base that is turned by 1: each link comes to rest where its own gear puts it."""
    parts = [
        ("joint", {"name": "a", "on": "base", "stiffness": 90.0, "damping": 9.0}),
        ("link", {"name": "one", "inertia": 0.2}),
        ("gear", {"name": "b", "on": "base", "ratio": -5.0, "stiffness": 40.0, "damping": 4.0}),
        ("link", {"name": "two", "inertia": 0.1}),
    ]
    signals = [("[output]", {"name": n, "at": n, "of": "angle"}) for n in ("one", "two")]
    signals += [("[input]", {"name": "turn", "at": "base", "acts": "angle"})]
    scene = chain(parts, base={"kind": "prescribed"}, signals=signals)
    found = exact_response(scene, {"turn": Constant(1.0)}, np.array([9.0]))
    assert found["one"][0] == pytest.approx(1.0, rel=1e-6)
    assert found["two"][0] == pytest.approx(-0.2, rel=1e-6)


@pytest.mark.parametrize(
    ("part", "key", "said", "instead"),
    [
        (
            ("gear", {"name": "x", "on": "coupling", "ratio": 2.0}),
            "gear[3].on",
            "puts a second part on [[joint]] 'coupling', which carries 'pinion' and has no inertia",
            "pinion",
        ),
        (
            ("joint", {"name": "x", "on": "base", "stiffness": 2.0}),
            "joint[3].on",
            "puts 'x' on the base, where 'motor' is",
            "motor",
        ),
    ],
    ids=["massless fork", "beside the motor"],
)
def test_forks_that_cannot_be_are_told(
    part: tuple[str, dict[str, Any]], key: str, said: str, instead: str, chain: Chain
) -> None:
    disc = ("link", {"name": "disc", "inertia": 0.1})
    with pytest.raises(SceneError) as raised:
        chain([*TWO_LOADS, part, disc])
    (problem,) = raised.value.problems
    assert problem.key == key
    assert said in problem.message
    assert chain([*TWO_LOADS, (part[0], {**part[1], "on": instead}), disc]).stations >= 3  # the remedy
