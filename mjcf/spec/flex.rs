//! Deformable bodies (XML reference: `deformable/flex`). A `flexcomp` is read as a flex with the bodies it makes.

use super::element::{SOLIMP, SOLREF, elements};
use physics::model::FlexSelf;

/// Which deformations of a surface are elastic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Elastic2d {
    /// Neither.
    #[default]
    None,
    /// Bending alone.
    Bend,
    /// Stretching alone.
    Stretch,
    /// Both.
    Both,
}

impl Elastic2d {
    /// Bending is elastic.
    pub fn bends(self) -> bool {
        matches!(self, Elastic2d::Bend | Elastic2d::Both)
    }

    /// Stretching is elastic.
    pub fn stretches(self) -> bool {
        matches!(self, Elastic2d::Stretch | Elastic2d::Both)
    }
}

elements! {
    /// A deformable body: lines, triangles or tetrahedra between vertices that are fixed to bodies, or that follow a
    /// lattice of nodes.
    Flex {
        /// Contact bits.
        contype: i32 = 1,
        /// Contact bits that it meets.
        conaffinity: i32 = 1,
        /// Dimensions of the contact: 1, 3, 4 or 6.
        condim: i32 = 3,
        /// Whose contact parameters win.
        priority: i32 = 0,
        /// Sliding, torsional, rolling friction.
        friction: [f64; 3] = [1.0, 0.005, 0.0001],
        /// Weight in mixing contact parameters.
        solmix: f64 = 1.0,
        /// Solver reference.
        solref: [f64; 2] = SOLREF,
        /// Solver impedance.
        solimp: [f64; 5] = SOLIMP,
        /// Distance at which contacts push, metres.
        margin: f64 = 0.0,
        /// Further distance at which contacts are listed, metres.
        gap: f64 = 0.0,
        /// Elements collide with the vertices of their neighbours.
        internal: bool = false,
        /// How elements that are far apart collide.
        selfcollide: FlexSelf = FlexSelf::Auto,
        /// Layers of tetrahedra below the surface that collide.
        activelayers: i32 = 1,
        /// Contacts push with passive forces.
        passive: bool = false,
        /// 1 for lines, 2 for triangles, 3 for tetrahedra.
        dim: i32 = 2,
        /// Radius around the elements, metres.
        radius: f64 = 0.005,
        /// Visual group.
        group: i32 = 0,
        /// Material.
        material: String = String::new(),
        /// Colour and opacity.
        rgba: [f32; 4] = [0.5, 0.5, 0.5, 1.0],
        /// Drawn with flat shading.
        flatskin: bool = false,
        /// Order of the interpolation between nodes, 0 without nodes.
        order: i32 = 0,
        /// Cells of the lattice of nodes along each axis.
        cellcount: [i32; 3] = [1; 3],
        /// Body of each vertex, or one for all.
        vertbody: Vec<String> = Vec::new(),
        /// Body of each node.
        nodebody: Vec<String> = Vec::new(),
        /// Vertices in the frames of their bodies, metres; empty where all are at the origins.
        vert: Vec<f64> = Vec::new(),
        /// Nodes in the frames of their bodies, metres; empty where all are at the origins.
        node: Vec<f64> = Vec::new(),
        /// Vertices of each element.
        elem: Vec<i32> = Vec::new(),
        /// Texture coordinates.
        texcoord: Vec<f32> = Vec::new(),
        /// Texture coordinates of the vertices of each element.
        elemtexcoord: Vec<i32> = Vec::new(),
        /// Stiffness of edges, N/m.
        edgestiffness: f64 = 0.0,
        /// Damping of edges, N s/m.
        edgedamping: f64 = 0.0,
        /// Young's modulus, Pa.
        young: f64 = 0.0,
        /// Poisson's ratio.
        poisson: f64 = 0.0,
        /// Damping proportional to the stiffness, seconds.
        damping: f64 = 0.0,
        /// Thickness of a surface, metres.
        thickness: f64 = -1.0,
        /// Which deformations of a surface are elastic.
        elastic2d: Elastic2d = Elastic2d::None,
        /// Cells of the lattice that hold no element, where a `flexcomp` has found them; otherwise the compiler does.
        empty_cells: Vec<bool> = Vec::new(),
    }
}
