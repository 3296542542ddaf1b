"""A click group that imports a command's module only when that command is called.

The help of the group is answered from a table of summaries: ``tmm-gen --help`` imports neither
SymPy, NumPy nor CasADi.
"""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any

import click

__all__ = ["LazyCommand", "LazyGroup"]


@dataclass(frozen=True)
class LazyCommand:
    """Where a command lies, and its line in the group's help.

    Attributes
    ----------
    target
        ``"package.module:attribute"`` of a `click.Command`.
    summary
        One sentence.
    """

    target: str
    summary: str

    def load(self) -> click.Command:
        """Import the command.

        Raises
        ------
        ImportError
            If there is no such module.
        TypeError
            If the target is no click command.
        """
        module, _, attribute = self.target.partition(":")
        command = getattr(importlib.import_module(module), attribute)
        if not isinstance(command, click.Command):
            raise TypeError(f"{self.target} is no click command but {command!r}")
        return command


class LazyGroup(click.Group):
    """A group over a table of `LazyCommand`, in the order of the table.

    Parameters
    ----------
    commands_by_name
        The table.
    """

    def __init__(self, *args: Any, commands_by_name: Mapping[str, LazyCommand], **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._table = dict(commands_by_name)

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names, in the order of the table."""
        return list(self._table)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import and return a command; None for an unknown name."""
        entry = self._table.get(cmd_name)
        return entry.load() if entry else None

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command called; a misspelt name is answered with the nearest one."""
        if args and args[0] not in self._table and not args[0].startswith("-"):
            near = get_close_matches(args[0], self._table, n=1)
            remedy = f"did you mean {near[0]}?" if near else f"commands are {', '.join(self._table)}"
            ctx.fail(f"no command {args[0]!r}; {remedy}")
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the list of commands from the table alone."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, entry.summary) for name, entry in self._table.items()])
