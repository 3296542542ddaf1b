"""Damage caches and end runs at random: is anything loaded that is not whole, anything left half written?

    .venv/bin/python benchmarks/damage.py --caches 200 --kills 60

Exits with 1 if anything went wrong.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from tmm_gen.resources import scenes_dir

_RUN = [
    "run",
    str(scenes_dir() / "thesis2.toml"),
    "--until",
    "1",
    "--input",
    "tip_torque=1",
    "--csv",
    "out.csv",
]
_KINDS = (
    "truncated",
    "emptied",
    "bit",
    "zeros",
    "longer",
    "folder",
    "pipe",
    "link",
    "open",
    "other user",
    "swapped",
)
_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGKILL)


def main() -> int:
    """Try, and print what came out."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--caches", type=int, default=200, help="entries of caches to damage")
    parser.add_argument("--kills", type=int, default=60, help="runs to end")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    draw = random.Random(options.seed)
    counts = _Told()
    with tempfile.TemporaryDirectory() as folder:
        here = Path(folder)
        _caches(here, options.caches, draw, counts)
        _kills(here, options.kills, draw, counts)
    for what, count in sorted(counts.items()):
        print(f"{count:6}  {what}")
    return int(any(what.startswith("WRONG") for what in counts))


class _Told(Counter[str]):
    """Counts that are told as they come: such a run is long, and may be ended."""

    def __setitem__(self, what: str, count: int) -> None:
        super().__setitem__(what, count)
        print(what, file=sys.stderr, flush=True)


def _caches(here: Path, tries: int, draw: random.Random, counts: Counter[str]) -> None:
    """Damage the library of a kernel, or the record of a build; the next run is to give the same result."""
    for words in ([*_RUN, "--backend", "c"], ["build", str(scenes_dir() / "thesis2.toml"), "--out", "made"]):
        _call(here, words)
        right = _result(here)
        for _ in range(tries // 2):
            entries = [p for p in (here / "cache").rglob("*") if p.suffix in (".so", ".json") and p.is_file()]
            entry = draw.choice([p for p in entries if (p.suffix == ".so") == (words[0] == "run")])
            kind = draw.choice(_KINDS)
            _damage(entry, kind, draw)
            _forget(here, words)
            done = _call(here, words)
            good = done.returncode == 0 and "Traceback" not in done.stderr and _result(here) == right
            counts[
                f"cache of {words[0]}, {kind}: right" if good else f"WRONG cache {kind}: {done.stderr[-200:]}"
            ] += 1


def _damage(path: Path, kind: str, draw: random.Random) -> None:
    content = bytearray(path.read_bytes())
    if kind in ("folder", "pipe", "link"):
        path.unlink()
        if kind == "folder":
            path.mkdir()
        elif kind == "pipe":
            os.mkfifo(path)
        else:
            path.symlink_to("/dev/zero")
    elif kind == "open":
        path.chmod(0o777)
    elif kind == "other user":
        if os.geteuid() == 0:
            os.chown(path, 12345, 12345)
    elif kind == "swapped":
        path.write_bytes(bytes(reversed(content)))
    else:
        at = draw.randrange(len(content))
        content[at] ^= 1 << draw.randrange(8)
        size = len(content)
        changed = {
            "truncated": content[:at],
            "emptied": b"",
            "zeros": bytes(size),
            "longer": content + b"\0" * 64,
        }
        path.write_bytes(bytes(changed.get(kind, content)))


def _kills(here: Path, tries: int, draw: random.Random, counts: Counter[str]) -> None:
    """End a command at a random time; what it writes is whole or as before, and the next leaves no scratch."""
    commands = (
        [*_RUN, "--backend", "c"],
        ["build", str(scenes_dir() / "arm2.toml"), "--out", "made"],
        ["check", str(scenes_dir() / "thesis2.toml")],
    )
    shutil.rmtree(here / "made", ignore_errors=True)  # of the caches: nothing here makes it anew
    for words in commands:
        began = time.monotonic()
        _call(here, words)
        took = time.monotonic() - began
        right = _result(here)
        for _ in range(tries // len(commands)):
            number = draw.choice(_SIGNALS)
            _forget(here, words)
            process = _start(here, words)
            time.sleep(draw.uniform(0.0, took))
            process.send_signal(number)
            _, said = process.communicate()
            name = f"{words[0]}, {signal.Signals(number).name}"
            fault = _fault(process.returncode, said, number) or _half(here, right)
            again = _call(here, words)
            if again.returncode != 0 or _result(here) != right:
                fault = fault or f"next run: {again.stderr[-200:]}"
            left = [p for place in (here, here / "tmp") for p in place.rglob(".tmm-gen-*") if p.exists()]
            if left:
                fault = fault or f"left {left[0]}"
            counts[f"WRONG {name}: {fault}" if fault else f"{name}: nothing half written, nothing left"] += 1


def _forget(here: Path, words: list[str]) -> None:
    """Make the command write anew."""
    written = {"run": [here / "out.csv"], "build": list((here / "made").rglob("*.c"))}
    for path in written.get(words[0], []):
        path.unlink(missing_ok=True)


def _fault(code: int, said: str, number: int) -> str:
    # before Python has started and after it has finished, signals have their usual effect
    usual = {signal.SIGINT: 130, signal.SIGTERM: 143}.get(signal.Signals(number), 0)
    if code not in (0, usual, -number):
        return f"code {code}: {said[-200:]}"
    if code == usual and "Traceback" in said and "tmm_gen/cli/__init__.py" in said:
        return said[-200:]
    return ""


def _half(here: Path, right: dict[str, bytes]) -> str:
    """Return the name of a file that is there and not as it is to be."""
    return next((f"half {name}" for name, content in _result(here).items() if right.get(name) != content), "")


def _result(here: Path) -> dict[str, bytes]:
    files = [here / "out.csv", *(here / "made").rglob("*")]
    return {
        str(p.relative_to(here)): p.read_bytes() for p in files if p.is_file() and ".tmm-gen-" not in str(p)
    }


def _start(here: Path, words: list[str]) -> subprocess.Popen[str]:
    (here / "tmp").mkdir(exist_ok=True)
    kept = {"XDG_CACHE_HOME": str(here / "cache"), "TMM_GEN_CACHE": str(here / "cache" / "built")}
    kept["TMPDIR"] = str(here / "tmp")
    return subprocess.Popen(
        [sys.executable, "-m", "tmm_gen", *words],
        cwd=here,
        env={**os.environ, **kept},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def _call(here: Path, words: list[str]) -> subprocess.CompletedProcess[str]:
    process = _start(here, words)
    out, err = process.communicate()
    return subprocess.CompletedProcess(words, process.returncode, out, err)


if __name__ == "__main__":
    sys.exit(main())
