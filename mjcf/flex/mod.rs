//! Points and elements of deformable bodies: computed shapes, and files of GMSH.
//!
//! ```
//! use robohive_mjcf::flex::decode_gmsh;
//!
//! let file = b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n\
//!     $Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements\n";
//! let triangle = decode_gmsh(file, "triangle.msh")?;
//! assert_eq!((triangle.dim, triangle.point.len(), &*triangle.element), (2, 9, &[0, 1, 2][..]));
//! # Ok::<(), robohive_mjcf::asset::AssetError>(())
//! ```

pub(crate) mod cells;
mod gmsh;
mod grid;
mod shell;

pub use gmsh::decode as decode_gmsh;

/// What a `flexcomp` is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[allow(missing_docs)]
pub enum Shape {
    #[default]
    Grid,
    Box,
    Cylinder,
    Ellipsoid,
    Square,
    Disc,
    Circle,
    Mesh,
    Gmsh,
    Direct,
}

impl Shape {
    /// Points and elements are given, not computed.
    pub fn is_given(self) -> bool {
        matches!(self, Shape::Mesh | Shape::Gmsh | Shape::Direct)
    }
}

/// Points, and elements between them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cloud {
    /// Vertices of an element less one.
    pub dim: i32,
    /// Points, three coordinates each [m].
    pub point: Vec<f64>,
    /// Points of each element.
    pub element: Vec<i32>,
    /// Texture coordinates, two each; one a point unless `elemtexcoord` says otherwise.
    pub texcoord: Vec<f32>,
    /// Texture coordinates of the points of each element.
    pub elemtexcoord: Vec<i32>,
}

/// A computed shape that is asked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Regular {
    pub shape: Shape,
    /// Vertices of an element less one.
    pub dim: i32,
    /// Points along each axis.
    pub count: [usize; 3],
    /// Their distance [m].
    pub spacing: [f64; 3],
    /// Texture coordinates are wanted.
    pub textured: bool,
}

impl Regular {
    /// Points and elements.
    ///
    /// # Errors
    /// There are too few points along an axis.
    pub(crate) fn build(&self) -> Result<Cloud, String> {
        match self.shape {
            Shape::Box | Shape::Cylinder | Shape::Ellipsoid => shell::build(self),
            Shape::Square | Shape::Disc => grid::projected(self),
            _ => grid::build(self),
        }
        .and_then(|cloud| match cloud.element.is_empty() {
            true => Err("the count makes no element: more points along an axis are needed".into()),
            false => Ok(cloud),
        })
    }

    /// Half lengths of the box around the points.
    fn half(&self) -> [f64; 3] {
        std::array::from_fn(|k| 0.5 * self.spacing[k] * (self.count[k] as f64 - 1.0))
    }

    /// Texture coordinate of place `i` along axis `axis`.
    fn share(&self, i: usize, axis: usize) -> f32 {
        i as f32 / (self.count[axis].max(2) - 1) as f32
    }
}
