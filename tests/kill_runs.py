#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Heel authors
# SPDX-License-Identifier: BSD-3-Clause
"""Kills runs of heel at random moments, lets them run into a full disk, and runs two at once.

  kill_runs.py HEEL [--runs 1000] [--seed 1] [--folder EMPTY_FOLDER]

Each run replaces results that are there already. Whatever happens to it:

  - the results are those that were there, or the run's own, whole: the same bytes as an undisturbed
    run gives (but for times and films, which differ from run to run). Each verb is called in two
    ways with other results, so a mixture of both would be seen;
  - files of somebody else, in the folder and beside it, stay as they are;
  - the next run works, and nothing of the one before is left;
  - a run that was asked to stop ends with 130, and what it wrote says that it is not complete; one
    of two at once says that the other one writes there; one on a full disk ends with 1.

What is not so is printed, and the script fails. A full disk is a small tmpfs where one can be
mounted (as root, or in a namespace of one's own), else a limit on the size of files.
"""

import argparse
import hashlib
import json
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

SCENE = """
name: hall
duration_s: {duration}
floor: {{material: parquet, color: oak}}
wall_surface: {{material: roughcast, color: beige}}
walls:
  - {{from: [0, -2], to: [0, 2]}}
  - {{from: [0, 2], to: [5, 2]}}
  - {{from: [5, 2], to: [5, -2]}}
  - {{from: [2.6, 1], to: [5, 1]}}
  - {{from: [5, -2], to: [0, -2]}}
lights:
  - {{lamp: [2.5, 0, 2.4], power: 30, radius_m: 0.2}}
people:
  - name: rosa
    height_m: 1.8
    start: [4.4, 1.5]
    outfit: {{top: {{color: red}}, trousers: {{color: charcoal}}}}
    path: [{{wait_s: 3.5}}, {{to: [2.1, 1.5]}}, {{to: [2.3, 0.3]}}, {{to: [3.5, -0.6]}},
           {{to: [3, 0.4]}}, {{to: [2.6, -0.8]}}, {{to: [3.6, 0.2]}}, {{to: [2.8, -0.5]}}]
robot:
  start: [0.5, 0]
  camera: {{at: [0.05, 0.06, 1.13], pitch_deg: 5.7, width: 160, height: 120, view_deg: 60,
           rate_hz: 5}}
"""
# What differs from run to run, by itself or because it holds times.
VARIES = {"timing.csv", "tracks.mp4", "follow.mp4", "report.html"}


class Fault(Exception):
    """Something that must not happen."""


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def content(folder):
    """The results in a folder: digests of what must be the same, names of the rest."""
    files = {}
    for path in sorted(folder.rglob("*")):
        if path.is_file() and path.name != "mine.txt" and not path.name.endswith(".heel"):
            name = str(path.relative_to(folder))
            files[name] = "" if path.name in VARIES else digest(path)
    return files


