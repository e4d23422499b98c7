#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Heel authors
# SPDX-License-Identifier: BSD-3-Clause
"""Makes docs/parameters.md of the headers: every Params struct, with its defaults and comments.

  docs/parameters.py            writes docs/parameters.md
  docs/parameters.py --check    says whether it is what would be written; the exit code is 1 if not

The headers are uniform (clang-format, `///` before and `///<` behind a field), so lines are read,
not C++. A line of a struct that is not understood is an error, never left out.
"""

import difflib
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "parameters.md"

MODULES = {
    "cloud": "Stereo, the floor, and the set-up check.",
    "segmentation": "The background, appearance models, the plan view and its blobs.",
    "tracking": "Who is where, and which of them is the target.",
    "mapping": "Walls, obstacles, and where the robot is.",
    "planning": "Paths, driving, where to stand, and where to search.",
    "apps/follower": "The whole composed: phase 1, phase 2, and the robot's mind.",
    "apps/recording": "How recordings and bags are read.",
    "apps/simulation": "The simulated robot. A scene's YAML file has these names under `robot`, "
                       "but angles in degrees: `view_deg`, `pitch_deg`, `yaw_deg`.",
}

# Structs of parameters with another name.
OTHERS = {"BagTopics", "DriveLimits", "HeightBand", "MountingTolerance", "PersonShape"}

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
      "AcquisitionParams.min_learn_height_m"],
     "Lower all of them together; furniture begins to count, too."),
    ("A large hall",
     ["PlanViewParams.max_range_m", "GroundPlaneParams.max_range_m"],
     "Only if your baseline carries so far; see [camera.md](camera.md)."),
    ("A high camera, or one that looks down steeply",
     ["GroundPlaneParams.max_tilt_rad"],
     "From how level a camera the search for the floor starts."),
    ("The target changes to somebody else after a loss",
     ["TargetParams.min_appearance", "TargetParams.min_appearance_ratio",
      "TargetParams.appearance_frames"],
     "Higher is stricter, and the target is found again later."),
    ("The target is given up too soon, or too late",
     ["TrackerParams.max_coast_s", "FollowerParams.lost_after_s"],
     "The first is for tracks, the second for what the robot does."),
    ("Your frames come slowly (below 4 Hz) or with gaps",
     ["TrackerParams.max_gap_s", "TrackerParams.max_coast_s", "TrackerParams.confirm_frames"],
     "Longer times; fewer frames to confirm."),
    ("Your robot is wider, or faster",
     ["DriveLimits.radius_m", "DriveLimits.max_speed_mps", "GlobalPlannerParams.robot_radius_m",
      "GoalChooserParams.radius_m"],
     "`Follower` takes the first three from its `RobotDescription`; the last is set by hand."),
    ("The robot follows too closely, or from too far",
     ["FollowerParams.near_m", "FollowerParams.far_m", "GoalChooserParams.standoff_m"],
     "Keep near_m below far_m."),
    ("The robot loses its place on the map",
     ["MotionModelParams.distance_noise", "MotionModelParams.turn_noise",
      "LocalizationParams.max_particles", "LocalizationParams.lost_fit"],
     "Wheels that slip need wider noise, wider noise needs more particles."),
]

UNITS = [  # the longest endings first
    ("_mps2", "m/s²"), ("_radps2", "rad/s²"), ("_radps", "rad/s"), ("_mps", "m/s"),
    ("_per_m2", "1/m²"), ("_per_square_m", "1/m"), ("_m2", "m²"), ("_rad", "rad"), ("_px", "px"),
    ("_hz", "1/s"), ("_pm", "1/m"), ("_percent", "%"), ("_bins", "bins"), ("_pixels", "px"),
    ("_frames", "frames"),
    ("_share", "share"), ("_prob", "probability"), ("_m", "m"), ("_s", "s"),
]
BRACKETED_UNIT = re.compile(r"\[((?:1/)?(?:m|s|rad|px|deg)(?:\^\d)?(?:/s(?:\^\d)?)?)\]")


class Struct:
    def __init__(self, name, path, doc):
        self.name, self.path, self.doc = name, path, doc
        self.rows = []         # fields, and strings: headings between them
        self.constructor = ""  # comment of a constructor that changes defaults

    def fields(self):
        return [row for row in self.rows if isinstance(row, Field)]

    def field(self, name):
        for field in self.fields():
            if field.name == name:
                return field
        raise SystemExit(f"docs/parameters.py: {self.name} has no field '{name}'")


class Field:
    def __init__(self, cpp_type, name, default, doc):
        self.type, self.name, self.default, self.doc = cpp_type, name, default, doc

    def unit(self):
        bracketed = BRACKETED_UNIT.search(self.doc)
        if bracketed:
            return bracketed.group(1).replace("^2", "²").replace("^3", "³")
        if self.type in ("bool", "std::string"):
            return ""
        return next((unit for ending, unit in UNITS if self.name.endswith(ending)), "")


def comment_text(lines):
    """The text of comment lines; an empty one ends a paragraph, and lines that name a tag go."""
    text = " ".join(line if line else "\n" for line in lines if not line.startswith("@"))
    return re.sub(r" *\n *", "\n\n", text).strip()


def file_comment(lines):
    """The `@file` comment of a header: what a struct without one of its own is for."""
    start = next((i for i, line in enumerate(lines) if line == "/// @file"), None)
    if start is None:
        return ""
    words = []
    for line in lines[start + 1:]:
        if not line.startswith("///") or line == "///":
            break
        words.append(line[3:].strip())
    return " ".join(words)


FIELD = re.compile(r"^(?P<type>(?:const )?[\w:]+(?:<.*>)?) (?P<rest>.*);$")
DECLARATOR = re.compile(r"^(?P<name>\w+)(?: = (?P<value>.*)|(?P<brace>\{.*\}))?$")


