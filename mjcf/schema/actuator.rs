//! `actuator`: the general form, and shortcuts that set its gain, bias and dynamics.

use physics::model::{BiasType, DynType, GainType, input};

use super::Bind::*;
use super::plugin::{CONFIG, USE_ROWS};
use super::tree::CLASS;
use super::words::{FALSE_TRUE_AUTO, INTERPOLATIONS, limited};
use super::{Child, ElementType, Kind, Row, Space, Words, any, class, leaf, local, row, section};
use crate::spec::Actuator;

/// `actuator`.
pub static ACTUATOR: ElementType = section(
    "actuator",
    "Forces that controls command",
    &[
        any(&GENERAL),
        any(&MOTOR),
        any(&POSITION),
        any(&VELOCITY),
        any(&INTVELOCITY),
        any(&DAMPER),
        any(&CYLINDER),
        any(&MUSCLE),
        any(&ADHESION),
        any(&ORIENTATION),
        any(&PID),
        any(&DCMOTOR),
        any(&PLUGIN),
    ],
);

/// Actuators in a default class.
pub const DEFAULTS: [Child; 12] = [
    class(&GENERAL),
    class(&MOTOR),
    class(&POSITION),
    class(&VELOCITY),
    class(&INTVELOCITY),
    class(&DAMPER),
    class(&CYLINDER),
    class(&MUSCLE),
    class(&ADHESION),
    class(&ORIENTATION),
    class(&PID),
    class(&DCMOTOR),
];

static PLUGIN: ElementType = leaf(
    "plugin",
    "An actuator whose force a plugin makes",
    &[
        &CLASS,
        &BASE,
        &CTRL_LIMITED,
        &FORCE,
        &ACT_LIMITS,
        &DYNAMICS,
        &TRANSMISSION,
        &SITE,
        &DYNAMICS_ROWS,
        &USE_ROWS,
    ],
)
.children(&[any(&CONFIG)]);
static GENERAL: ElementType = leaf(
    "general",
    "An actuator with every parameter of its own",
    &[
        &CLASS,
        &BASE,
        &CTRL_LIMITED,
        &FORCE,
        &ACT_LIMITS,
        &DYNAMICS,
        &TRANSMISSION,
        &SITE,
        &BODY,
        &SETPOINT_RANGES,
        &DYNAMICS_ROWS,
        &GENERAL_ROWS,
        &INPUT,
    ],
);
static MOTOR: ElementType = leaf(
    "motor",
    "Force is the control",
    &[&CLASS, &BASE, &CTRL_LIMITED, &FORCE, &DYNAMICS, &TRANSMISSION, &SITE],
);
static POSITION: ElementType = leaf(
    "position",
    "A servo that holds a position",
    &[
        &CLASS,
        &BASE,
        &CTRL_LIMITED,
        &FORCE,
        &DYNAMICS,
        &TRANSMISSION,
        &SITE,
        &SERVO_GAINS,
        &INHERIT,
        &KV,
        &SERVO_FILTER,
    ],
);
static VELOCITY: ElementType = leaf(
    "velocity",
    "A servo that holds a velocity",
    &[&CLASS, &BASE, &CTRL_LIMITED, &FORCE, &DYNAMICS, &TRANSMISSION, &SITE, &KV],
);
static INTVELOCITY: ElementType = leaf(
    "intvelocity",
    "A position servo whose set point integrates the control",
    &[
        &CLASS,
        &BASE,
        &CTRL_LIMITED,
        &FORCE,
        &ACT_LIMITS,
        &DYNAMICS,
        &TRANSMISSION,
        &SITE,
        &SERVO_GAINS,
        &INHERIT,
        &KV,
    ],
);
static DAMPER: ElementType = leaf(
    "damper",
    "Damping proportional to the control",
    &[&CLASS, &BASE, &FORCE, &DYNAMICS, &TRANSMISSION, &SITE, &KV],
);
static CYLINDER: ElementType = leaf(
    "cylinder",
    "A pneumatic or hydraulic cylinder",
    &[&CLASS, &BASE, &CTRL_LIMITED, &FORCE, &DYNAMICS, &TRANSMISSION, &SITE, &CYLINDER_ROWS],
);
static MUSCLE: ElementType = leaf(
    "muscle",
    "A Hill-type muscle",
    &[&CLASS, &BASE, &CTRL_LIMITED, &FORCE, &DYNAMICS, &TRANSMISSION, &MUSCLE_ROWS],
);
static ADHESION: ElementType =
    leaf("adhesion", "Attraction at the contacts of a body", &[&CLASS, &BASE, &FORCE, &BODY, &ADHESION_ROWS]);
