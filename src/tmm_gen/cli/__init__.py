"""The command line: a group whose commands are imported only when they are called.

To add a command: write ``cli/<name>.py`` with a click command in it, and add one line to `COMMANDS`.
"""

from __future__ import annotations

import contextlib
import errno
import gc
import os
import signal
import sys
import threading
import warnings
from collections.abc import Iterator, Sequence
from pathlib import Path

import click
from click.shell_completion import shell_complete

from tmm_gen.cli.lazy import LazyCommand, LazyGroup
from tmm_gen.errors import UserError, beyond, of_numbers
from tmm_gen.version import __version__

__all__ = ["COMMANDS", "main", "tmm_gen"]

_PROGRAM = "tmm-gen"
_OF_OUTPUT = (errno.EBADF, errno.EFBIG, errno.EIO, errno.ENOSPC, errno.EDQUOT)
"""What goes wrong with standard output, to which errors give no name."""
_NEW_OBJECTS = 50_000
"""After which Python looks for circles among them: 700 by itself; expressions of SymPy make none, and are many."""
_READER_WENT = 128 + 13
"""Exit code of a command whose reader goes away: what shells have for SIGPIPE."""

COMMANDS = {
    "new": LazyCommand("tmm_gen.cli.new:new", "Write a commented scene to start from."),
    "import": LazyCommand(
        "tmm_gen.cli.import_urdf:import_urdf", "Write the scene that a robot's URDF file makes."
    ),
    "keys": LazyCommand("tmm_gen.cli.keys:keys", "List every key a scene may have."),
    "schema": LazyCommand("tmm_gen.cli.schema:schema", "Print a JSON schema of scenes, for editors."),
    "build": LazyCommand("tmm_gen.cli.build:build", "Generate the kernels of scenes; --check only compares."),
    "check": LazyCommand("tmm_gen.cli.check:check", "Compile and compare every backend of a scene."),
    "run": LazyCommand("tmm_gen.cli.run:run", "Simulate a scene."),
    "rest": LazyCommand("tmm_gen.cli.rest:rest", "Show where an arm comes to rest, or would balance."),
    "modes": LazyCommand("tmm_gen.cli.modes:modes", "Show natural frequencies, damping and mode shapes."),
    "frequency": LazyCommand(
        "tmm_gen.cli.frequency:frequency", "Show frequency responses, and how few links a scene requires."
    ),
    "integrators": LazyCommand(
        "tmm_gen.cli.integrators:integrators", "Show what is derived about each integrator."
    ),
    "stability": LazyCommand(
        "tmm_gen.cli.stability:stability", "Show where a scene stands against every limit of stability."
    ),
    "trade": LazyCommand("tmm_gen.cli.trade:trade", "Measure error against cost over integrators and steps."),
    "tune": LazyCommand("tmm_gen.cli.tune:tune", "Find the cheapest configuration within given bounds."),
    "explain": LazyCommand(
        "tmm_gen.cli.explain:explain", "Show what a scene models, what it leaves out, and what that saves."
    ),
    "playground": LazyCommand(
        "tmm_gen.cli.playground:playground", "Write a page on which to play with a scene, without a server."
    ),
    "export": LazyCommand("tmm_gen.cli.export:export", "Write a scene for FMI, MuJoCo or URDF."),
    "errata": LazyCommand("tmm_gen.cli.errata:errata", "Compare the thesis's coefficients with the derived."),
    "calibrate": LazyCommand("tmm_gen.cli.calibrate:calibrate", "Fit a scene to a recorded response."),
    "mpc": LazyCommand("tmm_gen.cli.mpc:mpc", "Control the arm on a finer plant, and compare controllers."),
    "demo": LazyCommand("tmm_gen.cli.demo:demo", "Lift an arm's payload; measure what accuracy costs."),
}


