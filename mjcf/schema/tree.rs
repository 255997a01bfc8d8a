//! `worldbody`, `body` and everything fixed to a body.

use physics::model::{GeomType, JointType, LightType, Projection, SleepPolicy, TrackMode};

use super::Bind::*;
use super::composite::COMPOSITE;
use super::flex::FLEXCOMP;
use super::plugin::PLUGIN;
use super::words::{FALSE_TRUE_AUTO, GEOM_TYPES, TRACK_MODES, limited};
use super::{
    Child, ElementType, Kind, Row, Rule, Space, Way, Words, any, leaf, local, once, required, row, section,
};
use crate::spec::{AlignFree, Body, Camera, Frame, Geom, Inertial, Joint, Light, Site};

const SLEEP: Words = &[("auto", 0), ("never", 3), ("allowed", 4), ("init", 5)];
const SIMPLE: Words = &[("false", 0), ("auto", 1)];
const JOINT_TYPES: Words = &[("free", 0), ("ball", 1), ("slide", 2), ("hinge", 3)];
const FLUID: Words = &[("none", 0), ("ellipsoid", 1)];
const PROJECTIONS: Words = &[("perspective", 0), ("orthographic", 1)];
const OUTPUTS: Words = &[("rgb", 1), ("depth", 2), ("distance", 4), ("normal", 8), ("segmentation", 16)];
const LIGHTS: Words = &[("spot", 0), ("directional", 1), ("point", 2), ("image", 3)];

/// A frame takes its orientation from one attribute.
const ONE_ORIENTATION: Rule =
    Rule::Exclusive(&[&["quat"], &["axisangle"], &["xyaxes"], &["zaxis"], &["euler"]]);

static TREE: [Child; 14] = [
    any(&BODY),
    any(&FRAME),
    any(&REPLICATE),
    once(&INERTIAL),
    any(&JOINT),
    any(&FREEJOINT),
    any(&GEOM),
    any(&SITE),
    any(&CAMERA),
    any(&LIGHT),
    any(&PLUGIN),
    any(&FLEXCOMP),
    any(&COMPOSITE),
    any(&ATTACH),
];

/// `worldbody`.
pub static WORLDBODY: ElementType = section(
    "worldbody",
    "The fixed body at the root of the tree",
    &[
        any(&BODY),
        any(&FRAME),
        any(&REPLICATE),
        any(&GEOM),
        any(&SITE),
        any(&CAMERA),
        any(&LIGHT),
        any(&PLUGIN),
        any(&FLEXCOMP),
        any(&COMPOSITE),
        any(&ATTACH),
    ],
);
/// `body`.
pub static BODY: ElementType =
    leaf("body", "A rigid body with its own frame", &[&BODY_ROWS, &BODY_POSE, &CHILDCLASS])
        .children(&TREE)
        .rules(&[ONE_ORIENTATION]);
/// `frame`.
pub static FRAME: ElementType =
    leaf("frame", "A frame that moves what it encloses", &[&FRAME_ROWS, &CHILDCLASS])
        .children(&TREE)
        .rules(&[ONE_ORIENTATION]);
/// `replicate`.
pub static REPLICATE: ElementType = leaf(
    "replicate",
    "Copies of what it encloses, each moved on from the last",
    &[&REPLICATE_ROWS, &CHILDCLASS],
)
.children(&TREE);
/// `inertial`.
pub static INERTIAL: ElementType =
    leaf("inertial", "Mass and inertia of the body", &[&INERTIAL_ROWS]).rules(&[Rule::Exclusive(&[
        &["fullinertia"],
        &["quat"],
        &["axisangle"],
        &["xyaxes"],
        &["zaxis"],
        &["euler"],
    ])]);
/// `joint`.
pub static JOINT: ElementType =
    leaf("joint", "A degree of freedom of the body in its parent", &[&CLASS, &JOINT_ROWS]);
/// `freejoint`.
pub static FREEJOINT: ElementType =
    leaf("freejoint", "A free joint without default class", &[&FREEJOINT_ROWS]);
/// `geom`.
pub static GEOM: ElementType = leaf("geom", "A shape with mass, contact and looks", &[&CLASS, &GEOM_ROWS])
    .children(&[any(&PLUGIN)])
    .rules(&[ONE_ORIENTATION]);
/// `site`.
pub static SITE: ElementType =
    leaf("site", "A named frame with a shape", &[&CLASS, &SITE_ROWS]).rules(&[ONE_ORIENTATION]);
/// `camera`.
pub static CAMERA: ElementType = leaf("camera", "A camera", &[&CLASS, &CAMERA_ROWS])
    .rules(&[ONE_ORIENTATION, Rule::Exclusive(&[&["fovy"], &["sensorsize"]])]);
