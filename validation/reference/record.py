#!/usr/bin/env python3
"""Records what MuJoCo 3.12.0 computes for a model: compiled arrays, forward passes, rollouts.

    pip install mujoco==3.12.0
    python record.py --out DIR MODEL.xml [MODEL.xml ...]
    python record.py --out DIR --corpus FOLDER --list FILE

One archive a model, named after its path, `scene.xml` after its folder. Its arrays:

    model.NAME, size.NAME, opt.NAME, stat.NAME, vis.GROUP.NAME   the compiled model
    state.NAME      rows of independent states, taken from a moving rollout
    forward.NAME    the forward pass of each row; arrays whose length varies are
                    concatenated in row order, `ncon` and `nefc` tell the split
    rollout.NAME    500 steps from keyframe 0, or qpos0: `ctrl` in, `qpos`, `qvel`, `act` after every step
    twin.qpos       the same from a start 1e-12 away: how far MuJoCo is from itself

Models of more than 400 degrees of freedom get a fifth of the states and steps, those of more than 1000 a tenth.
Models that 3.12.0 refuses are recorded from a repaired copy (see `repair`).
"""

import argparse
import contextlib
import re
import shutil
import sys
import tempfile
from pathlib import Path
from xml.etree import ElementTree

import mujoco
import numpy as np

STATES = 20
STEPS = 500
TWIN_OFFSET = 1e-12
TEMPLATE_OBJECT = "airplane"

INPUTS = ["qpos", "qvel", "act", "ctrl", "mocap_pos", "mocap_quat", "qfrc_applied", "xfrc_applied",
          "eq_active", "qacc_warmstart", "history"]

FIXED = ["xpos", "xquat", "xmat", "xipos", "ximat", "xanchor", "xaxis", "geom_xpos", "geom_xmat", "site_xpos",
         "site_xmat", "cam_xpos", "cam_xmat", "light_xpos", "light_xdir", "subtree_com", "cdof", "cinert",
         "flexvert_xpos", "flexelem_aabb", "bvh_aabb_dyn", "flexedge_J", "flexedge_length", "flexvert_J",
         "flexvert_length", "flexedge_velocity",
         "ten_wrapadr", "ten_wrapnum", "ten_J", "ten_length", "wrap_obj", "wrap_xpos", "actuator_length",
         "moment_rownnz", "moment_rowadr", "moment_colind", "actuator_moment", "crb", "M", "qLD", "qLDiagInv",
         "ten_velocity", "actuator_velocity", "cvel", "cdof_dot", "qfrc_bias", "qfrc_spring", "qfrc_damper",
         "qfrc_gravcomp", "qfrc_fluid", "qfrc_adhesion", "qfrc_passive", "act_dot", "actuator_force",
         "qfrc_actuator", "qfrc_smooth", "qacc_smooth", "qfrc_constraint", "qacc", "sensordata", "subtree_linvel",
         "subtree_angmom", "cacc", "cfrc_int", "cfrc_ext", "energy"]

ROWS = ["efc_type", "efc_id", "efc_pos", "efc_margin", "efc_frictionloss", "efc_diagA", "efc_KBIP", "efc_D", "efc_R",
        "efc_vel", "efc_aref", "efc_b", "efc_state", "efc_force"]

CONTACT = ["dist", "pos", "frame", "includemargin", "friction", "solref", "solreffriction", "solimp", "adhesion",
           "mu", "dim", "geom", "flex", "elem", "vert", "exclude", "efc_address"]


def compiled(model):
    """Every array, size and setting of the model."""
    out = {}
    for name in dir(model):
        if name.startswith("_"):
            continue
        value = getattr(model, name)
        if isinstance(value, np.ndarray):
            out["model." + name] = value
        elif isinstance(value, bytes):
            out["model." + name] = np.frombuffer(value, np.uint8)
        elif isinstance(value, int) and re.match("n[A-Za-z]|flg_", name):
            out["size." + name] = np.int64(value)
    groups = {"opt": model.opt, "stat": model.stat, "vis.global": model.vis.global_}
    groups |= {"vis." + g: getattr(model.vis, g) for g in ["quality", "headlight", "map", "scale", "rgba"]}
    for group, holder in groups.items():
        for name in dir(holder):
            value = getattr(holder, name)
            if not name.startswith("_") and not callable(value):
                out[f"{group}.{name}"] = np.asarray(value)
    return out


