"""Reading the sidecar of a URDF: a TOML file with ``[joint.NAME]`` and ``[link.NAME]``."""

from __future__ import annotations

import tomllib
from pathlib import Path

from tmm_gen.errors import UserError
from tmm_gen.reading import read_file
from tmm_gen.scene.locate import locate
from tmm_gen.scene.syntax import syntax_problem
from tmm_gen.scene.table import STATION_LIMIT, closest
from tmm_gen.urdf.cross_section import MEASURES, CrossSection, cross_section
from tmm_gen.urdf.faults import Faults, UrdfError
from tmm_gen.urdf.flexibility import Flexibility, JointGives, LinkGives
from tmm_gen.urdf.keys import Keys
from tmm_gen.urdf.robot import ONE_WAY, Robot

OF_JOINTS = ("stiffness", "damping", "rotor_inertia", "gear", "lock")
OF_LINKS = (
    "links",
    "E",
    "G",
    "section",
    "bending_stiffness",
    "torsional_stiffness",
    "polar_inertia_per_length",
    "damping_time",
    "to",
    "end",
)
"""Keys of the tables of joints and of links."""


def read_sidecar(path: Path, robot: Robot) -> Flexibility:
    """Read what gives way in a robot.

    Parameters
    ----------
    path : Path
        A TOML file in UTF-8.
    robot : Robot
        Whose joints and links it names.

    Raises
    ------
    UserError
        If the file cannot be read or a key is at fault; all of them are named.
    """
    try:
        text = read_file(path).decode("utf-8-sig")
    except FileNotFoundError:
        raise UserError(f"{path}: no such file. Check the path.") from None
    except UnicodeDecodeError:
        raise UserError(f"{path}: is not UTF-8 text. Save the file as UTF-8.") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise UserError(f"{path}: {reason}. Name a TOML file that can be read.") from None
    try:
        data = tomllib.loads(text)
        lines = locate(text)
    except RecursionError:
        raise UserError(f"{path}: is nested too deeply. Remove superfluous brackets.") from None
    except ValueError as error:
        raise UrdfError((syntax_problem(text, str(path), error),)) from None
    faults = Faults(str(path))
    top = Keys(faults, lines, (), data)
    top.only(("joint", "link"))
    joints = {n: _joint(k, robot) for n, k in top.tables("joint", robot.joints, "joint").items()}
    links = {n: _link(k, robot) for n, k in top.tables("link", robot.links, "link").items()}
    faults.settle()
    return Flexibility(str(path), joints, {name: link for name, link in links.items() if link is not None})


def _joint(keys: Keys, robot: Robot) -> JointGives:
    keys.only(OF_JOINTS)
    stiffness = keys.number("stiffness", above=0.0)
    rotor, gear = keys.number("rotor_inertia", least=0.0), keys.number("gear", above=0.0)
    lock = keys.number("lock")
    kind = robot.joints[str(keys.path[-1])].kind
    if "lock" in keys.values and (others := [key for key in keys.values if key != "lock"]):
        keys.fault("lock", f"leaves nothing for {', '.join(others)} to act on", "Leave out one or the other.")
    elif "lock" in keys.values and kind not in ONE_WAY:
        keys.fault("lock", f"is for joints of one way to move; this one is {kind}", "Leave it out.")
    elif "lock" not in keys.values and kind == "fixed":
        keys.fault("", "is a fixed joint, which does not turn", 'Make it type="revolute" in the URDF.')
    elif stiffness is not None and not rotor:
        keys.fault(
            "",
            "has a gear that gives way and no rotor_inertia: nothing would be left to hold the motor's side",
            "Add for example `rotor_inertia = 2e-5`.",
        )
    return JointGives(
        keys.line,
        stiffness,
        keys.number("damping", least=0.0),
        rotor or 0.0,
        1.0 if gear is None else gear,
        lock,
    )


def _link(keys: Keys, robot: Robot) -> LinkGives | None:
    keys.only(OF_LINKS)
    links = keys.values.get("links")
    if isinstance(links, bool) or not isinstance(links, int) or not 1 <= links <= STATION_LIMIT:
        keys.fault("links", "must be a whole number from 1: the cells of the beam", "Write `links = 5`.")
        links = 1
    young, shear = keys.number("E", above=0.0), keys.number("G", above=0.0)
    section = _section(keys)
    bending = _bending(keys)
    torsion = keys.number("torsional_stiffness", above=0.0)
    if bending is None and "bending_stiffness" not in keys.values:
        if young is None or section is None:
            missing = [name for name in ("E", "section") if name not in keys.values]
            if missing:
                remedy = 'Write `E = 70e9` and `section = {kind = "tube", outer = 0.04, inner = 0.036}`, or '
                keys.fault(
                    "",
                    f"has no {' and no '.join(missing)} to bend by",
                    f"{remedy}`bending_stiffness = [15.0, 15.0]`.",
                )
        else:
            bending = (young * section.second_y, young * section.second_z)
    elif young is not None:
        keys.fault("E", "says again what bending_stiffness says", "Leave out one of them.")
    if shear is not None and torsion is not None:
        keys.fault("G", "says again what torsional_stiffness says", "Leave out one of them.")
    elif shear is not None and section is None and "section" not in keys.values:
        keys.fault("G", "needs a section", "Add one, or write torsional_stiffness in place of G.")
    elif shear is not None and section is not None:
        torsion = shear * section.torsion
    to = keys.text("to")
    leaving = [joint.name for joint in robot.joints.values() if joint.parent == str(keys.path[-1])]
    if to is not None and to not in leaving:
        remedy = closest(to, leaving) if leaving else "Write `end = [x, y, z]` in the link's frame instead."
        keys.fault("to", "is no joint that stands on this link", remedy)
    end = keys.numbers("end", 3)
    if to is not None and end is not None:
        keys.fault("end", "says again what `to` says", "Leave out one of them.")
    if bending is None:
        return None
    return LinkGives(
        keys.line,
        links,
        bending,
        torsion,
        keys.number("polar_inertia_per_length", above=0.0),
        None if section is None else (section.second_y + section.second_z) / section.area,
        keys.number("damping_time", least=0.0) or 0.0,
        to,
        None if end is None else (end[0], end[1], end[2]),
    )


def _bending(keys: Keys) -> tuple[float, float] | None:
    """Return EI about y and z, given as two numbers or as one for both."""
    if not isinstance(keys.values.get("bending_stiffness"), list):
        both = keys.number("bending_stiffness", above=0.0)
        return None if both is None else (both, both)
    found = keys.numbers("bending_stiffness", 2)
    if found is not None and min(found) <= 0.0:
        keys.fault("bending_stiffness", "must be greater than 0", "Correct it.")
        return None
    return None if found is None else (found[0], found[1])


def _section(keys: Keys) -> CrossSection | None:
    section = keys.table("section")
    if section is None:
        return None
    kind = section.text("kind")
    if kind not in MEASURES:
        section.fault("kind", "must be the shape of the section", closest(kind, tuple(MEASURES)))
        return None
    wanted = MEASURES[kind]
    section.only(("kind", *wanted))
    for key in wanted:
        if key not in section.values:
            section.fault("", f"has no {key}", f"Add for example `{key} = 0.04`, in m.")
    measures = [section.number(key, above=0.0) for key in wanted]
    if any(measure is None for measure in measures):
        return None
    sizes = tuple(float(measure or 0.0) for measure in measures)
    if kind == "tube" and sizes[1] >= sizes[0]:
        section.fault("inner", "must be less than outer", "Exchange them if they are.")
        return None
    return cross_section(kind, sizes)
