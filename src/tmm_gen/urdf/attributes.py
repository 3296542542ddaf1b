"""Attributes and single children of elements, with errors that name the element, its line, the value and a remedy."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches

from tmm_gen.urdf.faults import Faults
from tmm_gen.urdf.markup import Element
from tmm_gen.urdf.placement import Place, Vector

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
"""What a number looks like: Python alone would also take 1_000, nan and inf."""


@dataclass(frozen=True)
class Reader:
    """Reads elements of one link or joint.

    Parameters
    ----------
    faults : Faults
        Takes what is wrong.
    owner : str
        What is read, for errors, such as ``joint 'elbow'``; empty while its name is not known.
    notes : list of str
        Takes what is passed over.
    """

    faults: Faults
    owner: str
    notes: list[str] = field(default_factory=list)

    def only(self, parent: Element, tag: str) -> Element | None:
        """Return the child of a tag, None if there is none; several are a fault."""
        found = parent.all(tag)
        for second in found[1:]:
            self._fault(
                second, f"<{tag}>", f"is there twice, first on line {found[0].line}", "Keep one of them."
            )
        return found[0] if found else None

    def text(self, element: Element, name: str, example: str) -> str:
        """Return an attribute that must be there; empty where it is not, which is a fault."""
        value = element.attributes.get(name, "").strip()
        if not value:
            self._fault(
                element,
                f"<{element.tag}>",
                f"has no attribute {name}",
                f'Add it, for example {name}="{example}".',
            )
        return value

    def number(
        self, element: Element, name: str, default: float | None = None, least: float = -math.inf
    ) -> float:
        """Return a finite number; without a default it must be there. A fault gives the default, or 0."""
        fallback = 0.0 if default is None else default
        if name not in element.attributes:
            if default is None:
                self.text(element, name, "0.1")
            return fallback
        found = self._numbers(element, name, 1, "0.1")
        if found is None:
            return fallback
        if found[0] < least:
            self._fault(
                element,
                f"<{element.tag} {name}>",
                f"must not be less than {least:g}",
                "Correct the number.",
                element.attributes[name],
            )
            return fallback
        return found[0]

    def limit(self, element: Element, name: str, least: float = -math.inf) -> float | None:
        """Return a finite number, None where there is none or where it is infinite: no limit."""
        endless = element.attributes.get(name, "inf").strip().lower().lstrip("+-") in ("inf", "infinity")
        return None if endless else self.number(element, name, least=least)

    def vector(self, element: Element | None, name: str, default: Vector) -> Vector:
        """Return three finite numbers; the default where element or attribute is absent, or at fault."""
        if element is None or name not in element.attributes:
            return default
        found = self._numbers(element, name, 3, " ".join(f"{part:g}" for part in default))
        return default if found is None else (found[0], found[1], found[2])

    def origin(self, parent: Element) -> Place:
        """Return the place that the <origin> of an element says; none is no move."""
        element = self.only(parent, "origin")
        if element is None:
            return Place.of()
        self.known(element, ("xyz", "rpy"))
        zero = (0.0, 0.0, 0.0)
        return Place.of(self.vector(element, "xyz", zero), self.vector(element, "rpy", zero))

    def known(self, element: Element, names: Sequence[str]) -> None:
        """Note attributes that URDF does not have, as exporters add them; one that is nearly a known one is a fault."""
        strange = []
        for name, value in element.attributes.items():
            if name in names:
                continue
            if near := get_close_matches(name, names, n=1, cutoff=0.65):
                part, remedy = f"<{element.tag} {name}>", f"Did you mean {near[0]}?"
                self._fault(element, part, "is no attribute of URDF", remedy, value)
            else:
                strange.append(name)
        if strange:
            listed = ", ".join(strange)
            self.notes.append(
                f"{self.owner}: left out of <{element.tag}>, being no attributes of URDF: {listed}"
            )

    def misspelt(self, parent: Element, known: Collection[str]) -> list[Element]:
        """Return children that are not known; one that is nearly a known one is a fault."""
        strange = [child for child in parent.children if child.tag not in known]
        for child in strange:
            if near := get_close_matches(child.tag.lower(), known, n=1, cutoff=0.75):
                self._fault(child, f"<{child.tag}>", "is no element of URDF", f"Did you mean <{near[0]}>?")
        return strange

    def _numbers(self, element: Element, name: str, count: int, example: str) -> list[float] | None:
        value = element.attributes[name]
        words = value.split()
        numbers = [float(word) if _NUMBER.fullmatch(word) else math.nan for word in words]
        if len(words) == count and all(map(math.isfinite, numbers)):
            return numbers
        if "${" in value or "$(" in value:
            remedy = "The file is xacro: expand it first, by `xacro FILE > robot.urdf`."
        elif "," in value:
            remedy = f'Write a point before decimals, and spaces between numbers: {name}="{example}".'
        else:
            remedy = f'Write for example {name}="{example}".'
        wanted = "a finite number" if count == 1 else f"{count} finite numbers"
        self._fault(element, f"<{element.tag} {name}>", f"must be {wanted}", remedy, value)
        return None

    def _fault(self, element: Element, part: str, message: str, remedy: str, value: object = None) -> None:
        self.faults.add(element.line, f"{self.owner} {part}".strip(), message, remedy, value)
