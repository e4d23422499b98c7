#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Heel authors
# SPDX-License-Identifier: BSD-3-Clause
"""Makes docs/parameters.md of the headers: every Params struct, with its defaults and comments.

  docs/parameters.py            writes docs/parameters.md
  docs/parameters.py --check    says whether it is what would be written; the exit code is 1 if not
"""

import difflib
import re
import sys

sys.dont_write_bytecode = True
from read_parameters import MODULES, ROOT, changed_defaults, read_structs

PAGE = ROOT / "docs" / "parameters.md"

# What one changes in practice, and why: (heading, what it is about, rows of parameter and when).
# A parameter is named from a struct that one fills, through its members. Defaults are looked up; a
# name that is gone is an error. They are marked nowhere else.
FIRST = [
    ("Your robot", "`Follower` is told of the robot by a `RobotDescription`, and sets the radii, "
     "heights and limits of its parts by it. The other parameters here are set by hand.", [
        ("RobotDescription.drive.radius_m", "Your robot is wider or narrower than a Pioneer 3-DX."),
        ("RobotDescription.drive.max_speed_mps", "Your robot may drive faster, or must be slower. "
         "Everything in [results](results.md) was measured at 0.3."),
        ("RobotDescription.height_m", "Your robot is taller or lower: what hangs lower than this "
         "is an obstacle."),
        ("RobotDescription.scanner_height_m", "Your laser is mounted higher or lower."),
        ("FollowerParams.search.map.robot_speed_mps", "You changed the robot's speed: the search "
         "plans its time with this one."),
        ("FollowerParams.search.map.robot_turn_radps", "You changed how fast the robot turns."),
        ("FollowerParams.search.map.robot_clearance_m", "You changed the radius: this is the "
         "radius and 0.09 m."),
        ("FollowerParams.localization.motion.distance_noise", "The wheels slip, and the robot "
         "loses its place: raise it. More noise needs more particles."),
        ("FollowerParams.localization.motion.turn_noise", "The wheels slip in turns: raise it."),
    ]),
    ("Your camera", "[How far a camera measures](camera.md#how-far-it-measures) depends on its "
     "baseline and focal length.", [
        ("FollowerParams.perception.stereo.disparities", "Near things have no depth, as with a "
         "long baseline or many pixels. The nearest depth is focal length times baseline over "
         "this; more takes more time. Set it in `learn.stereo` and in `CameraSetupParams::stereo` "
         "as well."),
        ("CameraSetupParams.ground.max_tilt_rad", "The camera looks down steeply, and the floor "
         "is not found: raise it."),
        ("FollowerParams.perception.tracker.confirm_frames", "Frames come at less than 4 Hz: "
         "lower it, and `confirm_hits` with it."),
        ("FollowerParams.perception.tracker.max_coast_s", "Tracks end too soon while somebody is "
         "hidden, or too late."),
        ("FollowerParams.perception.tracker.max_gap_s", "Frames come with longer gaps than this: "
         "raise it."),
    ]),
    ("Your building", "", [
        ("FollowerParams.perception.plan_view.max_range_m", "You follow in a large hall, with a "
         "camera that measures so far."),
        ("CameraSetupParams.ground.max_range_m", "The floor near the camera is hidden, and the "
         "camera measures further."),
        ("FollowerParams.learn.acquisition.detector.height.max_m", "Your ceiling is lower than "
         "this."),
        ("FollowerParams.paths.unknown_is_free", "Your map has gaps through which the robot must "
         "go."),
        ("FollowerParams.obstacles.max_memory_s", "Many people walk about, and the robot avoids "
         "places that they have left: lower it."),
        ("FollowerParams.localization.max_particles", "The robot is not found in a large "
         "building: raise it."),
        ("FollowerParams.localization.lost_fit", "The robot says that it is lost where furniture "
         "hides the walls: lower it."),
    ]),
    ("Your people, and your taste", "", [
        ("FollowerParams.learn.acquisition.background_s", "The room can't be empty for so long "
         "(`heel learn --background`)."),
        ("FollowerParams.learn.acquisition.person_s", "The person can't stay for so long (`heel "
         "learn --person`)."),
        ("FollowerParams.learn.acquisition.detector.person.min_height_m", "You learn children, or "
         "people who sit: lower it. Furniture then begins to count, too."),
        ("FollowerParams.perception.candidates.min_height_m", "You follow children, or people who "
         "sit: lower it."),
        ("FollowerParams.perception.target.take_above", "Wrong people are followed: raise it. The "
         "right one is then found later. `keep_above` stays below it."),
        ("FollowerParams.goal.standoff_m", "The robot comes too close, or stays too far away. "
         "`near_m` and `far_m` go with it."),
        ("FollowerParams.near_m", "The robot should stop nearer to the person, or further away."),
        ("FollowerParams.far_m", "The robot should drive on sooner, or later. It is more than "
         "`near_m`."),
        ("FollowerParams.search.budget_s", "The robot should search longer for a lost person, or "
         "give up sooner."),
    ]),
]


def code(text):
    return f"`{text}`" if text else ""


def anchor(name):
    return f"[{name}](#{name.lower()})"


def in_table(text):
    return text.replace("|", "\\|").replace("\n\n", " ")


def default_of(field, structs):
    if field.default is not None:
        return code(field.default)
    if field.type in structs:
        return "see there"
    if field.type in ("int", "double", "bool"):
        raise SystemExit(f"docs/parameters.py: {field.name} has no default")
    if field.type.startswith("std::optional"):
        return "none"
    return '`""`' if field.type == "std::string" else "`{}`"


