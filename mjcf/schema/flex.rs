//! `deformable/flex`, and `flexcomp`, which makes one with its bodies.

use physics::model::FlexSelf;

use super::Bind::*;
use super::plugin::PLUGIN;
use super::{ElementType, Kind, Row, Rule, Space, Way, Words, any, leaf, local, once, required, row};
use crate::flex::Shape;
use crate::spec::{Dof, Elastic2d, EqualityOf, Flex, Flexcomp, Pin};

/// `flex`.
pub static FLEX: ElementType =
    leaf("flex", "A deformable body between existing bodies", &[&FLEX_ROWS, &LATTICE_ROWS]).children(&[
        once(&CONTACT),
        once(&EDGE),
        once(&ELASTICITY),
    ]);
/// `flexcomp`.
pub static FLEXCOMP: ElementType = leaf(
    "flexcomp",
    "A deformable body with the bodies, joints and constraints it needs",
    &[&FLEXCOMP_ROWS, &ORIGIN_ROW],
)
.children(&[once(&COMPOSED_EDGE), once(&ELASTICITY), once(&CONTACT), any(&PIN), any(&PLUGIN)])
.rules(&[Rule::Exclusive(&[&["quat"], &["axisangle"], &["xyaxes"], &["zaxis"], &["euler"]])]);
static CONTACT: ElementType = leaf("contact", "How the flex touches", &[&CONTACT_ROWS]);
static EDGE: ElementType = leaf("edge", "Springs and dampers of edges", &[&EDGE_ROWS]);
static COMPOSED_EDGE: ElementType =
    leaf("edge", "What holds edges together", &[&EDGE_ROWS, &EDGE_EQUALITY_ROWS]);
static ELASTICITY: ElementType = leaf("elasticity", "The material", &[&ELASTICITY_ROWS]);
static PIN: ElementType = leaf("pin", "Points that are fixed to the parent body", &[&PIN_ROWS]);

const DOFS: Words = &[("full", 0), ("radial", 1), ("trilinear", 2), ("quadratic", 3), ("2d", 4)];
const SHAPES: Words = &[
    ("grid", 0),
    ("box", 1),
    ("cylinder", 2),
    ("ellipsoid", 3),
    ("square", 4),
    ("disc", 5),
    ("circle", 6),
    ("mesh", 7),
    ("gmsh", 8),
    ("direct", 9),
];
const SELF_COLLISIONS: Words = &[("none", 0), ("narrow", 1), ("bvh", 2), ("sap", 3), ("auto", 4)];
const ELASTIC_2D: Words = &[("none", 0), ("bend", 1), ("stretch", 2), ("both", 3)];
const EQUALITIES: Words = &[("false", 0), ("true", 1), ("vert", 2), ("strain", 3)];

/// The shape of a flexcomp with this code.
const fn shape(code: i32) -> Shape {
    match code {
        0 => Shape::Grid,
        1 => Shape::Box,
        2 => Shape::Cylinder,
        3 => Shape::Ellipsoid,
        4 => Shape::Square,
        5 => Shape::Disc,
        6 => Shape::Circle,
        7 => Shape::Mesh,
        8 => Shape::Gmsh,
        _ => Shape::Direct,
    }
}

const fn dof(code: i32) -> Dof {
    match code {
        0 => Dof::Full,
        1 => Dof::Radial,
        2 => Dof::Trilinear,
        3 => Dof::Quadratic,
        _ => Dof::Plane,
    }
}

