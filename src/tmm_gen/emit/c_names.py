"""Names in emitted C that no macro, keyword or local variable can meet, whatever users call things.

A macro replaces every token of its name, a struct's members too, and any header may define any name (``linux`` and
``unix`` are macros of gcc itself): no list of them is ever complete, and a rule on the form of a name is such a list.
C knows one remedy, names with a prefix that belongs to one library. So

- what users name, inputs and outputs, is a member with :data:`PREFIX` in front, always;
- what a scene names has the scene's name in front and one of a few words of ours behind (``thesis10_step``);
- macros and enumerators have :func:`macros` in front, which differs where the names of two scenes do.
"""

from __future__ import annotations

from tmm_gen.program.variables import Ref, Role, Variable

PREFIX = "tmm_"
"""In front of every name that a user chose and that stands alone. Neither C, C++, POSIX nor a compiler has names that
begin so, nor reserves them."""

_CHOSEN_BY_USERS = frozenset({Role.INPUT, Role.OUTPUT, Role.INPUT_TANGENT})


def signal(name: str) -> str:
    """Return the member of an input or output.

    Parameters
    ----------
    name : str
        As in the scene.
    """
    return PREFIX + name


def c_name(variable: Variable) -> str:
    """Return the identifier of a variable: members and local variables alike."""
    return signal(variable.name) if variable.role in _CHOSEN_BY_USERS else variable.name


def c_element(ref: Ref) -> str:
    """Return the identifier of a scalar, or of an element of an array with a fixed index."""
    name = c_name(ref.variable)
    return name if ref.entry is None else f"{name}[{ref.entry}]"


def macros(scene: str) -> str:
    """Return what stands in front of a scene's macros and statuses.

    Its name in capitals; a name that has capitals itself, so that capitals could not tell it from another (``Arm``,
    ``ARM``), and one of a single letter, as systems have them (``R_OK`` of POSIX), keep their form behind
    :data:`PREFIX`. Different for different names, since no name in capitals alone begins with small letters.

    Parameters
    ----------
    scene : str
        Name of a scene.
    """
    return scene.upper() if scene == scene.lower() and len(scene) > 1 else PREFIX + scene
