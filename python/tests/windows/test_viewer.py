"""`mujoco.viewer`: windows on a display that nobody sees, used by a person that is a program."""

import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
import robohive.mujoco as mj
from displays import LONG, eventually
from robohive.mujoco import viewer

SCENE = """<mujoco model="scene">
  <visual><headlight ambient="1 1 1" diffuse="0 0 0" specular="0 0 0"/><map znear=".001"/></visual>
  <worldbody>
    <geom name="floor" type="plane" size="1 1 .1" rgba=".2 .2 .2 1"/>
    <body name="box" pos="0 0 .4"><freejoint/><geom type="box" size=".3 .3 .3" rgba="0 1 0 1"/></body>
    <body pos="0 1.5 0"><joint name="hinge" axis="0 0 1"/><geom size=".1"/></body>
  </worldbody>
  <actuator><motor joint="hinge" ctrlrange="-1 1"/></actuator>
</mujoco>"""


def is_green(red, green, blue):
    return (green > 120) & (red < 60) & (blue < 60)


def is_magenta(red, green, blue):
    return (red > 120) & (blue > 120) & (green < 60)


@pytest.fixture
def scene():
    model = mj.MjModel.from_xml_string(SCENE)
    return model, mj.MjData(model)


def test_without_a_display_the_error_says_what_is_missing(scene, no_display):
    with pytest.raises(mj.FatalError, match=r"no window can be opened.*DISPLAY or WAYLAND_DISPLAY.*mujoco\.Renderer.*xvfb-run"):
        viewer.launch_passive(*scene)
    with pytest.raises(mj.FatalError, match="DISPLAY") as raised:
        viewer.launch(*scene)
    assert ".rs:" not in str(raised.value), "a place in sources means nothing to a user"
    with pytest.raises(mj.FatalError, match="DISPLAY"):
        viewer.launch_from_path("model.xml")


def test_arguments_are_checked(scene):
    model, data = scene
    for wrong in ({"model": data, "data": data}, {"model": model, "data": model}):
        with pytest.raises(ValueError, match="is not a mujoco.Mj"):
            viewer.launch_passive(**wrong)
    with pytest.raises(ValueError, match="not callable"):
        viewer.launch_passive(model, data, key_callback=3)
    with pytest.raises(ValueError, match="mjModel is not"):
        viewer.launch(None, data)
    with pytest.raises(ValueError, match="both specified"):
        viewer.launch(model, loader=lambda: scene)


def test_the_passive_loop_of_the_tutorial(scene, display):
    m, d = scene
    with viewer.launch_passive(m, d) as shown:
        start, turns = time.time(), 0
        while shown.is_running() and (time.time() - start < 1 or turns < 50):
            turns += 1
            mj.mj_step(m, d)
            with shown.lock():
                shown.opt.flags[mj.mjtVisFlag.mjVIS_CONTACTPOINT] = int(d.time % 2)
            shown.sync()
        assert turns >= 50 and shown.m is m and shown.d is d
        eventually(lambda: display.count(is_green) > 3000, "the box is seen")
        # It is moved away: what is shown is what was synced.
        d.qpos[0] = 50.0
        mj.mj_forward(m, d)
        shown.sync(state_only=True)
        eventually(lambda: display.count(is_green) < 100, "the box is gone")
        place = shown.viewport
        assert 200 < place.width <= 1280 and 200 < place.height <= 1024
    assert not shown.is_running() and shown.m is None and shown.viewport is None
    shown.sync()
    shown.close()


