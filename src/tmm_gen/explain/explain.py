"""Explanations of scenes, each counted once and then remembered."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict

from tmm_gen.explain.explanation import Explained, Explanation
from tmm_gen.explain.footprint import Footprint
from tmm_gen.package.cache import keep, kept
from tmm_gen.scene import Scene

_KEPT = "explain"
"""Folder of the cache: counting takes a dozen programs."""


def explain(scene: Scene, advance: Callable[[str], None] = lambda term: None) -> Explanation:
    """List what was modelled and what was left out, with costs.

    Parameters
    ----------
    scene : Scene
        What to explain.
    advance : callable, optional
        Called with the name of each term as it is counted.
    """
    # words about a scene follow from how it is written too
    key = f"{scene.digest}\n{json.dumps(scene.source.data, sort_keys=True, default=str)}"
    if (known := kept(_KEPT, key)) is not None:
        told = tuple(Explained(**{**term, "worth": Footprint(**term["worth"])}) for term in known["terms"])
        return Explanation(scene, Footprint(**known["own"]), told, Footprint(**known["everything"]))
    from tmm_gen.explain.counting import counted  # and with it SymPy: what is remembered needs none

    found = counted(scene, advance)
    terms = [asdict(each) for each in found.terms]
    keep(_KEPT, key, {"own": asdict(found.own), "terms": terms, "everything": asdict(found.everything)})
    return found
