//! Sensors: references, dimension, stage and kind of data (XML reference, `sensor`).

use crate::compile::log::{Log, title};
use crate::compile::lookup::Lookup;
use crate::compile::plugins::Plugins;
use crate::compile::values::{bounded, push_user};
use crate::spec::{Sensor, Spec};
use physics::model::{DataType, GeomType, JointType, ObjType, Rows, SensorType, Stage};
use physics::plugin::{Capability, Config, Plugin};

/// Appends all sensors; their history buffers stand behind the actuators' buffers.
pub(super) fn fill(m: &mut Rows, (spec, plugins): (&Spec, &Plugins), lookup: &Lookup, log: &mut Log) {
    for sensor in &spec.sensors {
        let what = title("sensor", &sensor.name);
        let before = log.diagnostics.list.len();
        let object = reference(sensor.objtype, &sensor.objname, sensor, lookup, &what, log);
        let base = reference(sensor.reftype, &sensor.refname, sensor, lookup, &what, log);
        if log.diagnostics.list.len() == before {
            let plugin = plugins.id(sensor.plugin.as_ref(), (Capability::Sensor, &what), log);
            let kind = usize::try_from(plugin).ok().map(|id| plugins.list[id].config());
            let result = fill_sensor(m, sensor, [object, base], kind);
            log.check(sensor.loc, &what, result);
            m.sensor_plugin.push(plugin);
        }
    }
}

fn reference(kind: ObjType, name: &str, sensor: &Sensor, lookup: &Lookup, what: &str, log: &mut Log) -> i32 {
    match kind {
        ObjType::Unknown => -1,
        _ if name.is_empty() => {
            log.error(sensor.loc, format!("{what}: the sensorised object has no name"));
            -1
        }
        _ => lookup.require(kind, name, sensor.loc, what, log).map_or(-1, |id| id as i32),
    }
}

