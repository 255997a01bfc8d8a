"""What is written for LeRobot is loaded by the real package, and read back without it."""

import json

import numpy as np
import pytest
from data_samples import picture, record
from robohive import data

WITHOUT_LEROBOT = "not checked: loading with LeRobotDataset (pip install lerobot==0.4.4)"


def loaded(root, **settings):
    """The dataset as LeRobot loads it, without asking any server."""
    pytest.importorskip("lerobot", reason=WITHOUT_LEROBOT)
    from lerobot.datasets.lerobot_dataset import LeRobotDataset

    return LeRobotDataset("robohive/test", root=root, **settings)


@pytest.fixture(autouse=True)
def offline(monkeypatch, tmp_path):
    monkeypatch.setenv("HF_HUB_OFFLINE", "1")
    monkeypatch.setenv("HF_HOME", str(tmp_path / "hf"))
    monkeypatch.setenv("HF_DATASETS_CACHE", str(tmp_path / "hf" / "datasets"))


def check_numbers(dataset, trials):
    """Frames are those of the trials, in single precision."""
    index = 0
    for number, rows in enumerate(trials):
        for step in range(len(rows["time"]) - 1):
            frame = dataset[index]
            expected = {
                "observation.state": rows["observations"][step],
                "action": rows["actions"][step],
                "next.reward": rows["rewards"][step + 1],
            }
            for key, value in expected.items():
                np.testing.assert_array_equal(frame[key].numpy(), value.astype(np.float32))
            assert bool(frame["next.done"]) == bool(rows["done"][step + 1])
            assert bool(frame["next.success"]) == bool(rows["env_infos/solved"][step + 1])
            assert (int(frame["index"]), int(frame["episode_index"]), int(frame["frame_index"])) == (index, number, step)
            assert frame["task"] == "open the door"
            np.testing.assert_allclose(frame["timestamp"].numpy(), step / 25, rtol=1e-6)
            index += 1
    assert len(dataset) == index


def test_a_recording_loads_unchanged(tmp_path):
    trials = record(tmp_path / "trials.h5")
    done = data.export_lerobot(tmp_path / "trials.h5", tmp_path / "set", task="open the door", robot="adroit")
    assert done.episodes == 12 and "env_infos/count" in done.dropped
    dataset = loaded(tmp_path / "set")
    assert dataset.fps == 25 and dataset.num_episodes == 12 and dataset.meta.robot_type == "adroit"
    check_numbers(dataset, trials)
    some = loaded(tmp_path / "set", episodes=[3, 7])
    assert {int(some[i]["episode_index"]) for i in range(len(some))} == {3, 7}
    ahead = loaded(tmp_path / "set", delta_timestamps={"action": [0, 0.04, 0.08]})
    frame = ahead[0]
    np.testing.assert_array_equal(frame["action"].numpy(), trials[0]["actions"][:3].astype(np.float32))
    every = np.concatenate([rows["observations"][:-1] for rows in trials]).astype(np.float32)
    stats = dataset.meta.stats["observation.state"]
    np.testing.assert_allclose(stats["mean"], every.mean(axis=0), rtol=1e-5, atol=1e-6)
    np.testing.assert_allclose(stats["std"], every.std(axis=0), rtol=1e-5)
    np.testing.assert_array_equal(stats["max"], every.max(axis=0))
    assert stats["count"] == len(every)


def test_pictures_in_the_tables_are_exact(tmp_path):
    trials = record(tmp_path / "trials.h5", trials=3, pictures=True)
    data.export_lerobot(tmp_path / "trials.h5", tmp_path / "set", task="open the door", pictures="png")
    own = data.LeRobotFrames(tmp_path / "set")
    assert own[1]["observation.images.top_cam"][0].startswith(b"\x89PNG")
    dataset = loaded(tmp_path / "set")
    check_numbers(dataset, trials)
    for step in range(4):
        shown = dataset[step]["observation.images.top_cam"].numpy() * 255
        np.testing.assert_array_equal(shown.round().astype(np.uint8).transpose(1, 2, 0), picture(step))
    assert dataset.meta.stats["observation.images.top_cam"]["mean"].shape == (3, 1, 1)


