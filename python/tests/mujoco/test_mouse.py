"""Cameras, connectors and bodies that are pulled, beside MuJoCo's own bindings, where these are installed."""

import numpy as np
import pytest
import robohive.mujoco as mj

SCENE = """
<mujoco>
  <visual><global fovy="50"/></visual>
  <worldbody>
    <geom type="plane" size="2 2 1"/>
    <camera name="plain" pos="1 -2 1" euler="60 10 20" fovy="40"/>
    <camera name="lens" pos="1 -2 1" euler="60 0 0" resolution="640 480" sensorsize=".64 .48" focal=".5 .6" principal=".02 .05"/>
    <camera name="parallel" pos="0 -2 1" euler="70 0 0" {parallel} fovy="2"/>
    <body name="float" pos="0 0 .5" euler="0 20 10"><freejoint/><geom type="box" size=".1 .2 .3" pos=".05 0 .1"/>
      <body name="arm" pos=".3 0 0"><joint axis="0 1 0"/><geom type="capsule" size=".05 .1" pos=".1 0 0"/></body>
    </body>
    <body name="mocap" mocap="true" pos="1 1 1"><geom size=".1"/></body>
    <body name="hinged" pos="0 1 1"><joint axis="1 0 0"/><geom type="ellipsoid" size=".1 .1 .2" pos=".1 0 0"/></body>
  </worldbody>
</mujoco>
"""
PARALLEL = 'projection="orthographic"'


def scene(module, kind=None, number=0, **free):
    model = module.MjModel.from_xml_string(SCENE.format(parallel=PARALLEL))
    data = module.MjData(model)
    data.qvel[:] = np.linspace(-1, 1, model.nv)
    module.mj_forward(model, data)
    camera, out = module.MjvCamera(), module.MjvScene(model, 100)
    camera.type = module.mjtCamera.mjCAMERA_FREE if kind is None else getattr(module.mjtCamera, f"mjCAMERA_{kind}")
    camera.fixedcamid = camera.trackbodyid = number
    for name, value in {"azimuth": 130, "elevation": -25, "distance": 2.5, **free}.items():
        setattr(camera, name, value)
    module.mjv_updateScene(
        model, data, module.MjvOption(), module.MjvPerturb(), camera, module.mjtCatBit.mjCAT_ALL.value, out
    )
    return model, data, camera, out


def same(truth, call, tolerance=2e-6):
    """What `call(module)` returns is the same of both modules, to the single precision of cameras."""
    theirs, ours = (np.concatenate([np.ravel(part) for part in call(module)]).astype(float) for module in (truth, mj))
    assert theirs.size and np.isfinite(theirs).all()
    np.testing.assert_allclose(ours, theirs, rtol=tolerance, atol=tolerance)


CAMERAS = [(None, 0), ("TRACKING", 1), ("FIXED", 0), ("FIXED", 1), ("FIXED", 2)]


@pytest.mark.parametrize(("kind", "number"), CAMERAS)
def test_cameras(truth, kind, number):
    def frames(module):
        model, data, camera, out = scene(module, kind, number)
        vectors, spans = [np.zeros(3) for _ in range(4)], [np.zeros(2, np.float32) for _ in range(3)]
        module.mjv_cameraFrame(*vectors, data, camera)
        module.mjv_cameraFrustum(*spans, model, camera)
        single = module.mjv_camera2GLCamera(model, data, camera)
        mean = module.mjv_averageCamera(out.camera[0], out.camera[1])
        room, inside = ([np.zeros(3) for _ in range(3)] for _ in range(2))
        module.mjv_cameraInRoom(*room, out)
        module.mjv_cameraInModel(*inside, out)
        names = ("pos", "forward", "up", "frustum_center", "frustum_bottom", "frustum_top", "frustum_near", "frustum_far")
        eyes = [getattr(eye, name) for eye in (single, mean) for name in (*names, "orthographic")]
        return [*vectors, *spans, *eyes, *room, *inside, module.mjv_frustumHeight(out)]

    same(truth, frames)


