"""Checks of emitted C by compilers and analysers, each by its name, none of which runs a scene.

Each takes texts, so that a test can plant a fault and see which check finds it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from tmm_gen.scratch import scratch_folder
from tmm_gen.target.boards import BOARDS
from tmm_gen.target.tools import attempt, need

WARNINGS = (
    *("-std=c99", "-pedantic", "-Wall", "-Wextra", "-Wconversion", "-Wdouble-promotion", "-Wfloat-equal"),
    *("-Wshadow", "-Wundef", "-Wstrict-prototypes", "-Wmissing-prototypes", "-Wcast-qual", "-Werror"),
)
SANITIZERS = "-fsanitize=address,undefined,float-divide-by-zero"
SUPPRESSIONS = Path(__file__).with_name("misra.txt")
"""Rules that are not kept, with reasons."""

Files = Mapping[str, str]
"""Texts by path: a kernel's header and source, and its host test where there is one."""


@dataclass(frozen=True)
class LintRow:
    """The outcome of one check.

    Parameters
    ----------
    check : str
        Its name.
    passed : bool
        Whether it has nothing to say.
    said : str
        What it says.
    meaning : str
        What it looks for.
    """

    check: str
    passed: bool
    said: str
    meaning: str


def gcc_warnings(files: Files) -> LintRow:
    """Compile with gcc's warnings as errors."""
    return _compiled("gcc_warnings", "gcc", "gcc", ("-O2", *WARNINGS), files, "gcc, strict warnings")


def clang_warnings(files: Files) -> LintRow:
    """Compile with clang's warnings as errors."""
    return _compiled(
        "clang_warnings", "clang", "clang", ("-O2", *WARNINGS), files, "clang, the same warnings"
    )


def gcc_analyzer(files: Files) -> LintRow:
    """Follow the paths of each function with gcc's static analyser."""
    options = ("-std=c99", "-O1", "-fanalyzer", "-Werror")
    meaning = f"gcc -fanalyzer{_left_out(files)}"
    return _compiled("gcc_analyzer", "gcc", "gcc", options, _without_vectors(files), meaning)


def misra(files: Files) -> LintRow:
    """Check against MISRA C:2012, save for the rules of :data:`SUPPRESSIONS`."""
    cppcheck = need("cppcheck", "cppcheck")
    options = (
        *("--std=c99", "--addon=misra", "--enable=warning,performance,portability", "--error-exitcode=1"),
        *(
            "--inline-suppr",
            "--quiet",
            f"--suppressions-list={SUPPRESSIONS}",
            "--suppress=missingIncludeSystem",
        ),
        "--template={file}:{line}: {id} {message}",
    )
    kernel = {path: text for path, text in _without_vectors(files).items() if not _is_test(path)}
    with _laid_out(kernel) as (folder, sources):
        done = attempt([cppcheck, *options, *sources], folder)
    said = done.stdout + done.stderr
    meaning = f"cppcheck with its MISRA C:2012 addon{_left_out(files)}"
    return LintRow("misra", done.returncode == 0, _short(said), meaning)


def single_precision(files: Files) -> LintRow:
    """Compile for a processor without double arithmetic and look for calls of its emulation."""
    board = BOARDS["cortex-m4f"]
    cc, nm = need(f"{board.prefix}gcc", board.package), need(f"{board.prefix}nm", "binutils-arm-none-eabi")
    kernel = {path: text for path, text in _without_vectors(files).items() if not _is_test(path)}
    found: list[str] = []
    with _laid_out(kernel) as (folder, sources):
        for source in sources:
            command = [
                cc,
                "-std=c99",
                "-O2",
                *board.machine,
                "--specs=picolibc.specs",
                "-c",
                source,
                "-o",
                "kernel.o",
            ]
            done = attempt(command, folder)
            if done.returncode != 0:
                return LintRow("single_precision", False, _short(done.stderr), _SINGLE)
            undefined = attempt([nm, "--undefined-only", "kernel.o"], folder).stdout.split()
            found += [name for name in undefined if _is_double(name)]
    return LintRow("single_precision", not found, ", ".join(found), _SINGLE)


def host_test(files: Files) -> LintRow:
    """Compile the kernel with its own test against 30 digits, under sanitizers, and run it."""
    cc = need("gcc", "gcc libc6-dev")
    options = ("-std=c99", "-O1", "-g", "-ffp-contract=off", SANITIZERS, "-fno-sanitize-recover=all")
    with _laid_out(files) as (folder, sources):
        built = attempt([cc, *options, *sources, "-lm", "-o", "host_test"], folder)
        done = attempt(["./host_test"], folder) if built.returncode == 0 else built
    meaning = "the kernel's own test against 30 digits, under ASan and UBSan"
    return LintRow("host_test", done.returncode == 0, _short(done.stdout + done.stderr), meaning)


CHECKS: dict[str, Callable[[Files], LintRow]] = {
    check.__name__: check
    for check in (gcc_warnings, clang_warnings, gcc_analyzer, misra, single_precision, host_test)
}
"""By name."""
_SINGLE = "no call of double arithmetic in the object code for a Cortex-M4F"


def lint(files: Files, real: str) -> tuple[LintRow, ...]:
    """Run all checks that apply.

    Parameters
    ----------
    files : mapping from str to str
        As ``emit_c`` returns them.
    real : str
        Number type: ``single_precision`` is for "float32".

    Raises
    ------
    UserError
        If a program is missing.
    """
    return tuple(
        check(files) for name, check in CHECKS.items() if real == "float32" or name != "single_precision"
    )


def _compiled(
    check: str, compiler: str, package: str, options: tuple[str, ...], files: Files, meaning: str
) -> LintRow:
    cc = need(compiler, package)
    with _laid_out(files) as (folder, sources):
        done = [attempt([cc, *options, "-c", source, "-o", "object.o"], folder) for source in sources]
    said = "".join(one.stdout + one.stderr for one in done)
    return LintRow(check, all(one.returncode == 0 for one in done), _short(said), meaning)


@contextmanager
def _laid_out(files: Files) -> Iterator[tuple[Path, list[str]]]:
    """Put texts in a folder of their own, for as long as a block lasts."""
    with scratch_folder() as folder:
        names = [PurePosixPath(path).name for path in files]
        for name, text in zip(names, files.values(), strict=True):
            (folder / name).write_text(text, encoding="utf-8")
        yield folder, sorted(name for name in names if name.endswith(".c"))


def _without_vectors(files: Files) -> Files:
    """Return what is for microcontrollers.

    Vector types, those of arms side by side, are no C99, and analysers misread them.
    """
    return {path: text for path, text in files.items() if "vector_size(" not in text}


def _left_out(files: Files) -> str:
    return "" if _without_vectors(files) == files else ", of one arm's code"


def _is_test(path: str) -> bool:
    return PurePosixPath(path).name.startswith("test_")


def _is_double(name: str) -> bool:
    """Whether a symbol of ARM's run-time ABI, or of the C library, computes with doubles."""
    return name.startswith(("__aeabi_d", "__aeabi_f2d", "__aeabi_i2d", "__aeabi_ui2d")) or name in (
        "sin",
        "cos",
        "sqrt",
    )


def _short(said: str) -> str:
    return " ".join(said.split())[:400]
