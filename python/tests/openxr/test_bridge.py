"""What a runtime says reaches a session: the loader of pyopenxr, a stand-in runtime, and the bridge between them."""

import time
from pathlib import Path

import pytest

headsets = pytest.importorskip("headset", reason="needs pyopenxr and websockets")
Bridge, listening = headsets.Bridge, headsets.listening

REST = ["rightTrig 0.0000", "leftTrig 0.0000"]
FULL = {"trigger": 1.0, "squeeze": 1.0, "click": 1.0, "first": 1.0, "second": 1.0, "stick": [0.5, -0.25]}
STICK = "JS 0.5000 -0.2500"

#: What both hands with everything pressed say, by profile.
PRESSED = {
    "oculus/touch_controller": ["RG", "A", "B", "RJ", "RTr", "LG", "X", "Y", "LJ", "LTr", "right" + STICK, "left" + STICK],
    "valve/index_controller": ["RG", "A", "B", "RJ", "RTr", "LG", "X", "Y", "LJ", "LTr", "right" + STICK, "left" + STICK],
    "htc/vive_controller": ["RG", "A", "RJ", "RTr", "LG", "X", "Y", "LTr", "right" + STICK, "left" + STICK],
    "khr/simple_controller": ["RG", "A", "LG", "X"],
}


@pytest.fixture
def validation(monkeypatch):
    """Khronos' core validation, which comes with pyopenxr: a call that the specification does not allow fails."""
    import xr.api_layer
    from xr.platform_folder import platform_folder

    folder = Path(xr.api_layer.__file__).parent / platform_folder()[0]
    assert any(folder.glob("*core_validation*.json")), folder
    monkeypatch.setenv("XR_API_LAYER_PATH", str(folder))
    monkeypatch.setenv("XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation")
    monkeypatch.setenv("XR_CORE_VALIDATION_EXPORT_TYPE", "text")


@pytest.mark.parametrize("profile", PRESSED)
def test_every_controller_is_read(headset, validation, profile):
    with listening() as session, Bridge(headset, session.address, STANDIN_PROFILE=f"/interaction_profiles/{profile}") as bridge:
        session.wait_for_words(REST)
        for side in ("right", "left"):
            headset.set(side, **FULL)
        axes = [f"{side}{axis} 1.0000" for side in ("right", "left") for axis in ("Trig", "Grip")]
        if profile == "khr/simple_controller":
            axes = ["rightGrip 1.0000", "leftGrip 1.0000", *REST]
        session.wait_for_words([*PRESSED[profile], *axes])
        headsets.eventually(lambda: f"right hand: {profile}, left hand: {profile}" in bridge.said, "the controllers are named")
        assert session.path == "/0123456789abcdef/socket"
        numbers = [message["seq"] for message in session.messages]
        times = [message["time"] for message in session.messages]
        assert numbers == list(range(len(numbers))) and times == sorted(times)
        assert "VALID_ERROR" not in bridge.said and headset.frames == 0, bridge.said


def test_poses_are_sent_while_they_are_valid_and_tracked(headset):
    with listening() as session, Bridge(headset, session.address):
        headset.set("right", position=[0.25, 1.5, -0.5], turn=[0.0, 0.6, 0.0, 0.8])
        headset.set("left", position=[-0.25, 1.0, 0.0])
        there = [0.25, 1.5, -0.5, 0.0, 0.6, 0.0, 0.8]
        near = lambda pose: max(abs(a - b) for a, b in zip(pose, there)) < 1e-6
        session.wait_for(lambda m: m["tracked"] and near(m["pose"]) and m["left"]["pose"][:2] == [-0.25, 1.0], "both hands are there")
        for flags in (0b0111, 0b1011, 0b0011, 0b1110, 0):
            headset.set("right", flags=flags)
            session.wait_for(lambda m: not m["tracked"] and m["pose"][:3] == [0.0, 0.0, 0.0] and m["left"]["tracked"], f"flags {flags:b} are no pose")
            headset.set("right", flags=headsets.TRACKED)
            session.wait_for(lambda m: m["tracked"], "it is tracked again")


def test_a_session_without_focus_holds_nothing(headset):
    headset.set("right", **FULL)
    headset.state(headsets.SYNCHRONIZED)
    with listening() as session, Bridge(headset, session.address) as bridge:
        headsets.eventually(lambda: "waiting for the headset (synchronized): put it on" in bridge.said, "it says what it waits for")
        session.wait_for(lambda m: m["buttons"] == REST and not m["tracked"], "nothing is held")
        headset.state(headsets.FOCUSED)
        session.wait_for(lambda m: "RG" in m["buttons"] and m["tracked"], "the clutch is held")
        headset.state(headsets.SYNCHRONIZED)
        session.wait_for(lambda m: m["buttons"] == REST and not m["tracked"], "nothing is held any more")