def test_scenes_in_a_room(truth):
    def poses(module):
        model, _, _, out = scene(module)
        out.enabletransform, out.scale = 1, 1.5
        out.translate[:], out.rotate[:] = [0.1, 0.2, 0.3], [0.8, 0.0, 0.6, 0.0]
        pos, quat, given = np.zeros(3), np.zeros(4), (np.array([1.0, 2, 3]), np.array([0.6, 0.8, 0, 0]))
        rows = []
        for convert in (module.mjv_room2model, module.mjv_model2room):
            convert(pos, quat, *given, out)
            rows += [pos.copy(), quat.copy()]
        inside = [np.zeros(3) for _ in range(3)]
        module.mjv_cameraInModel(*inside, out)
        for action in range(1, 8):
            module.mjv_moveModel(model, action, 0.1, -0.2, np.array([0.0, 0, 1]), out)
            rows += [out.translate.copy(), out.rotate.copy(), [out.scale]]
        turned = np.zeros(3)
        module.mjv_alignToCamera(turned, np.array([1.0, 2, 3]), np.array([0.3, -0.5, 0.7]))
        return [*rows, *inside, turned]

    same(truth, poses)


@pytest.mark.parametrize("kind", ["CAPSULE", "CYLINDER", "ARROW", "ARROW1", "ARROW2", "LINE"])
def test_connectors(truth, kind):
    def shape(module):
        geom = module.MjvGeom()
        kinds = getattr(module.mjtGeom, f"mjGEOM_{kind}")
        module.mjv_initGeom(geom, kinds, np.zeros(3), np.zeros(3), np.zeros(9), np.array([1, 0, 0, 1], np.float32))
        module.mjv_connector(geom, kinds, 0.02, np.array([0.1, 0.2, 0.3]), np.array([1.0, -0.5, 0.7]))
        return geom.size, geom.pos, geom.mat, geom.rgba, [geom.type]

    same(truth, shape)
    with pytest.raises(mj.FatalError, match="invalid geom type"):
        mj.mjv_connector(mj.MjvGeom(), mj.mjtGeom.mjGEOM_BOX, 0.1, np.zeros(3), np.ones(3))


@pytest.mark.parametrize("body", [1, 2, 3, 4])
@pytest.mark.parametrize("camera", [(None, 0), ("FIXED", 2)])
def test_bodies_are_pulled(truth, body, camera):
    def pull(module):
        model, data, _, out = scene(module, *camera)
        rows = []
        for kind in (module.mjtPertBit.mjPERT_TRANSLATE, module.mjtPertBit.mjPERT_ROTATE, 3):
            pert = module.MjvPerturb()
            pert.select, pert.localpos[:] = body, [0.05, -0.02, 0.1]
            module.mjv_initPerturb(model, data, out, pert)
            pert.active = int(kind)
            for action in range(1, 8):
                module.mjv_movePerturb(model, data, action, 0.1, -0.04, out, pert)
                rows += [pert.refpos.copy(), pert.refquat.copy(), pert.refselpos.copy()]
            data.xfrc_applied[:] = 0
            module.mjv_applyPerturbForce(model, data, pert)
            rows += [[pert.localmass, pert.scale], data.xfrc_applied.copy()]
            for paused in (0, 1):
                module.mjv_applyPerturbPose(model, data, pert, paused)
                rows += [data.qpos.copy(), data.mocap_pos.copy(), data.mocap_quat.copy()]
        return rows

    same(truth, pull, 1e-5)


def test_pixels_text_and_rectangles():
    model, _, _, out = scene(mj)
    context = mj.MjrContext(model, 100)
    view = mj.MjrRect(3, 2, 40, 30)
    given = np.random.default_rng(0).integers(0, 255, (30, 40, 3), dtype=np.uint8)
    mj.mjr_drawPixels(given, None, view, context)
    back = np.zeros_like(given)
    mj.mjr_readPixels(back, None, view, context)
    assert (back == given).all()
    with pytest.raises(TypeError, match="rgb should be of a viewport"):
        mj.mjr_drawPixels(given, None, mj.MjrRect(0, 0, 10, 10), context)
    mj.mjr_changeFont(150, context)
    before = context._rgb.sum()
    mj.mjr_text(mj.mjtFont.mjFONT_NORMAL, "hello", context, 0.5, 0.5, 1, 1, 1)
    assert context._rgb.sum() > before and context.fontScale == 150
    assert [mj.mjr_findRect(x, 5, 1, view) for x in (2, 3, 42, 43)] == [-1, 0, 0, -1]


def test_names_that_are_missing_say_why():
    for name in mj.MISSING:
        with pytest.raises(NotImplementedError, match=f"robohive.mujoco has no {name}: .{{20}}"):
            getattr(mj, name)()