def test_the_programs_own_geoms_model_edits_and_images_are_seen(scene, display):
    m, d = scene
    with viewer.launch_passive(m, d, show_left_ui=False, show_right_ui=False) as shown:
        eventually(lambda: display.count(is_green) > 3000, "the box is seen")
        m.geom_rgba[1] = [1, 0, 0, 1]
        shown.sync()
        eventually(lambda: display.count(is_green) < 100, "the box is red")
        assert display.count(is_magenta) < 100
        mj.mjv_initGeom(
            shown.user_scn.geoms[0], mj.mjtGeom.mjGEOM_SPHERE, [0.4, 0, 0], [0, 0, 0.5], np.eye(3).ravel(), [1, 0, 1, 1]
        )
        shown.user_scn.ngeom = 1
        shown.sync()
        eventually(lambda: display.count(is_magenta) > 3000, "the sphere is seen")
        shown.user_scn.ngeom = 0
        shown.sync()
        eventually(lambda: display.count(is_magenta) < 100, "the sphere is gone")
        place = mj.MjrRect(100, 50, 200, 80)
        shown.set_images((place, np.tile(np.array([255, 0, 255], np.uint8), (80, 200, 1))))
        eventually(lambda: display.count(is_magenta) > 15000, "the image is seen")
        shown.clear_images()
        eventually(lambda: display.count(is_magenta) < 100, "the image is gone")
        figure = mj.MjvFigure()
        figure.figurergba[:] = [1, 0, 1, 1]
        figure.linepnt[0], figure.linedata[0, :4] = 2, [0, 0, 1, 1]
        shown.set_figures((place, figure))
        shown.set_texts([(None, mj.mjtGridPos.mjGRID_TOPRIGHT, "title", "text"), (None, None, None, None)])
        eventually(lambda: display.count(is_magenta) > 2000, "the figure is seen")
        shown.clear_figures()
        shown.clear_texts()
        with pytest.raises(ValueError, match="does not match"):
            shown.set_images((place, np.zeros((3, 4, 3), np.uint8)))
        with pytest.raises(ValueError, match="gridpos"):
            shown.set_texts((None, 9, "a", "b"))
        with pytest.raises(ValueError, match="no texture 0"):
            shown.update_texture(0)


def test_keys_reach_the_program_and_the_window(scene, display):
    m, d = scene
    keys = []
    with viewer.launch_passive(m, d, key_callback=keys.append) as shown:
        process = shown._window.process()
        eventually(lambda: display.focus(process), "there is a window")
        flag = mj.mjtVisFlag.mjVIS_CONTACTPOINT

        def pressed(key, code):
            display.person("key", key)
            return code in keys

        eventually(lambda: pressed("space", 32), "the program hears of the space bar")
        eventually(lambda: pressed("Right", 262), "the program hears of an arrow")
        # C switches contact points; the program sees it.
        presses = []

        def pressed_c():
            presses.append(display.person("key", "c"))
            return 67 in keys

        eventually(pressed_c, "the program hears of C")
        eventually(lambda: keys.count(67) == len(presses), f"the program hears of all {len(presses)} presses of C")
        eventually(lambda: shown.opt.flags[flag] == len(presses) % 2, f"{len(presses)} presses of C switch contact points")
        # What the program says last counts.
        shown.opt.flags[flag] = 1
        shown.cam.azimuth = 12.0
        shown.sync()
        time.sleep(0.5)
        shown.sync()
        assert shown.opt.flags[flag] == 1 and shown.cam.azimuth == 12.0


def test_keys_can_be_the_programs_alone(scene, display):
    keys = []
    with viewer.launch_passive(*scene, key_callback=keys.append, builtin_keys=False) as shown:
        eventually(lambda: display.focus(shown._window.process()), "there is a window")

        def pressed():
            display.person("key", "c")
            return 67 in keys

        eventually(pressed, "the program hears of C")
        time.sleep(0.5)
        assert shown.opt.flags[mj.mjtVisFlag.mjVIS_CONTACTPOINT] == 0


def test_a_person_pulls_a_body(scene, display):
    m, d = scene
    with viewer.launch_passive(m, d, show_left_ui=False, show_right_ui=False) as shown:
        eventually(lambda: display.count(is_green) > 3000, "the box is seen")
        process = shown._window.process()
        eventually(lambda: display.focus(process), "there is a window")
        rows, columns = np.nonzero(is_green(*np.moveaxis(display.pixels().astype(int), -1, 0)))
        at = int(np.median(columns)), int(np.median(rows))

        def selects():
            display.person("mousemove", *at, "click", "--repeat", 2, "--delay", 60, 1)
            time.sleep(0.3)
            shown.sync()
            return shown.perturb.select == 1

        eventually(selects, "a double click selects the box")
        display.person("keydown", "ctrl", "mousemove", *at, "mousedown", 3)

        def pulls():
            display.person("mousemove_relative", "--", 0, -8)
            time.sleep(0.1)
            shown.sync()
            return d.xfrc_applied[1, 2] > 0.1

        try:
            eventually(pulls, "a drag pulls the box up")
            assert shown.perturb.active == mj.mjtPertBit.mjPERT_TRANSLATE
        finally:
            display.person("mouseup", 3, "keyup", "ctrl")

        def lets_go():
            shown.sync()
            return not d.xfrc_applied.any()

        eventually(lets_go, "forces end when the person lets go")


