"""A scene file with another configuration in it: changed where it must be, otherwise as the user wrote it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from tmm_gen.scene import Scene, parse_scene
from tmm_gen.scene.integrator import underscored
from tmm_gen.study.chosen_steps import changes_of
from tmm_gen.study.configuration import Configuration, Family


def rewritten(
    text: str, scene: Scene, configuration: Configuration, remarks: list[str], accepted: float | None = None
) -> str:
    """Return the text of a scene file with another configuration.

    Parameters
    ----------
    text : str
        Of the scene's file.
    scene : Scene
        Read from it.
    configuration : Configuration
        What it is to say: a step, so that a tolerance that would choose others goes.
    remarks : list of str
        Written as comments on top.
    accepted : float, optional
        What its sweeps may leave unsolved, as the error that was measured contains it; if absent, as the scene says.

    Raises
    ------
    RuntimeError
        If the new text does not say just that: a defect of tmm-gen.
    """
    changes = {**configuration.family.changes(scene), "integrator.step": configuration.step}
    expected = configuration.apply(scene)
    if accepted is not None:
        changes["model.unsolved"] = accepted
        expected = expected.replace(**{"model.unsolved": accepted})
    return _written(text, scene, configuration.family.integrator, changes, expected, remarks)


def with_tolerance(text: str, scene: Scene, family: Family, tolerance: float, remarks: list[str]) -> str:
    """Return the text of a scene file whose steps a tolerance chooses; arguments and errors as of :func:`rewritten`."""
    changes = changes_of(family, tolerance)
    return _written(text, scene, family.integrator, changes, scene.replace(**changes), remarks)


def _written(
    text: str,
    scene: Scene,
    integrator: str,
    changes: Mapping[str, object],
    expected: Scene,
    remarks: list[str],
) -> str:
    """Return a file's text with some keys changed, which are all that makes the expected scene of it."""
    import tomlkit

    document = tomlkit.parse(text)
    table: Any = document["integrator"]
    if underscored(integrator) != scene.integrator.name:
        for key in [key for key in table if key not in ("name", "step")]:
            del table[key]
    table.pop("tolerance", None)
    for key, value in changes.items():
        place, *part, name = key.split(".")
        if place not in document:
            document[place] = tomlkit.table()
        section: Any = document[place]
        if part:
            section = next(each for each in section if each["name"] == part[0])
        section[name] = value
    written = "".join(f"# {remark}\n" for remark in remarks) + "#\n" + tomlkit.dumps(document)
    if parse_scene(written, scene.source.origin) != expected:
        raise RuntimeError(f"{scene.source.origin}: the rewritten scene says something else")
    return written
