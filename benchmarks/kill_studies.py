"""Kill parts of studies at random instants: each ends right, or in one line, and goes on from its store.

Kinds: the scheduler of another cluster, a worker of one's own cluster (as it starts or later), all of them time and
again, and the study itself; then the study is run again with the same store. Exits with 1 if one ends in a traceback
or in other results than a study that nobody disturbs.
"""

from __future__ import annotations

import argparse
import os
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from pathlib import Path

from tmm_gen.cli.console import Column, progress, table

SCENE = Path(__file__).resolve().parents[1] / "scenes" / "thesis2.toml"
STEPS = ",".join(f"{2.0 / (20 + k):.6g}" for k in range(60))
STUDY = [
    "trade",
    str(SCENE),
    "--integrators",
    "newmark,sdirk4",
    "--until",
    "2",
    "--rounds",
    "0",
    "--steps",
    STEPS,
]
TOOL = [sys.executable, "-m", "tmm_gen"]
ELSEWHERE = """
import time
from distributed import LocalCluster
if __name__ == "__main__":
    cluster = LocalCluster(n_workers=2, threads_per_worker=1, host="127.0.0.1",
                           dashboard_address="127.0.0.1:0", memory_limit=0)
    print(cluster.scheduler_address, flush=True)
    time.sleep(600)
"""
KINDS = ("scheduler", "worker", "all workers", "study")


def children(process: int) -> list[int]:
    """Return the processes that a process has started and that compute something."""
    found = []
    for entry in Path("/proc").iterdir():
        if not entry.name.isdecimal():
            continue
        try:
            parent = int((entry / "stat").read_text().rpartition(")")[2].split()[1])
            command = (entry / "cmdline").read_bytes()
        except OSError:
            continue
        if parent == process and b"resource_tracker" not in command and b"gcc" not in command:
            found.append(int(entry.name))
    return found


def run(kind: str, folder: Path) -> str:
    """Start a study, kill what is to be killed, and run it again; return how it ended."""
    words = [*STUDY, "--store", str(folder / "study.sqlite"), "--csv", str(folder / "rows.csv")]
    other = None
    if kind == "scheduler":
        other = subprocess.Popen([sys.executable, "-c", ELSEWHERE], stdout=subprocess.PIPE, text=True)
        assert other.stdout is not None
        disturbed = [*words, "--scheduler", other.stdout.readline().strip()]
    else:
        disturbed = [*words, "--workers", "2"]
    study = subprocess.Popen([*TOOL, *disturbed], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    begun = time.monotonic()
    patience = random.uniform(0.0, 12.0)
    done = threading.Event()

    def kill() -> None:
        while not done.wait(0.02):
            if kind == "all workers" or time.monotonic() - begun > patience:
                victims = {"scheduler": [other.pid] if other else [], "study": [study.pid]}.get(kind)
                for victim in (victims or children(study.pid))[: None if kind == "all workers" else 1]:
                    try:
                        os.kill(victim, signal.SIGKILL)
                    except ProcessLookupError:
                        continue
                    if kind != "all workers":
                        return

    killer = threading.Thread(target=kill)
    killer.start()
    try:
        _, said = study.communicate(timeout=300)
        code = study.returncode
    except subprocess.TimeoutExpired:
        study.kill()
        study.communicate()
        return "hangs"
    finally:
        done.set()
        killer.join()
        if other is not None:
            other.kill()
            other.communicate()
    if "Traceback" in said:
        return "traceback"
    if code not in (0, 2, -signal.SIGKILL) or (code == 2 and len(said.splitlines()) != 1):
        return f"code {code}: {said}"
    again = subprocess.run([*TOOL, *words], capture_output=True, text=True, check=False)
    if again.returncode != 0 or (folder / "rows.csv").read_text() != undisturbed():
        return f"other results: {again.stderr}"
    return {0: "finished", 2: "told in one line"}.get(code, "killed, went on")


_UNDISTURBED: list[str] = []


def undisturbed() -> str:
    """Return the rows of a study that nobody disturbs."""
    if not _UNDISTURBED:
        with tempfile.TemporaryDirectory() as folder:
            rows = Path(folder) / "rows.csv"
            subprocess.run([*TOOL, *STUDY, "--csv", str(rows)], capture_output=True, check=True)
            _UNDISTURBED.append(rows.read_text())
    return _UNDISTURBED[0]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--each", type=int, default=10, help="studies for each kind")
    parser.add_argument("--kind", choices=KINDS, action="append", help="repeatable; by default all")
    parser.add_argument("--seed", type=int, default=0, help="of the instants")
    parser.add_argument("--json", action="store_true", help="one JSON object instead of a table")
    chosen = parser.parse_args()
    random.seed(chosen.seed)
    kinds = chosen.kind or KINDS
    rows: list[dict[str, object]] = []
    good = ("finished", "told in one line", "killed, went on")
    bad = 0
    with progress("killing", total=len(kinds) * chosen.each) as advance:
        for kind in kinds:
            counts: Counter[str] = Counter()
            for _ in range(chosen.each):
                with tempfile.TemporaryDirectory() as folder:
                    said = run(kind, Path(folder))
                counts[said if said in good else "wrong"] += 1
                if said not in good:
                    bad += 1
                    print(f"{kind}: {said}", file=sys.stderr)
                advance(1, kind)
            keys = ("finished", "told in one line", "killed, went on", "wrong")
            rows.append(
                {
                    "killed": kind,
                    "studies": chosen.each,
                    **{k.replace(", ", "_").replace(" ", "_"): counts[k] for k in keys},
                }
            )
    columns: list[Column | str] = [
        "killed",
        "studies",
        "finished",
        "told_in_one_line",
        "killed_went_on",
        "wrong",
    ]
    table(rows, columns, chosen.json, title="Studies disturbed")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