def struct_section(struct, structs, users, changed):
    out = [f"### {struct.name}", ""]
    where = [f"[`{struct.path}`](../{struct.path})"]
    where += [f"`{field}` of {anchor(user)}" for user, field in users.get(struct.name, [])]
    out += [" · ".join(where), ""]
    if struct.doc:
        out += [struct.doc, ""]
    out += ["| parameter | unit | default | meaning |", "| --- | --- | --- | --- |"]
    for row in struct.rows:
        if isinstance(row, str):
            out.append(f"| *{in_table(row)}* | | | |")
            continue
        meaning = row.doc or (f"See {anchor(row.type)}." if row.type in structs else "")
        if row.type in structs and row.doc:
            meaning += f" See {anchor(row.type)}."
        out.append(f"| `{row.name}` | {row.unit()} | {default_of(row, structs)} "
                   f"| {in_table(meaning)} |")
    out.append("")
    for title, path, _, changes in changed.get(struct.name, []):
        out += [f"{title} ([`{path}`](../{path})) changes these defaults of its parts:", "",
                "| parameter | default of the part | here | why |", "| --- | --- | --- | --- |"]
        out += [f"| `{shown}` | {code(default)} | {code(value)} | {in_table(why)} |"
                for shown, _, _, default, value, why in changes]
        out.append("")
    return out


def find(path, structs):
    """(struct, field, default there) of a parameter named through the members of a struct."""
    root, *names = path.split(".")
    struct, changes = structs[root], changes_of(root, structs)
    for name in names[:-1]:
        struct = structs[struct.field(name).type]
    field = struct.field(names[-1])
    return struct, field, changes.get(".".join(names), field.default)


def changes_of(root, structs):
    return {shown: value for title, _, _, changes in changed_defaults(structs)
            if title == f"`{root}`" for shown, _, _, _, value, _ in changes}


def first_section(structs):
    out = []
    for title, about, rows in FIRST:
        out += [f"### {title}", ""] + ([about, ""] if about else [])
        out += ["| parameter | unit | default | change it when |", "| --- | --- | --- | --- |"]
        for path, when in rows:
            struct, field, default = find(path, structs)
            shown = path.replace(".", "::", 1)
            out.append(f"| [`{shown}`](#{struct.name.lower()}) | {field.unit()} | {code(default)} "
                       f"| {when} |")
        out.append("")
    return out


def make_page():
    structs = read_structs()
    users = {}
    for struct in structs.values():
        for field in struct.fields():
            if field.type in structs:
                users.setdefault(field.type, []).append((struct.name, field.name))
    changed = {}
    for change in changed_defaults(structs):
        owner = re.match(r"`(\w+)", change[0]).group(1)
        changed.setdefault(owner, []).append(change)
    for struct in structs.values():
        if struct.constructor and struct.name not in changed:
            raise SystemExit(f"docs/parameters.py: {struct.name}'s constructor was not found")

    count = sum(1 for struct in structs.values() for field in struct.fields()
                if field.type not in structs)
    first = sum(len(rows) for _, _, rows in FIRST)
    out = [
        "<!-- Made by docs/parameters.py of the headers: change their comments, and run it. -->",
        "", "# Parameters", "",
        f"Heel has {count} parameters in {len(structs)} structs. Their defaults suit a robot "
        "indoors, a stereo or RGB-D camera",
        f"of about 640x480, and people who walk. First come the {first} that one changes in "
        "practice, then [all of",
        "them](#all-structs). The page is made of the headers by `docs/parameters.py`; a "
        "test compares the two.",
        "",
        "A parameter is a field of a struct. Make the struct, change the field, and give it to a "
        "constructor or function:",
        "`heel::FollowerParams params; params.near_m = 0.8; heel::Follower follower(robot, walls, "
        "plan, start, params);`. A value",
        "out of its range throws `std::invalid_argument`. The `heel` command uses the defaults, "
        "except where it has an option.",
        "A *share* is a part of a whole, from 0 to 1; a parameter without a unit is a plain "
        "number.",
        "",
        "## What one changes", "",
    ]
    out += first_section(structs)
    out += ["## All structs", ""]
    for module in MODULES:
        names = [s.name for s in structs.values() if s.path.startswith(module + "/")]
        out.append(f"- **{module}**: {', '.join(anchor(name) for name in names)}")
    out.append("")
    for module, about in MODULES.items():
        out += [f"## {module}", "", about, ""]
        for struct in structs.values():
            if struct.path.startswith(module + "/"):
                out += struct_section(struct, structs, users, changed)
    return "\n".join(out).rstrip() + "\n"


def main():
    page = make_page()
    if sys.argv[1:] == ["--check"]:
        there = PAGE.read_text(encoding="utf-8") if PAGE.exists() else ""
        if there == page:
            return
        sys.stdout.writelines(difflib.unified_diff(
            there.splitlines(True), page.splitlines(True), "docs/parameters.md",
            "made of the code", n=0))
        raise SystemExit("docs/parameters.md is not what the headers say: run docs/parameters.py, "
                         "and commit the page")
    if sys.argv[1:]:
        raise SystemExit(__doc__)
    PAGE.write_text(page, encoding="utf-8")
    print(f"wrote {PAGE}")


if __name__ == "__main__":
    main()
