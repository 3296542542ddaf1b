"""One way to compute a scene's motion: what a study of errors and costs varies."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Literal

from tmm_gen.scene import Scene
from tmm_gen.scene.integrator import underscored
from tmm_gen.study.cells import cut_into, cuts

Backend = Literal["c", "numpy"]


@dataclass(frozen=True, order=True)
class Family:
    """All that decides which kernel is generated: everything but the step, which a kernel takes at `prepare`.

    Parameters
    ----------
    integrator : str
        With underscores.
    links : int, optional
        Links of the beam, in space cells of all beams; None where the scene lists its links, or cells differ.
    linearisation : str, optional
        Of an arm; None for a chain.
    iterations : int
        Sweeps per stage, or a sweep and its corrections.
    real : str
        "float64" or "float32".
    backend : {"c", "numpy"}
        NumPy knows float64 only.
    corrections : int
        Per stage behind its sweeps, of an arm in a plane.
    """

    integrator: str
    links: int | None
    linearisation: str | None
    iterations: int
    real: str
    backend: str
    corrections: int = 0

    @property
    def label(self) -> str:
        """What tells it from others, in a few words."""
        links = f", {self.links} links" if self.links is not None else ""
        return f"{self.integrator}{links}" + "".join(f", {part}" for part in self._unusual())

    @property
    def variant(self) -> str:
        """The label without the integrator; the number type where there is nothing else."""
        links = [] if self.links is None else [f"{self.links} links"]
        return ", ".join([*links, *(self._unusual() or [self.real])])

    def _unusual(self) -> list[str]:
        parts = []
        if self.linearisation not in (None, "newton"):
            parts.append(str(self.linearisation))
        if self.iterations > 1:
            parts.append(f"{self.iterations} sweeps")
        if self.corrections:
            parts.append(f"{self.corrections} correction{'s' if self.corrections > 1 else ''}")
        if self.real != "float64":
            parts.append(self.real)
        if self.backend != "c":
            parts.append(self.backend)
        return parts

    def changes(self, scene: Scene) -> dict[str, object]:
        """Return the keys of a scene that differ, as :meth:`Scene.replace` takes them."""
        wanted: dict[str, tuple[object, object]] = {
            "integrator.name": (scene.integrator.name, self.integrator),
            "emit.real": (scene.emit.real, self.real),
            "model.iterations": (self._as_it_would_be(scene), self.iterations),
            "model.corrections": (scene.model.corrections, self.corrections),
        }
        if scene.emit.compensated and self.real == "float64":
            wanted["emit.compensated"] = (True, False)
        if self.links is not None:
            wanted |= cuts(scene, self.links)
        if self.linearisation is not None:
            wanted["model.linearisation"] = (scene.model.linearisation, self.linearisation)
        return {key: new for key, (old, new) in wanted.items() if new != old}

    def _as_it_would_be(self, scene: Scene) -> int | None:
        """Return the rounds of the scene; None in space where they follow from what else differs."""
        linearisation = self.linearisation or scene.model.linearisation
        alike = (scene.integrator.name, scene.model.linearisation) == (self.integrator, linearisation)
        return scene.model.sweeps if scene.spatial is None or alike else None


@dataclass(frozen=True, order=True)
class Configuration:
    """A family at one step.

    Parameters
    ----------
    family : Family
        What is generated.
    step : float
        s.
    """

    family: Family
    step: float

    def apply(self, scene: Scene) -> Scene:
        """Return the scene so configured, steps all alike; an integrator's own parameters stay where it does.

        Raises
        ------
        SceneError
            If that is no valid scene.
        """
        steady: dict[str, object] = (
            {} if scene.integrator.tolerance is None else {"integrator.tolerance": None}
        )
        return scene.replace(**self.family.changes(scene), **steady, **{"integrator.step": self.step})

    def values(self) -> dict[str, object]:
        """Return all choices by key."""
        return {**asdict(self.family), "step": self.step}


def own(scene: Scene) -> Configuration:
    """Return how a scene itself wants to be computed, in C."""
    family = Family(
        integrator=underscored(scene.integrator.name),
        links=cut_into(scene),
        linearisation=None if scene.model.linear else scene.model.linearisation,
        iterations=scene.sweeps,
        real=scene.emit.real,
        backend="c",
        corrections=scene.model.corrections,
    )
    return Configuration(family, scene.integrator.step)
