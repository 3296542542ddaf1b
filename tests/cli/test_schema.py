"""`tmm-gen schema`: by it a checker accepts every scene and marks what is wrong; new scenes point to it."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tmm_gen.cli import main
from tmm_gen.scene import load_scene
from tmm_gen.scene.reference import keys
from tmm_gen.scene.schema import SCHEMA_FILE, scene_schema

ROOT = Path(__file__).resolve().parents[2]
SCENES = sorted([*ROOT.glob("scenes/*.toml"), *ROOT.glob("examples/space/*.toml")])


@pytest.fixture(scope="module")
def taplo() -> str:
    found = shutil.which("taplo") or shutil.which("taplo", path=str(Path(sys.executable).parent))
    if found is None:
        if os.environ.get("CI"):
            pytest.fail("taplo not found: pip install taplo")
        pytest.skip("taplo not found: pip install taplo")
    return found


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with the schema in it."""
    assert main(["schema", "--out", str(tmp_path / SCHEMA_FILE)]) == 0
    return tmp_path


def checked(taplo: str, folder: Path, *files: Path) -> subprocess.CompletedProcess[str]:
    schema = (folder / SCHEMA_FILE).as_uri()
    command = [taplo, "check", "--no-auto-config", "--schema", schema, *map(str, files)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_every_scene_and_every_template_is_accepted(taplo: str, folder: Path) -> None:
    kinds: list[list[str]] = [["--kind", kind] for kind in ("chain", "planar", "spatial")]
    kinds += [["--kind", "planar", "--motors", "2"], ["--kind", "planar", "--control"]]
    for number, words in enumerate(kinds):
        assert main(["new", f"arm{number}", *words, "--out", str(folder)]) == 0
        first, _, _ = (folder / f"arm{number}.toml").read_text().partition("\n")
        assert first == f"#:schema {SCHEMA_FILE}"
        assert load_scene(folder / f"arm{number}.toml").name == f"arm{number}"
    done = checked(taplo, folder, *SCENES, *folder.glob("*.toml"))
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    ("scene", "old", "new", "said"),
    [
        ("elbow", "rotor_inertia =", "rotor_inertla =", "'rotor_inertla' was unexpected"),
        ("arm10", "length = 1.0", "length = -1.0", "is not valid"),
        ("arm10", "beta = 0.25", "betta = 0.25", "'betta' was unexpected"),
        ("thesis10", 'kind = "clamp"', 'kind = "clam"', "clam"),
        ("geartrain", "ratio = ", "ration = ", "'ration' was unexpected"),
    ],
)
def test_what_is_wrong_is_marked(scene: str, old: str, new: str, said: str, taplo: str, folder: Path) -> None:
    text = (ROOT / "scenes" / f"{scene}.toml").read_text()
    assert old in text
    (folder / "bad.toml").write_text(text.replace(old, new, 1))
    done = checked(taplo, folder, folder / "bad.toml")
    assert done.returncode == 1
    assert said in done.stderr


def test_the_schema_has_every_key_and_none_that_is_hidden(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["schema"]) == 0
    schema = json.loads(capsys.readouterr().out)
    assert schema == json.loads(json.dumps(scene_schema()))
    found: set[str] = set()
    hidden: list[Any] = []

    def visit(value: Any) -> None:
        for each in value.values() if isinstance(value, dict) else value if isinstance(value, list) else ():
            visit(each)
        if isinstance(value, dict) and isinstance(value.get("properties"), dict):
            found.update(value["properties"])
            hidden.extend(field for field in value["properties"].values() if field.get("hidden"))

    visit(schema)
    assert {key.key for key in keys() if key.key.isidentifier()} <= found
    assert not hidden


def test_without_a_schema_beside_it_a_new_scene_points_nowhere(tmp_path: Path) -> None:
    assert main(["new", "arm", "--out", str(tmp_path)]) == 0
    assert "#:schema" not in (tmp_path / "arm.toml").read_text()
