//! `sensor`: what is measured, and the history kept of it.

use physics::model::{DataType, ObjType, SensorType, Stage};

use super::Bind::*;
use super::plugin::{CONFIG, USE_ROWS};
use super::words::INTERPOLATIONS;
use super::{Child, ElementType, Kind, Row, Rule, Space, Words, any, leaf, required, row, section};
use crate::spec::Sensor;

/// Attributes that every sensor has.
pub static BASE: [Row<Sensor>; 8] = [
    row("name", Name(Space::Sensor, |s| &mut s.name), "name"),
    row("nsample", Int(|s| &mut s.nsample), "samples of history kept"),
    row(
        "interp",
        Keyword { words: INTERPOLATIONS, assign: |s, c| s.interp = c },
        "interpolation of the history",
    ),
    row("delay", Real(|s| &mut s.delay), "delay of the reading, seconds"),
    row("interval", Reals { min: 1, field: |s| &mut s.interval }, "period and phase of measurement, seconds"),
    row("cutoff", Real(|s| &mut s.cutoff), "readings are clamped to this size; 0 for none"),
    row("noise", Real(|s| &mut s.noise), "standard deviation that a user may add"),
    row("user", RealList(|s| &mut s.userdata), "user data"),
];

/// What a sensor with one fixed kind of target measures.
pub struct Simple {
    /// The element.
    pub element: &'static ElementType,
    /// The measurement.
    pub kind: SensorType,
    /// Kind of the target.
    pub target: ObjType,
}

static SITE: [Row<Sensor>; 1] = [required("site", Ref(Space::Site, |s| &mut s.objname), "site measured")];
static JOINT: [Row<Sensor>; 1] = [required("joint", Ref(Space::Joint, |s| &mut s.objname), "joint measured")];
static TENDON: [Row<Sensor>; 1] =
    [required("tendon", Ref(Space::Tendon, |s| &mut s.objname), "tendon measured")];
static ACTUATOR: [Row<Sensor>; 1] =
    [required("actuator", Ref(Space::Actuator, |s| &mut s.objname), "actuator measured")];
static BODY: [Row<Sensor>; 1] = [required("body", Ref(Space::Body, |s| &mut s.objname), "body measured")];
static OBJECT: [Row<Sensor>; 2] = [
    required(
        "objtype",
        Keyword { words: FRAMED, assign: |s, c| s.objtype = object(c) },
        "kind of the object measured",
    ),
    required("objname", ObjRef("objtype", |s| &mut s.objname), "object measured"),
];
static REFERENCE: [Row<Sensor>; 2] = [
    row(
        "reftype",
        Keyword { words: FRAMED, assign: |s, c| s.reftype = object(c) },
        "kind of the frame of reference",
    ),
    row("refname", ObjRef("reftype", |s| &mut s.refname), "frame of reference, the world if absent"),
];
static ENCLOSING: [Row<Sensor>; 1] =
    [required("site", Ref(Space::Site, |s| &mut s.refname), "site whose volume is tested")];
static PROJECTING: [Row<Sensor>; 1] =
    [required("camera", Ref(Space::Camera, |s| &mut s.refname), "camera that projects")];
