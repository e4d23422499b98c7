#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Heel authors
# SPDX-License-Identifier: BSD-3-Clause
"""Checks of the guides against the code. What is wrong is printed, one line each.

  docs_test.py code              each C++ and CMake block is that of the file named above it
  docs_test.py links             relative links, headings and pictures are there
  docs_test.py size              pages and pictures are small, the README is short
  docs_test.py commands HEEL     each `heel ...` has a verb and options that HEEL knows, and those
                                 in blocks all that it requires

A block names its file in a comment right above it, `<!-- tests/consumer/x/main.cpp -->`, or a part
of it, `<!-- tests/consumer/x/main.cpp [name] -->`: what is between two lines that are a comment
with `[name]`.
"""

import functools
import pathlib
import re
import shlex
import subprocess
import sys
import textwrap

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
LOOKED_UP = {"parameters.md", "results.md"}  # by section, not read from end to end
README_WORDS = 1300

FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.M | re.S)
SOURCE = re.compile(r"<!-- (\S+?)(?: \[([^]]+)\])? -->\n\Z")


def text_of(path):
    return path.read_text(encoding="utf-8")


def place(page, offset):
    return f"{page.relative_to(ROOT)}:{text_of(page).count(chr(10), 0, offset) + 1}"


# --- Code ---------------------------------------------------------------------------------------


def region(source, name):
    """What is between the two lines of a file that have [name] in a comment."""
    parts = re.split(rf"^ *(?://!|#) \[{re.escape(name)}\]\n", source, flags=re.M)
    return parts[1] if len(parts) == 3 else None


def without_licence(source):
    return re.sub(r"\A(?:(?://|#) SPDX-.*\n)+\n?", "", source)


def check_code():
    wrong = []
    for page in PAGES:
        text = text_of(page)
        for fence in FENCE.finditer(text):
            if fence[1] not in ("cpp", "cmake"):
                continue
            at = place(page, fence.start())
            named = SOURCE.search(text[:fence.start()])
            if not named:
                wrong.append(f"{at}: a {fence[1]} block must name its file: <!-- tests/... -->")
                continue
            file, part = ROOT / named[1], named[2]
            if not file.exists():
                wrong.append(f"{at}: there is no {named[1]}")
                continue
            there = region(text_of(file), part) if part else without_licence(text_of(file))
            if there is None:
                wrong.append(f"{at}: {named[1]} has no region [{part}]")
            elif textwrap.dedent(there) != fence[2]:
                wrong.append(f"{at}: differs from {named[1]}{f' [{part}]' if part else ''}; it is\n"
                             + textwrap.dedent(there))
    return wrong


# --- Links --------------------------------------------------------------------------------------


def anchors(page):
    """The anchors that GitHub gives the headings of a page."""
    headings = re.findall(r"^#+ (.*)$", FENCE.sub("", text_of(page)), re.M)
    plain = [re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading) for heading in headings]
    return {re.sub(r"[^\w\- ]", "", heading).strip().lower().replace(" ", "-") for heading in plain}


def check_links():
    wrong = []
    for page in PAGES:
        text = text_of(page)
        plain = FENCE.sub(lambda fence: re.sub(r"[^\n]", " ", fence[0]), text)
        for link in re.finditer(r"\]\(([^)\s]+)\)", plain):
            target, _, anchor = link[1].partition("#")
            if "://" in target:
                continue
            file = (page.parent / target).resolve() if target else page
            if not file.exists():
                wrong.append(f"{place(page, link.start())}: {target} is not there")
            elif anchor and anchor not in anchors(file):
                wrong.append(f"{place(page, link.start())}: {file.name} has no heading #{anchor}")
    used = {name for page in PAGES for name in re.findall(r"images/([\w.-]+)", text_of(page))}
    for picture in sorted((ROOT / "docs" / "images").glob("*")):
        if picture.name not in used:
            wrong.append(f"{picture.relative_to(ROOT)}: no page shows it")
    return wrong


def check_size():
    wrong = []
    for page in sorted((ROOT / "docs").glob("*.md")):
        lines = len(text_of(page).splitlines())
        if lines > 150 and page.name not in LOOKED_UP:
            wrong.append(f"{page.relative_to(ROOT)}: {lines} lines are more than 150")
    words = len(text_of(ROOT / "README.md").split())
    if words > README_WORDS:
        wrong.append(f"README.md: {words} words are more than {README_WORDS}")
    if (ROOT / ".readme" / "follow.webp").stat().st_size > 2_000_000:
        wrong.append(".readme/follow.webp: more than 2 MB")
    for picture in sorted((ROOT / "docs" / "images").glob("*")):
        if picture.stat().st_size > 80_000:
            wrong.append(f"{picture.relative_to(ROOT)}: more than 80 kB")
    return wrong


# --- Commands -----------------------------------------------------------------------------------


def heel_calls(page):
    """(where, words, whether it is in a block) of each call of heel, in a block or in backticks."""
    text = text_of(page)
    for fence in FENCE.finditer(text):
        if fence[1] in ("", "sh"):
            lines = re.sub(r"\\\n", " ", fence[2]).splitlines()
            for line in lines:
                for command in re.split(r"&&|\|", line):
                    if re.match(r"\s*(\S+/)?heel ", command):
                        yield place(page, fence.start()), shlex.split(command, comments=True), True
    plain = FENCE.sub(lambda fence: re.sub(r"[^\n]", " ", fence[0]), text)
    for inline in re.finditer(r"`(heel [^`]+)`", plain):
        yield place(page, inline.start()), shlex.split(inline[1].replace("\n", " ")), False


def check_commands(heel):
    @functools.lru_cache(maxsize=None)
    def help_of(*verbs):
        done = subprocess.run([heel, *verbs, "--help"], capture_output=True, text=True, check=False)
        return done.stdout if done.returncode == 0 else None

    def knows(help_text, option):
        return re.search(rf"(?:^|[\s,]){re.escape(option)}(?![\w-])", help_text) is not None

    wrong, calls = [], 0
    for page in PAGES:
        for where, (_, *words), is_whole in heel_calls(page):
            calls += 1
            verbs = words[:2] if words[:1] == ["experiment"] else words[:1]
            is_form = not {"VERB", "NAME", "..."}.isdisjoint(verbs)
            if not verbs or verbs[0].startswith("-") or is_form:
                continue
            help_text = help_of(*verbs)
            if help_text is None:
                wrong.append(f"{where}: there is no 'heel {' '.join(verbs)}'")
                continue
            options = {word.partition("=")[0] for word in words if word.startswith("--")}
            wrong += [f"{where}: heel {' '.join(verbs)} knows no {option}"
                      for option in sorted(options) if not knows(help_text, option)]
            required = set(re.findall(r"^ +(--[\w-]+) .*\bREQUIRED\b", help_text, re.M))
            if is_whole and not required <= options:
                missing = ", ".join(sorted(required - options))
                wrong.append(f"{where}: heel {' '.join(verbs)} needs {missing}")
    if calls == 0:
        wrong.append("no page calls heel: are the pages there?")
    return wrong


def main():
    checks = {"code": check_code, "links": check_links, "size": check_size,
              "commands": check_commands}
    if sys.argv[1:2] == [] or sys.argv[1] not in checks:
        raise SystemExit(__doc__)
    wrong = checks[sys.argv[1]](*sys.argv[2:])
    if wrong:
        raise SystemExit("\n".join(wrong))


if __name__ == "__main__":
    main()
