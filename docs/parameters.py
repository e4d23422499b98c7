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

# What one changes in practice: the same list is printed by `heel config`. Defaults are looked up; a
# name that is gone is an error.
SETTINGS = ROOT / "apps" / "experiment" / "robot_config.cpp"
SETTING = re.compile(r"(FOLLOW|CAMERA)\((?P<path>[\w.]+),\s*(?P<when>(?:\"(?:[^\"\\]|\\.)*\"\s*)+),")
OF = {"FOLLOW": "FollowerParams", "CAMERA": "CameraSetupParams"}
ABOUT = {"Your wheels": "What the robot is stands under `robot` in the file: [RobotParams](#robotparams), with "
                        "angles in degrees. Whatever a part needs of sizes, speeds, places and views comes "
                        "from there; see `fittedTo()`.",
         "Your camera": "[How far a camera measures](camera.md#how-far-it-measures) depends on its "
                        "baseline and focal length."}


def read_settings():
    """(heading, rows of parameter and when one changes it), as the list of settings has them."""
    text = SETTINGS.read_text(encoding="utf-8")
    text = text[text.index("settingsOf(RobotConfig& c) {"):text.index("#undef FOLLOW")]
    out = []
    for part in re.split(r"^ *// (?=Your )", text, flags=re.M)[1:]:
        heading, _, rest = part.partition("\n")
        rows = [(OF[row[1]] + "." + row["path"], "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', row["when"])))
                for row in SETTING.finditer(rest)]
        out.append((heading.strip(), rows))
    return out


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
    for title, rows in read_settings():
        about = ABOUT.get(title)
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
    first = sum(len(rows) for _, rows in read_settings())
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
        "except where it has an option, or `--config` of `heel follow`, `heel live` and `heel experiment follow` "
        "names a file: `heel config > robot.yaml` prints one,",
        f"with the robot and the first {first}.",
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
