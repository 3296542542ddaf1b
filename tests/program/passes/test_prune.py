"""What nothing reads is not computed, whatever others of the same name do."""

from __future__ import annotations

import pytest

from tmm_gen.emit.c import emit_kernel
from tmm_gen.program.build import build_program
from tmm_gen.program.passes.prune import prune
from tmm_gen.program.statements import Assign, Loop, Order, Routine, Section
from tmm_gen.program.variables import Role, Variable, local
from tmm_gen.scene import parse_scene

KEPT = Variable("kept", Role.STATE, 4)
TURN = local("turn", "what a station computes for itself")
N = 4


def routine(*loops: Loop) -> Routine:
    return Routine("step", "A step.", (Section("all", loops),))


def test_a_value_that_its_own_loop_does_not_read_goes() -> None:
    unread = Loop(Order.OUTWARD, 0, N, (Assign(TURN, 2 * KEPT.at()), Assign(KEPT.at(), KEPT.at() + 1)))
    read = Loop(Order.OUTWARD, 0, N, (Assign(TURN, 3 * KEPT.at()), Assign(KEPT.at(), TURN)))
    pruned = prune(routine(unread, read), frozenset({KEPT}))
    first, second = pruned.statements()
    assert isinstance(first, Loop)
    assert [a.target for a in first.body if isinstance(a, Assign)] == [KEPT.at()]
    assert second == read


@pytest.mark.parametrize("order", list(Order))
def test_a_value_that_the_next_station_or_what_follows_reads_stays(order: Order) -> None:
    handed = Loop(order, 0, N, (Assign(KEPT.at(), TURN), Assign(TURN, 2 * TURN)))
    last = Loop(order, 0, N, (Assign(TURN, 2 * KEPT.at()),))
    for loops in ((handed,), (last, Loop(order, 0, 1, (Assign(KEPT.at(), TURN),)))):
        assert prune(routine(*loops), frozenset({KEPT})) == routine(*loops)


def test_joints_of_several_axes_on_one_base_compute_nothing_in_vain() -> None:
    """The force on the first of them goes to a clamp; about other axes than its own nobody asks for it."""
    joints = "".join(
        f"""
[[joint]]
name = "{axis}"
on = "base"
axis = "{axis}"
stiffness = 10.0
[[body]]
name = "on_{axis}"
on = "{axis}"
mass = 1.0
center = [0.2, 0.1, 0.0]
inertia = [1e-3, 1e-3, 1e-3]
"""
        for axis in "zy"
    )
    scene = parse_scene(
        f"""
name = "pair"
model = {{kind = "spatial", gravity = [0.0, 0.0, -9.81]}}
integrator = {{name = "newmark", step = 1e-3}}
base = {{kind = "clamp"}}
output = [{{name = "place", at = "on_y", of = "position"}}]
{joints}
"""
    )
    text = emit_kernel(build_program(scene), scene)["c/pair.c"]
    for line in text.splitlines():
        words = line.split()
        if words[:2] == ["const", "real"]:
            name = words[2]
            after = text[text.index(line) + len(line) :]
            assert name in after[: after.index("\n}\n")], line
