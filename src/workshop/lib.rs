//! A workshop for meshes: parts of robots made of profiles, in metres, the same bits on every machine.
//!
//! A [`Profile`] is a closed line in the plane. [`extrude`] gives it a height, [`revolve`] turns a half profile about the z axis,
//! [`sweep`] carries one along a path, [`loft`] spans a surface over several, and [`rounded_box`], [`cylinder`], [`capsule`] and
//! [`ellipsoid`] are the shapes that most machines consist of. What comes out is a [`Mesh`]: closed, its faces
//! counter-clockwise seen from outside. Parts are moved, mirrored and put together with its methods; [`Mesh::to_obj`] writes a file that
//! MJCF can name.
//!
//! ```
//! use robohive_workshop::{Profile, cylinder, extrude};
//!
//! // A bracket: a plate with a hole for the shaft, and the hub round it.
//! let hole = Profile::circle(0.01, 24);
//! let plate = extrude(&Profile::rounded_rectangle([0.04, 0.025], 0.008, 4), &[hole], [0.0, 0.006]);
//! let hub = cylinder(0.018, [0.006, 0.02], 0.002, 24).turned([0.0, 0.0, 1.0], 0.1);
//! let bracket = plate.with(&hub);
//! assert!(bracket.is_closed());
//! assert!(bracket.to_obj(0.6).starts_with("v "));
//! ```

mod lofts;
mod mesh;
mod obj;
mod profile;
mod shapes;

pub use lofts::{Station, extrude, loft, revolve, sweep};
pub use mesh::Mesh;
/// Sine and cosine of an angle \[rad\], the same bits on every machine.
pub use physics::math::ops::sincos;
pub use profile::Profile;
pub use shapes::{capsule, cylinder, ellipsoid, rounded_box};

/// A point or direction in space \[m\].
pub type Vec3 = [f64; 3];