static ORIENTATION: ElementType = leaf(
    "orientation",
    "A servo that holds the orientation of a ball joint or a site",
    &[&CLASS, &BASE, &FORCE, &JOINT, &SITE, &SERVO_GAINS, &KV, &INPUT],
);
static PID: ElementType = leaf(
    "pid",
    "A servo with integral, velocity set point and feed-forward",
    &[
        &CLASS,
        &BASE,
        &CTRL_LIMITED,
        &FORCE,
        &SETPOINT_RANGES,
        &POSITION_RANGE,
        &DYNAMICS,
        &TRANSMISSION,
        &SITE,
        &SERVO_GAINS,
        &INHERIT,
        &KV,
        &PID_ROWS,
        &INPUT,
    ],
);
static DCMOTOR: ElementType = leaf(
    "dcmotor",
    "A DC motor by its data sheet",
    &[&CLASS, &BASE, &CTRL_LIMITED, &DYNAMICS, &TRANSMISSION, &SITE, &MOTOR_ROWS, &INPUT],
);

const DYN_TYPES: Words = &[
    ("none", 0),
    ("integrator", 1),
    ("filter", 2),
    ("filterexact", 3),
    ("muscle", 4),
    ("dcmotor", 5),
    ("pid", 6),
    ("user", 7),
];
const GAIN_TYPES: Words =
    &[("fixed", 0), ("affine", 1), ("muscle", 2), ("dcmotor", 3), ("so3", 4), ("pid", 5), ("user", 6)];
const BIAS_TYPES: Words =
    &[("none", 0), ("affine", 1), ("muscle", 2), ("dcmotor", 3), ("so3", 4), ("user", 5)];

/// Values of `input` that stand alone.
pub const ALONE: Words =
    &[("expmap", input::EXPONENTIAL_MAP), ("quat", input::QUATERNION), ("none", input::NONE)];
/// Values of `input` that combine, in the order that they must be listed in.
pub const TOGETHER: Words = &[
    ("pos", input::POSITION),
    ("vel", input::VELOCITY),
    ("ff", input::FEED_FORWARD),
    ("voltage", input::VOLTAGE),
];

/// All blocks that write an [`Actuator`], in reading order.
pub static BLOCKS: [&[Row<Actuator>]; 9] = [
    &BASE,
    &CTRL_LIMITED,
    &FORCE,
    &ACT_LIMITS,
    &DYNAMICS,
    &SETPOINT_RANGES,
    &POSITION_RANGE,
    &DYNAMICS_ROWS,
    &GENERAL_ROWS,
];

