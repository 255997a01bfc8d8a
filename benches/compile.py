#!/usr/bin/env python3
"""Compile times beside MuJoCo 3.12.0's: cold, after an edit of the text, and from the cache.

    python benches/compile.py --corpus FOLDER --list FILE [--runs N] [--write FILE]

Both sides are measured inside a fresh process, around the load alone: wall time, the least of the runs, and processor
time of all threads. Ours is `load_seconds` of `robohive bench`: cold without a cache, cached with a folder that an
earlier process filled, edited with the same folder after an element was added to the text, the new model kept included.
MuJoCo's is `MjModel.from_xml_path` with an empty asset cache: it keeps none between processes, so an edit costs it the same.
Runs alternate. FILE lists models below the folder, one a line. Needs `mujoco`, Linux and the command built with `cargo build --profile dist`.
"""

import argparse
import json
import pathlib
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "validation" / "reference"))
from record import TEMPLATE_OBJECT, repair  # noqa: E402

THEIRS = ("import mujoco, sys, time; began = time.perf_counter(), time.process_time(); "
          "mujoco.MjModel.from_xml_path(sys.argv[1]); "
          "print(time.perf_counter() - began[0], time.process_time() - began[1])")


def fill(path):
    """Template text replaced, beside the template, so that relative paths keep their meaning."""
    text = path.read_text(errors="surrogateescape")
    if "OBJECT_NAME" not in text:
        return path
    filled = path.with_name(f"{path.stem}.{TEMPLATE_OBJECT}.xml")
    filled.write_text(text.replace("OBJECT_NAME", TEMPLATE_OBJECT), errors="surrogateescape")
    return filled


def theirs(path):
    """Wall and processor seconds, or None."""
    run = subprocess.run([sys.executable, "-c", THEIRS, str(path)], capture_output=True, text=True)
    return tuple(map(float, run.stdout.split())) if run.returncode == 0 else None


def ours(binary, path, *options):
    """Wall seconds of the load, and processor seconds of the whole process; or None."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run([binary, "bench", str(path), "--steps", "1", "--json", *options], capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if run.returncode != 0:
        return None
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return json.loads(run.stdout)["load_seconds"], processor


def measure(binary, path, cache, runs):
    """Least wall and processor times: MuJoCo's, ours cold, ours edited, ours cached."""
    sides = [], [], [], []
    text = path.read_text(errors="surrogateescape")
    for run in range(runs + 1):
        end = text.rindex("</mujoco>")
        custom = f'<custom><numeric name="edit_{run}" data="{run}"/></custom>'
        path.write_text(text[:end] + custom + text[end:], errors="surrogateescape")
        edited = ours(binary, path, "--cache", cache)
        if run > 0:
            sides[0].append(theirs(path))
            sides[1].append(ours(binary, path))
            sides[2].append(edited)
            sides[3].append(ours(binary, path, "--cache", cache))
    path.write_text(text, errors="surrogateescape")
    if any(value is None for side in sides for value in side):
        return None
    return [[min(column) for column in zip(*side)] for side in sides]


def write(report, path):
    begin, end = "<!-- compile begins -->", "<!-- compile ends -->"
    text = path.read_text()
    head, rest = text.split(begin)
    path.write_text(f"{head}{begin}\n{report}\n{end}{rest.split(end)[1]}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", default=str(ROOT / "target" / "dist" / "robohive"))
    parser.add_argument("--corpus", required=True, type=pathlib.Path, help="folder of models; it is copied, not changed")
    parser.add_argument("--list", required=True, type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--write", type=pathlib.Path, help="Markdown file whose table is replaced")
    args = parser.parse_args()
    lines = ["| model | MuJoCo [ms] | cold [ms] | edited [ms] | cached [ms] | cold ratio | edited ratio | cached ratio |",
             "|---|---|---|---|---|---|---|---|"]
    ratios = []
    with tempfile.TemporaryDirectory(prefix="corpus-") as copy, tempfile.TemporaryDirectory(prefix="cache-") as cache:
        shutil.copytree(args.corpus, copy, dirs_exist_ok=True,
                        ignore=lambda folder, names: [] if pathlib.Path(folder) != args.corpus
                        else [n for n in names if n not in ("envs", "simhive")])
        repair(copy)
        for line in args.list.read_text().split():
            found = measure(args.binary, fill(pathlib.Path(copy) / line), cache, args.runs)
            if found is None:
                lines.append(f"| {line} | one side does not load it | | | | | | |")
            else:
                base, *own = found
                ratios.append([side[k] / base[k] for side in own for k in (0, 1)])
                times = " | ".join(f"{1e3 * side[0]:.1f}" for side in found)
                lines.append(f"| {line} | {times} | {ratios[-1][0]:.2f} | {ratios[-1][2]:.2f} | {ratios[-1][4]:.3f} |")
            print(lines[-1], flush=True)
    means = [statistics.geometric_mean(column) for column in zip(*ratios)]
    summary = (f"Of {len(ratios)} models, geometric means of the ratios, wall (processor): cold {means[0]:.2f} "
               f"({means[1]:.2f}), edited {means[2]:.2f} ({means[3]:.2f}), cached {means[4]:.3f} ({means[5]:.3f}).")
    print(summary)
    if args.write:
        write("\n".join(lines) + "\n\n" + summary, args.write)


if __name__ == "__main__":
    main()