def controls(model, steps, seed):
    """Smooth controls: the mean of three sines an actuator, over nine tenths of its range."""
    rng = np.random.default_rng(seed)
    limited = model.actuator_ctrllimited.astype(bool)
    low = np.where(limited, model.actuator_ctrlrange[:, 0], -1.0)
    high = np.where(limited, model.actuator_ctrlrange[:, 1], 1.0)
    phase = rng.uniform(0, 2 * np.pi, (3, model.nu))
    rate = rng.uniform(0.2, 2.0, (3, model.nu))
    seconds = np.arange(steps)[:, None, None] * model.opt.timestep
    wave = np.sin(2 * np.pi * rate * seconds + phase).mean(axis=1)
    return (low + high) / 2 + 0.9 * (high - low) / 2 * wave


def start(model):
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    return data


def rollout(model, ctrl, offset=0.0, keep=None):
    """Steps under `ctrl`; calls `keep(step, data)` before each step."""
    data = start(model)
    qpos, qvel, act = [], [], []
    if offset:
        mujoco.mj_integratePos(model, data.qpos, np.full(model.nv, offset), 1.0)
    for step, row in enumerate(ctrl):
        data.ctrl[:] = row
        if keep:
            keep(step, data)
        mujoco.mj_step(model, data)
        qpos.append(data.qpos.copy())
        qvel.append(data.qvel.copy())
        act.append(data.act.copy())
    bad = int(sum(data.warning[w].number for w in (mujoco.mjtWarning.mjWARN_BADQPOS,
                  mujoco.mjtWarning.mjWARN_BADQVEL, mujoco.mjtWarning.mjWARN_BADQACC)))
    return np.array(qpos), np.array(qvel), np.array(act), bad


def dense_jacobian(model, data):
    if not data.nefc:
        return np.zeros((0, model.nv))
    if not mujoco.mj_isSparse(model):
        return data.efc_J[:data.nefc * model.nv].reshape(data.nefc, model.nv).copy()
    dense = np.zeros((data.nefc, model.nv))
    mujoco.mju_sparse2dense(dense, data.efc_J, data.efc_J_rownnz, data.efc_J_rowadr, data.efc_J_colind)
    return dense


def forward(model, states):
    """The forward pass of every row of `states`, fields stacked or concatenated."""
    data = mujoco.MjData(model)
    stacked = {name: [] for name in FIXED}
    counts = {name: [] for name in ["ncon", "ne", "nf", "nl", "nefc", "nisland", "solver_niter"]}
    ragged = {name: [] for name in ROWS + ["efc_J"] + ["contact." + c for c in CONTACT]}
    for row in range(len(states["time"])):
        mujoco.mj_resetData(model, data)
        data.time = states["time"][row]
        for name in INPUTS:
            getattr(data, name)[:] = states[name][row]
        mujoco.mj_forward(model, data)
        mujoco.mj_energyPos(model, data)
        mujoco.mj_energyVel(model, data)
        mujoco.mj_subtreeVel(model, data)
        mujoco.mj_rnePostConstraint(model, data)
        for name in FIXED:
            stacked[name].append(np.array(getattr(data, name)))
        for name in ["ncon", "ne", "nf", "nl", "nefc", "nisland"]:
            counts[name].append(getattr(data, name))
        counts["solver_niter"].append(np.array(data.solver_niter))
        for name in ROWS:
            ragged[name].append(np.array(getattr(data, name))[:data.nefc])
        ragged["efc_J"].append(dense_jacobian(model, data))
        for name in CONTACT:
            ragged["contact." + name].append(np.array(getattr(data.contact, name)))
    out = {"forward." + k: np.array(v) for k, v in stacked.items()}
    out |= {"forward." + k: np.array(v, np.int32) for k, v in counts.items()}
    for name, parts in ragged.items():
        filled = [p for p in parts if p.shape[0]]
        out["forward." + name] = np.concatenate(filled) if filled else parts[0]
    return out


