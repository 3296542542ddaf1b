"""A scene file with another configuration in it: changed where it must be, otherwise as the user wrote it."""

from __future__ import annotations

from typing import Any

from tmm_gen.scene import Scene, parse_scene
from tmm_gen.scene.integrator import underscored
from tmm_gen.study.configuration import Configuration


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
    import tomlkit

    document = tomlkit.parse(text)
    changes = {**configuration.family.changes(scene), "integrator.step": configuration.step}
    expected = configuration.apply(scene)
    if accepted is not None:
        changes["model.unsolved"] = accepted
        expected = expected.replace(**{"model.unsolved": accepted})
    table: Any = document["integrator"]
    if underscored(configuration.family.integrator) != scene.integrator.name:
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
