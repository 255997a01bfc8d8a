//! Sensors (documentation: XML reference, `sensor`). Each is read in the stage whose results it needs: positions,
//! velocities, or accelerations and forces.

mod acceleration;
mod contact;
mod distance;
mod objects;
pub mod pinhole;
mod position;
mod rangefinder;
mod scratch;
mod tactile;
mod velocity;
mod zone;

pub use crate::stages::{AccelerationInputs, PositionInputs, VelocityInputs};
pub use scratch::SensorScratch;

use acceleration::BodyForces;

use crate::actuation::history;
use crate::model::{
    Capability, DataType, Disable, Model, NotSimulated, ObjType, SensorInputs, SensorType, Stage,
};
use crate::on_demand::momentum::subtree_momentum;
use crate::sleep::{Awake, object};
use crate::stages::{Sensors, State};

/// What delayed sensors read from, and what tells which sensors sleep.
#[derive(Clone, Copy, Debug)]
pub struct Past<'a> {
    /// The present state, with its buffers, and with what sleeps.
    pub state: &'a State,
}

/// Checks once that every sensor of the model can be read. A `user` sensor reads zero.
///
/// # Errors
/// The first sensor that cannot.
pub fn check(m: &Model) -> Result<(), NotSimulated> {
    for sensor in 0..m.nsensor {
        if SensorType::from_code(m.sensor_type[sensor]).is_none() {
            return Err(NotSimulated::of(m.label_of(ObjType::Sensor, sensor), "this type of sensor"));
        }
    }
    Ok(())
}

/// True when some sensor of a `wanted` type exists and sensors are on.
fn any_of(m: &Model, wanted: impl Fn(SensorType) -> bool) -> bool {
    !m.opt.disableflags.contains(Disable::SENSOR)
        && m.sensor_type.iter().any(|&code| SensorType::from_code(code).is_some_and(&wanted))
}

/// True when some sensor reads body accelerations or the forces between bodies.
pub fn needs_body_forces(m: &Model) -> bool {
    use SensorType::{Accelerometer, Force, Frameangacc, Framelinacc, Torque};
    any_of(m, |kind| matches!(kind, Accelerometer | Force | Torque | Framelinacc | Frameangacc))
        || plugins_read(m, Stage::Acc)
}

/// True when some plugin reads sensors at `stage` and sensors are on.
fn plugins_read(m: &Model, stage: Stage) -> bool {
    m.nplugin > 0
        && !m.opt.disableflags.contains(Disable::SENSOR)
        && m.plugins().with(Capability::Sensor).any(|(_, running)| running.kind.stage() == stage)
}

/// Reads sensor `i` of a plugin.
fn read_plugin(m: &Model, i: usize, inputs: &SensorInputs, out: &mut [f64]) {
    if let Some(running) = m.plugins().get(m.sensor_plugin[i]) {
        running.instance.read(m, inputs, i, out);
    }
}

/// Reads the sensors of the position stage.
pub fn position_sensors(
    m: &Model,
    inputs: &PositionInputs,
    past: Past,
    scratch: &mut SensorScratch,
    out: &mut Sensors,
) {
    let mut fresh = std::mem::take(&mut scratch.fresh);
    each(m, Stage::Pos, past, &mut fresh, &mut out.sensordata, |i, kind, data| match kind {
        SensorType::Plugin => read_plugin(m, i, &SensorInputs::Position(inputs), data),
        _ => position::read(m, inputs, i, kind, scratch, data),
    });
    scratch.fresh = fresh;
}

/// Computes momenta of subtrees if sensors need them, then reads the sensors of the velocity stage.
pub fn velocity_sensors(
    m: &Model,
    inputs: &VelocityInputs,
    past: Past,
    scratch: &mut SensorScratch,
    out: &mut Sensors,
) {
    if any_of(m, |kind| matches!(kind, SensorType::Subtreelinvel | SensorType::Subtreeangmom))
        || plugins_read(m, Stage::Vel)
    {
        subtree_momentum(m, inputs.state, inputs.kin, inputs.com, inputs.vel, out);
    }
    let Sensors { sensordata, subtree_linvel, subtree_angmom, .. } = out;
    each(m, Stage::Vel, past, &mut scratch.fresh, sensordata, |i, kind, data| match kind {
        SensorType::Plugin => read_plugin(m, i, &SensorInputs::Velocity(inputs), data),
        _ => velocity::read(m, inputs, [subtree_linvel, subtree_angmom], i, kind, data),
    });
}

/// Reads the sensors of the acceleration stage; body accelerations and forces must be up to date in `out` if
/// [`needs_body_forces`].
pub fn acceleration_sensors(
    m: &Model,
    inputs: &AccelerationInputs,
    past: Past,
    scratch: &mut SensorScratch,
    out: &mut Sensors,
) {
    let Sensors { sensordata, cacc, cfrc_int, .. } = out;
    let bodies = BodyForces { cacc, cfrc_int };
    let mut fresh = std::mem::take(&mut scratch.fresh);
    each(m, Stage::Acc, past, &mut fresh, sensordata, |i, kind, data| match kind {
        SensorType::Plugin => read_plugin(m, i, &SensorInputs::Acceleration(inputs), data),
        _ => acceleration::read(m, inputs, &bodies, i, kind, scratch, data),
    });
    scratch.fresh = fresh;
}

/// Calls `read` on every sensor of a stage, applies its cut-off, and delays what it shows.
fn each(
    m: &Model,
    stage: Stage,
    past: Past,
    fresh: &mut Vec<f64>,
    sensordata: &mut [f64],
    mut read: impl FnMut(usize, SensorType, &mut [f64]),
) {
    if m.opt.disableflags.contains(Disable::SENSOR) {
        return;
    }
    if m.nhistory > 0 {
        fresh.resize(m.nsensordata, 0.0);
    }
    let wanted = m.sensor_needstage.iter().enumerate().filter(|&(_, &needed)| needed == stage.code());
    let awake = Awake::of(m, past.state);
    for (i, _) in wanted.filter(|(i, _)| !awake.skips(|state| object::sensor(m, state, *i))) {
        let Some(kind) = SensorType::from_code(m.sensor_type[i]) else { continue };
        let first = m.sensor_adr[i] as usize;
        let data = &mut sensordata[first..first + m.sensor_dim[i] as usize];
        data.fill(0.0);
        read(i, kind, data);
        cut_off(m, i, kind, data);
        if m.nhistory > 0 {
            fresh[first..first + data.len()].copy_from_slice(data);
            history::show(m, &past.state.history, past.state.time, i, data);
        }
    }
}

/// Limits a reading to the cut-off: real values on both sides, positive ones above.
fn cut_off(m: &Model, i: usize, kind: SensorType, data: &mut [f64]) {
    let cutoff = m.sensor_cutoff[i];
    if cutoff <= 0.0 || cutoff.is_nan() || matches!(kind, SensorType::Contact | SensorType::Geomfromto) {
        return;
    }
    match DataType::from_code(m.sensor_datatype[i]) {
        Some(DataType::Real) => data.iter_mut().for_each(|x| *x = x.clamp(-cutoff, cutoff)),
        Some(DataType::Positive) => data.iter_mut().for_each(|x| *x = x.min(cutoff)),
        Some(DataType::Axis | DataType::Quaternion) | None => {}
    }
}
