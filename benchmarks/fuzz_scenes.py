"""Change the example scenes at random: does any of them end in a traceback, anywhere?

All are read; the first so many that are valid are built, and of some of them, if small, modes, stability, explanation
and a few steps are asked for too. Results go into a file as they come: an interrupted run goes on where it stopped.

    .venv/bin/python benchmarks/fuzz_scenes.py --scenes 20000 --built 2000 --out out/fuzz.jsonl
    .venv/bin/python benchmarks/fuzz_scenes.py --folder examples/space --scenes 4000 --built 400 --out out/space.jsonl

Exits with 1 if there was a traceback.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import json
import os
import sys
import tempfile
import tomllib
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from support.scene_fuzz import Outcome, attempt, mutated, toml

from tmm_gen.cli import main as command
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import Scene, SceneError, parse_scene

_SMALL = 60
"""Links of arms for which everything is tried."""
_SECONDS = 60
"""Of processor time that a trial may take."""
_TOO_LONG = 400
"""Links above which building says nothing new and takes its time."""


def main() -> int:
    """Fuzz and print what came out."""
    options = _options()
    documents = [tomllib.loads(path.read_text()) for path in sorted(options.folder.glob("*.toml"))]
    options.out.parent.mkdir(parents=True, exist_ok=True)
    done = _done(options.out)
    built = sum(1 for entry in done.values() if "build" in entry)
    with tempfile.TemporaryDirectory() as scratch, options.out.open("a") as log:
        os.chdir(scratch)
        os.environ["TMM_GEN_CACHE"] = str(Path(scratch, "cache"))
        for seed in range(options.first, options.first + options.scenes):
            if str(seed) in done:
                continue
            thorough = built % options.every == 0
            entry = _one(toml(mutated(documents, seed)), built < options.built, thorough)
            built += "build" in entry
            done[str(seed)] = entry
            log.write(json.dumps({"seed": seed, **entry}) + "\n")
            log.flush()
            if (len(done)) % 500 == 0:
                print(len(done), built, file=sys.stderr, flush=True)
    return _report(done)


def _one(text: str, build: bool, thorough: bool) -> dict[str, dict[str, str]]:
    """Try everything a scene allows."""
    loaded: list[Scene] = []

    def read() -> int:
        try:
            loaded.append(parse_scene(text))
        except SceneError as error:
            str(error)
            return 2
        return 0

    entry = {"read": asdict(attempt(read, _SECONDS))}
    if not loaded or not build or loaded[0].stations > _TOO_LONG:
        return entry
    for name, words in _commands(loaded[0], thorough):
        entry[name] = asdict(_run(text, words))
    return entry


def _commands(scene: Scene, thorough: bool) -> Iterator[tuple[str, list[str]]]:
    yield "build", ["build", "scene.toml", "--out", "built", "--force"]
    if scene.stations > _SMALL or not thorough:
        return
    few = repr(3 * scene.integrator.step)
    yield "run", ["run", "scene.toml", "--until", few, "--csv", "out.csv"]
    if scene.spatial is not None:
        yield "export", ["export", "scene.toml", "--to", "mjcf", "--out", "arm.xml"]
        return
    yield "modes", ["modes", "scene.toml"]
    yield "explain", ["explain", "scene.toml"]
    yield "stability", ["stability", "scene.toml", "--cells", "0"]


def _run(text: str, words: list[str]) -> Outcome:
    Path("scene.toml").write_text(text)
    Path("out.csv").unlink(missing_ok=True)
    said = io.StringIO()
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(said):
        outcome = attempt(lambda: command(words), _SECONDS)
    if outcome.result in ("130", "143"):  # somebody ends this run: what is recorded is kept
        sys.exit(int(outcome.result))
    return outcome if outcome.where else Outcome(outcome.result, said.getvalue()[:300], outcome.warned)


def _report(done: dict[str, dict[str, dict[str, str]]]) -> int:
    """Print how many trials of each kind ended how; return the exit code."""
    counts: dict[str, Counter[str]] = {}
    places: Counter[str] = Counter()
    warned: Counter[str] = Counter()
    example: dict[str, str] = {}
    for seed, entry in done.items():
        for trial, outcome in entry.items():
            counts.setdefault(trial, Counter())[outcome["result"]] += 1
            caught = "leave the range of floating point" in outcome["where"]
            counts[trial]["caught"] += caught
            if caught or outcome["result"] == "traceback":
                place = f"{trial}: {outcome['where']}"
                places[place] += 1
                example.setdefault(place, seed)
            if outcome["warned"]:
                warned[f"{trial}: {outcome['warned']}"] += 1
                example.setdefault(f"{trial}: {outcome['warned']}", seed)
    ends = ("0", "2", "1", "slow", "caught", "traceback")
    heads = ("done", "refused", "check 1", "slow", "caught", "tracebacks")
    print("trial".ljust(10), "tried".rjust(10), *(head.rjust(10) for head in heads))
    for trial, count in counts.items():
        tried = count.total() - count["caught"]
        print(trial.ljust(10), str(tried).rjust(10), *(str(count[end]).rjust(10) for end in ends))
    for title, found in (("tracebacks and arithmetic caught at the end", places), ("warnings", warned)):
        if found:
            print(f"\n{title}:")
        for place, number in found.most_common(60):
            print(f"{number:6}  {place}  (seed {example[place]})")
    return int(any(count["traceback"] for count in counts.values()))


def _done(path: Path) -> dict[str, dict[str, dict[str, str]]]:
    """Return what an earlier run has recorded; its last line may be cut short."""
    done: dict[str, dict[str, dict[str, str]]] = {}
    if path.exists():
        for line in path.read_text().splitlines():
            with contextlib.suppress(ValueError):
                entry = json.loads(line)
                done[str(entry.pop("seed"))] = entry
    return done


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument(
        "--folder", type=Path, default=scenes_dir(), help="where the scenes are that are changed"
    )
    parser.add_argument("--scenes", type=int, default=20000, help="how many are read")
    parser.add_argument("--built", type=int, default=2000, help="how many are built")
    parser.add_argument("--every", type=int, default=10, help="one of so many built is tried in all ways")
    parser.add_argument("--first", type=int, default=0, help="first seed")
    parser.add_argument("--out", type=Path, default=Path("out/fuzz.jsonl"))
    options = parser.parse_args()
    options.out = options.out.resolve()
    return options


if __name__ == "__main__":
    sys.exit(main())
