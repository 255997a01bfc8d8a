//! From world coordinates to the window: projection matrices.

use crate::error::RenderError;
use crate::view::View;
use physics::math::{cross, dot};

/// Four rows that take a point (x, y, z, 1) to (x w, y w, z w, w): x and y in pixels from the lower left corner, reversed
/// depth z, and w, which is the distance from the eye's plane or 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection(pub [[f64; 4]; 4]);

/// Least distance of the near plane and greatest of the far one [m]: their product and quotient are numbers of single
/// precision.
const REACH: [f64; 2] = [1e-18, 1e18];

/// A map of points: three rows of a linear part and a shift.
pub type Affine = [[f64; 4]; 3];

impl Projection {
    /// What `view` shows in a window of `width` by `height` pixels.
    ///
    /// # Errors
    /// A frustum that is empty or not finite.
    pub fn of(view: &View, width: usize, height: usize) -> Result<Self, RenderError> {
        let f = &view.frustum;
        let half_height = 0.5 * (f.top - f.bottom);
        let half_width = f.half_width.unwrap_or(half_height * width as f64 / height as f64);
        let fails = |message: &str| Err(RenderError::Frustum { message: message.into() });
        let poses = view.eye.iter().chain(&view.forward).chain(&view.up);
        if !poses.chain(&[half_width, half_height, f.center, f.near, f.far]).all(|x| x.is_finite()) {
            return fails("its pose or its frustum is not finite");
        }
        if half_width <= 0.0 || half_height <= 0.0 {
            return fails("its window has no width or no height");
        }
        if f.near <= 0.0 || f.far <= f.near {
            return fails("its near plane must lie before its far plane, and before that the eye");
        }
        if f.near < REACH[0] || f.far > REACH[1] {
            let [least, most] = REACH;
            return fails(&format!(
                "its near plane must be {least:e} m away or more, its far plane {most:e} m or less"
            ));
        }
        let right = cross(view.forward, view.up);
        let from_eye = |axis: [f64; 3]| [axis[0], axis[1], axis[2], -dot(axis, view.eye)];
        let (x, y, depth) = (from_eye(right), from_eye(view.up), from_eye(view.forward));
        let w = if f.orthographic { [0.0, 0.0, 0.0, 1.0] } else { depth };
        let scale = if f.orthographic { 1.0 } else { f.near };
        let middle = 0.5 * (f.top + f.bottom);
        // Clip coordinates (scale x - centre w) / half, then from [-1, 1] to pixels.
        let window = |axis: [f64; 4], center: f64, half: f64, pixels: usize| {
            let pixels = 0.5 * pixels as f64;
            std::array::from_fn(|k| pixels * ((scale * axis[k] - center * w[k]) / half + w[k]))
        };
        let reach = f.far - f.near;
        let slope = scale / reach;
        let z = std::array::from_fn(|k| slope * (if k == 3 { f.far } else { 0.0 } - depth[k]));
        Ok(Projection([window(x, f.center, half_width, width), window(y, middle, half_height, height), z, w]))
    }

    /// This projection of points that `map` moves first, rounded to columns of `f32` that multiply x, y, z and 1.
    pub fn after(&self, map: &Affine) -> Columns {
        let columns: [[f32; 4]; 4] = std::array::from_fn(|j| {
            std::array::from_fn(|i| {
                let row = &self.0[i];
                let moved = row[0] * map[0][j] + row[1] * map[1][j] + row[2] * map[2][j];
                (moved + if j == 3 { row[3] } else { 0.0 }) as f32
            })
        });
        Columns(columns)
    }

    /// This projection of points mirrored in the plane through `point` with unit normal `normal`.
    pub fn mirrored(&self, point: [f64; 3], normal: [f64; 3]) -> Self {
        let mirror: Affine = mirror(point, normal);
        Projection(self.0.map(|row| {
            std::array::from_fn(|j| {
                let moved = row[0] * mirror[0][j] + row[1] * mirror[1][j] + row[2] * mirror[2][j];
                moved + if j == 3 { row[3] } else { 0.0 }
            })
        }))
    }
}

/// A projection in single precision, by columns.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Columns(pub [[f32; 4]; 4]);

impl Columns {
    /// (x w, y w, z w, w) of a point.
    pub fn apply(&self, p: [f32; 3]) -> [f32; 4] {
        let [a, b, c, d] = &self.0;
        std::array::from_fn(|i| a[i] * p[0] + b[i] * p[1] + c[i] * p[2] + d[i])
    }
}

/// The map that mirrors points in the plane through `point` with unit normal `normal`.
pub fn mirror(point: [f64; 3], normal: [f64; 3]) -> Affine {
    let away = dot(point, normal);
    std::array::from_fn(|i| {
        std::array::from_fn(|j| match j {
            3 => 2.0 * away * normal[i],
            _ => f64::from(u8::from(i == j)) - 2.0 * normal[i] * normal[j],
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::Frustum;

    fn view(orthographic: bool) -> View {
        let frustum = Frustum {
            orthographic,
            center: 0.0,
            half_width: None,
            bottom: -0.1,
            top: 0.1,
            near: 0.1,
            far: 10.0,
        };
        View { eye: [1.0, 2.0, 3.0], forward: [1.0, 0.0, 0.0], up: [0.0, 0.0, 1.0], frustum }
    }

    fn window(projection: &Projection, p: [f64; 3]) -> [f64; 3] {
        let [x, y, z, w] = projection.0.map(|row| row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]);
        [x / w, y / w, z / w]
    }

    #[test]
    fn the_middle_of_the_gaze_is_the_middle_of_the_picture_and_depth_is_reversed() {
        for orthographic in [false, true] {
            let projection = Projection::of(&view(orthographic), 200, 100).expect("a sound view");
            for (distance, depth) in [(0.1, 1.0), (10.0, 0.0)] {
                let [x, y, z] = window(&projection, [1.0 + distance, 2.0, 3.0]);
                assert!((x - 100.0).abs() < 1e-9 && (y - 50.0).abs() < 1e-9 && (z - depth).abs() < 1e-12);
            }
        }
        // One metre ahead the window is 2 m high in perspective: its upper edge is at 1 m.
        let projection = Projection::of(&view(false), 200, 100).expect("a sound view");
        let [x, y, _] = window(&projection, [2.0, 2.0, 4.0]);
        assert!((x - 100.0).abs() < 1e-9 && (y - 100.0).abs() < 1e-9);
        // Right of the gaze along +x with z up is -y.
        assert!(window(&projection, [2.0, 1.0, 3.0])[0] > 100.0);
    }

    #[test]
    fn mirroring_twice_changes_nothing() {
        let projection = Projection::of(&view(false), 64, 64).expect("a sound view");
        let normal = [0.6, 0.0, 0.8];
        let twice = projection.mirrored([1.0, 1.0, 1.0], normal).mirrored([1.0, 1.0, 1.0], normal);
        for (a, b) in twice.0.iter().flatten().zip(projection.0.iter().flatten()) {
            assert!((a - b).abs() < 1e-12);
        }
    }

    #[test]
    fn an_empty_frustum_is_an_error() {
        let mut flat = view(false);
        flat.frustum.top = flat.frustum.bottom;
        assert!(Projection::of(&flat, 10, 10).is_err());
        let mut nowhere = view(false);
        nowhere.eye[0] = f64::NAN;
        assert!(Projection::of(&nowhere, 10, 10).is_err());
    }
}
