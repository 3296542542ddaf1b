"""Inputs as a program gives them: numbers, profiles, files, functions, values over time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from difflib import get_close_matches

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.inputs.given import constant_inputs, input_names, read_inputs
from tmm_gen.inputs.sampled import Function, finite, sampled, shown, tabled
from tmm_gen.inputs.signals import Signal
from tmm_gen.modal.near import start_of
from tmm_gen.scene import Scene

__all__ = ["constants", "free_angles", "named", "number", "positive", "required", "signals"]


def named(scene: Scene, given: Mapping[str, object] | None, more: Mapping[str, object]) -> dict[str, object]:
    """Return inputs by column: a force in space may be given as three, by the name that the scene has for it.

    Raises
    ------
    UserError
        If a name is none of the scene's, or given twice.
    """
    if given is not None and not isinstance(given, Mapping):
        raise UserError(f"inputs: must be a mapping from names to values, not {type(given).__name__}.")
    vectors = {item.name: item.columns for item in scene.spatial.inputs} if scene.spatial is not None else {}
    names, found = [item.name for item in scene.inputs], dict[str, object]()
    for name, value in [*(given or {}).items(), *more.items()]:
        columns = vectors.get(name, (name,))
        parts = [value] if columns == (name,) else _parts(name, columns, value)
        for column, part in zip(columns, parts, strict=True):
            if column not in names:
                raise UserError(_unknown(scene, column, [*names, *vectors]))
            if column in found:
                raise UserError(f"{column}: is given twice. Give it once.")
            found[column] = part
    return found


def _parts(name: str, columns: Sequence[str], value: object) -> Sequence[object]:
    if not isinstance(value, tuple | list | np.ndarray) or len(value) != len(columns):
        raise UserError(
            f"{name}: must be {len(columns)} values, for {', '.join(columns)}. Write for example "
            f"{name}=(0, 0, 1), or name one of them alone."
        )
    return list(value)


def _unknown(scene: Scene, name: str, names: Sequence[str]) -> str:
    if not names:
        return f"{name}: the scene '{scene.name}' has no inputs. Add [[input]] to it."
    near = get_close_matches(name, names, n=1)
    remedy = f"Did you mean {near[0]}?" if near else f"Its inputs are {', '.join(dict.fromkeys(names))}."
    return f"{name}: the scene '{scene.name}' has no input of this name. {remedy}"


def signals(scene: Scene, given: Mapping[str, object], steps: int) -> dict[str, Signal]:
    """Return inputs over time.

    Parameters
    ----------
    scene : Scene
        With the step of the simulation.
    given : mapping from str to object
        As of :func:`named`: a number; a text as behind ``tmm-gen run --input NAME=``; a profile; a function of time;
        an array with a value for each instant; a pair of times and values.
    steps : int
        Of the simulation.
    """
    return {name: _signal(scene, name, value, steps) for name, value in given.items()}


def _signal(scene: Scene, name: str, value: object, steps: int) -> Signal:
    names, angles = input_names(scene)
    if isinstance(value, str):
        return read_inputs([f"{name}={value}"], names, angles)[name]
    if isinstance(value, Signal):
        return value
    if callable(value) and not hasattr(value, "__array__"):
        function = Function(name, value, scene.integrator.step)
        if name not in angles:
            return function
        # a base wants a smooth motion: a curve through what the function says at every step
        instants = _instants(scene, steps)
        return tabled(name, instants, function.at(instants))
    if isinstance(value, tuple) and len(value) == 2 and _is_row(value[0]):
        return tabled(name, *value)
    if _is_row(value):
        return sampled(name, value, _instants(scene, steps))
    return read_inputs([f"{name}={number(name, value)!r}"], names, angles)[name]


def _is_row(value: object) -> bool:
    """Whether a value is meant as several."""
    return isinstance(value, list | tuple) or bool(getattr(value, "ndim", 0))


def _instants(scene: Scene, steps: int) -> NDArray[np.float64]:
    """Return the instants of a simulation, s, (steps + 1,)."""
    return scene.integrator.step * np.arange(steps + 1, dtype=float)


def number(name: str, value: object) -> float:
    """Return a value as a finite float.

    Raises
    ------
    UserError
        If it is none.
    """
    found = finite(value)
    if found is None:
        raise UserError(f"{name}: {shown(value)} is not a finite number. Write for example {name}=1.5.")
    return found


def positive(name: str, value: float | None, what: str) -> float | None:
    """Return a positive number, or None where none is given.

    Raises
    ------
    UserError
        If it is not positive.
    """
    return None if value is None else required(name, value, what)


def required(name: str, value: object, what: str) -> float:
    """Return a positive number.

    Raises
    ------
    UserError
        If it is not positive.
    """
    found = number(name, value)
    if found <= 0.0:
        raise UserError(f"{name}: must be a positive number{f' of {what}' if what else ''}, not {value!r}.")
    return found


def constants(
    scene: Scene, given: Mapping[str, object] | None, more: Mapping[str, object]
) -> dict[str, float]:
    """Return constant inputs that an arm rests under, by column.

    Raises
    ------
    UserError
        If one is no number, of no such name, or the scene is a chain, whose motion no load changes.
    """
    found = {name: number(name, value) for name, value in named(scene, given, more).items()}
    return constant_inputs(scene, [f"{name}={value!r}" for name, value in found.items()])


def free_angles(scene: Scene, near: Mapping[str, float] | None) -> NDArray[np.float64] | None:
    """Return the free angles that joints of some angles stand for; None where none are given.

    Raises
    ------
    UserError
        If there is no such joint, an angle is no number, or the scene is a chain.
    """
    return None if near is None else start_of(scene, [f"{name}={angle}" for name, angle in _angles(near)])


def _angles(near: object) -> list[tuple[object, object]]:
    if isinstance(near, Mapping):
        return list(near.items())
    raise UserError(
        f"near: must be a mapping from joints to angles, rad, such as {{'elbow': 0.5}}, not {near!r}."
    )
