//! Casters are compared with the texels that fragments ask for.

use super::maps::Maps;
use super::rule::CasterRule;
use super::texels::{Question, Texels};
use crate::geometry::Assets;
use crate::raster::draws::{Draw, Draws};
use crate::raster::layer::{Layer, facing};
use crate::raster::lines::strip;
use crate::raster::window::coverage::{Extent, Facing, Pattern, Target};
use crate::raster::window::lens::{Lens, Sides};
use std::ops::Range;

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
    /// The surfaces of each picture; shared ones are in the first.
    pub draws: &'a [Draws],
    /// The lamp's maps.
    pub maps: Maps,
    /// Texels along a side of the map.
    pub size: usize,
    /// Width of the lines that outline triangles \[texel\]; none where they are filled.
    pub wire: Option<f32>,
}

impl Shadows {
    /// Keeps the `questions` that the lamp reaches past the draws that `casters` picks.
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
        let Casting { assets, draws, maps, size, wire } = *casting;
        let Shadows { layer, texels: Texels { grid, sorted, .. } } = self;
        let rule = CasterRule::of(assets.profile());
        let lens = Lens {
            projection: maps.casters,
            extent: Extent { width: size as i32, height: size as i32 },
            region: grid.region,
            deepest: grid.deepest,
            mirror: None,
            sides: if rule.averted { Sides::Averted } else { Sides::Both },
            wire,
        };
        layer.update(assets, &draws[view], &lens, |draw| draw.casts && casters(draw));
        let questions = questions.start as u32..questions.end as u32;
        for (index, draw) in draws[view].list.iter().enumerate() {
            if let Some(width) = wire {
                let target = Target::new(Pattern::CENTER, Facing::Both, &lens.region);
                layer.outlines(assets, (index, draw), &lens, |_, ends| {
                    for corners in strip(ends, width, &Pattern::CENTER) {
                        grid.shade(&corners, &target, rule.of_lines(), (&questions, sorted));
                    }
                });
                continue;
            }
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
