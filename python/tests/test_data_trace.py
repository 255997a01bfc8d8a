"""Recordings are read and written from Python as they are from Rust."""

import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from data_samples import TRACES, record
from robohive import data


def test_what_was_recorded_is_read(tmp_path):
    trials = record(tmp_path / "trials.h5")
    recording = data.open(tmp_path / "trials.h5")
    assert list(recording) == [f"Trial{i}" for i in range(12)]
    assert recording.attributes["env"] == "door-v1"
    for name, expected in zip(recording, trials):
        trial = recording[name]
        assert trial.layout == "RoboHive"
        for key, array in expected.items():
            assert trial[key].dtype == array.dtype and trial[key].shape == array.shape
            np.testing.assert_array_equal(trial[key].read(), array)
        assert trial["config/task"].read()[()] == "open the door"
    assert int(recording["Trial3"]["seed"][()]) == 103


def test_rows_are_read_when_they_are_asked_for(tmp_path):
    trials = record(tmp_path / "trials.h5", trials=1)
    rows = data.open(tmp_path / "trials.h5")["Trial0"]["observations"]
    expected = trials[0]["observations"]
    for index in (slice(1, 3), slice(-2, None), slice(4, 2), 2, (slice(None), 1), slice(None, None, 2), ...):
        np.testing.assert_array_equal(rows[index], expected[index])
    np.testing.assert_array_equal(np.asarray(rows, dtype=np.float32), expected.astype(np.float32))
    array = rows.read()
    array[0] = 0.0
    np.testing.assert_array_equal(rows.read(), expected)


def test_files_of_robohive_and_roboset_are_read():
    trial = data.open(TRACES / "robohive.h5")["Trial1"]
    assert trial["env_infos/obs_dict/qv_arm"].dtype == np.float16 and len(trial["actions"]) == 12
    images = trial["env_infos/visual_dict/rgb:left_cam:8x12:2d"]
    assert images.read().shape == (12, 8, 12, 3)
    roboset = data.open(TRACES / "roboset.h5")["Trial0"]
    assert roboset.layout == "RoboSet" and isinstance(roboset["config/task"].read()[()], str)


def test_h5py_reads_what_was_written(tmp_path):
    h5py = pytest.importorskip("h5py")
    trials = record(tmp_path / "trials.h5", pictures=True)
    with h5py.File(tmp_path / "trials.h5") as file:
        for number, expected in enumerate(trials):
            for key, array in expected.items():
                np.testing.assert_array_equal(file[f"Trial{number}/{key}"][()], array)


def test_transitions_take_the_reward_of_the_state_that_they_lead_to(tmp_path):
    trials = record(tmp_path / "trials.h5")
    for number, episode in enumerate(data.open(tmp_path / "trials.h5").episodes()):
        rows = trials[number]
        np.testing.assert_array_equal(episode.observations, rows["observations"])
        np.testing.assert_array_equal(episode.actions, rows["actions"][:-1])
        np.testing.assert_array_equal(episode.rewards, rows["rewards"][1:])
        np.testing.assert_array_equal(episode.terminations, rows["done"][1:])
        assert episode.truncations.sum() == (0 if number % 2 else 1)
        assert episode.seed == 100 + number
        np.testing.assert_array_equal(episode.infos["obs_dict/qp"], rows["env_infos/obs_dict/qp"])


def test_an_episode_is_written_and_read_back(tmp_path):
    record(tmp_path / "trials.h5")
    episodes = list(data.open(tmp_path / "trials.h5").episodes())
    with data.Recorder(tmp_path / "again.h5") as recorder:
        for episode in episodes:
            recorder.add(episode)
    for first, second in zip(episodes, data.open(tmp_path / "again.h5").episodes(), strict=True):
        for name in ("observations", "actions", "rewards", "terminations", "truncations", "seed"):
            np.testing.assert_array_equal(getattr(first, name), getattr(second, name))
        assert first.infos.keys() == second.infos.keys()


def test_layouts_and_archives_are_converted(tmp_path):
    record(tmp_path / "trials.h5")
    done = data.convert(tmp_path / "trials.h5", tmp_path / "trials.npz")
    assert done.trials == 12 and "config/task" in done.dropped
    archive = np.load(tmp_path / "trials.npz")
    trial = data.open(tmp_path / "trials.h5")["Trial5"]
    np.testing.assert_array_equal(archive["Trial5/observations"], trial["observations"].read())
    data.convert(TRACES / "robohive.h5", tmp_path / "roboset.h5", layout="roboset")
    assert data.open(tmp_path / "roboset.h5")["Trial0"].layout == "RoboSet"


