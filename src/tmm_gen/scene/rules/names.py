"""Names of inputs and outputs are distinct, in the scene and in the CSV file a run writes."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.scene.document import Document
from tmm_gen.scene.identifier import name_fault
from tmm_gen.scene.problem import Finding
from tmm_gen.scene.quantity import PLANAR
from tmm_gen.scene.signal import FileInput, FileOutput, kernel_names


def distinct_names(document: Document) -> Iterator[Finding]:
    """Find signals that share a name, and outputs named as a component of another."""
    first: dict[str, str] = {}
    for table in ("input", "output"):
        for index, signal in enumerate(getattr(document, table)):
            place = f"[[{table}]] number {index + 1}"
            names = kernel_names(signal) if isinstance(signal, FileInput) else (signal.name,)
            for name, what in zip(names, ("", "the rate of ", "the acceleration of "), strict=False):
                comes = f"comes with '{name}', which " if what else ""
                if name in first:
                    yield Finding(
                        (table, index, "name"),
                        f"{comes}is already the name of {first[name]}",
                        f"Choose another, for example '{signal.name}_{index + 1}'.",
                        signal.name,
                    )
                elif what and (wrong := name_fault(name)):
                    yield Finding((table, index, "name"), f"{comes}{wrong[0]}", wrong[1], signal.name)
                first.setdefault(name, f"{what}{place}")
    if document.model.kind == "planar":
        yield from _distinct_columns(document.output)


def _distinct_columns(outputs: tuple[FileOutput, ...]) -> Iterator[Finding]:
    columns = {
        f"{output.name}_{axis}": output.name
        for output in outputs
        if PLANAR[output.of].vector
        for axis in ("x", "y")
    }
    for index, output in enumerate(outputs):
        if output.name in columns:
            yield Finding(
                ("output", index, "name"),
                f"is also the name of a component of output '{columns[output.name]}'",
                f"Choose another, for example '{output.name}_2'.",
                output.name,
            )
