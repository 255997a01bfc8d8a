#!/usr/bin/env python3
"""Lists the XML files below a folder that MuJoCo loads, less those too large to record.

    pip install mujoco==3.12.0
    python scenes.py --models FOLDER --out LIST [--urdf] [--largest DOFS] [--mujoco VERSION] [DIR ...]

Only the folders DIR of FOLDER are searched, or all of it; with --urdf for URDF files too. LIST gets one path a line.
Every file left out is printed with its reason: what MuJoCo says when it refuses the file, or its degrees of freedom
where they are more than DOFS. The installed MuJoCo must be VERSION, 3.12.0 where none is given.
"""

import argparse
import multiprocessing
import sys
from pathlib import Path

import mujoco

LARGEST = 2000


def reason(path, largest):
    """Why the file is left out; empty when it is listed."""
    try:
        model = mujoco.MjModel.from_xml_path(str(path))
    except Exception as error:
        return "refused: " + " ".join(str(error).split())
    return size(model, largest)


def size(model, largest=LARGEST):
    """Why a model is too large; empty when it is not."""
    return f"{model.nv} degrees of freedom: too long to record" if model.nv > largest else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", required=True, type=Path)
    parser.add_argument("--out", required=True, type=Path)
    parser.add_argument("--urdf", action="store_true", help="list URDF files too")
    parser.add_argument("--largest", default=LARGEST, type=int, metavar="DOFS", help="most degrees of freedom")
    parser.add_argument("--mujoco", default="3.12.0", help="version that must be installed")
    parser.add_argument("folders", nargs="*", default=["."])
    args = parser.parse_args()
    if mujoco.__version__ != args.mujoco:
        sys.exit(f"mujoco {args.mujoco} is needed, this is {mujoco.__version__}")
    suffixes = {".xml", ".urdf"} if args.urdf else {".xml"}
    paths = sorted({p for f in args.folders for p in (args.models / f).rglob("*") if p.suffix in suffixes})
    with multiprocessing.Pool(2, maxtasksperchild=20) as pool:
        reasons = pool.starmap(reason, [(p, args.largest) for p in paths], chunksize=1)
    listed = [p for p, why in zip(paths, reasons) if not why]
    for path, why in zip(paths, reasons):
        if why:
            print(path.relative_to(args.models), why, sep="\t")
    args.out.write_text("".join(f"{p.relative_to(args.models)}\n" for p in listed))
    print(f"{len(paths)} files, {sum(w.startswith('refused') for w in reasons)} refused, {len(listed)} listed")


if __name__ == "__main__":
    main()
