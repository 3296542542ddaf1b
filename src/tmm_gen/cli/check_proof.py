"""`tmm-gen check --prove`: no run-time fault within the scene's box."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from tmm_gen.cli.console import progress, table

if TYPE_CHECKING:
    from tmm_gen.scene import Scene


def check_proof(scene: Scene, json_mode: bool) -> int:
    """Prove a scene's C.

    Returns
    -------
    int
        1 if an alarm is left, else 0.
    """
    with progress(f"proving {scene.name}"):
        from tmm_gen.target import prove

        found = prove(scene)
    rows = [{"file": alarm.file, "line": alarm.line, "alarm": alarm.text} for alarm in found.alarms]
    if json_mode:
        facts = {"scene": scene.name, "passed": found.proved, "alarms": len(rows), "box": found.box}
        table(rows, [], json_mode, more=facts)
        return 0 if found.proved else 1
    if rows:
        table(rows, ["file", "line", "alarm"], title=f"{scene.title}: what EVA cannot exclude")
    bounds = ", ".join(f"{name} {low:g} to {high:g}" for name, (low, high) in found.box.items())
    click.echo(f"Whatever start, state and inputs within {bounds}:")
    if found.proved:
        click.echo(
            "proved: no function leaves an array, divides by zero, reads what was not written, or makes an infinity "
            f"or a NaN; it succeeds or returns a status ({found.reached})"
        )
    else:
        click.echo(f"NOT proved: {len(rows)} alarms")
    return 0 if found.proved else 1
