"""What all tests share: the command line, a borrowed environment, repeatable Hypothesis."""

from __future__ import annotations

import gc
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import venv
from collections import Counter
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

import pytest
from hypothesis import settings
from hypothesis.internal.conjecture import providers

# Before any test imports SymPy: the package lets it remember more, and derivations take a fifth less.
import_module("tmm_gen")

# Figures are drawn into files; a display is neither needed nor there.
os.environ["MPLBACKEND"] = "Agg"
# Small matrices, and one process a core: threads of the linear algebra would only wait for each other, at length.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# `make test` gives the same answer on the same tree; HYPOTHESIS_PROFILE=explore looks for news.
settings.register_profile("repeatable", derandomize=True, deadline=None, database=None)
settings.register_profile("explore", deadline=None, print_blob=True)
PROFILE = os.environ.get("HYPOTHESIS_PROFILE", "repeatable")
settings.load_profile(PROFILE)
if PROFILE == "repeatable" and hasattr(providers, "_get_local_constants"):
    # Hypothesis also draws constants that our modules hold, those loaded by then: each worker would try other cases.
    providers._get_local_constants = providers.Constants

OPTIONAL_TOOLS = {
    "arm-none-eabi-gcc": "gcc-arm-none-eabi picolibc-arm-none-eabi",
    "chromium": "chromium",
    "clang": "clang",
    "cmake": "cmake",
    "cppcheck": "cppcheck",
    "ctest": "cmake",
    "frama-c": "frama-c-base",
    "g++": "g++",
    "qemu-system-arm": "qemu-system-arm",
    "qemu-system-riscv32": "qemu-system-misc",
    "riscv64-unknown-elf-gcc": "gcc-riscv64-unknown-elf picolibc-riscv64-unknown-elf",
}
"""Programs that tests use where they are there, and the packages of Debian and Ubuntu that hold them."""

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def repository() -> Path:
    """Root of the source tree."""
    return ROOT


@pytest.fixture(scope="session")
def optional_tools() -> dict[str, str]:
    """Programs that may be absent, and the packages that hold them."""
    return OPTIONAL_TOOLS


@pytest.fixture(scope="session", autouse=True)
def _patient() -> None:
    """Let commands run long without a word: standard error is to say the same on slow machines and on fast ones."""
    import_module("tmm_gen.cli.console")._QUIET = 1e6


@pytest.fixture(scope="session", autouse=True)
def _quickly_compiled() -> None:
    """Let compiled kernels and controllers be optimised less than a user's, where a test does not say how.

    Their bits are the same.

    What is compiled as a user's is: by commands that run in a process of their own, for functional mock-up units and
    batches, whose bits are compared with these kernels', and by the tests of emitted C.
    """
    loading = import_module("tmm_gen.native.loading")
    for compiling in (loading.compile_kernel, loading.load_kernel):
        assert compiling.__defaults__ == ("gcc", loading.FLAGS)
        compiling.__defaults__ = ("gcc", ("-O1", *loading.FLAGS[1:]))
    native = import_module("tmm_gen.onboard.native")
    made = native.EmittedController.__init__
    assert made.__defaults__ == ("float64", "gcc", native.FLAGS, 1)
    made.__defaults__ = ("float64", "gcc", ("-O1", *native.FLAGS[1:]), 1)


