"""`tmm-gen build` as users meet it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from tmm_gen.cli import main
from tmm_gen.scene import Scene

SCENE = """\
name = "{name}"
[model]
kind = "chain"
[integrator]
name = "newmark"
step = 0.01
[base]
kind = "clamp"
[[joint]]
stiffness = {stiffness}
[[link]]
inertia = 1.0
[[input]]
name = "push"
at = "tip"
acts = "torque"
[[output]]
name = "tip"
at = "tip"
of = "angle"
"""


def scene(name: str, stiffness: float = 2.0) -> str:
    return SCENE.format(name=name, stiffness=stiffness)


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with two scenes, and a cache of its own."""
    (tmp_path / "scenes").mkdir()
    for name in ("arm", "beam"):
        (tmp_path / "scenes" / f"{name}.toml").write_text(scene(name))
    monkeypatch.setenv("TMM_GEN_CACHE", str(tmp_path / "cache"))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def rows(capsys: pytest.CaptureFixture[str]) -> dict[str, dict[str, object]]:
    return {row["scene"]: row for row in json.loads(capsys.readouterr().out)["rows"]}


def tree(folder: Path) -> dict[str, bytes]:
    files = [path for path in folder.rglob("*") if path.is_file() and "__pycache__" not in path.parts]
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


def test_all_scenes_are_built_by_default(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["build", "--json"]) == 0
    found = rows(capsys)
    assert {name: row["state"] for name, row in found.items()} == {"arm": "built", "beam": "built"}
    assert found["arm"]["folder"] == "generated/arm"
    assert {"__init__.py", "kernel.py", "casadi_model.py", "c/arm.h", "c/arm.c"} <= set(
        found["arm"]["written"]
    )  # type: ignore[call-overload]
    assert sorted(path.name for path in (place / "generated").iterdir()) == ["arm", "beam"]
    assert main(["build", "--json"]) == 0
    again = rows(capsys)
    assert {row["state"] for row in again.values()} == {"up to date"}
    assert sorted(again["arm"]["unchanged"]) == sorted(found["arm"]["written"])  # type: ignore[call-overload]


@pytest.mark.parametrize("word", ["arm", "scenes/arm.toml"])
def test_a_scene_is_named_by_name_or_file(place: Path, word: str) -> None:
    assert main(["build", word, "--out", "here/below"]) == 0
    assert sorted(path.name for path in (place / "here" / "below").iterdir()) == ["arm"]


def test_the_package_runs(place: Path) -> None:
    assert main(["build", "arm"]) == 0
    program = "import arm; print(arm.simulate(1.0, {'push': 1.0}).outputs['tip'][-1], arm.__file__)"
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=place / "generated", capture_output=True, text=True, check=True
    )
    assert 0.2 < float(done.stdout.split()[0]) < 0.5  # (1 - cos(sqrt(2))) / 2 is 0.42


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["armm"], "no scene 'armm' in scenes/. Did you mean 'arm'?"),
        (["zzz"], "no scene 'zzz' in scenes/. Name a *.toml file, or one of: arm, beam."),
        (["nowhere.toml"], "nowhere.toml: "),
    ],
)
def test_an_unknown_scene_is_told(
    place: Path, capsys: pytest.CaptureFixture[str], words: list[str], said: str
) -> None:
    assert main(["build", *words]) == 2
    assert said in capsys.readouterr().err
    assert not (place / "generated").exists()


def test_no_scenes_at_all_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["build"]) == 2
    assert "no scene: scenes/ holds no *.toml here. Name a file, or make one by" in capsys.readouterr().err


