//! Mesh assets: file bytes or inline arrays become the `mesh_*` rows of a model.
//!
//! The vertices are moved to the centre of mass and turned to the principal axes of inertia (MuJoCo
//! XML reference, `asset/mesh`); `pos` and `quat` say how, and geoms that use the mesh absorb them.
//!
//! ```
//! use robohive_mjcf::mesh::{MeshSource, decode, process};
//!
//! let tetrahedron = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
//! let file = decode(tetrahedron, "tetrahedron.obj", "")?;
//! let mesh = process(MeshSource { file: Some(file), needhull: true, ..MeshSource::default() })?;
//! assert!((mesh.volume - 1.0 / 6.0).abs() < 1e-7);
//! assert_eq!(mesh.poly_normal.len(), 4);
//! # Ok::<(), robohive_mjcf::asset::AssetError>(())
//! ```

mod compiled;
mod cube_triangles;
mod decode;
mod ear_clipping;
mod fit;
mod graph;
mod hash_order;
mod hull;
mod mass;
mod msh;
mod normals;
mod obj;
mod octree;
mod polygons;
mod process;
mod shapes;
mod skin;
mod source;
mod stl;
pub(crate) mod stored;
mod surface;

pub use compiled::CompiledMesh;
pub use decode::decode;
pub use fit::{Primitive, fit_primitive};
pub use hull::{Hull, HullError, convex_hull};
pub use mass::MeshInertia;
pub use octree::Octree;
pub use physics::geometry::hierarchy::Bvh;
pub use process::process;
pub use shapes::{Shape, builtin, vertex_count};
pub use skin::{Bone, CompiledSkin, RawSkin, SkinSource, skin};
pub use source::{Format, MeshSource, RawMesh};
pub use surface::surface;