static RANGE: [Row<Sensor>; 3] = [
    row("site", Ref(Space::Site, |s| &mut s.objname), "site that the ray leaves"),
    row("camera", Ref(Space::Camera, |s| &mut s.objname), "camera whose pixels the rays leave through"),
    row("data", Own(Kind::Flags(RAY_DATA)), "what each ray reports, in this order"),
];
static TWO_SHAPES: [Row<Sensor>; 4] = [
    row("geom1", Ref(Space::Geom, |s| &mut s.objname), "first geom"),
    row("body1", Ref(Space::Body, |s| &mut s.objname), "first body"),
    row("geom2", Ref(Space::Geom, |s| &mut s.refname), "second geom"),
    row("body2", Ref(Space::Body, |s| &mut s.refname), "second body"),
];
static CONTACTS: [Row<Sensor>; 10] = [
    row("geom1", Ref(Space::Geom, |s| &mut s.objname), "first geom"),
    row("body1", Ref(Space::Body, |s| &mut s.objname), "first body"),
    row("subtree1", Ref(Space::Body, |s| &mut s.objname), "first subtree"),
    row("site", Ref(Space::Site, |s| &mut s.objname), "volume that contacts lie in"),
    row("geom2", Ref(Space::Geom, |s| &mut s.refname), "second geom"),
    row("body2", Ref(Space::Body, |s| &mut s.refname), "second body"),
    row("subtree2", Ref(Space::Body, |s| &mut s.refname), "second subtree"),
    row("num", Int(|s| &mut s.intprm[2]), "contacts reported"),
    row("data", Own(Kind::Flags(CONTACT_DATA)), "what each contact reports, in this order"),
    row(
        "reduce",
        Keyword { words: REDUCTIONS, assign: |s, c| s.intprm[1] = c },
        "which contacts are reported",
    ),
];
static TACTILE: [Row<Sensor>; 7] = [
    row("name", Name(Space::Sensor, |s| &mut s.name), "name"),
    required("geom", Ref(Space::Geom, |s| &mut s.refname), "geom that carries the points; its body feels"),
    required("mesh", Ref(Space::Mesh, |s| &mut s.objname), "mesh whose vertices are the points"),
    row("nsample", Int(|s| &mut s.nsample), "samples of history kept"),
    row(
        "interp",
        Keyword { words: INTERPOLATIONS, assign: |s, c| s.interp = c },
        "interpolation of the history",
    ),
    row("delay", Real(|s| &mut s.delay), "delay of the reading, seconds"),
    row("interval", Reals { min: 1, field: |s| &mut s.interval }, "period and phase of measurement, seconds"),
];
static USER: [Row<Sensor>; 8] = [
    row("name", Name(Space::Sensor, |s| &mut s.name), "name"),
    row("objtype", Own(Kind::Text), "kind of the object measured"),
    row("objname", ObjRef("objtype", |s| &mut s.objname), "object measured"),
    row(
        "datatype",
        Keyword {
            words: DATA_TYPES,
            assign: |s, c| s.datatype = DataType::from_code(c).unwrap_or(s.datatype),
        },
        "kind of numbers",
    ),
    row(
        "needstage",
        Keyword { words: STAGES, assign: |s, c| s.needstage = Stage::from_code(c).unwrap_or(s.needstage) },
        "stage of the computation it needs",
    ),
    required("dim", Int(|s| &mut s.dim), "number of outputs"),
    row("cutoff", Real(|s| &mut s.cutoff), "readings are clamped to this size; 0 for none"),
    row("noise", Real(|s| &mut s.noise), "standard deviation that a user may add"),
];
/// Attributes of `plugin` that every sensor has.
pub static PLUGIN_ROWS: [Row<Sensor>; 2] = [
    row("name", Name(Space::Sensor, |s| &mut s.name), "name"),
    row("cutoff", Real(|s| &mut s.cutoff), "readings are clamped to this size; 0 for none"),
];
/// What a plugin may read.
pub static PLUGIN_OBJECTS: [Row<Sensor>; 4] = [
    row("objtype", Own(Kind::Text), "kind of the object measured"),
    row("objname", ObjRef("objtype", |s| &mut s.objname), "object measured"),
    row("reftype", Own(Kind::Text), "kind of the frame of reference"),
    row("refname", ObjRef("reftype", |s| &mut s.refname), "frame of reference"),
];
/// User data.
pub static USER_DATA: [Row<Sensor>; 1] = [row("user", RealList(|s| &mut s.userdata), "user data")];

const FRAMED: Words = &[("body", 1), ("xbody", 2), ("geom", 5), ("site", 6), ("camera", 7)];
/// Data of a rangefinder in the order that they must be listed in; the code is the bit.
pub const RAY_DATA: Words =
    &[("dist", 0), ("dir", 1), ("origin", 2), ("point", 3), ("normal", 4), ("depth", 5)];
/// Data of a contact sensor in the order that they must be listed in; the code is the bit.
pub const CONTACT_DATA: Words =
    &[("found", 0), ("force", 1), ("torque", 2), ("dist", 3), ("pos", 4), ("normal", 5), ("tangent", 6)];
const REDUCTIONS: Words = &[("none", 0), ("mindist", 1), ("maxforce", 2), ("netforce", 3)];
const STAGES: Words = &[("none", 0), ("pos", 1), ("vel", 2), ("acc", 3)];
const DATA_TYPES: Words = &[("real", 0), ("positive", 1), ("axis", 2), ("quaternion", 3)];

fn object(code: i32) -> ObjType {
    ObjType::from_code(code).unwrap_or(ObjType::Unknown)
}