/// `light`.
pub static LIGHT: ElementType = leaf("light", "A light", &[&CLASS, &LIGHT_ROWS])
    .rules(&[Rule::Exclusive(&[&["directional"], &["type"]])]);
static ATTACH: ElementType = leaf("attach", "A copy of a part of this or another model", &[&ATTACH_ROWS])
    .rules(&[Rule::Exclusive(&[&["body"], &["frame"]])]);

/// The attribute `class` of elements that have defaults.
pub static CLASS: [Row<()>; 1] = [row("class", Own(Kind::Ref(Space::Class)), "default class")];
static CHILDCLASS: [Row<()>; 1] =
    [row("childclass", Own(Kind::Ref(Space::Class)), "default class of everything inside")];

/// Attributes of `attach`.
pub static ATTACH_ROWS: [Row<Attach>; 4] = [
    row("model", Text(|a| &mut a.model), "model of the assets; this one if absent"),
    row("body", Text(|a| &mut a.body), "body to copy with all below it"),
    row("frame", Text(|a| &mut a.frame), "frame to copy with all inside it"),
    required("prefix", Text(|a| &mut a.prefix), "what is put before the names of the copy"),
];

/// What an `attach` asks for.
#[derive(Debug, Clone, Default)]
pub struct Attach {
    /// Name of the model.
    pub model: String,
    /// Name of the body in it.
    pub body: String,
    /// Name of the frame in it.
    pub frame: String,
    /// Put before every name.
    pub prefix: String,
}

/// Own attributes of `body`.
pub static BODY_ROWS: [Row<Body>; 6] = [
    row("name", Name(Space::Body, |b| &mut b.name), "name"),
    row("mocap", Bool(|b| &mut b.mocap), "moved by the user, not by the physics"),
    row("gravcomp", Real(|b| &mut b.gravcomp), "share of the weight that is compensated"),
    row(
        "sleep",
        Keyword { words: SLEEP, assign: |b, c| b.sleep = SleepPolicy::from_code(c).unwrap_or(b.sleep) },
        "whether the tree may sleep",
    ),
    row(
        "simple",
        Keyword { words: SIMPLE, assign: |b, c| b.simple = c == 1 },
        "allow the diagonal inertia shortcut",
    ),
    row("user", RealList(|b| &mut b.userdata), "user data"),
];

/// Where the body stands in its parent.
pub static BODY_POSE: [Row<Body>; 6] = [
    row("pos", Reals { min: 3, field: |b| &mut b.pos }, "position, metres"),
    row("quat", Quat(|b| &mut b.quat), "orientation"),
    row("axisangle", Turn(Way::AxisAngle, |b| &mut b.alt), "orientation by axis and angle"),
    row("xyaxes", Turn(Way::XyAxes, |b| &mut b.alt), "orientation by x and y axes"),
    row("zaxis", Turn(Way::ZAxis, |b| &mut b.alt), "orientation by z axis"),
    row("euler", Turn(Way::Euler, |b| &mut b.alt), "orientation by Euler angles"),
];

/// Attributes of `frame`.
pub static FRAME_ROWS: [Row<Frame>; 7] = [
    row("name", Name(Space::Frame, |f| &mut f.name), "name"),
    row("pos", Reals { min: 3, field: |f| &mut f.pos }, "position, metres"),
    row("quat", Quat(|f| &mut f.quat), "orientation"),
    row("axisangle", Turn(Way::AxisAngle, |f| &mut f.alt), "orientation by axis and angle"),
    row("xyaxes", Turn(Way::XyAxes, |f| &mut f.alt), "orientation by x and y axes"),
    row("zaxis", Turn(Way::ZAxis, |f| &mut f.alt), "orientation by z axis"),
    row("euler", Turn(Way::Euler, |f| &mut f.alt), "orientation by Euler angles"),
];

/// What `replicate` asks for.
#[derive(Debug, Clone, Default)]
pub struct Replicate {
    /// Number of copies.
    pub count: i32,
    /// Step from one copy to the next, metres.
    pub offset: [f64; 3],
    /// Turn from one copy to the next, Euler angles in the unit of the file.
    pub euler: [f64; 3],
    /// Between a name and its number.
    pub sep: String,
}

/// Attributes of `replicate`.
pub static REPLICATE_ROWS: [Row<Replicate>; 4] = [
    required("count", Int(|r| &mut r.count), "number of copies"),
    row("offset", Reals { min: 3, field: |r| &mut r.offset }, "step between copies, metres"),
    row("euler", Reals { min: 3, field: |r| &mut r.euler }, "turn between copies, Euler angles"),
    row("sep", Text(|r| &mut r.sep), "text between name and number"),
];

