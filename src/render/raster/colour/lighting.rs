//! Light on corners: OpenGL's fixed-function lighting, eight corners at a time.
//!
//! c = emission base + g base + sum a (A base + max(N.L, 0) D base + \[N.L > 0\] max(N.H, 0)^(128 shininess) S specular),
//! clamped to \[0, 1\] for every corner and pass (OpenGL 2.1 specification, section 2.14.1, with a local viewer).

use super::power::power;
use crate::scene::{Item, Light, LightKind};
use wide::f32x8;

/// Three coordinates or colours of eight corners.
pub type Triple = [f32x8; 3];

/// Eight corners, world frame.
#[derive(Clone, Copy, Debug)]
pub struct Corners {
    /// Positions \[m\].
    pub position: Triple,
    /// Unit normals.
    pub normal: Triple,
}

/// How a surface answers light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Colour that ambient and diffuse light takes.
    pub base: [f32; 3],
    /// Opacity.
    pub alpha: f32,
    /// Light of its own, in units of the colour.
    pub emission: f32,
    /// Strength of highlights.
    pub specular: f32,
    /// Exponent of highlights.
    pub exponent: f32,
}

impl Material {
    /// The material of an item whose colour is scaled, as mirrors do.
    pub fn of(item: &Item, scale: f32, alpha: f32) -> Self {
        let [r, g, b, _] = item.rgba;
        Material {
            base: [r * scale, g * scale, b * scale],
            alpha,
            emission: item.look.emission,
            specular: item.look.specular,
            exponent: 128.0 * item.look.shininess,
        }
    }
}

/// A light in the form that corners need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp {
    light: Light,
    /// Cosine of a spot's half angle; -1 for all directions.
    cos_cutoff: f32,
}

impl Lamp {
    /// Prepares a light.
    pub fn new(light: &Light) -> Self {
        let cos_cutoff = match light.kind {
            LightKind::Spot { cutoff, .. } if cutoff < 180.0 => {
                physics::math::ops::cos(f64::from(cutoff).to_radians()) as f32
            }
            _ => -1.0,
        };
        Lamp { light: *light, cos_cutoff }
    }
}

/// Light that comes from everywhere, and from the material itself.
pub fn own_light(material: &Material, ambient: f32) -> Triple {
    material.base.map(|base| f32x8::splat(base * (material.emission + ambient)))
}

/// Adds what a lamp gives to eight corners seen from `eye`.
pub fn add_lamp(sum: &mut Triple, corners: &Corners, material: &Material, lamp: &Lamp, eye: [f32; 3]) {
    let light = &lamp.light;
    let (to_light, strength) = match light.kind {
        LightKind::Directional => (light.dir.map(|d| f32x8::splat(-d)), f32x8::ONE),
        LightKind::Spot { exponent, attenuation: [k0, k1, k2], .. } => {
            let away = subtract(light.pos.map(f32x8::splat), corners.position);
            let (to_light, distance) = unit(away);
            let fall = f32x8::splat(k0) + distance * (f32x8::splat(k1) + distance * f32x8::splat(k2));
            let along = f32x8::ZERO - dot(to_light, light.dir.map(f32x8::splat));
            let cone = power(share(along), exponent) / fall;
            (to_light, along.simd_lt(f32x8::splat(lamp.cos_cutoff)).select(f32x8::ZERO, cone))
        }
    };
    if !strength.simd_gt(f32x8::ZERO).any() {
        return;
    }
    let facing = dot(corners.normal, to_light);
    let lit = facing.simd_gt(f32x8::ZERO);
    let diffuse = lit.select(facing, f32x8::ZERO);
    let highlight = if material.specular > 0.0 && lit.any() {
        let (to_eye, _) = unit(subtract(eye.map(f32x8::splat), corners.position));
        let (half, _) = unit(std::array::from_fn(|k| to_light[k] + to_eye[k]));
        let shine = share(dot(corners.normal, half));
        lit.select(power(shine, material.exponent) * f32x8::splat(material.specular), f32x8::ZERO)
    } else {
        f32x8::ZERO
    };
    for k in 0..3 {
        let base = f32x8::splat(material.base[k]);
        let body = (f32x8::splat(light.ambient[k]) + diffuse * f32x8::splat(light.diffuse[k])) * base;
        sum[k] += strength * (body + highlight * f32x8::splat(light.specular[k]));
    }
}

