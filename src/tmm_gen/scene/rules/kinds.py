"""Keys that only one kind of model, linearisation or base can have."""

from __future__ import annotations

import math
from collections.abc import Iterator

from tmm_gen.scene.document import Document
from tmm_gen.scene.problem import Finding

_LINK_PLANAR = ("mass", "length", "center")


def kind_keys(document: Document) -> Iterator[Finding]:
    """Find planar keys in a chain, and planar links without mass or length."""
    if document.model.kind == "chain":
        yield from _planar_keys_in_chain(document)
        return
    for index, link in enumerate(document.link):
        for key in ("mass", "length"):
            if key not in link.model_fields_set:
                example = "mass = 0.5" if key == "mass" else "length = 0.1"
                unit = "kg" if key == "mass" else "m"
                yield Finding(
                    ("link", index, key),
                    "is missing: a planar link has mass and length",
                    f"Add for example `{example}` ({unit}).",
                )


def _planar_keys_in_chain(document: Document) -> Iterator[Finding]:
    model = document.model
    for key in ("gravity", "linearisation", "iterations", "corrections", "unsolved"):
        if key in model.model_fields_set:
            yield Finding(
                ("model", key),
                "is for planar scenes; a chain is linear and has no weight",
                'Remove it, or set model.kind = "planar".',
                getattr(model, key),
            )
    if document.beam:
        yield Finding(
            ("beam",),
            "is for planar scenes; a chain is made of torsional stations",
            'Write [[joint]] and [[link]] instead, or set model.kind = "planar".',
        )
    if document.tip:
        yield Finding(
            ("tip",), "is for planar scenes", "Remove it and add its inertia to that of the last [[link]]."
        )
    for index, link in enumerate(document.link):
        for key in _LINK_PLANAR:
            if key in link.model_fields_set:
                yield Finding(
                    ("link", index, key),
                    "is for planar scenes; a chain knows only the inertia of a link",
                    'Remove it, or set model.kind = "planar".',
                    getattr(link, key),
                )


def newton_keys(document: Document) -> Iterator[Finding]:
    """Find iterations of a linearisation that does not iterate."""
    model = document.model
    if model.kind != "planar" or model.linearisation == "newton":
        return
    for key in ("iterations", "corrections", "unsolved"):
        if key in model.model_fields_set:
            yield Finding(
                ("model", key),
                f'contradicts linearisation = "{model.linearisation}", which does not iterate',
                'Remove it, or set linearisation = "newton".',
                getattr(model, key),
            )


def _light_hub(document: Document) -> float:
    """Return an inertia that changes the arm's motion by little: a thousandth of the first link's about the hub."""
    link = next(iter(document.links()), None)
    light = (link.inertia + link.mass * link.length * link.length) / 1000 if link else 0.0
    return light if 0.0 < light < math.inf else 0.05


def base_hub(document: Document) -> Iterator[Finding]:
    """Find a motor without inertia, and a clamp with a hub."""
    base = document.base
    if base.kind == "motor" and base.inertia <= 0.0:
        given = "inertia" in base.model_fields_set
        yield Finding(
            ("base", "inertia"),
            "must be greater than 0 for a motor, whose torques turn the hub"
            if given
            else "is missing: a motor turns a hub",
            "Write the inertia of hub and rotor in kg m^2, for example `inertia = 0.05`; beside this arm "
            f"{_light_hub(document):.2g} is light.",
            base.inertia if given else None,
        )
    if base.kind == "clamp":
        for key in ("inertia", "damping"):
            if key in base.model_fields_set:
                yield Finding(
                    ("base", key),
                    'contradicts kind = "clamp", which has no hub',
                    'Remove it, or set kind = "motor".',
                    getattr(base, key),
                )


def held(document: Document) -> Iterator[Finding]:
    """Find an arm that nothing holds."""
    if document.base.kind == "free":
        yield Finding(
            ("base", "kind"),
            "leaves the arm without anything that holds it, which arms of parts by name alone can do",
            'Write "clamp", "motor" or "prescribed".',
            "free",
        )
