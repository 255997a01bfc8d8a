import pytest
import robohive.mujoco as mj
from scenes import ARM


@pytest.fixture
def model():
    return mj.MjModel.from_xml_string(ARM)


@pytest.fixture
def data(model):
    return mj.MjData(model)