/// Attributes of `flex` that a default of [`Flex`] has.
pub static FLEX_ROWS: [Row<Flex>; 14] = [
    row("name", Name(Space::Flex, |f| &mut f.name), "name"),
    row("group", Int(|f| &mut f.group), "visual group"),
    row("dim", Int(|f| &mut f.dim), "1 for lines, 2 for triangles, 3 for tetrahedra"),
    row("radius", Real(|f| &mut f.radius), "radius around the elements, metres"),
    row("material", Ref(Space::Material, |f| &mut f.material), "material"),
    row("rgba", Singles(|f| &mut f.rgba), "colour and opacity"),
    row("flatskin", Bool(|f| &mut f.flatskin), "flat shading"),
    required("body", NameList(|f| &mut f.vertbody), "body of each vertex, or one for all"),
    local("vertex", RealList(|f| &mut f.vert), "vertices in the frames of their bodies, metres"),
    required("element", IntList(|f| &mut f.elem), "vertices of each element"),
    local("texcoord", SingleList(|f| &mut f.texcoord), "texture coordinates"),
    local(
        "elemtexcoord",
        IntList(|f| &mut f.elemtexcoord),
        "texture coordinates of the vertices of each element",
    ),
    local("node", NameList(|f| &mut f.nodebody), "body of each node of the lattice"),
    local("nodecoord", RealList(|f| &mut f.node), "nodes in the frames of their bodies, metres"),
];

/// Attributes of the lattice of a `flex`.
pub static LATTICE_ROWS: [Row<Flex>; 2] = [
    row("cellcount", Ints(|f| &mut f.cellcount), "cells of the lattice of nodes along each axis"),
    row(
        "dof",
        Keyword {
            words: DOFS,
            assign: |f, c| {
                f.order = match dof(c) {
                    Dof::Trilinear => 1,
                    Dof::Quadratic => 2,
                    _ => 0,
                }
            },
        },
        "interpolation between the nodes",
    ),
];

/// Attributes of `contact` in a flex.
pub static CONTACT_ROWS: [Row<Flex>; 14] = [
    row("contype", Int(|f| &mut f.contype), "contact bits"),
    row("conaffinity", Int(|f| &mut f.conaffinity), "contact bits that it meets"),
    row("condim", Int(|f| &mut f.condim), "dimensions of the contact: 1, 3, 4 or 6"),
    row("priority", Int(|f| &mut f.priority), "whose contact parameters win"),
    row("friction", Reals { min: 1, field: |f| &mut f.friction }, "sliding, torsional, rolling friction"),
    row("solmix", Real(|f| &mut f.solmix), "weight in mixing contact parameters"),
    row("solref", Reals { min: 1, field: |f| &mut f.solref }, "solver reference"),
    row("solimp", Reals { min: 1, field: |f| &mut f.solimp }, "solver impedance"),
    row("margin", Real(|f| &mut f.margin), "distance at which contacts push, metres"),
    row("gap", Real(|f| &mut f.gap), "further distance at which contacts are listed, metres"),
    row("internal", Bool(|f| &mut f.internal), "elements collide with the vertices of their neighbours"),
    row(
        "selfcollide",
        Keyword {
            words: SELF_COLLISIONS,
            assign: |f, c| f.selfcollide = FlexSelf::from_code(c).unwrap_or(f.selfcollide),
        },
        "how elements that are far apart collide",
    ),
    row("activelayers", Int(|f| &mut f.activelayers), "layers of tetrahedra below the surface that collide"),
    row("passive", Bool(|f| &mut f.passive), "contacts push with passive forces"),
];

/// Attributes of `edge` in a flex.
pub static EDGE_ROWS: [Row<Flex>; 2] = [
    row("stiffness", Real(|f| &mut f.edgestiffness), "stiffness of edges, N/m"),
    row("damping", Real(|f| &mut f.edgedamping), "damping of edges, N s/m"),
];

/// Attributes of `elasticity`.
pub static ELASTICITY_ROWS: [Row<Flex>; 5] = [
    row("young", Real(|f| &mut f.young), "Young's modulus, Pa"),
    row("poisson", Real(|f| &mut f.poisson), "Poisson's ratio"),
    row("damping", Real(|f| &mut f.damping), "damping proportional to the stiffness, seconds"),
    row("thickness", Real(|f| &mut f.thickness), "thickness of a surface, metres"),
    row(
        "elastic2d",
        Keyword {
            words: ELASTIC_2D,
            assign: |f, c| {
                use Elastic2d::*;
                f.elastic2d = [None, Bend, Stretch, Both][c as usize];
            },
        },
        "which deformations of a surface are elastic",
    ),
];

