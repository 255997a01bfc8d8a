#!/usr/bin/env python3
"""Records what RoboHive's own Python computes: observations, rewards and reset draws of its environments.

    pip install robohive==0.7.0 mujoco==3.1.3 dm-control==1.0.16 gymnasium==0.29.1
    python robohive.py --out DIR                      every id of the list below, at least one a registered class
    python robohive.py --out DIR --jobs 2 ID [ID ...] only these

A recorded id is skipped, so that an interrupted run goes on where it stopped (`--again` records it once more).
RoboHive's model files must be where its package expects them. Encoders and rendering are not needed: an id with
visual keys is constructed without them, and its `meta` says so.

DIR/ID.npz, one episode of T seeded actions, T+1 rows, row 0 after `env.seed(S)` and `env.reset()`:

    seed, actions                   S; (T, nu) as given to `step`
    time qpos qvel act mocap_pos mocap_quat site_pos site_quat body_pos body_quat ctrl
                                    the state at the end of `reset` or `step`, flat rows; absent arrays are left out
    obs, obs_dict/KEY, rwd_dict/KEY what the environment reports; rewards of row 0 are those of the first observation
    reward terminated truncated     T rows, what `step` returned
    derived/NAME                    arrays of MjData that the class reads, when it made the observation
    extra/NAME                      task state outside model and data, when the class made the observation
    model/NAME                      arrays of MjModel that differ from the compiled model in some row
    meta                            JSON, as bytes: the environment, its names, sizes, keys and weights, versions

`extra` and `model` arrays that are the same in all rows have a single row. The environment is constructed with
`seed=S` as well: some classes keep the generator of their construction, which `env.seed` does not replace. numpy's
global generator is seeded with S before the reset.

DIR/draws/ID.npz, for a fresh environment a seed: the state after `seed(S)` and `reset()`, and after a second
`reset()`; rows in the order of `seed` and `episode`, under the same names, `extra` as at the end of the reset.
"""

import argparse
import contextlib
import fcntl
import io
import json
import os
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:] = [folder for folder in sys.path if Path(folder or ".").resolve() != HERE]
os.environ.setdefault("ROBOHIVE_VERBOSITY", "SILENT")

import numpy as np

SEED = 20260
STEPS = 30
DRAW_SEEDS = [0, 1, 2, 3, 123456789]

STATE = ["qpos", "qvel", "act", "mocap_pos", "mocap_quat"]
POSES = ["site_pos", "site_quat", "body_pos", "body_quat"]

WORLD = ["site_xpos", "site_xmat", "xpos", "xquat", "xipos", "geom_xpos"]

EDITS = ["geom_type", "geom_size", "geom_pos", "geom_quat", "geom_friction", "geom_condim", "geom_contype",
         "geom_conaffinity", "geom_rbound", "geom_aabb", "geom_rgba", "body_mass", "body_inertia", "body_ipos",
         "actuator_gainprm", "actuator_biasprm", "site_size", "hfield_data"]

HIDDEN = ["last_ctrl", "counter", "steps", "target_jnt_value", "target_pose", "obj_goal", "interact_sid", "x_radius",
          "y_radius", "goal", "which_task", "current_task", "ball_1_starting_angle", "ball_2_starting_angle",
          "init_qpos", "init_qvel", "_lift_z", "goal_init_pos", "goal_obj_offset", "object_init_pos", "key_init_pos",
          "pen_length", "tar_length", "init_body_pos", "robot_base_pos", "robot_meanpos", "MVC_rest"]

POLICIES = ["static_stationary", "stationary", "random", "repeller", "chase_player"]

SITES = ["site_xpos"]
FRAMES = ["site_xpos", "site_xmat"]
MUSCLES = ["actuator_length", "actuator_velocity", "actuator_force"]
OBJECTS = ["site_xpos", "xpos", "xquat"]
LEGS = ["xpos", "xquat", "xipos", "cvel"] + MUSCLES

