//! RoboHive.
pub use physics;
pub use mjcf;
pub use dataset;
