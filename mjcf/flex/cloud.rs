//! Points of a deformable body, and elements between them.

/// Points, and elements between them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cloud {
    /// Vertices of an element less one.
    pub dim: i32,
    /// Points, three coordinates each \[m\].
    pub point: Vec<f64>,
    /// Points of each element.
    pub element: Vec<i32>,
    /// Texture coordinates, two each; one a point unless `elemtexcoord` says otherwise.
    pub texcoord: Vec<f32>,
    /// Texture coordinates of the points of each element.
    pub elemtexcoord: Vec<i32>,
}