/// Attributes of every actuator.
pub static BASE: [Row<Actuator>; 7] = [
    row("name", Name(Space::Actuator, |a| &mut a.name), "name"),
    row("group", Int(|a| &mut a.group), "group, for switching off"),
    row("nsample", Int(|a| &mut a.nsample), "samples of control history kept"),
    row(
        "interp",
        Keyword { words: INTERPOLATIONS, assign: |a, c| a.interp = c },
        "interpolation of the history",
    ),
    row("delay", Real(|a| &mut a.delay), "delay of the control, seconds"),
    row("ctrlrange", Reals { min: 2, field: |a| &mut a.ctrlrange }, "limits of the control"),
    row("user", RealList(|a| &mut a.userdata), "user data"),
];
static CTRL_LIMITED: [Row<Actuator>; 1] = [row(
    "ctrllimited",
    Keyword { words: FALSE_TRUE_AUTO, assign: |a, c| a.ctrllimited = limited(c) },
    "control has limits",
)];
static FORCE: [Row<Actuator>; 2] = [
    row(
        "forcelimited",
        Keyword { words: FALSE_TRUE_AUTO, assign: |a, c| a.forcelimited = limited(c) },
        "force has limits",
    ),
    row("forcerange", Reals { min: 2, field: |a| &mut a.forcerange }, "limits of the force"),
];
static ACT_LIMITS: [Row<Actuator>; 2] = [
    row(
        "actlimited",
        Keyword { words: FALSE_TRUE_AUTO, assign: |a, c| a.actlimited = limited(c) },
        "activation has limits",
    ),
    row("actrange", Reals { min: 2, field: |a| &mut a.actrange }, "limits of the activation"),
];
static DYNAMICS: [Row<Actuator>; 5] = [
    local("lengthrange", Reals { min: 2, field: |a| &mut a.lengthrange }, "range of the length"),
    row("gear", Reals { min: 1, field: |a| &mut a.gear }, "ratio, or force and torque axes"),
    row("damping", Reals { min: 1, field: |a| &mut a.damping }, "damper polynomial"),
    row("armature", Real(|a| &mut a.armature), "inertia of the actuator"),
    row("cranklength", Real(|a| &mut a.cranklength), "length of the connecting rod, metres"),
];
static TRANSMISSION: [Row<()>; 5] = [
    local("joint", Own(Kind::Ref(Space::Joint)), "joint driven"),
    local("jointinparent", Own(Kind::Ref(Space::Joint)), "joint driven, force in the parent's frame"),
    local("tendon", Own(Kind::Ref(Space::Tendon)), "tendon driven"),
    local("slidersite", Own(Kind::Ref(Space::Site)), "site whose z axis the slider moves on"),
    local("cranksite", Own(Kind::Ref(Space::Site)), "site of the crank's pin"),
];
static SITE: [Row<()>; 2] = [
    local("site", Own(Kind::Ref(Space::Site)), "site driven"),
    local("refsite", Own(Kind::Ref(Space::Site)), "site that the motion is measured against"),
];
static BODY: [Row<()>; 1] = [local("body", Own(Kind::Ref(Space::Body)), "body whose contacts attract")];
/// Activation dynamics of `general` and `plugin`.
pub static DYNAMICS_ROWS: [Row<Actuator>; 4] = [
    row("actdim", Int(|a| &mut a.actdim), "activation variables, -1 for as many as the dynamics need"),
    row(
        "dyntype",
        Keyword { words: DYN_TYPES, assign: |a, c| a.dyntype = DynType::from_code(c).unwrap_or(a.dyntype) },
        "activation dynamics",
    ),
    row("dynprm", Reals { min: 1, field: |a| &mut a.dynprm }, "parameters of the dynamics"),
    row("actearly", Bool(|a| &mut a.actearly), "force uses the next activation"),
];
/// Gain and bias of `general`.
pub static GENERAL_ROWS: [Row<Actuator>; 4] = [
    row(
        "gaintype",
        Keyword {
            words: GAIN_TYPES,
            assign: |a, c| a.gaintype = GainType::from_code(c).unwrap_or(a.gaintype),
        },
        "gain",
    ),
    row(
        "biastype",
        Keyword {
            words: BIAS_TYPES,
            assign: |a, c| a.biastype = BiasType::from_code(c).unwrap_or(a.biastype),
        },
        "bias",
    ),
    row("gainprm", Reals { min: 1, field: |a| &mut a.gainprm }, "parameters of the gain"),
    row("biasprm", Reals { min: 1, field: |a| &mut a.biasprm }, "parameters of the bias"),
];
/// Ranges of further set points.
pub static SETPOINT_RANGES: [Row<Actuator>; 2] = [
    row("velrange", Reals { min: 2, field: |a| &mut a.velrange }, "limits of the velocity set point"),
    row("ffrange", Reals { min: 2, field: |a| &mut a.ffrange }, "limits of the feed-forward"),
];
/// The range of a pid servo.
pub static POSITION_RANGE: [Row<Actuator>; 1] =
    [row("posrange", Reals { min: 2, field: |a| &mut a.ctrlrange }, "limits of the position set point")];
