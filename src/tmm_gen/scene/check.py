"""From the data of a scene file to a scene, or to everything that is wrong with it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from pydantic import ValidationError

from tmm_gen.scene.complaints import findings
from tmm_gen.scene.document import Document
from tmm_gen.scene.locate import nearest_line
from tmm_gen.scene.parts.document import PartsDocument, document_class
from tmm_gen.scene.problem import Finding, Problem, SceneError, show_path
from tmm_gen.scene.rules import broken_part_rules, broken_rules
from tmm_gen.scene.rules.spatial import broken_spatial_rules
from tmm_gen.scene.scene import Scene, scene_of
from tmm_gen.scene.source import Source
from tmm_gen.scene.spatial.document import SpatialDocument


def check_data(source: Source) -> Scene:
    """Check a document and expand it.

    Parameters
    ----------
    source : Source
        The document with its lines.

    Returns
    -------
    Scene
        The scene.

    Raises
    ------
    SceneError
        With every fault found: first those of single tables, and where there is none, those between tables.
    """
    document = document_of(source)
    if isinstance(document, SpatialDocument):
        broken = broken_spatial_rules(document)
    elif isinstance(document, PartsDocument):
        broken = broken_part_rules(document)
    else:
        broken = broken_rules(document)
    if broken:
        raise _located(broken, source)
    return scene_of(document, source)


def document_of(source: Source) -> Document:
    """Return the tables of a file as they are written, each well formed.

    Raises
    ------
    SceneError
        With every fault of single tables.
    """
    kind = SpatialDocument if _in_space(source.data) else document_class(source.data)
    try:
        return kind.model_validate(source.data)
    except ValidationError as error:
        raise _located(findings(error, kind), source) from None


def _in_space(data: Mapping[str, object]) -> bool:
    model = data.get("model")
    return isinstance(model, dict) and model.get("kind") == "spatial"


def _located(found: Iterable[Finding], source: Source) -> SceneError:
    return SceneError(
        Problem(
            source.origin,
            nearest_line(source.lines, finding.path),
            show_path(finding.path),
            finding.value,
            finding.message,
            finding.remedy,
        )
        for finding in found
    )