def test_pictures_in_videos_are_close(tmp_path):
    trials = record(tmp_path / "trials.h5", trials=3, pictures=True)
    data.export_lerobot(tmp_path / "trials.h5", tmp_path / "set", task="open the door")
    assert len(list((tmp_path / "set" / "videos").rglob("*.mp4"))) == 3
    pytest.importorskip("torchcodec", reason="not checked: videos (pip install torchcodec)")
    dataset = loaded(tmp_path / "set", video_backend="torchcodec")
    check_numbers(dataset, trials)
    for index in (0, 3, 4, 8, 9, 13):
        frame = dataset[index]
        shown = frame["observation.images.top_cam"].numpy().transpose(1, 2, 0)
        wrong = np.abs(shown - picture(int(frame["frame_index"])) / 255)
        assert wrong.mean() < 0.02 and shown.shape == (32, 48, 3)


def test_it_comes_back(tmp_path):
    record(tmp_path / "trials.h5")
    data.export_lerobot(tmp_path / "trials.h5", tmp_path / "set")
    frames = data.LeRobotFrames(tmp_path / "set")
    assert len(frames) == 12 and frames.info["codebase_version"] == "v3.0"
    for number, episode in enumerate(data.open(tmp_path / "trials.h5").episodes()):
        back = frames.episode(number)
        np.testing.assert_array_equal(back.observations, episode.observations[:-1].astype(np.float32))
        np.testing.assert_array_equal(back.actions, episode.actions.astype(np.float32))
        np.testing.assert_array_equal(back.rewards, episode.rewards.astype(np.float32))
        np.testing.assert_array_equal(back.terminations, episode.terminations)
        np.testing.assert_array_equal(back.truncations, episode.truncations)
        assert back.task == "door-v1"


def test_features_of_every_type_and_shape(tmp_path):
    rng = np.random.default_rng(0)
    episodes = [
        {
            "observation.state": rng.standard_normal((steps, 4)).astype(np.float32),
            "observation.map": rng.standard_normal((steps, 2, 3)),
            "observation.cube": rng.standard_normal((steps, 2, 3, 4)).astype(np.float32),
            "count": rng.integers(0, 9, steps),
            "flags": rng.random((steps, 3)) > 0.5,
            "small": rng.integers(0, 9, (steps, 2)).astype(np.uint8),
            "half": rng.standard_normal(steps).astype(np.float16),
        }
        for steps in (1, 300, 7)
    ]
    with data.LeRobotWriter(tmp_path / "set", fps=12.5) as writer:
        for number, episode in enumerate(episodes):
            writer.add(episode, task=f"task {number % 2}")
        assert not (tmp_path / "set").exists()
    own = data.LeRobotFrames(tmp_path / "set")
    for expected, frames in zip(episodes, own, strict=True):
        for key, array in expected.items():
            np.testing.assert_array_equal(frames[key], array)
    assert [own.episode_task(i) for i in range(3)] == ["task 0", "task 1", "task 0"]
    dataset = loaded(tmp_path / "set")
    assert len(dataset) == 308 and dataset.fps == 12.5
    frame = dataset[301]
    for key, array in episodes[2].items():
        # LeRobot makes all floats single.
        single = array[0].astype(np.float32) if array.dtype == np.float64 else array[0]
        np.testing.assert_array_equal(frame[key].numpy(), single)
    assert frame["task"] == "task 0" and list(dataset.meta.tasks.index) == ["task 0", "task 1"]


def test_what_lerobot_wrote_is_read(tmp_path):
    pytest.importorskip("lerobot", reason=WITHOUT_LEROBOT)
    from lerobot.datasets.lerobot_dataset import LeRobotDataset

    features = {
        "observation.state": {"dtype": "float32", "shape": (3,), "names": None},
        "action": {"dtype": "float64", "shape": (2,), "names": None},
        "flag": {"dtype": "bool", "shape": (1,), "names": None},
    }
    theirs = LeRobotDataset.create("robohive/theirs", fps=10, root=tmp_path / "set", features=features)
    rng = np.random.default_rng(0)
    written = []
    for length in (4, 9, 2):
        rows = []
        for _ in range(length):
            row = {
                "observation.state": rng.standard_normal(3).astype(np.float32),
                "action": rng.standard_normal(2),
                "flag": np.array([rng.random() > 0.5]),
            }
            rows.append(row)
            theirs.add_frame({**row, "task": f"task {length}"})
        theirs.save_episode()
        written.append(rows)
    theirs.finalize()
    own = data.LeRobotFrames(tmp_path / "set")
    for number, (rows, frames) in enumerate(zip(written, own, strict=True)):
        for key in features:
            np.testing.assert_array_equal(frames[key], np.stack([row[key] for row in rows]).reshape(frames[key].shape))
        assert own.episode(number).task == f"task {len(rows)}"


