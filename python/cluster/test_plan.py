import pytest

pytest.importorskip("ray")

from robohive.collect import RandomPolicy
from robohive.ray import Collector
from robohive.ray.plan import LostEpisodes, Plan


def plan(episodes=10, size=4, attempts=3):
    return Plan.of(range(episodes), size, attempts)


def test_units_hold_every_episode_once():
    units = list(plan().waiting)
    assert [unit.episodes for unit in units] == [(0, 1, 2, 3), (4, 5, 6, 7), (8, 9)]


def test_a_lost_unit_runs_before_those_that_wait():
    p = plan()
    first, _ = p.take(), p.take()
    p.lose(first)
    assert p.take() == first
    assert p.lost == 1


def test_a_plan_is_over_when_every_unit_has_arrived():
    p = plan()
    while unit := p.take():
        assert not p.is_over
        p.finish(unit)
    assert p.is_over and p.lost == 0


def test_a_unit_lost_at_every_attempt_is_an_error_that_names_its_episodes():
    p = plan(attempts=2)
    p.lose(p.take())
    with pytest.raises(LostEpisodes, match="episodes 0 to 3 were lost 2 times"):
        p.lose(p.take())


@pytest.mark.parametrize("name", ["unit", "actors", "cpus_per_actor", "envs_per_actor", "attempts"])
def test_numbers_that_are_not_positive_are_refused(name):
    with pytest.raises(ValueError, match=f"{name} is positive, not 0"):
        Collector("hive/FrankaReach-v0", 4, policy=RandomPolicy, **{name: 0})
