"""MuJoCo's classic way of drawing: scenes, contexts, cameras that move."""

import numpy as np
import pytest
import robohive.mujoco as mj
from scenes import ARM


def scene_of(module, model, data, camera=None, options=None):
    """A scene of a free camera. The second update centres planes below the eye of the first, in MuJoCo."""
    scene = module.MjvScene(model, 100)
    if camera is None:
        camera = module.MjvCamera()
        module.mjv_defaultFreeCamera(model, camera)
    for _ in range(2):
        all = int(module.mjtCatBit.mjCAT_ALL)
        module.mjv_updateScene(model, data, options or module.MjvOption(), module.MjvPerturb(), camera, all, scene)
    return scene


def drawn(scene, context, width=64, height=48):
    """Colours and depths of a scene, row 0 at the top."""
    viewport = mj.MjrRect(0, 0, width, height)
    mj.mjr_render(viewport, scene, context)
    rgb, depth = np.zeros((height, width, 3), np.uint8), np.zeros((height, width), np.float32)
    mj.mjr_readPixels(rgb, depth, viewport, context)
    return rgb[::-1], depth[::-1]


@pytest.fixture
def context(model):
    return mj.MjrContext(model, mj.mjtFontScale.mjFONTSCALE_150)


def test_a_scene_is_drawn_as_the_renderer_draws_it(model, data, context):
    mj.mj_forward(model, data)
    scene = scene_of(mj, model, data)
    rgb, depth = drawn(scene, context)
    renderer = mj.Renderer(model, 48, 64)
    renderer.update_scene(data)
    assert np.array_equal(rgb, renderer.render()) and rgb.std() > 1
    renderer.enable_depth_rendering()
    near, far = scene.camera[0].frustum_near, scene.camera[0].frustum_far
    distance = 1 / (1 / near - depth.astype(float) * (1 / near - 1 / far))
    assert np.allclose(distance, renderer.render(), rtol=1e-3)
    context.readDepthMap = mj.mjtDepthMap.mjDEPTH_ZEROFAR
    assert np.allclose(drawn(scene, context)[1], 1 - depth)


def test_segmentation_numbers_the_geoms_of_the_scene(model, data, context):
    mj.mj_forward(model, data)
    scene = scene_of(mj, model, data)
    scene.flags[[mj.mjtRndFlag.mjRND_SEGMENT, mj.mjtRndFlag.mjRND_IDCOLOR]] = 1
    rgb = drawn(scene, context)[0].astype(int)
    numbers = np.unique(rgb[..., 0] + 256 * rgb[..., 1] + 65536 * rgb[..., 2])
    seen = {scene.geoms[number - 1].objid for number in numbers if number}
    assert {model.geom(name).id for name in ("floor", "shell", "rod")} <= seen
    scene.flags[mj.mjtRndFlag.mjRND_IDCOLOR] = 0
    assert len(np.unique(drawn(scene, context)[0].reshape(-1, 3), axis=0)) == len(numbers)


def test_geoms_of_a_program_are_drawn_behind_those_of_the_model(model, data, context):
    mj.mj_forward(model, data)
    scene = scene_of(mj, model, data)
    before = drawn(scene, context)[0]
    marker = scene.geoms[scene.ngeom]
    mj.mjv_initGeom(marker, mj.mjtGeom.mjGEOM_SPHERE, np.full(3, 0.2), data.geom("rod").xpos, np.eye(3).ravel(), [1, 0, 0, 1])
    assert np.array_equal(drawn(scene, context)[0], before)
    scene.ngeom += 1
    red = drawn(scene, context)[0].astype(int)
    assert ((red[..., 0] > 80) & (red[..., 1] < 40)).sum() > 20
    with pytest.raises(AttributeError, match="read-only"):
        scene.geoms[0].type = mj.mjtGeom.mjGEOM_BOX
    with pytest.raises(ValueError, match="read-only"):
        scene.geoms[0].rgba[:] = 1
    marker.type = mj.mjtGeom.mjGEOM_HFIELD
    with pytest.raises(ValueError, match="type 1 cannot be added"):
        drawn(scene, context)


