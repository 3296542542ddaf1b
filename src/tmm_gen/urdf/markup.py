"""Elements of an XML file with the lines they stand on.

Read by Expat itself, which the standard library's tree is built on too: it knows the line of every element, and can
refuse a DOCTYPE before any entity of it is expanded.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from xml.parsers import expat

from tmm_gen.urdf.faults import Faults


@dataclass(eq=False)
class Element:
    """An element.

    Parameters
    ----------
    tag : str
        As written, with its prefix.
    attributes : dict
        As written.
    line : int
        Of its start tag, from 1.
    children : list of Element
        In the order of the file.
    """

    tag: str
    attributes: dict[str, str]
    line: int
    children: list[Element] = field(default_factory=list)

    def all(self, tag: str) -> list[Element]:
        """Return the children of a tag."""
        return [child for child in self.children if child.tag == tag]

    def walk(self) -> Iterator[Element]:
        """Yield it and all below, in the order of the file."""
        waiting = [self]
        while waiting:
            element = waiting.pop()
            yield element
            waiting += reversed(element.children)


class _DoctypeError(Exception):
    """A DOCTYPE was met."""


def read_markup(content: bytes, origin: str) -> Element:
    """Return the root element of an XML file.

    Parameters
    ----------
    content : bytes
        Of the file, in the encoding that it declares.
    origin : str
        Name used in errors.

    Raises
    ------
    UrdfError
        If it is no XML, or has a DOCTYPE.
    """
    faults = Faults(origin)
    open_elements: list[Element] = []
    roots: list[Element] = []
    parser = expat.ParserCreate()

    def start(tag: str, attributes: dict[str, str]) -> None:
        element = Element(tag, attributes, parser.CurrentLineNumber)
        (open_elements[-1].children if open_elements else roots).append(element)
        open_elements.append(element)

    def refuse(*_: object) -> None:
        raise _DoctypeError

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda _: open_elements.pop()
    parser.StartDoctypeDeclHandler = refuse
    try:
        parser.Parse(content, True)
    except _DoctypeError:
        faults.add(
            parser.CurrentLineNumber,
            "<!DOCTYPE>",
            "is not allowed: entities could stand for anything, also for what lies in other files",
            "Remove the declaration, and write out what its entities stand for.",
        )
    except expat.ExpatError as error:
        remedy = _REMEDIES.get(error.code, "Mend the line, or export the file again.")
        still = (
            f", and <{open_elements[-1].tag}> of line {open_elements[-1].line} is open"
            if open_elements
            else ""
        )
        faults.add(error.lineno, "", f"is no XML: {expat.ErrorString(error.code)}{still}", remedy)
    except (LookupError, ValueError) as error:
        # an encoding that Python does not have, or cannot give to Expat
        faults.add(1, "", f"is in an encoding that cannot be read: {error}", "Save the file as UTF-8.")
    faults.settle()
    return roots[0]


_REMEDIES = {
    expat.errors.codes[expat.errors.XML_ERROR_NO_ELEMENTS]: "Name a file that holds a <robot>.",
    expat.errors.codes[
        expat.errors.XML_ERROR_TAG_MISMATCH
    ]: "Close every element: <link ...> ... </link>, or <link ... />.",
    expat.errors.codes[expat.errors.XML_ERROR_DUPLICATE_ATTRIBUTE]: "Write each attribute once.",
    expat.errors.codes[
        expat.errors.XML_ERROR_UNDEFINED_ENTITY
    ]: "Write the character itself; only &amp; &lt; &gt; &quot; &apos; and &#...; are known.",
}
