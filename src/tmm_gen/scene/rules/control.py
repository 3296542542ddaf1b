"""What ``[control]`` asks for can be had of this arm."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from tmm_gen.scene.control import Control
from tmm_gen.scene.document import Document
from tmm_gen.scene.each import by_names
from tmm_gen.scene.problem import Finding, Path
from tmm_gen.scene.table import Table

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
    for path, _ in told_by_name(control):
        yield Finding(
            path,
            "is told by names of motors, and this arm has its hub alone",
            "Write the value alone, without a name.",
        )
        return
    if control.bounds.hub_rate is not None:
        yield Finding(
            ("control", "bounds", "hub_rate"),
            "is for arms whose motors are parts by name",
            "Remove the key, or write such an arm.",
            control.bounds.hub_rate,
        )
    yield from within_reach(control, ("hub",))


def told_by_name(control: Control) -> Iterator[tuple[Path, Mapping[str, object]]]:
    """Yield what is told of each motor by its name, with its place in the file."""

    def walk(table: Table, path: Path) -> Iterator[tuple[Path, Mapping[str, object]]]:
        for name in type(table).model_fields:
            value = getattr(table, name)
            if isinstance(value, Table):
                yield from walk(value, (*path, name))
            elif isinstance(value, Mapping):
                yield (*path, name), value
            elif isinstance(value, tuple):
                for index, entry in enumerate(value):
                    if isinstance(entry, Table):
                        yield from walk(entry, (*path, name, index))

    yield from walk(control, ("control",))


def within_reach(control: Control, motors: tuple[str, ...]) -> Iterator[Finding]:
    """Find bounds that exclude the reference, and a delay that is a slip.

    Parameters
    ----------
    control : Control
        Which tells all that is told by name of all of them.
    motors : tuple of str
        Their names.
    """
    bounds = control.bounds.hub
    if bounds is not None:
        for name, reference, hub in zip(
            motors, by_names(control.reference, motors), by_names(bounds, motors), strict=True
        ):
            if not hub[0] <= reference <= hub[1]:
                yield Finding(
                    ("control", "bounds", "hub", *([name] if isinstance(bounds, dict) else [])),
                    f"excludes the reference, {reference:g} rad",
                    "Widen the bounds, or set another reference.",
                    list(hub),
                )
    if control.modes is not None and control.modes < len(motors):
        yield Finding(
            ("control", "modes"),
            f"must be at least {len(motors)}, the number of motors: each turns the arm by a mode of its own",
            "Remove the key, or write more: some that bend are to follow them.",
            control.modes,
        )
    if control.delay > MOST_DELAY * control.sample_time:
        yield Finding(
            ("control", "delay"),
            f"must be at most {MOST_DELAY} samples",
            f"Write seconds: one sample is {control.sample_time:g} s.",
            control.delay,
        )
