//! Meshes of loose objects, by the folder that they are in.

mod desk;
mod gadgets;
mod kitchen;
mod solids;
mod things;
mod toys;

pub(crate) use desk::MESHES as DESK;
pub(crate) use gadgets::MESHES as GADGETS;
pub(crate) use kitchen::MESHES as KITCHEN;
pub(crate) use solids::MESHES as SOLIDS;
pub(crate) use things::MESHES as THINGS;
pub(crate) use toys::MESHES as TOYS;

use workshop::{Mesh, Profile, Station, Vec3, sweep};

/// A bent rod through places, each with the half widths of its section.
fn rod(path: &[(Vec3, [f64; 2])], count: usize) -> Mesh {
    let stations: Vec<_> = path.iter().map(|(at, size)| Station { at: *at, size: *size }).collect();
    sweep(&Profile::circle(1.0, count), &stations)
}