@pytest.fixture
def tmm_gen(tmp_path: Path) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Run the command line in a process of its own, in an empty folder unless `cwd` is given."""

    def call(
        *words: str | Path, cwd: Path = tmp_path, env: dict[str, str] | None = None
    ) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, "-m", "tmm_gen", *map(str, words)],
            cwd=cwd,
            env={**os.environ, **(env or {})},
            capture_output=True,
            text=True,
            check=False,
        )

    return call


@pytest.fixture(scope="session")
def borrow_environment() -> Callable[[Path], Path]:
    """Make a virtual environment that finds this one's packages, but not its tmm-gen.

    The function given takes the folder of the new environment and returns its ``bin``. Packages
    are borrowed by a path file, so nothing is downloaded; path files are not read recursively, so
    an editable install of tmm-gen in this environment is not seen from the new one.
    """

    def make(folder: Path) -> Path:
        venv.create(folder, with_pip=False, symlinks=True)
        variables = {"base": str(folder), "platbase": str(folder)}
        packages = Path(sysconfig.get_path("purelib", vars=variables))
        (packages / "borrowed.pth").write_text(sysconfig.get_path("purelib") + "\n")
        bin_folder = Path(sysconfig.get_path("scripts", vars=variables))
        # Without it, a `pip` called here would be some other environment's.
        pip = bin_folder / "pip"
        pip.write_text(f'#!/bin/sh\nexec "{bin_folder / "python"}" -m pip "$@"\n')
        pip.chmod(0o755)
        return bin_folder

    return make


@pytest.fixture(scope="session")
def need_tool() -> Callable[..., str]:
    """Return the path of a program; without it, fail where ``CI`` is set and skip elsewhere.

    The function given takes the program, as called on a command line. What is not in `OPTIONAL_TOOLS` is needed for
    any test at all, so its absence is a failure everywhere.
    """

    def find(program: str, package: str = "") -> str:
        found = shutil.which(program)
        if found is not None:
            return found
        package = package or OPTIONAL_TOOLS.get(program, "")
        if not package or os.environ.get("CI"):
            pytest.fail(f"{program} not found: apt-get install {package or program}")
        pytest.skip(f"{program} not found: apt-get install {package}")

    return find


@pytest.fixture(scope="session")
def browse(need_tool: Callable[..., str], tmp_path_factory: pytest.TempPathFactory) -> Callable[..., str]:
    """Call a headless browser on a page, with nothing of the network."""
    program = need_tool("chromium")

    def call(page: Path, *options: str) -> str:
        profile = tmp_path_factory.mktemp("profile")
        quiet = (
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
        )
        offline = "--proxy-server=127.0.0.1:9"
        always = (
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            f"--user-data-dir={profile}",
            *quiet,
            offline,
        )
        done = subprocess.run(
            [program, *always, *options, page.as_uri()],
            capture_output=True,
            text=True,
            check=True,
            timeout=120,
        )
        return done.stdout

    return call


# -- what takes long, first -------------------------------------------------------------------------

LONG = (
    "cli/test_demo.py",
    "cli/test_thesis_demo.py",
    "cli/test_space_motion.py",
    "cli/test_stability.py",
    "control/emitted/test_faults.py",
    "control/test_calibration_parts.py",
    "control/test_closed_loop.py",
    "control/test_mpc_command.py",
    "control/test_tuning.py",
    "docs/test_mpc_page.py",
    "docs/test_space_page.py",
    "docs/test_stability_page.py",
    "docs/test_trade_page.py",
    "docs/test_tutorial_page.py",
    "explain/test_space.py",
    "export/fmu/test_space.py",
    "modal/test_time_and_frequency.py",
    "planar/test_accuracy.py",
    "planar/test_energy.py",
    "planar/test_extremes.py",
    "playground/test_page.py",
    "spatial/test_afloat_conserved.py",
    "spatial/test_afloat_equations.py",
    "spatial/test_afloat_order.py",
    "spatial/test_agreement.py",
    "spatial/test_budgets.py",
    "spatial/test_compensated.py",
    "spatial/test_hard_cases.py",
    "spatial/test_import_motion.py",
    "spatial/test_integrators.py",
    "spatial/test_newton.py",
    "spatial/test_order.py",
    "spatial/test_pictures.py",
    "spatial/test_planar_twins.py",
    "spatial/test_prescribed_base.py",
    "spatial/test_rest.py",
    "spatial/test_text_size.py",
    "spatial/test_wide_vectors.py",
    "spatial/test_written_first.py",
    "spatial/test_yardsticks.py",
    "stability/test_map.py",
    "study/test_cluster.py",
    "target/test_space.py",
)
"""Files whose tests take long, besides single ones marked so; ``-m "not long"`` leaves them out.

