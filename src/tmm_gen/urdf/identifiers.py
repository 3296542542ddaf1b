"""Names of a URDF as identifiers of a scene: what is none becomes one, and no two are alike."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from tmm_gen.scene.identifier import LONGEST, name_fault, scene_name_fault

_ROOM = 16
"""Characters left for what is put behind a name, such as ``_torque`` or ``_flange_x``."""


@dataclass
class Names:
    """Hands out identifiers.

    Parameters
    ----------
    taken : set of str
        What is given away.
    """

    taken: set[str] = field(default_factory=set)

    def take(self, wanted: str, after: str = "", columns: str = "") -> str:
        """Return an identifier for a name, the name itself where it is one and free.

        Parameters
        ----------
        wanted : str
            A name, of any characters.
        after : str
            What to put behind it where it is taken.
        columns : str
            Letters of the columns that come with it, as ``name_x``: they must be free too.
        """
        stem = identifier(wanted)
        name, number = stem, 1
        while not self._free(name, columns):
            name = f"{stem}{after}" if after and number == 1 else f"{stem}_{number}"
            number += 1
        self.taken |= {name, *(f"{name}_{column}" for column in columns)}
        return name

    def _free(self, name: str, columns: str) -> bool:
        return not self.taken & {name, *(f"{name}_{column}" for column in columns)}


def identifier(name: str) -> str:
    """Return a name, changed as little as makes an identifier of it."""
    found = re.sub(r"_*[^A-Za-z0-9_]+_*", "_", name).strip("_") or "part"
    if not found[0].isalpha():
        found = f"part_{found}"
    found = found[: LONGEST - _ROOM].rstrip("_")
    return f"{found}_1" if name_fault(found) else found


def scene_identifier(name: str) -> str:
    """Return a name, changed as little as makes that of a scene of it."""
    found = identifier(name)
    return f"{found}_arm" if scene_name_fault(found) else found