def test_a_recording_is_continued(tmp_path):
    record(tmp_path / "trials.h5", trials=2)
    with data.Recorder(tmp_path / "trials.h5", append=True) as recorder, recorder.trial() as trial:
        trial.append({"time": 0.0})
        trial.append({"time": 0.1})
    assert list(data.open(tmp_path / "trials.h5")) == ["Trial0", "Trial1", "Trial2"]


def test_a_trial_that_raises_is_not_written(tmp_path):
    with data.Recorder(tmp_path / "trials.h5") as recorder:
        with pytest.raises(RuntimeError), recorder.trial() as trial:
            trial.append({"time": 0.0})
            raise RuntimeError
        with recorder.trial() as trial:
            trial.append({"time": 1.0})
    recording = data.open(tmp_path / "trials.h5")
    assert list(recording) == ["Trial0"] and recording["Trial0"]["time"][0] == 1.0


WRITER = """
import sys, numpy as np
from robohive import data
with data.Recorder(sys.argv[1]) as recorder:
    for number in range(10**6):
        with recorder.trial() as trial:
            trial.extend({"observations": np.full((50, 20), float(number)), "time": np.arange(50.0)})
        print(number, flush=True)
"""


def test_a_killed_recorder_loses_no_finished_trial(tmp_path):
    path = tmp_path / "trials.h5"
    process = subprocess.Popen([sys.executable, "-c", WRITER, str(path)], stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    finished = -1
    end = time.monotonic() + 60
    while finished < 20 and time.monotonic() < end:
        finished = int(process.stdout.readline())
    os.kill(process.pid, signal.SIGKILL)
    finished = max([finished, *map(int, process.stdout.read().split())])
    process.wait()
    recording = data.open(path)
    assert len(recording) > finished >= 20
    for number in range(finished + 1):
        assert (recording[f"Trial{number}"]["observations"].read() == number).all()


def test_a_damaged_file_is_repaired(tmp_path):
    record(tmp_path / "trials.h5")
    whole = (tmp_path / "trials.h5").read_bytes()
    cut = tmp_path / "cut.h5"
    cut.write_bytes(whole[: len(whole) * 3 // 4])
    with pytest.raises(data.DataError, match=r"cut\.h5.*cut off"):
        data.open(cut)
    report = data.repair(cut, tmp_path / "saved.h5")
    assert 0 < len(report.saved) < 12 and report.damage
    assert list(data.open(tmp_path / "saved.h5")) == report.saved


def test_bad_input_is_named(tmp_path):
    path = tmp_path / "trials.h5"
    record(path, trials=1)
    recording = data.open(path)
    with pytest.raises(FileNotFoundError, match="missing.h5"):
        data.open(tmp_path / "missing.h5")
    (tmp_path / "text.h5").write_text("no HDF5")
    with pytest.raises(data.DataError, match="text.h5"):
        data.open(tmp_path / "text.h5")
    with pytest.raises(KeyError, match="trials.h5.*Trial9"):
        recording["Trial9"]
    with pytest.raises(KeyError, match="trials.h5.*Trial0/nothing"):
        recording["Trial0"]["nothing"]
    with pytest.raises(FileExistsError, match="trials.h5"):
        data.Recorder(path)
    with pytest.raises(FileExistsError, match="trials.h5"):
        data.convert(path, path, overwrite=True)
    with pytest.raises(ValueError, match="no layout .lerobot."):
        data.Recorder(tmp_path / "other.h5", layout="lerobot")
    with pytest.raises(data.DataError, match="neither|RoboHive's layout"):
        data.open(TRACES / "roboset.h5")["Trial0"].episode()


def test_rows_that_do_not_fit_are_refused(tmp_path):
    with data.Recorder(tmp_path / "trials.h5") as recorder:
        with recorder.trial() as trial:
            trial.append({"a": [1.0, 2.0], "b": 1})
            with pytest.raises(data.DataError, match="other names.*: b"):
                trial.append({"a": [1.0, 2.0]})
            with pytest.raises(data.DataError, match="a: a row of float64 .3,. follows rows of float64 .2,."):
                trial.append({"a": [1.0, 2.0, 3.0], "b": 1})
            with pytest.raises(data.DataError, match="one number of rows"):
                trial.extend({"a": np.zeros((3, 2)), "b": np.zeros(2, dtype=int)})
        with pytest.raises(TypeError, match="complex128 is not kept"), recorder.trial() as trial:
            trial.append({"a": 1j})
        with pytest.raises(data.DataError, match=r"trials\.h5.*Trial0.*already"), recorder.trial("Trial0") as trial:
            trial.append({"a": 1.0})
    with pytest.raises(ValueError, match="closed"), recorder.trial() as trial:
        trial.append({"a": 1.0})
    assert len(data.open(tmp_path / "trials.h5")) == 1
