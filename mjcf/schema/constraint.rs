//! `contact`, `equality` and `tendon`.

use physics::model::EqType;

use super::Bind::*;
use super::tree::CLASS;
use super::words::{FALSE_TRUE_AUTO, limited};
use super::{ElementType, Kind, Row, Rule, Space, any, leaf, required, row, section};
use crate::spec::{Equality, Exclude, Pair, SOLIMP, SOLREF, Tendon};

/// `contact`.
pub static CONTACT: ElementType =
    section("contact", "Pairs that collide by decree, or not at all", &[any(&PAIR), any(&EXCLUDE)]);
/// `pair`.
pub static PAIR: ElementType = leaf("pair", "Two geoms that collide", &[&CLASS, &PAIR_ROWS]);
static EXCLUDE: ElementType = leaf("exclude", "Two bodies that do not collide", &[&EXCLUDE_ROWS]);

/// Attributes of `pair`.
pub static PAIR_ROWS: [Row<Pair>; 11] = [
    row("name", Name(Space::Pair, |p| &mut p.name), "name"),
    required("geom1", Ref(Space::Geom, |p| &mut p.geomname1), "first geom"),
    required("geom2", Ref(Space::Geom, |p| &mut p.geomname2), "second geom"),
    row("condim", Int(|p| p.condim.get_or_insert(3)), "dimensions of the contact: 1, 3, 4 or 6"),
    row(
        "friction",
        Reals { min: 1, field: |p| p.friction.get_or_insert([1.0, 1.0, 0.005, 0.0001, 0.0001]) },
        "two sliding, one torsional, two rolling frictions",
    ),
    row("solref", Reals { min: 1, field: |p| p.solref.get_or_insert(SOLREF) }, "solver reference"),
    row(
        "solreffriction",
        Reals { min: 1, field: |p| p.solreffriction.get_or_insert([0.0; 2]) },
        "solver reference of friction",
    ),
    row("solimp", Reals { min: 1, field: |p| p.solimp.get_or_insert(SOLIMP) }, "solver impedance"),
    row("gap", Real(|p| p.gap.get_or_insert(0.0)), "further distance at which contacts are listed, metres"),
    row("margin", Real(|p| p.margin.get_or_insert(0.0)), "distance at which contacts push, metres"),
    row("adhesion", Real(|p| p.adhesion.get_or_insert(0.0)), "attractive contact force, N"),
];

/// Attributes of `exclude`.
pub static EXCLUDE_ROWS: [Row<Exclude>; 3] = [
    row("name", Name(Space::Exclude, |e| &mut e.name), "name"),
    required("body1", Ref(Space::Body, |e| &mut e.bodyname1), "first body"),
    required("body2", Ref(Space::Body, |e| &mut e.bodyname2), "second body"),
];

/// `equality`.
pub static EQUALITY: ElementType = section(
    "equality",
    "Constraints that hold things equal",
    &[
        any(&CONNECT),
        any(&WELD),
        any(&EQ_JOINT),
        any(&EQ_TENDON),
        any(&EQ_FLEX),
        any(&FLEXVERT),
        any(&FLEXSTRAIN),
    ],
);
static CONNECT: ElementType =
    leaf("connect", "Two bodies share a point", &[&CLASS, &EQUALITY_ROWS, &BODIES, &SITES, &ANCHOR]).rules(
        &[
            Rule::Exclusive(&[&["site1", "site2"], &["body1", "body2", "anchor"]]),
            Rule::OneOf(&[&["site1", "site2"], &["body1", "anchor"]]),
            Rule::Together(&["site1", "site2"]),
        ],
    );
static WELD: ElementType = leaf(
    "weld",
    "Two bodies keep their relative pose",
    &[&CLASS, &EQUALITY_ROWS, &BODIES, &SITES, &ANCHOR, &POSE],
)
.rules(&[
    Rule::Exclusive(&[&["site1", "site2"], &["body1", "body2", "anchor", "relpose"]]),
    Rule::OneOf(&[&["site1", "site2"], &["body1"]]),
    Rule::Together(&["site1", "site2"]),
]);
static EQ_JOINT: ElementType = leaf(
    "joint",
    "One joint follows another, or stands still",
    &[&CLASS, &EQUALITY_ROWS, &JOINTS, &POLYNOMIAL],
);
static EQ_TENDON: ElementType = leaf(
    "tendon",
    "One tendon follows another, or stands still",
    &[&CLASS, &EQUALITY_ROWS, &TENDONS, &POLYNOMIAL],
);
static EQ_FLEX: ElementType =
    leaf("flex", "The edges of a flex keep their lengths", &[&CLASS, &EQUALITY_ROWS, &FLEX]);