const TWO_SIDES: &[Rule] = &[
    Rule::Exclusive(&[&["geom1"], &["body1"]]),
    Rule::OneOf(&[&["geom1"], &["body1"]]),
    Rule::Exclusive(&[&["geom2"], &["body2"]]),
    Rule::OneOf(&[&["geom2"], &["body2"]]),
];

static T_TOUCH: ElementType = leaf("touch", "Normal contact force in a site's volume, N", &[&BASE, &SITE]);
static T_ACCELEROMETER: ElementType =
    leaf("accelerometer", "Linear acceleration at a site, site frame", &[&BASE, &SITE]);
static T_VELOCIMETER: ElementType =
    leaf("velocimeter", "Linear velocity at a site, site frame", &[&BASE, &SITE]);
static T_GYRO: ElementType = leaf("gyro", "Angular velocity at a site, site frame", &[&BASE, &SITE]);
static T_FORCE: ElementType = leaf("force", "Force between the site's body and its parent", &[&BASE, &SITE]);
static T_TORQUE: ElementType =
    leaf("torque", "Torque between the site's body and its parent", &[&BASE, &SITE]);
static T_MAGNETOMETER: ElementType = leaf("magnetometer", "Magnetic flux at a site", &[&BASE, &SITE]);
static T_JOINTPOS: ElementType = leaf("jointpos", "Position of a hinge or slide", &[&BASE, &JOINT]);
static T_JOINTVEL: ElementType = leaf("jointvel", "Velocity of a hinge or slide", &[&BASE, &JOINT]);
static T_TENDONPOS: ElementType = leaf("tendonpos", "Length of a tendon", &[&BASE, &TENDON]);
static T_TENDONVEL: ElementType = leaf("tendonvel", "Velocity of a tendon", &[&BASE, &TENDON]);
static T_ACTUATORPOS: ElementType = leaf("actuatorpos", "Length of an actuator", &[&BASE, &ACTUATOR]);
static T_ACTUATORVEL: ElementType = leaf("actuatorvel", "Velocity of an actuator", &[&BASE, &ACTUATOR]);
static T_ACTUATORFRC: ElementType = leaf("actuatorfrc", "Force of an actuator", &[&BASE, &ACTUATOR]);
static T_JOINTACTUATORFRC: ElementType =
    leaf("jointactuatorfrc", "Total actuator force at a joint", &[&BASE, &JOINT]);
static T_TENDONACTUATORFRC: ElementType =
    leaf("tendonactuatorfrc", "Total actuator force at a tendon", &[&BASE, &TENDON]);
static T_BALLQUAT: ElementType = leaf("ballquat", "Orientation of a ball joint", &[&BASE, &JOINT]);
static T_BALLANGVEL: ElementType = leaf("ballangvel", "Angular velocity of a ball joint", &[&BASE, &JOINT]);
static T_JOINTLIMITPOS: ElementType = leaf("jointlimitpos", "Distance to a joint limit", &[&BASE, &JOINT]);
static T_JOINTLIMITVEL: ElementType = leaf("jointlimitvel", "Velocity of a limited joint", &[&BASE, &JOINT]);
static T_JOINTLIMITFRC: ElementType = leaf("jointlimitfrc", "Force of a joint limit", &[&BASE, &JOINT]);
static T_TENDONLIMITPOS: ElementType =
    leaf("tendonlimitpos", "Distance to a tendon limit", &[&BASE, &TENDON]);
static T_TENDONLIMITVEL: ElementType =
    leaf("tendonlimitvel", "Velocity of a limited tendon", &[&BASE, &TENDON]);
static T_TENDONLIMITFRC: ElementType = leaf("tendonlimitfrc", "Force of a tendon limit", &[&BASE, &TENDON]);
static T_SUBTREECOM: ElementType = leaf("subtreecom", "Centre of mass of a subtree", &[&BASE, &BODY]);
static T_SUBTREELINVEL: ElementType =
    leaf("subtreelinvel", "Velocity of a subtree's centre of mass", &[&BASE, &BODY]);
static T_SUBTREEANGMOM: ElementType =
    leaf("subtreeangmom", "Angular momentum of a subtree about its centre of mass", &[&BASE, &BODY]);
static T_CAMPROJECTION: ElementType =
    leaf("camprojection", "Projection of a site onto a camera image, pixels", &[&BASE, &SITE, &PROJECTING]);
static T_FRAMEPOS: ElementType = leaf("framepos", "Position of a frame", &[&BASE, &OBJECT, &REFERENCE])
    .rules(&[Rule::Together(&["reftype", "refname"])]);