def test_two_scenes_of_one_name_are_told(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (place / "scenes" / "zoo.toml").write_text(scene("arm", 3.0))
    assert main(["build"]) == 2
    assert "zoo.toml: has the name 'arm', as scenes/arm.toml has" in capsys.readouterr().err
    assert not (place / "generated").exists()


def test_a_bad_scene_stops_all_before_anything_is_written(
    place: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (place / "scenes" / "beam.toml").write_text(scene("beam", -1.0))
    assert main(["build"]) == 2
    assert "beam.toml:10: joint[1].stiffness" in capsys.readouterr().err
    assert not (place / "generated").exists()


def test_check_shows_the_difference_and_writes_nothing(
    place: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["build"]) == 0
    assert main(["build", "--check"]) == 0
    (place / "scenes" / "arm.toml").write_text(scene("arm", 4.0))
    before = tree(place / "generated")
    capsys.readouterr()
    assert main(["build", "--check"]) == 1
    shown = capsys.readouterr()
    assert "-    stiffness: ArrayLike = 2.0" in shown.out.splitlines()
    assert "+    stiffness: ArrayLike = 4.0" in shown.out.splitlines()
    assert "error: generated/ is not what the scenes give: arm. Run `tmm-gen build`." in shown.err
    assert tree(place / "generated") == before
    assert main(["build", "--check", "--json", "arm"]) == 1
    assert rows(capsys)["arm"]["state"] == "drift"
    assert main(["build"]) == 0
    assert main(["build", "--check"]) == 0


def test_check_does_not_trust_the_cache(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["build", "arm"]) == 0
    for entry in (place / "cache" / "build").iterdir():
        kernel = place / "generated" / "arm" / "kernel.py"
        kernel.write_text(kernel.read_text().replace("2.0", "7.0"))
        import hashlib

        known = json.loads(entry.read_text().partition("\n")[2])
        body = json.dumps({**known, "kernel.py": hashlib.sha256(kernel.read_bytes()).hexdigest()})
        seal = hashlib.sha256(f"{entry.name}\n{body}".encode()).hexdigest()
        entry.write_text(f"{seal}\n{body}")
    capsys.readouterr()
    assert main(["build", "--check", "arm"]) == 1


def test_check_of_what_was_never_built_is_all_difference(
    place: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["build", "--check", "arm"]) == 1
    shown = capsys.readouterr().out
    assert "--- /dev/null" in shown
    assert "+++ generated/arm/kernel.py" in shown
    assert not (place / "generated").exists()


def test_an_edit_by_hand_is_kept_unless_forced(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["build"]) == 0
    kernel = place / "generated" / "arm" / "kernel.py"
    edited = kernel.read_text() + "# mine\n"
    kernel.write_text(edited)
    capsys.readouterr()
    assert main(["build"]) == 2
    said = capsys.readouterr().err
    assert "generated/arm/kernel.py: was edited by hand since tmm-gen wrote it" in said
    assert "--force" in said
    assert kernel.read_text() == edited
    assert main(["build", "--force"]) == 0
    assert not kernel.read_text().endswith("# mine\n")


def test_files_no_longer_made_are_reported_and_removed(
    place: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["build", "arm"]) == 0
    (place / "scenes" / "arm.toml").write_text(scene("arm") + '[emit]\nbackends = ["numpy"]\n')
    capsys.readouterr()
    assert main(["build", "arm", "--check"]) == 1
    assert "+++ /dev/null" in capsys.readouterr().out
    assert main(["build", "arm", "--json"]) == 0
    assert "casadi_model.py" in rows(capsys)["arm"]["removed"]  # type: ignore[operator]
    assert set(tree(place / "generated" / "arm")) == {"__init__.py", "kernel.py"}


def test_a_missing_file_is_written_again(place: Path) -> None:
    assert main(["build", "arm"]) == 0
    before = tree(place / "generated")
    (place / "generated" / "arm" / "kernel.py").unlink()
    assert main(["build", "arm"]) == 0
    assert tree(place / "generated") == before


HEAVY = [
    *("sympy", "numpy", "casadi", "scipy", "jinja2", "matplotlib"),
    *("pydantic", "importlib.metadata", "tmm_gen.scene"),
]
"""Models that check scenes take twice as long to import as all that a build with nothing to do takes."""


def imported(place: Path, words: list[str]) -> str:
    program = (
        "import sys\nfrom tmm_gen.cli import main\n"
        f"assert main({words!r}) == 0\n"
        f"print('imported:', *[name for name in {HEAVY!r} if name in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=place, capture_output=True, text=True, check=True
    )
    return done.stdout.splitlines()[-1]


def test_a_build_with_nothing_to_do_imports_nothing_heavy(place: Path) -> None:
    assert "sympy" in imported(place, ["build"])
    assert imported(place, ["build"]) == "imported:"


@pytest.fixture
def derived(place: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Build a scene; return the names of those that are derived from then on."""
    from tmm_gen.package import texts

    emit, found = texts.emit_package, list[str]()

    def emitted(scene: Scene) -> dict[str, str]:
        found.append(scene.name)
        return emit(scene)

    monkeypatch.setattr(texts, "emit_package", emitted)
    assert main(["build", "arm"]) == 0
    assert found == ["arm"]
    found.clear()
    return found


CHANGES = (
    "a source",
    "a template",
    "sympy",
    "pydantic",
    "python",
    "damage",
    "others may write",
    "entries swapped",
)


@pytest.mark.parametrize("change", CHANGES)
def test_the_cache_forgets(
    place: Path, monkeypatch: pytest.MonkeyPatch, derived: list[str], change: str
) -> None:
    """Whatever decides what a build gives changes, or an entry cannot be believed: it is derived again."""
    assert main(["build", "arm"]) == 0
    assert derived == []
    forget(place, monkeypatch, change)
    try:
        assert main(["build", "arm"]) == 0
        assert derived == ["arm"]
        assert main(["build", "arm"]) == 0
        assert derived == ["arm"]
    finally:
        forget_digests()


def forget(place: Path, monkeypatch: pytest.MonkeyPatch, change: str) -> None:
    """Change what entries are kept by, or all entries."""
    from tmm_gen.package import generator

    entries = sorted((place / "cache").rglob("*.json"))
    assert [entry.parent.name for entry in entries] == ["build", "scene"]
    told = [entry.read_text() for entry in entries]
    known = generator.release
    match change:
        case "a source":
            (place / "tmm_gen" / "package").mkdir(parents=True)
            monkeypatch.setattr(generator, "__file__", str(place / "tmm_gen" / "package" / "generator.py"))
        case "a template":
            monkeypatch.setattr(generator, "templates_dir", lambda: place / "scenes")
        case "sympy" | "pydantic":
            monkeypatch.setattr(generator, "release", lambda name: "0" if name == change else known(name))
        case "python":
            monkeypatch.setattr(sys, "version", "3.99.0")
        case "damage":
            for entry, text in zip(entries, told, strict=True):
                entry.write_text(text.replace("arm", "mra").replace("kernel", "lenrek"))
        case "others may write":
            for entry in entries:
                entry.chmod(0o666)
        case _:
            for entry, text in zip(entries, reversed(told), strict=True):
                entry.write_text(text)
    forget_digests()


def forget_digests() -> None:
    """As a new process does."""
    from tmm_gen.package import generator

    generator.generator_digest.cache_clear()
    generator.installed_digest.cache_clear()


def test_a_changed_scene_is_derived_and_the_former_known_again(place: Path, derived: list[str]) -> None:
    file, package = place / "scenes" / "arm.toml", place / "generated" / "arm"
    before = tree(package)
    file.write_text(scene("arm", 2.5))
    assert main(["build", "arm"]) == 0
    assert derived == ["arm"]
    assert tree(package) != before
    file.write_text(scene("arm"))
    assert main(["build", "arm"]) == 0  # its texts are known by their hashes alone
    assert derived == ["arm", "arm"]
    assert tree(package) == before
    file.write_text(scene("arm") + "# another spelling of the same scene\n")
    assert main(["build", "arm"]) == 0
    assert derived == ["arm", "arm"]


def test_what_python_changed_is_not_taken_for_the_file(place: Path, derived: list[str]) -> None:
    import tmm_gen as tg

    before = tree(place / "generated")
    (place / "scenes" / "arm.toml").write_text(scene("arm", 2.5))
    tg.load("scenes/arm.toml").with_(joint__1__stiffness=3.5).build()
    changed = tree(place / "generated")
    assert main(["build", "arm"]) == 0
    assert derived == ["arm", "arm"]
    assert tree(place / "generated") not in (before, changed)


def test_a_cache_that_cannot_be_written_is_no_error(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (place / "file").write_text("")
    monkeypatch.setenv("TMM_GEN_CACHE", str(place / "file"))
    assert main(["build", "arm"]) == 0
    assert main(["build", "arm"]) == 0


def test_text_does_not_depend_on_the_seed_of_hashes(
    place: Path, tmm_gen: Callable[..., subprocess.CompletedProcess[str]]
) -> None:
    scenes = Path(__file__).resolve().parents[2] / "scenes"
    (place / "scenes" / "drivetrain.toml").write_text((scenes / "drivetrain.toml").read_text())
    # what derivatives keep of a variable is called like it: the order of the two is none of names alone
    arm2 = (scenes / "arm2.toml").read_text().partition("[emit]")[0]
    emit = '[emit]\nbackends = ["casadi"]\nsensitivities = true\n'
    (place / "scenes" / "arm2.toml").write_text(arm2 + emit)
    trees = []
    for seed in ("0", "12345"):
        done = tmm_gen("build", "--out", seed, env={"PYTHONHASHSEED": seed, "TMM_GEN_CACHE": os.devnull})
        assert done.returncode == 0, done.stderr
        trees.append(tree(place / seed))
    assert trees[0] == trees[1]
    assert len(trees[0]) >= 3 * 7
