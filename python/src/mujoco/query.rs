//! Questions about the present poses: Jacobians, rays, distances, velocities of frames, forces of contacts.

use super::call::read;
use super::data::Data;
use super::error::Fault;
use super::model::Model;
use super::statistics;
use numpy::{PyArray1, PyReadonlyArray2};
use physics::actuation::muscle::{Muscle, activation_rate};
use physics::actuation::{Recorded, recall as recall_recorded};
use physics::collision::distance::{DistanceScratch, geom_distance as distance_of};
use physics::math::Vec3;
use physics::model::{Model as Compiled, ObjType};
use physics::position::frame::frame;
use physics::position::jacobian::{Jacobian, angular_momentum_matrix, axis_rate, subtree_com_jacobian};
use physics::ray::{Hit, Ray, RayFilter, multi_ray, ray, ray_geom, ray_shape};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A numpy array of numbers.
type Vector<'py> = Bound<'py, PyArray1<f64>>;

/// An id among `count`, as an index.
fn index(id: i64, count: usize, kind: &str) -> Result<usize, Fault> {
    usize::try_from(id).ok().filter(|&i| i < count).ok_or_else(|| {
        Fault::Value(format!("there is no {kind} {id}: the model has {count}, numbered from 0"))
    })
}

/// Iterations and non-zeros of each island, and every iteration: improvement, gradient, slope, and the counts.
#[pyfunction]
pub fn solver<'py>(py: Python<'py>, d: &Bound<'py, Data>) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    for (name, values) in statistics::columns(&d.get().wait(py).simulation.solver) {
        all.set_item(name, values)?;
    }
    Ok(all)
}

/// Jacobians of a point or frame, `3 * nv` each, translation and rotation. `what` says which: `point`, its `rate`,
/// `body`, `bodycom`, `geom`, `site`; the second is empty for `subtree` and `angmom`.
#[pyfunction]
pub fn jacobian<'py>(
    py: Python<'py>,
    m: &Bound<'py, Model>,
    d: &Bound<'py, Data>,
    what: &str,
    id: i64,
    point: Vec3,
) -> PyResult<(Vector<'py>, Vector<'py>)> {
    let (pos, rot) = read(py, m, d, |m, d| {
        let mut out = Jacobian::default();
        let body = |id| index(id, m.nbody, "body");
        match what {
            "point" => out.point(m, &d.com, body(id)?, point),
            "rate" => out.point_rate(m, &d.com, &d.vel, body(id)?, point),
            "body" => out.body(m, &d.kin, &d.com, body(id)?),
            "bodycom" => out.body_com(m, &d.kin, &d.com, body(id)?),
            "geom" => out.geom(m, &d.kin, &d.com, index(id, m.ngeom, "geom")?),
            "site" => out.site(m, &d.kin, &d.com, index(id, m.nsite, "site")?),
            "subtree" => subtree_com_jacobian(m, &d.kin, &d.com, body(id)?, &mut out.pos),
            "angmom" => angular_momentum_matrix(m, &d.kin, &d.com, body(id)?, &mut out.pos),
            _ => return Err(Fault::Value(format!("no Jacobian called {what:?}"))),
        }
        Ok((out.pos, out.rot))
    })?;
    Ok((PyArray1::from_vec(py, pos), PyArray1::from_vec(py, rot)))
}

/// Joint forces that a force and a torque at a point of a body amount to.
#[pyfunction]
pub fn joint_forces<'py>(
    py: Python<'py>,
    m: &Bound<'py, Model>,
    d: &Bound<'py, Data>,
    wrench: [Vec3; 2],
    point: Vec3,
    body: i64,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let forces = read(py, m, d, |m, d| {
        let (mut jacobian, mut forces) = (Jacobian::default(), vec![0.0; m.nv]);
        jacobian.point(m, &d.com, index(body, m.nbody, "body")?, point);
        jacobian.add_wrench(wrench[0], wrench[1], &mut forces);
        Ok(forces)
    })?;
    Ok(PyArray1::from_vec(py, forces))
}

