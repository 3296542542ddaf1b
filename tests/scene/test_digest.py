"""The digest depends on what a scene says, not on how it is written."""

from __future__ import annotations

import re
import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tmm_gen.scene import parse_scene
from tmm_gen.scene.digest import content_digest


def blocks(text: str) -> list[str]:
    """Split a document before each header."""
    return re.split(r"(?m)^(?=\[)", text)


def test_shape(chain: str) -> None:
    assert re.fullmatch("[0-9a-f]{64}", parse_scene(chain).digest)


@given(data=st.data())
def test_order_of_tables_and_keys_and_comments_do_not_matter(chain: str, data: st.DataObject) -> None:
    head, *tables = blocks(chain)
    order = data.draw(st.permutations(range(len(tables))))
    # Elements of one array of tables keep their order: it is the order of stations.
    by_header: dict[str, list[str]] = {}
    for table in tables:
        by_header.setdefault(table.split("\n")[0], []).append(table)
    shuffled = [by_header[tables[index].split("\n")[0]].pop(0) for index in order]
    written = head
    for table in shuffled:
        header, *rows = table.strip().split("\n")
        comment = data.draw(st.sampled_from(["", "  # why", "\n\n# [base]\n"]))
        rows = data.draw(st.permutations(rows))
        space = data.draw(st.sampled_from(["=", " =\t", "  =  "]))
        written += "\n".join([header + comment, *(row.replace(" = ", space) for row in rows)]) + "\n"
    assert parse_scene(written, "elsewhere.toml").digest == parse_scene(chain).digest


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("20.0", "20"),
        ("20.0", "2e1"),
        ('"newmark"', "'newmark'"),
        ("damping = 0.5", "damping = 0.5\nrepeat = 1"),
        ('"riccati"', '"riccati"\nunknown = "acceleration"'),
        ("[base]", "[initial]\nangles = [0.0, -0.0]\n[base]"),
        ("[base]", "[emit]\nbackends = ['casadi', 'numpy', 'c']\n[base]"),
    ],
)
def test_spelling_does_not_matter(chain: str, old: str, new: str) -> None:
    assert parse_scene(chain.replace(old, new, 1)) == parse_scene(chain)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('"arm"', '"leg"'),
        ("An arm", "An Arm"),
        ('"riccati"', '"product"'),
        ('"newmark"\nstep', '"zhou"\nstep'),
        ("0.01", "0.011"),
        ("0.25", "0.2500000000000001"),
        ("20.0", "20.000000000000004"),
        ("2.0", "3.0"),
        ('"tip_torque"', '"torque"'),
        ('"tip"\nacts', "2\nacts"),
        ('"angle"', '"velocity"'),
        ("[base]", "[initial]\nrates = 1\n[base]"),
        ("[base]", "[emit]\nreal = 'float32'\n[base]"),
        ("[base]", "[emit.box]\nrates = [0, 1]\n[base]"),
    ],
)
def test_content_matters(chain: str, old: str, new: str) -> None:
    text = chain.replace("beta = 0.25\n", "") if "zhou" in new else chain
    assert parse_scene(text.replace(old, new, 1)) != parse_scene(text)


def test_order_of_stations_matters(chain: str) -> None:
    swapped = chain.replace("inertia = 1.0", "inertia = 9.0").replace("2.0", "1.0").replace("9.0", "2.0")
    assert parse_scene(swapped) != parse_scene(chain)


def test_digest_does_not_depend_on_the_hash_seed(chain: str) -> None:
    code = "import sys; from tmm_gen.scene import parse_scene; print(parse_scene(sys.stdin.read()).digest)"
    digests = {
        subprocess.run(
            [sys.executable, "-c", code],
            input=chain,
            capture_output=True,
            text=True,
            check=True,
            env={"PYTHONHASHSEED": seed, "PYTHONPATH": ":".join(sys.path)},
        ).stdout.strip()
        for seed in ("0", "1", "2")
    }
    assert digests == {parse_scene(chain).digest}


def test_numbers_that_are_not_finite_are_refused() -> None:
    with pytest.raises(ValueError, match="JSON"):
        content_digest({"x": float("nan")})