static INPUT: [Row<()>; 1] = [row(
    "input",
    Own(Kind::Text),
    "what the controls are: expmap, quat, none, or some of pos, vel, ff and voltage in this order",
)];
static JOINT: [Row<()>; 1] = [local("joint", Own(Kind::Ref(Space::Joint)), "ball joint driven")];

/// Parameters of a shortcut, absent where the element is silent.
#[derive(Debug, Clone, Default)]
#[allow(missing_docs)]
pub struct Shortcut {
    pub kp: Option<f64>,
    pub kv: Option<f64>,
    pub dampratio: Option<f64>,
    pub inheritrange: Option<f64>,
    pub timeconst: Option<f64>,
    pub area: Option<f64>,
    pub diameter: Option<f64>,
    pub bias: Option<[f64; 3]>,
    pub muscle_timeconst: Option<[f64; 2]>,
    pub tausmooth: Option<f64>,
    pub range: Option<[f64; 2]>,
    /// force, scale, lmin, lmax, vmax, fpmax, fvmax.
    pub curve: [Option<f64>; 7],
    pub gain: Option<f64>,
    pub ki: Option<f64>,
    pub imax: Option<f64>,
    pub slewmax: Option<f64>,
}

/// Data sheet of a `dcmotor`.
#[derive(Debug, Clone, Default)]
#[allow(missing_docs)]
pub struct Motor {
    pub motorconst: [f64; 2],
    pub resistance: f64,
    /// Voltage, stall torque, no-load speed.
    pub nominal: [f64; 3],
    pub saturation: [f64; 3],
    pub inductance: [f64; 2],
    pub cogging: [f64; 3],
    /// kp, ki, kd, slew limit, integral limit, supply voltage.
    pub controller: [f64; 6],
    /// Resistance, capacity, time constant, temperature coefficient, reference and ambient temperature.
    pub thermal: [f64; 6],
    pub lugre: [f64; 5],
}

/// Gains of the position servos.
pub static SERVO_GAINS: [Row<Shortcut>; 2] = [
    row("kp", Real(|s| s.kp.get_or_insert(0.0)), "position gain"),
    row("dampratio", Real(|s| s.dampratio.get_or_insert(0.0)), "damping ratio, instead of kv"),
];
/// Range of the position servos.
pub static INHERIT: [Row<Shortcut>; 1] = [row(
    "inheritrange",
    Real(|s| s.inheritrange.get_or_insert(0.0)),
    "control range as a share of the target's",
)];
/// Attributes of `pid` alone.
pub static PID_ROWS: [Row<Shortcut>; 3] = [
    row("ki", Real(|s| s.ki.get_or_insert(0.0)), "integral gain"),
    row("imax", Real(|s| s.imax.get_or_insert(0.0)), "bound of the integral, 0 for none"),
    row(
        "slewmax",
        Real(|s| s.slewmax.get_or_insert(0.0)),
        "largest rate of the position set point, 0 for any",
    ),
];
/// Attributes of `dcmotor`.
pub static MOTOR_ROWS: [Row<Motor>; 9] = [
    row("motorconst", Reals { min: 1, field: |m| &mut m.motorconst }, "torque and back-EMF constants"),
    row("resistance", Real(|m| &mut m.resistance), "resistance of the winding, ohm"),
    row("nominal", Reals { min: 1, field: |m| &mut m.nominal }, "voltage, stall torque, no-load speed"),
    row(
        "saturation",
        Reals { min: 1, field: |m| &mut m.saturation },
        "most torque, current, rate of current",
    ),
    row(
        "inductance",
        Reals { min: 1, field: |m| &mut m.inductance },
        "inductance, or time constant of the current",
    ),
    row("cogging", Reals { min: 1, field: |m| &mut m.cogging }, "amplitude, periods a turn, phase"),
    row(
        "controller",
        Reals { min: 1, field: |m| &mut m.controller },
        "kp, ki, kd, slew limit, integral limit, supply voltage",
    ),
    row(
        "thermal",
        Reals { min: 1, field: |m| &mut m.thermal },
        "resistance, capacity, time constant, temperature coefficient, reference, ambient",
    ),
    row(
        "lugre",
        Reals { min: 1, field: |m| &mut m.lugre },
        "stiffness and damping of bristles, Coulomb and static friction, Stribeck velocity",
    ),
];
/// Velocity gain.
pub static KV: [Row<Shortcut>; 1] = [row("kv", Real(|s| s.kv.get_or_insert(0.0)), "velocity gain")];
/// Time constant of `position`.
pub static SERVO_FILTER: [Row<Shortcut>; 1] =
    [row("timeconst", Real(|s| s.timeconst.get_or_insert(0.0)), "time constant of the set point, seconds")];
