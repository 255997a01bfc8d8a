"""Descriptions of models: what attributes take, how elements are found, and what goes wrong."""

import copy
import zipfile

import numpy as np
import pytest
import robohive.mujoco as mj
from spec_scripts import LEG, two_legs


@pytest.fixture
def leg():
    return mj.MjSpec.from_string(LEG)


def test_arrays_are_written_in_place_and_keep_their_identity(leg):
    site = leg.site("foot")
    held = site.pos
    site.pos = [1, 2, 3]
    held[0] = 7
    assert site.pos is held and held.tolist() == [7, 2, 3]
    assert leg.compile().site("foot").pos.tolist() == [7, 2, 3]


def test_attributes_have_mujocos_types(leg):
    geom = leg.geom("thigh")
    assert geom.type is mj.mjtGeom.mjGEOM_CAPSULE
    geom.type = 6
    assert geom.type is mj.mjtGeom.mjGEOM_BOX
    assert geom.rgba.dtype == np.float32 and geom.pos.dtype == np.float64
    assert np.isnan(geom.mass) and isinstance(geom.contype, int) and isinstance(leg.body("thigh").mocap, bool)
    assert "".join(leg.compiler.eulerseq) == "xyz"


@pytest.mark.parametrize(
    ("name", "value", "error"),
    [
        ("pos", [1, 2], TypeError),
        ("pos", None, TypeError),
        ("pos", "here", TypeError),
        ("type", "box", TypeError),
        ("type", 77, TypeError),
        ("material", 3, TypeError),
        ("name", 3, TypeError),
        ("name", "pad", ValueError),
        ("colour", 1, AttributeError),
    ],
)
def test_values_that_do_not_fit_change_nothing(leg, name, value, error):
    geom = leg.geom("thigh")
    before = leg.to_xml()
    with pytest.raises(error):
        setattr(geom, name, value)
    assert leg.to_xml() == before


def test_arguments_of_add_are_checked_before_anything_is_added(leg):
    body = leg.body("shin")
    with pytest.raises(ValueError, match="size 3"):
        body.add_geom(pos=[0, 1])
    with pytest.raises(ValueError, match="Only one of"):
        body.add_geom(euler=[0, 0, 1], zaxis=[0, 0, 1])
    with pytest.raises(TypeError, match="no attribute 'vel'"):
        body.add_geom(vel=1)
    with pytest.raises(ValueError, match="repeated name 'pad' in geom"):
        body.add_geom(name="pad", size=[1])
    with pytest.raises(TypeError, match="align, group, name"):
        body.add_freejoint(axis=[0, 0, 1])
    with pytest.raises(TypeError, match="plugin"):
        body.add_geom(plugin=object())
    assert len(body.geoms) == 1


def test_elements_are_found_by_name_place_and_kind(leg):
    thigh = leg.body("thigh")
    assert leg.body("none") is None and leg.geom("pad").parent is leg.worldbody
    assert [body.name for body in leg.bodies] == ["world", "thigh", "shin"]
    assert thigh.first_geom() is leg.geom("thigh") and thigh.next_geom(thigh.first_geom()) is None
    assert thigh.find_all("site") == leg.sites and thigh.find_all(mj.mjtObj.mjOBJ_BODY) == [leg.body("shin")]
    assert thigh.find_child("shin").frame is leg.frame("below") and leg.frame("below").parent is thigh
    assert leg.tendon("cord").path[1].target is leg.site("foot")
    with pytest.raises(ValueError, match="body.find_all supports"):
        thigh.find_all("actuator")


def test_references_keep_the_old_name_when_an_element_is_renamed(leg):
    leg.joint("hip").name = "thigh_joint"
    assert leg.actuator("hip").target == "hip"
    with pytest.raises(ValueError, match="hip"):
        leg.compile()


def test_errors_of_a_text_name_file_line_and_column():
    with pytest.raises(ValueError, match=r":2:\d+.*did you mean 'mass'"):
        mj.MjSpec.from_string("<mujoco>\n<worldbody><geom size='1' mas='2'/></worldbody></mujoco>")