def test_centring_the_space_lets_go(headset):
    headset.set("right", **FULL)
    with listening() as session, Bridge(headset, session.address):
        session.wait_for(lambda m: "RG" in m["buttons"] and m["tracked"], "the clutch is held")
        before, first = time.monotonic(), len(session.messages)
        headset.centre()
        session.wait_for(lambda m: m["buttons"] == REST and not m["tracked"], "it is let go")
        session.wait_for(lambda m: "RG" in m["buttons"] and m["tracked"], "it is held again")
        came = session.messages[first:]
        quiet = next(index for index, m in enumerate(came) if m["buttons"] == REST)
        again = next(m["time"] for m in came[quiet:] if "RG" in m["buttons"])
        assert again - before > 0.15, "later than an old pose is believed"


def test_a_runtime_that_only_draws_gets_empty_frames(headset, display, validation):
    with listening() as session, Bridge(headset, session.address, STANDIN_HEADLESS="0", DISPLAY=display.name) as bridge:
        headset.set("right", **FULL)
        session.wait_for(lambda m: "RG" in m["buttons"] and m["tracked"], "the clutch is held")
        assert headset.frames > 0 and "at the frame rate of the headset" in bridge.said
        assert "VALID_ERROR" not in bridge.said, bridge.said


def test_a_runtime_that_only_draws_needs_a_display(headset):
    with listening() as session, Bridge(headset, session.address, STANDIN_HEADLESS="0", DISPLAY="", WAYLAND_DISPLAY="") as bridge:
        assert bridge.end() == 1
        assert "asks for OpenGL" in bridge.said and "XR_MND_headless" in bridge.said and "Traceback" not in bridge.said


def test_either_end_may_end(headset):
    with listening() as session:
        with Bridge(headset, session.address) as bridge:
            session.wait_for(lambda m: m["tracked"], "it runs")
            headset.state(headsets.STOPPED)
            assert bridge.end() == 0 and "the OpenXR runtime has ended the session" in bridge.said
        headset.state(headsets.FOCUSED)
        with Bridge(headset, session.address) as bridge:
            session.wait_for(lambda m: m["tracked"], "it runs")
            session.close()
            assert bridge.end() == 0 and "the session by hand has ended" in bridge.said


def test_the_runtime_is_described(headset):
    for environment, kind in ({}, "without pictures"), ({"STANDIN_HEADLESS": "0"}, "with empty pictures, by OpenGL"):
        with Bridge(headset, "--list", **environment) as bridge:
            assert bridge.end() == 0
            for line in ("runtime     stand-in 1.2.3", "headset     controllers of a test", f"session     {kind}", "extension   XR_KHR_opengl_enable"):
                assert line in bridge.said, bridge.said


@pytest.mark.parametrize(
    ("arguments", "environment", "says"),
    [
        (["--list"], {"XR_RUNTIME_JSON": "/nonexistent/runtime.json"}, "no OpenXR runtime is active: start SteamVR"),
        (["--list"], {"STANDIN_STAGE": ""}, "refuses a connection"),
        (["http://127.0.0.1:1/abc"], {}, "no session at http://127.0.0.1:1/abc"),
        (["127.0.0.1:8090"], {}, "is not the address of a session"),
        ([], {}, "or --list"),
        (["--list", "--rate", "5"], {}, "--rate is from 20 to 1000 Hz"),
        (["--list", "--rate", "nan"], {}, "--rate is from 20 to 1000 Hz"),
    ],
)
def test_what_is_missing_is_named(headset, arguments, environment, says):
    with Bridge(headset, *arguments, **environment) as bridge:
        assert bridge.end() != 0
        assert says in bridge.said and "Traceback" not in bridge.said, bridge.said


@pytest.mark.parametrize("package", ["xr", "websockets"])
def test_a_package_that_is_missing_is_named_with_the_command(headset, tmp_path, package):
    (tmp_path / f"{package}.py").write_text("raise ImportError('not here')")
    with listening() as session, Bridge(headset, session.address, PYTHONPATH=str(tmp_path)) as bridge:
        assert bridge.end() == 1
        assert "python -m pip install pyopenxr websockets" in bridge.said and "Traceback" not in bridge.said


def test_the_rate_is_kept(headset):
    with listening() as session, Bridge(headset, session.address, "--rate", "50") as bridge:
        session.wait_for(lambda m: m["seq"] > 50, "a second is over")
        assert "50 times a second" in bridge.said
        times = [message["time"] for message in session.messages if message["tracked"]]
        # A busy machine makes intervals longer, and none shorter but the one after the longest.
        assert times[-1] - times[0] > (len(times) - 2) / 50 - 1e-3