static FLEXVERT: ElementType =
    leaf("flexvert", "A flex keeps its shape around each vertex", &[&CLASS, &EQUALITY_ROWS, &FLEX]);
static FLEXSTRAIN: ElementType = leaf(
    "flexstrain",
    "A cell of an interpolated flex keeps its shape",
    &[&CLASS, &EQUALITY_ROWS, &FLEX, &CELL],
);
/// `equality` in a default class.
pub static DEFAULT_EQUALITY: ElementType =
    leaf("equality", "Defaults of equality constraints", &[&EQUALITY_ROWS]);

/// The equality constraints by tag.
pub const EQUALITIES: [(&str, EqType); 7] = [
    ("connect", EqType::Connect),
    ("weld", EqType::Weld),
    ("joint", EqType::Joint),
    ("tendon", EqType::Tendon),
    ("flex", EqType::Flex),
    ("flexvert", EqType::Flexvert),
    ("flexstrain", EqType::Flexstrain),
];

/// Attributes of every equality constraint.
pub static EQUALITY_ROWS: [Row<Equality>; 4] = [
    row("name", Name(Space::Equality, |e| &mut e.name), "name"),
    row("active", Bool(|e| &mut e.active), "holds from the start"),
    row("solref", Reals { min: 1, field: |e| &mut e.solref }, "solver reference"),
    row("solimp", Reals { min: 1, field: |e| &mut e.solimp }, "solver impedance"),
];
static BODIES: [Row<Equality>; 2] = [
    row("body1", Ref(Space::Body, |e| &mut e.name1), "first body"),
    row("body2", Ref(Space::Body, |e| &mut e.name2), "second body, the world if absent"),
];
static SITES: [Row<Equality>; 2] = [
    row("site1", Ref(Space::Site, |e| &mut e.name1), "first site"),
    row("site2", Ref(Space::Site, |e| &mut e.name2), "second site"),
];
static ANCHOR: [Row<Equality>; 1] = [row(
    "anchor",
    Reals { min: 3, field: |e| &mut e.data[..3] },
    "shared point in the frame of a body, metres",
)];
static POSE: [Row<Equality>; 2] = [
    row("relpose", Reals { min: 7, field: |e| &mut e.data[3..10] }, "pose of the second body in the first"),
    row("torquescale", Real(|e| &mut e.data[10]), "weight of rotation against translation, metres"),
];
static JOINTS: [Row<Equality>; 2] = [
    required("joint1", Ref(Space::Joint, |e| &mut e.name1), "joint that follows"),
    row("joint2", Ref(Space::Joint, |e| &mut e.name2), "joint that leads, if any"),
];
static TENDONS: [Row<Equality>; 2] = [
    required("tendon1", Ref(Space::Tendon, |e| &mut e.name1), "tendon that follows"),
    row("tendon2", Ref(Space::Tendon, |e| &mut e.name2), "tendon that leads, if any"),
];
static FLEX: [Row<Equality>; 1] = [required("flex", Ref(Space::Flex, |e| &mut e.name1), "flex")];
static CELL: [Row<Equality>; 1] = [row(
    "cell",
    Reals { min: 3, field: |e| &mut e.data[..3] },
    "cell by its place along each axis, or element of the surface and twice -1",
)];
static POLYNOMIAL: [Row<Equality>; 1] =
    [row("polycoef", Reals { min: 1, field: |e| &mut e.data[..5] }, "coefficients of a quartic")];

/// Blocks of attributes that one kind of equality constraint adds, as read outside default classes.
pub fn equality_blocks(kind: EqType) -> Vec<&'static [Row<Equality>]> {
    match kind {
        EqType::Connect => vec![&BODIES, &SITES, &ANCHOR],
        EqType::Weld => vec![&BODIES, &SITES, &ANCHOR, &POSE],
        EqType::Joint => vec![&JOINTS, &POLYNOMIAL],
        EqType::Flex | EqType::Flexvert => vec![&FLEX],
        EqType::Flexstrain => vec![&FLEX, &CELL],
        _ => vec![&TENDONS, &POLYNOMIAL],
    }
}

/// `tendon` at the top.
pub static TENDON: ElementType =
    section("tendon", "Lengths that depend on several joints", &[any(&SPATIAL), any(&FIXED)]);
static SPATIAL: ElementType =
    leaf("spatial", "A path through sites and around geoms", &[&CLASS, &TENDON_ROWS, &TENDON_LOOKS])
        .children(&[any(&PATH_SITE), any(&PATH_GEOM), any(&PULLEY)]);