def test_errors_of_elements_without_a_text_name_the_element():
    spec = mj.MjSpec()
    spec.worldbody.add_geom(name="flat", info="made here")
    with pytest.raises(ValueError, match=r"(?s)flat.*made here"):
        spec.compile()


def test_attached_elements_move_and_stay_the_same_objects(leg):
    spec = mj.MjSpec()
    knee, motor = leg.joint("knee"), leg.actuator("knee")
    around = spec.attach(leg, frame=spec.worldbody.add_frame(pos=[0, 0, 1]), prefix="l-", suffix="-s")
    assert spec.joint("l-knee-s") is knee and spec.actuators[1] is motor
    assert motor.target == "l-knee-s" and leg.parent is spec and around.parent is spec.worldbody
    assert [body.name for body in leg.bodies] == ["world", "l-thigh-s", "l-shin-s"]
    knee.damping = 3
    model = spec.compile()
    assert model.bind(knee).damping[0] == 3
    with pytest.raises(ValueError, match="attached"):
        leg.compile()
    with pytest.raises(ValueError, match="attached"):
        leg.delete(knee)
    with pytest.raises(ValueError, match="attached already"):
        spec.attach(leg, frame=around, prefix="again")


def test_attaching_is_refused_as_a_whole():
    spec, leg = mj.MjSpec.from_string(LEG), mj.MjSpec.from_string(LEG)
    frame = spec.worldbody.add_frame(name="here")
    with pytest.raises(ValueError, match="Frame not found"):
        spec.attach(leg, frame="there")
    with pytest.raises(ValueError, match="the frame or the site"):
        spec.attach(leg)
    with pytest.raises(ValueError, match="repeated name"):
        spec.attach(leg, frame=frame, prefix="")
    assert leg.parent is None and leg.compile().nbody == 3 and spec.compile().nbody == 3


def test_settings_of_what_is_attached_conflict_as_the_compiler_says():
    spec, leg = mj.MjSpec(), mj.MjSpec.from_string(LEG)
    spec.compiler.conflict = mj.mjtConflict.mjCONFLICT_MERGE
    spec.option.timestep, leg.option.timestep = 0.005, 0.001
    with pytest.warns(UserWarning, match="timestep"):
        spec.attach(leg, frame=spec.worldbody.add_frame())
    assert spec.option.timestep == 0.001
    other = mj.MjSpec.from_string(LEG)
    spec.option.integrator, other.option.integrator = 1, 2
    with pytest.raises(ValueError, match="integrator"):
        spec.attach(other, frame=spec.worldbody.add_frame(), prefix="second")
    assert spec.compile().nbody == 3


def test_a_part_is_attached_to_its_own_description_as_a_copy(leg):
    frame = leg.worldbody.add_frame(pos=[0, 1, 0])
    twin = frame.attach_body(leg.body("thigh"), prefix="twin-")
    assert twin is not leg.body("thigh") and leg.actuator("twin-hip").target == "twin-hip"
    model = leg.compile()
    assert (model.nbody, model.nmat, model.nactuator) == (5, 1, 4)


def test_deleting_a_body_takes_what_refers_to_it(leg):
    leg.delete(leg.body("shin"))
    assert [actuator.name for actuator in leg.actuators] == ["hip"]
    assert not leg.excludes and not leg.tendons and not leg.sensors
    model = leg.compile()
    assert model.key("bent").qpos.tolist() == [0.3] and leg.key("bent").qpos.tolist() == [0.3]
    with pytest.raises(ValueError, match="not part"):
        leg.delete(leg.geoms[0]._duplicate(None, leg, None))
    with pytest.raises(ValueError, match="world"):
        leg.delete(leg.worldbody)


