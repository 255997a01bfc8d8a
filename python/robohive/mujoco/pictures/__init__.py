"""Scenes, views and contexts: from a model in a state to pixels."""
