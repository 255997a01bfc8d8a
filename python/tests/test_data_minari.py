"""What is written for Minari is loaded by the real package."""

import json

import gymnasium
import numpy as np
import pytest
from data_samples import TRACES, record
from robohive import data
from robohive.data.collect import Collector
from robohive.data.spaces import space_to_json

minari = pytest.importorskip("minari")

ID = "robohive/door/random-v0"


@pytest.fixture(autouse=True)
def root(tmp_path, monkeypatch):
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path / "minari"))
    return tmp_path / "minari"


class Counter(gymnasium.Env):
    """Ends itself after five steps where the seed is odd; observes in a mapping."""

    observation_space = gymnasium.spaces.Dict(
        image=gymnasium.spaces.Box(0, 255, (32, 32, 3), np.uint8), state=gymnasium.spaces.Box(-np.inf, np.inf, (2,))
    )
    action_space = gymnasium.spaces.Box(-1, 1, (3,))
    spec = gymnasium.envs.registration.EnvSpec("Counter-v0", entry_point="test_data_minari:Counter")

    def _see(self):
        image = np.full((32, 32, 3), self.count, dtype=np.uint8)
        return {"image": image, "state": np.array([self.count, 0.5], dtype=np.float32)}

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        self.odd, self.count = bool((seed or 0) % 2), 0
        return self._see(), {"count": 0, "text": "a"}

    def step(self, action):
        self.count += 1
        return self._see(), float(self.count), self.odd and self.count == 5, False, {"count": self.count, "text": "b"}


def test_a_recording_loads_unchanged(tmp_path):
    trials = record(tmp_path / "trials.h5", pictures=True)
    seen = []
    done = data.export_minari(
        tmp_path / "trials.h5", ID, author="A", description="D", progress=lambda now, all: seen.append((now, all))
    )
    assert done.episodes == 12 and seen == [(i + 1, 12) for i in range(12)] and "config/task" in done.dropped
    dataset = minari.load_dataset(ID)
    assert dataset.id == ID and len(dataset) == 12 and dataset.total_steps == done.steps
    assert dataset.storage.metadata["author"] == {"A"} and dataset.env_spec.id == "door-v1"
    assert list(minari.list_local_datasets()) == [ID]
    assert dataset.observation_space.shape == (6,) and dataset.action_space.dtype == np.float64
    for rows, episode in zip(trials, dataset, strict=True):
        np.testing.assert_array_equal(episode.observations, rows["observations"])
        np.testing.assert_array_equal(episode.actions, rows["actions"][:-1])
        np.testing.assert_array_equal(episode.rewards, rows["rewards"][1:])
        np.testing.assert_array_equal(episode.terminations, rows["done"][1:])
        np.testing.assert_array_equal(episode.infos["obs_dict"]["qp"], rows["env_infos/obs_dict/qp"])
        image = "rgb:top_cam:32x48:2d"
        np.testing.assert_array_equal(episode.infos["visual_dict"][image], rows[f"env_infos/visual_dict/{image}"])
        assert episode.truncations[-1] != episode.terminations[-1]
    seeds = [about["seed"] for about in dataset.storage.get_episode_metadata(range(12))]
    assert seeds == [100 + i for i in range(12)]
    assert len(dataset.filter_episodes(lambda episode: episode.terminations[-1])) == 6


def test_it_comes_back(tmp_path):
    record(tmp_path / "trials.h5")
    data.export_minari(tmp_path / "trials.h5", ID)
    back = data.MinariDataset(ID)
    with data.Recorder(tmp_path / "back.h5") as recorder:
        for episode in back:
            recorder.add(episode)
    first, second = data.open(tmp_path / "trials.h5"), data.open(tmp_path / "back.h5")
    for name in first:
        for key in ("observations", "actions", "done", "env_infos/solved", "env_infos/obs_dict/qp", "seed"):
            np.testing.assert_array_equal(first[name][key].read(), second[name][key].read())
        np.testing.assert_array_equal(first[name]["rewards"][1:], second[name]["rewards"][1:])


def test_minari_adds_to_it_and_combines(tmp_path):
    record(tmp_path / "trials.h5")
    data.export_minari(tmp_path / "trials.h5", ID, infos=False)
    dataset = minari.load_dataset(ID)
    buffer = minari.data_collector.EpisodeBuffer(
        observations=np.zeros((3, 6)),
        actions=np.zeros((2, 3)),
        rewards=[0.0, 1.0],
        terminations=[False, True],
        truncations=[False, False],
        infos={},
    )
    dataset.update_dataset_from_buffer([buffer])
    again = minari.load_dataset(ID)
    assert len(again) == 13 and again[12].rewards[1] == 1.0
    data.export_minari(tmp_path / "trials.h5", "robohive/door/other-v0", infos=False)
    parts = [minari.load_dataset("robohive/door/other-v0"), again]
    assert minari.combine_datasets(parts, "robohive/door/both-v0").total_episodes == 25


