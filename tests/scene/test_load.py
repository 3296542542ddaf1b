"""Files that cannot be read, texts that cannot be parsed, and texts nobody would write."""

from __future__ import annotations

import pickle
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tmm_gen.scene import Problem, SceneError, load_scene, parse_scene


def only_problem(path: Path) -> Problem:
    with pytest.raises(SceneError) as caught:
        load_scene(path)
    (problem,) = caught.value.problems
    assert problem.file == str(path)
    return problem


def test_missing_file_suggests_a_similar_one(tmp_path: Path, chain: str) -> None:
    (tmp_path / "arm10.toml").write_text(chain)
    problem = only_problem(tmp_path / "arm1.toml")
    assert problem.message == "no such file"
    assert problem.remedy == f"Did you mean '{tmp_path / 'arm10.toml'}'?"
    assert str(problem).startswith(f"{problem.file}: no such file. ")


def test_missing_file_suggests_to_make_one(tmp_path: Path) -> None:
    assert "tmm-gen new arm" in only_problem(tmp_path / "nowhere" / "arm.toml").remedy


def test_directory(tmp_path: Path) -> None:
    assert only_problem(tmp_path).message == "is a directory"


def test_path_through_a_file(tmp_path: Path, chain: str) -> None:
    (tmp_path / "arm.toml").write_text(chain)
    assert only_problem(tmp_path / "arm.toml" / "arm.toml").message.startswith("cannot be read")


def test_path_with_a_null_byte() -> None:
    assert only_problem(Path("arm\0.toml")).message.startswith("cannot be read")


def test_not_utf8(tmp_path: Path, chain: str) -> None:
    path = tmp_path / "arm.toml"
    path.write_bytes(chain.replace("An arm", "Ein Ärmchen").encode("latin-1"))
    problem = only_problem(path)
    assert (problem.line, problem.remedy) == (2, "Save the file as UTF-8.")
    assert "0xC4" in problem.message


@pytest.mark.parametrize("text", ["", "# nothing\n"])
def test_empty_file_names_all_required_tables(text: str) -> None:
    with pytest.raises(SceneError) as caught:
        parse_scene(text)
    assert [problem.key for problem in caught.value.problems] == ["name", "model", "integrator", "base"]


def test_byte_order_mark_and_windows_line_ends_are_accepted(tmp_path: Path, chain: str) -> None:
    path = tmp_path / "arm.toml"
    path.write_bytes(b"\xef\xbb\xbf" + chain.replace("\n", "\r\n").encode())
    assert load_scene(path) == parse_scene(chain)


def test_str_and_path_are_alike(tmp_path: Path, chain: str) -> None:
    path = tmp_path / "arm.toml"
    path.write_text(chain)
    assert load_scene(str(path)) == load_scene(path)


@pytest.mark.parametrize("text", ["x = " + "[" * 100_000, "x = " + "[" * 300 + "]" * 300])
def test_deep_nesting_is_an_error_not_a_crash(text: str) -> None:
    with pytest.raises(SceneError):
        parse_scene(text)


def test_error_is_one_line_per_problem_and_survives_pickling(chain: str) -> None:
    with pytest.raises(SceneError) as caught:
        parse_scene(chain.replace("20.0", "-1").replace("[output]", "[outputs]", 1), "arm.toml")
    error = caught.value
    assert len(error.problems) == len(str(error).splitlines()) == 2
    again = pickle.loads(pickle.dumps(error))
    assert again.problems == error.problems
    assert str(again) == str(error)


@settings(max_examples=400)
@given(data=st.data())
def test_damaged_scenes_give_a_scene_or_a_located_complaint(
    chain: str, planar: str, data: st.DataObject
) -> None:
    lines = data.draw(st.sampled_from([chain, planar])).splitlines()
    for _ in range(data.draw(st.integers(1, 3))):
        index = data.draw(st.integers(0, len(lines) - 1))
        junk = st.sampled_from(
            ["[", "]]", "=", '"', "{", "[tip]", "[[link]]", "x.y = 1", "kind.a = []", "[a.b]", "-"]
        )
        damage = data.draw(st.sampled_from(["drop", "double", "insert", "cut", "move", "value"]))
        if damage == "drop" and len(lines) > 1:
            del lines[index]
        elif damage == "double":
            lines.insert(index, lines[index])
        elif damage == "insert":
            lines.insert(index, data.draw(junk))
        elif damage == "cut":
            lines[index] = lines[index][: data.draw(st.integers(0, len(lines[index])))]
        elif damage == "move":
            lines.insert(data.draw(st.integers(0, len(lines) - 1)), lines.pop(index))
        elif "=" in lines[index]:
            values = [
                "0",
                "-1",
                "nan",
                "1e308",
                "true",
                '""',
                "[]",
                "[[]]",
                "{}",
                "[{}]",
                "2024-01-01",
                '"tip"',
                "9" * 99,
            ]
            lines[index] = f"{lines[index].split('=')[0]}= {data.draw(st.sampled_from(values))}"
    for problem in complaints("\n".join(lines)):
        assert 1 <= problem.line <= len(lines)
        assert problem.message
        assert problem.remedy.endswith((".", "?"))
        assert "\n" not in str(problem)


def complaints(text: str) -> tuple[Problem, ...]:
    """Return what is wrong with a text, nothing if it is a scene."""
    try:
        parse_scene(text, "arm.toml")
    except SceneError as error:
        return error.problems
    return ()
