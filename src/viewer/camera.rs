//! How gestures move the free camera (documentation: programming, `mjv_moveCamera`).
//!
//! Gestures are measured in heights of the view: a drag over the whole height is 1, to the right and up are positive.

use physics::Model;
use physics::math::{Vec3, add_scaled, ops};
use render::scene::FreeCamera;

/// Degrees that a drag over the height of the view turns the camera.
const TURN: f64 = 180.0;
/// Steepest elevation \[deg\].
const STEEPEST: f64 = 89.0;
/// Nearest and farthest distance, in extents of the model.
const DISTANCES: [f64; 2] = [0.01, 100.0];
/// What parallel rays pan, of what rays from one point pan at a depth of one metre.
pub(crate) const PARALLEL: f64 = 0.15;

/// The plane in which a drag moves things.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// Upright: up on the screen is up in the world.
    Vertical,
    /// The floor: up on the screen is away from the eye.
    Horizontal,
}

impl Plane {
    /// A drag as a displacement of the world, for an eye that looks along `gaze`.
    pub(crate) fn displacement(self, drag: [f64; 2], gaze: Vec3) -> Vec3 {
        let [right, up] = drag;
        heading(
            gaze,
            match self {
                Plane::Vertical => [right, 0.0, up],
                Plane::Horizontal => [right, up, 0.0],
            },
        )
    }

    /// A drag as an axis whose length is the turn, for an eye that looks along `gaze`.
    pub(crate) fn axis(self, drag: [f64; 2], gaze: Vec3) -> Vec3 {
        let [right, up] = drag;
        heading(
            gaze,
            match self {
                Plane::Vertical => [-up, 0.0, right],
                Plane::Horizontal => [-up, right, 0.0],
            },
        )
    }
}

/// `v`, whose second axis is the horizontal heading of `gaze`, in the world's frame.
fn heading(gaze: Vec3, v: Vec3) -> Vec3 {
    let length = gaze[0].hypot(gaze[1]);
    let [x, y] = if length > 0.0 { [gaze[0] / length, gaze[1] / length] } else { [1.0, 0.0] };
    [v[0] * y + v[1] * x, v[1] * y - v[0] * x, v[2]]
}

/// Direction in which a free camera looks.
fn gaze(camera: &FreeCamera) -> Vec3 {
    let (sin_azimuth, cos_azimuth) = ops::sincos(camera.azimuth.to_radians());
    let (sin_elevation, cos_elevation) = ops::sincos(camera.elevation.to_radians());
    [cos_elevation * cos_azimuth, cos_elevation * sin_azimuth, sin_elevation]
}

/// Turns the camera about the point that it looks at.
pub fn orbit(camera: &mut FreeCamera, drag: [f64; 2]) {
    camera.azimuth -= TURN * drag[0];
    camera.elevation = (camera.elevation + TURN * drag[1]).clamp(-STEEPEST, STEEPEST);
    camera.azimuth = (camera.azimuth + 180.0).rem_euclid(360.0) - 180.0;
}

/// Moves the point that the camera looks at, so that it follows the drag. A camera that tracks a body stays with it.
pub fn pan(camera: &mut FreeCamera, plane: Plane, drag: [f64; 2]) {
    if camera.track.is_some() {
        return;
    }
    let depth = if camera.orthographic {
        PARALLEL * camera.fovy * camera.distance
    } else {
        2.0 * ops::tan(camera.fovy.to_radians() / 2.0) * camera.distance
    };
    camera.lookat = add_scaled(camera.lookat, plane.displacement(drag, gaze(camera)), -depth);
}

/// Brings the camera nearer (positive) or takes it away.
pub fn zoom(camera: &mut FreeCamera, model: &Model, by: f64) {
    let extent = model.stat.extent;
    let [nearest, farthest] = DISTANCES.map(|distance| distance * extent);
    let pace = 9.0 * extent * ops::log(1.0 + camera.distance / extent / 3.0);
    camera.distance = (camera.distance - pace * by).clamp(nearest, farthest);
}
