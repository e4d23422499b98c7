# SPDX-FileCopyrightText: 2026 The Heel authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reads the structs of parameters out of the headers, for parameters.py.

The headers are uniform (clang-format, `///` before and `///<` behind a field), so lines are read,
not C++. A line of a struct that is not understood is an error, never left out.
"""

import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent

MODULES = {
    "cloud": "Stereo, the floor, and the set-up check.",
    "segmentation": "The background, appearance models, the plan view and its blobs.",
    "tracking": "Who is where, and which of them is the target.",
    "mapping": "Walls, obstacles, and where the robot is.",
    "planning": "Paths, driving, where to stand, and where to search.",
    "apps/follower": "All of it together: phase 1, phase 2, and what the robot does.",
    "apps/recording": "How recordings and bags are read.",
    "apps/simulation": "The simulated robot. A scene's YAML file has these names under `robot`, "
                       "but angles in degrees: `view_deg`, `pitch_deg`, `yaw_deg`.",
}

# Structs of parameters with another name.
OTHERS = {"BagTopics", "DriveLimits", "HeightBand", "PersonShape",
          "RobotDescription"}

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
        raise SystemExit(f"docs/read_parameters.py: {self.name} has no field '{name}'")


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
            raise SystemExit(f"docs/read_parameters.py: cannot read this line of {where}:\n{statement}")
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
        for path in sorted((ROOT / module).rglob("*.hpp")):
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
        raise SystemExit(f"docs/read_parameters.py: no header has {', '.join(sorted(missing))}")
    return structs


# --- Defaults that code changes ------------------------------------------------------------------

ASSIGNMENT = re.compile(r"^  (?P<path>[\w.]+)(?:\[(?P<index>.*)\])? = (?P<value>.*);"
                        r"(?:\s*// (?P<why>.*))?$")


def changed_defaults(structs):
    """(where, struct, [(field's path, struct that it is in, field, new value, why)]) of functions
    that change defaults: X::X() and `Y X::name()` for structs X and Y of parameters."""
    found = []
    for module in MODULES:
        for path in sorted((ROOT / module).rglob("*.cpp")):
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
                        raise SystemExit("docs/read_parameters.py: cannot read this line of "
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
