"""Every option that names a file to write, against every place where nothing must be written."""

from __future__ import annotations

import os
import socket
import stat
from collections.abc import Callable, Iterator
from pathlib import Path

import click
import pytest

from tmm_gen.cli import COMMANDS, main
from tmm_gen.cli.outputs import OutputFile, claim, write_outputs
from tmm_gen.errors import UserError

SCENES = Path(__file__).resolve().parents[2] / "scenes"
PLANAR, CHAIN = str(SCENES / "swing.toml"), str(SCENES / "thesis2.toml")
URDF = str(SCENES.parent / "examples" / "urdf" / "picker.urdf")

FILES: dict[tuple[str, str], tuple[list[str], str]] = {
    ("run", "--csv"): ([CHAIN], ".csv"),
    ("run", "--plot"): ([CHAIN], ".png"),
    ("run", "--animate"): ([PLANAR], ".gif"),
    ("rest", "--plot"): ([PLANAR], ".svg"),
    ("modes", "--plot"): ([CHAIN], ".svg"),
    ("frequency", "--csv"): ([CHAIN], ".csv"),
    ("frequency", "--plot"): ([CHAIN], ".pdf"),
    ("stability", "--plot"): ([CHAIN], ".png"),
    ("trade", "--csv"): ([CHAIN], ".csv"),
    ("trade", "--plot"): ([CHAIN], ".png"),
    ("trade", "--report"): ([CHAIN], ".html"),
    ("tune", "--out"): ([CHAIN, "--max-error", "1e-2", "--max-time", "1ms"], ".toml"),
    ("export", "--out"): ([CHAIN, "--to", "fmu"], ".fmu"),
    ("import", "--out"): ([URDF], ".toml"),
    ("calibrate", "--out"): ([CHAIN, "record.csv"], ".toml"),
    ("playground", "--out"): ([PLANAR], ".html"),
    ("schema", "--out"): ([], ".json"),
    ("mpc", "--plot"): ([PLANAR], ".png"),
    ("mpc", "--animate"): ([PLANAR], ".html"),
    ("mpc", "--out"): ([PLANAR, "--tune"], ".toml"),
}
"""Options of files, with the words that go before and an ending."""
FOLDERS: dict[tuple[str, str], list[str]] = {
    ("build", "--out"): [CHAIN],
    ("new", "--out"): ["arm"],
    ("demo", "--out"): [],
    ("mpc", "--emit"): [PLANAR],
}
READ = {("trade", "--store"), ("import", "--flex")}
"""A data base, which is opened, not replaced; a file that is only read."""


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def _options(name: str) -> Iterator[str]:
    for parameter in COMMANDS[name].load().params:
        path = isinstance(parameter, click.Option) and isinstance(parameter.type, click.Path)
        if path or parameter.opts[0] in ("--plot", "--report"):
            yield parameter.opts[0]


def test_the_table_above_has_every_option_that_names_a_file() -> None:
    found = {(name, option) for name in COMMANDS for option in _options(name)}
    assert found == {*FILES, *FOLDERS, *READ}


def _device(path: Path) -> None:
    path.symlink_to("/dev/null")


def _pipe(path: Path) -> None:
    os.mkfifo(path)


def _socket(path: Path) -> None:
    with socket.socket(socket.AF_UNIX) as made:
        made.bind(path.name)


def _folder(path: Path) -> None:
    path.mkdir()


def _circle(path: Path) -> None:
    path.symlink_to(path.name)


