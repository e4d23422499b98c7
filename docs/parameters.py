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

# What people change first. Values are looked up; a name that is gone is an error.
FIRST = [
    ("Near things have no depth: a long baseline, or a fine camera",
     ["StereoMatcherParams.disparities"],
     "The nearest depth is focal length times baseline over it. More costs time."),
    ("Your light is poor: shadows become foreground, or the person does not",
     ["BackgroundParams.min_intensity_step", "BackgroundParams.intensity_spreads"],
     "Higher means less foreground."),
    ("The room cannot be empty for 5 s, or the person cannot stay for 10 s",
     ["AcquisitionParams.background_s", "AcquisitionParams.person_s"],
     "`heel learn --background` and `--person`."),
    ("Children, or people who sit",
     ["CandidateParams.min_height_m", "PersonShape.min_height_m", "HeightCropParams.min_m",
      "AppearanceParams.bands"],
     "Lower the heights and the bands' limits together; furniture begins to count, too."),
    ("A large hall",
     ["PlanViewParams.max_range_m", "GroundPlaneParams.max_range_m"],
     "Only if your baseline carries so far; see [camera.md](camera.md)."),
    ("A high camera, or one that looks down steeply",
     ["GroundPlaneParams.max_tilt_rad"],
     "From how level a camera the search for the floor starts."),
    ("The target changes to somebody else after a loss",
     ["TargetParams.take_above", "TargetParams.keep_above"],
     "Higher is stricter, and the target is found again later."),
    ("The target is given up too soon, or too late",
     ["TrackerParams.max_coast_s", "FollowerParams.lost_after_s"],
     "The first is for tracks, the second for what the robot does."),
    ("Your frames come slowly (below 4 Hz) or with gaps",
     ["TrackerParams.max_gap_s", "TrackerParams.max_coast_s", "TrackerParams.confirm_frames"],
     "Longer times; fewer frames to confirm."),
    ("Your robot is wider, or faster",
     ["DriveLimits.radius_m", "DriveLimits.max_speed_mps", "SearchMapParams.robot_speed_mps",
      "SearchMapParams.robot_turn_radps", "SearchMapParams.robot_clearance_m"],
     "`Follower` takes the first two, and all other radii, from its `RobotDescription`; the last "
     "three are set by hand."),
    ("The robot follows too closely, or from too far",
     ["FollowerParams.near_m", "FollowerParams.far_m", "GoalChooserParams.standoff_m"],
     "Keep near_m below far_m."),
    ("The robot loses its place on the map",
     ["MotionModelParams.distance_noise", "MotionModelParams.turn_noise",
      "LocalizationParams.max_particles", "LocalizationParams.lost_fit"],
     "Wheels that slip need wider noise, wider noise needs more particles."),
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


def first_section(structs):
    out = ["## What one changes first", "",
           "| when | parameter (default) | note |", "| --- | --- | --- |"]
    for when, names, note in FIRST:
        shown = []
        for name in names:
            struct, _, field = name.partition(".")
            default = structs[struct].field(field).default
            shown.append(f"[{struct}](#{struct.lower()})`.{field}` ({code(default)})")
        out.append(f"| {when} | {', '.join(shown)} | {note} |")
    return out + [""]


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
    out = [
        "<!-- Made by docs/parameters.py of the headers: change their comments, and run it. -->",
        "", "# Parameters", "",
        f"All {count} parameters of the library, in {len(structs)} structs: what each is, its unit "
        "and its default. The defaults suit a",
        "robot indoors, with a stereo or RGB-D camera of about 640x480, and people who walk. This "
        "page is made of the code by",
        "`docs/parameters.py`; a test compares the two.",
        "",
        "A parameter is a field. Make the struct, change the field, and give it to the "
        "constructor: `heel::PlanViewParams params;",
        "params.cell_size_m = 0.1; heel::PlanView view(params);`. A value that makes no sense is a "
        "`std::invalid_argument`. The",
        "`heel` command uses the defaults, but for what its options say. *Share* is a part of a "
        "whole, from 0 to 1; no unit: a plain",
        "number.",
        "",
    ]
    out += first_section(structs)
    out += ["## All structs", ""]
    for module in MODULES:
        names = [s.name for s in structs.values() if s.path.rpartition("/")[0] == module]
        out.append(f"- **{module}**: {', '.join(anchor(name) for name in names)}")
    out.append("")
    for module, about in MODULES.items():
        out += [f"## {module}", "", about, ""]
        for struct in structs.values():
            if struct.path.rpartition("/")[0] == module:
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
