"""The deepest stack a function can reach, from the call graph that gcc writes (``-fcallgraph-info=su``)."""

from __future__ import annotations

import re
from dataclasses import dataclass

_NODE = re.compile(r'node: \{ title: "([^"]+)" label: "([^"]*)"')
_EDGE = re.compile(r'edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"')
_FRAME = re.compile(r"(\d+) bytes \((\w+)")


@dataclass(frozen=True)
class Depth:
    """How deep the stack gets.

    Parameters
    ----------
    bytes : int
        Of the function and all it calls whose frames are known.
    unknown : tuple of str
        Functions it reaches whose frames are not known: those of libraries.
    """

    bytes: int
    unknown: tuple[str, ...]


def worst_stack(callgraph: str, function: str) -> Depth:
    """Return the deepest stack from a function on.

    Parameters
    ----------
    callgraph : str
        Content of gcc's ``.ci`` file.
    function : str
        Where to start.

    Raises
    ------
    ValueError
        If the function is not in the graph, calls itself, or has a frame whose size depends on data.
    """
    frames: dict[str, int] = {}
    for title, label in _NODE.findall(callgraph):
        frame = _FRAME.search(label)
        if frame is None:
            continue
        if frame[2] != "static":
            raise ValueError(f"the frame of {title} is {frame[2]}: its size depends on data")
        frames[title] = int(frame[1])
    calls: dict[str, list[str]] = {}
    for source, target in _EDGE.findall(callgraph):
        calls.setdefault(source, []).append(target)
    start = next((title for title in frames if title.split(":")[-1] == function), None)
    if start is None:
        raise ValueError(f"no function {function} in the call graph")
    unknown: set[str] = set()

    def depth(title: str, above: tuple[str, ...]) -> int:
        if title in above:
            raise ValueError(f"{title} calls itself: no bound of the stack")
        if title not in frames:
            unknown.add(title)
            return 0
        below = (depth(callee, (*above, title)) for callee in calls.get(title, []))
        return frames[title] + max(below, default=0)

    return Depth(depth(start, ()), tuple(sorted(unknown)))
