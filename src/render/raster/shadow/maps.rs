//! From the world to the shadow maps of a lamp.

use crate::raster::window::projection::Projection;
use crate::scene::{Light, LightKind, Scene};
use physics::math::ops::tan;
use physics::math::{cross, dot};

/// Texels left free at every side of the map.
const MARGIN: f64 = 1.0;
/// Widest full angle of a spot's map \[deg\].
const WIDEST: f32 = 160.0;

/// What every shadow of a scene needs beside its lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadowSettings {
    /// Texels along a side of the map, at most 8192; none is drawn for 0.
    pub size: usize,
    /// Half the width of the map of a directional light \[m\].
    pub clip: f32,
    /// Share of a spot's cone that the map covers.
    pub scale: f32,
}

/// Maps of the world to a lamp's map: `casters` for triangles, in texels of the inner map; `lookups` for fragments, in texels
/// of the whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Maps {
    /// From the world to the texels that casters are drawn to.
    pub casters: Projection,
    /// From the world to the texels that are looked up.
    pub lookups: Projection,
}

/// The maps of a lamp, with its depth as `u`.
pub fn maps(light: &Light, scene: &Scene, settings: &ShadowSettings) -> Maps {
    let frustum = &scene.view.frustum;
    let (near, far) = (frustum.near, frustum.far);
    let forward = unit(light.dir.map(f64::from));
    // The side of the map: the gaze times -x, or times y where that is too short.
    let side = cross(forward, [-1.0, 0.0, 0.0]);
    let up = if dot(side, side) < 0.01 { cross(forward, [0.0, 1.0, 0.0]) } else { side };
    let right = unit(cross(forward, up));
    let up = cross(right, forward);
    let pos = light.pos.map(f64::from);
    let from_lamp = |axis: [f64; 3]| [axis[0], axis[1], axis[2], -dot(axis, pos)];
    let (x, y, depth) = (from_lamp(right), from_lamp(up), from_lamp(forward));
    let (w, half, slope) = match light.kind {
        LightKind::Directional => ([0.0, 0.0, 0.0, 1.0], f64::from(settings.clip), 1.0 / (far - near)),
        LightKind::Spot { cutoff, .. } => {
            let angle = (2.0 * cutoff * settings.scale).min(WIDEST);
            (depth, tan(0.5 * f64::from(angle).to_radians()), far / (far - near))
        }
    };
    let u = std::array::from_fn(|k| slope * (depth[k] - if k == 3 { near } else { 0.0 }));
    let texels = settings.size as f64;
    let axis =
        |row: [f64; 4], inner: f64| std::array::from_fn(|k| 0.5 * (inner * row[k] / half + texels * w[k]));
    let map = |inner: f64| Projection([axis(x, inner), axis(y, inner), u, w]);
    Maps { casters: map(texels - 2.0 * MARGIN), lookups: map(texels) }
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    v.map(|x| x / length)
}