static T_FRAMEQUAT: ElementType = leaf("framequat", "Orientation of a frame", &[&BASE, &OBJECT, &REFERENCE])
    .rules(&[Rule::Together(&["reftype", "refname"])]);
static T_FRAMEXAXIS: ElementType = leaf("framexaxis", "X axis of a frame", &[&BASE, &OBJECT, &REFERENCE])
    .rules(&[Rule::Together(&["reftype", "refname"])]);
static T_FRAMEYAXIS: ElementType = leaf("frameyaxis", "Y axis of a frame", &[&BASE, &OBJECT, &REFERENCE])
    .rules(&[Rule::Together(&["reftype", "refname"])]);
static T_FRAMEZAXIS: ElementType = leaf("framezaxis", "Z axis of a frame", &[&BASE, &OBJECT, &REFERENCE])
    .rules(&[Rule::Together(&["reftype", "refname"])]);
static T_FRAMELINVEL: ElementType =
    leaf("framelinvel", "Linear velocity of a frame", &[&BASE, &OBJECT, &REFERENCE])
        .rules(&[Rule::Together(&["reftype", "refname"])]);
static T_FRAMEANGVEL: ElementType =
    leaf("frameangvel", "Angular velocity of a frame", &[&BASE, &OBJECT, &REFERENCE])
        .rules(&[Rule::Together(&["reftype", "refname"])]);
static T_FRAMELINACC: ElementType = leaf("framelinacc", "Linear acceleration of a frame", &[&BASE, &OBJECT]);
static T_FRAMEANGACC: ElementType = leaf("frameangacc", "Angular acceleration of a frame", &[&BASE, &OBJECT]);
static T_INSIDESITE: ElementType =
    leaf("insidesite", "Whether an object is in a site's volume", &[&BASE, &ENCLOSING, &OBJECT]);
static T_RANGEFINDER: ElementType =
    leaf("rangefinder", "Distance to the nearest geom along rays", &[&BASE, &RANGE])
        .rules(&[Rule::Exclusive(&[&["site"], &["camera"]]), Rule::OneOf(&[&["site"], &["camera"]])]);
static T_DISTANCE: ElementType =
    leaf("distance", "Smallest distance between shapes", &[&BASE, &TWO_SHAPES]).rules(TWO_SIDES);
static T_NORMAL: ElementType =
    leaf("normal", "Direction of the smallest distance between shapes", &[&BASE, &TWO_SHAPES])
        .rules(TWO_SIDES);
static T_FROMTO: ElementType =
    leaf("fromto", "Ends of the smallest distance between shapes", &[&BASE, &TWO_SHAPES]).rules(TWO_SIDES);
static T_CONTACT: ElementType = leaf("contact", "Contacts between matching shapes", &[&BASE, &CONTACTS])
    .rules(&[
        Rule::Exclusive(&[&["geom1"], &["body1"], &["subtree1"], &["site"]]),
        Rule::Exclusive(&[&["geom2"], &["body2"], &["subtree2"]]),
    ]);
static T_E_POTENTIAL: ElementType = leaf("e_potential", "Potential energy, J", &[&BASE]);
static T_E_KINETIC: ElementType = leaf("e_kinetic", "Kinetic energy, J", &[&BASE]);
static T_CLOCK: ElementType = leaf("clock", "Simulated time, seconds", &[&BASE]);
static T_PLUGIN: ElementType =
    leaf("plugin", "What a plugin reads", &[&PLUGIN_ROWS, &PLUGIN_OBJECTS, &USE_ROWS, &USER_DATA])
        .children(&[any(&CONFIG)])
        .rules(&[Rule::Together(&["objtype", "objname"]), Rule::Together(&["reftype", "refname"])]);
static T_TACTILE: ElementType = leaf(
    "tactile",
    "Depth, m, and speeds of sliding, m/s, at the vertices of a mesh",
    &[&TACTILE, &USER_DATA],
);
static T_USER: ElementType = leaf("user", "Numbers that a user computes", &[&USER, &USER_DATA])
    .rules(&[Rule::Together(&["objtype", "objname"])]);

