"""Robots drawn at random, imported, built and run: they move as MuJoCo reads and moves them."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest
from support.urdf_runs import UNTIL, UrdfRun, urdf_run

STEP = 1e-4
"""s, of MuJoCo's Runge-Kutta method."""
OPTIONS = (
    '<mujoco><compiler fusestatic="true" discardvisual="true" balanceinertia="false" boundmass="1e-9" '
    'boundinertia="1e-12"/></mujoco></robot>'
)
"""Without any mass MuJoCo refuses a link between two joints."""


def moved(run: UrdfRun) -> np.ndarray:
    """Return the angles at `UNTIL` by MuJoCo."""
    model = mujoco.MjModel.from_xml_string(run.text.replace("</robot>", OPTIONS))
    model.opt.timestep, model.opt.integrator = STEP, mujoco.mjtIntegrator.mjINT_RK4
    # dampers here are linear, and there are no stops
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    data = mujoco.MjData(model)
    order = [run.names.index(model.joint(k).name) for k in range(model.njnt)]
    data.qfrc_applied = run.torques[order]
    mujoco.mj_step(model, data, round(UNTIL / STEP))
    angles = np.empty(len(order))
    angles[order] = data.qpos
    return angles


# each joint of a robot has a pattern of its own to derive: most are small
@pytest.mark.parametrize(("seed", "joints"), [(seed, 3) for seed in range(17)] + [(17, 4), (18, 5), (19, 7)])
def test_a_robot_moves_as_mujoco_says(seed: int, joints: int, tmp_path: Path) -> None:
    run = urdf_run(seed, tmp_path, joints)
    way, coarse, fine = run.judged(moved(run))
    assert way > 0.01
    assert coarse < 1e-3
    assert np.log2(coarse / fine) == pytest.approx(2.0, abs=0.1)
