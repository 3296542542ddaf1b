"""What a branch costs, and where parts may hang on the same one."""

from __future__ import annotations

import pytest

from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.scene import Scene, SceneError, parse_scene

HEAD = """\
name = "tree"
[model]
kind = "planar"
gravity = 9.81
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "clamp"
[[output]]
name = "end"
at = "link3"
of = "position"
"""


def links(*hosts: str) -> str:
    """Return rigid links on springs, each on another or the base."""
    return HEAD + "".join(
        f'[[joint]]\nname = "joint{k}"\non = "{on}"\nstiffness = {10.0 + k}\n'
        f'[[link]]\nname = "link{k}"\non = "joint{k}"\nlength = 0.3\nmass = {0.2 + 0.1 * k}\ninertia = 1e-3\n'
        for k, on in enumerate(hosts)
    )


def operations(*hosts: str) -> int:
    return count_routine(build_program(parse_scene(links(*hosts))).main).total


def test_a_branch_costs_sums_alone() -> None:
    row = operations("base", "link0", "link1", "link2")
    # nine impedances and three forces, less what need not be carried over the end of a branch
    assert operations("base", "link0", "link0", "link2") - row <= 20
    assert operations("base", "link0", "link1", "link1") - row <= 20
    # on a clamp nothing has to be added up
    assert operations("base", "base", "link1", "link2") - row <= 0


def test_each_joint_knows_what_it_stands_on() -> None:
    scene = parse_scene(links("base", "link0", "link1", "link0"))
    assert scene.hosts == (0, 1, 2, 1)
    assert [scene.host(k) for k in (1, 2, 3, 4)] == [0, 1, 2, 1]
    assert parse_scene(links("base", "link0", "link1", "link2")).hosts == ()


def test_branches_stand_to_their_ends() -> None:
    """Whatever the order in the file, what a link carries stands right behind it."""
    scene = parse_scene(links("base", "link0", "link0", "link1", "link2"))
    for number in range(1, scene.stations + 1):
        carried = {k for k in range(1, scene.stations + 1) if number in way(scene, k)}
        assert carried == set(range(number, number + len(carried)))


def way(scene: Scene, number: int) -> list[int]:
    found = []
    while number:
        found.append(number)
        number = scene.host(number)
    return found


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('on = "joint2"', 'on = "joint1"', "puts a second part on [[joint]] 'joint1'"),
        ('name = "link2"\non = "joint2"', 'name = "link2"\non = "link0"', "hangs inside of a rigid body"),
    ],
)
def test_where_nothing_can_branch(old: str, new: str, said: str) -> None:
    text = links("base", "link0", "link0").replace("link3", "link1")
    assert old in text
    with pytest.raises(SceneError) as raised:
        parse_scene(text.replace(old, new))
    assert said in str(raised.value)