def test_two_windows_at_once_and_one_that_dies(scene, display):
    m, d = scene
    other = mj.MjData(m)
    first, second = viewer.launch_passive(m, d), viewer.launch_passive(m, other)
    assert first.is_running() and second.is_running()
    assert first._window.process() != second._window.process()
    os.kill(first._window.process(), signal.SIGKILL)
    eventually(lambda: not first.is_running(), "the program notices that the window died")
    for _ in range(3):
        mj.mj_step(m, d)
        first.sync()
    assert first.viewport is None and second.is_running()
    second.sync()
    first.close()
    second.close()
    assert not second.is_running()


def closing(display, process, done):
    """Closes a window as a person does, again and again until it is closed."""
    while not done.is_set():
        display.focus(process)
        display.person("key", "ctrl+q")
        done.wait(1.0)


def test_a_person_closes_a_window_and_the_loop_ends(scene, display):
    m, d = scene
    with viewer.launch_passive(m, d) as shown:
        process, done = shown._window.process(), threading.Event()
        person = threading.Thread(target=closing, args=(display, process, done))
        person.start()
        until = time.monotonic() + LONG
        while shown.is_running() and time.monotonic() < until:
            mj.mj_step(m, d)
            shown.sync()
        done.set()
        person.join()
        assert not shown.is_running() and shown.d is None
        shown.sync()


@pytest.mark.parametrize("end", ["", "os._exit(3)", "os.kill(os.getpid(), signal.SIGKILL)"])
def test_windows_close_when_their_program_ends(display, tmp_path, end):
    path = tmp_path / "scene.xml"
    path.write_text(SCENE)
    program = f"""
import os, signal
import robohive.mujoco as mj
from robohive.mujoco import viewer
m = mj.MjModel.from_xml_path({str(path)!r})
shown = viewer.launch_passive(m, mj.MjData(m))
print(shown._window.process(), flush=True)
{end}
"""
    run = subprocess.run([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True, timeout=LONG)
    process = int(run.stdout)
    assert run.returncode == (3 if "_exit" in end else -signal.SIGKILL if end else 0)
    eventually(lambda: not os.path.exists(f"/proc/{process}"), "the window has closed")


def test_managed_windows_run_and_return_the_last_state(scene, display, monkeypatch):
    m, d = scene
    opened = []
    real = viewer.Managed.run

    def run(managed):
        opened.append(managed._window.process())
        done = threading.Event()
        person = threading.Thread(target=closing, args=(display, opened[0], done))
        person.start()
        try:
            real(managed)
        finally:
            done.set()
            person.join()

    display.person("version")
    monkeypatch.setattr(viewer.Managed, "run", run)
    d.qpos[2] = 3.0
    viewer.launch(m, d)
    assert d.time > 0 and d.qpos[2] < 3.0, "it has fallen"
    assert d.time == pytest.approx(round(d.time / m.opt.timestep) * m.opt.timestep)


def test_callbacks_are_called_in_front_of_a_window(scene, display, monkeypatch):
    m, d = scene
    display.person("version")
    said = []
    monkeypatch.setattr(viewer.Handle, "set_texts", lambda handle, texts: said.append(texts))

    def control(model, data):
        data.ctrl[0] = 0.25
        if data is d and len(viewer._handles) == before + 1 and d.time > 0.05 and not people:
            people.append(threading.Thread(target=visit, args=(viewer._handles[-1]._window.process(),)))
            people[0].start()

    def visit(process):
        while not said:
            display.focus(process)
            display.person("key", "space")
            time.sleep(0.5)
        closing(display, process, done)

    before, people, done = len([each for each in viewer._handles if each.is_running()]), [], threading.Event()
    mj.set_mjcb_control(control)
    try:
        viewer.launch(m, d)
    finally:
        done.set()
        mj.set_mjcb_control(None)
    people[0].join()
    assert d.ctrl[0] == 0.25 and d.time > 0.05 and said[0][0][2] == "PAUSE"


def test_a_file_in_a_window_of_the_command_line(display, tmp_path):
    path = tmp_path / "scene.xml"
    path.write_text(SCENE)
    display.person("version")
    run = subprocess.Popen([sys.executable, "-m", "robohive.mujoco.viewer", f"--mjcf={path}"], stderr=subprocess.PIPE, text=True)
    eventually(lambda: display.count(is_green) > 3000, "the box is seen")
    child = []
    eventually(lambda: child.extend(children(run.pid)) or child, "there is a window's process")
    done = threading.Event()
    person = threading.Thread(target=closing, args=(display, child[0], done))
    person.start()
    try:
        _, said = run.communicate(timeout=90)
    finally:
        done.set()
        person.join()
    assert run.returncode == 0, said


def children(process):
    """Processes that a process has started."""
    with open(f"/proc/{process}/task/{process}/children") as file:
        return [int(word) for word in file.read().split()]
