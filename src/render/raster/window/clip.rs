//! Triangles that leave the space that can be drawn are cut at its faces.

/// Largest distance from the window's origin that a corner may have \[pixel\]; with it the products of the edge functions
/// stay within their integers.
pub const GUARD: f32 = 10240.0;

/// A corner before division: (x w, y w, z w, w), and its distance from a mirror, where there is one.
pub type Corner = [f32; 5];

/// Faces of the space that can be drawn, as signed distances that are at least 0 inside.
const FACES: [fn(&Corner) -> f32; 7] = [
    |c| c[3] - c[2],
    |c| c[2],
    |c| c[0] + GUARD * c[3],
    |c| GUARD * c[3] - c[0],
    |c| c[1] + GUARD * c[3],
    |c| GUARD * c[3] - c[1],
    |c| c[4],
];

/// A triangle cut by all faces.
#[derive(Clone, Debug)]
pub struct Polygon {
    corners: [Corner; 3 + FACES.len()],
    count: usize,
}

/// What is left of a triangle inside: a convex polygon with the same sense of rotation, without corners if nothing is.
pub fn clip(triangle: [Corner; 3]) -> Polygon {
    let mut polygon = Polygon { corners: [[0.0; 5]; 3 + FACES.len()], count: 3 };
    polygon.corners[..3].copy_from_slice(&triangle);
    for face in FACES {
        let before = polygon.clone();
        polygon.count = 0;
        for i in 0..before.count {
            let (here, next) = (before.corners[i], before.corners[(i + 1) % before.count]);
            let (inside, inside_next) = (face(&here), face(&next));
            if inside >= 0.0 {
                polygon.push(here);
            }
            // From the inner corner outwards, so that neighbours share their new corners.
            if inside >= 0.0 && inside_next < 0.0 {
                polygon.push(between(&here, &next, inside / (inside - inside_next)));
            } else if inside < 0.0 && inside_next >= 0.0 {
                polygon.push(between(&next, &here, inside_next / (inside_next - inside)));
            }
        }
    }
    polygon
}

/// The part of a line inside, if there is any.
pub fn clip_line(mut ends: [Corner; 2]) -> Option<[Corner; 2]> {
    for face in FACES {
        let [a, b] = [face(&ends[0]), face(&ends[1])];
        match (a >= 0.0, b >= 0.0) {
            (true, true) => {}
            (false, false) => return None,
            (true, false) => ends[1] = between(&ends[0], &ends[1], a / (a - b)),
            (false, true) => ends[0] = between(&ends[1], &ends[0], b / (b - a)),
        }
    }
    Some(ends)
}

impl Polygon {
    /// A line through the polygon's side adds at most one corner a face, rounding aside.
    fn push(&mut self, corner: Corner) {
        if self.count < self.corners.len() {
            self.corners[self.count] = corner;
            self.count += 1;
        }
    }

    /// The triangles of a fan about the first corner.
    pub fn triangles(&self) -> impl Iterator<Item = [Corner; 3]> + '_ {
        (2..self.count).map(|i| [self.corners[0], self.corners[i - 1], self.corners[i]])
    }
}

fn between(from: &Corner, to: &Corner, share: f32) -> Corner {
    std::array::from_fn(|k| from[k] + share * (to[k] - from[k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(corners: [Corner; 3]) -> f32 {
        let [a, b, c] = corners.map(|c| [c[0] / c[3], c[1] / c[3]]);
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]))
    }

    #[test]
    fn what_is_inside_stays() {
        let triangle = [[0.0, 0.0, 0.5, 1.0, 1.0], [10.0, 0.0, 0.5, 1.0, 1.0], [0.0, 10.0, 0.5, 1.0, 1.0]];
        let kept: Vec<_> = clip(triangle).triangles().collect();
        assert_eq!(kept, [triangle]);
    }

    #[test]
    fn a_mirror_cuts_half_away() {
        let triangle = [[0.0, 0.0, 0.5, 1.0, 1.0], [10.0, 0.0, 0.5, 1.0, 1.0], [0.0, 10.0, 0.5, 1.0, -1.0]];
        let area: f32 = clip(triangle).triangles().map(area).sum();
        // The upper quarter of the triangle is behind the mirror.
        assert!((area - 37.5).abs() < 1e-4, "{area}");
    }

    #[test]
    fn nothing_is_left_behind_the_near_plane() {
        let triangle = [[0.0, 0.0, 2.0, 1.0, 1.0], [10.0, 0.0, 2.0, 1.0, 1.0], [0.0, 10.0, 2.0, 1.0, 1.0]];
        assert_eq!(clip(triangle).triangles().count(), 0);
    }

    #[test]
    fn far_corners_are_pulled_to_the_guard_band() {
        let triangle = [[-1e6, 0.0, 0.5, 1.0, 1.0], [1e6, 0.0, 0.5, 1.0, 1.0], [0.0, 1e6, 0.5, 1.0, 1.0]];
        let polygon = clip(triangle);
        let corners: Vec<_> = polygon.triangles().flatten().collect();
        assert!(!corners.is_empty());
        assert!(corners.iter().all(|c| c[0].abs() <= GUARD * 1.001 && c[1].abs() <= GUARD * 1.001));
    }
}
