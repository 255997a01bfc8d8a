//! The colour of a fragment: light times texture, in eight bits.

use super::seen::{Fragment, Seen, SeenTriangle};
use crate::geometry::{Assets, Paint};
use crate::raster::window::projection::Affine;
use crate::scene::Fog;
use wide::f32x4;

/// Opacity from which on a fragment takes the light of lamps that cast shadows; the others light it whatever it is. MuJoCo's
/// 0.99, as Mesa compares it in eight bits.
const SOLID: u8 = 252;

/// A colour and its opacity in eight bits each.
pub type Rgba = [u8; 4];

/// What fades with distance.
#[derive(Clone, Copy, Debug)]
pub struct Veil {
    fog: Fog,
    /// Distance from the eye's plane as a function of a point of the world.
    depth: [f32; 4],
}

impl Veil {
    /// Fog seen along `forward` from `eye`.
    pub fn new(fog: Fog, eye: [f64; 3], forward: [f64; 3]) -> Self {
        let shift = -(0..3).map(|k| eye[k] * forward[k]).sum::<f64>();
        Veil { fog, depth: [forward[0], forward[1], forward[2], shift].map(|x| x as f32) }
    }

    /// The same for points that are seen where `mirror` moves them.
    pub fn mirrored(fog: Fog, eye: [f64; 3], forward: [f64; 3], mirror: &Affine) -> Self {
        let row = |j: usize| (0..3).map(|i| forward[i] * mirror[i][j]).sum::<f64>();
        let shift = (0..3).map(|i| forward[i] * (mirror[i][3] - eye[i])).sum::<f64>();
        Veil { fog, depth: [row(0), row(1), row(2), shift].map(|x| x as f32) }
    }

    /// Share of its own colour that is left of a point of a triangle. Distances of the corners count as positive, those behind
    /// the eye too, as in Mesa: between them the distance is interpolated.
    fn clear(&self, triangle: &SeenTriangle, weights: [f32; 3]) -> f32 {
        let away = |p: [f32; 3]| ((0..3).map(|k| self.depth[k] * p[k]).sum::<f32>() + self.depth[3]).abs();
        self.fog.clearness(triangle.mean(weights, away))
    }
}

/// What shading needs beside the triangles.
#[derive(Clone, Copy)]
pub struct Brush<'a> {
    /// Textures.
    pub assets: &'a Assets,
    /// Fog, where there is any.
    pub veil: Option<Veil>,
}

impl Brush<'_> {
    /// The texture's colour at the middle of a fragment's pixel, where the surface has a texture.
    #[inline]
    fn texel(
        &self,
        triangle: &SeenTriangle,
        paint: &Paint,
        fragment: &Fragment,
        weights: [f32; 3],
    ) -> Option<f32x4> {
        let (texture, cube) = match *paint {
            Paint::Plain => return None,
            Paint::Explicit { texture, .. } | Paint::Planar { texture, .. } => (texture, false),
            Paint::Cube { texture, .. } => (texture, true),
        };
        let texture = self.assets.textures.get(texture)?;
        // Differences within the aligned square of four pixels that this one belongs to.
        let corner = |x: u16, y: u16| {
            triangle.texture(
                triangle
                    .weights(f32::from((fragment.x & !1) + x) + 0.5, f32::from((fragment.y & !1) + y) + 0.5),
            )
        };
        let (origin, right, above) = (corner(0, 0), corner(1, 0), corner(0, 1));
        let three = |v: f32x4| {
            let [x, y, z, _] = v.to_array();
            [x, y, z]
        };
        let (here, across, up) =
            (three(triangle.texture(weights)), three(right - origin), three(above - origin));
        Some(f32x4::new(if cube {
            texture.sample_cube(here, texture.lod_cube(three(origin), across, up))
        } else {
            texture.sample_2d(here[0], here[1], texture.lod_2d(across[0], across[1], up[0], up[1]))
        }))
    }

    /// The colour of a fragment under the lamps without shadows and those with shadows that reach it.
    #[inline]
    pub fn colour(&self, seen: &Seen, paint: &Paint, alpha: f32, fragment: &Fragment) -> Rgba {
        let shade = self.shade(seen, paint, fragment);
        let mut sum = shade.pass(0, alpha * shade.opacity());
        let mut lit = if sum[3] < SOLID { 0 } else { fragment.lit };
        while lit != 0 {
            sum = added(sum, shade.pass(1 + lit.trailing_zeros() as usize, 0.0));
            lit &= lit - 1;
        }
        sum
    }

    /// The colours of an opaque fragment under the lamps without shadows and under each of the others, `passes` in all.
    pub fn passes(
        &self,
        seen: &Seen,
        paint: &Paint,
        fragment: &Fragment,
        passes: usize,
        out: &mut Vec<Rgba>,
    ) {
        let shade = self.shade(seen, paint, fragment);
        let lit = if eight_bits(shade.opacity()) < SOLID { 1 } else { passes };
        out.extend((0..lit).map(|pass| shade.pass(pass, 1.0)));
        out.extend((lit..passes).map(|_| [0, 0, 0, 255]));
    }

    #[inline]
    fn shade<'a>(&self, seen: &'a Seen, paint: &Paint, fragment: &Fragment) -> Shade<'a> {
        let triangle = &seen.triangles[fragment.triangle as usize];
        let weights = triangle.weights(f32::from(fragment.x) + 0.5, f32::from(fragment.y) + 0.5);
        let texel = self.texel(triangle, paint, fragment, weights);
        let fog = self.veil.map(|veil| (veil.clear(triangle, weights), veil.fog.rgb));
        Shade { seen, triangle, weights, texel, fog }
    }
}

