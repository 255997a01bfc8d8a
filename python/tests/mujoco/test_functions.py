"""Functions by laws: factors, programs with bounds, slopes beside differences, histories, least squares."""

import io

import numpy as np
import pytest
import robohive.mujoco as mj
from robohive.mujoco import minimize


def random_quat(draws):
    quat = draws.normal(size=4)
    return quat / np.linalg.norm(quat)


def turned(quat, turn):
    out = quat.copy()
    mj.mju_quatIntegrate(out, turn, 1.0)
    return out


def test_band_matrices_solve_as_dense_ones():
    draws, total, band, dense = np.random.default_rng(0), 9, 3, 2
    lower = np.tril(draws.normal(size=(total, total)))
    rows, columns = np.indices(lower.shape)
    lower[(rows < total - dense) & (rows - columns >= band)] = 0
    full = lower + lower.T + 20 * np.eye(total)
    kept = np.zeros(band * (total - dense) + dense * total)
    mj.mju_dense2Band(kept, full, total, band, dense)
    assert [kept[mj.mju_bandDiag(i, total, band, dense)] for i in range(total)] == np.diag(full).tolist()
    back = np.zeros((total, total))
    mj.mju_band2Dense(back, kept, total, band, dense, True)
    np.testing.assert_array_equal(back, full)
    right, product, solution = draws.normal(size=total), np.zeros(total), np.zeros(total)
    mj.mju_bandMulMatVec(product, kept, right, total, band, dense, 1, True)
    np.testing.assert_allclose(product, full @ right, atol=1e-12)
    assert mj.mju_cholFactorBand(kept, total, band, dense, 0.0, 0.0) > 0
    mj.mju_cholSolveBand(solution, kept, right, total, band, dense)
    np.testing.assert_allclose(full @ solution, right, atol=1e-12)
    mj.mju_dense2Band(kept, -full, total, band, dense)
    assert mj.mju_cholFactorBand(kept, total, band, dense, 0.0, 0.0) == 0


@pytest.mark.parametrize("seed", range(20))
def test_programs_with_bounds_end_where_no_free_slope_is_left(seed):
    draws, n = np.random.default_rng(seed), 6
    root = draws.normal(size=(n, n))
    h, g = root @ root.T + 0.1 * np.eye(n), 3 * draws.normal(size=n)
    low, high = -draws.uniform(0.1, 1, n), draws.uniform(0.1, 1, n)
    x, r, index = np.zeros(n), np.zeros((n, n + 7)), np.zeros(n, np.int32)
    count = mj.mju_boxQP(x, r, index, h, g, low, high)
    slope, free = g + h @ x, (x > low) & (x < high)
    assert ((x >= low) & (x <= high)).all()
    np.testing.assert_allclose(slope[free], 0, atol=1e-9)
    assert (slope[x == low] >= -1e-9).all() and (slope[x == high] <= 1e-9).all()
    assert index[:count].tolist() == np.flatnonzero(free).tolist()
    factor = r.ravel()[: count * count].reshape(count, count)
    np.testing.assert_allclose(factor @ factor.T, h[np.ix_(free, free)], atol=1e-9)
    assert mj.mju_boxQP(x, r, None, -h, g, None, None) == -1


@pytest.mark.parametrize("seed", range(10))
def test_slopes_of_quaternions_are_those_of_differences(seed):
    draws, step = np.random.default_rng(seed), 1e-6
    a, b, velocity, duration = random_quat(draws), random_quat(draws), draws.normal(size=3), draws.uniform(0.1, 1)

    def between(p, q):
        out = np.zeros(3)
        mj.mju_subQuat(out, p, q)
        return out

    first, second = np.zeros((3, 3)), np.zeros((3, 3))
    mj.mjd_subQuat(a, b, first, second)
    moves = np.eye(3) * step
    ends = [(between(turned(a, v), b) - between(turned(a, -v), b)) / (2 * step) for v in moves]
    starts = [(between(a, turned(b, v)) - between(a, turned(b, -v))) / (2 * step) for v in moves]
    np.testing.assert_allclose(first, np.transpose(ends), atol=1e-7)
    np.testing.assert_allclose(second, np.transpose(starts), atol=1e-7)

    def after(quat, speed, time):
        out = quat.copy()
        mj.mju_quatIntegrate(out, speed, time)
        return out

    end = after(a, velocity, duration)
    by_quat, by_velocity, by_time = np.zeros(9), np.zeros(9), np.zeros(3)
    mj.mjd_quatIntegrate(velocity, duration, by_quat, by_velocity, by_time)
    turns = [between(after(turned(a, v), velocity, duration), end) / step for v in moves]
    speeds = [between(after(a, velocity + v / duration, duration), end) / step for v in moves]
    np.testing.assert_allclose(by_quat.reshape(3, 3), np.transpose(turns), atol=1e-5)
    np.testing.assert_allclose(by_velocity.reshape(3, 3), np.transpose(speeds), atol=1e-5)
    np.testing.assert_allclose(by_time, between(after(a, velocity, duration + step), end) / step, atol=1e-5)


