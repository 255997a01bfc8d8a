import pytest
import robohive.mujoco as mj
from scenes import ARM


@pytest.fixture
def model():
    return mj.MjModel.from_xml_string(ARM)


@pytest.fixture
def data(model):
    return mj.MjData(model)


@pytest.fixture(scope="session")
def truth():
    """MuJoCo's own bindings, where they are installed."""
    module = pytest.importorskip("mujoco")
    if module is mj or getattr(module, "__version__", None) != "3.12.0":
        pytest.skip("compares with mujoco 3.12.0")
    return module
