//! Shapes of points, and one that is asked for by counts and spacing.

/// What a `flexcomp` is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[allow(missing_docs)]
pub enum Shape {
    #[default]
    Grid,
    Box,
    Cylinder,
    Ellipsoid,
    Square,
    Disc,
    Circle,
    Mesh,
    Gmsh,
    Direct,
}

impl Shape {
    /// Points and elements are given, not computed.
    pub fn is_given(self) -> bool {
        matches!(self, Shape::Mesh | Shape::Gmsh | Shape::Direct)
    }
}

/// A computed shape that is asked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Regular {
    pub shape: Shape,
    /// Vertices of an element less one.
    pub dim: i32,
    /// Points along each axis.
    pub count: [usize; 3],
    /// Their distance \[m\].
    pub spacing: [f64; 3],
    /// Texture coordinates are wanted.
    pub textured: bool,
}

impl Regular {
    /// Half lengths of the box around the points.
    pub(super) fn half(&self) -> [f64; 3] {
        std::array::from_fn(|k| 0.5 * self.spacing[k] * (self.count[k] as f64 - 1.0))
    }

    /// Texture coordinate of place `i` along axis `axis`.
    pub(super) fn share(&self, i: usize, axis: usize) -> f32 {
        i as f32 / (self.count[axis].max(2) - 1) as f32
    }
}