/// Attributes of `inertial`.
pub static INERTIAL_ROWS: [Row<Inertial>; 9] = [
    required("pos", Reals { min: 3, field: |i| &mut i.pos }, "centre of mass, metres"),
    required("mass", Real(|i| &mut i.mass), "mass, kg"),
    row("diaginertia", Reals { min: 3, field: |i| &mut i.inertia }, "principal moments, kg m²"),
    row("fullinertia", Six(|i| &mut i.fullinertia), "xx yy zz xy xz yz, kg m²"),
    row("quat", Quat(|i| &mut i.quat), "orientation"),
    row("axisangle", Turn(Way::AxisAngle, |i| &mut i.alt), "orientation by axis and angle"),
    row("xyaxes", Turn(Way::XyAxes, |i| &mut i.alt), "orientation by x and y axes"),
    row("zaxis", Turn(Way::ZAxis, |i| &mut i.alt), "orientation by z axis"),
    row("euler", Turn(Way::Euler, |i| &mut i.alt), "orientation by Euler angles"),
];

/// Attributes of `joint`.
pub static JOINT_ROWS: [Row<Joint>; 23] = [
    row("name", Name(Space::Joint, |j| &mut j.name), "name"),
    row(
        "type",
        Keyword { words: JOINT_TYPES, assign: |j, c| j.kind = JointType::from_code(c).unwrap_or(j.kind) },
        "kind of motion",
    ),
    row("group", Int(|j| &mut j.group), "visual group"),
    row("pos", Reals { min: 3, field: |j| &mut j.pos }, "anchor, metres"),
    row("axis", Reals { min: 3, field: |j| &mut j.axis }, "axis of hinge or slide"),
    row("springdamper", Reals { min: 2, field: |j| &mut j.springdamper }, "time constant and damping ratio"),
    row("limited", Keyword { words: FALSE_TRUE_AUTO, assign: |j, c| j.limited = limited(c) }, "has limits"),
    row(
        "actuatorfrclimited",
        Keyword { words: FALSE_TRUE_AUTO, assign: |j, c| j.actfrclimited = limited(c) },
        "total actuator force has limits",
    ),
    row("solreflimit", Reals { min: 1, field: |j| &mut j.solref_limit }, "solver reference of the limit"),
    row("solimplimit", Reals { min: 1, field: |j| &mut j.solimp_limit }, "solver impedance of the limit"),
    row(
        "solreffriction",
        Reals { min: 1, field: |j| &mut j.solref_friction },
        "solver reference of friction",
    ),
    row(
        "solimpfriction",
        Reals { min: 1, field: |j| &mut j.solimp_friction },
        "solver impedance of friction",
    ),
    row("stiffness", Reals { min: 1, field: |j| &mut j.stiffness }, "spring polynomial"),
    row("range", Reals { min: 2, field: |j| &mut j.range }, "limits, metres or angle"),
    row(
        "actuatorfrcrange",
        Reals { min: 2, field: |j| &mut j.actfrcrange },
        "limits of total actuator force",
    ),
    row("actuatorgravcomp", Bool(|j| &mut j.actgravcomp), "gravity compensation counts as actuator force"),
    row("margin", Real(|j| &mut j.margin), "distance at which the limit is detected"),
    row("ref", Real(|j| &mut j.ref_), "position in the initial configuration"),
    row("springref", Real(|j| &mut j.springref), "position without spring force"),
    row("armature", Real(|j| &mut j.armature), "inertia of the rotor, kg m² or kg"),
    row("damping", Reals { min: 1, field: |j| &mut j.damping }, "damper polynomial"),
    row("frictionloss", Real(|j| &mut j.frictionloss), "dry friction, N or N m"),
    row("user", RealList(|j| &mut j.userdata), "user data"),
];

/// Attributes of `freejoint`.
pub static FREEJOINT_ROWS: [Row<Joint>; 3] = [
    row("name", Name(Space::Joint, |j| &mut j.name), "name"),
    row("group", Int(|j| &mut j.group), "visual group"),
    row(
        "align",
        Keyword {
            words: FALSE_TRUE_AUTO,
            assign: |j, c| j.align = [AlignFree::False, AlignFree::True, AlignFree::Auto][c as usize],
        },
        "body frame is moved to the inertial frame",
    ),
];