class Verb:
    """A verb with its own folder, in which its results are."""

    def __init__(self, heel, folder, name, call, other, results="out", shared=False):
        """`other`: what is added to the call for other results. `shared`: somebody's file is among
        the results, too."""
        self.name, self.folder = name, folder / (name + "_shared" if shared else name)
        self.folder.mkdir()
        self.out = self.folder / results
        first = [heel, name, *[str(word) for word in call], "--out", str(self.out)]
        self.calls = [first, [*first, *other]]
        self.mine = [self.folder / "mine.txt"] + ([self.out / "mine.txt"] if shared else [])
        for mine in self.mine:
            mine.parent.mkdir(exist_ok=True)
            mine.write_text("somebody's")
        self.references = []
        for way in range(2):
            started = time.monotonic()
            self.finish(way)
            self.duration_s = time.monotonic() - started
            self.references.append(content(self.folder))
        if self.references[0] == self.references[1]:
            raise Fault(f"{name}: both calls have the same results")

    def start(self, way, **more):
        return subprocess.Popen(self.calls[way], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                errors="replace", **more)

    def clear(self):
        """What may stay of runs that were stopped: results that say that they are not complete."""
        for kept in self.folder.glob("*.[0-9]*"):
            shutil.rmtree(kept)

    def finish(self, way):
        run = subprocess.run(self.calls[way], capture_output=True, text=True, errors="replace")
        if run.returncode != 0:
            raise Fault(f"{self.name}: the next run failed ({run.returncode}): {run.stderr[-300:]}")

    def check(self, what, ways=(0, 1)):
        """The results are whole, of one of the ways, and other people's files are there."""
        for mine in self.mine:
            if not mine.exists() or mine.read_text() != "somebody's":
                raise Fault(f"{self.name}, {what}: somebody's file is gone or changed")
        found = {name: value for name, value in content(self.folder).items()
                 if ".heel-part/" not in name and not is_aside(name)}
        self.check_whole(found, what, ways)

    def check_whole(self, found, what, ways):
        if all(found != self.references[way] for way in ways):
            wrong = sorted(set(found.items()) ^ set(self.references[ways[0]].items()))[:6]
            raise Fault(f"{self.name}, {what}: the results are not whole: {wrong}")

    def check_aside(self, what):
        """What a stopped run left beside says that it is not complete."""
        for summary in self.folder.glob("*.[0-9]*/summary.json"):
            if json.loads(summary.read_text())["complete"]:
                raise Fault(f"{self.name}, {what}: {summary} says that it is complete")

    def check_clean(self, what):
        left = [str(path) for path in self.folder.glob(".*part*")]
        if left:
            raise Fault(f"{self.name}, {what}: left {left}")


def is_aside(name):
    return name.split("/")[0].rpartition(".")[2].isdigit()


def killed(verb, draw):
    """One run that a signal meets at a random moment."""
    name = draw.choice(["SIGKILL", "SIGTERM", "SIGINT"])
    run = verb.start(draw.randrange(2))
    # Half of them about the end, where the results get their place.
    time.sleep(verb.duration_s * draw.uniform(draw.choice([0.0, 0.8]), 1.1))
    run.send_signal(getattr(signal, name))
    _, err = run.communicate(timeout=120)
    expected = {0, -9} if name == "SIGKILL" else {0, 130, -2, -15}
    if run.returncode not in expected:
        raise Fault(f"{verb.name}, {name}: ended with {run.returncode}: {err[-300:]}")
    # Until main() has begun, a signal ends a process in its own way.
    if run.returncode in (-2, -15) and "%" in err:
        raise Fault(f"{verb.name}, {name}: ended by the signal itself")
    verb.check(name)
    verb.check_aside(name)
    return name


def twice(verb, _):
    """Two runs at once: one says so, or comes after the other."""
    runs = [verb.start(0), verb.start(1)]
    ends = []
    for run in runs:
        _, err = run.communicate(timeout=240)
        ends.append(run.returncode)
        if run.returncode not in (0, 2) or (run.returncode == 2 and "another run" not in err):
            raise Fault(f"{verb.name}, two at once: {run.returncode}: {err[-300:]}")
    if 0 not in ends:
        raise Fault(f"{verb.name}, two at once: none worked")
    verb.check("two at once")
    verb.check_clean("two at once")
    return "two at once"


def full(verb, draw, mounts):
    """One run on a disk that is full at a random moment."""
    size, way = draw.choice([4, 16, 64, 256, 4096]) * 1024, draw.randrange(2)
    if mounts:
        disk, copy = verb.folder.parent / "disk", verb.folder.parent / "copy"
        disk.mkdir(exist_ok=True)
        shutil.rmtree(copy, ignore_errors=True)
        call = [str(disk / verb.out.name) if word == str(verb.out) else word
                for word in verb.calls[way]]
        # Without the mount, what is there when the run has ended would be gone.
        script = ('mount -t tmpfs -o size="$1" none "$2" && d="$2" && copy="$3" && shift 3 && "$@"; '
                  'code=$?; cp -r "$d" "$copy"; exit $code')
        run = subprocess.run([*mounts, "sh", "-c", script, "sh", str(size), str(disk), str(copy),
                              *call], capture_output=True, text=True, errors="replace", timeout=240)
        if run.returncode == 0:
            verb.check_whole(content(copy), "full disk", (way,))
        elif any(copy.iterdir()):
            raise Fault(f"{verb.name}, full disk: left {list(copy.iterdir())}")
    else:
        run = verb.start(way, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE,
                                                                    (size, size)))
        run.communicate(timeout=240)
        verb.check("full disk")
        verb.check_clean("full disk")
    if run.returncode not in (0, 1):
        raise Fault(f"{verb.name}, full disk of {size}: ended with {run.returncode}")
    return "full disk"


