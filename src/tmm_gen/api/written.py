"""What an arm is written as: its scene file, its package, models of other tools, a page."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from tmm_gen.api.described import Described
from tmm_gen.api.given import positive
from tmm_gen.api.guard import guarded
from tmm_gen.api.picture import target_of
from tmm_gen.api.several import Few, texts
from tmm_gen.api.words import path_of
from tmm_gen.errors import UserError
from tmm_gen.files import write_whole

if TYPE_CHECKING:
    from tmm_gen.api.exported import Exported
    from tmm_gen.package.build import Built

__all__ = ["Written"]


class Written(Described):
    """An arm that can be written to files."""

    @guarded
    def save(self, file: str | PathLike[str]) -> Path:
        """Write its scene file; return where."""
        target = target_of(file, (".toml",))
        write_whole(target, self.toml())
        return target

    @guarded
    def build(self, out: str | PathLike[str] = "generated", *, force: bool = False) -> Built:
        """Write its generated package into a folder of packages; say what was done.

        Parameters
        ----------
        out : str or path
            Folder of the packages; made if missing.
        force : bool
            Overwrite also files that were edited by hand or are not tmm-gen's.
        """
        from tmm_gen.package.build import built

        folder = path_of("out", out)
        if folder.exists() and not folder.is_dir():
            raise UserError(f"out: {folder} is a file, not a folder. Name another place.")
        return built(self.scene, folder, force)

    @guarded
    def export(self, file: str | PathLike[str], *, fmi: Literal[2, 3] = 2, cc: str = "gcc") -> Exported:
        """Write it for another tool, by the file's ending.

        Parameters
        ----------
        file : str or path
            ``.fmu``: a functional mock-up unit. ``.xml``: a model for MuJoCo. ``.urdf``: a robot, of arms in space.
        fmi : {2, 3}
            Version of FMI.
        cc : str
            Compiler of the unit's binary.
        """
        from tmm_gen.api.exported import exported

        return exported(self.scene, file, fmi, cc)

    @guarded
    def playground(
        self, file: str | PathLike[str], *, integrators: Few = None, until: float | None = None
    ) -> Path:
        """Write one page on which anybody plays with it, as WebAssembly; needs the extra `playground`.

        Parameters
        ----------
        file : str or path
            Ends in ``.html``.
        integrators : str or iterable of str, optional
            To choose from, besides its own and ``sdirk4``; by default ``newmark``, ``bathe``, ``houbolt``, ``zhai``.
        until : float, optional
            Length of a run, s; by default five slow periods, or fewer.
        """
        from tmm_gen.playground.page import playground

        target = target_of(file, (".html",))
        write_whole(
            target,
            playground(self.scene, texts("integrators", integrators), positive("until", until, "seconds")),
        )
        return target
