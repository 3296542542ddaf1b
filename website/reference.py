"""Pages from docstrings: what `tmm_gen` offers in Python, and what a generated package does."""

from __future__ import annotations

import inspect

import tmm_gen

GENERATED = "generated.elbow.kernel"
"""The package that stands for all generated ones."""


RETURNED = (
    "tmm_gen.api.run.Run",
    "tmm_gen.api.rest.Equilibria",
    "tmm_gen.api.rest.Equilibrium",
    "tmm_gen.api.modes.Modes",
    "tmm_gen.api.frequency.Response",
    "tmm_gen.control.arm.linear_model.LinearModel",
    "tmm_gen.api.sweep.Sweep",
    "tmm_gen.api.checked.Check",
    "tmm_gen.api.explained.Explained",
    "tmm_gen.api.stability.Stability",
    "tmm_gen.api.trade.Trade",
    "tmm_gen.api.tuned.Tuned",
    "tmm_gen.api.controlled.Control",
    "tmm_gen.api.calibrated.Calibrated",
    "tmm_gen.package.build.Built",
    "tmm_gen.api.exported.Exported",
    "tmm_gen.api.picture.Picture",
)
"""What calls return."""


def python_page() -> str:
    """Return the page of what `import tmm_gen` offers; empty where that is its version alone."""
    offered = [getattr(tmm_gen, name) for name in tmm_gen.__all__]
    documented = [each for each in offered if inspect.isclass(each) or inspect.isfunction(each)]
    if not documented:
        return ""
    names = [*(f"{each.__module__}.{each.__qualname__}" for each in documented), *RETURNED]
    blocks = "\n\n".join(f"::: {name}\n    options:\n      inherited_members: true" for name in names)
    return f"# Python\n\nWhat `import tmm_gen as tg` offers, from its docstrings.\n\n{blocks}\n"


def generated_page() -> str:
    """Return the page of a generated package."""
    return (
        "# Generated Python\n\nEvery generated package has these functions and classes; those of `elbow` stand for "
        "all. Its C has the same phases under the same names: `elbow_prepare`, `elbow_initialise`, `elbow_step`, "
        "`elbow_output`.\n\n"
        f"::: {GENERATED}\n    options:\n      show_root_heading: false\n      show_root_toc_entry: false\n"
    )
