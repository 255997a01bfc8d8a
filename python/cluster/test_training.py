"""Trainings on a real cluster of two nodes on this machine: the bits of one process, and nothing made twice."""

import os
import pathlib

import pytest

os.environ["RAY_ENABLE_WINDOWS_OR_OSX_CLUSTER"] = "0"
ray = pytest.importorskip("ray")

from ray.cluster_utils import Cluster
from robohive.ray import train
from robohive.training import Run, variations

RUNS = variations(
    "hive/myoElbowPose1D6MRandom-v0",
    seeds=[1, 2],
    vary={"learning.fit.rate": [1e-3, 3e-4]},
    iterations=2,
    settings={"episodes": 4, "hidden": [[8], [8]]},
)


@pytest.fixture
def cluster():
    found = Cluster(initialize_head=True, head_node_args={"num_cpus": 0})
    for _ in range(2):
        found.add_node(num_cpus=1)
    ray.init(address=found.address, log_to_driver=False)
    yield found
    ray.shutdown()
    found.shutdown()


def test_a_cluster_trains_what_one_process_does(cluster, tmp_path: pathlib.Path):
    found = dict(train(RUNS, tmp_path / "sweep"))
    assert set(found) == set(RUNS) and all(row["iteration"] == 2 for row in found.values())
    for name, config in RUNS.items():
        alone = Run.of(config, tmp_path / "alone" / name)
        assert [row["num_samples"] for row in alone][-1] == found[name]["num_samples"]
        for file in ("policy.safetensors", "checkpoint.safetensors", "run.toml"):
            assert (tmp_path / "sweep" / name / file).read_bytes() == (tmp_path / "alone" / name / file).read_bytes()
    assert dict(train(RUNS, tmp_path / "sweep")) == {}, "all of them are there"
    other = {name: {**config, "iterations": 3} for name, config in RUNS.items()}
    with pytest.raises(ValueError, match="holds a run of another configuration"):
        next(train(other, tmp_path / "sweep"))
