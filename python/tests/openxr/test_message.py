"""States of controllers become messages."""

import json
import math

import pytest
from robohive.openxr import Controller, message
from robohive.openxr.bindings import ACTIONS, PROFILES, suggested
from robohive.openxr.link import socket_of
from robohive.openxr.runtime import DRAWN, HEADLESS, choose
from robohive.openxr.trouble import Trouble

NOWHERE = {"pose": [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], "tracked": False}


def test_a_controller_that_is_not_there_says_nothing():
    assert message(3, 1.5, Controller(), Controller()) == {"seq": 3, "time": 1.5, **NOWHERE, "left": NOWHERE, "buttons": ["rightTrig 0.0000", "leftTrig 0.0000"]}


def test_poses_are_those_of_their_hands():
    right = Controller(position=(1.0, 2.0, 3.0), orientation=(0.0, 1.0, 0.0, 0.0), tracked=True)
    left = Controller(position=(4.0, 5.0, 6.0), tracked=True)
    said = message(0, 0.0, right, left)
    assert said["pose"] == [1.0, 2.0, 3.0, 0.0, 1.0, 0.0, 0.0] and said["tracked"] is True
    assert said["left"] == {"pose": [4.0, 5.0, 6.0, 0.0, 0.0, 0.0, 1.0], "tracked": True}


@pytest.mark.parametrize("lost", [Controller(position=(1.0, 2.0, 3.0)), Controller(position=(math.nan, 0.0, 0.0), tracked=True)])
def test_a_pose_that_is_not_tracked_or_no_number_is_not_sent(lost):
    said = message(0, 0.0, lost, lost)
    assert {"pose": said["pose"], "tracked": said["tracked"]} == NOWHERE == said["left"]


def test_buttons_and_axes_have_the_names_of_mappings():
    right = Controller(trigger=0.75, squeeze=1.0, stick=(0.5, -1.0), stick_click=True, first=True, second=True)
    left = Controller(trigger=0.25, squeeze=0.5, first=True)
    said = message(0, 0.0, right, left)["buttons"]
    assert said[:8] == ["RG", "A", "B", "RJ", "RTr", "rightTrig 0.7500", "rightGrip 1.0000", "rightJS 0.5000 -1.0000"]
    assert said[8:] == ["X", "leftTrig 0.2500", "leftGrip 0.5000"], "half a grip is not pressed"
    everything = Controller(trigger=1.0, squeeze=1.0, stick=(1.0, 1.0), stick_click=True, first=True, second=True)
    assert len(message(0, 0.0, everything, everything)["buttons"]) == 16, "a session takes 24"


def test_an_axis_that_is_no_number_rests():
    odd = Controller(trigger=math.nan, squeeze=math.inf, stick=(math.nan, 0.5))
    said = message(0, 0.0, odd, Controller())
    assert "rightTrig 0.0000" in said["buttons"] and "rightJS 0.0000 0.5000" in said["buttons"]
    assert "nan" not in json.dumps(said, allow_nan=False)


def test_every_profile_has_a_grip_a_clutch_and_a_success_for_both_hands():
    assert set(PROFILES) == {"oculus/touch_controller", "valve/index_controller", "htc/vive_controller", "khr/simple_controller"}
    for profile in PROFILES:
        rows = suggested(profile)
        for hand in ("right", "left"):
            of_hand = [action for action, path in rows if path.startswith(f"/user/hand/{hand}/input/")]
            assert {"grip", "squeeze"} <= set(of_hand) <= set(ACTIONS) and len(of_hand) == len(set(of_hand))
        assert ("first", "/user/hand/right/input/" + ("a/click" if profile[0] in "ov" else "menu/click")) in rows


def test_addresses_are_those_that_sessions_print():
    assert socket_of("http://127.0.0.1:8090/0a1b") == "ws://127.0.0.1:8090/0a1b/socket"
    assert socket_of("http://localhost:8090/0a1b/") == "ws://localhost:8090/0a1b/socket"
    for wrong in ("127.0.0.1:8090", "http://127.0.0.1:8090", "https://127.0.0.1:8090/0a1b", "http:///0a1b", "http://127.0.0.1:8090/a/b", ""):
        with pytest.raises(Trouble, match="robohive teleop ID --device openxr"):
            socket_of(wrong)


def test_a_session_has_no_pictures_where_the_runtime_can_do_without():
    assert choose([*HEADLESS, *DRAWN]) == HEADLESS
    assert choose([HEADLESS[0], *DRAWN]) == DRAWN, "without the system's time a session cannot be headless"
    with pytest.raises(Trouble, match="another one is needed"):
        choose(["XR_KHR_vulkan_enable2"])
