"""Recordings of episodes between this project and h5py, in both directions.

    traces.py fixtures              write traces/robohive.h5 and traces/roboset.h5, which the tests read
    traces.py check ROBOHIVE        compare what the command ROBOHIVE reads and writes with h5py and numpy
    traces.py killed FOLDER         open what `cargo xtask crash-safety --keep FOLDER` left, compare with what was promised

Needs numpy and h5py.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

HERE = pathlib.Path(__file__).parent / "traces"
GZIP = dict(compression="gzip", compression_opts=4)


def robohive_trial(group, random, rows, solved_from):
    """A trial as RoboHive's logger writes it: one gzip dataset a name, the last action NaN."""
    time = 0.04 * np.arange(rows)
    actions = random.uniform(-1, 1, (rows, 8))
    actions[-1] = np.nan
    solved = np.arange(rows) >= solved_from
    pose = random.normal(size=(rows, 12))
    values = {
        "time": time,
        "observations": random.normal(size=(rows, 18)),
        "actions": actions,
        "rewards": random.normal(size=rows),
        "done": np.zeros(rows, bool),
        "env_infos/solved": solved,
        "env_infos/rwd_dict/dense": random.normal(size=(rows, 1)).astype(np.float32),
        "env_infos/obs_dict/time": time,
        "env_infos/obs_dict/qp_arm": random.normal(size=(rows, 7)),
        "env_infos/obs_dict/qv_arm": random.normal(size=(rows, 7)).astype(np.float16),
        "env_infos/obs_dict/pos_ee": pose[:, :3],
        "env_infos/obs_dict/rot_ee": pose[:, 3:],
        "env_infos/state/count": np.arange(rows, dtype=np.int32),
        "env_infos/visual_dict/rgb:left_cam:8x12:2d": random.integers(0, 256, (rows, 8, 12, 3), np.uint8),
    }
    for key, value in values.items():
        group.create_dataset(key, data=value, **GZIP)
    group.create_dataset("user_cmt", data=np.float16(1.0))


def roboset_trial(group, random, rows):
    """A trial as RoboSet's files have it."""
    values = {
        "data/time": 0.04 * np.arange(rows),
        "data/ctrl_arm": random.normal(size=(rows, 7)).astype(np.float16),
        "data/ctrl_ee": random.normal(size=(rows, 1)).astype(np.float16),
        "data/qp_arm": random.normal(size=(rows, 7)).astype(np.float16),
        "data/rgb_top": random.integers(0, 256, (rows, 6, 10, 3), np.uint8),
        "derived/pose_ee": random.normal(size=(rows, 12)).astype(np.float16),
    }
    for key, value in values.items():
        group.create_dataset(key, data=value, **GZIP)
    group.create_dataset("config/solved", data=np.float16(1.0))
    group.create_dataset("config/task", data="open the drawer")


def fixtures():
    random = np.random.default_rng(0)
    HERE.mkdir(exist_ok=True)
    with h5py.File(HERE / "robohive.h5", "w") as file:
        for i in (0, 1, 10):
            robohive_trial(file.create_group(f"Trial{i}"), random, 12, 4 + i)
    with h5py.File(HERE / "roboset.h5", "w") as file:
        for i in range(2):
            roboset_trial(file.create_group(f"Trial{i}"), random, 9)


def unusual(path, **options):
    """Types, chunks and filters that h5py can write and RoboHive does not."""
    random = np.random.default_rng(1)
    with h5py.File(path, "w", **options) as file:
        group = file.create_group("Trial0")
        for kind in "bool u1 u2 u4 u8 i1 i2 i4 i8 f2 f4 f8 >i4 >f8 >u2".split():
            group.create_dataset(f"a{kind[-1]}/{kind}", data=(100 * random.random((50, 3))).astype(kind), **GZIP)
        wide = random.normal(size=(50, 37))
        group.create_dataset("b/tiles", data=wide, chunks=(7, 5), shuffle=True, **GZIP)
        group.create_dataset("b/summed", data=wide, chunks=(16, 37), fletcher32=True, shuffle=True, **GZIP)
        group.create_dataset("b/plain", data=wide)
        group.create_dataset("b/bare_chunks", data=wide, chunks=(13, 9))
        group.create_dataset("c/empty", data=np.zeros((50, 0)))
        group.create_dataset("c/none", data=np.zeros((0, 4)))
        group.create_dataset("c/scalar", data=3.5)
        group["c/soft"] = h5py.SoftLink("/Trial0/b/plain")
        image = random.integers(0, 256, (50, 40, 60, 3), np.uint8)
        group.create_dataset("d/rgb", data=image, **GZIP)


def datasets(node):
    """Every dataset below a group, by its path; soft links are followed."""
    found = {}
    for name, member in node.items():
        if isinstance(member, h5py.Group):
            found.update({f"{name}/{below}": value for below, value in datasets(member).items()})
        else:
            found[name] = member[()]
    return found


def read(path):
    if str(path).endswith(".npz"):
        with np.load(path) as archive:
            return {name: archive[name] for name in archive.files}
    with h5py.File(path, "r") as file:
        return datasets(file)


def text(value):
    return value.decode() if isinstance(value, bytes) else value


