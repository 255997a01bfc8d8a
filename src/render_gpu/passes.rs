//! What the shaders know of one pass over one picture, and of its lights.

use physics::math::ops::{atan, cos, sin, sqrt};
use render::raster::{Affine, Projection};
use render::scene::{Fog, Haze, Light, LightKind, Scene};
use std::f64::consts::PI;

/// Bytes from one pass to the next: the alignment of uniforms that every GPU offers.
pub const STRIDE: usize = 512;
/// Floats of a pass in the shader.
const FLOATS: usize = 80;
/// Bytes of a pass in the shader.
pub const BYTES: usize = 4 * FLOATS;
/// Place of the layer in a pass \[byte\].
const LAYER: usize = 13 * 16 + 8;
/// Lights of a picture in the list of lights.
pub const LIGHTS: usize = 8;
/// Floats of a light.
const LIGHT_FLOATS: usize = 24;
/// Bit of the lights that stands for emission.
pub const EMISSION: u32 = 1 << 8;
/// Bit of the lights that stands for a mirror: positions are projected by the pass, not by the instances.
pub const MIRROR: u32 = 1 << 9;
/// Radius and half height of the sky, in units of the far plane's distance.
const SKY: f64 = 0.7;

/// One pass over one picture.
#[derive(Clone, Debug)]
pub struct Pass<'a> {
    /// What is drawn.
    pub scene: &'a Scene,
    /// Where its points come to lie.
    pub clip: [[f32; 4]; 4],
    /// Where a shadow map keeps them.
    pub map: [[f32; 4]; 4],
    /// The plane that mirrors, world frame relative to the eye.
    pub mirror: [f32; 4],
    /// Where highlights are seen from, relative to the eye \[m\].
    pub from: [f32; 3],
    /// Factor of the items' own colours.
    pub reflectance: f32,
    /// From the world relative to the eye to the distance from the eye's plane \[m\].
    pub depth: [f32; 4],
    /// First light.
    pub first_light: u32,
    /// Lights that light, and [`EMISSION`].
    pub lights: u32,
    /// Layer of the shadow map.
    pub layer: u32,
    /// Texels along a side of the shadow map.
    pub map_size: usize,
    /// Depth in the shadow map is reversed.
    pub reversed: bool,
    /// What is added to the depth in it.
    pub offset: f32,
    /// Slices of the sky.
    pub slices: usize,
    /// Columns and rows of the picture \[pixel\].
    pub window: [f32; 2],
}

impl<'a> Pass<'a> {
    /// A pass without light, shadow or mirror.
    pub fn new(scene: &'a Scene, clip: [[f32; 4]; 4]) -> Self {
        let forward = scene.view.forward.map(|x| x as f32);
        Pass {
            scene,
            clip,
            map: [[0.0; 4]; 4],
            mirror: [0.0; 4],
            from: [0.0; 3],
            reflectance: 1.0,
            depth: [forward[0], forward[1], forward[2], 0.0],
            first_light: 0,
            lights: 0,
            layer: 0,
            map_size: 0,
            reversed: false,
            offset: 0.0,
            slices: 3,
            window: [1.0; 2],
        }
    }

    /// Appends the pass as the shader reads it.
    pub fn write(&self, out: &mut Vec<u8>) {
        let scene = self.scene;
        let Fog { start, end, rgb: fog } = scene.fog.unwrap_or(Fog { start: 0.0, end: 1.0, rgb: [0.0; 3] });
        let foggy = if scene.fog.is_some() { 1.0 } else { 0.0 };
        let [x, y, z] = self.from;
        let ambient = if self.lights & EMISSION != 0 { scene.ambient } else { 0.0 };
        let [around, haze] = surroundings(scene);
        let [gx, gy, gz] = scene.view.forward.map(|x| x as f32);
        let parallel = if scene.view.frustum.orthographic { 1.0 } else { 0.0 };
        let counts = [self.first_light, self.lights, self.layer, self.slices as u32].map(f32::from_bits);
        let mut rows: [[f32; 4]; FLOATS / 4] = [[0.0; 4]; FLOATS / 4];
        rows[..4].copy_from_slice(&self.clip);
        rows[4..8].copy_from_slice(&self.map);
        rows[8] = self.mirror;
        rows[9] = [x, y, z, self.reflectance];
        rows[10] = [fog[0], fog[1], fog[2], foggy];
        rows[11] = self.depth;
        rows[12] = [start, end, ambient, self.map_size as f32];
        rows[13] = counts;
        rows[14..17].copy_from_slice(&around);
        rows[17] = haze[0];
        rows[18] = [gx, gy, gz, parallel];
        rows[19] = [self.window[0], self.window[1], f32::from(u8::from(self.reversed)), self.offset];
        let first = out.len();
        out.extend_from_slice(bytemuck::cast_slice(&rows));
        out.resize(first + STRIDE, 0);
    }
}

/// Changes the layer of the shadow map of a pass that has been written.
pub fn set_layer(passes: &mut [u8], number: u32, layer: u32) {
    let at = number as usize * STRIDE + LAYER;
    passes[at..at + 4].copy_from_slice(&layer.to_ne_bytes());
}