/// A fragment about to be painted.
struct Shade<'a> {
    seen: &'a Seen,
    triangle: &'a SeenTriangle,
    weights: [f32; 3],
    texel: Option<f32x4>,
    /// Share of its own colour that fog leaves, and the fog's.
    fog: Option<(f32, [f32; 3])>,
}

impl Shade<'_> {
    /// The texture's.
    #[inline]
    fn opacity(&self) -> f32 {
        self.texel.map_or(1.0, |texel| texel.to_array()[3])
    }

    /// The colour that a pass gives, with an opacity. Fog is black in all but the first, as these are added.
    #[inline]
    fn pass(&self, pass: usize, opacity: f32) -> Rgba {
        let mut c = self.seen.colour(self.triangle, self.weights, pass);
        if let Some(texel) = self.texel {
            c *= texel;
        }
        if let Some((clear, [r, g, b])) = self.fog {
            let fog = if pass == 0 { f32x4::new([r, g, b, 0.0]) } else { f32x4::ZERO };
            c = f32x4::splat(clear) * c + f32x4::splat(1.0 - clear) * fog;
        }
        // The last lane is 0 up to here.
        bytes(c + f32x4::new([0.0, 0.0, 0.0, opacity]))
    }
}

/// Four numbers as bytes, each as [`eight_bits`] rounds it.
#[inline]
fn bytes(colour: f32x4) -> Rgba {
    let (least, most) = (f32x4::ZERO, f32x4::splat(255.0));
    let steps = most * colour + f32x4::splat(0.5);
    // Selected, so that what is not a number becomes 0.
    let steps = steps.simd_gt(least).select(steps, least);
    let steps = steps.simd_lt(most).select(steps, most);
    steps.fast_trunc_int().to_array().map(|step| step as u8)
}

/// The sum of two colours, at most white.
#[inline]
pub fn added(a: Rgba, b: Rgba) -> Rgba {
    std::array::from_fn(|k| a[k].saturating_add(b[k]))
}

/// A number from 0 to 1 as a byte.
#[inline]
pub fn eight_bits(x: f32) -> u8 {
    (255.0 * x + 0.5) as u8
}

/// Colours of all samples of a window, four a group as in its visibility.
#[derive(Clone, Debug, Default)]
pub struct Canvas {
    /// The samples.
    pub groups: Vec<[Rgba; 4]>,
}

impl Canvas {
    /// A black window of `groups` groups.
    pub fn clear(&mut self, groups: usize) {
        self.groups.clear();
        self.groups.resize(groups, [[0; 4]; 4]);
    }

    /// Gives the samples of a fragment a colour.
    #[inline]
    pub fn set(&mut self, fragment: &Fragment, colour: Rgba) {
        let samples = &mut self.groups[fragment.group as usize];
        if fragment.lanes == 0b1111 {
            *samples = [colour; 4];
            return;
        }
        for (lane, sample) in samples.iter_mut().enumerate() {
            *sample = if fragment.lanes >> lane & 1 != 0 { colour } else { *sample };
        }
    }

    /// Changes the samples of a fragment.
    #[inline]
    pub fn touch(&mut self, fragment: &Fragment, change: impl Fn(Rgba) -> Rgba) {
        for (lane, sample) in self.groups[fragment.group as usize].iter_mut().enumerate() {
            if fragment.lanes >> lane & 1 != 0 {
                *sample = change(*sample);
            }
        }
    }
}

/// A colour laid over another with its opacity, in arithmetic of eight bits.
#[inline]
pub fn over(top: Rgba, below: Rgba) -> Rgba {
    let alpha = top[3];
    let mix = |k: usize| product(top[k], alpha).saturating_add(product(below[k], 255 - alpha));
    [mix(0), mix(1), mix(2), below[3]]
}

/// A colour added to another, weakened by its opacity.
#[inline]
pub fn onto(top: Rgba, below: Rgba) -> Rgba {
    let mix = |k: usize| product(top[k], top[3]).saturating_add(below[k]);
    [mix(0), mix(1), mix(2), below[3]]
}

/// The product of two numbers from 0 to 1, in eight bits.
#[inline]
fn product(a: u8, b: u8) -> u8 {
    let t = u32::from(a) * u32::from(b) + 128;
    ((t + (t >> 8)) >> 8) as u8
}