def test_files_of_the_original_load(tmp_path):
    data.export_minari(TRACES / "robohive.h5", "robohive/original/franka-v3")
    dataset = minari.load_dataset("robohive/original/franka-v3")
    # Its trials are Trial0, Trial1, Trial10.
    trial = data.open(TRACES / "robohive.h5")["Trial10"]
    np.testing.assert_array_equal(dataset[2].observations, trial["observations"].read())


def test_an_environment_is_collected_as_it_runs():
    env = Counter()
    with data.MinariWriter(ID, env=env) as writer:
        collector = Collector(env, writer, infos=True)
        for seed in range(4):
            collector.reset(seed=seed)
            for _ in range(5):
                collector.step(collector.action_space.sample())
            # What is written can be loaded before the end; an even episode is written at the next reset.
            assert len(minari.load_dataset(ID)) == (seed + 1) // 2 * 2
        collector.reset(seed=9)
        collector.close()
    dataset = minari.load_dataset(ID)
    assert len(dataset) == 4 and dataset.observation_space == env.observation_space
    for seed, episode in enumerate(dataset):
        np.testing.assert_array_equal(episode.observations["state"][:, 0], np.arange(6))
        np.testing.assert_array_equal(episode.observations["image"][3], np.full((32, 32, 3), 3))
        assert episode.rewards.tolist() == [1, 2, 3, 4, 5]
        assert bool(episode.terminations[-1]) == bool(seed % 2) != bool(episode.truncations[-1])
        assert list(episode.infos) == ["count"]
    assert isinstance(dataset.recover_environment().unwrapped, Counter)
    back = data.MinariDataset(ID)[2]
    assert back.seed == 2 and back.observations["image"].dtype == np.uint8


def test_the_files_are_like_those_that_minari_writes(root):
    h5py = pytest.importorskip("h5py")
    env = Counter()
    with data.MinariWriter(ID, env=env) as writer:
        collector = Collector(env, writer, infos=True)
        for seed in range(3):
            collector.reset(seed=seed)
            for step in range(5):
                collector.step(np.full(3, step / 5, dtype=np.float32))
        collector.close()
    ours = minari.load_dataset(ID)
    buffers = [
        minari.data_collector.EpisodeBuffer(
            seed=seed,
            observations=episode.observations,
            actions=episode.actions,
            rewards=episode.rewards.tolist(),
            terminations=episode.terminations.tolist(),
            truncations=episode.truncations.tolist(),
            infos=episode.infos,
        )
        for seed, episode in enumerate(ours)
    ]
    minari.create_dataset_from_buffers("theirs-v0", buffers, env=Counter.spec, jpeg_encoding=False)

    def content(name):
        out = {}

        def note(path, item):
            out[path] = dict(item.attrs)
            if isinstance(item, h5py.Dataset):
                out[path] = (item.shape, item.dtype, item[()].tobytes())

        with h5py.File(root / name / "data" / "main_data.hdf5") as file:
            file.visititems(note)
        return out

    assert content(ID) == content("theirs-v0")
    entries = [json.loads((root / name / "data" / "metadata.json").read_text()) for name in (ID, "theirs-v0")]
    for key in ("dataset_id", "dataset_size"):
        assert [type(entry.pop(key)) for entry in entries] in ([str, str], [float, float])
    # Minari writes that of an environment for evaluation too.
    entries[1].pop("eval_env_spec", None)
    assert entries[0] == entries[1]


def test_an_own_environment_is_recovered(tmp_path):
    env = gymnasium.make("hive/FrankaReach-v0")
    with data.MinariWriter("robohive/franka/random-v0", env=env) as writer, data.Recorder(tmp_path / "t.h5") as recorder:
        for seed in range(2):
            for sink in (writer, recorder):
                collector = Collector(gymnasium.make("hive/FrankaReach-v0"), sink)
                collector.reset(seed=seed)
                collector.action_space.seed(seed)
                for _ in range(3):
                    collector.step(collector.action_space.sample())
                collector.close()
    dataset = minari.load_dataset("robohive/franka/random-v0")
    again = dataset.recover_environment()
    assert again.spec.id == env.spec.id and again.observation_space == dataset.observation_space
    again.reset(seed=1)
    for action, expected in zip(dataset[1].actions, dataset[1].observations[1:], strict=True):
        np.testing.assert_array_equal(again.step(action)[0], expected)
    for episode, trial in zip(dataset, data.open(tmp_path / "t.h5").episodes(), strict=True):
        np.testing.assert_array_equal(episode.observations, trial.observations)


def test_the_environment_of_a_recording_is_recovered(tmp_path):
    with data.Recorder(tmp_path / "t.h5", attributes={"env": "hive/FrankaReach-v0"}) as recorder:
        recorder.add(episode())
    data.export_minari(tmp_path / "t.h5", ID)
    assert minari.load_dataset(ID).recover_environment().spec.id == "hive/FrankaReach-v0"


