//! RoboHive.
pub use dataset;
pub use mjcf;
pub use physics;
