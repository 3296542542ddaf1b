"""What headers say of the elements of arrays is where the parts' own numbers are."""

from __future__ import annotations

from pathlib import Path

from tmm_gen.emit.places import places
from tmm_gen.scene import load_scene

ROOT = Path(__file__).resolve().parents[2]


def told(text: str) -> dict[str, range]:
    found = {}
    for each in text.split(", "):
        name, _, numbers = each.partition(" ")
        first, _, last = numbers.partition(" to ")
        found[name] = range(int(first), int(last or first) + 1)
    return found


def test_in_a_plane() -> None:
    scene = load_scene(ROOT / "scenes" / "elbow.toml")
    found = places(scene)
    motors = [k for k, joint in enumerate(scene.joints) if joint.rotor_inertia]
    assert [place[0] for place in told(found["joints"]).values()] == motors
    links = told(found["links"])
    assert [k for place in links.values() for k in place] == list(range(scene.stations))
    for name, length in (("upper", scene.source.data["beam"][0]["length"]), ("forearm", scene.reach)):
        assert abs(sum(scene.links[k].length for k in range(links[name].stop)) - length) < 1e-12


def test_in_space_and_without_names() -> None:
    scene = load_scene(ROOT / "examples" / "space" / "reach3.toml")
    assert scene.spatial is not None
    for name, place in told(places(scene)["joints"]).items():
        assert all(scene.spatial.joints[k].name.startswith(name) for k in place)
        assert (len(place) > 1) == (name in ("upper", "forearm"))
    assert places(load_scene(ROOT / "scenes" / "arm10.toml")) == {}
