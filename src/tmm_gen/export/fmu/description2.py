"""``modelDescription.xml`` of FMI 2.0: every element of an array is a variable of its own."""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree import ElementTree as Xml

from tmm_gen.export.fmu.identity import Identity, add_units, number, xml_text
from tmm_gen.export.fmu.variables import FmuVariable


def description2(identity: Identity, variables: Sequence[FmuVariable]) -> str:
    """Return the description of a unit.

    Parameters
    ----------
    identity : Identity
        The unit as a whole.
    variables : sequence of FmuVariable
        Single numbers, in the order of their value references from 1; 0 is time.
    """
    root = identity.root("2.0", "guid")
    simulation = Xml.SubElement(
        root,
        "CoSimulation",
        {
            **identity.abilities("FMUstate"),
            # else multiples of the internal step only, which FMI 2.0 cannot say
            "canHandleVariableCommunicationStepSize": "true" if identity.held else "false",
            "canNotUseMemoryManagementFunctions": "true",
        },
    )
    files = Xml.SubElement(simulation, "SourceFiles")
    for name in identity.sources:
        Xml.SubElement(files, "File", name=name)
    add_units(root, {v.unit for v in variables if v.unit != "1"} | {"s"})
    logs = Xml.SubElement(root, "LogCategories")
    Xml.SubElement(logs, "Category", name="logStatusError", description="what went wrong")
    identity.add_experiment(root)
    listed = Xml.SubElement(root, "ModelVariables")
    time = Xml.SubElement(
        listed,
        "ScalarVariable",
        {"name": "time", "valueReference": "0", "causality": "independent", "variability": "continuous"},
    )
    Xml.SubElement(time, "Real", unit="s")
    for reference, variable in enumerate(variables, start=1):
        _add(listed, reference, variable)
    structure = Xml.SubElement(root, "ModelStructure")
    results = [k for k, v in enumerate(variables, start=2) if v.causality == "output"]
    if results:
        # outputs are read off the state: an input acts from the next step on
        outputs = Xml.SubElement(structure, "Outputs")
        for index in results:
            Xml.SubElement(outputs, "Unknown", index=str(index), dependencies="")
        unknowns = Xml.SubElement(structure, "InitialUnknowns")
        for index in results:
            Xml.SubElement(unknowns, "Unknown", index=str(index))
    return xml_text(root)


def _add(listed: Xml.Element, reference: int, variable: FmuVariable) -> None:
    entry = Xml.SubElement(listed, "ScalarVariable", variable.attributes(reference))
    real = {"unit": variable.unit} if variable.unit != "1" else {}
    if variable.start:
        real["start"] = number(variable.start[0])
    Xml.SubElement(entry, "Real", real)
