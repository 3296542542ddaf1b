"""The deepest stack follows from frames and calls."""

from __future__ import annotations

import pytest

from tmm_gen.target.stack import worst_stack

GRAPH = """graph: { title: "kernel"
node: { title: "arm.c:helper" label: "helper\\narm.c:3:1\\n16 bytes (static)\\n0 dynamic objects" }
node: { title: "other" label: "other\\narm.c:9:1\\n40 bytes (static)\\n0 dynamic objects" }
node: { title: "arm_step" label: "arm_step\\narm.c:20:1\\n100 bytes (static)\\n0 dynamic objects" }
node: { title: "sinf" label: "sinf\\nmath.h:1:1" shape : ellipse }
edge: { sourcename: "arm_step" targetname: "arm.c:helper" label: "arm.c:21:2" }
edge: { sourcename: "arm_step" targetname: "other" label: "arm.c:22:2" }
edge: { sourcename: "other" targetname: "arm.c:helper" label: "arm.c:10:2" }
"""


def test_the_deepest_chain_of_calls_counts() -> None:
    found = worst_stack(GRAPH + "}", "arm_step")
    assert (found.bytes, found.unknown) == (100 + 40 + 16, ())


def test_functions_without_a_frame_are_named() -> None:
    edge = 'edge: { sourcename: "arm.c:helper" targetname: "sinf" label: "arm.c:4:2" }\n}'
    assert worst_stack(GRAPH + edge, "arm_step").unknown == ("sinf",)


def test_recursion_has_no_bound() -> None:
    edge = 'edge: { sourcename: "other" targetname: "arm_step" label: "arm.c:11:2" }\n}'
    with pytest.raises(ValueError, match="calls itself"):
        worst_stack(GRAPH + edge, "arm_step")


def test_a_frame_that_depends_on_data_has_no_bound() -> None:
    with pytest.raises(ValueError, match="depends on data"):
        worst_stack(GRAPH.replace("40 bytes (static)", "40 bytes (dynamic)"), "arm_step")


def test_a_function_must_be_there() -> None:
    with pytest.raises(ValueError, match="no function leg_step"):
        worst_stack(GRAPH, "leg_step")
