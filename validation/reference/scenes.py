#!/usr/bin/env python3
"""Lists the XML files below a folder that MuJoCo loads, less those of features that are not simulated.

    pip install mujoco==3.12.0
    python scenes.py --models FOLDER --out LIST [--any] [--mujoco VERSION] [DIR ...]

Only the folders DIR of FOLDER are searched, or all of it. LIST gets one path a line. Every file left out is printed
with its reason: what MuJoCo says when it refuses the file, or the feature. With --any no feature is left out. The
installed MuJoCo must be VERSION, 3.12.0 where none is given.
"""

import argparse
import multiprocessing
import re
import sys
from pathlib import Path
from xml.etree import ElementTree

import mujoco

ELEMENTS = ["flexcomp", "flex"]
LARGEST = 1000


def elements(path, seen):
    """Names of all elements of a file and of those it includes."""
    try:
        names = [e.tag for e in ElementTree.parse(path).iter()]
    except (ElementTree.ParseError, OSError):
        return set()
    seen.add(path)
    for name in re.findall(r'<include\s+file\s*=\s*"([^"]+)"', path.read_text(errors="replace")):
        if path.parent / name not in seen:
            names += elements(path.parent / name, seen)
    return set(names)


def reason(path, any_feature):
    """Why the file is left out; empty when it is listed."""
    try:
        model = mujoco.MjModel.from_xml_path(str(path))
    except Exception as error:
        return "refused: " + " ".join(str(error).split())
    return "" if any_feature else feature(path, model)


def feature(path, model):
    """What of a model is not simulated, or why it is too large; empty when there is nothing."""
    present = elements(path, set())
    if found := [e for e in ELEMENTS if e in present]:
        return ", ".join(found)
    if model.nflex:
        return "flex"
    if model.nv > LARGEST:
        return f"{model.nv} degrees of freedom: too long to record"
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", required=True, type=Path)
    parser.add_argument("--out", required=True, type=Path)
    parser.add_argument("--any", action="store_true", help="keep every file that MuJoCo loads")
    parser.add_argument("--mujoco", default="3.12.0", help="version that must be installed")
    parser.add_argument("folders", nargs="*", default=["."])
    args = parser.parse_args()
    if mujoco.__version__ != args.mujoco:
        sys.exit(f"mujoco {args.mujoco} is needed, this is {mujoco.__version__}")
    paths = sorted({p for f in args.folders for p in (args.models / f).rglob("*.xml")})
    with multiprocessing.Pool(2, maxtasksperchild=20) as pool:
        reasons = pool.starmap(reason, [(p, args.any) for p in paths], chunksize=1)
    listed = [p for p, why in zip(paths, reasons) if not why]
    for path, why in zip(paths, reasons):
        if why:
            print(path.relative_to(args.models), why, sep="\t")
    args.out.write_text("".join(f"{p.relative_to(args.models)}\n" for p in listed))
    print(f"{len(paths)} files, {sum(w.startswith('refused') for w in reasons)} refused, {len(listed)} listed")


if __name__ == "__main__":
    main()