@pytest.mark.parametrize("kind", ["body", "frame", "joint", "freejoint", "geom", "site", "camera", "light"])
def test_nothing_is_added_to_what_was_deleted(leg, kind):
    shin = leg.body("shin")
    frame = shin.add_frame(name="around")
    leg.delete(shin)
    for place, name in ((shin, "the body 'shin'"), (frame, "the frame 'around'")):
        with pytest.raises(ValueError, match=f"^{name} was deleted from its description$"):
            getattr(place, f"add_{kind}")()


def test_what_was_deleted_is_not_attached_or_replaced(leg):
    shin = leg.body("shin")
    frame = shin.add_frame()
    leg.delete(shin)
    site = leg.worldbody.add_site()
    for call in (
        shin.to_frame,
        lambda: shin.make_flex("cloth"),
        lambda: shin.attach_frame(leg.worldbody.add_frame()),
        lambda: site.attach_body(shin),
    ):
        with pytest.raises(ValueError, match="the body 'shin' was deleted"):
            call()
    for call in (lambda: leg.attach(mj.MjSpec(), frame=frame), lambda: leg.worldbody.attach_frame(frame)):
        with pytest.raises(ValueError, match="the frame was deleted"):
            call()


def test_copies_share_nothing(leg):
    for duplicate in (leg.copy(), copy.copy(leg), copy.deepcopy(leg)):
        duplicate.body("thigh").pos[0] = 5
        duplicate.option.timestep = 0.5
        duplicate.body("shin").name = "calf"
        assert duplicate.exclude("") is None and duplicate.geom("shin").classname is not leg.geom("shin").classname
    assert leg.body("thigh").pos[0] == 0 and leg.option.timestep == 0.002 and leg.body("shin") is not None


def test_bound_elements_are_views_of_what_was_compiled():
    spec = two_legs(mj)
    model = spec.compile()
    data = mj.MjData(model)
    hips = [spec.joint("left/hip"), spec.joint("right/hip")]
    data.bind(hips).qpos = [0.1, 0.2]
    assert data.bind(hips).qpos.tolist() == [0.1, 0.2] and data.bind(hips[0]).qpos.tolist() == [0.1]
    assert model.bind(spec.bodies[1:3]).pos.shape == (2, 3) and model.bind([]).qposadr.tolist() == []
    with pytest.raises(AttributeError, match="no attribute 'invalid'"):
        model.bind(hips).invalid  # noqa: B018
    spec.compile()
    with pytest.raises(ValueError, match="does not match"):
        model.bind(hips[0])


def test_files_are_named_from_the_text_and_from_memory(tmp_path):
    cube = "\n".join(f"v {x} {y} {z}" for x in (0, 1) for y in (0, 1) for z in (0, 1))
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "cube.obj").write_text(cube)
    text = "<mujoco><compiler meshdir='parts'/><asset><mesh file='cube.obj'/></asset><worldbody/></mujoco>"
    (tmp_path / "model.xml").write_text(text)
    spec = mj.MjSpec.from_file(tmp_path / "model.xml")
    assert spec.meshdir == "parts" and spec.mesh("cube").file == "cube.obj"
    spec.worldbody.add_geom(type=mj.mjtGeom.mjGEOM_MESH, meshname="cube")
    assert spec.compile().nmeshvert == 8
    spec.to_file(tmp_path / "written.xml")
    assert mj.MjModel.from_xml_path(str(tmp_path / "written.xml")).nmeshvert == 8
    spec.meshdir = "nowhere"
    with pytest.raises(ValueError, match="cube.obj"):
        spec.compile()
    included = mj.MjSpec.from_string(
        "<mujoco><include file='part.xml'/></mujoco>",
        include={"part.xml": b"<mujoco><worldbody><frame name='empty'/></worldbody></mujoco>"},
    )
    assert included.frame("empty").parent is included.worldbody


def test_orientations_resolve_to_quaternions():
    body = mj.MjSpec().worldbody.add_body(euler=[0, 0, 90])
    quat = mj.MjSpec.resolve_orientation(degree=True, sequence=None, orientation=body.alt)
    np.testing.assert_allclose(quat, [0.5**0.5, 0, 0, 0.5**0.5], atol=1e-15)