/// `sensor`.
pub static SENSOR: ElementType = section("sensor", "Measurements, in the order of `sensordata`", &SENSORS);
static SENSORS: [Child; 49] = [
    any(&T_TOUCH),
    any(&T_ACCELEROMETER),
    any(&T_VELOCIMETER),
    any(&T_GYRO),
    any(&T_FORCE),
    any(&T_TORQUE),
    any(&T_MAGNETOMETER),
    any(&T_JOINTPOS),
    any(&T_JOINTVEL),
    any(&T_TENDONPOS),
    any(&T_TENDONVEL),
    any(&T_ACTUATORPOS),
    any(&T_ACTUATORVEL),
    any(&T_ACTUATORFRC),
    any(&T_JOINTACTUATORFRC),
    any(&T_TENDONACTUATORFRC),
    any(&T_BALLQUAT),
    any(&T_BALLANGVEL),
    any(&T_JOINTLIMITPOS),
    any(&T_JOINTLIMITVEL),
    any(&T_JOINTLIMITFRC),
    any(&T_TENDONLIMITPOS),
    any(&T_TENDONLIMITVEL),
    any(&T_TENDONLIMITFRC),
    any(&T_SUBTREECOM),
    any(&T_SUBTREELINVEL),
    any(&T_SUBTREEANGMOM),
    any(&T_CAMPROJECTION),
    any(&T_FRAMEPOS),
    any(&T_FRAMEQUAT),
    any(&T_FRAMEXAXIS),
    any(&T_FRAMEYAXIS),
    any(&T_FRAMEZAXIS),
    any(&T_FRAMELINVEL),
    any(&T_FRAMEANGVEL),
    any(&T_FRAMELINACC),
    any(&T_FRAMEANGACC),
    any(&T_INSIDESITE),
    any(&T_RANGEFINDER),
    any(&T_DISTANCE),
    any(&T_NORMAL),
    any(&T_FROMTO),
    any(&T_CONTACT),
    any(&T_E_POTENTIAL),
    any(&T_E_KINETIC),
    any(&T_CLOCK),
    any(&T_TACTILE),
    any(&T_USER),
    any(&T_PLUGIN),
];