# Arrays of MjData that each registered class reads in its observation, reward or step; module of the class, class.
READS = {
    "reach_base_v0:ReachBaseV0": SITES, "push_base_v0:PushBaseV0": SITES, "pick_place_v0:PickPlaceV0": SITES,
    "reorient_v0:ReorientBaseV0": FRAMES, "reorient_v0:ReorientEnvV0": FRAMES,
    "franka_robotiq_data_v0:FrankaRobotiqData": FRAMES,
    "franka_ee_pose_v0:FrankaEEPose": [], "franka_ee_pose_v0:FrankaRobotiqPose": [],
    "hands:DoorEnvV1": SITES, "hands:HammerEnvV1": OBJECTS + ["sensordata"], "hands:PenEnvV1": OBJECTS,
    "hands:RelocateEnvV1": OBJECTS, "hands:BaodingFixedEnvV1": OBJECTS,
    "franka_kitchen_v2:FrankaKitchen": FRAMES, "franka_appliance_v1:FrankaAppliance": FRAMES,
    "orient_v0:OrientBaseV0": FRAMES, "stand_v0:StandBaseV0": FRAMES, "walk_v0:WalkBaseV0": FRAMES,
    "pose_v0:PoseEnvV0": SITES, "reach_v0:ReachEnvV0": SITES, "key_turn_v0:KeyTurnEnvV0": SITES,
    "obj_hold_v0:ObjHoldFixedEnvV0": SITES, "obj_hold_v0:ObjHoldRandomEnvV0": SITES,
    "pen_v0:PenTwirlFixedEnvV0": OBJECTS, "pen_v0:PenTwirlRandomEnvV0": OBJECTS,
    "reorient_sar_v0:Geometries8EnvV0": OBJECTS + ["geom_xpos"] + MUSCLES,
    "reorient_sar_v0:Geometries100EnvV0": OBJECTS + ["geom_xpos"] + MUSCLES,
    "reorient_sar_v0:InDistribution": OBJECTS + ["geom_xpos"] + MUSCLES,
    "reorient_sar_v0:OutofDistribution": OBJECTS + ["geom_xpos"] + MUSCLES,
    "baoding_v1:BaodingEnvV1": SITES, "walk_v0:ReachEnvV0": SITES, "walk_v0:WalkEnvV0": LEGS,
    "walk_v0:TerrainEnvV0": LEGS, "relocate_v0:RelocateEnvV0": FRAMES,
    "chasetag_v0:ChaseTagEnvV0": OBJECTS + ["sensordata"] + MUSCLES, "myodm_v0:TrackEnv": ["xipos", "ximat"],
}

FIRST = """FrankaReachRandom-v0 FrankaPushRandom-v0 FrankaPickPlaceRandom-v0 TrifingerReachRandom-v0
rpFrankaDmanusPoseRandom-v0 rpFrankaRobotiqPoseRandom-v0 rpFrankaRobotiqData-v0 DKittyWalkRandom-v0
DKittyOrientRandom-v0 DKittyStandRandom-v0 FK1_MicroOpenRandom-v4 franka_micro_random-v3 door-v1 hammer-v1 pen-v1
relocate-v1 baoding-v1 myoElbowPose1D6MRandom-v0 myoHandPoseRandom-v0 myoHandReachRandom-v0 myoHandKeyTurnRandom-v0
myoHandObjHoldFixed-v0 myoHandObjHoldRandom-v0 myoHandPenTwirlFixed-v0 myoHandPenTwirlRandom-v0 myoHandReorient8-v0
myoHandReorient100-v0 myoHandReorientID-v0 myoHandReorientOOD-v0 myoHandBaodingFixed-v1 myoLegStandRandom-v0
myoLegWalk-v0 myoLegRoughTerrainWalk-v0 myoChallengeDieReorientP2-v0 myoChallengeRelocateP2-v0
myoChallengeBaodingP2-v1 myoChallengeChaseTagP2-v0 MyoHandAirplaneFly-v0""".split()