/// Attributes of `geom`.
pub static GEOM_ROWS: [Row<Geom>; 34] = [
    row("name", Name(Space::Geom, |g| &mut g.name), "name"),
    row(
        "type",
        Keyword { words: GEOM_TYPES, assign: |g, c| g.kind = GeomType::from_code(c).unwrap_or(g.kind) },
        "shape",
    ),
    row("contype", Int(|g| &mut g.contype), "contact bits"),
    row("conaffinity", Int(|g| &mut g.conaffinity), "contact bits that it meets"),
    row("condim", Int(|g| &mut g.condim), "dimensions of the contact: 1, 3, 4 or 6"),
    row("group", Int(|g| &mut g.group), "visual group"),
    row("priority", Int(|g| &mut g.priority), "whose contact parameters win"),
    row("size", Reals { min: 1, field: |g| &mut g.size }, "radii or half lengths, metres"),
    row("material", Ref(Space::Material, |g| &mut g.material), "material"),
    row("friction", Reals { min: 1, field: |g| &mut g.friction }, "sliding, torsional, rolling friction"),
    row("mass", Real(|g| g.mass.get_or_insert(0.0)), "mass, kg; replaces density"),
    row("density", Real(|g| &mut g.density), "density, kg/m³ or kg/m² for shells"),
    row("shellinertia", Bool(|g| &mut g.shellinertia), "mass lies on the surface"),
    row("solmix", Real(|g| &mut g.solmix), "weight in mixing contact parameters"),
    row("solref", Reals { min: 1, field: |g| &mut g.solref }, "solver reference"),
    row("solimp", Reals { min: 1, field: |g| &mut g.solimp }, "solver impedance"),
    row("margin", Real(|g| &mut g.margin), "distance at which contacts push, metres"),
    row("gap", Real(|g| &mut g.gap), "further distance at which contacts are listed, metres"),
    row(
        "surfacevel",
        Reals { min: 1, field: |g| &mut g.surfacevel },
        "velocity of the surface, m/s and rad/s",
    ),
    row("adhesion", Real(|g| &mut g.adhesion), "attractive contact force, N"),
    row("fromto", Six(|g| &mut g.fromto), "ends of capsule, cylinder, ellipsoid or box, metres"),
    row("pos", Reals { min: 3, field: |g| &mut g.pos }, "position, metres"),
    row("quat", Quat(|g| &mut g.quat), "orientation"),
    row("axisangle", Turn(Way::AxisAngle, |g| &mut g.alt), "orientation by axis and angle"),
    row("xyaxes", Turn(Way::XyAxes, |g| &mut g.alt), "orientation by x and y axes"),
    row("zaxis", Turn(Way::ZAxis, |g| &mut g.alt), "orientation by z axis"),
    row("euler", Turn(Way::Euler, |g| &mut g.alt), "orientation by Euler angles"),
    row("hfield", Ref(Space::Hfield, |g| &mut g.hfieldname), "height field"),
    row("mesh", Ref(Space::Mesh, |g| &mut g.meshname), "mesh"),
    row("fitscale", Real(|g| &mut g.fitscale), "scale of a shape fitted to a mesh"),
    row("rgba", Singles(|g| &mut g.rgba), "colour and opacity"),
    row(
        "fluidshape",
        Keyword { words: FLUID, assign: |g, c| g.fluid_ellipsoid = f64::from(c) },
        "fluid model",
    ),
    row("fluidcoef", Reals { min: 1, field: |g| &mut g.fluid_coefs }, "fluid coefficients"),
    row("user", RealList(|g| &mut g.userdata), "user data"),
];

/// Attributes of `site`.
pub static SITE_ROWS: [Row<Site>; 14] = [
    row("name", Name(Space::Site, |s| &mut s.name), "name"),
    row(
        "type",
        Keyword { words: GEOM_TYPES, assign: |s, c| s.kind = GeomType::from_code(c).unwrap_or(s.kind) },
        "shape",
    ),
    row("group", Int(|s| &mut s.group), "visual group"),
    row("pos", Reals { min: 3, field: |s| &mut s.pos }, "position, metres"),
    row("quat", Quat(|s| &mut s.quat), "orientation"),
    row("axisangle", Turn(Way::AxisAngle, |s| &mut s.alt), "orientation by axis and angle"),
    row("xyaxes", Turn(Way::XyAxes, |s| &mut s.alt), "orientation by x and y axes"),
    row("zaxis", Turn(Way::ZAxis, |s| &mut s.alt), "orientation by z axis"),
    row("euler", Turn(Way::Euler, |s| &mut s.alt), "orientation by Euler angles"),
    row("material", Ref(Space::Material, |s| &mut s.material), "material"),
    row("size", Reals { min: 1, field: |s| &mut s.size }, "radii or half lengths, metres"),
    row("fromto", Six(|s| &mut s.fromto), "ends of a long shape, metres"),
    row("rgba", Singles(|s| &mut s.rgba), "colour and opacity"),
    row("user", RealList(|s| &mut s.userdata), "user data"),
];