fn fill_sensor(
    m: &mut Rows,
    sensor: &Sensor,
    [object, base]: [i32; 2],
    plugin: Option<(&dyn Plugin, Config<'_>)>,
) -> Result<(), String> {
    check_numbers(sensor)?;
    check(m, sensor, object, base)?;
    let user = sensor.kind == SensorType::User;
    let datatype = if user { sensor.datatype } else { datatype(sensor.kind) };
    let needstage = match &plugin {
        Some((kind, _)) => kind.stage(),
        None if user => sensor.needstage,
        None => needstage(sensor.kind),
    };
    let dim = match &plugin {
        Some((kind, config)) => kind.readings(config).map_err(|error| error.to_string())? as i64,
        None => dimension(m, sensor, object)?,
    };
    let dim = bounded(dim, "dim")?;
    bounded((m.nsensordata + dim) as i64, "dim of all sensors")?;
    let samples = sensor.nsample.max(0) as usize;
    let history = if samples == 0 { 0 } else { 2 + samples + samples * dim };
    bounded((m.nhistory + history) as i64, "the history of all sensors and actuators")?;
    let angular = datatype == DataType::Quaternion
        || (datatype == DataType::Axis && sensor.kind != SensorType::Geomnormal);
    if sensor.cutoff > 0.0 && angular {
        return Err("cutoff does not apply to directions".into());
    }
    m.sensor_type.push(sensor.kind.code());
    m.sensor_datatype.push(datatype.code());
    m.sensor_needstage.push(needstage.code());
    m.sensor_objtype.push(sensor.objtype.code());
    m.sensor_objid.push(object);
    m.sensor_reftype.push(sensor.reftype.code());
    m.sensor_refid.push(base);
    m.sensor_intprm.push(sensor.intprm);
    m.sensor_dim.push(dim as i32);
    m.sensor_adr.push(m.nsensordata as i32);
    m.nsensordata += dim;
    m.sensor_cutoff.push(sensor.cutoff);
    m.sensor_noise.push(sensor.noise);
    m.sensor_history.push([sensor.nsample, sensor.interp]);
    m.sensor_historyadr.push(if sensor.nsample > 0 { m.nhistory as i32 } else { -1 });
    m.nhistory += history;
    m.sensor_delay.push(sensor.delay);
    m.sensor_interval.push(sensor.interval);
    push_user(&mut m.sensor_user, &sensor.userdata, m.nuser_sensor, "nuser_sensor")
}

/// Noise, cutoff and times of a sensor.
fn check_numbers(sensor: &Sensor) -> Result<(), String> {
    if sensor.noise < 0.0 || sensor.cutoff < 0.0 || sensor.interval[0] < 0.0 {
        return Err("attributes 'noise', 'cutoff' and 'interval': set each to 0 or more".into());
    }
    let [period, phase] = sensor.interval;
    if phase > 0.0 || (period > 0.0 && phase <= -period) {
        return Err("the phase of interval must lie in (-period, 0]".into());
    }
    if sensor.delay > 0.0 && sensor.nsample <= 0 {
        return Err("attribute 'delay' reads past values: set 'nsample' to the number that is kept".into());
    }
    Ok(())
}

/// An error unless something holds.
fn ensure(holds: bool, otherwise: &str) -> Result<(), String> {
    if holds { Ok(()) } else { Err(otherwise.into()) }
}

/// Which objects a sensor may be attached to.
fn check(m: &Rows, sensor: &Sensor, object: i32, base: i32) -> Result<(), String> {
    use SensorType::*;
    let on = |kinds: &[ObjType]| {
        if kinds.contains(&sensor.objtype) {
            Ok(())
        } else {
            Err(format!("cannot be attached to {:?}", sensor.objtype))
        }
    };
    let spatial = [ObjType::Body, ObjType::Xbody, ObjType::Geom, ObjType::Site, ObjType::Camera];
    let joint = || m.jnt_type.get(object as usize).copied().and_then(JointType::from_code);
    match sensor.kind {
        Touch | Accelerometer | Velocimeter | Gyro | Force | Torque | Magnetometer => on(&[ObjType::Site]),
        Camprojection => {
            on(&[ObjType::Site])?;
            let sized = m.cam_resolution.get(base as usize).is_some_and(|r| r[0] != 0 && r[1] != 0);
            ensure(sized, "the camera needs a resolution")
        }
        Rangefinder => {
            on(&[ObjType::Site, ObjType::Camera])?;
            check_fields(sensor.intprm[0], 6)
        }
        Jointpos | Jointvel | Jointactfrc => {
            on(&[ObjType::Joint])?;
            let scalar = matches!(joint(), Some(JointType::Slide | JointType::Hinge));
            ensure(scalar, "attribute 'joint' must name a hinge or a slide")
        }
        Ballquat | Ballangvel => {
            on(&[ObjType::Joint])?;
            ensure(joint() == Some(JointType::Ball), "attribute 'joint' must name a ball joint")
        }
        Jointlimitpos | Jointlimitvel | Jointlimitfrc => {
            on(&[ObjType::Joint])?;
            let limited = m.jnt_limited.get(object as usize) == Some(&true);
            ensure(limited, "attribute 'joint' must name a joint with limits: give it a 'range'")
        }
        Tendonpos | Tendonvel | Tendonactfrc => on(&[ObjType::Tendon]),
        Tendonlimitpos | Tendonlimitvel | Tendonlimitfrc => {
            on(&[ObjType::Tendon])?;
            let limited = m.tendon_limited.get(object as usize) == Some(&true);
            ensure(limited, "attribute 'tendon' must name a tendon with limits: give it a 'range'")
        }
        Actuatorpos | Actuatorvel | Actuatorfrc => on(&[ObjType::Actuator]),
        Framepos | Framequat | Framexaxis | Frameyaxis | Framezaxis | Framelinvel | Frameangvel
        | Framelinacc | Frameangacc => {
            on(&spatial)?;
            let based = sensor.reftype == ObjType::Unknown || spatial.contains(&sensor.reftype);
            ensure(based, "the reference must have a frame")
        }
        Subtreecom | Subtreelinvel | Subtreeangmom => on(&[ObjType::Body]),
        Insidesite => {
            on(&spatial)?;
            ensure(sensor.reftype == ObjType::Site, "needs a site")
        }
        Geomdist | Geomnormal | Geomfromto => check_distance(m, sensor, object, base),
        Contact => {
            on(&[ObjType::Site, ObjType::Body, ObjType::Xbody, ObjType::Geom, ObjType::Unknown])?;
            check_fields(sensor.intprm[0], 7)?;
            if !(0..=3).contains(&sensor.intprm[1]) || sensor.intprm[2] <= 0 {
                return Err("reduce must be 0 to 3 and num positive".into());
            }
            Ok(())
        }
        EPotential | EKinetic | Clock => Ok(()),
        User => match (sensor.datatype, sensor.dim) {
            (DataType::Axis, dim) if dim != 3 => Err("an axis has dim 3".into()),
            (DataType::Quaternion, dim) if dim != 4 => Err("a quaternion has dim 4".into()),
            (_, dim) if dim < 0 => Err(format!("attribute 'dim' is {dim}: set it to 0 or more")),
            _ => Ok(()),
        },
        Plugin => ensure(sensor.plugin.is_some(), "needs a plugin"),
        Tactile => {
            on(&[ObjType::Mesh])?;
            ensure(sensor.reftype == ObjType::Geom, "needs a geom: set attribute 'geom'")?;
            check_carrier(m, base as usize)
        }
    }
}

/// The body of a tactile sensor's geom must be able to touch something.
fn check_carrier(m: &Rows, geom: usize) -> Result<(), String> {
    let body = m.geom_bodyid[geom];
    let touches =
        |g: usize| m.geom_bodyid[g] == body && (m.geom_contype[g] != 0 || m.geom_conaffinity[g] != 0);
    ensure(
        (0..m.geom_bodyid.len()).any(touches),
        "no geom of the body that attribute 'geom' leads to can collide: give the body a geom whose 'contype' or \
         'conaffinity' is not 0",
    )
}

fn check_fields(fields: i32, count: u32) -> Result<(), String> {
    if fields > 0 && fields < 1 << count { Ok(()) } else { Err(format!("invalid data fields {fields:#b}")) }
}

fn check_distance(m: &Rows, sensor: &Sensor, object: i32, base: i32) -> Result<(), String> {
    let ends = [(sensor.objtype, object), (sensor.reftype, base)];
    if ends.iter().any(|(kind, _)| !matches!(kind, ObjType::Body | ObjType::Geom)) {
        return Err(
            "distances lie between bodies or geoms: set 'body1' or 'geom1', and 'body2' or 'geom2'".into()
        );
    }
    if ends[0] == ends[1] {
        return Err("both ends are the same".into());
    }
    let field = |(kind, id): &(ObjType, i32)| {
        *kind == ObjType::Geom && m.geom_type.get(*id as usize) == Some(&GeomType::Hfield.code())
    };
    if ends.iter().any(field) { Err("height fields have no distance sensors".into()) } else { Ok(()) }
}

/// The kind of numbers of a sensor whose text does not tell it.
pub(crate) fn datatype(kind: SensorType) -> DataType {
    use SensorType::*;
    match kind {
        Touch | Insidesite => DataType::Positive,
        Framexaxis | Frameyaxis | Framezaxis | Geomnormal => DataType::Axis,
        Ballquat | Framequat => DataType::Quaternion,
        _ => DataType::Real,
    }
}

/// The stage of a sensor whose text does not tell it.
pub(crate) fn needstage(kind: SensorType) -> Stage {
    use SensorType::*;
    match kind {
        Touch | Accelerometer | Force | Torque | Actuatorfrc | Jointactfrc | Tendonactfrc | Jointlimitfrc
        | Tendonlimitfrc | Framelinacc | Frameangacc | Contact | Tactile => Stage::Acc,
        Velocimeter | Gyro | Jointvel | Tendonvel | Actuatorvel | Ballangvel | Jointlimitvel
        | Tendonlimitvel | Framelinvel | Frameangvel | Subtreelinvel | Subtreeangmom => Stage::Vel,
        _ => Stage::Pos,
    }
}

fn dimension(m: &Rows, sensor: &Sensor, object: i32) -> Result<i64, String> {
    use SensorType::*;
    let id = object as usize;
    Ok(match sensor.kind {
        Actuatorpos | Actuatorvel | Actuatorfrc => m.actuator_outnum.get(id).copied().unwrap_or(1).into(),
        Touch | Jointpos | Jointvel | Tendonpos | Tendonvel | Jointactfrc | Tendonactfrc | Jointlimitpos
        | Jointlimitvel | Jointlimitfrc | Tendonlimitpos | Tendonlimitvel | Tendonlimitfrc | Geomdist
        | Insidesite | EPotential | EKinetic | Clock => 1,
        Camprojection => 2,
        Accelerometer | Velocimeter | Gyro | Force | Torque | Magnetometer | Ballangvel | Framepos
        | Framexaxis | Frameyaxis | Framezaxis | Framelinvel | Frameangvel | Framelinacc | Frameangacc
        | Subtreecom | Subtreelinvel | Subtreeangmom | Geomnormal => 3,
        Ballquat | Framequat => 4,
        Geomfromto => 6,
        Contact => i64::from(sensor.intprm[2]) * fields_size(sensor.intprm[0], &[1, 3, 3, 1, 3, 3, 3]),
        Rangefinder => {
            let size = fields_size(sensor.intprm[0], &[1, 3, 3, 3, 3, 1]);
            match sensor.objtype {
                ObjType::Camera => {
                    let [width, height] = m.cam_resolution[id].map(|n| i64::from(n.clamp(0, 1 << 20)));
                    size * width * height
                }
                _ => size,
            }
        }
        User => sensor.dim.into(),
        // Its plugin was not found, which has been reported.
        Plugin => 0,
        Tactile => 3 * m.mesh_vertnum.get(id).copied().map_or(0, i64::from),
    })
}

/// Numbers in the data fields selected by the bits of `fields`.
fn fields_size(fields: i32, sizes: &[i64]) -> i64 {
    sizes.iter().enumerate().filter(|(bit, _)| fields >> bit & 1 == 1).map(|(_, size)| size).sum()
}