/// Colours between 0 and 1.
pub fn clamped(colour: Triple) -> Triple {
    colour.map(share)
}

/// Numbers between 0 and 1; 0 for what is none. Selected, since the least and greatest of vectors have the sign of either zero,
/// as each processor does.
fn share(x: f32x8) -> f32x8 {
    let positive = x.simd_gt(f32x8::ZERO).select(x, f32x8::ZERO);
    positive.simd_lt(f32x8::ONE).select(positive, f32x8::ONE)
}

/// Vectors scaled to length 1, and their lengths before; zero vectors stay zero.
pub fn unit(v: Triple) -> (Triple, f32x8) {
    let length = dot(v, v).sqrt();
    let safe = length.simd_gt(f32x8::ZERO).select(length, f32x8::ONE);
    (v.map(|x| x / safe), length)
}

fn dot(a: Triple, b: Triple) -> f32x8 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn subtract(a: Triple, b: Triple) -> Triple {
    std::array::from_fn(|k| a[k] - b[k])
}

#[cfg(test)]
mod tests {
    use super::*;

    const MATERIAL: Material =
        Material { base: [0.8, 0.4, 0.2], alpha: 1.0, emission: 0.0, specular: 0.5, exponent: 64.0 };

    fn light(kind: LightKind) -> Light {
        Light {
            kind,
            pos: [0.0, 0.0, 2.0],
            dir: [0.0, 0.0, -1.0],
            ambient: [0.1; 3],
            diffuse: [0.5; 3],
            specular: [0.25; 3],
            shadow: false,
            headlight: false,
        }
    }

    /// The colour of a corner at the origin with its normal along +z.
    fn lit(light: Light, eye: [f32; 3]) -> [f32; 3] {
        let corners = Corners { position: [f32x8::ZERO; 3], normal: [f32x8::ZERO, f32x8::ZERO, f32x8::ONE] };
        let mut sum = [f32x8::ZERO; 3];
        add_lamp(&mut sum, &corners, &MATERIAL, &Lamp::new(&light), eye);
        sum.map(|c| c.to_array()[5])
    }

    #[test]
    fn a_light_above_gives_ambient_diffuse_and_highlight() {
        let [r, g, b] = lit(light(LightKind::Directional), [0.0, 0.0, 5.0]);
        for (found, base) in [(r, 0.8), (g, 0.4), (b, 0.2)] {
            assert!((found - (0.6 * base + 0.125)).abs() < 1e-6, "{found}");
        }
        // From the side the half vector is at 45 degrees: (cos 45)^64 is 2^-32.
        let side = lit(light(LightKind::Directional), [5.0, 0.0, 0.0]);
        assert!((side[0] - 0.48).abs() < 1e-6);
    }

    #[test]
    fn a_spot_falls_with_distance_and_ends_at_its_cone() {
        let spot = LightKind::Spot { cutoff: 30.0, exponent: 10.0, attenuation: [1.0, 0.5, 0.25] };
        let found = lit(light(spot), [5.0, 0.0, 0.0])[0];
        assert!((found - 0.48 / 3.0).abs() < 1e-6, "{found}");
        let mut aside = light(spot);
        aside.pos = [2.0, 0.0, 2.0];
        assert_eq!(lit(aside, [0.0, 0.0, 5.0]), [0.0; 3], "45 degrees off the axis");
    }

    #[test]
    fn what_faces_away_gets_ambient_light_alone() {
        let mut below = light(LightKind::Directional);
        below.dir = [0.0, 0.0, 1.0];
        assert!((lit(below, [0.0, 0.0, 5.0])[0] - 0.08).abs() < 1e-7);
    }
}
