//! `composite`: a chain of bodies along a curve.

use physics::model::GeomType;

use super::Bind::*;
use super::plugin::PLUGIN;
use super::words::{FALSE_TRUE_AUTO, GEOM_TYPES, limited};
use super::{ElementType, Kind, Row, Space, Words, any, leaf, once, required, row};
use crate::spec::{Geom, Joint, Site};

/// Types by name; all but `cable` have been dropped from the format.
pub const TYPES: Words =
    &[("particle", 0), ("grid", 1), ("cable", CABLE), ("rope", 3), ("loop", 4), ("cloth", 5)];
/// The type that there is.
pub const CABLE: i32 = 2;
const KINDS: Words = &[("main", 0)];
const JOINT_TYPES: Words = &[("free", 0), ("ball", 1), ("slide", 2), ("hinge", 3)];

/// `composite`.
pub static COMPOSITE: ElementType =
    leaf("composite", "Bodies in a chain, as a cable has them", &[&COMPOSITE_ROWS]).children(&[
        any(&JOINT),
        once(&SKIN),
        once(&GEOM),
        once(&SITE),
        any(&PLUGIN),
    ]);
static JOINT: ElementType = leaf("joint", "The joint of each body", &[&JOINT_ROWS, &JOINT_UNUSED]);
static GEOM: ElementType = leaf("geom", "The geom of each body", &[&GEOM_ROWS]);
static SITE: ElementType = leaf("site", "The sites at both ends", &[&SITE_ROWS]);
static SKIN: ElementType = leaf("skin", "The skin over boxes", &[&SKIN_ROWS]);

/// What `composite` asks for.
#[derive(Debug, Clone)]
pub struct Composite {
    /// Put before every name.
    pub prefix: String,
    /// Code of the type.
    pub kind: i32,
    /// Number of vertices along each direction.
    pub count: [i32; 3],
    /// Of the first vertex, metres.
    pub offset: [f64; 3],
    /// Vertices, three numbers each.
    pub vertex: Vec<f32>,
    /// Joint of the first body: `ball`, `free` or `none`.
    pub initial: String,
    /// Functions of the arc for x, y and z.
    pub curve: String,
    /// Length, radius and number of half turns.
    pub size: [f64; 3],
    /// Orientation of the curve.
    pub quat: [f64; 4],
}

impl Default for Composite {
    fn default() -> Self {
        Composite {
            prefix: String::new(),
            kind: CABLE,
            count: [1; 3],
            offset: [0.0; 3],
            vertex: Vec::new(),
            initial: "ball".into(),
            curve: String::new(),
            size: [1.0, 0.0, 0.0],
            quat: [1.0, 0.0, 0.0, 0.0],
        }
    }
}

/// Attributes of `composite`.
pub static COMPOSITE_ROWS: [Row<Composite>; 9] = [
    row("prefix", Text(|c| &mut c.prefix), "what is put before every name"),
    required("type", Keyword { words: TYPES, assign: |c, code| c.kind = code }, "kind of composite: cable"),
    row("count", Own(Kind::Int { min: 1, max: Some(3) }), "number of vertices"),
    row("offset", Reals { min: 3, field: |c| &mut c.offset }, "place of the first vertex, metres"),
    row("vertex", SingleList(|c| &mut c.vertex), "vertices, instead of a curve, metres"),
    row("initial", Text(|c| &mut c.initial), "joint of the first body: ball, free or none"),
    row("curve", Text(|c| &mut c.curve), "functions for x, y and z: s, cos(s), sin(s) or 0"),
    row("size", Reals { min: 1, field: |c| &mut c.size }, "length, radius, half turns"),
    row("quat", Quat(|c| &mut c.quat), "orientation of the curve"),
];

/// Attributes of the joints.
pub static JOINT_ROWS: [Row<Joint>; 11] = [
    row("group", Int(|j| &mut j.group), "visual group"),
    row("stiffness", Reals { min: 1, field: |j| &mut j.stiffness[..1] }, "spring, N m/rad"),
    row("damping", Reals { min: 1, field: |j| &mut j.damping[..1] }, "damper, N m s/rad"),
    row("armature", Real(|j| &mut j.armature), "inertia of the rotor, kg m²"),
    row("range", Reals { min: 2, field: |j| &mut j.range }, "limits of the angle"),
    row("margin", Real(|j| &mut j.margin), "distance at which the limit is detected"),
    row("solreflimit", Reals { min: 1, field: |j| &mut j.solref_limit }, "solver reference of the limit"),
    row("solimplimit", Reals { min: 1, field: |j| &mut j.solimp_limit }, "solver impedance of the limit"),
    row("frictionloss", Real(|j| &mut j.frictionloss), "dry friction, N m"),
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
];