@click.group(
    cls=LazyGroup,
    commands_by_name=COMMANDS,
    context_settings={"help_option_names": ["-h", "--help"]},
)
@click.version_option(__version__, prog_name=_PROGRAM, message="%(prog)s %(version)s")
def tmm_gen() -> None:
    """Derive, generate and measure transfer-matrix kernels of flexible arms.

    A scene, written in TOML, says what the arm is; `tmm-gen new NAME` writes one to start from.
    """


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Parameters
    ----------
    arguments
        Words after the program's name; by default those of the process.

    Returns
    -------
    int
        Exit code: 0 done, 1 a check failed, 2 bad usage, a bad scene, or a file or standard output that cannot be
        written; 130 interrupted, 143 told to end.
    """
    words = list(sys.argv[1:] if arguments is None else arguments)
    if instruction := os.environ.get("_TMM_GEN_COMPLETE"):
        return shell_complete(tmm_gen, {}, _PROGRAM, "_TMM_GEN_COMPLETE", instruction)
    if sys.stdout is None:
        return _fail(
            "standard output is closed. Leave it open, or send it to /dev/null.", UserError.exit_code
        )
    if any("\0" in word for word in words):
        return _fail("an argument holds a null character. Leave it out.", UserError.exit_code)
    if arguments is None:
        _alone()
    with _ending_in_order():
        return _code(words)


def _alone() -> None:
    """Set up a process that does nothing but this command."""
    gc.set_threshold(_NEW_OBJECTS)
    # which pydantic would look for in every package installed
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    # what libraries warn of is for those who write tmm-gen; python -W shows it
    if not sys.warnoptions:
        warnings.simplefilter("ignore")


def _code(words: list[str]) -> int:
    """Run, and turn every error that the user can mend into one line and an exit code."""
    try:
        code = _invoke(words)
        sys.stdout.flush()
        return code
    except BrokenPipeError as error:
        return _printing_failed(error)
    except SystemExit as stop:
        # rich turns a broken pipe into this.
        if isinstance(stop.__context__, BrokenPipeError):
            return _printing_failed(stop.__context__)
        raise
    except KeyboardInterrupt:
        return _fail(_ended("interrupted", words), 130)
    except _ToldToEnd:
        return _fail(_ended("told to end", words), 143)
    except OSError as error:
        if error.filename is None:
            if error.errno not in _OF_OUTPUT:
                raise
            return _printing_failed(error)
        return _fail(f"{error.filename}: {error.strerror}", UserError.exit_code)
    except MemoryError:
        return _fail("not enough memory for this. Ask for fewer steps, links or modes.", UserError.exit_code)
    except UserError as error:
        return _fail(str(error), error.exit_code)
    except Exception as error:
        if (scene := _scene_in(words)) is None or not of_numbers(error):
            raise
        return _fail(f"{scene}: {beyond(error)}", UserError.exit_code)


def _invoke(words: list[str]) -> int:
    """Parse and run; click's own ``main`` is passed by, since it settles broken pipes its own way."""
    try:
        with tmm_gen.make_context(_PROGRAM, words) as context:
            outcome = tmm_gen.invoke(context)
    except click.exceptions.Exit as finished:
        return finished.exit_code
    except click.Abort as stop:
        raise KeyboardInterrupt from stop
    except click.exceptions.NoArgsIsHelpError as error:
        error.show()
        return UserError.exit_code
    except click.ClickException as error:
        return _fail(_usage(error), UserError.exit_code)
    return outcome if isinstance(outcome, int) else 0


def _usage(error: click.ClickException) -> str:
    """Return on one line what click has to say, and where the help is."""
    said = " ".join(error.format_message().split())
    context = getattr(error, "ctx", None)
    if context is None:
        return said
    ended = said if said.endswith("?") else f"{said.rstrip('.')}."
    return f"{ended} `{context.command_path} --help` shows what there is."


def _ended(how: str, words: list[str]) -> str:
    """Return what to say of an end before the end: a study with a store can go on, from what is in it."""
    for word, following in zip(words, [*words[1:], ""], strict=True):
        option, _, value = word.partition("=")
        if option == "--store" and (store := value or following):
            from tmm_gen.study.store import kept_in

            return f"{how}. {store} {kept_in(Path(store))}"
    return how


class _ToldToEnd(BaseException):
    """SIGTERM or SIGHUP: everything on the way out is to be put back."""


@contextlib.contextmanager
def _ending_in_order() -> Iterator[None]:
    """Let signals that end the process unwind it first, so that no scratch is left and no file half written."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def end(number: int, _frame: object) -> None:
        signal.signal(number, signal.SIG_IGN)  # once is enough
        raise _ToldToEnd

    ours = [getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]
    ours = [number for number in ours if signal.getsignal(number) == signal.SIG_DFL]
    for number in ours:
        signal.signal(number, end)
    try:
        yield
    finally:
        for number in ours:
            signal.signal(number, signal.SIG_DFL)


def _scene_in(words: list[str]) -> str | None:
    """Return the scene that a command line names."""
    return next((word for word in words[1:] if word.endswith(".toml")), None)


def _fail(message: str, code: int) -> int:
    with contextlib.suppress(OSError, ValueError):  # standard error may be closed too: the code tells
        click.echo(f"error: {message}", err=True)
    return code


def _printing_failed(error: OSError) -> int:
    """Say that the output cannot be written; standard output points at nothing then, so that the exit stays quiet.

    A reader that has seen enough, such as ``head``, is no error: nothing is said, as by other commands in pipes.
    """
    with contextlib.suppress(OSError, ValueError):  # standard output may be no file
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    if isinstance(error, BrokenPipeError):
        return _READER_WENT
    return _fail(f"standard output: {error.strerror or error}", UserError.exit_code)
