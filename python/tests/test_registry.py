import pytest
import robohive


def test_ids_are_those_of_the_registry():
    ids = robohive.ids()
    assert len(ids) == len(set(ids)) > 521
    assert "door-v1" in robohive.ids("hands") and "hive/FrankaReach-v0" in ids


def test_an_unknown_suite_is_an_error_that_lists_suites():
    with pytest.raises(ValueError, match="no suite 'legs'; there are .*hands"):
        robohive.ids("legs")
