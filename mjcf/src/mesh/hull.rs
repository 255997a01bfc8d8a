//! Convex hull of a point set (Barber, Dobkin & Huhdanpaa 1996, "The quickhull algorithm for convex
//! hulls").

/// A triangulated convex hull; all indices are input points.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Hull {
    /// Points on the hull.
    pub vert: Vec<i32>,
    /// Hull neighbours of each entry of `vert`, as points.
    pub neighbours: Vec<Vec<i32>>,
    /// Triangles, counter-clockwise seen from outside.
    pub face: Vec<[i32; 3]>,
}

/// Hull of `points`; at most `max_vert` vertices unless that is -1. The error says why there is none.
pub fn convex_hull(points: &[[f64; 3]], max_vert: i32) -> Result<Hull, String> {
    let _ = (points, max_vert);
    Err("convex hulls are not available".to_string())
}
