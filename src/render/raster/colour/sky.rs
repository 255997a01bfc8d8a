//! What surrounds the items: the sky, and haze over the horizon.

use super::paint::{Canvas, Rgba, eight_bits, over};
use super::shares::shares;
use crate::raster::visibility::Visibility;
use crate::raster::window::clip::clip;
use crate::raster::window::coverage::{Extent, Facing, Pattern, Target, Triangle};
use crate::raster::window::projection::Projection;
use crate::raster::window::vertices::inside;
use crate::scene::{Haze, Scene};
use crate::texture::Texture;
use crate::view::View;
use physics::math::ops::{atan, atan2, cos, sin, sqrt};
use std::f64::consts::PI;
use wide::f32x4;

/// Radius and half height of the sky, in units of the far plane's distance.
const DISTANCE: f64 = 0.7;

/// What a view has shown of its sky.
#[derive(Clone, Debug, Default)]
pub struct Sky {
    /// The texture, where anything is kept.
    texture: Option<usize>,
    /// Colours of the pixels, row by row from below; transparent where they are not known.
    pixels: Vec<Rgba>,
}

impl Sky {
    /// Makes room for the pixels of a window, whose sky has a texture; keeps nothing where there is no window.
    pub fn hold(&mut self, texture: usize, window: Option<Extent>) {
        let kept = window.map(|_| texture);
        if kept.is_none() || self.texture != kept {
            let pixels = window.map_or(0, |window| window.width as usize * window.height as usize);
            self.pixels.clear();
            self.pixels.resize(pixels, [0; 4]);
        }
        self.texture = kept;
    }

    /// Keeps nothing of what has been shown.
    pub fn forget(&mut self) {
        self.texture = None;
    }

    /// The colour of a pixel, which `find` finds where it is not known.
    fn colour(&mut self, pixel: usize, find: impl FnOnce() -> Rgba) -> Rgba {
        match self.pixels.get_mut(pixel) {
            Some(known) if known[3] != 0 => *known,
            Some(unknown) => {
                *unknown = find();
                *unknown
            }
            None => find(),
        }
    }
}

/// The window and the view that surroundings are drawn for.
pub struct Surroundings<'a> {
    /// What is seen so far.
    pub visibility: &'a Visibility,
    /// From the world to the window.
    pub projection: &'a Projection,
    /// Size of the window \[pixel\].
    pub extent: Extent,
    /// The scene.
    pub scene: &'a Scene,
    /// Slices of round shapes.
    pub slices: usize,
}

impl Surroundings<'_> {
    /// Paints the sky where nothing is nearer.
    pub fn sky(&self, texture: &Texture, known: &mut Sky, canvas: &mut Canvas) {
        let view = &self.scene.view;
        let rays = Rays::new(self.projection, view.forward);
        let radius = DISTANCE * view.frustum.far;
        let Visibility { pattern, per_row, groups } = self.visibility;
        let (near, far) = (view.frustum.near, view.frustum.far);
        let reversed = |distance: f64| near * (far - distance) / (distance * (far - near));
        let hidden = reversed(0.5 * radius);
        let nearer = f32x4::splat((hidden as f32).next_up());
        let width = self.extent.width as usize;
        let groups = groups.iter().zip(&mut canvas.groups);
        for (index, (group, samples)) in
            groups.enumerate().filter(|(_, (group, _))| !group.depth.simd_gt(nearer).all())
        {
            let (y, column) = (index / per_row, index % per_row);
            let mut colour = |x: usize| {
                known.colour(y * width + x, || self.sky_in(texture, &rays, [x as f64 + 0.5, y as f64 + 0.5]))
            };
            let depths = group.depth.to_array();
            if *pattern == Pattern::FOUR && depths == [0.0; 4] {
                *samples = [colour(column); 4];
                continue;
            }
            for (lane, (depth, sample)) in depths.into_iter().zip(samples).enumerate() {
                let x = column * pattern.pixels_in_group() as usize + pattern.pixel_of(lane) as usize;
                // Up to half of the sky's least distance everything hides it.
                if x >= width || f64::from(depth) > hidden {
                    continue;
                }
                let direction = || rays.direction(x as f64 + 0.5, y as f64 + 0.5);
                let open = depth == 0.0 || depth < reversed(wall(direction(), radius, self.slices)) as f32;
                if open {
                    *sample = colour(x);
                }
            }
        }
    }

    /// The sky in a point of the window, behind fog.
    fn sky_in(&self, texture: &Texture, rays: &Rays, at: [f64; 2]) -> Rgba {
        let own = sky_colour(texture, rays, at);
        let veiled = self.scene.fog.map_or(own, |fog| {
            let radius = DISTANCE * self.scene.view.frustum.far;
            let away = wall(rays.direction(at[0], at[1]), radius, self.slices);
            fog.over(fog.clearness(away as f32), own)
        });
        let [r, g, b] = veiled.map(eight_bits);
        [r, g, b, 255]
    }

    /// Lays haze over the horizon of an infinite plane.
    pub fn haze(&self, haze: &Haze, canvas: &mut Canvas) {
        let view = &self.scene.view;
        let radius = DISTANCE * view.frustum.far;
        let axis = |k: usize| [haze.mat[k], haze.mat[3 + k], haze.mat[6 + k]].map(f64::from);
        let up = axis(2);
        let height: f64 = (0..3).map(|k| (view.eye[k] - f64::from(haze.pos[k])) * up[k]).sum();
        if height < 0.0 {
            return;
        }
        let share = f64::from(haze.share);
        let angle = atan(1.0 / share);
        let middle = sqrt(0.5) * share * sin(angle) / sin(0.75 * PI - angle);
        // A point of the cone at a height from 0 on the plane to 1 at the eye.
        let point = |slice: usize, level: f64| {
            let turn = 2.0 * PI * slice as f64 / self.slices as f64;
            let reach = radius * (1.0 - share * (1.0 - level));
            let (x, y) = (reach * cos(turn), reach * sin(turn));
            let rise = height * (level - 1.0);
            std::array::from_fn(|k| view.eye[k] + x * axis(0)[k] + y * axis(1)[k] + rise * up[k])
        };
        for (low, high) in [(0.0, middle), (middle, 1.0)] {
            let (from, to) = if low == 0.0 { (0.0, 1.0) } else { (1.0, 0.0) };
            for slice in 0..self.slices {
                let a = (point(slice, low), from);
                let b = (point(slice + 1, low), from);
                let c = (point(slice + 1, high), to);
                let d = (point(slice, high), to);
                self.blend([a, b, d], haze, canvas);
                self.blend([b, c, d], haze, canvas);
            }
        }
    }

    /// Blends a triangle of haze whose corners have their own opacity.
    fn blend(&self, corners: [([f64; 3], f32); 3], haze: &Haze, canvas: &mut Canvas) {
        let window = corners.map(|(p, _)| {
            self.projection.0.map(|row| (row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]) as f32)
        });
        let [r, g, b] = haze.rgb.map(eight_bits);
        let View { eye, forward, .. } = self.scene.view;
        let away = corners.map(|(p, _)| (0..3).map(|k| forward[k] * (p[k] - eye[k])).sum::<f64>() as f32);
        let Visibility { pattern, per_row, groups } = self.visibility;
        let middle = [0.5 * self.extent.width as f32, 0.5 * self.extent.height as f32];
        let shares = shares(window, middle);
        let target = Target::new(*pattern, Facing::Both, &self.extent.region());
        for piece in clip(window.map(|[x, y, z, w]| [x, y, z, w, 1.0])).triangles() {
            let v = piece.map(|corner| inside(&corner));
            let Some(triangle) = Triangle::new(&v, &target) else {
                continue;
            };
            triangle.cover(pattern, |row, column, mask, depth| {
                let index = row * per_row + column;
                let (mask, depth, below) =
                    (mask.to_array(), depth.to_array(), groups[index].depth.to_array());
                for lane in 0..4 {
                    if mask[lane] == 0 || depth[lane] < below[lane] {
                        continue;
                    }
                    let x = column as i32 * pattern.pixels_in_group() + pattern.pixel_of(lane);
                    let (x, y) = (x as f32 + 0.5 - middle[0], row as f32 + 0.5 - middle[1]);
                    let e = shares.map(|[a, b, c]| a * x + b * y + c);
                    let mean =
                        |at: [f32; 3]| (0..3).map(|k| e[k] * at[k]).sum::<f32>() / (e[0] + e[1] + e[2]);
                    let [r, g, b] = self.scene.fog.map_or([r, g, b], |fog| {
                        fog.over(fog.clearness(mean(away)), haze.rgb).map(eight_bits)
                    });
                    let alpha = mean(corners.map(|(_, alpha)| alpha));
                    let colour = [r, g, b, eight_bits(alpha.clamp(0.0, 1.0))];
                    let sample = &mut canvas.groups[index][lane];
                    *sample = over(colour, *sample);
                }
            });
        }
    }
}