def record(model, seed=0, states=STATES, steps=STEPS):
    ctrl = controls(model, steps, seed)
    rows = {name: [] for name in INPUTS + ["time"]}
    every = max(1, steps // states)

    def keep(step, data):
        if step % every == every - 1 and len(rows["time"]) < states:
            for name in INPUTS:
                rows[name].append(np.array(getattr(data, name)))
            rows["time"].append(data.time)

    qpos, qvel, act, bad = rollout(model, ctrl, keep=keep)
    twin = rollout(model, ctrl, TWIN_OFFSET)[0]
    out = {"rollout.ctrl": ctrl, "rollout.qpos": qpos, "rollout.qvel": qvel, "rollout.act": act,
           "rollout.bad": np.int64(bad), "twin.qpos": twin}
    rows = {k: np.array(v) for k, v in rows.items()}
    return out | compiled(model) | {"state." + k: v for k, v in rows.items()} | forward(model, rows)


def share(model):
    """What the states and steps of a model are divided by: dense rows of constraints grow with its square."""
    return 1 if model.nv <= 400 else 5 if model.nv <= 1000 else 10


def repair(folder):
    """Removes from a copy of the corpus what 3.12.0 refuses and 3.1.3 ignored: `apirate`, and the class of a
    default that stands at the top of an included file."""
    for path in Path(folder).rglob("*.xml"):
        text = path.read_text(errors="surrogateescape")
        repaired = re.sub(r'\sapirate\s*=\s*"[^"]*"', "", text)
        for name in top_default_classes(text):
            repaired = re.sub(rf'<default\s+class\s*=\s*"{re.escape(name)}"', "<default", repaired, count=1)
        if repaired != text:
            path.write_text(repaired, errors="surrogateescape")


def top_default_classes(text):
    try:
        root = ElementTree.fromstring(text.encode(errors="surrogateescape"))
    except ElementTree.ParseError:
        return []
    return [d.get("class") for d in root.findall("default") if d.get("class", "main") != "main"]


def load(path):
    text = path.read_text(errors="surrogateescape")
    if "OBJECT_NAME" in text:
        path = path.with_name(f"{path.stem}.{TEMPLATE_OBJECT}.xml")
        path.write_text(text.replace("OBJECT_NAME", TEMPLATE_OBJECT), errors="surrogateescape")
    return mujoco.MjModel.from_xml_path(str(path))


def arguments(doc):
    """Parser with what all recorders take."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="*", type=Path)
    parser.add_argument("--out", required=True, type=Path)
    parser.add_argument("--corpus", type=Path, help="folder whose models --list names; it is copied, not changed")
    parser.add_argument("--list", type=Path, help="file with one model path a line")
    parser.add_argument("--only", default="", help="record only listed models whose path contains this")
    return parser


@contextlib.contextmanager
def jobs(args):
    """Name of the archive and path of the file of each model; the folder for archives is made."""
    if mujoco.__version__ != "3.12.0":
        sys.exit(f"mujoco 3.12.0 is needed, this is {mujoco.__version__}")
    args.out.mkdir(parents=True, exist_ok=True)
    found = [(path.parent.name if path.stem == "scene" else path.stem, path) for path in args.models]
    with tempfile.TemporaryDirectory(prefix="corpus-") as copy:
        if args.list:
            shutil.copytree(args.corpus, copy, dirs_exist_ok=True)
            repair(copy)
            found += [(line.removesuffix(".xml").replace("/", "__"), Path(copy) / line)
                      for line in args.list.read_text().split() if args.only in line]
        yield found


def main():
    parser = arguments(__doc__)
    parser.add_argument("--states", type=int, default=STATES, help="independent states to record")
    parser.add_argument("--steps", type=int, default=STEPS, help="steps of the rollout")
    args = parser.parse_args()
    failed = 0
    with jobs(args) as found:
        for name, path in found:
            try:
                model = load(path)
                states, steps = max(2, args.states // share(model)), max(10, args.steps // share(model))
                np.savez_compressed(args.out / (name + ".npz"), **record(model, states=states, steps=steps))
                print("recorded", name, flush=True)
            except Exception as error:
                failed += 1
                print("FAILED", name, error, flush=True)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