/// Attributes of `flexcomp`.
pub static FLEXCOMP_ROWS: [Row<Flexcomp>; 26] = [
    required("name", Name(Space::Flex, |f| &mut f.flex.name), "name"),
    row("type", Keyword { words: SHAPES, assign: |f, c| f.shape = shape(c) }, "what it is made of"),
    row("group", Int(|f| &mut f.flex.group), "visual group"),
    row("dim", Int(|f| &mut f.flex.dim), "1 for lines, 2 for triangles, 3 for tetrahedra"),
    row("dof", Keyword { words: DOFS, assign: |f, c| f.dof = dof(c) }, "how its points move"),
    row("count", Ints(|f| &mut f.count), "points along each axis"),
    row("cellcount", Ints(|f| &mut f.cellcount), "cells of the lattice of nodes along each axis"),
    row("spacing", Reals { min: 3, field: |f| &mut f.spacing }, "distance of points along each axis, metres"),
    row("radius", Real(|f| &mut f.flex.radius), "radius around the elements, metres"),
    row("rigid", Bool(|f| &mut f.rigid), "all points are fixed to the parent body"),
    row("mass", Real(|f| &mut f.mass), "mass of all bodies made, kg"),
    row(
        "inertiabox",
        Real(|f| &mut f.inertiabox),
        "half length of the box that gives a body its inertia, metres",
    ),
    row("scale", Reals { min: 3, field: |f| &mut f.scale }, "scale of given points along each axis"),
    row("file", Own(Kind::File), "mesh or GMSH file"),
    row("point", RealList(|f| &mut f.point), "points, metres"),
    row("element", IntList(|f| &mut f.element), "points of each element"),
    row("texcoord", SingleList(|f| &mut f.texcoord), "texture coordinates of the points"),
    row("material", Ref(Space::Material, |f| &mut f.flex.material), "material"),
    row("rgba", Singles(|f| &mut f.flex.rgba), "colour and opacity"),
    row("flatskin", Bool(|f| &mut f.flex.flatskin), "flat shading"),
    row("pos", Reals { min: 3, field: |f| &mut f.pos }, "position in the parent body, metres"),
    row("quat", Quat(|f| &mut f.quat), "orientation"),
    row("axisangle", Turn(Way::AxisAngle, |f| &mut f.alt), "orientation by axis and angle"),
    row("xyaxes", Turn(Way::XyAxes, |f| &mut f.alt), "orientation by x and y axes"),
    row("zaxis", Turn(Way::ZAxis, |f| &mut f.alt), "orientation by the z axis"),
    row("euler", Turn(Way::Euler, |f| &mut f.alt), "orientation by Euler angles"),
];

/// Where tetrahedra over a surface meet.
pub static ORIGIN_ROW: [Row<Flexcomp>; 1] = [row(
    "origin",
    Reals { min: 3, field: |f| f.origin.get_or_insert([0.0; 3]) },
    "where the tetrahedra over a surface meet, metres",
)];

/// Attributes of `edge` that a `flexcomp` alone has.
pub static EDGE_EQUALITY_ROWS: [Row<Flexcomp>; 3] = [
    row(
        "equality",
        Keyword {
            words: EQUALITIES,
            assign: |f, c| {
                use EqualityOf::*;
                f.equality = [Nothing, Edges, Vertices, Strains][c as usize];
            },
        },
        "what constraints hold",
    ),
    row("solref", Reals { min: 1, field: |f| &mut f.solref }, "solver reference of the constraints"),
    row("solimp", Reals { min: 1, field: |f| &mut f.solimp }, "solver impedance of the constraints"),
];

/// Attributes of `pin`.
pub static PIN_ROWS: [Row<Pin>; 4] = [
    row("id", IntList(|p| &mut p.id), "points"),
    row("range", IntList(|p| &mut p.range), "first and last point of each range"),
    row("grid", IntList(|p| &mut p.grid), "points by their place in the grid"),
    row("gridrange", IntList(|p| &mut p.gridrange), "first and last corner of each block of the grid"),
];
