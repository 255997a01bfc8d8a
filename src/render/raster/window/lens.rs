//! What a picture, a mirror image or a shadow map is seen through.

use super::coverage::{Extent, Region};
use super::projection::Projection;

/// What a layer shows.
#[derive(Clone, Copy, Debug)]
pub struct Lens {
    /// From the world to the window.
    pub projection: Projection,
    /// Size of the window \[pixel\].
    pub extent: Extent,
    /// The part of it that is looked at.
    pub region: Region,
    /// What lies wholly beyond this depth is left out.
    pub deepest: f32,
    /// Only points with `normal . p + shift >= 0` in the world are drawn, and the sides of all triangles are exchanged.
    pub mirror: Option<[f64; 4]>,
    /// Which sides of triangles are drawn.
    pub sides: Sides,
    /// Width of the lines that outline triangles \[pixel\]; none where they are filled.
    pub wire: Option<f32>,
}

/// Which sides of triangles a layer shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sides {
    /// Those that are seen.
    Seen,
    /// Both.
    Both,
    /// Those turned away.
    Averted,
}
