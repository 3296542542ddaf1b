"""The gallery's pictures: each scene in motion, from its start on.

``python website/pictures.py`` writes ``docs/figures/gallery/NAME.svg`` of every scene whose picture is not of its
content; ``python website/pictures.py NAME ...`` writes those, whatever lies there. The site takes them as they lie,
since to derive and run all scenes takes a minute.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from tmm_gen.scene import Scene, load_scene
from tmm_gen.simulate.places import node_places, outline
from tmm_gen.simulate.run import simulate
from tmm_gen.simulate.skeleton import Skeleton
from tmm_gen.study.excitation import excitation

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ("scenes", "examples/space")
PICTURES = ROOT / "docs" / "figures" / "gallery"
WIDE, HIGH = 320.0, 180.0
EDGE = 12.0
"""Left free around the drawing."""
POSES, WAY = 8, 40
"""Instants at which the arm is drawn, and those through which the ways of its ends are."""
FAR = 1.4
"""Where a motion that goes on is broken off: in sizes of the arm that a point of it has come."""
MOST_STEPS = 3000

Lines = list[np.ndarray]


def gallery_scenes() -> list[Path]:
    """Return the files of all scenes of the gallery, in its order."""
    return [path for folder in FOLDERS for path in sorted((ROOT / folder).glob("*.toml"))]


def picture(scene: Scene) -> str:
    """Return the picture of a scene.

    Raises
    ------
    FileNotFoundError
        If there is none of the scene as it is.
    """
    file = PICTURES / f"{scene.name}.svg"
    text = file.read_text() if file.exists() else ""
    if _stamp(scene) not in text:
        raise FileNotFoundError(f"{file} is not of the scene as it is: run `python website/pictures.py`")
    return text.rstrip("\n")


def drawn(scene: Scene) -> str:
    """Simulate a scene under the loads that studies have, and return it in motion as SVG."""
    until = min(excitation(scene).until, MOST_STEPS * scene.integrator.step)
    signals = excitation(scene, until=until).signals
    run = simulate(scene, signals, until, "c", trace=True, judge=False, substeps=True)
    assert run.trace is not None  # it was asked for
    angles = run.trace.angle if scene.spatial is not None else run.trace.angle[:, scene.hub :]
    course = [list(_lines(scene, each)) for each in angles]
    points = np.array([np.concatenate(pose) for pose in course])
    away = np.linalg.norm(points - points[0], axis=2).max(axis=1)
    size = np.ptp(points[0], axis=0).max()
    far = np.flatnonzero(away >= FAR * size)
    last = int(far[0]) if far.size and not scene.model.linear else int(np.argmax(away))
    return _svg(scene, [course[k] for k in _spread(last, POSES)], [course[k] for k in _spread(last, WAY)])


def _spread(last: int, count: int) -> list[int]:
    return sorted({round(last * k / (count - 1)) for k in range(count)})


def _stamp(scene: Scene) -> str:
    return f'data-scene="{scene.digest[:16]}"'


def _svg(scene: Scene, poses: list[Lines], course: list[Lines]) -> str:
    """Draw poses, the later the darker, and the ways that ends of lines take."""
    points = np.concatenate([line for pose in (*poses, *course) for line in pose])
    low, high = points.min(axis=0), points.max(axis=0)
    stretch = (np.array([WIDE, HIGH]) - 2 * EDGE) / np.maximum(high - low, 1e-9)
    scale = stretch if scene.model.linear else np.full(2, stretch.min())
    tall = scale[1] * (high[1] - low[1]) + 2 * EDGE
    middle = (low + high) / 2

    def on_page(line: np.ndarray) -> str:
        at = (line - middle) * scale * [1, -1] + [WIDE / 2, tall / 2]
        return " ".join(f"{x:.1f},{y:.1f}" for x, y in at)

    ways = [np.array([pose[k][-1] for pose in course]) for k in range(len(course[0]))]
    parts = [f'<polyline points="{on_page(way)}" stroke-width="1" stroke-dasharray="3 3"/>' for way in ways]
    for number, pose in enumerate(poses, start=1):
        shade = f' stroke-opacity="{0.12 + 0.88 * (number / len(poses)) ** 2:.2f}"'
        parts += [f'<polyline points="{on_page(line)}"{shade}/>' for line in pose]
    told = f'{_stamp(scene)} viewBox="0 0 {WIDE:g} {tall:.0f}" role="img" aria-label="{scene.name} in motion"'
    style = (
        'fill="none" stroke="currentColor" stroke-width="3" stroke-linejoin="round" stroke-linecap="round"'
    )
    return f'<svg xmlns="http://www.w3.org/2000/svg" {told} {style}>{"".join(parts)}</svg>\n'


def _lines(scene: Scene, angles: np.ndarray) -> Iterator[np.ndarray]:
    """Yield the lines of one pose: in a plane, in space seen from the side, or of a chain angles along its stations."""
    if scene.spatial is not None:
        skeleton = Skeleton(scene.spatial)
        x, y, z = skeleton.points(angles[None])[0].T
        seen = np.stack([0.8 * x + 0.6 * y, z + 0.25 * (0.8 * y - 0.6 * x)], axis=1)
        yield from (seen[list(line)] for line in skeleton.lines)
    elif scene.model.linear:
        yield np.stack([np.arange(scene.stations + 1.0), np.concatenate([[0.0], angles])], axis=1)
    else:
        places = np.stack([outline(scene, each)[0] for each in node_places(scene, angles[None])], axis=1)
        for part in np.split(places, np.flatnonzero(np.isnan(places[:, 0]))):
            yield part[~np.isnan(part[:, 0])]


def main(names: list[str]) -> None:
    """Write pictures, by default those that are missing or of another content."""
    PICTURES.mkdir(exist_ok=True)
    for path in gallery_scenes():
        scene = load_scene(path)
        file = PICTURES / f"{scene.name}.svg"
        if scene.name in names or (not names and not (file.exists() and _stamp(scene) in file.read_text())):
            file.write_text(drawn(scene))
            print(f"wrote {file}")


if __name__ == "__main__":
    main(sys.argv[1:])
