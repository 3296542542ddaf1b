"""What a description says of a unit as a whole, in both versions of FMI."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal
from xml.etree import ElementTree as Xml

from tmm_gen.version import __version__

FmiVersion = Literal[2, 3]

_ABILITIES = {"canGetAndSet{}": "true", "canSerialize{}": "true"}


@dataclass(frozen=True)
class Identity:
    """Name, step and proof of identity.

    Parameters
    ----------
    name, title : str
        Of what is exported.
    token : str
        Changes with anything in the unit; the binary refuses another one.
    step : float
        Internal step, s.
    sources : tuple of str
        Names of the C files to compile.
    held : bool
        Whether communication steps are of any size up to the internal step, not whole multiples of it.
    """

    name: str
    title: str
    token: str
    step: float
    sources: tuple[str, ...]
    held: bool = False

    def root(self, version: str, token_attribute: str) -> Xml.Element:
        """Return the root of the description; without a date, so that it is the same every time."""
        return Xml.Element(
            "fmiModelDescription",
            {
                "fmiVersion": version,
                "modelName": self.name,
                token_attribute: self.token,
                "description": self.title,
                "generationTool": f"tmm-gen {__version__}",
                "variableNamingConvention": "structured",
            },
        )

    def abilities(self, state: str) -> dict[str, str]:
        """Return the flags common to both versions; ``state`` is how the version spells "FMU state"."""
        return {
            "modelIdentifier": self.name,
            **{key.format(state): value for key, value in _ABILITIES.items()},
        }

    def add_experiment(self, root: Xml.Element) -> None:
        """Propose the internal step as communication step."""
        Xml.SubElement(root, "DefaultExperiment", startTime="0", stepSize=repr(self.step))


def add_units(root: Xml.Element, units: set[str]) -> None:
    """Define units by their base units."""
    from tmm_gen.export.fmu.units import base_exponents

    definitions = Xml.SubElement(root, "UnitDefinitions")
    for unit in sorted(units):
        exponents = {base: str(exponent) for base, exponent in base_exponents(unit).items()}
        Xml.SubElement(Xml.SubElement(definitions, "Unit", name=unit), "BaseUnit", exponents)


def xml_text(root: Xml.Element) -> str:
    """Return a document, indented."""
    Xml.indent(root, "  ")
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + Xml.tostring(root, encoding="unicode") + "\n"


def number(value: float) -> str:
    """Return the shortest decimal that reads back as the same number."""
    return repr(float(value))
