"""What the emitted step is compared with, written by hand, takes the same step."""

from __future__ import annotations

import numpy as np
import pytest

pytestmark = pytest.mark.compiler


def test_the_step_by_hand_is_the_emitted_one() -> None:
    from hand_written import FLAGS, HandWritten, arm, started

    from tmm_gen.native import compile_kernel
    from tmm_gen.program.build import build_program

    scene = arm("gravity", 3, "newmark", "1")
    kernel = compile_kernel(build_program(scene), scene, flags=FLAGS)
    kernel.prepare()
    kernel.initialise()
    motion = started(scene)
    for _ in range(50):
        kernel.step()
    HandWritten(scene).advance(motion, 50)
    for mine, name in ((motion.angles, "angle"), (motion.accelerations, "acceleration")):
        wanted = np.asarray(kernel.state[name])
        np.testing.assert_allclose(mine, wanted, rtol=0, atol=1e-9 * np.max(np.abs(wanted)))