ARM = """
<mujoco>
  <worldbody><body><joint name="j" axis="0 1 0"/><geom size=".1" pos="1 0 0" mass="1"/><site name="s" pos="1 0 0"/></body></worldbody>
  <actuator><position joint="j" kp="10" {0}/></actuator>
  <sensor><jointpos joint="j"/><framelinacc objtype="site" objname="s" {1}/></sensor>
</mujoco>
"""


@pytest.fixture
def arm(request):
    model = mj.MjModel.from_xml_string(ARM.format(*getattr(request, "param", ("", ""))))
    data = mj.MjData(model)
    data.qpos[0] = 0.3
    mj.mj_forward(model, data)
    return model, data


def test_slopes_of_inverse_dynamics(arm):
    model, data = arm
    forces, sensors, inertia = np.zeros((1, 1)), np.zeros((1, 4)), np.zeros((1, model.nC))
    by_acceleration, plain = np.zeros((1, 1)), np.zeros((1, 1))
    given = data.qacc.copy()
    mj.mjd_inverseFD(model, data, 1e-6, True, forces, None, by_acceleration, sensors, None, None, inertia)
    mj.mjd_inverseFD(model, data, 1e-6, False, plain)
    # Weight m g r cos(q) of the geom against gravity; a mass at a distance turns with the same inertia everywhere.
    assert plain[0, 0] == pytest.approx(9.81 * np.sin(0.3), rel=1e-4)
    assert forces[0, 0] == pytest.approx(plain[0, 0] + 10, rel=1e-4), "the actuator holds the joint"
    assert by_acceleration[0, 0] == pytest.approx(data.M[0], rel=1e-6) and abs(inertia[0, 0]) < 1e-6
    assert sensors[0, 0] == pytest.approx(1, rel=1e-6) and data.qacc.tolist() == given.tolist()


@pytest.mark.parametrize("arm", [('delay=".01" nsample="4"', 'delay=".01" nsample="3"')], indirect=True)
def test_histories_are_read_with_their_delay(arm):
    model, data = arm
    times = np.array([0.0, 0.01, 0.02, 0.03])
    mj.mj_initCtrlHistory(model, data, 0, times, [1.0, 2.0, 3.0, 4.0])
    assert [mj.mj_readCtrl(model, data, 0, t, 0) for t in (0.0, 0.02, 0.025, 0.9)] == [1, 2, 2, 4]
    assert mj.mj_readCtrl(model, data, 0, 0.025, 1) == pytest.approx(2.5)
    rows, out = np.arange(9.0).reshape(3, 3), np.zeros(3)
    mj.mj_initSensorHistory(model, data, 1, times[:3], rows, 0.0)
    assert mj.mj_readSensor(model, data, 1, 0.02, out, 0).tolist() == out.tolist() == [3, 4, 5]
    out = np.zeros(1)
    assert mj.mj_readSensor(model, data, 0, 0.0, out, 0)[0] == pytest.approx(0.3), "no history: the present reading"
    with pytest.raises(mj.FatalError, match="strictly increasing"):
        mj.mj_initCtrlHistory(model, data, 0, times[::-1], [1.0, 2.0, 3.0, 4.0])
    with pytest.raises(mj.FatalError, match="no history"):
        mj.mj_initSensorHistory(model, data, 0, None, [[1.0]], 0.0)
    with pytest.raises(mj.FatalError, match="invalid actuator id 1"):
        mj.mj_readCtrl(model, data, 1, 0.0, 0)


def test_results_go_through_the_arrays_own_memory():
    class Guarded(np.ndarray):
        def __setitem__(self, place, value):
            raise AssertionError("written by a program's own class")

    out = np.zeros(3).view(Guarded)
    mj.mju_rotVecQuat(out, [1.0, 0.0, 0.0], [np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5)])
    np.testing.assert_allclose(np.asarray(out), [0, 1, 0], atol=1e-15)


def rosenbrock(x):
    return np.stack([1 - x[0], 10 * (x[1] - x[0] ** 2)])


def test_least_squares_end_at_the_minimum_within_bounds():
    out = io.StringIO()
    x, trace = minimize.least_squares(np.zeros(2), rosenbrock, output=out, check_derivatives=True)
    np.testing.assert_allclose(x, [1, 1], atol=1e-7)
    assert trace[-1].objective < 1e-12 and all(step.reduction >= 0 for step in trace)
    x, trace = minimize.least_squares(
        np.zeros(2), rosenbrock, bounds=[np.full(2, -2.0), np.array([0.5, 2.0])], output=out, verbose=3
    )
    np.testing.assert_allclose(x, [0.5, 0.25], atol=1e-6)
    assert trace[-1].grad[0] < -0.4 and "norm(gradient) < tol" in out.getvalue()


@pytest.mark.parametrize("bounds", [[0, 1, 2], [np.zeros(3), np.ones(3)], [np.zeros(2), np.array([1, np.inf])], [np.ones(2), np.zeros(2)]])
def test_bounds_that_do_not_fit(bounds):
    with pytest.raises(ValueError, match="bound"):
        minimize.least_squares(np.zeros(2), rosenbrock, bounds=bounds, verbose=0)
