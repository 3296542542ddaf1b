"""What commands make of floating arms, and what is refused in words."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.explain.terms import terms_of
from tmm_gen.export.mjcf.model import mujoco_model
from tmm_gen.inputs.signals import Constant
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.report.animate import _places
from tmm_gen.scene import Scene
from tmm_gen.simulate.run import simulate

Run = Callable[..., subprocess.CompletedProcess[str]]

REFUSED = [
    ('kind = "free"', 'kind = "free"\ninertia = 0.1', "such a base is made of the bodies on it"),
    ("inertia = 0.02", "inertia = 0.0", "body[1].inertia: is 0 or missing"),
    ('acts = "force_x"', 'acts = "angle"', 'cannot be "angle" with base.kind = "free"'),
    ('at = "base"\nof = "velocity"', 'at = "base"\nof = "torque"', "cannot be torque at the base"),
    ('kind = "free"', 'kind = "clamp"', "a body sits on a beam's or a link's outer end"),
    ('kind = "free"', 'kind = "clamp"', 'or write `kind = "free"` alone in [base]'),
    ('acts = "force_x"', 'acts = "angle"', 'Write `acts = "torque"`, or remove the input.'),
    (
        'name = "hub"\non = "base"',
        'name = "hub"\non = "shin"',
        'on = "base"`, `mass = 1.0`, `inertia = 0.01`',
    ),
]


@pytest.mark.parametrize(("old", "new", "told"), REFUSED)
def test_refusals(old: str, new: str, told: str, drifter_text: str, tmp_path: Path, tmm_gen: Run) -> None:
    assert old in drifter_text
    path = tmp_path / "drifter.toml"
    path.write_text(drifter_text.replace(old, new, 1))
    ended = tmm_gen("run", path)
    assert ended.returncode == 2
    assert told in " ".join(ended.stderr.split())
    assert "drifter.toml:" in ended.stderr


def test_explain_names_the_base(drifter: Callable[..., Scene]) -> None:
    scene = drifter()
    (term,) = [each for each in terms_of(scene) if each.name == "a base that floats"]
    assert term.modelled
    assert not term.other(scene).floats
    assert all(each.name != "friction of the hub" for each in terms_of(scene))


@pytest.mark.compiler
def test_pictures_show_where_the_base_is(drifter: Callable[..., Scene]) -> None:
    """Drawn from the centre of mass, though no state needs to keep the place."""
    signals = {"wheel": Constant(0.3), "thruster": Constant(0.5), "push": Constant(-0.4)}
    scene = drifter("sdirk4")
    run = simulate(scene, signals, until=0.3, trace=True)
    x, y = _places(run)
    np.testing.assert_allclose(x[:, 0], run.outputs["hub_x"], atol=1e-7)
    np.testing.assert_allclose(y[:, -1], run.outputs["end_y"], atol=1e-7)


def test_mujoco_moves_alike(drifter: Callable[..., Scene]) -> None:
    mujoco = pytest.importorskip("mujoco")
    scene = drifter()
    model = mujoco.MjModel.from_xml_string(mujoco_model(scene).text)
    model.opt.timestep = 1e-4
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    values = {"wheel": 0.3, "thruster": 0.5, "push": -0.4}
    for name, value in values.items():
        data.actuator(name).ctrl[:] = value
    for _ in range(4000):
        mujoco.mj_step(model, data)
    mujoco.mj_forward(model, data)
    right = planar_response(scene, {k: Constant(v) for k, v in values.items()}, np.array([0.4]))
    found = {
        "hub_x": data.sensor("hub").data[0],
        "hub_y": data.sensor("hub").data[1],
        "end_x": data.sensor("end").data[0],
        "attitude": data.sensor("attitude").data[0],
        "drift_y": data.sensor("drift").data[1],
    }
    for name, value in found.items():
        assert value == pytest.approx(float(right[name][0]), rel=1e-8, abs=1e-8), name
