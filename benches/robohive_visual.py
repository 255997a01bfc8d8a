#!/usr/bin/env python3
"""Environment steps per second with the pictures of their visual keys, beside RoboHive's own Python, on one thread.

    ROBOHIVE_STORE=FOLDER python benches/robohive_visual.py --robohive PYTHON [--binary FILE] [--write FILE]

PYTHON is an interpreter that has robohive 0.7.0 and mujoco 3.1.3, whose renderer draws on EGL with Mesa's llvmpipe held to one
thread (LP_NUM_THREADS=0). Where it has no PyTorch, which RoboHive imports before it draws anything, an empty module stands
in: keys that end with 2d need none of it. RoboHive draws depth together with colours in every picture; ours draws what the
keys name.

Both sides step under random actions and draw every picture after every step. Rates are of processor time, since other work
on the machine only adds to the wall's; each side has its best round.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Ids of the paper's table, and its samples/s of a process: a suite's total over its 32 processes.
IDS = [
    ("FrankaReachRandom_v2d-v0", 31), ("FrankaPushRandom_v2d-v0", 31), ("FrankaPickPlaceRandom_v2d-v0", 31),
    ("door_v2d-v1", 54), ("hammer_v2d-v1", 54), ("pen_v2d-v1", 54), ("relocate_v2d-v1", 54),
    ("FK1_LightOnRandom_v2d-v4", 11),
]
STEPS = 8  # Of RoboHive's, which take a second or so each.
OUR_STEPS = 48  # Two thirds of a second or more, since the clock that counts processor time ticks every 10 ms.
ROUNDS = 2

PEER = """
import importlib.machinery, sys, time, types
answers, sys.stdout = sys.stdout, sys.stderr
import gymnasium, robohive
try:
    import torch
except ImportError:
    torch = types.ModuleType('torch')
    torch.__spec__ = importlib.machinery.ModuleSpec('torch', None)
    module = type('Module', (), {'eval': lambda self: self, 'to': lambda self, device: self})
    torch.nn = types.SimpleNamespace(Module=module)
    torch.cuda = types.SimpleNamespace(is_available=lambda: False)
    torch.Tensor = type('Tensor', (), {})
    sys.modules['torch'] = torch
env = gymnasium.make(sys.argv[1]).unwrapped
env.reset()
env.get_exteroception()
steps = int(sys.argv[2])
began = time.process_time()
for _ in range(steps):
    env.step(env.action_space.sample())
    env.get_exteroception()
print(steps / (time.process_time() - began), file=answers)
"""


def processor_seconds(pid):
    """Time that a process has spent, user and system."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def ours(binary, name):
    """Steps per second with and without pictures."""
    command = [binary, "bench-env", name, "--requests"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        def ask(request):
            began = processor_seconds(process.pid)
            process.stdin.write(request + "\n")
            process.stdin.flush()
            answer = json.loads(process.stdout.readline())
            return answer["steps"], processor_seconds(process.pid) - began

        rates = []
        for request, count in [("images", OUR_STEPS), ("env", 2000)]:
            ask(f"record {count}")
            ask(request)
            rates.append(max(steps / max(spent, 0.01) for steps, spent in (ask(request) for _ in range(ROUNDS))))
        process.stdin.close()
        return rates


def theirs(python, name):
    """Steps per second of RoboHive with pictures."""
    environment = os.environ | {"MUJOCO_GL": "egl", "LP_NUM_THREADS": "0"}
    command = [python, "-c", PEER, name, str(STEPS)]
    found = [subprocess.run(command, env=environment, capture_output=True, text=True, check=False, cwd="/tmp")
             for _ in range(ROUNDS)]
    failed = [run.stderr for run in found if run.returncode]
    if failed:
        sys.exit(f"{name} under {python}:\n{failed[0]}")
    return max(float(run.stdout.split()[-1]) for run in found)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robohive", required=True, help="interpreter that has robohive 0.7.0")
    parser.add_argument("--binary", default=ROOT / "target/dist/robohive", help="the command")
    parser.add_argument("--write", type=pathlib.Path, help="write the table into this file, between its marks")
    arguments = parser.parse_args()
    lines = ["| id | pictures | RoboHive steps/s | ours | / RoboHive | paper's process | / paper | without pictures |",
             "|---|---|---|---|---|---|---|---|"]
    for name, paper in IDS:
        information = subprocess.run([arguments.binary, "info", name, "--json"], capture_output=True, text=True, check=True)
        keys = [image["key"] for image in json.loads(information.stdout)["images"]]
        size = keys[0].split(":")[-2]
        (with_images, without), peer = ours(arguments.binary, name), theirs(arguments.robohive, name)
        lines.append(f"| {name} | {len(keys)} of {size} | {peer:.2f} | {with_images:.2f} | {with_images / peer:.2f} | {paper} "
                     f"| {with_images / paper:.2f} | {without:.0f} |")
        print(lines[-1], flush=True)
    if arguments.write:
        text = arguments.write.read_text()
        start, end = "<!-- speed begin -->\n", "<!-- speed end -->"
        before, rest = text.split(start)
        arguments.write.write_text(before + start + "\n".join(lines) + "\n" + end + rest.split(end)[1])


if __name__ == "__main__":
    main()
