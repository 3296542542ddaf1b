"""``modelDescription.xml`` and ``buildDescription.xml`` of FMI 3.0: arrays are variables."""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree import ElementTree as Xml

from tmm_gen.export.fmu.identity import Identity, add_units, number, xml_text
from tmm_gen.export.fmu.variables import FmuVariable


def description3(identity: Identity, variables: Sequence[FmuVariable]) -> str:
    """Return the description of a unit.

    Parameters
    ----------
    identity : Identity
        The unit as a whole.
    variables : sequence of FmuVariable
        In the order of their value references from 1; 0 is time.
    """
    root = identity.root("3.0", "instantiationToken")
    multiples = {
        "canHandleVariableCommunicationStepSize": "false",  # multiples of this only:
        "fixedInternalStepSize": number(identity.step),
    }
    steps = {"canHandleVariableCommunicationStepSize": "true"} if identity.held else multiples
    Xml.SubElement(root, "CoSimulation", {**identity.abilities("FMUState"), **steps})
    add_units(root, {v.unit for v in variables if v.unit != "1"} | {"s"})
    logs = Xml.SubElement(root, "LogCategories")
    Xml.SubElement(logs, "Category", name="logStatusError", description="what went wrong")
    identity.add_experiment(root)
    listed = Xml.SubElement(root, "ModelVariables")
    Xml.SubElement(
        listed,
        "Float64",
        {
            "name": "time",
            "valueReference": "0",
            "causality": "independent",
            "variability": "continuous",
            "unit": "s",
        },
    )
    for reference, variable in enumerate(variables, start=1):
        _add(listed, reference, variable)
    structure = Xml.SubElement(root, "ModelStructure")
    results = [k for k, v in enumerate(variables, start=1) if v.causality == "output"]
    for reference in results:
        # outputs are read off the state: an input acts from the next step on
        Xml.SubElement(structure, "Output", valueReference=str(reference), dependencies="")
    for reference in results:
        Xml.SubElement(structure, "InitialUnknown", valueReference=str(reference))
    return xml_text(root)


def build_description(identity: Identity, flags: Sequence[str]) -> str:
    """Return how to compile the sources.

    Parameters
    ----------
    identity : Identity
        The unit as a whole.
    flags : sequence of str
        Options of the compiler that the results depend on.
    """
    root = Xml.Element("fmiBuildDescription", fmiVersion="3.0")
    build = Xml.SubElement(root, "BuildConfiguration", modelIdentifier=identity.name)
    files = Xml.SubElement(build, "SourceFileSet", language="C99", compilerOptions=" ".join(flags))
    for name in identity.sources:
        Xml.SubElement(files, "SourceFile", name=name)
    return xml_text(root)


def _add(listed: Xml.Element, reference: int, variable: FmuVariable) -> None:
    attributes = variable.attributes(reference)
    if variable.unit != "1":
        attributes["unit"] = variable.unit
    if variable.start:
        attributes["start"] = " ".join(number(value) for value in variable.start)
    entry = Xml.SubElement(listed, "Float64", attributes)
    if variable.length is not None:
        Xml.SubElement(entry, "Dimension", start=str(variable.length))
