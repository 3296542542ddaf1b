"""Scenes changed at random: whatever a scene says, the tool takes it or refuses it in words.

A change puts something absurd, of the wrong type or merely unusual in the place of a value, or takes away, doubles or
renames a key. The same seed gives the same scene.
"""

from __future__ import annotations

import copy
import math
import random
import signal
import threading
import traceback
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

Path = tuple[Any, ...]
"""Keys and positions that lead to a value."""

NUMBERS: tuple[object, ...] = (
    *(0, 0.0, -0.0, 1, -1, 2, 3, 0.5, 0.25, 1 / 3, 1e-3, 1e-9, 1e-16, 1e-30, 1e-78, 1e-160, 1e-300, 1e-320),
    *(5e-324, 1e3, 1e9, 1e16, 1e30, 1e78, 1e160, 1e300, 1.7976931348623157e308, -1e-320, -1e30, -1e308),
    *(math.inf, -math.inf, math.nan, 2**31, 2**63, 10**30, 10**400, True),
)
WORDS = (
    *(
        "",
        " ",
        "x",
        "NAN",
        "NULL",
        "u",
        "step",
        "import",
        "class",
        "int",
        "a b",
        "a-b",
        "9a",
        "_",
        "__init__",
    ),
    *("tip", "base", "motor", "clamp", "prescribed", "hinge", "planar", "chain", "torque", "force", "angle"),
    *(
        "position",
        "velocity",
        "rate",
        "float32",
        "float64",
        "bound",
        "free",
        "own",
        "newton",
        "taylor",
        "frozen",
    ),
    *("newmark", "sdirk4", "sdirk2", "park", "houbolt", "bathe", "wilson", "zhou", "zhai", "fox_euler"),
    *(
        "mixed",
        "generalized_alpha",
        "acceleration",
        "riccati",
        "product",
        "ä$\\n{",
        "\x07",
        "a" * 300,
        "$x_{$",
        "%s%n",
    ),
    *("spatial", "quaternion", "world", "body", "inertial", "x", "-z"),
)
OTHERS: tuple[object, ...] = (
    [],
    [1.0],
    [0.0, 0.0, 0.0],
    [1.0, 0.0, -1.0],
    [1e300, 1e-300, 5e-324],
    [[]],
    {},
    {"x": 1},
    "text",
    False,
    [0.0] * 7,
    ["numpy", "c", "casadi"],
)
KEYS = (
    *(
        "gravity",
        "damping",
        "stiffness",
        "iterations",
        "linearisation",
        "sweep",
        "unknown",
        "inertia",
        "mass",
    ),
    *(
        "center",
        "length",
        "repeat",
        "links",
        "damping_time",
        "real",
        "parameters",
        "trigonometry",
        "sensitivities",
    ),
    *(
        "compensated",
        "guard",
        "rho",
        "theta",
        "beta",
        "gamma",
        "angle",
        "rate",
        "spring_rule",
        "box",
        "budget",
    ),
    *("axis", "turn", "at", "axes", "on", "section", "material", "offset", "prediction", "rest"),
)


def mutated(documents: Sequence[Mapping[str, Any]], seed: int) -> dict[str, Any]:
    """Return one of the documents with one to four changes."""
    draw = random.Random(seed)
    document = copy.deepcopy(dict(draw.choice(documents)))
    for _ in range(draw.choice((1, 1, 1, 2, 2, 3, 4))):
        _change(document, draw)
    return document


def toml(document: Mapping[str, Any]) -> str:
    """Return a document as TOML, every table on its line."""
    return "".join(f"{_word(key)} = {_value(value)}\n" for key, value in document.items())


@dataclass(frozen=True)
class Outcome:
    """What became of a trial.

    Parameters
    ----------
    result : str
        "0", "1", "2" (the exit code), "slow", or "traceback".
    where : str
        Of a traceback: its last line and the innermost place in tmm-gen; of a code, what was said.
    warned : str
        First warning, if there was one.
    """

    result: str
    where: str = ""
    warned: str = ""


def attempt(work: Callable[[], int], seconds: int) -> Outcome:
    """Do something that gives an exit code, for a limited time, and tell a defect from an answer."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            with _limited(seconds):
                result, where = str(work()), ""
        except _TooSlowError:
            result, where = "slow", ""
        except Exception as error:
            result, where = "traceback", _place(error)
    told = [item for item in caught if not issubclass(item.category, DeprecationWarning | ResourceWarning)]
    return Outcome(result, where, f"{told[0].category.__name__}: {told[0].message}" if told else "")


def _place(error: Exception) -> str:
    frames = [f for f in traceback.extract_tb(error.__traceback__) if "tmm_gen" in f.filename]
    inner = frames[-1] if frames else None
    where = f"{inner.filename.partition('tmm_gen/')[2]}:{inner.lineno}" if inner else "?"
    return f"{where} {type(error).__name__}: {str(error)[:100]}"


class _TooSlowError(BaseException):
    pass


@contextmanager
def _limited(seconds: int) -> Iterator[None]:
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def stop(_number: int, _frame: object) -> None:
        raise _TooSlowError

    # Seconds of this process's own work, so that a busy machine makes nothing slow.
    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def _change(document: dict[str, Any], draw: random.Random) -> None:
    places = list(_places(document))
    path = draw.choice(places)
    holder: Any = document
    for step in path[:-1]:
        holder = holder[step]
    key = path[-1]
    kind = draw.random()
    if kind < 0.72:
        holder[key] = _other(holder[key], draw)
    elif kind < 0.80:
        del holder[key]
    elif kind < 0.90 and isinstance(holder, list):
        holder.insert(draw.randrange(len(holder) + 1), copy.deepcopy(holder[key]))
    elif isinstance(holder, dict):
        holder[draw.choice(KEYS)] = _anything(draw)


def _other(value: object, draw: random.Random) -> object:
    if isinstance(value, bool):
        return not value
    if isinstance(value, int | float) and draw.random() < 0.9:
        if draw.random() < 0.35 and abs(value) < 10**300:
            return value * 10.0 ** draw.uniform(-6, 6)
        return draw.choice(NUMBERS)
    if isinstance(value, str) and draw.random() < 0.9:
        return draw.choice(WORDS)
    return _anything(draw)


def _anything(draw: random.Random) -> object:
    return copy.deepcopy(
        draw.choice((*NUMBERS, *WORDS, *OTHERS))
    )  # later changes must not reach the next scene


def _places(value: object, path: Path = ()) -> Iterator[Path]:
    items: Iterator[tuple[Any, object]]
    if isinstance(value, dict):
        items = iter(value.items())
    elif isinstance(value, list):
        items = iter(enumerate(value))
    else:
        return
    for key, inner in items:
        yield (*path, key)
        yield from _places(inner, (*path, key))


def _value(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return {math.inf: "inf", -math.inf: "-inf"}.get(value, "nan" if math.isnan(value) else repr(value))
    if isinstance(value, int):
        return str(value)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_word(key)} = {_value(inner)}" for key, inner in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(_value, value)) + "]"
    return _word(str(value))


def _word(text: str) -> str:
    escaped = (f"\\u{ord(letter):04x}" if letter < " " or letter in '"\\\x7f' else letter for letter in text)
    return '"' + "".join(escaped) + '"'
