#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Heel authors
# SPDX-License-Identifier: BSD-3-Clause
"""page_for_site.py PAGE: a page as Doxygen can read it, on stdout; see docs/CMakeLists.txt.

Doxygen gives headings other anchors than GitHub, and an anchor may be on one page only: here it is
GitHub's behind the page's name, in headings and in links. A link to a file that is not in the site
becomes its text, and pictures are in one folder.
"""

import pathlib
import re
import sys

OUTSIDE = {"CHANGELOG.md", "CONTRIBUTING.md"}


def anchor(heading):
    plain = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading)
    return re.sub(r"[^\w\- ]", "", plain).strip().lower().replace(" ", "-")


def mended_link(link, page):
    text, (path, _, heading) = link[1], link[2].partition("#")
    if "://" in path:
        return link[0]
    if link[0].startswith("!"):
        return f"![{text}]({pathlib.Path(path).name})"
    if path and (not path.endswith(".md") or pathlib.Path(path).name in OUTSIDE):
        return text
    return f"[{text}](#{pathlib.Path(path).stem or page}-{heading})" if heading else link[0]


def main(file):
    page = pathlib.Path(file).stem
    parts = re.split(r"(?ms)(^```.*?^```$)", pathlib.Path(file).read_text(encoding="utf-8"))
    for i in range(0, len(parts), 2):  # those between are code
        parts[i] = re.sub(r"(?m)^##+ (.*)$", lambda h: f"{h[0]} {{#{page}-{anchor(h[1])}}}", parts[i])
        parts[i] = re.sub(r"!?\[([^]]*)\]\(([^)\s]+)\)", lambda k: mended_link(k, page), parts[i])
    sys.stdout.write("".join(parts))


if __name__ == "__main__":
    main(sys.argv[1])