/// Attributes of `cylinder`.
pub static CYLINDER_ROWS: [Row<Shortcut>; 4] = [
    row("timeconst", Real(|s| s.timeconst.get_or_insert(0.0)), "time constant of the pressure, seconds"),
    row("area", Real(|s| s.area.get_or_insert(0.0)), "area of the piston, m²"),
    row("diameter", Real(|s| s.diameter.get_or_insert(0.0)), "diameter of the piston, metres"),
    row(
        "bias",
        Reals { min: 3, field: |s| s.bias.get_or_insert([0.0; 3]) },
        "constant, length and velocity bias",
    ),
];
/// Attributes of `muscle`.
pub static MUSCLE_ROWS: [Row<Shortcut>; 10] = [
    row(
        "timeconst",
        Reals { min: 2, field: |s| s.muscle_timeconst.get_or_insert([0.0; 2]) },
        "time constants of activation and deactivation, seconds",
    ),
    local("tausmooth", Real(|s| s.tausmooth.get_or_insert(0.0)), "width of the change between them"),
    row(
        "range",
        Reals { min: 2, field: |s| s.range.get_or_insert([0.0; 2]) },
        "operating lengths, in optimal lengths",
    ),
    row(
        "force",
        Real(|s| s.curve[0].get_or_insert(0.0)),
        "peak force, N; negative for scale over acceleration",
    ),
    row("scale", Real(|s| s.curve[1].get_or_insert(0.0)), "peak force times acceleration at unit force"),
    row("lmin", Real(|s| s.curve[2].get_or_insert(0.0)), "shortest length with force, in optimal lengths"),
    row("lmax", Real(|s| s.curve[3].get_or_insert(0.0)), "longest length with force, in optimal lengths"),
    row("vmax", Real(|s| s.curve[4].get_or_insert(0.0)), "fastest shortening, optimal lengths per second"),
    row("fpmax", Real(|s| s.curve[5].get_or_insert(0.0)), "passive force at lmax, in peak forces"),
    row("fvmax", Real(|s| s.curve[6].get_or_insert(0.0)), "force at fastest lengthening, in peak forces"),
];
/// Attributes of `adhesion`.
pub static ADHESION_ROWS: [Row<Shortcut>; 1] =
    [row("gain", Real(|s| s.gain.get_or_insert(0.0)), "force per control, N")];

/// The parameter blocks of the shortcut with this tag.
pub fn shortcut_blocks(tag: &str) -> Vec<&'static [Row<Shortcut>]> {
    match tag {
        "position" => vec![&SERVO_GAINS, &INHERIT, &KV, &SERVO_FILTER],
        "orientation" => vec![&SERVO_GAINS, &KV],
        "pid" => vec![&SERVO_GAINS, &INHERIT, &KV, &PID_ROWS],
        "intvelocity" => vec![&SERVO_GAINS, &INHERIT, &KV],
        "velocity" | "damper" => vec![&KV],
        "cylinder" => vec![&CYLINDER_ROWS],
        "muscle" => vec![&MUSCLE_ROWS],
        "adhesion" => vec![&ADHESION_ROWS],
        _ => vec![],
    }
}