def test_bad_input_is_named(tmp_path):
    record(tmp_path / "trials.h5")
    with pytest.raises(FileNotFoundError, match="missing.h5"):
        data.export_lerobot(tmp_path / "missing.h5", tmp_path / "set")
    data.export_lerobot(tmp_path / "trials.h5", tmp_path / "set")
    with pytest.raises(FileExistsError, match="set: the folder exists"):
        data.export_lerobot(tmp_path / "trials.h5", tmp_path / "set")
    with pytest.raises(IndexError, match="no episode 12"):
        data.LeRobotFrames(tmp_path / "set")[12]
    with pytest.raises(ValueError, match="no form of pictures"):
        data.LeRobotWriter(tmp_path / "other", fps=10, pictures="gif")
    for fps in (0, -1, np.nan):
        with pytest.raises(data.DataError, match="positive number"):
            data.LeRobotWriter(tmp_path / "other", fps=fps)
    with pytest.raises(data.DataError, match="at least one episode"), data.LeRobotWriter(tmp_path / "other", fps=1):
        pass
    with data.LeRobotWriter(tmp_path / "other", fps=10) as writer:
        writer.add({"action": np.zeros((4, 2))}, "t")
        for wrong, message in (
            ({"action": np.zeros((4, 3))}, "episode 1, action.*shape .3., float64 of shape .2. in the first"),
            ({"other": np.zeros((4, 2))}, "episode 1, other.*the first episode does not have it"),
            ({"action": np.zeros((4, 2)), "b": np.zeros(3)}, "episode 1, b.*3 frames, where \"action\" has 4"),
            ({"action": np.zeros((0, 2))}, "a frame at least"),
            ({"a/b": np.zeros((4, 2))}, "has no /"),
            ({"index": np.zeros(4)}, "the writer sets this"),
            ({}, "no features"),
        ):
            with pytest.raises(data.DataError, match=message):
                writer.add(wrong, "t")
    assert len(data.LeRobotFrames(tmp_path / "other")) == 1


def test_what_fails_leaves_nothing(tmp_path):
    def stop(done, total):
        raise RuntimeError("enough")

    record(tmp_path / "trials.h5")
    with pytest.raises(RuntimeError, match="enough"):
        data.export_lerobot(tmp_path / "trials.h5", tmp_path / "set", progress=stop)
    with pytest.raises(RuntimeError), data.LeRobotWriter(tmp_path / "set", fps=10) as writer:
        writer.add({"action": np.zeros((4, 2))}, "t")
        raise RuntimeError
    odd = {"observation.images.a": np.zeros((2, 33, 40, 3), dtype=np.uint8)}
    with pytest.raises(data.DataError, match="40 x 33 pixels: the sides of videos must be even"):
        with data.LeRobotWriter(tmp_path / "set", fps=10) as writer:
            writer.add(odd, "t")
    assert [path.name for path in tmp_path.iterdir()] == ["trials.h5"]


def test_damage_is_named(tmp_path):
    record(tmp_path / "trials.h5")
    root = tmp_path / "set"
    data.export_lerobot(tmp_path / "trials.h5", root)
    table = root / "data" / "chunk-000" / "file-000.parquet"
    whole = table.read_bytes()
    table.write_bytes(whole[: len(whole) // 2])
    with pytest.raises(data.DataError, match=r"file-000\.parquet: no Parquet file, or a damaged one"):
        data.LeRobotFrames(root)[0]
    table.unlink()
    with pytest.raises(data.DataError, match=r"file-000\.parquet.*No such file"):
        data.LeRobotFrames(root)[0]
    info = root / "meta" / "info.json"
    info.write_text(json.dumps({**json.loads(info.read_text()), "codebase_version": "v2.1"}))
    with pytest.raises(data.DataError, match="version v2.1 is not read"):
        data.LeRobotFrames(root)
    info.write_text("{")
    with pytest.raises(data.DataError, match="info.json: no valid JSON"):
        data.LeRobotFrames(root)
