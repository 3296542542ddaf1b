"""What a scene makes the generator model, what it leaves out, and what that saves."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from tmm_gen.api.html import html_table
from tmm_gen.explain.explain import explain as explanation_of
from tmm_gen.explain.explanation import Explanation
from tmm_gen.explain.footprint import Footprint
from tmm_gen.explain.rows import beam_sentences, headline, term_row, whole_sentence
from tmm_gen.scene import Scene

__all__ = ["Explained", "explained"]

_COLUMNS = {
    "status": "status",
    "term": "term",
    "why": "why",
    "operations_per_step": "operations a step",
    "operations_per_output": "an output",
    "state_bytes": "bytes of state",
    "model_bytes": "of model",
}


@dataclass(frozen=True, eq=False, repr=False)
class Explained:
    """What a scene models.

    Parameters
    ----------
    explanation : Explanation
        What was counted.
    """

    explanation: Explanation

    @property
    def cost(self) -> Footprint:
        """Of the scene: operations of ``step``, ``output`` and ``prepare``, ``state_bytes`` and ``model_bytes``."""
        return self.explanation.own

    @property
    def everything(self) -> Footprint:
        """Of the same with all that was left out put in at once."""
        return self.explanation.everything

    @property
    def rows(self) -> list[dict[str, object]]:
        """Each term, whether it is modelled, why, and what it costs or would cost."""
        return [term_row(each) for each in self.explanation.terms]

    @property
    def statement(self) -> str:
        """Say what beams follow from their sections, and what all that was left out would cost."""
        return "\n".join([*beam_sentences(self.explanation.scene), whole_sentence(self.explanation)])

    def __repr__(self) -> str:
        """Say what a step costs."""
        terms = self.explanation.terms
        modelled = sum(each.modelled for each in terms)
        return (
            f"<Explanation of {self.explanation.scene.name}: {self.cost.step} operations a step, "
            f"{modelled} terms modelled, {len(terms) - modelled} left out>"
        )

    def _repr_html_(self) -> str:
        return html_table(headline(self.explanation), _COLUMNS, self.rows, self.statement.splitlines())


def explained(scene: Scene, advance: Callable[[str], None] = lambda term: None) -> Explained:
    """Return what a scene models; ``advance`` hears of each term as it is counted."""
    return Explained(explanation_of(scene, advance))
