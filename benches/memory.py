"""Resident memory of one more environment, beside MuJoCo's mjData.

    python benches/memory.py [MODEL...]

Each environment has taken 100 steps from keyframe 0, or `qpos0`, with zero controls. Two processes hold 200 and 600
environments; what they differ by, a 400th, is the memory of one. Needs `mujoco` 3.12.0, Linux, and the command
built with `cargo build --profile dist`.
"""

import json
import subprocess
import sys

import mujoco

from step import OWN, ROOT, binary

FEW, MANY, STEPS = 200, 600, 100


def ours(path, environments):
    command = [binary(), "bench", path, "--batch", str(environments), "--steps", str(STEPS), "--json"]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["resident_bytes"]


def theirs(path, environments):
    command = [sys.executable, __file__, "--mujoco", path, str(environments)]
    return int(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def hold_mujoco(path, environments):
    """Resident bytes of this process with as many mjData."""
    model, held = mujoco.MjModel.from_xml_path(path), []
    for _ in range(environments):
        held.append(mujoco.MjData(model))
        if model.nkey:
            mujoco.mj_resetDataKeyframe(model, held[-1], 0)
        held[-1].ctrl[:] = 0
        mujoco.mj_step(model, held[-1], STEPS)
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) * 1024 for line in status if line.startswith("VmRSS:"))


def main(paths):
    print(f"{'model':32} {'robohive KiB':>12} {'mujoco KiB':>12} {'ratio':>6}")
    for path in paths or [str(ROOT / "assets" / f"{name}.xml") for name in OWN]:
        sides = [(side(path, MANY) - side(path, FEW)) / (MANY - FEW) / 1024 for side in (ours, theirs)]
        print(f"{path.split('/')[-1][:-4]:32} {sides[0]:12.0f} {sides[1]:12.0f} {sides[0] / sides[1]:6.2f}", flush=True)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--mujoco"]:
        print(hold_mujoco(sys.argv[2], int(sys.argv[3])))
    else:
        main(sys.argv[1:])
