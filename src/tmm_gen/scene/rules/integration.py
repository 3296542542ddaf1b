"""The integrator is known, its parameters are its own and in range, and the unknown suits it."""

from __future__ import annotations

from collections.abc import Iterator

from tmm_gen.scene.document import Document
from tmm_gen.scene.integrator import INTEGRATOR_NAMES, METHODS, Method, method_named
from tmm_gen.scene.problem import Finding
from tmm_gen.scene.table import closest, is_finite_number


def integrator_parameters(document: Document) -> Iterator[Finding]:
    """Find an unknown method, and parameters that are not its own or out of range."""
    table = document.integrator
    method = method_named(table.name)
    if method is None:
        yield Finding(
            ("integrator", "name"),
            "is not a known integrator",
            f"{_did_you_mean(table.name)}Known are {', '.join(INTEGRATOR_NAMES)}.",
            table.name,
        )
        return
    parameters = {parameter.name: parameter for parameter in method.parameters}
    for key, value in (table.model_extra or {}).items():
        path = ("integrator", key)
        if key not in parameters:
            yield Finding(path, f"is not a parameter of {method.name}", _parameter_remedy(key, method), value)
            continue
        parameter = parameters[key]
        if not is_finite_number(value):
            remedy = f"Write for example `{key} = {parameter.default:g}`."
            yield Finding(path, "must be a finite number", remedy, value)
        elif not parameter.admits(float(value)):
            remedy = f"Write for example `{key} = {parameter.default:g}`."
            yield Finding(path, f"must be {parameter.range}", remedy, value)


def explicit_needs_acceleration(document: Document) -> Iterator[Finding]:
    """Find an explicit method asked to solve for displacements, which do not depend on the new forces."""
    unknown = document.model.unknown
    method = _explicit_method(document)
    if method is None or unknown == "acceleration":
        return
    yield Finding(
        ("model", "unknown"),
        f"cannot be solved for: {_explicit_words(method)}",
        'Write `unknown = "acceleration"`.',
        unknown,
    )


def coupled_suits(document: Document) -> Iterator[Finding]:
    """Find what a method whose stages are solved all at once does not go with."""
    method = method_named(document.integrator.name)
    if method is None or not method.coupled:
        return
    model, emit = document.model, document.emit
    words = f"{method.name} solves all its stages at once"
    if model.unknown != "acceleration":
        yield Finding(
            ("model", "unknown"),
            f"cannot be solved for: {words}, by their accelerations",
            'Write `unknown = "acceleration"`.',
            model.unknown,
        )
    if model.sweep != "riccati":
        yield Finding(
            ("model", "sweep"), f"is not derived here: {words}", 'Write `sweep = "riccati"`.', model.sweep
        )
    if model.corrections and model.kind == "planar":
        rounds = model.sweeps + model.corrections
        yield Finding(
            ("model", "corrections"),
            f"are not derived here: {words}",
            f"Write `iterations = {rounds}` in their place.",
            model.corrections,
        )
    beside = 'Write `name = "sdirk4"`, whose stages follow one another.'
    for where in _not_carried(document):
        yield Finding(("integrator", "name"), f"{where}: {words}", beside, document.integrator.name)
    if emit.sensitivities and model.kind == "planar":
        yield Finding(
            ("emit", "sensitivities"),
            f"are not derived here yet: {words}",
            f"Remove it, or w{beside[1:]}",
            True,
        )


def steps_may_change(document: Document) -> Iterator[Finding]:
    """Find a tolerance beside a step that cannot change on the way."""
    table, model = document.integrator, document.model
    method = method_named(table.name)
    if table.tolerance is None or method is None:
        return
    where, beside = ("integrator", "tolerance"), "Or remove it: steps are then all alike."
    if method.multistep:
        yield Finding(
            where,
            f"does not go with {method.name}, which reads instants a step apart from before",
            f'Write `name = "newmark"`, or "sdirk4". {beside}',
            table.tolerance,
        )
    if model.kind == "planar" and model.linearisation != "newton":
        yield Finding(
            where,
            f'does not go with linearisation = "{model.linearisation}", whose error does not fall with the step',
            f'Write `linearisation = "newton"` in [model]. {beside}',
            table.tolerance,
        )


def _not_carried(document: Document) -> Iterator[str]:
    """Yield the arms of a document that such methods do not go with."""
    if document.model.kind == "spatial":
        if document.model.linearisation == "newton":
            yield 'goes with linearisation = "inertial" in space, not with "newton"'
    elif document.model.kind == "planar" and document.model.linearisation != "newton":
        yield f'does not go with linearisation = "{document.model.linearisation}"'


def _explicit_method(document: Document) -> Method | None:
    """Return the method if it is explicit with the parameters given."""
    method = method_named(document.integrator.name)
    given = {
        key: float(value)
        for key, value in (document.integrator.model_extra or {}).items()
        if is_finite_number(value)
    }
    return method if method is not None and method.explicit(given) else None


def _explicit_words(method: Method) -> str:
    parameters = "".join(f" at {key} = {value:g}" for key, value in (method.explicit_at or {}).items())
    return f"{method.name} is explicit{parameters}"


def _did_you_mean(name: str) -> str:
    remedy = closest(name, INTEGRATOR_NAMES)
    return f"{remedy} " if remedy.startswith("Did") else ""


def _parameter_remedy(key: str, method: Method) -> str:
    names = [parameter.name for parameter in method.parameters]
    if names:
        remedy = closest(key, names)
        if remedy.startswith("Did"):
            return remedy
    owners = [other.name for other in METHODS if any(p.name == key for p in other.parameters)]
    hint = f" ({key} belongs to {', '.join(owners)})" if owners else ""
    known = f"Its parameters are {', '.join(names)}" if names else "It has no parameters; remove the key"
    return f"{known}{hint}."
