"""A runtime that is compiled for the tests."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def manifest(tmp_path_factory):
    """The manifest of the stand-in runtime."""
    pytest.importorskip("websockets")
    try:
        import xr  # noqa: F401
    except Exception as error:
        pytest.skip(f"pyopenxr cannot be imported: {error}")
    if shutil.which("cc") is None:
        pytest.skip("there is no C compiler: apt-get install gcc")
    folder = tmp_path_factory.mktemp("runtime")
    library = folder / "runtime.so"
    flags = ["-std=c11", "-D_GNU_SOURCE", "-O1", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC"]
    subprocess.run(["cc", *flags, "-o", library, Path(__file__).with_name("runtime.c")], check=True)
    manifest = folder / "runtime.json"
    manifest.write_text(json.dumps({"file_format_version": "1.0.0", "runtime": {"library_path": str(library), "name": "stand-in"}}))
    return manifest


@pytest.fixture
def headset(manifest, tmp_path):
    from headset import Headset

    return Headset(tmp_path, manifest)
