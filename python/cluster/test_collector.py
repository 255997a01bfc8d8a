"""A collection on a real cluster of several nodes on this machine, some of which die."""

import hashlib
import os
import sys
import time

import numpy as np
import pytest

# All nodes are processes of this machine; without this they would talk by its outer address. Read when ray is imported.
os.environ["RAY_ENABLE_WINDOWS_OR_OSX_CLUSTER"] = "0"
ray = pytest.importorskip("ray")

from ray.cluster_utils import Cluster
from robohive.collect import RandomPolicy, collect
from robohive.ray import Collector

ID = "hive/FrankaReach-v0"

# The nodes do not have this file; its policies travel by value.
ray.cloudpickle.register_pickle_by_value(sys.modules[__name__])


def cluster_of(nodes):
    """A cluster with a head that runs nothing and nodes of one processor each."""
    found = Cluster(initialize_head=True, head_node_args={"num_cpus": 0})
    for _ in range(nodes):
        found.add_node(num_cpus=1)
    ray.init(address=found.address, log_to_driver=False)
    return found


def mark(episode):
    """What two equal episodes have in common."""
    parts = (episode.observations, episode.actions, episode.rewards)
    digest = hashlib.sha256(b"".join(np.ascontiguousarray(part).tobytes() for part in parts))
    return episode.index, episode.seed, episode.terminated, episode.truncated, digest.hexdigest()


@pytest.fixture
def cluster():
    found = cluster_of(2)
    yield found
    ray.shutdown()
    found.shutdown()


def expected(count, seed=5):
    return {mark(episode) for episode in collect(ID, count, policy=RandomPolicy, seed=seed, num_envs=8)}


def test_a_cluster_collects_what_one_process_does(cluster):
    collector = Collector(ID, 60, policy=RandomPolicy, seed=5, envs_per_actor=4, unit=7)
    found = [mark(episode) for episode in collector]
    assert len(found) == 60 and set(found) == expected(60)
    assert collector.actors_lost == 0


def test_nodes_that_die_lose_and_double_nothing(cluster):
    collector = Collector(ID, 400, policy=RandomPolicy, seed=5, envs_per_actor=4, unit=8)
    kills = 0
    found = []
    for episode in collector:
        found.append(mark(episode))
        if len(found) in (50, 150, 250):
            cluster.remove_node(next(iter(cluster.worker_nodes)), allow_graceful=False)
            cluster.add_node(num_cpus=1)
            kills += 1
    assert kills == 3 and collector.actors_lost >= 3 and collector.units_lost >= 3
    assert len(found) == 400 and set(found) == expected(400)


def test_a_slow_consumer_holds_one_unit_an_actor(cluster):
    collector = Collector(ID, 200, policy=RandomPolicy, actors=2, envs_per_actor=4, unit=4)
    episodes = iter(collector)
    next(episodes)
    time.sleep(3)
    assert len(collector._plan.waiting) >= 200 // 4 - 4
    episodes.close()


def test_an_unknown_id_is_the_error_of_the_caller(cluster):
    with pytest.raises(ray.exceptions.ActorDiedError, match="FrankaReech"):
        list(Collector("hive/FrankaReech-v0", 4, policy=RandomPolicy))


class Sensitive(RandomPolicy):
    """Fails in one of the episodes."""

    def act(self, observations):
        raise ArithmeticError("no action for this observation")


def test_what_a_policy_raises_reaches_the_caller(cluster):
    with pytest.raises(ArithmeticError, match="no action for this observation"):
        list(Collector(ID, 4, policy=Sensitive))


class Scaled(RandomPolicy):
    """Random actions, scaled by a parameter."""

    scale = 1.0

    def act(self, observations):
        return (super().act(observations) * self.scale).astype(np.float32)

    def load(self, state):
        self.scale = state


def test_parameters_reach_units_that_start_after_them(cluster):
    collector = Collector(ID, 120, policy=Scaled, actors=2, envs_per_actor=4, unit=4)
    versions = {}
    for count, episode in enumerate(collector):
        versions[episode.version] = max(versions.get(episode.version, 0.0), float(np.abs(episode.actions).max()))
        if count == 20:
            assert collector.update(0.1) == 1
    assert set(versions) == {0, 1}
    assert versions[0] > 0.5 and 0.0 < versions[1] <= 0.1


def test_nodes_that_join_take_part():
    found = cluster_of(1)
    try:
        collector = Collector(ID, 1000, policy=RandomPolicy, envs_per_actor=2, unit=2)
        numbers, most = [], 0
        for episode in collector:
            numbers.append(episode.index)
            if len(numbers) == 10:
                assert collector.actors == 1
                found.add_node(num_cpus=1)
            most = max(most, collector.actors)
            if most == 2 and len(numbers) > 200:
                break
        assert most == 2 and len(set(numbers)) == len(numbers) > 200
    finally:
        ray.shutdown()
        found.shutdown()
