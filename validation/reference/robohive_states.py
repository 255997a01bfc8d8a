#!/usr/bin/env python3
"""Records a few states of every registered class of RoboHive, small enough to live beside this file.

    python robohive_states.py --out robohive

What `robohive.py` needs is needed here. DIR/ID.npz holds what a task function reads and what RoboHive made of it, so
that observations and rewards can be recomputed on a stand-in for the model that has the right names and counts only.
Rows are states: first two of an episode, after steps 1 and 15, then probes, whose arrays were drawn so that bonuses,
success, penalties and the end of the episode occur. Arrays are those of `robohive.py`, with these columns only:

    site_pos site_quat derived/site_*                   the sites of meta["sites"], in this order
    body_pos body_quat derived/x* derived/cvel          the bodies of meta["bodies"]
    derived/geom_xpos                                   the geoms of meta["geoms"]
    derived/sensordata                                  the (scalar) sensors of meta["sensors"]
    derived/actuator_*                                  all actuators

`control` is what the last step sent to the actuators. In probes the arrays do not follow from `qpos`.
meta, JSON as bytes: id, class, keyword arguments, keys and weights, times, sizes, and

    joints      all, in order: name where the class asks for it, type (0 free, 1 ball, 2 slide, 3 hinge), range, qpos0
    actuators   all, in order: name where the class asks for it, ctrlrange, muscle
    sites, bodies, geoms, sensors   those the class asks for; walking classes sum over all bodies and have them all.
                With their poses in the freshly loaded model: `xpos`, `xquat` in the world, bodies also `xipos`, `mass`
    keys        configurations of the model's keyframes, where the class reads them
"""

import argparse
import contextlib
import importlib.util
import io
import json
from pathlib import Path

import numpy as np

IDS = """FrankaReachFixed-v0 FrankaPushFixed-v0 FrankaPickPlaceFixed-v0 TrifingerReachFixed-v0
rpFrankaDmanusPoseFixed-v0 rpFrankaRobotiqPoseFixed-v0 rpFrankaRobotiqData-v0 DKittyWalkRandom-v0 DKittyOrientFixed-v0
DKittyStandFixed-v0 FK1_MicroOpenFixed-v4 franka_micro_open-v3 door-v1 hammer-v1 pen-v1 relocate-v1 baoding-v1
myoElbowPose1D6MFixed-v0 myoHandReachFixed-v0 myoHandKeyTurnFixed-v0 myoHandObjHoldFixed-v0 myoHandObjHoldRandom-v0
myoHandPenTwirlFixed-v0 myoHandPenTwirlRandom-v0 myoHandReorient8-v0 myoHandReorient100-v0 myoHandReorientID-v0
myoHandReorientOOD-v0 myoHandBaodingFixed-v1 myoLegStandRandom-v0 myoLegWalk-v0 myoLegRoughTerrainWalk-v0
myoChallengeDieReorientP1-v0 myoChallengeRelocateP1-v0 myoChallengeBaodingP1-v1 myoChallengeChaseTagP1-v0
MyoHandAirplaneFixed-v0""".split()

VISITED = 15
PROBES = 4
TRIALS = 400
SPREADS = [0.004, 0.01, 0.03, 0.08, 0.3, 1.2]
SUMS_OVER_BODIES = ["WalkEnvV0", "TerrainEnvV0"]
READS_KEYS = SUMS_OVER_BODIES + ["ChaseTagEnvV0"]
NAMED_DATA = {"ChaseTagEnvV0": {"body": ["root", "pelvis", "talus_l", "talus_r"], "site": ["head"],
                                "sensor": ["r_foot", "r_toes", "l_foot", "l_toes"]}}
KINDS = ["body", "joint", "geom", "site", "actuator", "sensor"]
TERMS = ["solved", "done", "bonus", "bonus_small", "bonus_big", "penalty", "falling", "drop", "drop_penalty", "lose"]