static FIXED: ElementType =
    leaf("fixed", "A weighted sum of joint positions", &[&CLASS, &TENDON_ROWS]).children(&[any(&PATH_JOINT)]);
static PATH_SITE: ElementType = leaf("site", "The path passes a site", &[&PATH_SITE_ROWS]);
static PATH_GEOM: ElementType = leaf("geom", "The path wraps a sphere or cylinder", &[&PATH_GEOM_ROWS]);
static PULLEY: ElementType = leaf("pulley", "The path branches over a pulley", &[&PULLEY_ROWS]);
static PATH_JOINT: ElementType = leaf("joint", "A joint of the sum", &[&PATH_JOINT_ROWS]);
/// `tendon` in a default class.
pub static DEFAULT_TENDON: ElementType =
    leaf("tendon", "Defaults of tendons", &[&TENDON_ROWS, &TENDON_LOOKS]);

/// What one path element says.
#[derive(Debug, Clone, Default)]
#[allow(missing_docs)]
pub struct PathElement {
    pub target: String,
    pub sidesite: String,
    pub number: f64,
}

/// Attributes of `spatial/site`.
pub static PATH_SITE_ROWS: [Row<PathElement>; 1] =
    [required("site", Ref(Space::Site, |p| &mut p.target), "site")];
/// Attributes of `spatial/geom`.
pub static PATH_GEOM_ROWS: [Row<PathElement>; 2] = [
    required("geom", Ref(Space::Geom, |p| &mut p.target), "sphere or cylinder"),
    row("sidesite", Ref(Space::Site, |p| &mut p.sidesite), "site that tells the side, or inside"),
];
/// Attributes of `spatial/pulley`.
pub static PULLEY_ROWS: [Row<PathElement>; 1] =
    [required("divisor", Real(|p| &mut p.number), "share of the force in this branch, inverted")];
/// Attributes of `fixed/joint`.
pub static PATH_JOINT_ROWS: [Row<PathElement>; 2] = [
    required("joint", Ref(Space::Joint, |p| &mut p.target), "joint"),
    required("coef", Real(|p| &mut p.number), "weight"),
];

/// Attributes of every tendon.
pub static TENDON_ROWS: [Row<Tendon>; 17] = [
    row("name", Name(Space::Tendon, |t| &mut t.name), "name"),
    row("group", Int(|t| &mut t.group), "visual group"),
    row("limited", Keyword { words: FALSE_TRUE_AUTO, assign: |t, c| t.limited = limited(c) }, "has limits"),
    row(
        "actuatorfrclimited",
        Keyword { words: FALSE_TRUE_AUTO, assign: |t, c| t.actfrclimited = limited(c) },
        "total actuator force has limits",
    ),
    row("range", Reals { min: 2, field: |t| &mut t.range }, "limits of length, metres"),
    row(
        "actuatorfrcrange",
        Reals { min: 2, field: |t| &mut t.actfrcrange },
        "limits of total actuator force, N",
    ),
    row("solreflimit", Reals { min: 1, field: |t| &mut t.solref_limit }, "solver reference of the limit"),
    row("solimplimit", Reals { min: 1, field: |t| &mut t.solimp_limit }, "solver impedance of the limit"),
    row(
        "solreffriction",
        Reals { min: 1, field: |t| &mut t.solref_friction },
        "solver reference of friction",
    ),
    row(
        "solimpfriction",
        Reals { min: 1, field: |t| &mut t.solimp_friction },
        "solver impedance of friction",
    ),
    row("frictionloss", Real(|t| &mut t.frictionloss), "dry friction, N"),
    row("springlength", Own(Kind::Real { min: 1, max: Some(2) }), "lengths without spring force, metres"),
    row("margin", Real(|t| &mut t.margin), "distance at which the limit is detected, metres"),
    row("stiffness", Reals { min: 1, field: |t| &mut t.stiffness }, "spring polynomial"),
    row("damping", Reals { min: 1, field: |t| &mut t.damping }, "damper polynomial"),
    row("armature", Real(|t| &mut t.armature), "inertia of length changes, kg"),
    row("user", RealList(|t| &mut t.userdata), "user data"),
];

/// Looks of a spatial tendon.
pub static TENDON_LOOKS: [Row<Tendon>; 3] = [
    row("width", Real(|t| &mut t.width), "width drawn, metres"),
    row("material", Ref(Space::Material, |t| &mut t.material), "material"),
    row("rgba", Singles(|t| &mut t.rgba), "colour and opacity"),
];
