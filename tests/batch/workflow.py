#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Heel authors
# SPDX-License-Identifier: BSD-3-Clause
"""Holds the workflow of apps/batch to what it promises (Debian's snakemake, slurm-wlm and munge).

  workflow.py HEEL [--recordings 40] [--kills 10] [--nodes 3] [--seed 1] [--work FOLDER]

Simulates recordings, breaks some, and works on them: on this machine; once more, which does
nothing; killed again and again at random moments; and, as root, on a Slurm cluster of so many
nodes (0: none), one of which dies on the way. Each time the results must have the same bytes, but
for what tells of the machine. Fails with a sentence if something is not so.
"""

import argparse
import concurrent.futures
import csv
import filecmp
import json
import os
import pathlib
import random
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
BATCH = HERE.parent.parent / "apps" / "batch"
# What tells of the machine and of time.
MACHINE = {"timing.csv", "machine.csv"}


def fail(sentence):
    sys.exit(f"workflow.py: {sentence}")


def small_scene(folder):
    """The scene 'wardrobe', smaller and shorter."""
    scenes = BATCH.parent / "scenes"
    text = (scenes / "wardrobe.yaml").read_text()
    for old, new in ((r"width: 640, height: 480", "width: 320, height: 240"),
                     (r"models: models", f"models: {scenes}/models"),
                     (r"duration_s: .*", "duration_s: 14")):
        text, count = re.subn(old, new, text)
        if count == 0:
            fail(f"the scene 'wardrobe' has no '{old}' any more")
    scene = folder / "small.yaml"
    scene.write_text(text)
    return scene


def make_recordings(heel, work, count):
    """The first of them is the lesson. Some are broken; gives these with their codes."""
    folder = work / "recordings"
    folder.mkdir()
    scene = small_scene(work)

    def simulate(i):
        subprocess.run([heel, "simulate", scene, "--seed", str(i), "--light", "drawn", "--threads",
                        "1", "--out", folder / f"r{i:03}"], check=True, capture_output=True)
    broken = {"empty": 3, "endless.bag": 3, "noise.bag": 3, "cut, $(touch x) {run}.bag": 3,
              "one_eyed": 3}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(simulate, range(1, max(2, count - len(broken)) + 1)))
    (folder / "empty").mkdir()
    (folder / "endless.bag").symlink_to("/dev/zero")
    (folder / "noise.bag").write_bytes(random.Random(1).randbytes(100_000))
    (folder / "cut, $(touch x) {run}.bag").write_bytes(b"#ROSBAG V2.0\n")
    shutil.copytree(folder / "r002", folder / "one_eyed")
    shutil.rmtree(folder / "one_eyed" / "right")
    return broken


def command(work, *more):
    return ["snakemake", "--snakefile", str(BATCH / "Snakefile"), "--configfile",
            str(work / "config.yaml"), "--directory", str(work), "--keep-going",
            "--rerun-incomplete", *more]


def run(work, *more):
    done = subprocess.run(command(work, *more), capture_output=True, text=True)
    if done.returncode != 0:
        fail(f"snakemake failed:\n{done.stdout[-2000:]}{done.stderr[-4000:]}")
    return done.stdout + done.stderr


def begin(work):
    return subprocess.Popen(command(work, "--cores", "2"), stdout=subprocess.DEVNULL,
                            stderr=subprocess.DEVNULL, start_new_session=True)


def results(folder):
    return {path.relative_to(folder): path for path in sorted(folder.rglob("*"))
            if path.is_file() and path.name not in MACHINE and not path.name.endswith(".heel")}


def compare(reference, folder, what):
    expected, there = results(reference), results(folder)
    if expected.keys() != there.keys():
        fail(f"{what}: other files: {sorted(map(str, expected.keys() ^ there.keys()))[:5]}")
    for name, path in expected.items():
        if not filecmp.cmp(path, there[name], shallow=False):
            fail(f"{what}: {name} has other bytes")
    print(f"{what}: the same {len(expected)} files", flush=True)


def check_summary(folder, broken, sound):
    with open(folder / "summary" / "summary.csv", encoding="utf-8", newline="") as file:
        rows = {row["name"].rsplit("-", 1)[0]: row for row in csv.DictReader(file)}
    for name, code in broken.items():
        row = rows.pop(re.sub(r"[^A-Za-z0-9_-]", "_", name), None)
        if row is None or int(row["exit"]) != code or not row["reason"]:
            fail(f"the summary does not say what is wrong with {name}: {row}")
    if len(rows) != sound or any(row["exit"] not in ("0", "4") for row in rows.values()):
        fail(f"not each of {sound} recordings that are sound was tracked: {rows}")
    right = [float(row["evaluation.target.right_answer_share"]) for row in rows.values()
             if row["exit"] == "0"]
    if 2 * len(right) < sound or sum(right) < 0.8 * len(right):
        fail(f"the person is hardly found: in {len(right)} of {sound}, right answers {right}")
    print(f"{sound} sound recordings, {len(broken)} broken ones; right answers "
          f"{sum(right) / len(right):.2f}", flush=True)