def recorder():
    """The module `robohive.py` beside this file, whose name the installed package has as well."""
    spec = importlib.util.spec_from_file_location("recorder", Path(__file__).resolve().parent / "robohive.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Asked:
    """Names that a class looks up in its model, without those of the robot's configuration."""

    def __init__(self):
        self.names = {kind: set() for kind in KINDS}
        self.listening = True

    @contextlib.contextmanager
    def watching(self):
        from robohive.physics.mj_sim_scene import DMSimScene
        from robohive.robot.robot import Robot

        patch, configure = DMSimScene._patch_mjmodel_accessors, Robot.configure_robot

        def patched(scene, model):
            patch(scene, model)
            for kind in KINDS:
                setattr(model, kind + "_name2id", self.lookup(kind, getattr(model, kind + "_name2id")))

        def configured(robot, *args):
            self.listening = False
            try:
                return configure(robot, *args)
            finally:
                self.listening = True

        DMSimScene._patch_mjmodel_accessors, Robot.configure_robot = patched, configured
        try:
            yield
        finally:
            DMSimScene._patch_mjmodel_accessors, Robot.configure_robot = patch, configure

    def lookup(self, kind, find):
        def found(name):
            if self.listening:
                self.names[kind].add(name)
            return find(name)
        return found

    def ids(self, model, kind):
        return sorted(getattr(model, kind)(name).id for name in self.names[kind])


def columns(value, ids, count):
    """Of a flat row with one entry of some width for each of `count` things, those of `ids`."""
    return value.reshape(count, -1)[ids].ravel() if count else value


class States:
    """An environment, what its class asks for, and rows of it."""

    def __init__(self, tools, name):
        self.tools, self.asked = tools, Asked()
        with self.asked.watching():
            self.recorder = tools.Recorder(name, tools.SEED)
            self.env, self.name = self.recorder.env, name
            self.model, self.data = self.env.sim.model, self.env.sim.data
            self.rng = np.random.default_rng(tools.SEED)
            self.recorder.seed(tools.SEED)
            self.recorder.reset()
            space = self.env.action_space
            visited = [self.recorder.step(self.rng.uniform(space.low, space.high))[0] for _ in range(VISITED)]
            self.rows = [self.row(visited[0]), self.row(visited[-1])]
        for kind, names in NAMED_DATA.get(type(self.env).__name__, {}).items():
            self.asked.names[kind] |= set(names)
        self.read = tools.READS[self.recorder.entry]
        self.used = {kind: self.asked.ids(self.model, kind) for kind in KINDS}
        if type(self.env).__name__ in SUMS_OVER_BODIES:
            self.used["body"] = list(range(self.model.nbody))

    def row(self, values):
        """Without what no observation or reward reads."""
        dropped = ("model/", "ctrl", "extra/last_ctrl", "extra/opponent_noise", "extra/init_q")
        kept = {name: value for name, value in values.items() if not name.startswith(dropped) and name != "extra/goal"}
        return kept | {"control": values["extra/last_ctrl"]}

    def reduced(self, name, value):
        """The row with the columns of what the class asks for."""
        base = name.removeprefix("derived/")
        model = self.model
        counts = {"site": ("site", model.nsite), "body": ("body", model.nbody), "x": ("body", model.nbody),
                  "cvel": ("body", model.nbody), "geom": ("geom", model.ngeom), "sensordata": ("sensor", model.nsensor)}
        for prefix, (kind, count) in counts.items():
            if base.startswith(prefix) and (name != base or prefix in ("site", "body")):
                return columns(value, self.used[kind], count)
        return value

    def probe(self):
        """A state whose arrays were drawn, observed and rewarded without a forward pass."""
        env, data, rng = self.env, self.data, self.rng
        before = {name: np.array(getattr(data, name)) for name in ["qpos", "qvel", "act", "mocap_pos"] + self.read}
        time = data.time
        spread = rng.choice(SPREADS)
        data.time = rng.choice([1, 15, 100 if not hasattr(env, "maxTime") else 2000]) * env.dt
        data.qpos[:] = self.positions(spread)
        data.qvel[:] = rng.normal(0, spread, self.model.nv)
        if self.model.na:
            data.act[:] = rng.uniform(0, 1, self.model.na)
        centre = data.xpos[1:].mean(axis=0)
        if rng.random() < 0.3:
            centre[2] = rng.uniform(0, 0.3)
        for name in self.read:
            getattr(data, name)[:] = self.drawn(name, before[name], centre, spread)
        if hasattr(env, "opponent"):
            env.opponent.opponent_vel = np.zeros(2)
            data.mocap_pos[0, :2] = data.body("pelvis").xpos[:2] + rng.normal(0, 4 * spread, 2)
        values = self.seen()
        for name, value in before.items():
            getattr(data, name)[:] = value
        data.time = time
        return values

    def positions(self, spread):
        """Around what the class wants, where it wants joint positions; else around the present ones."""
        env, model, rng = self.env, self.model, self.rng
        centre = np.array(self.data.qpos)
        if hasattr(env, "obj_goal"):
            centre[env.obj["dof_adrs"]] = env.obj_goal
        for wanted in ["target_jnt_value", "target_pose"]:
            if hasattr(env, wanted):
                target = np.asarray(getattr(env, wanted))
                centre[:len(target)] = target
        if type(env).__name__ == "StandBaseV0":
            centre[list(env.dof_range)] = 0
        if type(env).__name__ in ("DoorEnvV1", "KeyTurnEnvV0"):
            centre[-2:] = rng.uniform(0, 7 if "Key" in type(env).__name__ else 1.6, 2)
        if hasattr(env, "ref"):
            centre[:3] += rng.uniform(-0.6, 0.6, 3)
            centre[-6:-3] = env.ref.reference["object"][0, :3]
        return centre + rng.normal(0, spread * rng.choice([1, 8]), model.nq)

    def drawn(self, name, present, centre, spread):
        """Positions close to each other, rotations close to none, the rest scaled."""
        rng = self.rng
        if name in ("site_xpos", "xpos", "xipos", "geom_xpos"):
            return centre + rng.normal(0, spread, present.shape) + self.lengthwise(name, len(present))
        if name in ("xquat", "xmat", "site_xmat", "ximat"):
            from robohive.utils.quat_math import euler2mat, euler2quat
            angles = rng.normal(0, spread, (len(present), 3))
            return euler2quat(angles) if name == "xquat" else euler2mat(angles).reshape(-1, 9)
        return present * rng.uniform(0.5, 1.5, present.shape) + rng.normal(0, spread, present.shape)

    def lengthwise(self, name, count):
        """Ends of an object and of its goal apart along one axis; a goal shown beside its object where it is shown."""
        kind, offsets = name.split("_")[0], np.zeros((count, 3))
        for end, side in [("top", 0.05), ("bot", -0.05)]:
            ends = [getattr(self.model, kind)(n).id for n in self.asked.names.get(kind, []) if end in n]
            offsets[ends, 2] = side
        if kind == "site" and hasattr(self.env, "goal_obj_offset"):
            offsets[self.env.goal_sid] += self.env.goal_obj_offset
        return offsets

    def seen(self):
        env = self.env
        env.obs_dict = env.get_obs_dict(env.sim_obsd)
        obs = np.concatenate([np.ravel(env.obs_dict[key]) for key in env.obs_keys])
        observed = {key: np.array(value) for key, value in env.obs_dict.items()}
        env.expand_dims(env.obs_dict)
        env.rwd_dict = env.get_reward_dict(env.obs_dict)
        env.squeeze_dims(env.rwd_dict)
        env.obs_dict = observed
        recorder = self.recorder
        return self.row(recorder.state() | recorder.reports(obs) | recorder.rewards() | recorder.seen)

    def probes(self):
        """Probes that differ in what their discrete terms say, as many as PROBES."""
        kept = {}
        for _ in range(TRIALS):
            values = self.probe()
            sign = tuple(round(float(values["rwd_dict/" + term][0]), 1) for term in TERMS
                         if "rwd_dict/" + term in values)
            kept.setdefault(sign, values)
        signs = list(kept)
        order = [min(signs, key=lambda s: -s[0])]
        while len(order) < min(PROBES, len(signs)):
            order.append(max((s for s in signs if s not in order),
                             key=lambda s: min(sum(a != b for a, b in zip(s, o)) for o in order)))
        return [kept[sign] for sign in order]

    def arrays(self):
        rows = self.rows + self.probes()
        names = [name for name in rows[0] if name in rows[-1]]
        stacked = {name: np.stack([self.reduced(name, np.atleast_1d(row[name])) for row in rows]) for name in names}
        return {name: value for name, value in stacked.items() if value.size}

    def meta(self):
        full = json.loads(bytes(self.recorder.meta()))
        model, plain, poses = self.model, self.tools.plain, self.recorder.poses
        masses = self.recorder.compiled["body_mass"]
        out = {key: full[key] for key in ["id", "entry_point", "class", "kwargs", "overrides", "versions", "horizon",
                                          "dt", "frame_skip", "timestep", "normalize_act", "act_mode", "obs_keys",
                                          "rwd_keys_wt", "proprio_keys", "sizes"]}
        out["joints"] = [self.named("joint", j) | {
            "type": int(model.jnt_type[j]), "range": plain(model.jnt_range[j]),
            "qpos0": plain(model.qpos0[model.jnt_qposadr[j]:self.end(j)])} for j in range(model.njnt)]
        out["actuators"] = [self.named("actuator", a) | {
            "ctrlrange": plain(model.actuator_ctrlrange[a]),
            "muscle": bool(model.actuator_dyntype[a] == 4)} for a in range(model.nu)]
        out["sites"] = [self.named("site", i) | {
            "xpos": plain(poses["site_xpos"][i]), "xquat": self.quat(poses["site_xmat"][i])} for i in self.used["site"]]
        out["bodies"] = [self.named("body", i) | {"mass": float(masses[i])} | {
            key: plain(poses[key][i]) for key in ["xpos", "xquat", "xipos"]} for i in self.used["body"]]
        out["geoms"] = [self.named("geom", i) | {"xpos": plain(poses["geom_xpos"][i])} for i in self.used["geom"]]
        out["sensors"] = [self.named("sensor", i) for i in self.used["sensor"]]
        out["keys"] = plain(model.key_qpos) if type(self.env).__name__ in READS_KEYS else []
        return np.frombuffer(json.dumps(out).encode(), np.uint8)

    def named(self, kind, index):
        name = getattr(self.model, kind)(index).name
        return {"name": name if name in self.asked.names[kind] else ""}

    def end(self, joint):
        """Where the joint's positions end in qpos."""
        return self.model.jnt_qposadr[joint] + {0: 7, 1: 4}.get(int(self.model.jnt_type[joint]), 1)

    def quat(self, matrix):
        from robohive.utils.quat_math import mat2quat
        return self.tools.plain(mat2quat(np.reshape(matrix, (3, 3))))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ids", nargs="*", help="ids to record instead of one of each class")
    parser.add_argument("--out", required=True, type=Path, help="folder of the archives; it is made")
    args = parser.parse_args()
    args.out = args.out.resolve()
    tools = recorder()
    for name in args.ids or IDS:
        with contextlib.redirect_stdout(io.StringIO()):
            states = States(tools, name)
            arrays = states.arrays() | {"meta": states.meta()}
            tools.save(args.out / f"{name}.npz", arrays)
        print("recorded", name, len(arrays["time"]), "states", flush=True)


if __name__ == "__main__":
    main()