/// Attributes of the joints that a cable makes no use of.
pub static JOINT_UNUSED: [Row<Joint>; 6] = [
    required("kind", Own(Kind::Keyword(KINDS)), "main, the only kind"),
    row("type", Own(Kind::Keyword(JOINT_TYPES)), "not used: cables have ball joints"),
    row("axis", Reals { min: 3, field: |j| &mut j.axis }, "not used: balls have none"),
    row(
        "limited",
        Keyword { words: FALSE_TRUE_AUTO, assign: |j, c| j.limited = limited(c) },
        "not used: a range limits",
    ),
    row("solreffix", Own(Kind::Real { min: 1, max: Some(2) }), "not used: a cable is fixed by constraints"),
    row("solimpfix", Own(Kind::Real { min: 1, max: Some(5) }), "not used: a cable is fixed by constraints"),
];

/// Attributes of the geoms.
pub static GEOM_ROWS: [Row<Geom>; 19] = [
    row(
        "type",
        Keyword { words: GEOM_TYPES, assign: |g, c| g.kind = GeomType::from_code(c).unwrap_or(g.kind) },
        "capsule, cylinder or box",
    ),
    row("contype", Int(|g| &mut g.contype), "contact bits"),
    row("conaffinity", Int(|g| &mut g.conaffinity), "contact bits that it meets"),
    row("condim", Int(|g| &mut g.condim), "dimensions of the contact: 1, 3, 4 or 6"),
    row("group", Int(|g| &mut g.group), "visual group"),
    row("priority", Int(|g| &mut g.priority), "whose contact parameters win"),
    row("size", Reals { min: 1, field: |g| &mut g.size }, "radius, or half lengths, metres"),
    row("material", Ref(Space::Material, |g| &mut g.material), "material"),
    row("rgba", Singles(|g| &mut g.rgba), "colour and opacity"),
    row("friction", Reals { min: 1, field: |g| &mut g.friction }, "sliding, torsional, rolling friction"),
    row("mass", Real(|g| g.mass.get_or_insert(0.0)), "mass, kg; replaces density"),
    row("density", Real(|g| &mut g.density), "density, kg/m³"),
    row("solmix", Real(|g| &mut g.solmix), "weight in mixing contact parameters"),
    row("solref", Reals { min: 1, field: |g| &mut g.solref }, "solver reference"),
    row("solimp", Reals { min: 1, field: |g| &mut g.solimp }, "solver impedance"),
    row("margin", Real(|g| &mut g.margin), "distance at which contacts push, metres"),
    row("gap", Real(|g| &mut g.gap), "further distance at which contacts are listed, metres"),
    row("surfacevel", Reals { min: 1, field: |g| &mut g.surfacevel }, "velocity of the surface"),
    row("adhesion", Real(|g| &mut g.adhesion), "attractive contact force, N"),
];

/// Attributes of the sites.
pub static SITE_ROWS: [Row<Site>; 4] = [
    row("group", Int(|s| &mut s.group), "visual group"),
    row("size", Reals { min: 1, field: |s| &mut s.size }, "radii, metres"),
    row("material", Ref(Space::Material, |s| &mut s.material), "material"),
    row("rgba", Singles(|s| &mut s.rgba), "colour and opacity"),
];

/// What the skin of a composite asks for.
#[derive(Debug, Clone)]
pub struct CompositeSkin {
    /// Texture coordinates are made.
    pub texcoord: bool,
    /// Material.
    pub material: String,
    /// Visual group.
    pub group: i32,
    /// Colour and opacity.
    pub rgba: [f32; 4],
    /// Not used: the thickness of the boxes is taken.
    pub inflate: f64,
    /// Additional vertices between the vertices of neighbouring bodies.
    pub subgrid: i32,
}

impl Default for CompositeSkin {
    fn default() -> Self {
        CompositeSkin {
            texcoord: false,
            material: String::new(),
            group: 0,
            rgba: [1.0; 4],
            inflate: 0.0,
            subgrid: 0,
        }
    }
}

/// Attributes of the skin.
pub static SKIN_ROWS: [Row<CompositeSkin>; 6] = [
    row("texcoord", Bool(|s| &mut s.texcoord), "make texture coordinates"),
    row("material", Ref(Space::Material, |s| &mut s.material), "material"),
    row("group", Int(|s| &mut s.group), "visual group"),
    row("rgba", Singles(|s| &mut s.rgba), "colour and opacity"),
    row("inflate", Real(|s| &mut s.inflate), "not used: the boxes have a thickness"),
    row("subgrid", Int(|s| &mut s.subgrid), "vertices between those of the bodies"),
];
