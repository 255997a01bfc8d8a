//! A surface of an item: where it lies in the item's frame, and how it is textured.

/// One surface of an item, where it lies in the item's frame and how it is textured. An item has one to three; a flex has
/// one for each vertex and edge that is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// Index into [`Assets::surfaces`](super::Assets::surfaces).
    pub surface: usize,
    /// From the surface's coordinates to the item's frame: three rows of a linear map.
    pub linear: [[f32; 3]; 3],
    /// Origin of the surface's coordinates in the item's frame \[m\].
    pub offset: [f32; 3],
    /// How it is textured.
    pub paint: Paint,
    /// It is seen from both sides.
    pub two_sided: bool,
}

/// How a part is textured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Paint {
    /// In the colour of the item.
    Plain,
    /// By the surface's own texture coordinates: `(s, t) = scale * (u, v) + offset`.
    Explicit {
        /// Index into [`Assets::textures`](super::Assets::textures).
        texture: usize,
        /// Factors of u and v.
        scale: [f32; 2],
        /// Added after scaling.
        offset: [f32; 2],
    },
    /// By the position in the surface's coordinates: `(s, t) = (a * x - 0.5, b * y - 0.5)`.
    Planar {
        /// Index into [`Assets::textures`](super::Assets::textures).
        texture: usize,
        /// Factors a and b.
        scale: [f32; 2],
    },
    /// A cube texture looked up in the direction `scale * position`, in the surface's coordinates.
    Cube {
        /// Index into [`Assets::textures`](super::Assets::textures).
        texture: usize,
        /// Factors of x, y and z.
        scale: [f32; 3],
    },
}