/// What each element measures; the target's kind is unknown here where attributes tell it.
pub static MEASUREMENTS: [Simple; 48] = [
    Simple { element: &T_TOUCH, kind: SensorType::Touch, target: ObjType::Site },
    Simple { element: &T_ACCELEROMETER, kind: SensorType::Accelerometer, target: ObjType::Site },
    Simple { element: &T_VELOCIMETER, kind: SensorType::Velocimeter, target: ObjType::Site },
    Simple { element: &T_GYRO, kind: SensorType::Gyro, target: ObjType::Site },
    Simple { element: &T_FORCE, kind: SensorType::Force, target: ObjType::Site },
    Simple { element: &T_TORQUE, kind: SensorType::Torque, target: ObjType::Site },
    Simple { element: &T_MAGNETOMETER, kind: SensorType::Magnetometer, target: ObjType::Site },
    Simple { element: &T_JOINTPOS, kind: SensorType::Jointpos, target: ObjType::Joint },
    Simple { element: &T_JOINTVEL, kind: SensorType::Jointvel, target: ObjType::Joint },
    Simple { element: &T_TENDONPOS, kind: SensorType::Tendonpos, target: ObjType::Tendon },
    Simple { element: &T_TENDONVEL, kind: SensorType::Tendonvel, target: ObjType::Tendon },
    Simple { element: &T_ACTUATORPOS, kind: SensorType::Actuatorpos, target: ObjType::Actuator },
    Simple { element: &T_ACTUATORVEL, kind: SensorType::Actuatorvel, target: ObjType::Actuator },
    Simple { element: &T_ACTUATORFRC, kind: SensorType::Actuatorfrc, target: ObjType::Actuator },
    Simple { element: &T_JOINTACTUATORFRC, kind: SensorType::Jointactfrc, target: ObjType::Joint },
    Simple { element: &T_TENDONACTUATORFRC, kind: SensorType::Tendonactfrc, target: ObjType::Tendon },
    Simple { element: &T_BALLQUAT, kind: SensorType::Ballquat, target: ObjType::Joint },
    Simple { element: &T_BALLANGVEL, kind: SensorType::Ballangvel, target: ObjType::Joint },
    Simple { element: &T_JOINTLIMITPOS, kind: SensorType::Jointlimitpos, target: ObjType::Joint },
    Simple { element: &T_JOINTLIMITVEL, kind: SensorType::Jointlimitvel, target: ObjType::Joint },
    Simple { element: &T_JOINTLIMITFRC, kind: SensorType::Jointlimitfrc, target: ObjType::Joint },
    Simple { element: &T_TENDONLIMITPOS, kind: SensorType::Tendonlimitpos, target: ObjType::Tendon },
    Simple { element: &T_TENDONLIMITVEL, kind: SensorType::Tendonlimitvel, target: ObjType::Tendon },
    Simple { element: &T_TENDONLIMITFRC, kind: SensorType::Tendonlimitfrc, target: ObjType::Tendon },
    Simple { element: &T_SUBTREECOM, kind: SensorType::Subtreecom, target: ObjType::Body },
    Simple { element: &T_SUBTREELINVEL, kind: SensorType::Subtreelinvel, target: ObjType::Body },
    Simple { element: &T_SUBTREEANGMOM, kind: SensorType::Subtreeangmom, target: ObjType::Body },
    Simple { element: &T_CAMPROJECTION, kind: SensorType::Camprojection, target: ObjType::Site },
    Simple { element: &T_FRAMEPOS, kind: SensorType::Framepos, target: ObjType::Unknown },
    Simple { element: &T_FRAMEQUAT, kind: SensorType::Framequat, target: ObjType::Unknown },
    Simple { element: &T_FRAMEXAXIS, kind: SensorType::Framexaxis, target: ObjType::Unknown },
    Simple { element: &T_FRAMEYAXIS, kind: SensorType::Frameyaxis, target: ObjType::Unknown },
    Simple { element: &T_FRAMEZAXIS, kind: SensorType::Framezaxis, target: ObjType::Unknown },
    Simple { element: &T_FRAMELINVEL, kind: SensorType::Framelinvel, target: ObjType::Unknown },
    Simple { element: &T_FRAMEANGVEL, kind: SensorType::Frameangvel, target: ObjType::Unknown },
    Simple { element: &T_FRAMELINACC, kind: SensorType::Framelinacc, target: ObjType::Unknown },
    Simple { element: &T_FRAMEANGACC, kind: SensorType::Frameangacc, target: ObjType::Unknown },
    Simple { element: &T_INSIDESITE, kind: SensorType::Insidesite, target: ObjType::Unknown },
    Simple { element: &T_RANGEFINDER, kind: SensorType::Rangefinder, target: ObjType::Unknown },
    Simple { element: &T_DISTANCE, kind: SensorType::Geomdist, target: ObjType::Unknown },
    Simple { element: &T_NORMAL, kind: SensorType::Geomnormal, target: ObjType::Unknown },
    Simple { element: &T_FROMTO, kind: SensorType::Geomfromto, target: ObjType::Unknown },
    Simple { element: &T_CONTACT, kind: SensorType::Contact, target: ObjType::Unknown },
    Simple { element: &T_E_POTENTIAL, kind: SensorType::EPotential, target: ObjType::Unknown },
    Simple { element: &T_E_KINETIC, kind: SensorType::EKinetic, target: ObjType::Unknown },
    Simple { element: &T_CLOCK, kind: SensorType::Clock, target: ObjType::Unknown },
    Simple { element: &T_TACTILE, kind: SensorType::Tactile, target: ObjType::Mesh },
    Simple { element: &T_USER, kind: SensorType::User, target: ObjType::Unknown },
];

/// The blocks of attributes of a sensor, by what it measures on which kind of object.
pub fn blocks(kind: SensorType, target: ObjType) -> Vec<&'static [Row<Sensor>]> {
    let own: Vec<&'static [Row<Sensor>]> = match (kind, target) {
        (SensorType::Camprojection, _) => vec![&SITE, &PROJECTING],
        (SensorType::Insidesite, _) => vec![&ENCLOSING, &OBJECT],
        (SensorType::Rangefinder, _) => vec![&RANGE],
        (SensorType::Geomdist | SensorType::Geomnormal | SensorType::Geomfromto, _) => vec![&TWO_SHAPES],
        (SensorType::Contact, _) => vec![&CONTACTS],
        (SensorType::User, _) => return vec![&USER, &USER_DATA],
        (SensorType::Tactile, _) => return vec![&TACTILE, &USER_DATA],
        (_, ObjType::Site) => vec![&SITE],
        (_, ObjType::Joint) => vec![&JOINT],
        (_, ObjType::Tendon) => vec![&TENDON],
        (_, ObjType::Actuator) => vec![&ACTUATOR],
        (_, ObjType::Body) => vec![&BODY],
        (SensorType::EPotential | SensorType::EKinetic | SensorType::Clock, _) => vec![],
        _ => vec![&OBJECT, &REFERENCE],
    };
    [&BASE as &[_]].into_iter().chain(own).collect()
}
