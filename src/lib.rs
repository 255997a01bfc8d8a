//! RoboHive: robots described in MJCF, moved by physics that follows MuJoCo 3.12.
//!
//! ```no_run
//! let loaded = robohive::mjcf::load("assets/franka/franka_table.xml").unwrap();
//! let mut data = robohive::physics::Data::new(&loaded.model);
//! robohive::physics::step(&loaded.model, &mut data).unwrap();
//! assert!(data.state.time > 0.0);
//! ```

pub use dataset;
pub use mjcf;
pub use physics;