def split_commas(text):
    """Splits at the commas that are outside of all brackets."""
    parts, depth = [""], 0
    for letter in text:
        depth += (letter in "({<[") - (letter in ")}>]")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts]


def parse_body(struct, lines, where):
    """Reads the lines between the braces of a struct."""
    before, heading = [], []  # comment lines that wait for what follows them
    i = 0
    while i < len(lines):
        line = lines[i].strip()
        i += 1
        if not line:
            before = []
            continue
        if line.startswith("///") and not line.startswith("///<"):
            before.append(line[3:].strip())
            continue
        if line.startswith("//") and not line.startswith("///"):
            heading.append(line[2:].strip())
            continue
        statement, _, behind = (part.strip() for part in line.partition("///<"))
        while not statement.endswith((";", "{", "}")):
            more, _, more_behind = (part.strip() for part in lines[i].strip().partition("///<"))
            statement += " " + more
            behind = (behind + " " + more_behind).strip()
            i += 1
        while i < len(lines) and lines[i].strip().startswith("///<"):
            behind += " " + lines[i].strip()[4:].strip()
            i += 1
        if statement.endswith("{"):  # a function's body
            while not re.match(r"^  \}", lines[i]):
                i += 1
            i += 1
            before = []
            continue
        if statement == f"{struct.name}();":
            struct.constructor = behind or comment_text(before)
            before = []
            continue
        if statement.startswith(("static ", "using ")) or re.match(r"^[^={]*\(", statement):
            before = []
            continue
        match = FIELD.match(statement)
        declarators = split_commas(match["rest"]) if match else []
        parsed = [DECLARATOR.match(part) for part in declarators]
        if not parsed or not all(parsed):
            raise SystemExit(f"docs/parameters.py: cannot read this line of {where}:\n{statement}")
        if heading:
            struct.rows.append(" ".join(heading))
            heading = []
        for one in parsed:
            default = one["value"] if one["value"] is not None else one["brace"]
            doc = comment_text(before) + (" " if before and behind else "") + behind
            struct.rows.append(Field(match["type"], one["name"], default, doc))
        before = []


def read_structs():
    """All structs of the modules' headers, by name."""
    structs = {}
    for module in MODULES:
        for path in sorted((ROOT / module).glob("*.hpp")):
            lines = path.read_text(encoding="utf-8").splitlines()
            comment = []
            for number, line in enumerate(lines):
                opening = re.match(r"^struct (\w+) \{$", line)
                if line.startswith("///"):
                    comment.append(line[3:].strip())
                    continue
                name = opening.group(1) if opening else ""
                if name.endswith("Params") or name in OTHERS:
                    end = lines.index("};", number)
                    where = path.relative_to(ROOT).as_posix()
                    struct = Struct(name, where, comment_text(comment) or file_comment(lines))
                    parse_body(struct, lines[number + 1:end], f"{where}, struct {name}")
                    structs[name] = struct
                comment = []
    missing = OTHERS - structs.keys()
    if missing:
        raise SystemExit(f"docs/parameters.py: no header has {', '.join(sorted(missing))}")
    return structs


# --- Defaults that code changes ------------------------------------------------------------------

ASSIGNMENT = re.compile(r"^  (?P<path>[\w.]+)(?:\[(?P<index>.*)\])? = (?P<value>.*);"
                        r"(?:\s*// (?P<why>.*))?$")


def changed_defaults(structs):
    """(where, struct, [(field's path, struct that it is in, field, new value, why)]) of functions
    that change defaults: X::X() and `Y X::name()` for structs X and Y of parameters."""
    found = []
    for module in MODULES:
        for path in sorted((ROOT / module).glob("*.cpp")):
            lines = path.read_text(encoding="utf-8").splitlines()
            for number, line in enumerate(lines):
                made = re.match(r"^(\w+)::\1\(\) \{$", line)
                function = re.match(r"^(\w+) (\w+)::(\w+)\(\) \{$", line)
                if made and made.group(1) in structs:
                    struct, title, prefix = made.group(1), f"`{made.group(1)}`", ""
                elif function and function.group(1) in structs and function.group(2) in structs:
                    struct, owner, name = function.groups()
                    title, prefix = f"`{owner}::{name}()`", "params."
                else:
                    continue
                changes = []
                for statement in lines[number + 1:lines.index("}", number)]:
                    match = ASSIGNMENT.match(statement)
                    if match and match["path"].startswith(prefix):
                        changes.append(change_of(structs, structs[struct], match, prefix))
                    elif statement.strip() not in (f"{struct} params;", "return params;"):
                        raise SystemExit("docs/parameters.py: cannot read this line of "
                                         f"{path.relative_to(ROOT)}, {title}:\n{statement}")
                found.append((title, path.relative_to(ROOT).as_posix(), struct, changes))
    return found


def change_of(structs, struct, match, prefix):
    names = match["path"][len(prefix):].split(".")
    for name in names[:-1]:
        struct = structs[struct.field(name).type]
    field = struct.field(names[-1])
    shown, default = ".".join(names), field.default
    if match["index"]:
        enumerator = re.sub(r"^static_cast<std::size_t>\((.*)\)$", r"\1", match["index"])
        shown += f"[{enumerator}]"
        kind, _, value = enumerator.partition("::")
        header = (ROOT / struct.path).read_text(encoding="utf-8")
        body = re.search(rf"enum class {kind}\b[^{{]*\{{(.*?)\}};", header, re.S).group(1)
        order = re.findall(r"^\s*(k\w+),", body, re.M)
        default = split_commas(default.strip("{}"))[order.index(value)]
    return shown, struct, field, default, match["value"], match["why"] or ""


# --- The page -----------------------------------------------------------------------------------

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