They begin first: what is left at the end, when a worker has nothing more to do, is short.
"""


def pytest_addoption(parser: pytest.Parser) -> None:
    """Let a run on yet another machine repeat nothing of one kind."""
    parser.addoption(
        "--one-of-each",
        action="store_true",
        help="of each file only the first test, and those that want an optional tool",
    )


def pytest_configure(config: pytest.Config) -> None:
    """Put the files named on the command line in order of their folders.

    A file forgets the folders beside it with pytest 9.1, and the fixtures that these have given: what stands in such a
    folder is not to come before and after it (pytest issue 14635; gone with 9.2).
    """
    config.args.sort(key=lambda word: Path(word.partition("::")[0]).parent.parts)


def _is_short(item: pytest.Item) -> bool:
    return item.get_closest_marker("long") is None


def _is_for_gcc(item: pytest.Item) -> bool:
    """Return whether a test that asks for one compiler after another is for that which is always there."""
    called = getattr(item, "callspec", None)
    return called is not None and any(
        isinstance(each, str) and each == "gcc" for each in called.params.values()
    )


@pytest.hookimpl(tryfirst=True)  # before -m looks for the marks
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark what takes long, and what wants an optional tool; put the former first, leave repeats out if asked.

    A file's tests go to one worker unless they say otherwise: what its fixtures make is made once.
    """
    for item in items:
        place = item.path.relative_to(ROOT / "tests").as_posix()
        if place in LONG:
            item.add_marker(pytest.mark.long)
        if item.get_closest_marker("xdist_group") is None:
            item.add_marker(pytest.mark.xdist_group(place))
        if "need_tool" in getattr(item, "fixturenames", ()) and not _is_for_gcc(item):
            item.add_marker(pytest.mark.tools)
    items.sort(key=_is_short)
    if config.getoption("--one-of-each"):
        firsts: dict[Path, pytest.Item] = {}
        for item in sorted(items, key=_is_short, reverse=True):  # long ones may be left out too
            firsts.setdefault(item.path, item)
        chosen = {id(item) for item in firsts.values()}
        chosen |= {id(item) for item in items if item.get_closest_marker("tools")}
        config.hook.pytest_deselected(items=[item for item in items if id(item) not in chosen])
        items[:] = [item for item in items if id(item) in chosen]


def pytest_collection_finish(session: pytest.Session) -> None:
    """Look for circles among new objects alone, and seldom, as commands do.

    What thousands of tests and their modules are made of stays anyway; Python would go through it again and again, for
    a fifth of the time that derivations take.
    """
    gc.collect()
    gc.freeze()
    gc.set_threshold(import_module("tmm_gen.cli")._NEW_OBJECTS)


# -- what was left out, in one line at the very end ---------------------------------------------

LEFT_OUT = pytest.StashKey[Counter[str]]()


@pytest.hookimpl(trylast=True)
def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    """Count the tests that an absent tool left out."""
    absent = re.compile(r"Skipped: (\S+) not found: apt-get install")
    reasons = (str(report.longrepr) for report in terminalreporter.stats.get("skipped", []))
    found = (absent.search(reason) for reason in reasons)
    config.stash[LEFT_OUT] = Counter(match[1] for match in found if match)


def pytest_unconfigure(config: pytest.Config) -> None:
    """Say it after everything else that pytest says."""
    if LEFT_OUT not in config.stash:
        return
    counts = config.stash[LEFT_OUT]
    if not counts:
        print("No optional tool was absent.")
        return
    tools = ", ".join(f"{tool} ({count})" for tool, count in sorted(counts.items()))
    print(f"Optional tools absent (tests left out): {tools}; {counts.total()} tests left out in all.")
