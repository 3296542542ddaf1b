"""What is wrong with a URDF file or its sidecar, where, and what to do about it: all of it, not the first alone."""

from __future__ import annotations

from dataclasses import dataclass, field

from tmm_gen.errors import UserError
from tmm_gen.scene.problem import Problem


class UrdfError(UserError):
    """A robot that cannot be imported.

    Parameters
    ----------
    problems : tuple of Problem
        At least one, by line.
    """

    def __init__(self, problems: tuple[Problem, ...]) -> None:
        self.problems = problems
        super().__init__("\n".join(map(str, problems)))


@dataclass
class Faults:
    """Collects the faults of one file.

    Parameters
    ----------
    file : str
        As the user named it.
    """

    file: str
    found: list[Problem] = field(default_factory=list)

    def add(self, line: int, key: str, message: str, remedy: str, value: object = None) -> None:
        """Note a fault.

        Parameters
        ----------
        line : int
            From 1; 0 where the fault is the file itself.
        key : str
            Element or key at fault, such as ``joint 'elbow' <axis>``.
        message : str
            What is wrong, to be read after the key.
        remedy : str
            What to do, in whole sentences.
        value : object
            The value at fault; None where there is none.
        """
        self.found.append(Problem(self.file, line, key, value, message, remedy))

    def settle(self) -> None:
        """Raise what was found, if anything was.

        Raises
        ------
        UrdfError
            With every fault, by line.
        """
        if self.found:
            raise UrdfError(tuple(sorted(self.found, key=lambda problem: problem.line)))
