//! Shadows: which fragments a lamp reaches.
//!
//! MuJoCo draws a depth map of `shadowsize` texels a side from every lamp and looks each fragment up in its nearest texel. Here
//! only the texels that fragments ask for exist (`texels`), and casters are compared with them. The answers equal those of a
//! whole map. Pictures of one state ask together, so that every caster is projected once for all of them.
//!
//! Depth here is u = 0 at the near plane and 1 at the far one, so that what is near keeps its bits.

use super::coverage::{Extent, Pattern, Target};
use super::draws::{Draw, Draws};
use super::layer::{Layer, Lens, Sides, facing};
use super::texels::Texels;
use super::window::Projection;
use crate::geometry::Assets;
use crate::profile::Profile;
use crate::scene::{Light, LightKind, Scene};
use physics::math::ops::tan;
use physics::math::{cross, dot};
use std::ops::Range;

/// Texels left free at every side of the map.
const MARGIN: f64 = 1.0;
/// How casters are drawn into a shadow map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CasterRule {
    /// Only what faces away from the lamp is.
    pub averted: bool,
    /// Added to their depth, in slopes a texel.
    pub slopes: f32,
    /// Added to their depth.
    pub constant: f32,
}

impl CasterRule {
    /// That of a version of MuJoCo. `glPolygonOffset` of -1.5 and -4 in 3.12; pictures of Mesa fit best where its unit is
    /// two steps of the map's 24 bits. MuJoCo 3.1.3 draws what faces away from the lamp, as it is.
    pub fn of(profile: Profile) -> Self {
        match profile {
            Profile::Mujoco312 => CasterRule { averted: false, slopes: 1.5, constant: 8.0 / 16_777_216.0 },
            Profile::Mujoco313 => CasterRule { averted: true, slopes: 0.0, constant: 0.0 },
        }
    }
}

/// Widest full angle of a spot's map [deg].
const WIDEST: f32 = 160.0;

/// What every shadow of a scene needs beside its lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadowSettings {
    /// Texels along a side of the map, at most 8192; none is drawn for 0.
    pub size: usize,
    /// Half the width of the map of a directional light [m].
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

/// A point that a lamp may reach.
#[derive(Clone, Copy, Debug)]
pub struct Question {
    /// Which picture asks. Questions of one picture follow each other.
    pub view: u32,
    /// What the picture calls it.
    pub name: u32,
    /// Where it is, world frame [m].
    pub position: [f32; 3],
}

/// Which points a lamp reaches.
#[derive(Clone, Debug, Default)]
pub struct Shadows {
    layer: Layer,
    texels: Texels,
}

/// What casts shadows from one lamp.
#[derive(Clone, Copy)]
pub struct Casting<'a> {
    /// Triangles.
    pub assets: &'a Assets,
    /// The surfaces of each picture. Shared surfaces stand in the first picture alone.
    pub draws: &'a [Draws],
    /// The lamp's maps.
    pub maps: Maps,
    /// Texels along a side of the map.
    pub size: usize,
}

impl Shadows {
    /// Keeps the questions whose points the lamp reaches past the draws that `casters` picks.
    pub fn cast(
        &mut self,
        casting: &Casting<'_>,
        casters: impl Fn(&Draw) -> bool,
        questions: &mut Vec<Question>,
    ) {
        if questions.is_empty() {
            return;
        }
        self.texels.ask(&casting.maps.lookups, casting.size, questions);
        if self.texels.any() {
            self.draw_casters(casting, 0, |draw| draw.shared && casters(draw), 0..questions.len());
            for (view, draws) in casting.draws.iter().enumerate() {
                let own = |draw: &Draw| !draw.shared && casters(draw);
                if draws.list.iter().any(own) {
                    let first = questions.partition_point(|question| (question.view as usize) < view);
                    let end = questions.partition_point(|question| question.view as usize <= view);
                    self.draw_casters(casting, view, own, first..end);
                }
            }
        }
        self.texels.keep_reached(questions);
    }

    /// Compares casters of a picture with the texels that some of the questions ask for.
    fn draw_casters(
        &mut self,
        casting: &Casting<'_>,
        view: usize,
        casters: impl Fn(&Draw) -> bool,
        questions: Range<usize>,
    ) {
        let Casting { assets, draws, maps, size } = *casting;
        let Shadows { layer, texels: Texels { grid, sorted, .. } } = self;
        let rule = CasterRule::of(assets.profile());
        let lens = Lens {
            projection: maps.casters,
            extent: Extent { width: size as i32, height: size as i32 },
            region: grid.region,
            deepest: grid.deepest,
            mirror: None,
            sides: if rule.averted { Sides::Averted } else { Sides::Both },
        };
        layer.update(assets, &draws[view], &lens, |draw| draw.casts && casters(draw));
        let questions = questions.start as u32..questions.end as u32;
        for (index, draw) in draws[view].list.iter().enumerate() {
            let target = Target::new(Pattern::CENTER, facing(draw, &lens), &lens.region);
            layer.corners(
                assets,
                (index, draw),
                &lens,
                |reached| grid.has_deeper(reached),
                |_, corners| grid.shade(corners, &target, rule, (&questions, sorted)),
            );
        }
    }
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
