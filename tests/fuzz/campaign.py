#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Heel authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the fuzzer of each reader (cmake --preset fuzz; cmake --build --preset fuzz).

  campaign.py [READER...] [--seconds 600] [--inputs 1000000] [--most 7200] [--jobs 2] [--seed 0]

Each one runs for so many seconds and so many inputs, whichever takes longer, but never for longer
than --most. What it draws follows from --seed, and with 0 from the time. It begins with the seeds
that our own writers draw, and with what was found before (tests/fuzz/findings). Prints a table, and
says where inputs are that a reader did not bear: crashes and leaks, what takes over 2 GB of memory
or over 5 s of the processor. If there are any, the script fails. What ended the fuzzer but does not
happen again when the same bytes are read alone is printed, and does not count.
"""

import argparse
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
KINDS = ["crash", "leak", "oom", "timeout"]
INTERRUPTED = 72  # libFuzzer's exit code when somebody stopped it
# Freed memory is kept back until it is 16 MB, not 256, and who freed it is kept in short: small inputs
# are then read up to ten times as fast.
ASAN = "quarantine_size_mb=16:malloc_context_size=2:max_malloc_fill_size=0"
HEADER = ("| reader | inputs | minutes | edges | peak memory | crashes and leaks | over 2 GB "
          "| over 5 s |\n| --- " + "| ---: " * 7 + "|")


def last(pattern, text):
    numbers = re.findall(pattern, text)
    return int(numbers[-1]) if numbers else 0


def happens_again(fuzzer, reader, file, environment):
    """Whether an input ends the fuzzer by itself, or takes over 5 s of the processor. On a busy
    machine libFuzzer's clock on the wall goes on while a program waits for its turn, and the search
    for leaks may find no turn at all."""
    child = subprocess.Popen([fuzzer, reader, "-rss_limit_mb=2048", "-timeout=300", file],
                             env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    return child.returncode != 0 or used.ru_utime + used.ru_stime > 5.0


def run(fuzzer, reader, work, scratch, options):
    """Fuzzes one reader; gives its row of the table, and what it did not bear."""
    folder = work / reader
    shutil.rmtree(folder, ignore_errors=True)
    corpus, found = folder / "corpus", folder / "found"
    for part in (corpus, found):
        part.mkdir(parents=True)
    former = HERE / "findings" / reader
    environment = {**os.environ, "TMPDIR": scratch, "ASAN_OPTIONS": ASAN}
    subprocess.run([fuzzer, reader, "--seeds", corpus], check=True, env=environment)
    started = time.monotonic()
    inputs = edges = memory = 0
    with open(folder / "log.txt", "w+", encoding="utf-8", errors="replace") as log:
        while not any(found.iterdir()):
            past = time.monotonic() - started
            if (past >= options.seconds and inputs >= options.inputs) or past >= options.most:
                break
            # At first the time, then what is missing of the inputs.
            limits = ([f"-max_total_time={max(round(options.seconds - past), 1)}"]
                      if past < options.seconds else
                      [f"-runs={options.inputs - inputs}",
                       f"-max_total_time={round(options.most - past) + 1}"])
            log.seek(0)
            log.truncate()
            code = subprocess.call(
                [fuzzer, reader, "-rss_limit_mb=2048", "-timeout=5", "-print_final_stats=1",
                 f"-seed={options.seed}", f"-artifact_prefix={found}/", *limits, corpus,
                 *([former] if former.is_dir() else [])],
                stdout=log, stderr=log, env=environment)
            log.seek(0)
            text = log.read()
            inputs += last(r"number_of_executed_units: (\d+)", text)
            edges = max(edges, last(r" cov: (\d+)", text))
            memory = max(memory, last(r"peak_rss_mb: +(\d+)", text))
            if code == 0:
                continue
            if code == INTERRUPTED:
                break
            print(f"campaign.py: {reader} ended with {code}; the end of its log:\n{text[-6000:]}",
                  file=sys.stderr)
            for file in list(found.iterdir()):
                if not happens_again(fuzzer, reader, file, environment):
                    print(f"campaign.py: {file.name} does not happen again", file=sys.stderr)
                    file.rename(folder / file.name)
                    code = 0
            if code != 0:
                break
    counts = {kind: len(list(found.glob(kind + "-*"))) for kind in KINDS}
    if code not in (0, INTERRUPTED) and not any(counts.values()):
        counts["crash"] = 1
    row = (f"| {reader} | {inputs:,} | {(time.monotonic() - started) / 60:.1f} | {edges:,} "
           f"| {memory} MB | {counts['crash'] + counts['leak']} | {counts['oom']} "
           f"| {counts['timeout']} |")
    print(row, file=sys.stderr, flush=True)
    return row, folder if any(counts.values()) else None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("readers", nargs="*")
    parser.add_argument("--build", type=pathlib.Path, default=HERE.parent.parent / "build/fuzz")
    parser.add_argument("--seconds", type=float, default=600)
    parser.add_argument("--inputs", type=int, default=1_000_000)
    parser.add_argument("--most", type=float, default=7200)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    fuzzer = options.build.resolve() / "tests/fuzz/fuzz"
    if not fuzzer.exists():
        sys.exit(f"campaign.py: {fuzzer} is not there: cmake --build --preset fuzz")
    all_readers = subprocess.run([fuzzer, "--list"], check=True, capture_output=True,
                                 text=True).stdout.split()
    unknown = set(options.readers) - set(all_readers)
    if unknown:
        sys.exit(f"campaign.py: there is no reader {', '.join(sorted(unknown))}")
    work = options.build.resolve() / "campaign"
    # Each input becomes a file: where there is one, in a file system in memory.
    memory = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
    with (tempfile.TemporaryDirectory(prefix="heel_fuzz_", dir=memory) as scratch,
          concurrent.futures.ThreadPoolExecutor(options.jobs) as pool):
        results = list(pool.map(lambda reader: run(fuzzer, reader, work, scratch, options),
                                options.readers or all_readers))
    print(HEADER, *(row for row, _ in results), sep="\n")
    found = [folder for _, folder in results if folder]
    for folder in found:
        print(f"campaign.py: not borne: {folder}/found, see {folder}/log.txt", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