/// Rates of change of the axes of all degrees of freedom, `6 * nv`, row after row of a degree.
#[pyfunction]
pub fn axis_rates<'py>(
    py: Python<'py>,
    m: &Bound<'py, Model>,
    d: &Bound<'py, Data>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let rates: Vec<f64> =
        read(py, m, d, |m, d| Ok((0..m.nv).flat_map(|dof| axis_rate(m, &d.com, &d.vel, dof)).collect()))?;
    Ok(PyArray1::from_vec(py, rates))
}

/// Which geoms rays can hit: groups or none for all, whether static ones count, a body that does not, or -1.
type Filter = (Option<[bool; 6]>, bool, i64);

fn filter((groups, with_static, exclude): Filter) -> RayFilter {
    RayFilter { groups, skip_static: !with_static, exclude_body: usize::try_from(exclude).ok() }
}

/// What a ray hits: geom and distance, -1 both for nothing, and the normal, zeros for nothing.
type Found = (i64, f64, Vec3);

fn found(hit: Option<(usize, Hit)>) -> Found {
    hit.map_or((-1, -1.0, [0.0; 3]), |(geom, hit)| (geom as i64, hit.distance, hit.normal))
}

/// The nearest geom along a ray.
#[pyfunction]
pub fn cast_ray(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    origin: Vec3,
    direction: Vec3,
    what: Filter,
) -> PyResult<Found> {
    let (line, what) = (Ray { origin, direction }, filter(what));
    read(py, m, d, |m, d| Ok(found(ray(m, &d.kin, line, what))))
}

/// The nearest geom along each of several rays from one point.
#[pyfunction]
pub fn cast_rays(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    origin: Vec3,
    directions: PyReadonlyArray2<'_, f64>,
    what: Filter,
    cutoff: f64,
) -> PyResult<Vec<Found>> {
    let rows = directions.as_array().rows().into_iter().map(|r| [r[0], r[1], r[2]]).collect::<Vec<_>>();
    let what = filter(what);
    read(py, m, d, |m, d| {
        Ok(multi_ray(m, &d.kin, origin, &rows, what, cutoff).into_iter().map(found).collect())
    })
}

/// Where a ray hits one geom: distance, -1 for nothing, and normal.
#[pyfunction]
pub fn cast_at_geom(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    geom: i64,
    origin: Vec3,
    direction: Vec3,
) -> PyResult<(f64, Vec3)> {
    read(py, m, d, |m, d| {
        let hit = ray_geom(m, &d.kin, index(geom, m.ngeom, "geom")?, Ray { origin, direction });
        Ok(hit.map_or((-1.0, [0.0; 3]), |hit| (hit.distance, hit.normal)))
    })
}

/// Where a ray hits a shape that belongs to no model: distance, -1 for nothing, and normal.
#[pyfunction]
pub fn cast_at_shape(
    shape: (i32, Vec3),
    pose: (Vec3, [f64; 9]),
    origin: Vec3,
    direction: Vec3,
) -> PyResult<(f64, Vec3)> {
    let kind = physics::model::GeomType::from_code(shape.0)
        .ok_or_else(|| PyErr::from(Fault::Value(format!("{} is no type of geom", shape.0))))?;
    let hit = ray_shape(kind, shape.1, pose.0, &pose.1, Ray { origin, direction });
    Ok(hit.map_or((-1.0, [0.0; 3]), |hit| (hit.distance, hit.normal)))
}

/// Distance of two geoms, at most `limit`, and their nearest points.
#[pyfunction]
pub fn geom_distance(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    geoms: [i64; 2],
    limit: f64,
) -> PyResult<(f64, [Vec3; 2])> {
    read(py, m, d, |m, d| {
        let [a, b] = [index(geoms[0], m.ngeom, "geom")?, index(geoms[1], m.ngeom, "geom")?];
        Ok(distance_of(m, &d.kin, a, b, limit, &mut DistanceScratch::default()))
    })
}

