"""What a base that floats costs, and that it is proved like any other."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.scene import parse_scene

MORE = {"newmark": 51, "radau3": 323, "gauss2": 222}
"""Operations a step, of a hub with two arms."""

BOX = """
[emit]
trigonometry = "own"
[emit.box]
angles = [-4.0, 4.0]
rates = [-20.0, 20.0]
accelerations = [-1000.0, 1000.0]
base_places = [-100.0, 100.0]
base_velocities = [-10.0, 10.0]
base_accelerations = [-100.0, 100.0]
wheel = [-5.0, 5.0]
thruster = [-10.0, 10.0]
push = [-1.0, 1.0]
"""


def turning(text: str) -> str:
    """Return the arm on a hub that turns about a fixed point, with what is asked of it alone."""
    hub = text[text.index("[[body]]") : text.index("[[joint]]")]
    text = text.replace(hub, "").replace('kind = "free"', 'kind = "motor"\ninertia = 0.02')
    return text.replace('on = "hub"', 'on = "base"').replace('at = "hub"', 'at = "base"')


@pytest.mark.parametrize("integrator", MORE)
def test_a_step_costs_so_much_more(integrator: str, drifter_text: str) -> None:
    """Three equations in place of one, two coordinates to integrate, and forces that go on to the base."""
    begin = drifter_text[: drifter_text.index("[[output]]")]
    begin = begin.replace('[[input]]\nname = "thruster"\nat = "base"\nacts = "force_x"\n', "")
    end = '[[output]]\nname = "end"\nat = "shin"\nof = "position"\n'
    floats, turns = (parse_scene(text + end) for text in (begin, turning(begin)))
    costs = [
        count_routine(build_program(scene.replace(**{"integrator.name": integrator})).main).total
        for scene in (floats, turns)
    ]
    assert costs[0] - costs[1] == MORE[integrator]


def test_it_is_proved(
    drifter_text: str,
    tmp_path: Path,
    tmm_gen: Callable[..., subprocess.CompletedProcess[str]],
    need_tool: Callable[..., str],
) -> None:
    need_tool("frama-c")
    path = tmp_path / "drifter.toml"
    path.write_text(drifter_text + BOX)
    ended = tmm_gen("check", path, "--prove")
    assert ended.returncode == 0, ended.stderr
    assert "proved: no function leaves an array" in ended.stdout
