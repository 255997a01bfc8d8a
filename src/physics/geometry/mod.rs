//! Shapes of geoms: volume and inertia, bounding spheres and boxes, hierarchies of boxes.
//!
//! ```
//! use robohive_physics::geometry::shape;
//! use robohive_physics::model::GeomType;
//!
//! let text = "<mujoco><worldbody><body><freejoint/><geom type='box' size='.1 .2 .3'/></body></worldbody></mujoco>";
//! let mut model = robohive_mjcf::load_str(text)?.model;
//! let size = [0.2, 0.1, 0.1];
//! let mass = 1000.0 * shape::volume(GeomType::Box, size, false);
//! model.edit(|m| {
//!     m.geom_size[0] = size;
//!     m.body_mass[1] = mass;
//!     m.body_inertia[1] = shape::inertia(GeomType::Box, size, mass, false);
//! })?;
//! assert_eq!(model.geom_aabb[0], [0.0, 0.0, 0.0, 0.2, 0.1, 0.1]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub(crate) mod bounds;
#[doc(hidden)]
pub mod hierarchy;
mod quickselect;
pub mod shape;