REST = """FrankaReachFixed-v0 FetchReachRandom-v0 FetchReachFixed-v0 FrankaPushFixed-v0 FrankaPickPlaceFixed-v0
FrankaReachRandom_v2d-v0 TrifingerReachFixed-v0 TrifingerReachRandom_v2d-v0 rpFrankaDmanusPoseFixed-v0
rpFrankaRobotiqPoseFixed-v0 DKittyWalkFixed-v0 DKittyOrientFixed-v0 DKittyStandFixed-v0 DKittyStandRandom_v2d-v0
FK1_RelaxFixed-v4 FK1_RelaxRandom-v4 FK1_MicroOpenFixed-v4 FK1_MicroCloseRandom-v4 FK1_RdoorOpenRandom-v4
FK1_LdoorCloseFixed-v4 FK1_SdoorOpenRandom-v4 FK1_LightOnRandom-v4 FK1_LightOffFixed-v4 FK1_Knob1OnRandom-v4
FK1_Knob3OffRandom-v4 FK1_Stove1KettleRandom-v4 FK1_Stove4KettleFixed-v4 FK1_MicroSlideCloseRandom-v4
FK1_OpenAllRandom-v4 FK1_CloseAllFixed-v4 FK1_MicroOpenRandom_v2d-v4
franka_micro_open-v3 franka_micro_close-v3 franka_slide_open-v3 franka_slide_close-v3 franka_slide_random-v3
door_v2d-v1 baoding4th-v1 baoding8th-v1
motorFingerPoseFixed-v0 motorFingerPoseRandom-v0 motorFingerReachFixed-v0 motorFingerReachRandom-v0
myoFingerPoseFixed-v0 myoFingerPoseRandom-v0 myoFingerReachFixed-v0 myoFingerReachRandom-v0
myoElbowPose1D6MFixed-v0 myoElbowPose1D6MExoFixed-v0 myoElbowPose1D6MExoRandom-v0 myoHandPoseFixed-v0
myoHandPose0Fixed-v0 myoHandPose7Fixed-v0 myoHandReachFixed-v0 myoHandKeyTurnFixed-v0 myoHandBaodingRandom-v1
myoHandBaodingFixed4th-v1 myoHandBaodingFixed8th-v1 myoLegHillyTerrainWalk-v0 myoLegStairTerrainWalk-v0
myoSarcElbowPose1D6MRandom-v0 myoFatiElbowPose1D6MRandom-v0 myoFatiElbowPose1D6MExoRandom-v0
myoSarcFingerReachRandom-v0 myoFatiFingerPoseRandom-v0 myoSarcHandPoseRandom-v0 myoFatiHandPoseRandom-v0
myoReafHandPoseRandom-v0 myoReafHandReachRandom-v0 myoReafHandKeyTurnRandom-v0 myoReafHandBaodingFixed-v1
myoSarcHandReorient8-v0 myoReafHandReorient100-v0 myoFatiHandObjHoldRandom-v0 myoFatiLegWalk-v0 myoSarcLegWalk-v0
myoSarcLegStandRandom-v0 myoFatiLegHillyTerrainWalk-v0 myoSarcLegStairTerrainWalk-v0
myoChallengeDieReorientDemo-v0 myoChallengeDieReorientP1-v0 myoChallengeRelocateP1-v0 myoChallengeRelocateP2eval-v0
myoChallengeBaodingP1-v1 myoChallengeChaseTagP1-v0 myoChallengeChaseTagP2eval-v0
MyoHandAirplaneFixed-v0 MyoHandAirplaneRandom-v0 MyoHandPiggybankPass-v0 MyoHandWatchLift-v0 MyoHandCupPour-v0
MyoHandHandInspect-v0 MyoHandWineglassRandom-v0""".split()


def plain(value):
    """The value as JSON knows it."""
    if isinstance(value, dict):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple, set)) or type(value).__name__ == "dict_keys":
        return [plain(v) for v in value]
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, np.generic):
        return value.item()
    return value if isinstance(value, (str, int, float, bool, type(None))) else str(value)