def differences(expected, found, dtypes=True):
    """What is not equal, of all names."""
    wrong = sorted(set(expected) ^ set(found))
    for name in set(expected) & set(found):
        a, b = text(expected[name]), text(found[name])
        if isinstance(a, str) or isinstance(b, str):
            same = a == b
        else:
            a, b = np.asarray(a), np.asarray(b)
            same = a.shape == b.shape and np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
            same = same and (not dtypes or a.dtype.newbyteorder("<") == b.dtype.newbyteorder("<"))
        if not same:
            wrong.append(name)
    return wrong


def check(command):
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        unusual(folder / "unusual.h5")
        unusual(folder / "v108.h5", libver=("v108", "v108"))
        unusual(folder / "v110.h5", libver=("v110", "v110"))
        unusual(folder / "latest.h5", libver="latest")

        def verdict(what, wrong, count):
            nonlocal failures
            failures += bool(wrong)
            print(f"{what:<58} {count:4} datasets  {'equal' if not wrong else f'DIFFER: {wrong}'}")

        def convert(source, target, *options):
            words = [command, "data", "convert", source, target, "--force", *options]
            done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
            if done.returncode:
                sys.exit(f"{words}: {done.stderr}")

        made = [folder / f"{name}.h5" for name in ("unusual", "v108", "v110", "latest")]
        for source in (HERE / "robohive.h5", HERE / "roboset.h5", *made):
            expected = read(source)
            h5, npz, again = folder / "out.h5", folder / "out.npz", folder / "again.h5"
            convert(source, h5)
            verdict(f"{source.name} (h5py) -> ours.h5, read by h5py", differences(expected, read(h5)), len(expected))
            numbers = {name: value for name, value in expected.items() if not isinstance(text(value), str)}
            convert(source, npz)
            verdict(f"{source.name} (h5py) -> ours.npz, read by numpy", differences(numbers, read(npz)), len(numbers))
            convert(h5, again)
            verdict(f"{source.name}: ours.h5 -> ours.h5, read by h5py", differences(expected, read(again)), len(expected))
            convert(npz, again)
            verdict(f"{source.name}: ours.npz -> ours.h5, read by h5py", differences(numbers, read(again)), len(numbers))

        source = HERE / "robohive.h5"
        reduced = {}
        for name, value in read(source).items():
            small = {"f": np.float16, "i": np.int8, "u": np.uint8}.get(value.dtype.kind, value.dtype)
            reduced[name] = value.astype(small)
        convert(source, folder / "reduced.h5", "--precision", "reduced")
        verdict("reduced precision as numpy's astype", differences(reduced, read(folder / "reduced.h5")), len(reduced))

        convert(source, folder / "set.h5", "--layout", "roboset")
        full, expected = read(source), {}
        for trial in ("Trial0", "Trial1", "Trial10"):
            infos = f"{trial}/env_infos/obs_dict"
            expected[f"{trial}/data/time"] = full[f"{infos}/time"]
            expected[f"{trial}/data/ctrl_arm"] = full[f"{trial}/actions"][:, :7]
            expected[f"{trial}/data/ctrl_ee"] = full[f"{trial}/actions"][:, 7:]
            expected[f"{trial}/data/qp_arm"] = full[f"{infos}/qp_arm"]
            expected[f"{trial}/data/qv_arm"] = full[f"{infos}/qv_arm"]
            expected[f"{trial}/data/rgb_left"] = full[f"{trial}/env_infos/visual_dict/rgb:left_cam:8x12:2d"]
            expected[f"{trial}/derived/pose_ee"] = np.hstack([full[f"{infos}/pos_ee"], full[f"{infos}/rot_ee"]])
            expected[f"{trial}/config/solved"] = full[f"{trial}/user_cmt"]
        verdict("RoboHive -> RoboSet as path2dataset", differences(expected, read(folder / "set.h5")), len(expected))
        convert(folder / "set.h5", folder / "back.h5", "--layout", "robohive")
        back = read(folder / "back.h5")
        wanted = {name: full[name] for name in back}
        verdict("RoboSet -> RoboHive: what went over comes back", differences(wanted, back), len(back))
    sys.exit(bool(failures))


def killed(folder):
    """Every recording of a folder opens, and holds the trials that were finished before its process was killed."""
    files = sorted(pathlib.Path(folder).glob("*.h5"))
    trials = lost = 0
    for path in files:
        promised = json.loads(path.with_suffix(".json").read_text())["finished"]
        with h5py.File(path, "r") as file:
            trials += len(file)
            lost += sum(f"Trial{i}" not in file for i in range(promised))
            for name, trial in file.items():
                rows = trial["time"].shape[0]
                if "image" not in trial:
                    # Of `robohive run`: the columns of a trial are equally long.
                    columns = [column for column in datasets(trial).values() if np.ndim(column)]
                    assert len(columns) > 5 and all(len(column) == rows for column in columns), (path, name)
                    continue
                number = int(name.removeprefix("Trial"))
                assert np.array_equal(trial["time"][()], number + 0.01 * np.arange(rows)), (path, name)
                assert np.array_equal(trial["image"][:, 0, 0, 0], np.arange(rows) % 256), (path, name)
                assert all(len(column) == rows for column in datasets(trial).values()), (path, name)
    print(f"{len(files)} recordings open in h5py {h5py.__version__}, {trials} trials, {lost} of the finished ones lost")
    sys.exit(bool(lost) or not files)


if __name__ == "__main__":
    match sys.argv[1:]:
        case ["fixtures"]:
            fixtures()
        case ["check", command]:
            check(command)
        case ["killed", folder]:
            killed(folder)
        case _:
            sys.exit(__doc__)
