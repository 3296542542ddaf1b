"""The list of all keys: complete, and what it gives as examples is accepted."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tmm_gen.cli import main
from tmm_gen.scene import parse_scene
from tmm_gen.scene.integrator import METHODS
from tmm_gen.scene.parts.document import PartsDocument
from tmm_gen.scene.reference import keys, markdown

PAGE = Path(__file__).resolve().parents[2] / "docs" / "scene.md"


def test_the_page_lists_every_key() -> None:
    listed = PAGE.read_text().partition("## Every key\n\n")[2]
    assert listed == markdown(), "renew the end of docs/scene.md with: tmm-gen keys --markdown"


def test_the_example_is_a_scene() -> None:
    example = PAGE.read_text().partition("```toml\n")[2].partition("```")[0]
    assert parse_scene(example).stations == 1


def test_every_table_and_parameter_is_there() -> None:
    found = {(key.table.partition(" ")[0].strip("[]"), key.key) for key in keys()}
    tables = {table.split(".")[0] for table, _ in found} | {key for table, key in found if not table}
    assert tables - {""} == set(PartsDocument.model_fields)
    assert not any(key.key == "mass" and key.table == "[[link]] by name in a chain" for key in keys())
    assert {("motor", "stiffness"), ("beam.material", "young"), ("beam.section", "thickness")} <= found
    assert {p.name for m in METHODS for p in m.parameters} <= {key for t, key in found if t == "integrator"}


def test_what_must_be_there_and_what_is_not_modelled() -> None:
    by_name = {(key.table, key.key): key for key in keys()}
    assert by_name["[beam]", "length"].default is None
    assert by_name["[model]", "gravity"].default == ""
    assert by_name["[[link]]", "mass"].default == ""
    assert by_name["[model]", "iterations"].default == '"auto"'
    assert by_name["[model]", "unsolved"].default == "follows the step's own error"
    assert by_name["[base]", "inertia"].value == "number from 0"
    assert by_name["[base]", "kind"].value == '"clamp", "motor", "prescribed", "free"'
    assert by_name["[emit]", "batch"].value == "4, 8, 16"
    assert '"sdirk4"' in by_name["[integrator]", "name"].value


def test_one_table_on_the_command_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["keys", "[beam]", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["rows"]
    assert {row["table"] for row in rows} == {"[beam]"}
    assert {row["key"] for row in rows} >= {"length", "links", "springs"}
    assert main(["keys"]) == 0
    assert "must be there" in capsys.readouterr().out


def test_an_unknown_table_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["keys", "beem"]) == 2
    assert "choose from model, integrator" in capsys.readouterr().err
