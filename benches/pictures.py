#!/usr/bin/env python3
"""Milliseconds a picture beside MuJoCo's offscreen renderer on Mesa's llvmpipe, each on one thread.

    apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri
    pip install mujoco==3.12.0 pyopengl
    python benches/pictures.py --models FOLDER [--only TEXT] [--sizes 84,224,256] [--rounds N] [--all] [--batches]
                               [--write FILE]

FOLDER has RoboHive's `envs` and `simhive` and MuJoCo's `model`, see validation/reference/pictures.py; without it, own
models alone. Ours is the command built with `cargo build --profile dist`. Scenes are the listed ones of
validation/pictures.toml, with --all every one; sizes are theirs.

Both sides go through the same STATES states, the recorded pose with other noise in each, so that every picture is
of another state than the one before. A picture is all that follows from a state whose forward pass is done: assembling the
scene, drawing it, and the pixels in memory. The sides take turns; each has the least processor time of its rounds, since
other work on the machine only adds. LP_NUM_THREADS=0 keeps llvmpipe in the thread that calls it.

rgb       colours, four samples a pixel
plain     the same without shadows
depth     metres
ids       segmentation
second    what the free camera costs when it is drawn together with another picture of the same state, in units of its picture
          alone: 1 is no gain
batch     64 environments in colours, two threads over one, wall time: wants two idle cores (--batches)
memory    resident MiB of our process; of MuJoCo's, what it has above Python with its modules

The bars: colours 8 times MuJoCo's speed each and 15 times in the geometric mean; without shadows 3 and 5; depth and
segmentation 2 and 3; a side of 84 at least 1.4 times faster than 224; two threads 1.8.
"""

import argparse
import json
import os
import pathlib
import sys
import tomllib

from robohive import ROOT, Process, binary, geometric_mean, write

# `pictures` is then the recorder, not this file.
sys.path.insert(0, str(ROOT / "validation" / "reference"))

STATES = 24  # More than the views that our renderer keeps, so that no picture of a moving camera returns.
KINDS = {"rgb": (8, 15), "plain": (3, 5), "depth": (2, 3), "ids": (2, 3)}
OURS_FRAMES = STATES  # Pictures a request: one of each state.
PEER_SECONDS = 0.4  # Time of a request to MuJoCo, at least one picture.


# The peer: this file as a child, with MuJoCo.

class Peer:
    """MuJoCo's renderer of one scene."""

    def __init__(self, models):
        import mujoco
        import numpy
        import pictures
        self.mujoco, self.numpy, self.pictures, self.models = mujoco, numpy, pictures, models
        self.bare = resident(os.getpid())

    def make(self, name):
        """The positions of every state."""
        scene = next(scene for scene in scenes() if scene["name"] == name)
        self.model, _ = self.pictures.load(scene, self.models)
        self.camera = scene.get("camera", -1)
        self.data, self.view = [], None
        for seed in range(STATES):
            data = self.pictures.pose(self.model, seed)
            self.data.append(data)
        return [data.qpos.tolist() for data in self.data]

    def size(self, side):
        if self.view:
            self.view.close()
        self.model.vis.quality.offsamples = self.pictures.SAMPLES
        self.view = self.mujoco.Renderer(self.model, int(side), int(side))

    def draw(self, kind, count):
        """Draws pictures, each of the next state."""
        view, flag = self.view, self.mujoco.mjtRndFlag.mjRND_SHADOW
        {"depth": view.enable_depth_rendering, "ids": view.enable_segmentation_rendering}.get(kind, lambda: None)()
        for k in range(int(count)):
            view.update_scene(self.data[k % STATES], self.camera)
            view.scene.flags[flag] = kind != "plain"
            view.render()
        view.disable_depth_rendering()
        view.disable_segmentation_rendering()

    def memory(self):
        """Bytes above those of Python and its modules."""
        return resident(os.getpid()) - self.bare


def serve(models):
    """Answers requests of standard input."""
    answers, sys.stdout = sys.stdout, sys.stderr
    peer = Peer(models)
    for line in sys.stdin:
        request, *words = line.split()
        print(json.dumps(getattr(peer, request)(*words)), file=answers, flush=True)


def resident(process):
    """Resident bytes of a process."""
    with open(f"/proc/{process}/status") as status:
        return 1024 * next(int(line.split()[1]) for line in status if line.startswith("VmRSS"))


# The measuring side.

def start_ours(scene, args):
    own = scene["file"].startswith(("assets/", "validation/"))
    command = [args.binary, "bench-render", (ROOT if own else args.models) / scene["file"], "--requests"]
    command += ["--camera", scene.get("camera", "free")]
    for text, value in scene.get("define", {}).items():
        command += ["--define", f"{text}={value}"]
    return Process(command, quiet=True)


