"""Names in emitted C that no macro, keyword or local variable can meet, whatever users call things.

A macro replaces every token of its name, a struct's members too, and any header may define any name (``linux`` and
``unix`` are macros of gcc itself): no list of them is ever complete. But the preprocessor knows at every place. So

- what users name, inputs and outputs, is a member of that very name where no macro has it when the header is included,
  and has :data:`PREFIX` in front there (:func:`declared`): the same place in the struct, whoever includes it;
- our own sources say ``#undef`` before the header (:func:`bare_names`) and use the bare name; what they need themselves
  (:mod:`tmm_gen.c_language.words`) has the prefix always;
- what a scene names has the scene's name in front and one of a few words of ours behind (``thesis10_step``);
- macros and enumerators have :func:`macros` in front, which differs where the names of two scenes do.
"""

from __future__ import annotations

from tmm_gen.c_language.words import taken
from tmm_gen.program.statements import Program
from tmm_gen.program.variables import Ref, Role, Variable

PREFIX = "tmm_"
"""In front of a name that a user chose and that a macro or our own sources have. Neither C, C++, POSIX nor a compiler
has names that begin so, nor reserves them."""

_CHOSEN_BY_USERS = frozenset({Role.INPUT, Role.OUTPUT, Role.INPUT_TANGENT})


def signal(name: str, scene: str) -> str:
    """Return the member of an input or output, as a scene's own sources call it.

    Parameters
    ----------
    name : str
        As in the scene.
    scene : str
        Name of the scene.
    """
    return PREFIX + name if taken(name, scene, macros(scene)) else name


def member(variable: Variable, scene: str) -> str:
    """Return the member that holds a variable, as a scene's own sources call it."""
    return signal(variable.name, scene) if variable.role in _CHOSEN_BY_USERS else variable.name


def local_name(variable: Variable) -> str:
    """Return the local variable that holds a copy of a member: never what users name, of which it could be a macro."""
    return f"{PREFIX}{variable.name}_now" if variable.role in _CHOSEN_BY_USERS else variable.name


def element_name(ref: Ref, scene: str) -> str:
    """Return the member that holds a scalar, or an element of an array with a fixed index."""
    name = member(ref.variable, scene)
    return name if ref.entry is None else f"{name}[{ref.entry}]"


def bare_names(program: Program) -> list[str]:
    """Return the inputs and outputs whose members are bare in a program's own sources."""
    names = (variable.name for variable in (*program.inputs, *program.outputs))
    return [name for name in names if signal(name, program.name) == name]


def declared(name: str, head: str, tail: str, doc: str) -> list[str]:
    """Return the declaration of a member that a user has named: bare, unless a macro would replace the name.

    Parameters
    ----------
    name : str
        Of the member: bare, or with :data:`PREFIX` where it always has that.
    head, tail : str
        What stands before and behind it, indentation included.
    doc : str
        A comment to stand behind, with a space before; or "".
    """
    if name.startswith(PREFIX):
        return [f"{head}{name}{tail}{doc}"]
    return [
        f"#ifndef {name}",
        f"{head}{name}{tail}{doc}",
        "#else /* a macro would replace the name */",
        f"{head}{PREFIX}{name}{tail}",
        "#endif",
    ]


def macros(scene: str) -> str:
    """Return what stands in front of a scene's macros and statuses.

    Its name in capitals. A name that has capitals itself, so that capitals could not tell it from another (``Arm``,
    ``ARM``), one of a single letter, as systems have them (``R_OK`` of POSIX), and one that ends in ``_invalid``
    (``ARM_INVALID_STEP`` is a status of ``arm``) keep their form behind :data:`PREFIX`. Different for different names,
    since no name in capitals alone begins with small letters.

    Parameters
    ----------
    scene : str
        Name of a scene.
    """
    told_apart = scene == scene.lower() and len(scene) > 1 and not scene.endswith("_invalid")
    return scene.upper() if told_apart else PREFIX + scene
