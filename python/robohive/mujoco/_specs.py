"""Descriptions of models, where programs look for them that know MuJoCo's own module."""

from robohive.mujoco.spec import *  # noqa: F403