def mount_call():
    """How a file system of one's own is mounted, if it can be."""
    for call in (["unshare", "-m"], ["unshare", "-rm"]):
        test = [*call, "sh", "-c", "mount -t tmpfs none /mnt"]
        try:
            if subprocess.run(test, capture_output=True).returncode == 0:
                return call
        except FileNotFoundError:
            break
    return None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("heel", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder", type=pathlib.Path)
    options = parser.parse_args()
    heel = str(options.heel.resolve())
    draw = random.Random(options.seed)
    folder = options.folder or pathlib.Path(tempfile.mkdtemp(prefix="heel_kill_"))
    try:
        return run_all(heel, folder, options.runs, draw)
    finally:
        if options.folder is None:
            shutil.rmtree(folder, ignore_errors=True)


def run_all(heel, folder, count, draw):
    scene, short = folder / "hall.yaml", folder / "short.yaml"
    scene.write_text(SCENE.format(duration=13))
    short.write_text(SCENE.format(duration=1))
    recording, model = folder / "rec", folder / "person.yaml"
    for call in (["simulate", scene, "--out", recording],
                 ["learn", recording, "--out", model, "--background", "3", "--person", "5"]):
        subprocess.run([heel, *map(str, call)], check=True, capture_output=True)
    clouds = folder / "clouds"
    clouds.mkdir()
    for number in range(3):
        points = "".join(f"{0.01 * i} {0.02 * (i % 50)} 2 {0xC02030 if i % 2 else 0x90A0A0}\n"
                         for i in range(20000))
        (clouds / f"{number}.pcd").write_text(
            "VERSION .7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\n"
            "WIDTH 20000\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 20000\nDATA ascii\n" + points)
    work = folder / "work"
    work.mkdir()
    learn = ["--background", "3", "--person", "5"]
    verbs = [
        Verb(heel, work, "track", [recording, "--model", model], ["--to", "12"]),
        Verb(heel, work, "track", [recording, "--model", model, "--no-film"], ["--to", "12"],
             shared=True),
        Verb(heel, work, "simulate", [short], ["--seed", "2"]),
        Verb(heel, work, "follow", [scene, "--limit", "2"], ["--seed", "2"]),
        Verb(heel, work, "filter", [clouds, "--model", model], ["--negative"]),
        Verb(heel, work, "map", [scene], ["--resolution", "0.08"]),
        Verb(heel, work, "map", [scene], ["--resolution", "0.08"], shared=True),
        Verb(heel, work, "learn", [recording, *learn], ["--to", "12"], "p.yaml"),
    ]
    mounts = mount_call()
    counts = {}
    for number in range(count):
        verb = verbs[number % len(verbs)]
        kind = draw.choices(["killed", "twice", "full"], [8, 1, 1])[0]
        try:
            what = (killed(verb, draw) if kind == "killed" else
                    twice(verb, draw) if kind == "twice" else full(verb, draw, mounts))
            if draw.random() < 0.25 or number >= count - len(verbs):
                way = draw.randrange(2)
                verb.clear()
                verb.finish(way)
                verb.check("the next run", (way,))
                verb.check_clean("the next run")
        except Fault as fault:
            print(f"run {number}: {fault}", file=sys.stderr)
            return 1
        counts[what] = counts.get(what, 0) + 1
        if (number + 1) % 100 == 0:
            print(f"{number + 1} runs", file=sys.stderr, flush=True)
    told = ", ".join(f"{value} {name}" for name, value in sorted(counts.items()))
    print(f"{count} runs ({told}): nothing was lost, and each next run worked")
    return 0


if __name__ == "__main__":
    sys.exit(main())
