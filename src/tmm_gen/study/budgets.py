"""Whether a configuration fits the budget of its scene on a microcontroller."""

from __future__ import annotations

from dataclasses import dataclass, field

from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.study.configuration import Configuration, Family
from tmm_gen.target.boards import BOARDS

DEFAULT_TARGET = "cortex-m7"
"""It knows both number types."""


@dataclass(eq=False)
class Allowance:
    """Holds families against ``[emit.budget]`` by compiling and running them in an emulator.

    Parameters
    ----------
    scene : Scene
        With a budget.
    target : str
        See :mod:`tmm_gen.target`.
    required : bool
        Whether missing tools are an error; otherwise the budget goes unchecked, and `unchecked` says why.
    """

    scene: Scene
    target: str
    required: bool
    unchecked: str = ""
    _known: dict[Family, str | None] = field(default_factory=dict)

    def __call__(self, configuration: Configuration) -> str | None:
        """Return why a configuration does not fit; None if it does.

        Raises
        ------
        UserError
            If a tool that is required is missing.
        """
        family = configuration.family
        if family not in self._known:
            self._known[family] = self._excess(configuration)
        return self._known[family]

    def _excess(self, configuration: Configuration) -> str | None:
        from tmm_gen.target import against_budget, measure

        try:
            # at the scene's own step: what a step costs does not depend on its length
            usual = Configuration(configuration.family, self.scene.integrator.step)
            found = measure(usual.apply(self.scene), self.target)
        except UserError as error:
            if self.required:
                raise
            self.unchecked = str(error)
            return None
        rows = against_budget(found, self.scene.emit.budget)
        excesses = [row.excess for row in rows if not row.passed]
        return "; ".join(excesses) or None


def require_target(name: str | None) -> None:
    """Refuse a microcontroller that is not known.

    Raises
    ------
    UserError
        If it is named and there is none of its name.
    """
    if name is not None and name not in BOARDS:
        raise UserError(f"--target {name}: no such microcontroller; there are {', '.join(BOARDS)}.")


def allowance(scene: Scene, target: str | None) -> Allowance | None:
    """Return what looks after a scene's budget; None where it has none."""
    if scene.emit.budget is None:
        return None
    return Allowance(scene, target or DEFAULT_TARGET, required=target is not None)
