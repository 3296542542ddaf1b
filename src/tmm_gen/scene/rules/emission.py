"""What is emitted, and the bounds set on it, concern something in the scene."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tmm_gen.scene.document import Document
from tmm_gen.scene.emit import Budget, Emit
from tmm_gen.scene.problem import Finding
from tmm_gen.scene.signal import kernel_names
from tmm_gen.scene.table import closest

BOX_STATES = (
    "angles",
    "rates",
    "accelerations",
    "step",
    "base_places",
    "base_velocities",
    "base_accelerations",
)


def real_is_used(document: Document) -> Iterator[Finding]:
    """Find settings of the C code where none is emitted."""
    emit = document.emit
    if "c" in emit.backends:
        return
    for key in ("real", "trigonometry", "parameters", "compensated", "favour"):
        if (value := getattr(emit, key)) != Emit.model_fields[key].default:
            yield Finding(
                ("emit", key),
                "is for the C code, which is not emitted",
                'Add "c" to backends, or remove it.',
                value,
            )
    for key in ("budget", "box", "batch"):
        if getattr(emit, key) is not None:
            yield Finding(
                ("emit", key), "is for the C code, which is not emitted", 'Add "c" to backends, or remove it.'
            )


def bound_without_sensitivities(document: Document) -> Iterator[Finding]:
    """Find derivatives asked of a kernel whose parameters are constants or whose sines are its own."""
    emit = document.emit
    if not emit.sensitivities:
        return
    if emit.parameters == "bound":
        yield Finding(
            ("emit", "parameters"),
            "and emit.sensitivities exclude each other",
            'Write parameters = "free", or remove sensitivities.',
            emit.parameters,
        )
    if emit.trigonometry == "own" and document.model.kind != "chain" and "c" in emit.backends:
        beside = "" if emit.batch is None else " and batch, which needs it"
        yield Finding(
            ("emit", "trigonometry"),
            "and emit.sensitivities exclude each other: derivatives are by the C library's sines",
            f"Remove it{beside}, or remove sensitivities.",
            emit.trigonometry,
        )


def corrections_without_sensitivities(document: Document) -> Iterator[Finding]:
    """Find derivatives asked of a step with corrections: they would be those of factors too."""
    corrections = document.model.corrections
    if corrections and document.emit.sensitivities:
        rounds = document.model.sweeps + corrections
        yield Finding(
            ("model", "corrections"),
            "and emit.sensitivities exclude each other: a step with corrections has no exact derivatives yet",
            f"Write `iterations = {rounds}` in their place, or remove sensitivities.",
            corrections,
        )


def compensated_suits(document: Document) -> Iterator[Finding]:
    """Find sums of two numbers asked for where they are of no use, or not to be had."""
    emit, key = document.emit, ("emit", "compensated")
    if not emit.compensated or "c" not in emit.backends:
        return
    if emit.real != "float32":
        yield Finding(
            key,
            f"keeps each number as the sum of two of type float, and emit.real is {emit.real}",
            'Write real = "float32", or remove it.',
            True,
        )
    if emit.sensitivities:
        yield Finding(
            key,
            "and emit.sensitivities exclude each other",
            "Remove one of them: exact derivatives are emitted without compensation.",
            True,
        )
    if document.model.kind in ("planar", "spatial") and emit.trigonometry != "own":
        yield Finding(
            key,
            "needs sines that are as exact, which a C library has not",
            'Write trigonometry = "own" beside it.',
            True,
        )


def batch_suits(document: Document) -> Iterator[Finding]:
    """Find a kernel for many arms asked for beside what it cannot be, or without what it needs."""
    emit, key = document.emit, ("emit", "batch")
    if emit.batch is None or "c" not in emit.backends:
        return
    if emit.parameters == "bound":
        yield Finding(
            key,
            "is for arms that may differ, and emit.parameters is bound",
            'Write parameters = "free", or remove it.',
            emit.batch,
        )
    if emit.compensated:
        yield Finding(key, "and emit.compensated exclude each other", "Remove one of them.", emit.batch)
    if emit.batch == 16 and emit.real == "float64":
        yield Finding(
            key,
            "of float64 is wider than any vector register, and slow",
            'Write batch = 8, or real = "float32" beside it.',
            emit.batch,
        )
    if document.model.kind != "chain" and emit.trigonometry != "own" and emit.sensitivities:
        yield Finding(
            key,
            "and emit.sensitivities exclude each other: derivatives are by the C library's sines, which several arms "
            "at once have not",
            "Remove one of them.",
            emit.batch,
        )
    elif document.model.kind != "chain" and emit.trigonometry != "own":
        yield Finding(
            key,
            "needs sines for several arms at once, which a C library has not",
            'Write trigonometry = "own" beside it.',
            emit.batch,
        )


def favour_suits(document: Document) -> Iterator[Finding]:
    """Find fast code asked for where it is not to be had."""
    emit, key = document.emit, ("emit", "favour")
    if emit.favour == "size" or "c" not in emit.backends:
        return
    if emit.compensated:
        yield Finding(
            key,
            "and emit.compensated exclude each other: no vector register holds sums of two",
            "Remove one of them.",
            emit.favour,
        )
    if emit.box is not None:
        yield Finding(
            key,
            "and [emit.box] exclude each other: the proof is of the small code",
            'Write favour = "size", or remove the table.',
            emit.favour,
        )


def budget_not_empty(document: Document) -> Iterator[Finding]:
    """Find a budget that bounds nothing."""
    budget = document.emit.budget
    if budget is not None and not budget.model_fields_set:
        yield Finding(
            ("emit", "budget"),
            "is empty",
            f"Set one of {', '.join(Budget.model_fields)}, or remove the table.",
        )


def box_names(document: Document) -> Iterator[Finding]:
    """Find bounds on what is neither state nor input of this scene, and inputs called as a key of the state."""
    yield from box_of_names(document.emit, [kernel_names(item) for item in document.input])


def box_of_names(emit: Emit, names: Sequence[Sequence[str]]) -> Iterator[Finding]:
    """Find the same where kernels take each input under some names."""
    for index, mine in enumerate(names if emit.box is not None else ()):
        for name in mine:
            if name in BOX_STATES:
                yield Finding(
                    ("input", index, "name"),
                    "is a key of [emit.box], where it bounds something else",
                    f"Choose another, for example '{name}_1'.",
                    name,
                )
    known = [*BOX_STATES, *(name for mine in names for name in mine)]
    for key, bounds in (emit.box or {}).items():
        if key not in known:
            yield Finding(
                ("emit", "box", key),
                "is neither a state nor an input of this scene",
                closest(key, known),
                bounds,
            )
        elif key == "step" and emit.parameters == "bound":
            yield Finding(
                ("emit", "box", key),
                "bounds a step that is a constant of the code",
                'Remove it, or write parameters = "free".',
                bounds,
            )
        elif key == "step" and bounds[0] <= 0.0:
            yield Finding(
                ("emit", "box", key), "must be greater than 0", "Write for example `[1e-4, 1e-2]`.", bounds
            )
