"""Forces and moments act on frames of joints that carry no mass too, with either linearisation."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from support.spatial.kernels import package_of
from support.spatial.random_arms import random_arm

from tmm_gen.program.space.assemble import SpaceChoices
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.scene.spatial.arm import RigidBody


@pytest.mark.parametrize("exact", [False, True])
@pytest.mark.parametrize("seed", [0, 10])
def test_start(seed: int, exact: bool) -> None:
    arm = random_arm(seed, 3, tree=True, loads=True)
    # the first joint, and nothing but it, is light
    light = replace(arm.joints[0], body=RigidBody(0.0))
    arm = replace(arm, joints=(light, *arm.joints[1:]))
    columns = [c for i in arm.inputs for c in i.columns]
    acting = [c for i in arm.inputs if i.frame is not None and i.frame.joint == 1 for c in i.columns]
    assert len(acting) >= 12
    values = np.random.default_rng(seed).normal(size=len(acting)).tolist()
    inputs = {**dict.fromkeys(columns, 0.0), **dict(zip(acting, values, strict=True))}
    module = package_of(arm, choices=SpaceChoices(1e-3, exact=True) if exact else None)
    state = module.initialise(module.Params(), module.Input(**inputs))
    q, v = (np.array([getattr(joint, word) for joint in arm.joints]) for word in ("angle", "rate"))
    right = WorldArm(arm).forward_dynamics(q, v, inputs)
    loaded = right - WorldArm(arm).forward_dynamics(q, v, dict.fromkeys(columns, 0.0))
    assert np.abs(loaded).max() > 0.1
    assert np.abs(state.acceleration - right).max() < 1e-11 * np.abs(right).max()