def target_places(table):
    with open(table, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    targets = {row["stamp_s"]: complex(float(row["x_m"]), float(row["y_m"]))
               for row in rows if row["is_target"] == "1"}
    return {row["stamp_s"]: targets.get(row["stamp_s"]) for row in rows}


def compare_pieces(uncut, joined):
    """Tables may differ where the overlap was too short to find out who is who."""
    same = moments = 0
    for table in sorted(joined.glob("track/*/tracks.csv")):
        if not (joined / "pieces" / table.parent.name / "2_2").is_dir():
            fail(f"{table.parent.name} is not cut into two pieces")
        one, other = target_places(uncut / table.relative_to(joined)), target_places(table)
        with_target = [t for t in one if one[t] is not None or other.get(t) is not None]
        moments += len(with_target)
        same += sum(one[t] is not None and other.get(t) is not None and
                    abs(one[t] - other[t]) < 0.1 for t in with_target)
    if same < 0.95 * moments or moments == 0:
        fail(f"cut into pieces: only {same} of {moments} moments have the same target")
    print(f"cut into pieces: the same target in {same} of {moments} moments", flush=True)


def kill_and_go_on(work, kills, dice, whole_s):
    for _ in range(kills):
        child = begin(work)
        time.sleep(dice.uniform(0.0, 1.5 * whole_s / kills))
        os.killpg(child.pid, signal.SIGKILL)
        child.wait()
        run(work, "--unlock")
    return run(work, "--cores", "2")


def on_slurm(work, nodes, dice, whole_s):
    cluster = HERE / "slurm_cluster.sh"
    folder = work / "slurm"
    subprocess.run([cluster, "start", folder, str(nodes)], check=True)
    os.environ["SLURM_CONF"] = str(folder / "slurm.conf")
    os.environ.setdefault("USER", "root")
    try:
        child = subprocess.Popen(command(work, "--profile", str(BATCH / "slurm")),
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        time.sleep(3.0 + dice.uniform(0.0, 0.3 * whole_s))
        if nodes > 1:
            subprocess.run([cluster, "kill", folder, "n1"], check=True)
        try:
            told = child.communicate(timeout=120.0 + 20.0 * whole_s)[0]
        except subprocess.TimeoutExpired:
            child.kill()
            fail("the workflow on Slurm does not end")
        if child.returncode != 0:
            fail(f"snakemake on Slurm failed:\n{told[-4000:]}")
    finally:
        subprocess.run([cluster, "stop", folder], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("heel", type=pathlib.Path)
    parser.add_argument("--recordings", type=int, default=40)
    parser.add_argument("--kills", type=int, default=10)
    parser.add_argument("--nodes", type=int, default=3)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--work", type=pathlib.Path)
    options = parser.parse_args()
    heel, dice = options.heel.resolve(), random.Random(options.seed)
    with tempfile.TemporaryDirectory(prefix="heel_workflow_") as temporary:
        work = options.work or pathlib.Path(temporary)
        work.mkdir(exist_ok=True)
        broken = make_recordings(heel, work, options.recordings)
        (work / "config.yaml").write_text(json.dumps({
            "recordings": ["recordings/*"], "learn": {"anna": "recordings/r001"},
            "homes": {"number": 3, "at_once": 2, "options": "--limit 0.3"},
            "heel": shlex.quote(str(heel)), "limit_s": 600}))
        out, reference = work / "batch", work / "reference"
        began = time.monotonic()
        run(work, "--cores", "2")
        whole_s = time.monotonic() - began
        check_summary(out, broken, len(list((work / "recordings").iterdir())) - len(broken))
        if list(work.rglob("x")):
            fail("a recording's name was run by a shell")
        if "Nothing to be done" not in run(work, "--cores", "2"):
            fail("a second run does something")
        out.rename(reference)
        (work / "pieces.json").write_text(json.dumps({
            "recordings": ["recordings/r00[2-4]"], "out": "cut", "piece_gb": 0.02, "overlap_s": 6}))
        run(work, "--cores", "2", "--configfile", str(work / "config.yaml"), str(work / "pieces.json"))
        compare_pieces(reference, work / "cut")
        shutil.rmtree(work / ".snakemake")
        kill_and_go_on(work, options.kills, dice, whole_s)
        compare(reference, out, f"killed {options.kills} times")
        if options.nodes > 0:
            shutil.rmtree(out)
            shutil.rmtree(work / ".snakemake")
            on_slurm(work, options.nodes, dice, whole_s)
            compare(reference, out, f"on {options.nodes} nodes of Slurm, one of which died")
    print("all as promised")


if __name__ == "__main__":
    main()