/// Velocity or acceleration of an object, rotation first, in the orientation of the world or of the object.
#[pyfunction]
pub fn object_motion(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    object: (i32, i64),
    acceleration: bool,
    local: bool,
) -> PyResult<[f64; 6]> {
    read(py, m, d, |m, d| {
        let kind = ObjType::from_code(object.0).unwrap_or(ObjType::Unknown);
        let id = index(object.1, objects(m, kind), "such object")?;
        let frame = frame(m, &d.kin, kind, id)
            .ok_or_else(|| Fault::Value(format!("objects of type {} have no frame", object.0)))?;
        Ok(match (acceleration, local) {
            (false, false) => frame.velocity(m, &d.com, &d.vel.cvel),
            (false, true) => frame.local(&frame.velocity(m, &d.com, &d.vel.cvel)),
            (true, false) => frame.acceleration(m, &d.com, &d.vel.cvel, &d.sensor.cacc),
            (true, true) => frame.local_acceleration(m, &d.com, &d.vel.cvel, &d.sensor.cacc),
        })
    })
}

/// Number of objects of a kind that has frames.
fn objects(m: &Compiled, kind: ObjType) -> usize {
    match kind {
        ObjType::Body | ObjType::Xbody => m.nbody,
        ObjType::Geom => m.ngeom,
        ObjType::Site => m.nsite,
        ObjType::Camera => m.ncam,
        _ => 0,
    }
}

/// Force and torque of a contact in its own frame.
#[pyfunction]
pub fn contact_force(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    id: i64,
) -> PyResult<[f64; 6]> {
    read(py, m, d, |m, d| {
        let contact = &d.con.contact[index(id, d.con.contact.len(), "contact")?];
        let rows = usize::try_from(contact.efc_address).map_or(0, |first| first + contact.dim as usize);
        if rows > d.efc.efc_force.len() {
            // No force has been computed yet.
            return Ok([0.0; 6]);
        }
        Ok(physics::acceleration::contact_force::contact_force(m, &d.efc, contact))
    })
}

/// What was recorded of the control of actuator `id`, or of the readings of sensor `id`, as it arrives at `time` [s]; the
/// interpolation is the model's where `interp` is negative. None where the element keeps no history.
#[pyfunction]
pub fn recall(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    of: (bool, i64),
    time: f64,
    interp: i32,
) -> PyResult<Option<Vec<f64>>> {
    let (is_sensor, id) = of;
    read(py, m, d, |m, d| {
        let element = if is_sensor {
            Recorded::Sensor(index(id, m.nsensor, "sensor")?)
        } else {
            Recorded::Actuator(index(id, m.nactuator, "actuator")?)
        };
        Ok(recall_recorded(m, &d.state.history, element, time, (interp >= 0).then_some(interp)))
    })
}

/// Gain \[N\] and bias \[N\] of a muscle of these parameters at a length and a velocity.
#[pyfunction]
pub fn muscle_forces(
    length: f64,
    velocity: f64,
    lengthrange: [f64; 2],
    acc0: f64,
    parameters: [f64; 9],
) -> (f64, f64) {
    let mut prm = [0.0; 10];
    prm[..9].copy_from_slice(&parameters);
    let muscle = Muscle { lengthrange, acc0, prm: &prm };
    (muscle.gain(length, velocity), muscle.bias(length))
}

/// Rate of a muscle's activation \[1/s\].
#[pyfunction]
pub fn muscle_rate(ctrl: f64, act: f64, parameters: [f64; 3]) -> f64 {
    let mut prm = [0.0; 10];
    prm[..3].copy_from_slice(&parameters);
    activation_rate(ctrl, act, &prm)
}