@pytest.mark.parametrize("make", [_device, _pipe, _socket, _folder, _circle], ids=lambda made: made.__name__)
@pytest.mark.parametrize(("command", "option"), FILES)
def test_what_is_no_file_is_told_before_the_work_and_left_alone(
    command: str,
    option: str,
    make: Callable[[Path], None],
    place: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    words, ending = FILES[command, option]
    target = place / f"out{ending}"
    make(target)
    before = target.lstat()
    assert main([command, *words, option, target.name]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert target.name in said
    assert "tmm-gen-" not in said  # no internal name
    assert stat.S_IFMT(target.lstat().st_mode) == stat.S_IFMT(before.st_mode)
    assert [item.name for item in place.iterdir()] == [target.name]


@pytest.mark.parametrize("where", ["/proc/out", "/sys/out", "record/out", ""])
@pytest.mark.parametrize(("command", "option"), FILES)
def test_where_no_file_can_be_is_told_on_one_line(
    command: str, option: str, where: str, place: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words, ending = FILES[command, option]
    (place / "record").write_text("a file")
    target = f"{where}{ending}" if where else where
    if (command, option) in {("run", "--csv"), ("run", "--plot"), ("modes", "--plot")} or not os.access(
        "/proc", os.W_OK
    ):
        assert main([command, *words, option, target]) == 2  # these get as far as writing, and quickly
        said = capsys.readouterr().err
    elif where in ("/proc/out", "/sys/out"):
        with pytest.raises(OSError, match=where):  # what the longer ones meet at their end
            write_outputs({Path(target): b"x"})
        return
    else:
        assert main([command, *words, option, target]) == 2
        said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "Traceback" not in said
    assert "tmm-gen-" not in said


@pytest.mark.parametrize(("command", "option"), FOLDERS)
def test_a_folder_that_is_a_file_is_told(
    command: str, option: str, place: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (place / "taken").write_text("precious")
    assert main([command, *FOLDERS[command, option], option, "taken"]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert (place / "taken").read_text() == "precious"


@pytest.mark.parametrize(
    ("name", "new"),
    [
        ("a.csv", b"time,tip\n0,1\n"),
        ("a.png", b"\x89PNG new"),
        ("a.svg", b"<?xml " + b"x" * 70),
        ("a.gif", b"GIF89a"),
    ],
)
def test_only_former_results_are_replaced(place: Path, name: str, new: bytes) -> None:
    target = place / name
    target.write_bytes(b"somebody's notes\n")
    with pytest.raises(UserError, match="is there and no"):
        write_outputs({target: new})
    assert target.read_bytes() == b"somebody's notes\n"
    target.write_bytes(new + b"1,2\n")
    write_outputs({target: new})
    assert target.read_bytes() == new


def test_scenes_and_sources_are_replaced_by_force_only(place: Path) -> None:
    target = place / "a.toml"
    target.write_text("mine")
    with pytest.raises(UserError, match="--force"):
        write_outputs({target: "new"}, force=False)
    write_outputs({target: "mine"}, force=False)
    write_outputs({target: "new"}, force=True)
    assert target.read_text() == "new"


def test_nothing_is_written_twice_or_over_what_is_read(place: Path) -> None:
    (place / "in.csv").write_text("time,u\n")
    (place / "link.csv").symlink_to("in.csv")
    with pytest.raises(UserError, match="is read by this command"):
        claim((Path("link.csv"),), (Path("in.csv"),))
    with pytest.raises(UserError, match="is to be written twice"):
        claim((Path("a.csv"), None, Path("./a.csv")))


def test_a_folder_that_is_made_is_said(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_outputs({place / "a" / "b" / "c.csv": "time\n"})
    assert capsys.readouterr().out == f"made the folder {place / 'a'}\n"


def test_endings_are_checked() -> None:
    with pytest.raises(click.BadParameter, match=r"must end in \.gif"):
        OutputFile(".gif").convert("a.png", None, None)


@pytest.mark.parametrize("make", [_device, _pipe, _socket, _folder, _circle], ids=lambda made: made.__name__)
@pytest.mark.parametrize(
    "words",
    [
        ["run", "it"], ["build", "it"], ["modes", "it"], ["explain", "it"], ["run", CHAIN, "--input", "it"],
        ["run", CHAIN, "--input", "tip_torque=it"], ["calibrate", CHAIN, "it"],
    ],
    ids=" ".join,
)  # fmt: skip
def test_inputs_that_are_no_files_are_told(
    words: list[str], make: Callable[[Path], None], place: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    name = "it.csv" if "--input" in words or words[0] == "calibrate" else "it.toml"
    make(place / name)
    assert main([word.replace("it", name) if word.endswith(("it", "=it")) else word for word in words]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert name in said


CONTENTS = [b"\xff\xfe\x00", b"\x00" * 100, b"", b"time", b"a,b\n1,2\n", b"time,tip_torque\n" * 3]
READERS = [["run", CHAIN, "--input", "it.csv"], ["calibrate", CHAIN, "it.csv"], ["run", "it.csv"]]


@pytest.mark.parametrize("content", CONTENTS)
@pytest.mark.parametrize("words", READERS)
def test_contents_that_are_none_are_told(
    words: list[str], content: bytes, place: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (place / "it.csv").write_bytes(content)
    assert main(words) == 2
    said = capsys.readouterr().err
    assert said
    assert "it.csv" in said.splitlines()[0]


def test_a_huge_file_is_not_read(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("it.toml", "it.csv"):
        with (place / name).open("wb") as file:
            file.truncate(2**40)  # sparse
    assert main(["run", "it.toml"]) == 2
    assert "is larger than" in capsys.readouterr().err
    assert main(["run", CHAIN, "--input", "it.csv"]) == 2
    assert "is larger than" in capsys.readouterr().err