def test_archives_and_encoded_files_hold_the_same_model(tmp_path):
    spec = mj.MjSpec.from_string(LEG)
    spec.assets = {"cube.obj": "\n".join(f"v {x} {y} {z}" for x in (0, 1) for y in (0, 1) for z in (0, 1))}
    spec.add_mesh(name="cube", file="cube.obj")
    spec.worldbody.add_geom(type=mj.mjtGeom.mjGEOM_MESH, meshname="cube")
    spec.to_zip(str(tmp_path / "leg.zip"))
    assert mj.from_zip(str(tmp_path / "leg.zip")).compile().nmeshvert == 8
    with pytest.raises(ValueError, match="no zip archive"):
        (tmp_path / "no.zip").write_text("nothing")
        mj.from_zip(str(tmp_path / "no.zip"))
    with zipfile.ZipFile(tmp_path / "parts.zip", "w") as archive:
        archive.writestr("parts/foot.xml", "<mujoco><worldbody><site name='foot'/></worldbody></mujoco>")
        archive.writestr("whole.xml", "<mujoco><include file='parts/foot.xml'/></mujoco>")
    assert mj.from_zip(str(tmp_path / "parts.zip")).compile().nsite == 1
    text = tmp_path / "leg.xml"
    assert mj.MjSpec.from_string(LEG).encode(str(text)) == text.stat().st_size
    with pytest.raises(mj.FatalError, match="MJCF"):
        spec.encode(str(tmp_path / "leg.mjb"))


def test_sizes_of_sensors_are_those_of_the_model():
    spec = two_legs(mj)
    spec.add_sensor(type=mj.mjtSensor.mjSENS_CONTACT, objtype=mj.mjtObj.mjOBJ_BODY, objname="torso", intprm=[0b1010011, 0, 2])
    sizes = [sensor.get_data_size() for sensor in spec.sensors]
    assert sizes == spec.compile().sensor_dim.tolist()


@pytest.mark.parametrize(("kind", "size", "channels"), [("2D", (3, 2), 1), ("2D", (3, 2), 4), ("CUBE", (2, 2), 3), ("SKYBOX", (2, 12), 3)])
def test_pixels_of_a_texture_are_those_of_the_model(kind, size, channels):
    width, height = size
    spec = mj.MjSpec()
    spec.compiler.texturedir = "pictures/"
    pixels = bytes(7 * k % 256 for k in range(width * height * channels))
    texture = spec.add_texture(name="a/b", type=mj.mjtTexture[f"mjTEXTURE_{kind}"], width=width, height=height, nchannel=channels)
    assert texture.data == b""
    texture.data = pixels
    model = spec.copy().compile()
    assert model.tex_data.tobytes() == texture.data == pixels and model.tex_colorspace[0] == mj.mjtColorSpace.mjCOLORSPACE_AUTO
    assert (model.tex_width[0], model.tex_height[0], model.tex_nchannel[0]) == (width, height, channels)
    with pytest.raises(ValueError, match="no text can hold"):
        spec.to_xml()
    texture.data = pixels[:-1]
    with pytest.raises(ValueError, match="bytes of data for"):
        spec.compile()


def test_a_part_may_name_what_its_parent_has():
    arm = mj.MjSpec.from_string(
        "<mujoco><worldbody><body name='arm'><geom size='.1'/><site name='hand' pos='1 0 0'/></body></worldbody>"
        "<tendon><spatial name='t'><site site='shoulder'/><site site='hand'/></spatial></tendon></mujoco>"
    )
    with pytest.raises(ValueError, match="1:1.*tendon 't': there is no site 'shoulder'"):
        arm.compile()
    torso = mj.MjSpec.from_string("<mujoco><worldbody><site name='shoulder'/><frame name='f'/></worldbody></mujoco>")
    torso.attach(arm, frame="f", prefix="")
    model = torso.compile()
    assert model.ntendon == 1 and model.tendon_length0[0] == 1.0
