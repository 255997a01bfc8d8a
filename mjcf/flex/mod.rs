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
mod cloud;
mod gmsh;
mod grid;
mod regular;
mod shell;

pub use cloud::Cloud;
pub use gmsh::decode as decode_gmsh;
pub(crate) use regular::Regular;
pub use regular::Shape;

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
}
