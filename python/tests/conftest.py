"""What tests share."""

import pytest
import robohive


@pytest.fixture
def env():
    """An arm that reaches."""
    env = robohive.make("hive/FrankaReach-v0", seed=0)
    env.reset(seed=0)
    yield env
    env.close()