/// The rows of sky and haze.
fn surroundings(scene: &Scene) -> [[[f32; 4]; 3]; 2] {
    let radius = SKY * scene.view.frustum.far;
    let Some(Haze { share, rgb, pos, mat }) = scene.haze else {
        return [[[0.0, 0.0, 0.0, radius as f32], [0.0; 4], [0.0; 4]], [[0.0; 4]; 3]];
    };
    let axis = |k: usize| [mat[k], mat[3 + k], mat[6 + k]];
    let height: f64 = (0..3).map(|k| (scene.view.eye[k] - f64::from(pos[k])) * f64::from(axis(2)[k])).sum();
    let angle = atan(1.0 / f64::from(share));
    // Where the cone of haze is densest, as a share of the eye's height.
    let middle = sqrt(0.5) * f64::from(share) * sin(angle) / sin(0.75 * PI - angle);
    let row = |k: usize, w: f32| [axis(k)[0], axis(k)[1], axis(k)[2], w];
    let around = [row(0, radius as f32), row(1, height as f32), row(2, share)];
    [around, [[rgb[0], rgb[1], rgb[2], middle as f32], [0.0; 4], [0.0; 4]]]
}

/// Rows that take a point relative to `eye` to clip coordinates of a window of these sizes whose row 0 is its lowest.
pub fn clip_rows(projection: &Projection, eye: [f64; 3], [width, height]: [f64; 2]) -> [[f32; 4]; 4] {
    let [x, y, z, w] = projection.0;
    let columns = std::array::from_fn(|k| 2.0 * x[k] / width - w[k]);
    let rows = std::array::from_fn(|k| w[k] - 2.0 * y[k] / height);
    [columns, rows, z, w].map(|row| relative(row, eye))
}

/// A projection to a window of these sizes.
#[derive(Clone, Copy, Debug)]
pub struct Lens<'a> {
    /// To pixels from the lower left corner.
    pub projection: &'a Projection,
    /// Columns and rows \[pixel\].
    pub window: [f64; 2],
}

/// Columns that take a point which `map` moves first to clip coordinates, as [`clip_rows`] are.
pub fn clip_columns(lens: &Lens<'_>, map: &Affine) -> [[f32; 4]; 4] {
    let [x, y, z, w] = lens.projection.0;
    let columns = std::array::from_fn(|k| 2.0 * x[k] / lens.window[0] - w[k]);
    let rows = std::array::from_fn(|k| w[k] - 2.0 * y[k] / lens.window[1]);
    let rows: [[f64; 4]; 4] = [columns, rows, z, w];
    std::array::from_fn(|j| {
        rows.map(|row| {
            let moved = (0..3).map(|k| row[k] * map[k][j]).sum::<f64>();
            (moved + if j == 3 { row[3] } else { 0.0 }) as f32
        })
    })
}

/// A row for points relative to `eye`.
pub fn relative(row: [f64; 4], eye: [f64; 3]) -> [f32; 4] {
    let shift = row[3] + (0..3).map(|k| row[k] * eye[k]).sum::<f64>();
    [row[0] as f32, row[1] as f32, row[2] as f32, shift as f32]
}

/// A point relative to `eye`, moved by `map`.
pub fn moved(map: &Affine, point: [f64; 3], eye: [f64; 3]) -> [f32; 3] {
    std::array::from_fn(|i| {
        let row = map[i];
        ((0..3).map(|k| row[k] * point[k]).sum::<f64>() + row[3] - eye[i]) as f32
    })
}

/// Appends the lights of a picture as the shader reads them.
pub fn write_lights(scene: &Scene, out: &mut Vec<[f32; LIGHT_FLOATS]>) {
    let end = out.len() + LIGHTS;
    let eye = scene.view.eye;
    out.extend(scene.lights.iter().take(LIGHTS).map(|light| light_row(light, eye)));
    out.resize(end, [0.0; LIGHT_FLOATS]);
}

fn light_row(light: &Light, eye: [f64; 3]) -> [f32; LIGHT_FLOATS] {
    let (is_spot, cutoff, exponent, fall) = match light.kind {
        LightKind::Directional => (0.0, 180.0, 0.0, [1.0, 0.0, 0.0]),
        LightKind::Spot { cutoff, exponent, attenuation } => (1.0, cutoff, exponent, attenuation),
    };
    let cos_cutoff = if cutoff < 180.0 { cos(f64::from(cutoff).to_radians()) as f32 } else { -1.0 };
    let pos: [f32; 3] = std::array::from_fn(|k| (f64::from(light.pos[k]) - eye[k]) as f32);
    let mut row = [0.0; LIGHT_FLOATS];
    let parts = [
        (pos, is_spot),
        (light.dir, cos_cutoff),
        (light.ambient, exponent),
        (light.diffuse, fall[0]),
        (light.specular, fall[1]),
        ([fall[2], 0.0, 0.0], 0.0),
    ];
    for (four, (xyz, w)) in row.as_chunks_mut::<4>().0.iter_mut().zip(parts) {
        *four = [xyz[0], xyz[1], xyz[2], w];
    }
    row
}
