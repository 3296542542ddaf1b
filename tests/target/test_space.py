"""Arms in space on microcontrollers: the host's bits, and proofs that need the sums which a sweep checks on its way."""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest
from support.spatial.boom import BOOM
from support.spatial.moving import AFLOAT, TABLE

from tmm_gen.emit.c import emit_kernel
from tmm_gen.emit.c.box import box_of
from tmm_gen.emit.c.handed import handed_at, handed_on
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.errors import UserError
from tmm_gen.native import compile_kernel
from tmm_gen.native.library import OutOfRangeError
from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.program.statements import Loop, Program, Require
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.target import measure
from tmm_gen.target.proof import IN_SPACE, analyse, driver

BOX = {
    "angles": [-3.0, 3.0],
    "rates": [-10.0, 10.0],
    "accelerations": [-1e3, 1e3],
    "torque": [-0.2, 0.2],
    **{f"push_{axis}": [-5.0, 5.0] for axis in "xyz"},
}


@pytest.fixture(scope="module")
def boom() -> Scene:
    """A motor, and a beam whose cells turn about all three axes; its own sines, and a box."""
    changes = {"emit.trigonometry": "own", "emit.real": "float32", "emit.box": BOX}
    return parse_scene(BOOM).replace(**changes)


@pytest.fixture(scope="module")
def program(boom: Scene) -> Program:
    return build_program(boom)


def test_no_fault_is_possible_within_the_box(
    boom: Scene, program: Program, need_tool: Callable[[str], str]
) -> None:
    """In single precision, whose range is the smaller; and without what is checked on the way nothing is proved."""
    need_tool("frama-c")
    box = box_of(boom)
    assert box is not None
    call = driver(Kernel.of(program, boom), box)
    alarms, _ = analyse({**emit_kernel(program, boom), "proof.c": call}, "boom", IN_SPACE)
    assert alarms == ()
    bare = boom.replace(**{"emit.box": None})
    alarms, _ = analyse({**emit_kernel(program, bare), "proof.c": call}, "boom", IN_SPACE)
    assert alarms
    assert all("is_finite" in alarm.text for alarm in alarms)


def test_what_is_checked_lies_far_beyond_what_states_of_the_box_lead_to(
    boom: Scene, program: Program
) -> None:
    kernel = Kernel.of(program, boom)
    fence = kernel.fences["step"]
    assert {name.split("_")[0] for name in (v.name for v in fence.handed)} == {"articulated"}
    assert {name.split("_")[0] for name in fence.largest} == {"relief", "unknown", "yield"}
    guarded = compile_kernel(program, boom.replace(**{"emit.real": "float64"}), flags=("-O1",))
    guarded.prepare()
    draw = random.Random(31)
    keys = {"angle": "angles", "rate": "rates", "acceleration": "accelerations"}
    for _ in range(100):
        guarded.state = {
            name: [draw.uniform(*BOX[key]) for _ in range(program.stations)] for name, key in keys.items()
        }
        guarded.step({name: draw.uniform(*BOX[name]) for name in BOX if name not in keys.values()})


def test_each_joint_of_a_loops_body_is_checked() -> None:
    """A body that does several joints at a time hands on under names of its own: 21 numbers, but those that vanish."""
    program = build_program(parse_scene(BOOM.replace("links = 1", "links = 5")))
    loops = [
        loop
        for loop in program.main.statements()
        if isinstance(loop, Loop) and sum(isinstance(inner, Require) for inner in loop.body) > 1
    ]
    assert loops
    for loop in loops:
        pivots = sum(isinstance(inner, Require) for inner in loop.body)
        handed = handed_at(loop, handed_on(program.main)).values()
        assert len(handed) == pivots
        assert all(len(numbers) >= 19 for numbers in handed), [len(numbers) for numbers in handed]
        assert (
            handed_at(loop, frozenset()) == {}
        )  # without a box nothing is checked, and there is no status for it


def test_checks_refuse_what_leaves_their_bounds(boom: Scene, program: Program) -> None:
    """An arm a million times as heavy as the scene's: its state stays as it was."""
    guarded = compile_kernel(program, boom, flags=("-O1",))
    guarded.prepare()
    guarded.initialise()
    masses = next(v.default for v in program.parameters if v.name == "mass")
    assert isinstance(masses, tuple)
    guarded.prepare({"mass": [1e6 * mass for mass in masses]})
    before = guarded.state
    with pytest.raises(OutOfRangeError):
        guarded.step()
    assert {k: list(v) for k, v in guarded.state.items()} == {k: list(v) for k, v in before.items()}


@pytest.mark.parametrize("parameters", ["free", "bound"])
def test_bits_are_the_hosts(
    boom: Scene, program: Program, parameters: str, need_tool: Callable[[str], str]
) -> None:
    for tool in ("arm-none-eabi-gcc", "qemu-system-arm"):
        need_tool(tool)
    found = measure(boom.replace(**{"emit.parameters": parameters}), "cortex-m4f")
    assert found.bits_equal
    assert found.library_functions == ()
    assert found.instructions_per_step == found.instructions_least > count_routine(program.main).total
    assert found.stack_proved


@pytest.mark.parametrize("text", [AFLOAT, TABLE], ids=["floats", "prescribed"])
def test_bits_are_the_hosts_on_a_base_that_moves(text: str, need_tool: Callable[[str], str]) -> None:
    for tool in ("arm-none-eabi-gcc", "qemu-system-arm"):
        need_tool(tool)
    found = measure(
        parse_scene(text).replace(**{"emit.trigonometry": "own", "emit.real": "float32"}), "cortex-m4f"
    )
    assert found.bits_equal
    assert found.stack_proved


def test_a_prescribed_base_is_proved_too_and_one_that_floats_is_told(need_tool: Callable[[str], str]) -> None:
    need_tool("frama-c")
    turning = {"table": [-3.0, 3.0], "table_rate": [-5.0, 5.0], "table_acceleration": [-50.0, 50.0]}
    bounds = {name: limits for name, limits in BOX.items() if name != "torque"}
    changes = {"emit.trigonometry": "own", "emit.box": bounds | turning}
    scene = parse_scene(TABLE).replace(**changes)
    made, box = build_program(scene), box_of(scene)
    assert box is not None
    alarms, _ = analyse(
        {**emit_kernel(made, scene), "proof.c": driver(Kernel.of(made, scene), box)}, "table", IN_SPACE
    )
    assert alarms == ()
    afloat = parse_scene(AFLOAT).replace(**{"emit.box": bounds})
    found = box_of(afloat)
    assert found is not None
    with pytest.raises(UserError, match="whose base floats is not proved yet"):
        found.missing(build_program(afloat))