/// Distance along a ray of length 1 along the gaze to a cylinder of flat slices about the eye.
fn wall(direction: [f64; 3], radius: f64, slices: usize) -> f64 {
    let [x, y, z] = direction;
    let level = sqrt(x * x + y * y);
    let half = PI / slices as f64;
    let turn = atan2(y, x);
    let within = turn - 2.0 * half * (turn / (2.0 * half)).floor() - half;
    let side = radius * cos(half) / cos(within);
    if z.abs() * side > radius * level { radius / z.abs() } else { side / level }
}

/// The sky in the middle of a pixel.
fn sky_colour(texture: &Texture, rays: &Rays, [x, y]: [f64; 2]) -> [f32; 3] {
    // The sky turns its y axis up.
    let look = |x: f64, y: f64| {
        let [a, b, c] = rays.direction(x, y);
        [a, c, -b].map(|x| x as f32)
    };
    let (left, below) = (2.0 * (0.5 * (x - 0.5)).floor() + 0.5, 2.0 * (0.5 * (y - 0.5)).floor() + 0.5);
    let (origin, right, above) = (look(left, below), look(left + 1.0, below), look(left, below + 1.0));
    let across = std::array::from_fn(|k| right[k] - origin[k]);
    let up = std::array::from_fn(|k| above[k] - origin[k]);
    let lod = texture.lod_cube(origin, across, up);
    let [r, g, b, _] = texture.sample_cube(look(x, y), lod);
    [r, g, b]
}

/// Directions of the world that the pixels of a window look in.
struct Rays {
    /// What multiplies column, row and 1.
    columns: [[f64; 3]; 3],
}

impl Rays {
    fn new(projection: &Projection, forward: [f64; 3]) -> Self {
        let [x, y, _, w] = projection.0.map(|row| [row[0], row[1], row[2]]);
        if w == [0.0; 3] {
            return Rays { columns: [[0.0; 3], [0.0; 3], forward] };
        }
        let cross = |a: [f64; 3], b: [f64; 3]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let normals = [cross(y, w), cross(w, x), cross(x, y)];
        let determinant: f64 = (0..3).map(|k| x[k] * normals[0][k]).sum();
        Rays { columns: normals.map(|n| n.map(|c| c / determinant)) }
    }

    /// Direction through a point of the window \[pixel\], of length 1 along the gaze.
    fn direction(&self, x: f64, y: f64) -> [f64; 3] {
        let [a, b, c] = self.columns;
        std::array::from_fn(|k| a[k] * x + b[k] * y + c[k])
    }
}
