"""Arms one can look at."""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from tmm_gen.report.animate import animation, frame_instants, link_angles
from tmm_gen.scene import Scene, load_scene
from tmm_gen.simulate.places import node_places
from tmm_gen.simulate.run import simulate

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def moved(unlike: Callable[..., Scene], swinging: Any) -> Any:
    scene = unlike("motor", step=0.01)
    return simulate(scene, swinging(scene), 0.4, trace=True, refuse=False)


def test_nodes_are_where_the_outputs_say(moved: Any) -> None:
    x, y = node_places(moved.scene, link_angles(moved))
    assert x[:, -1] == pytest.approx(moved.outputs["position_of_tip_x"])
    assert y[:, 1] == pytest.approx(moved.outputs["position_of_1_y"])
    assert not np.any(x[:, 0])


def test_a_gif_moves_at_the_pace_of_the_arm(moved: Any) -> None:
    picture = Image.open(BytesIO(animation(moved, "gif")))
    shown, speed = frame_instants(moved)
    assert picture.n_frames == len(shown) == 10
    assert picture.info["duration"] == 40
    assert speed == pytest.approx(1.0, rel=0.15)
    frames = []
    for k in (0, picture.n_frames - 1):
        picture.seek(k)
        frames.append(np.array(picture.convert("RGB")))
    assert np.any(frames[0] != frames[1])


def test_a_page_needs_nothing_else(moved: Any) -> None:
    page = animation(moved, "html").decode()
    assert "data:image/png;base64" in page
    assert "//" not in re.sub(r'base64,[^"]+|const frames = .*', "", page)  # no address at all
    frames = json.loads(re.search(r"const frames = (.*);", page)[1])  # type: ignore[index]
    first, last = (Image.open(BytesIO(base64.b64decode(frames[k]))) for k in (0, -1))
    assert len(frames) == 10
    assert first.size == last.size == (448, 416)
    assert np.any(np.array(first) != np.array(last))


def test_without_a_trace_there_is_nothing_to_draw(unlike: Callable[..., Scene]) -> None:
    run = simulate(unlike("clamp"), {}, 0.002, judge=False)
    with pytest.raises(ValueError, match="not traced"):
        link_angles(run)


def test_the_command_draws_and_animates(tmm_gen: Callable[..., Any], tmp_path: Path) -> None:
    words = [
        "run",
        ROOT / "scenes" / "fall10.toml",
        "--until",
        "0.05",
        "--plot",
        "a.png",
        "--animate",
        "a.gif",
    ]
    done = tmm_gen(*words, "--csv", "a.csv")
    assert done.returncode == 0, done.stderr
    with Image.open(tmp_path / "a.png") as still, Image.open(tmp_path / "a.gif") as moving:
        assert still.size[0] > 1000
        assert moving.n_frames > 1
    header = (tmp_path / "a.csv").read_text().partition("\n")[0]
    assert header == "time,tip_x,tip_y,speed_x,speed_y,root"


def test_a_chain_has_no_shape(tmm_gen: Callable[..., Any]) -> None:
    done = tmm_gen("run", ROOT / "scenes" / "thesis2.toml", "--animate", "a.gif")
    assert done.returncode == 2
    assert "--plot" in done.stderr
    assert "Traceback" not in done.stderr


def test_other_endings_are_refused(tmm_gen: Callable[..., Any]) -> None:
    done = tmm_gen("run", ROOT / "scenes" / "fall10.toml", "--animate", "a.mp4")
    assert done.returncode == 2
    assert ".gif" in done.stderr


def test_fall10_drops_by_more_than_a_third_of_its_length() -> None:
    run = simulate(load_scene(ROOT / "scenes" / "fall10.toml"), {}, 0.5, "c")
    assert np.min(run.outputs["tip_y"]) < -0.3