def test_what_minari_wrote_is_read():
    buffers = [
        minari.data_collector.EpisodeBuffer(
            seed=number,
            observations=np.full((3, 2), number),
            actions=np.zeros((2, 1)),
            rewards=[0.0, 1.0],
            terminations=[False, True],
            truncations=[False, False],
            infos={"a": np.arange(3)},
        )
        for number in range(20)
    ]
    box = gymnasium.spaces.Box(-np.inf, np.inf, (2,), np.float64)
    minari.create_dataset_from_buffers("theirs-v0", buffers, observation_space=box, action_space=box)
    back = data.MinariDataset("theirs-v0")
    assert len(back) == 20 and back[-1].seed == 19
    assert [episode.observations[0, 0] for episode in back] == list(range(20))
    np.testing.assert_array_equal(back[3].infos["a"], np.arange(3))


def test_spaces_are_those_that_minari_writes():
    from minari.serialization import deserialize_space, serialize_space

    spaces = gymnasium.spaces
    for space in (
        spaces.Box(-1, np.inf, (2, 3), np.float32),
        spaces.Box(0, 255, (4, 4, 3), np.uint8),
        spaces.Discrete(5, start=-2),
        spaces.MultiDiscrete([2, 3]),
        spaces.MultiBinary(4),
        spaces.MultiBinary((2, 3)),
        spaces.Tuple([spaces.Discrete(2), spaces.Text(5)]),
        spaces.Dict(a=spaces.Discrete(3), b=spaces.Dict(c=spaces.Box(-1, 1, (1,)))),
    ):
        assert deserialize_space(space_to_json(space)) == space
        assert json.loads(space_to_json(space)) == json.loads(serialize_space(space))
    with pytest.raises(data.DataError, match="Graph"):
        space_to_json(spaces.Graph(spaces.Discrete(2), None))


def episode(steps=3, **changes):
    parts = {
        "observations": np.zeros((steps + 1, 2)),
        "actions": np.zeros((steps, 3)),
        "rewards": np.zeros(steps),
        "terminations": np.zeros(steps, dtype=bool),
        "truncations": np.zeros(steps, dtype=bool),
    }
    return data.Episode(**{**parts, **changes})


def test_bad_input_is_named(tmp_path):
    box = gymnasium.spaces.Box(-1, 1, (2,), np.float64)
    for wrong in ("door", "door-v", "../door-v0", "a b-v1"):
        with pytest.raises(ValueError, match="no dataset id"):
            data.MinariWriter(wrong, observation_space=box, action_space=box)
    with pytest.raises(ValueError, match="a space is missing"):
        data.MinariWriter(ID, env="door-v1")
    with data.MinariWriter(ID, observation_space=box, action_space=box) as writer:
        writer.add(episode())
        with pytest.raises(data.DataError, match=r"main_data.hdf5.*episode_1/observations.*3 rows: .* has 4"):
            writer.add(episode(observations=np.zeros((3, 2))))
        with pytest.raises(data.DataError, match="rows of shape .5., .2. in the episodes before"):
            writer.add(episode(observations=np.zeros((4, 5))))
        with pytest.raises(data.DataError, match="a step has one number"):
            writer.add(episode(rewards=np.zeros((3, 1))))
        with pytest.raises(data.DataError, match="a step at least"):
            writer.add(episode(0))
        writer.add(episode(5))
    assert [len(one) for one in minari.load_dataset(ID)] == [3, 5]
    assert "infos=dict with the following keys: []" in repr(minari.load_dataset(ID)[0])
    assert [len(one) for one in data.MinariDataset(ID)] == [3, 5]
    with pytest.raises(ValueError, match="closed"):
        writer.add(episode())
    with pytest.raises(FileExistsError, match="random-v0.*exists"):
        data.MinariWriter(ID, observation_space=box, action_space=box)
    with pytest.raises(FileNotFoundError, match="nothing-v0"):
        data.MinariDataset("robohive/nothing-v0")
    with pytest.raises(ValueError, match="total_steps"):
        data.MinariWriter("a-v0", observation_space=box, action_space=box, total_steps=3)
    (tmp_path / "minari" / ID / "data" / "metadata.json").write_text("{")
    with pytest.raises(data.DataError, match="metadata.json"):
        data.MinariDataset(ID)


def test_an_export_that_fails_leaves_nothing(tmp_path, root):
    def stop(done, total):
        if done == 3:
            raise KeyboardInterrupt

    record(tmp_path / "trials.h5")
    with pytest.raises(KeyboardInterrupt):
        data.export_minari(tmp_path / "trials.h5", ID, progress=stop)
    with data.Recorder(tmp_path / "short.h5") as recorder, recorder.trial() as trial:
        trial.append({"observations": np.zeros(2), "actions": np.zeros(1), "rewards": 0.0, "done": False})
    with pytest.raises(data.DataError, match=r"short\.h5.*Trial0/observations.*no step"):
        data.export_minari(tmp_path / "short.h5", ID)
    assert not (root / ID).exists()
    data.export_minari(tmp_path / "trials.h5", ID)
