"""Files in memory, and what a model is made of."""

import pytest
import robohive.mujoco as mj
from robohive.mujoco import msh2obj

MESH = "<mujoco><asset><mesh name='m' file='{}'/></asset><worldbody><geom type='mesh' mesh='m'/></worldbody></mujoco>"
TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"


def test_files_in_memory_serve_loading_and_compiling():
    with mj.MjVfs() as files:
        files["model.xml"] = MESH.format("m.obj").encode()
        files["m.obj"] = TETRAHEDRON.encode()
        model = mj.MjModel.from_xml_path("model.xml", vfs=files)
        spec = mj.MjSpec.from_string(MESH.format("m.obj"))
        assert model.nmeshvert == spec.compile(vfs=files).nmeshvert == 4 and not spec.assets
        with pytest.raises(ValueError, match="already"):
            files["m.obj"] = b""
        with pytest.raises(ValueError, match="not by both"):
            mj.MjModel.from_xml_string("<mujoco/>", {"a": b""}, vfs=files)
        del files["m.obj"]
        assert "m.obj" not in files and "model.xml" in files
        with pytest.raises(KeyError):
            del files["m.obj"]
    with pytest.raises(RuntimeError, match="closed"):
        files["m.obj"] = b""


def test_files_of_one_name_are_refused():
    with pytest.raises(ValueError, match="Repeated file name in assets: m.obj"):
        mj.MjModel.from_xml_string("<mujoco/>", {"m.obj": b"", "folder/m.obj": b""})


def test_dependencies_are_those_that_are_read(tmp_path):
    (tmp_path / "m.obj").write_text(TETRAHEDRON)
    (tmp_path / "part.xml").write_text("<mujoco><asset><mesh name='m' file='m.obj'/></asset></mujoco>")
    main = tmp_path / "main.xml"
    main.write_text("<mujoco><include file='part.xml'/><worldbody><geom type='mesh' mesh='m'/></worldbody></mujoco>")
    assert mj.mju_getXMLDependencies(str(main)) == [str(tmp_path / name) for name in ("main.xml", "part.xml", "m.obj")]


def test_the_schema_is_the_readers():
    text = mj.mj_printSchema(False, False)
    assert "worldbody" in text and "<br>" not in text
    assert "&nbsp;" in mj.mj_printSchema(True, True)


def test_compiling_is_logged_where_asked(tmp_path):
    before = mj.MjLogConfig.get()
    config = mj.MjLogConfig.get()
    config.logfile, config.logto_console = str(tmp_path / "log"), False
    config.topics = 1 << (mj.mjtLogTopic.mjTOPIC_TIME_CMP - 1)
    config.set()
    try:
        mj.MjModel.from_xml_string("<mujoco/>")
    finally:
        before.set()
    mj.MjModel.from_xml_string("<mujoco/>")
    assert (tmp_path / "log").read_text().count("compile time") == 1


def test_msh_that_lies_about_its_size(tmp_path):
    file = tmp_path / "m.msh"
    file.write_bytes(bytes(16))
    assert msh2obj.msh_to_obj(file) == ""
    file.write_bytes(b"\1\0\0\0" + bytes(12))
    with pytest.raises(ValueError, match=r"m\.msh is no MSH file: it has 16 bytes"):
        msh2obj.msh_to_obj(file)


def test_what_was_loaded_last_is_written(tmp_path):
    model = mj.MjModel.from_xml_string(MESH.format("m.obj"), {"m.obj": TETRAHEDRON.encode()})
    mj.mj_saveLastXML(str(tmp_path / "saved.xml"), model)
    (tmp_path / "m.obj").write_text(TETRAHEDRON)
    again = mj.MjModel.from_xml_path(str(tmp_path / "saved.xml"))
    assert again.mesh_vert.tolist() == model.mesh_vert.tolist()


@pytest.mark.parametrize(("text", "place"), [("<mujoco>\n</mujoco>\0", "2:10"), ("a\0", "1:2"), ("\0", "1:1")])
def test_a_nul_in_a_text_is_named(text, place):
    for read in (mj.MjModel.from_xml_string, mj.MjSpec.from_string):
        with pytest.raises(ValueError, match=f"<text>:{place}: error: the text has a NUL here"):
            read(text)
