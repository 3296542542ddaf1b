"""tmm-gen: a scene goes in; transfer-matrix kernels in NumPy, C99 and CasADi come out.

>>> import tmm_gen as tg
>>> arm = tg.load("scenes/elbow.toml")  # doctest: +SKIP
>>> arm.simulate(2.0, shoulder_torque=0.05).plot("swing.png")  # doctest: +SKIP
"""

import os
from importlib import import_module
from typing import TYPE_CHECKING, Any

# SymPy reads this as it is imported: a sweep's long sums drive out the thousand results that it remembers otherwise
os.environ.setdefault("SYMPY_CACHE_SIZE", "100000")

from tmm_gen.version import __version__

if TYPE_CHECKING:
    from tmm_gen.api.arm import Arm
    from tmm_gen.api.integrators import integrators
    from tmm_gen.api.load import load, parse
    from tmm_gen.api.profiles import chirp, ramp, sine, smooth, step
    from tmm_gen.api.sweep import sweep
    from tmm_gen.errors import UserError
    from tmm_gen.scene.problem import SceneError

__all__ = [
    "Arm",
    "SceneError",
    "UserError",
    "__version__",
    "chirp",
    "integrators",
    "load",
    "parse",
    "ramp",
    "sine",
    "smooth",
    "step",
    "sweep",
]

_PLACES = {
    "Arm": "tmm_gen.api.arm",
    "integrators": "tmm_gen.api.integrators",
    **dict.fromkeys(("load", "parse"), "tmm_gen.api.load"),
    **dict.fromkeys(("chirp", "ramp", "sine", "smooth", "step"), "tmm_gen.api.profiles"),
    "sweep": "tmm_gen.api.sweep",
    "UserError": "tmm_gen.errors",
    "SceneError": "tmm_gen.scene.problem",
}
"""Where each name lies: imported when it is first asked for, since NumPy and pydantic take their time."""


def __getattr__(name: str) -> Any:
    """Import a name of the Python interface."""
    if name not in _PLACES:
        raise AttributeError(f"module 'tmm_gen' has no attribute {name!r}")
    found = globals()[name] = getattr(import_module(_PLACES[name]), name)
    return found


def __dir__() -> list[str]:
    """Offer what is not imported yet, too."""
    return sorted({*globals(), *__all__})
