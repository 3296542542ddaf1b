"""What an arm is, in words: its signals, its scene file, how it is shown."""

from __future__ import annotations

from typing import Self

from tmm_gen.api.guard import guarded
from tmm_gen.api.html import html_table
from tmm_gen.scene import Scene
from tmm_gen.scene.columns import output_columns
from tmm_gen.scene.quantity import INPUT_UNITS

__all__ = ["Described"]


class Described:
    """An arm that can be described.

    Attributes
    ----------
    scene : Scene
        All that it says.
    """

    scene: Scene

    @property
    def name(self) -> str:
        """Of the scene, and of the generated package."""
        return self.scene.name

    @property
    def kind(self) -> str:
        """Return "chain", "planar" or "spatial"."""
        return self.scene.model.kind

    @property
    def inputs(self) -> dict[str, str]:
        """Units of the inputs by column."""
        return {item.name: INPUT_UNITS[item.acts] for item in self.scene.inputs}

    @property
    def outputs(self) -> dict[str, str]:
        """Units of the outputs by column."""
        return {column.name: column.unit for column in output_columns(self.scene)}

    @property
    def hints(self) -> list[str]:
        """What is probably mistaken, mostly units."""
        from tmm_gen.explain.hints import hints

        return hints(self.scene)

    @guarded
    def toml(self) -> str:
        """Return the text of its scene file; comments of the file that it was read from are not kept."""
        import tomlkit

        return tomlkit.dumps(dict(self.scene.source.data))

    @property
    def _size(self) -> str:
        count = self.scene.stations
        return f"{count} {'joint' if self.scene.spatial else 'link'}{'s' * (count > 1)}"

    def __reduce__(self) -> tuple[object, tuple[Scene]]:
        """Pickle by the scene: kernels are made anew where they are asked for."""
        return type(self).of, (self.scene,)

    @classmethod
    def of(cls, scene: Scene) -> Self:
        """Return the arm of a scene."""
        made = cls.__new__(cls)
        made.scene = scene
        return made

    def __eq__(self, other: object) -> bool:
        """Compare what both say, however they are written."""
        return self.scene == other.scene if isinstance(other, Described) else NotImplemented

    def __hash__(self) -> int:
        """Hash what it says."""
        return hash(self.scene)

    def __repr__(self) -> str:
        """Say what it is."""
        method = self.scene.integrator
        return f"<Arm {self.name}: {self.kind}, {self._size}, {method.name} at {method.step:g} s>"

    def _repr_html_(self) -> str:
        rows = [{"signal": name, "unit": unit, "what": "input"} for name, unit in self.inputs.items()]
        rows += [
            {"signal": column.name, "unit": column.unit, "what": column.what}
            for column in output_columns(self.scene)
        ]
        method = self.scene.integrator
        title = f"{self.scene.title} ({self.kind}, {self._size}, {method.name} at {method.step:g} s)"
        return html_table(title, {"signal": "signal", "unit": "unit", "what": ""}, rows, self.hints)
