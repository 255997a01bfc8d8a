//! What a `flexcomp` says, before it becomes a flex with bodies (XML reference: `body/flexcomp`).

use super::element::{SOLIMP, SOLREF};
use super::flex::Flex;
use super::orientation::Orientation;
use super::plugin::PluginUse;
use crate::diagnostic::Loc;
use crate::flex::Shape;

/// How the points of a flexcomp move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub(crate) enum Dof {
    /// Each along three axes.
    #[default]
    Full,
    /// Each along the line from the parent body.
    Radial,
    /// With the corners of cells.
    Trilinear,
    /// With the corners, edges, faces and middles of cells.
    Quadratic,
    /// Each along two axes.
    Plane,
}

impl Dof {
    /// Nodes of a cell along an axis less one; 0 where points move themselves.
    pub fn order(self) -> i32 {
        match self {
            Dof::Trilinear => 1,
            Dof::Quadratic => 2,
            _ => 0,
        }
    }
}

/// What equality constraints hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub(crate) enum EqualityOf {
    #[default]
    Nothing,
    Edges,
    Vertices,
    Strains,
}

/// Points that are fixed to the parent body.
#[derive(Clone, Debug, PartialEq, Default)]
pub(crate) struct Pin {
    pub loc: Loc,
    pub id: Vec<i32>,
    pub range: Vec<i32>,
    pub grid: Vec<i32>,
    pub gridrange: Vec<i32>,
}

/// What a `flexcomp` says.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Flexcomp {
    /// The flex as far as it is said.
    pub flex: Flex,
    pub shape: Shape,
    pub dof: Dof,
    pub count: [i32; 3],
    /// Cells of the lattice along each axis, -1 where nothing is said.
    pub cellcount: [i32; 3],
    pub spacing: [f64; 3],
    pub scale: [f64; 3],
    /// Where tetrahedra over a surface meet.
    pub origin: Option<[f64; 3]>,
    pub mass: f64,
    pub inertiabox: f64,
    pub equality: EqualityOf,
    pub solref: [f64; 2],
    pub solimp: [f64; 5],
    pub rigid: bool,
    pub point: Vec<f64>,
    pub element: Vec<i32>,
    pub texcoord: Vec<f32>,
    pub pos: [f64; 3],
    pub quat: [f64; 4],
    pub alt: Option<Orientation>,
    pub pins: Vec<Pin>,
    /// What acts on the bodies of its points.
    pub plugin: Option<PluginUse>,
}

impl Default for Flexcomp {
    fn default() -> Self {
        Flexcomp {
            flex: Flex::default(),
            shape: Shape::Grid,
            dof: Dof::Full,
            count: [10; 3],
            cellcount: [-1; 3],
            spacing: [0.02; 3],
            scale: [1.0; 3],
            origin: None,
            mass: 1.0,
            inertiabox: 0.005,
            equality: EqualityOf::Nothing,
            solref: SOLREF,
            solimp: SOLIMP,
            rigid: false,
            point: Vec::new(),
            element: Vec::new(),
            texcoord: Vec::new(),
            pos: [0.0; 3],
            quat: [1.0, 0.0, 0.0, 0.0],
            alt: None,
            pins: Vec::new(),
            plugin: None,
        }
    }
}
