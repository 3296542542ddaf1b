"""Robots drawn at random as URDF, imported, built and run, against Pinocchio: its reader, its ``aba``, SciPy's DOP853.

``python benchmarks/urdf_runs.py [--robots 200]``. From rest, under its weight and a torque in each joint, each robot
runs at a step of Newmark and at half of it. A robot is wrong if its error is more than a thousandth of its way, or if
half the step does not leave about a quarter of it. Exits with 1 if any is. Pinocchio is no dependency: where it
cannot be imported, this says how to get it.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path
from types import ModuleType

import numpy as np
from import_urdf import HOW_TO_GET
from scipy.integrate import solve_ivp
from support.urdf_runs import UNTIL, Array, UrdfRun, urdf_run

from tmm_gen.cli.console import progress
from tmm_gen.csv_text import csv_text
from tmm_gen.errors import UserError
from tmm_gen.files import write_whole

TOLERANCE = 1e-11
"""Of the integration, relative and absolute."""
WRONG = 1e-3
"""An error that no step explains, as a share of the way."""
ORDER = (1.8, 2.2)
"""Of the method, as both errors show it; where the finer is above `ROUNDING`."""
ROUNDING = 1e-9


def exact(pin: ModuleType, run: UrdfRun, folder: Path) -> Array:
    """Return the angles at `UNTIL` in the order of the scene's joints, as Pinocchio has them."""
    (folder / "robot.urdf").write_text(run.text, encoding="utf-8")
    model = pin.buildModelFromUrdf(str(folder / "robot.urdf"))
    assert run.scene.spatial is not None
    model.gravity.linear = np.array(run.scene.spatial.gravity)
    data, joints = model.createData(), list(model.joints)[1:]
    order = [run.names.index(name) for name in list(model.names)[1:]]
    torques = run.torques[order]

    def slope(_: float, motion: Array) -> Array:
        q, v = np.split(motion, 2)
        turned = pin.neutral(model)
        for joint, angle in zip(joints, q, strict=True):
            place = [angle] if joint.nq == 1 else [np.cos(angle), np.sin(angle)]
            turned[joint.idx_q : joint.idx_q + joint.nq] = place
        return np.concatenate([v, pin.aba(model, data, turned, v, torques - model.damping * v)])

    start = np.zeros(2 * len(order))
    found = solve_ivp(slope, (0.0, UNTIL), start, method="DOP853", rtol=TOLERANCE, atol=TOLERANCE)
    angles = np.empty(len(order))
    angles[order] = found.y[: len(order), -1]
    return angles


def main() -> int:
    """Print what became of all."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--robots", type=int, default=200)
    parser.add_argument("--first", type=int, default=0, help="seed of the first")
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    given = parser.parse_args()
    try:
        import pinocchio as pin
    except ImportError:
        sys.exit(f"Pinocchio is not here: {HOW_TO_GET}")
    rows: list[dict[str, object]] = []
    with tempfile.TemporaryDirectory() as name, progress("running robots", total=given.robots) as advance:
        for seed in range(given.first, given.first + given.robots):
            rows.append(judged(pin, seed, Path(name)))
            write_whole(given.out / "urdf_runs.csv", csv_text(rows))
            advance()
    wrong = [row for row in rows if row["said"]]
    for row in wrong:
        print(f"robot {row['seed']}: {row['said']}")
    errors = [float(str(row["error"])) for row in rows if row["error"]]
    fine = [float(str(row["error_at_half"])) for row in rows if row["error_at_half"]]
    joints = sum(int(str(row["joints"])) for row in rows)
    print(
        f"{len(rows)} robots, {joints} joints: {len(wrong)} wrong; largest error {max(errors):.1e} of the way, "
        f"{max(fine):.1e} at half the step"
    )
    return int(bool(wrong))


def judged(pin: ModuleType, seed: int, folder: Path) -> dict[str, object]:
    """Return a row about a robot; what is wrong is `said`."""
    row: dict[str, object] = dict.fromkeys(
        ("seed", "joints", "way", "error", "error_at_half", "order", "said"), ""
    )
    row["seed"] = seed
    try:
        run = urdf_run(seed, folder)
    except (UserError, ArithmeticError) as error:
        return row | {"joints": 0, "said": str(error)}
    way, coarse, fine = run.judged(exact(pin, run, folder))
    order = float(np.log2(coarse / fine))
    said = ""
    if coarse > WRONG:
        said = f"its error is {coarse:.1e} of the way"
    elif fine > ROUNDING and not ORDER[0] <= order <= ORDER[1]:
        said = f"its errors show order {order:.2f}"
    return row | {
        "joints": len(run.names),
        "way": way,
        "error": coarse,
        "error_at_half": fine,
        "order": order,
        "said": said,
    }


if __name__ == "__main__":
    sys.exit(main())