/// Attributes of `camera`.
pub static CAMERA_ROWS: [Row<Camera>; 20] = [
    row("name", Name(Space::Camera, |c| &mut c.name), "name"),
    row(
        "projection",
        Keyword { words: PROJECTIONS, assign: |v, c| v.proj = Projection::from_code(c).unwrap_or(v.proj) },
        "kind of projection",
    ),
    row(
        "fovy",
        Real(|c| &mut c.fovy),
        "vertical field of view, degrees, or height when orthographic, metres",
    ),
    row("ipd", Real(|c| &mut c.ipd), "distance between the eyes, metres"),
    row("resolution", Ints(|c| &mut c.resolution), "width and height, pixels"),
    row("output", Flags { words: OUTPUTS, field: |c| &mut c.output }, "images that it makes"),
    row("pos", Reals { min: 3, field: |c| &mut c.pos }, "position, metres"),
    row("quat", Quat(|c| &mut c.quat), "orientation"),
    row("axisangle", Turn(Way::AxisAngle, |c| &mut c.alt), "orientation by axis and angle"),
    row("xyaxes", Turn(Way::XyAxes, |c| &mut c.alt), "orientation by x and y axes"),
    row("zaxis", Turn(Way::ZAxis, |c| &mut c.alt), "orientation by z axis"),
    row("euler", Turn(Way::Euler, |c| &mut c.alt), "orientation by Euler angles"),
    row(
        "mode",
        Keyword { words: TRACK_MODES, assign: |v, c| v.mode = TrackMode::from_code(c).unwrap_or(v.mode) },
        "what it follows",
    ),
    local("target", Ref(Space::Body, |c| &mut c.targetbody), "body that it looks at"),
    row("focal", Singles(|c| &mut c.focal_length), "focal lengths, metres"),
    row("focalpixel", Singles(|c| &mut c.focal_pixel), "focal lengths, pixels"),
    row("principal", Singles(|c| &mut c.principal_length), "principal point offset, metres"),
    row("principalpixel", Singles(|c| &mut c.principal_pixel), "principal point offset, pixels"),
    row("sensorsize", Singles(|c| &mut c.sensor_size), "sensor width and height, metres"),
    row("user", RealList(|c| &mut c.userdata), "user data"),
];

/// Attributes of `light`.
pub static LIGHT_ROWS: [Row<Light>; 20] = [
    row("name", Name(Space::Light, |l| &mut l.name), "name"),
    row(
        "directional",
        Keyword {
            words: super::BOOL,
            assign: |l, c| l.kind = if c == 1 { LightType::Directional } else { LightType::Spot },
        },
        "parallel rays; older spelling of type",
    ),
    row(
        "type",
        Keyword { words: LIGHTS, assign: |l, c| l.kind = LightType::from_code(c).unwrap_or(l.kind) },
        "kind of light",
    ),
    row("castshadow", Bool(|l| &mut l.castshadow), "casts shadows"),
    row("active", Bool(|l| &mut l.active), "is on"),
    row("pos", Reals { min: 3, field: |l| &mut l.pos }, "position, metres"),
    row("dir", Reals { min: 3, field: |l| &mut l.dir }, "direction"),
    row("bulbradius", Single(|l| &mut l.bulbradius), "radius of the bulb, metres"),
    row("intensity", Single(|l| &mut l.intensity), "intensity, candela"),
    row("range", Single(|l| &mut l.range), "reach, metres"),
    row("attenuation", Singles(|l| &mut l.attenuation), "constant, linear, quadratic attenuation"),
    row("cutoff", Single(|l| &mut l.cutoff), "half angle of the cone, degrees"),
    row("softness", Single(|l| &mut l.softness), "softness of the cone's edge"),
    row("exponent", Single(|l| &mut l.exponent), "fall-off inside the cone"),
    row("ambient", Singles(|l| &mut l.ambient), "ambient colour"),
    row("diffuse", Singles(|l| &mut l.diffuse), "diffuse colour"),
    row("specular", Singles(|l| &mut l.specular), "specular colour"),
    row(
        "mode",
        Keyword { words: TRACK_MODES, assign: |l, c| l.mode = TrackMode::from_code(c).unwrap_or(l.mode) },
        "what it follows",
    ),
    local("target", Ref(Space::Body, |l| &mut l.targetbody), "body that it shines on"),
    local("texture", Ref(Space::Texture, |l| &mut l.texture), "image of an image light"),
];