def row(value):
    """The value as one flat row of float64, None for what is not a number."""
    if hasattr(value, "value") and hasattr(value, "name"):
        value = value.value
    if isinstance(value, dict):
        value = list(value.values())
    try:
        return np.array(value, dtype=np.float64).ravel()
    except (TypeError, ValueError):
        return None


@contextlib.contextmanager
def construction_lock():
    """Some classes write a model of fixed name into the package while they are constructed."""
    with open(Path(tempfile.gettempdir()) / "robohive-construction.lock", "w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def construct(name, seed):
    """The environment without gymnasium's wrappers, arrays of its compiled model and world poses before any edit, and
    the arguments that were overridden."""
    import gymnasium
    import robohive  # noqa: F401  registers the ids
    from robohive.physics.sim_scene import SimScene

    compiled, poses = {}, {}
    load = SimScene.__dict__["get_sim"]

    def loading(handle):
        sim = load.__func__(handle)
        compiled.update({array: np.array(getattr(sim.model, array)) for array in EDITS})
        poses.update({array: np.array(getattr(sim.data, array)) for array in WORLD})
        return sim

    overrides = {"visual_keys": None} if gymnasium.spec(name).kwargs.get("visual_keys") else {}
    SimScene.get_sim = staticmethod(loading)
    try:
        with construction_lock():
            env = gymnasium.make(name, seed=seed, **overrides).unwrapped
    finally:
        SimScene.get_sim = load
    return env, compiled, poses, overrides


class Snapshots:
    """Rows of named arrays; a name that is missing in some rows is an error."""

    def __init__(self):
        self.rows = []

    def add(self, values):
        self.rows.append(values)

    def arrays(self, single=()):
        """One array a name; a constant one whose name starts with a prefix of `single` keeps one row."""
        out = {}
        for name in self.rows[0]:
            stacked = np.stack([np.atleast_1d(values[name]) for values in self.rows])
            constant = name.startswith(tuple(single)) and (stacked == stacked[0]).all()
            out[name] = stacked[:1] if constant else stacked
        return out


class Recorder:
    """An environment whose observations are watched: what they read is kept when they are made."""

    def __init__(self, name, seed):
        self.name = name
        self.env, self.compiled, self.poses, self.overrides = construct(name, seed)
        self.entry = ":".join([type(self.env).__module__.rpartition(".")[2], type(self.env).__name__])
        if ".hands." in type(self.env).__module__:
            self.entry = "hands:" + type(self.env).__name__
        self.seen = {}
        observe = self.env.get_obs_dict

        def watched(sim):
            out = observe(sim)
            self.seen = self.derived() | self.extra()
            return out

        self.env.get_obs_dict = watched

    def derived(self):
        data = self.env.sim.data
        out = {"derived/" + array: np.array(getattr(data, array), np.float64).ravel() for array in READS[self.entry]}
        out["derived/ncon"] = np.array([data.ncon], np.float64)
        if getattr(self.env, "muscle_condition", "") == "fatigue":
            moment = np.array(data.actuator_moment)
            out["derived/actuator_moment_read"] = moment[:, min(1, moment.shape[1] - 1)].ravel()
        return out

    def extra(self):
        out = {"extra/" + name.lstrip("_"): row(getattr(self.env, name)) for name in HIDDEN if hasattr(self.env, name)}
        out |= {"extra/dof_" + key: row(self.env.obj["dof_" + key]) for key in ["adrs", "proximity"]
                if hasattr(self.env, "obj")}
        opponent = getattr(self.env, "opponent", None)
        if opponent:
            out["extra/opponent_policy"] = row(POLICIES.index(opponent.opponent_policy))
            out["extra/opponent_vel"] = row(opponent.opponent_vel)
            out["extra/opponent_chase_velocity"] = row(opponent.chase_velocity)
            out["extra/opponent_noise_index"] = row(opponent.noise_process.idx)
            out["extra/opponent_noise_buffer"] = row(opponent.noise_process.buffer)
        if hasattr(self.env, "ref"):
            out["extra/reference_index"] = row(self.env.ref.index_cache)
        return {name: value for name, value in out.items() if value is not None and value.size}

    def state(self):
        data, model = self.env.sim.data, self.env.sim.model
        out = {"time": np.array([data.time])}
        out |= {name: np.array(getattr(data, name), np.float64).ravel() for name in STATE}
        out |= {name: np.array(getattr(model, name), np.float64).ravel() for name in POSES}
        out["ctrl"] = np.array(data.ctrl, np.float64)
        return {name: value for name, value in out.items() if value.size}

    def edits(self):
        return {"model/" + name: np.array(getattr(self.env.sim.model, name)).ravel() for name in self.compiled}

    def edited(self, arrays):
        """Without the model arrays that no row changes; float64, except height fields."""
        out = {}
        for name, value in arrays.items():
            if name.startswith("model/"):
                if (value == self.compiled[name[6:]].ravel()).all():
                    continue
                value = value.astype(np.float32 if name == "model/hfield_data" else np.float64)
            out[name] = value
        return out

    def reports(self, obs):
        out = {"obs": np.array(obs, np.float64).ravel()}
        out |= {"obs_dict/" + key: row(value) for key, value in self.env.obs_dict.items()}
        return out

    def rewards(self):
        return {"rwd_dict/" + key: row(value) for key, value in self.env.rwd_dict.items()}

    def reset(self):
        """Resets and rewards the first observation, as `forward` would without observing again."""
        env = self.env
        obs = env.reset()
        obs = obs[0] if isinstance(obs, tuple) else obs
        observed = {key: np.array(value) for key, value in env.obs_dict.items()}
        before = self.edits()
        env.expand_dims(env.obs_dict)
        env.rwd_dict = env.get_reward_dict(env.obs_dict)
        env.squeeze_dims(env.rwd_dict)
        env.obs_dict = observed
        return self.state() | before | self.reports(obs) | self.rewards() | self.seen

    def step(self, action):
        obs, reward, terminated, truncated, _ = self.env.step(action.copy())
        rows = self.state() | self.edits() | self.reports(obs) | self.rewards() | self.seen
        return rows, [float(reward), float(terminated), float(truncated)]

    def seed(self, seed):
        self.env.seed(seed)
        np.random.seed(seed % 2**32)

    def meta(self):
        import gymnasium
        import robohive
        from importlib.metadata import version

        env, model = self.env, self.env.sim.model
        kinds = {"body": model.nbody, "joint": model.njnt, "geom": model.ngeom, "site": model.nsite,
                 "actuator": model.nu, "sensor": model.nsensor, "tendon": model.ntendon}
        names = {kind: [getattr(model, kind)(i).name for i in range(count)] for kind, count in kinds.items()}
        arrays = ["jnt_type", "jnt_qposadr", "jnt_dofadr", "jnt_range", "jnt_bodyid", "body_parentid", "body_geomadr",
                  "body_geomnum", "site_bodyid", "geom_bodyid", "actuator_ctrlrange", "actuator_dyntype",
                  "actuator_trntype", "actuator_trnid", "actuator_actadr", "sensor_type", "sensor_objid", "sensor_adr",
                  "sensor_dim", "body_mass", "qpos0", "key_qpos", "key_qvel"]
        spec = gymnasium.spec(self.name)
        package = str(Path(robohive.__file__).parent) + "/"
        described = {
            "id": self.name, "entry_point": spec.entry_point, "class": type(env).__name__,
            "kwargs": plain(spec.kwargs), "overrides": plain(self.overrides),
            "versions": {name: version(name) for name in ["robohive", "mujoco", "dm-control", "gymnasium", "numpy"]},
            "horizon": spec.max_episode_steps, "dt": env.dt, "frame_skip": env.frame_skip,
            "timestep": model.opt.timestep, "normalize_act": env.normalize_act, "act_mode": env.robot._act_mode,
            "obs_keys": plain(list(env.obs_keys)), "rwd_keys_wt": plain(env.rwd_keys_wt),
            "proprio_keys": plain(env.proprio_keys), "obs_range": plain([env.observation_space.low.min(),
                                                                        env.observation_space.high.max()]),
            "generator": type(env.np_random.bit_generator).__name__, "opponent_policies": POLICIES,
            "sizes": {name: int(getattr(model, name)) for name in ["nq", "nv", "nu", "na", "nmocap", "nsensordata"]},
            "names": names, "arrays": {name: plain(np.array(getattr(model, name))) for name in arrays},
        }
        return np.frombuffer(json.dumps(described).replace(package, "").encode(), np.uint8)


def record(name, seed, steps):
    """The arrays of one episode."""
    recorder = Recorder(name, seed)
    space = recorder.env.action_space
    rng = np.random.default_rng(seed)
    actions = rng.uniform(space.low.astype(np.float64), space.high.astype(np.float64), (steps, space.shape[0]))
    recorder.seed(seed)
    rows, returned = Snapshots(), []
    rows.add(recorder.reset())
    for action in actions:
        values, result = recorder.step(action)
        rows.add(values)
        returned.append(result)
    out = recorder.edited(rows.arrays(single=["extra/", "model/"]))
    out |= dict(zip(["reward", "terminated", "truncated"], np.array(returned).T))
    return out | {"seed": np.int64(seed), "actions": actions, "meta": recorder.meta()}


def draws(name, seeds):
    """The state after two resets for each of `seeds`."""
    rows, order = Snapshots(), []
    for seed in seeds:
        recorder = Recorder(name, seed)
        recorder.seed(seed)
        for episode in range(2):
            rows.add(recorder.reset() | recorder.extra())
            order.append([seed, episode])
    keep = rows.arrays(single=["extra/", "model/", "site_", "body_"])
    keep = {k: v for k, v in keep.items() if not k.startswith("derived/") and k != "ctrl"}
    out = recorder.edited(keep) | dict(zip(["seed", "episode"], np.array(order, np.int64).T))
    return out | {"meta": recorder.meta()}


def save(path, arrays):
    """Whole or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(path.name + ".part")
    with open(part, "wb") as file:
        np.savez_compressed(file, **arrays)
    os.replace(part, path)


def job(name, args):
    """Records one id; what happened, in a line."""
    begin = time.time()
    made = []
    try:
        with contextlib.redirect_stdout(io.StringIO()):
            for path, work in [(args.out / f"{name}.npz", lambda: record(name, args.seed, args.steps)),
                               (args.out / "draws" / f"{name}.npz", lambda: draws(name, DRAW_SEEDS))]:
                if args.again or not path.exists():
                    save(path, work())
                    made.append(path.parent.name if path.parent != args.out else "episode")
    except (Exception, SystemExit) as error:
        return f"FAILED {name} {type(error).__name__}: {error}"
    return f"recorded {name} ({' and '.join(made) or 'was there'}, {time.time() - begin:.1f} s)"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ids", nargs="*", help="ids to record instead of the whole list")
    parser.add_argument("--out", required=True, type=Path, help="folder of the archives; it is made")
    parser.add_argument("--seed", type=int, default=SEED, help=f"seed of the episode and its actions ({SEED})")
    parser.add_argument("--steps", type=int, default=STEPS, help=f"steps of the episode ({STEPS})")
    parser.add_argument("--jobs", type=int, default=1, help="processes (1)")
    parser.add_argument("--again", action="store_true", help="record what is there already, too")
    args = parser.parse_args()
    args.out = args.out.resolve()
    failed = 0
    with ProcessPoolExecutor(args.jobs) as pool:
        for done in as_completed([pool.submit(job, name, args) for name in args.ids or FIRST + REST]):
            print(done.result(), flush=True)
            failed += done.result().startswith("FAILED")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