#: Sides that a text stands at.
GRID = {
    "TOPLEFT": (-1, -1),
    "TOPRIGHT": (1, -1),
    "BOTTOMLEFT": (-1, 1),
    "BOTTOMRIGHT": (1, 1),
    "TOP": (0, -1),
    "BOTTOM": (0, 1),
    "LEFT": (-1, 0),
    "RIGHT": (1, 0),
}


def blank(context):
    context._rgb[:] = 200
    return mj.MjrRect(0, 0, context.offWidth, context.offHeight)


@pytest.mark.parametrize("word", GRID)
def test_overlays_stand_at_their_places(context, word):
    viewport = blank(context)
    gridpos = mj.mjtGridPos[f"mjGRID_{word}"]
    mj.mjr_overlay(mj.mjtFont.mjFONT_NORMAL, gridpos, viewport, "one\nthree", "", context)
    picture = context._rgb[::-1].astype(int)
    rows, columns = np.nonzero((picture != 200).any(-1))
    # Five letters of 16 pixels, two lines.
    assert (np.ptp(rows) + 1, np.ptp(columns) + 1) == (5 + 2 * 16 + 5, 13 + 5 * 16)
    height, width = picture.shape[:2]
    sides = np.sign((columns.mean() - width / 2) // 8), np.sign((rows.mean() - height / 2) // 8)
    expected = GRID[word]
    assert all(want in (0, side) for want, side in zip(expected, sides, strict=True))
    gaps = {-1: (columns.min(), rows.min()), 1: (width - 1 - columns.max(), height - 1 - rows.max())}
    assert all(gaps[side][axis] in (5, 6) for axis, side in enumerate(expected) if side)
    assert set(np.unique(picture)) == {100, 200, 255}


def test_overlays_have_two_columns_with_grey_titles(context):
    viewport = blank(context)
    pixels = {}
    for word in ("TOPLEFT", "TOPRIGHT"):
        blank(context)
        mj.mjr_overlay(mj.mjtFont.mjFONT_NORMAL, mj.mjtGridPos[f"mjGRID_{word}"], viewport, "I", "I", context)
        row = context._rgb[..., 0].astype(int)
        pixels[word] = [np.nonzero(row == value)[1].mean() for value in (178, 255)]
        # Where the boxes overlap, they are darkened twice.
        assert (row == 50).sum() == 2 * (5 + 16)
    assert all(title < content for title, content in pixels.values())
    before = context._rgb.copy()
    mj.mjr_overlay(mj.mjtFont.mjFONT_BIG, mj.mjtGridPos.mjGRID_TOP, mj.MjrRect(0, 0, 0, 0), "none", None, context)
    assert np.array_equal(context._rgb, before)
    mj.mjr_overlay(mj.mjtFont.mjFONT_SHADOW, mj.mjtGridPos.mjGRID_TOP, mj.MjrRect(0, 0, 40, 20), "longer than the picture", None, context)
    assert not np.array_equal(context._rgb, before)
    with pytest.raises(ValueError, match="9"):
        mj.mjr_overlay(0, 9, viewport, "nowhere", "", context)


def test_labels_fill_their_rectangle(context):
    blank(context)
    mj.mjr_label(mj.MjrRect(10, 20, 60, 30), mj.mjtFont.mjFONT_NORMAL, "ab", 0, 0, 1, 1, 1, 1, 0, context)
    box = context._rgb[20:50, 10:70].astype(int)
    blue, yellow = (box == [0, 0, 255]).all(-1), (box == [255, 255, 0]).all(-1)
    assert (blue | yellow).all() and 60 < yellow.sum() < 512 and yellow.any(0).nonzero()[0].mean() == pytest.approx(30, abs=3)


def test_what_cannot_be_drawn_says_so(model, data, context):
    mj.mj_forward(model, data)
    with pytest.raises(RuntimeError, match="no scene yet"):
        drawn(mj.MjvScene(model, 10), context)
    scene = scene_of(mj, model, data)
    with pytest.raises(TypeError, match="rgb should have"):
        mj.mjr_readPixels(np.zeros((4, 4, 3), np.uint8), None, mj.MjrRect(0, 0, 8, 8), context)
    with pytest.raises(mj.FatalError, match="unexpected action 0"):
        mj.mjv_moveCamera(model, mj.mjtMouse.mjMOUSE_NONE, 0.1, 0.1, mj.MjvCamera())


def moves(module, model):
    """Where every kind of drag takes a camera."""
    for action in range(1, 10):
        for x, y in ((0.1, 0.2), (2.5, -3.0), (0.0, -0.01)):
            camera = module.MjvCamera()
            module.mjv_defaultFreeCamera(model, camera)
            camera.azimuth, camera.elevation = 30, -20
            module.mjv_moveCamera(model, action, x, y, camera)
            yield from (*camera.lookat, camera.distance, camera.azimuth, camera.elevation)


def clicks(module, model, data):
    """What is hit at places of a picture."""
    scene, option = scene_of(module, model, data), module.MjvOption()
    for place in ((0.5, 0.5), (0.5, 0.6), (0.1, 0.1), (0.9, 0.95), (0.55, 0.5)):
        point, ids = np.zeros(3), [np.zeros(1, np.int32) for _ in range(3)]
        yield module.mjv_select(model, data, option, 1.3, *place, scene, point, *ids)
        yield from (*point, *(int(id[0]) for id in ids))


def geoms(module, model, data):
    """Fields of all geoms of a scene, and of its camera."""
    scene = scene_of(module, model, data)
    for geom in scene.geoms[: scene.ngeom]:
        for name in ("type", "dataid", "objtype", "objid", "category", "segid", "matid", "modelrbound"):
            yield getattr(geom, name)
        for name in ("pos", "mat", "size", "rgba"):
            yield from np.ravel(getattr(geom, name))
    # MuJoCo's are those of two eyes.
    yield from np.mean([eye.pos for eye in scene.camera], axis=0)
    eye = scene.camera[0]
    yield from (*eye.forward, *eye.up, eye.frustum_bottom, eye.frustum_top, eye.frustum_near, eye.frustum_far)


@pytest.mark.parametrize("orthographic", ["false", "true"])
def test_cameras_geoms_and_clicks_are_mujocos(orthographic):
    truth = pytest.importorskip("mujoco")
    if truth is mj or getattr(truth, "__version__", None) != "3.12.0":
        pytest.skip("compares with mujoco 3.12.0")
    text = ARM.replace("<worldbody>", f"<visual><global orthographic='{orthographic}'/></visual><worldbody>", 1)
    found = []
    for module in (truth, mj):
        model = module.MjModel.from_xml_string(text)
        data = module.MjData(model)
        module.mj_forward(model, data)
        found.append([*moves(module, model), *clicks(module, model, data), *geoms(module, model, data)])
    assert np.allclose(*found, rtol=0, atol=2e-6)


def test_a_renderers_scene_takes_geoms_and_flags_in_any_order():
    model = mj.MjModel.from_xml_string(
        "<mujoco><worldbody><light pos='1 0 3'/><geom type='plane' size='2 2 .1'/><geom size='.2' pos='0 0 .5'/></worldbody></mujoco>"
    )
    data = mj.MjData(model)
    mj.mj_forward(model, data)

    def drawn(*changes):
        with mj.Renderer(model, 48, 48) as renderer:
            renderer.update_scene(data)
            for change in changes:
                change(renderer.scene)
            return renderer.render()

    def add(scene):
        place = scene.geoms[scene.ngeom]
        mj.mjv_initGeom(place, mj.mjtGeom.mjGEOM_SPHERE, [0.3, 0, 0], [0.5, 0, 0.5], np.eye(3).ravel(), [1, 0, 0, 1])
        scene.ngeom += 1

    def no_shadow(scene):
        scene.flags[mj.mjtRndFlag.mjRND_SHADOW] = 0

    plain, both = drawn(), drawn(add, no_shadow)
    assert (plain != drawn(add)).any() and (plain != drawn(no_shadow)).any() and (both != drawn(add)).any()
    np.testing.assert_array_equal(both, drawn(no_shadow, add))
    with mj.Renderer(model, 48, 48, max_geom=4) as renderer:
        renderer.update_scene(data)
        add(renderer.scene)
        renderer.render()
        renderer.update_scene(data)
        # An update drops what was added.
        np.testing.assert_array_equal(renderer.render(), plain)


#: A ball behind glass, and a box.
GLASS = """<mujoco><statistic extent="1" center="0 0 0"/><visual><map znear=".5" zfar="4"/>
  <headlight ambient=".5 .5 .5" diffuse="0 0 0" specular="0 0 0"/></visual><worldbody><camera name="eye" pos="0 0 2"/>
  <geom size=".4" rgba=".2 .4 .6 1"/><geom type="box" size=".1 .1 .1" pos=".6 .6 0"/>
  <geom type="box" size=".3 .3 .01" pos="0 0 .8" rgba=".8 .4 .2 .5"/></worldbody></mujoco>"""
#: Of pictures of it with these flags, 64 x 64: the colour in the middle, and the sum of all, as MuJoCo 3.12.0 draws them on Mesa.
FLAGGED = {
    "": ([82, 51, 38], 251253),
    "ADDITIVE": ([76, 77, 89], 273587),
    "WIREFRAME": ([80, 51, 40], 156432),
    "ADDITIVE WIREFRAME": ([128, 103, 102], 175069),
    "SEGMENT IDCOLOR": ([3, 0, 0], 4518),
    "WIREFRAME SEGMENT IDCOLOR": ([3, 0, 0], 4518),
    "DEPTH": ([0, 0, 0], 0),
    "DEPTH SEGMENT": ([0, 0, 0], 0),
}


@pytest.mark.parametrize("names", FLAGGED)
def test_flags_draw_what_mujoco_draws(names):
    model = mj.MjModel.from_xml_string(GLASS)
    data = mj.MjData(model)
    mj.mj_forward(model, data)
    colour, total = FLAGGED[names]
    with mj.Renderer(model, 64, 64) as renderer:
        renderer.update_scene(data, "eye")
        renderer.enable_depth_rendering()
        depth = renderer.render()
        renderer.disable_depth_rendering()
        for name in names.split():
            renderer.scene.flags[mj.mjtRndFlag[f"mjRND_{name}"]] = 1
        picture = renderer.render().astype(int)
        assert np.abs(picture[32, 32] - colour).max() <= 1
        assert picture.sum() == pytest.approx(total, rel=0.005)
        # Depths stay those of surfaces.
        renderer.enable_depth_rendering()
        np.testing.assert_array_equal(renderer.render(), depth)
        context = mj.MjrContext(model, mj.mjtFontScale.mjFONTSCALE_150)
        np.testing.assert_array_equal(drawn(renderer.scene, context, 64, 64)[0], picture)


def test_sizes_of_round_geoms_are_mujocos():
    given, geom = [0.3, 0.5, 0.7], mj.MjvScene(mj.MjModel.from_xml_string("<mujoco/>"), 1).geoms[0]
    for kind, size in {"SPHERE": [0.3] * 3, "CAPSULE": [0.3, 0.3, 0.5], "CYLINDER": [0.3, 0.3, 0.5], "BOX": given}.items():
        mj.mjv_initGeom(geom, mj.mjtGeom[f"mjGEOM_{kind}"], given, np.zeros(3), np.eye(3).ravel(), np.ones(4))
        np.testing.assert_allclose(geom.size, size, rtol=1e-6)