def measure(scene, peer, args):
    """The row of a scene: for every size milliseconds of each kind, and what else is measured."""
    name, rows = scene["name"], {}
    states = peer.ask("make", name)
    ours = start_ours(scene, args)
    for positions in states:
        ours.ask("state", *positions)
    for side in args.sizes:
        peer.ask("size", side)
        row = {}
        for kind in KINDS:
            peer.ask("draw", kind, 1)
            frames = max(1, min(STATES, int(PEER_SECONDS / peer.seconds("draw", kind, 1))))
            ours.ask(kind, side, OURS_FRAMES)
            mine, theirs = [], []
            for _ in range(args.rounds):
                theirs.append(peer.seconds("draw", kind, frames) / frames)
                mine.append(ours.seconds(kind, side, OURS_FRAMES) / OURS_FRAMES)
            row[kind] = 1e3 * min(mine), 1e3 * min(theirs)
        both, other = (min(ours.seconds(word, "free", side, OURS_FRAMES) / OURS_FRAMES for _ in range(args.rounds))
                       for word in ("both", "other"))
        row["second"] = (1e3 * both - row["rgb"][0]) / (1e3 * other)
        row["load"] = ours.ask("rgb", side, 1)
        row["two"] = batches(ours, side, args.rounds) if args.batches else None
        rows[side] = row
    memory = [resident(ours.process.pid) / 2**20, peer.ask("memory") / 2**20]
    ours.close()
    return {"sides": rows, "memory": memory}


def batches(ours, side, rounds):
    """Two threads over one, of the best rounds."""
    one, two = (min(ours.ask("batch", side, threads)["seconds"] for _ in range(rounds)) for threads in (1, 2))
    return one / two


HEADER = """| scene | side | items, triangles | rgb ms, MuJoCo's, ratio | plain | depth | ids | second | two threads | memory |
|---|---|---|---|---|---|---|---|---|---|"""


def lines(name, row):
    for side, found in row["sides"].items():
        cells = [f"{a:.2f}, {b:.1f}, {b / a:.1f}" for a, b in (found[kind] for kind in KINDS)]
        load = f"{found['load']['items']}, {found['load']['triangles']}"
        two = f"{found['two']:.2f}" if found["two"] else ""
        memory = "{:.0f}, {:.0f}".format(*row["memory"])
        yield f"| {name} | {side} | {load} | {' | '.join(cells)} | {found['second']:.2f} | {two} | {memory} |"


def misses(rows, sizes):
    """Every bar that is not reached."""
    for kind, (least, mean) in KINDS.items():
        for side in sizes:
            ratios = {name: row["sides"][side][kind][1] / row["sides"][side][kind][0] for name, row in rows.items()}
            yield from (f"{name} {side} {kind}: {ratio:.1f} of {least}" for name, ratio in ratios.items() if ratio < least)
            if (found := geometric_mean(list(ratios.values()))) < mean:
                yield f"geometric mean {side} {kind}: {found:.1f} of {mean}"
    for name, row in rows.items():
        for side, found in row["sides"].items():
            if found["two"] and found["two"] < 1.8:
                yield f"{name} {side}: two threads {found['two']:.2f}"
        if {84, 224} <= set(sizes):
            gain = row["sides"][224]["rgb"][0] / row["sides"][84]["rgb"][0]
            if gain < 1.4:
                yield f"{name}: 84 is {gain:.2f} times as fast as 224"


def report(rows, sizes):
    out = [HEADER, *(line for name, row in rows.items() for line in lines(name, row)), ""]
    for side in sizes:
        means = []
        for kind in KINDS:
            ratios = [row["sides"][side][kind][1] / row["sides"][side][kind][0] for row in rows.values()]
            means.append(f"{kind} {geometric_mean(ratios):.1f} (least {min(ratios):.1f})")
        out.append(f"- {side} x {side} pixels, times MuJoCo's speed, geometric means of {len(rows)} scenes: {', '.join(means)}")
    out += ["", "Bars missed: " + ("; ".join(misses(rows, sizes)) or "none") + "."]
    return "\n".join(out)


def scenes():
    return tomllib.loads((ROOT / "validation" / "pictures.toml").read_text())["scene"]


def chosen(args):
    """Scenes whose models are there."""
    for scene in scenes():
        there = scene["file"].startswith(("assets/", "validation/")) or args.models
        if there and args.only in scene["name"] and (args.all or scene["bars"] == "listed"):
            yield scene


def measure_all(args, models):
    os.environ.update({"MUJOCO_GL": "egl", "LP_NUM_THREADS": "0", "GALLIUM_DRIVER": "llvmpipe"})
    rows = {}
    for scene in chosen(args):
        # A process for each scene, so that memory is of one.
        peer = Process([sys.executable, pathlib.Path(__file__).resolve(), "--serve", models], quiet=True)
        rows[scene["name"]] = measure(scene, peer, args)
        print("\n".join(lines(scene["name"], rows[scene["name"]])), file=sys.stderr, flush=True)
        peer.close()
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", type=pathlib.Path)
    parser.add_argument("--binary", type=pathlib.Path, help="our command, if not the one built with the profile `dist`")
    parser.add_argument("--only", default="", help="scenes whose name contains this")
    parser.add_argument("--all", action="store_true", help="every scene")
    parser.add_argument("--sizes", type=lambda text: [int(side) for side in text.split(",")], default=[84, 224, 256])
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--batches", action="store_true", help="two threads over one as well")
    parser.add_argument("--write", type=pathlib.Path, help="file with the marks 'speed begin' and 'speed end'")
    parser.add_argument("--serve", type=pathlib.Path, help=argparse.SUPPRESS)
    args = parser.parse_args()
    if args.serve:
        return serve(args.serve)
    import pictures
    import tempfile
    args.binary = (args.binary or binary()).resolve()
    args.models = args.models and args.models.resolve()
    with tempfile.TemporaryDirectory(prefix="models-") as copy:
        if args.models:
            pictures.copy_models(args.models, pathlib.Path(copy), repaired=True)
        rows = measure_all(args, copy)
    table = report(rows, args.sizes)
    print(table)
    if args.write:
        write(args.write, table)


if __name__ == "__main__":
    main()
