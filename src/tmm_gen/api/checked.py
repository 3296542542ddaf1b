"""Every backend of a scene against the others and against the exact response."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from tmm_gen.api.html import html_table
from tmm_gen.api.wording import in_python
from tmm_gen.verify.check import CheckReport
from tmm_gen.verify.check_row import CheckRow

__all__ = ["Check"]

_COLUMNS = {"check": "check", "value": "value", "bound": "at most", "passed": "holds", "meaning": "meaning"}


@dataclass(frozen=True, eq=False, repr=False)
class Check:
    """What was compared; true if everything holds.

    Parameters
    ----------
    name : str
        Of the scene.
    report : CheckReport
        What was found.
    """

    name: str
    report: CheckReport

    @property
    def passed(self) -> bool:
        """Whether every value is within its bound."""
        return self.report.passed

    @property
    def rows(self) -> tuple[CheckRow, ...]:
        """Each comparison: ``check``, ``value``, ``bound``, ``passed``, ``meaning``."""
        return self.report.rows

    @property
    def facts(self) -> Mapping[str, object]:
        """Further figures, such as the time of a step in C, ns."""
        return self.report.facts

    @property
    def why(self) -> str:
        """The cause where the motion breaks off or errs too much, and what would hold; empty otherwise."""
        return in_python(self.report.why)

    def __bool__(self) -> bool:
        """Return whether everything holds."""
        return self.passed

    def __repr__(self) -> str:
        """Say what does not hold."""
        failed = [row.check.replace("_", " ") for row in self.rows if not row.passed]
        said = f"NOT {', not '.join(failed)}" if failed else "everything holds"
        return f"<Check of {self.name}: {said}, {len(self.rows)} comparisons>"

    def _repr_html_(self) -> str:
        rows = [
            {key: getattr(row, key) for key in _COLUMNS} | {"check": row.check.replace("_", " ")}
            for row in self.rows
        ]
        return html_table(f"Check of {self.name}", _COLUMNS, rows, [self.why] if self.why else [])
