"""What ``[control]`` asks for can be had of this arm."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.scene.document import Document
from tmm_gen.scene.problem import Finding

MOST_DELAY = 10
"""Samples; a longer delay than this is a slip of the unit."""


def control_possible(document: Document) -> Iterator[Finding]:
    """Find a controller of an arm that no hub torque turns, and bounds that exclude the reference."""
    control = document.control
    if control is None:
        return
    if document.model.kind != "planar":
        yield Finding(("control",), "is for planar arms", 'Set model.kind = "planar", or remove the table.')
    if document.base.kind != "motor":
        yield Finding(
            ("control",),
            "turns the arm by a torque at its hub, which does not turn",
            'Set base.kind = "motor", or remove the table.',
        )
    elif not any(item.at == "base" and item.acts == "torque" for item in document.input):
        yield Finding(
            ("control",),
            "turns the arm by a torque at its hub, which is not among the inputs",
            'Add [[input]] with `name = "hub_torque"`, `at = "base"`, `acts = "torque"`.',
        )
    hub = control.bounds.hub
    if hub is not None and not hub[0] <= control.reference <= hub[1]:
        yield Finding(
            ("control", "bounds", "hub"),
            f"excludes the reference, {control.reference:g} rad",
            "Widen the bounds, or set another reference.",
            list(hub),
        )
    if control.delay > MOST_DELAY * control.sample_time:
        yield Finding(
            ("control", "delay"),
            f"must be at most {MOST_DELAY} samples",
            f"Write seconds: one sample is {control.sample_time:g} s.",
            control.delay,
        )
