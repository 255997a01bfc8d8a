//! Spatial tendons: taut along their path, or hanging as ropes.

use super::catenary::{MAX_POINTS, Rope};
use super::island;
use super::item::{Category, Shape};
use super::options::{LabelChoice, is_visible};
use super::sink::{Coat, Form, GREY, Items, Source, element};
use physics::math::{Vec3, norm};
use physics::model::bounds::MINVAL;
use physics::model::{ConstraintType, Disable, ObjType, TrnType};

/// Adds the visible tendons, one capsule for each stretch. Transparent ones stay: they cast shadows.
pub(super) fn tendons(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, options, .. } = from;
    if !from.shows(Category::Dynamic) || !options.show.tendons {
        return;
    }
    for i in 0..m.ntendon {
        if !is_visible(&options.groups.tendons, m.tendon_group[i]) {
            continue;
        }
        match rope(from, i) {
            None => taut(from, i, items),
            Some(rope) => slack(from, i, &rope, items),
        }
    }
}

/// One stretch of a tendon's path.
#[derive(Clone, Copy)]
pub(super) struct Stretch {
    /// Its ends, world frame \[m\].
    pub ends: [Vec3; 2],
    /// Radius with which it is drawn \[m\].
    pub width: f64,
    /// It is the first of its tendon.
    pub first: bool,
}

/// The stretches of a tendon; none where it passes a pulley. Inside a wrapped geom they are half as wide.
pub(super) fn stretches(from: Source<'_>, tendon: usize) -> impl Iterator<Item = Stretch> {
    let ten = &from.d.ten;
    let (start, count) = (ten.ten_wrapadr[tendon] as usize, ten.ten_wrapnum[tendon].max(0) as usize);
    let (objects, points) = (ten.wrap_obj.as_flattened(), ten.wrap_xpos.as_flattened().as_chunks::<3>().0);
    let width = from.m.tendon_width[tendon];
    (start..(start + count).saturating_sub(1))
        .filter(|&j| objects[j] != PULLEY && objects[j + 1] != PULLEY)
        .map(move |j| {
            let inside = objects[j] >= 0 && objects[j + 1] >= 0;
            Stretch {
                ends: [points[j], points[j + 1]],
                width: if inside { 0.5 * width } else { width },
                first: j == start,
            }
        })
}

/// What marks a pulley in a tendon's path.
const PULLEY: i32 = -2;

fn taut(from: Source<'_>, i: usize, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
    let mut rgba = m.tendon_rgba[i];
    if m.tendon_matid[i] == -1 && rgba == GREY {
        rgba = from.strained(rgba, ConstraintType::LimitTendon, i);
    }
    let mut coat = from.coat(m.tendon_matid[i], rgba, Category::Dynamic);
    if options.show.islands {
        let row = d.efc.tendon_efcadr.get(i).copied().unwrap_or(-1);
        coat = Coat { rgba: island::color(from.first_dof_of_row(row)), material: None, ..coat };
    }
    for stretch in stretches(from, i) {
        let form = Form::connector(Shape::Capsule, stretch.width, stretch.ends[0], stretch.ends[1]);
        let item = items.add(&form, coat, element(ObjType::Tendon, i), Category::Dynamic);
        if options.label == LabelChoice::Tendon && stretch.first {
            item.label = from.label(ObjType::Tendon, i);
        }
    }
}

impl Source<'_> {
    /// `rgba` mixed with the colour of constraints by the impedance of the active limit of joint or tendon `id`.
    pub fn strained(&self, rgba: [f32; 4], kind: ConstraintType, id: usize) -> [f32; 4] {
        let efc = &self.d.efc;
        let first = efc.ne + efc.nf;
        let limit =
            (first..first + efc.nl).rfind(|&k| efc.efc_type[k] == kind.code() && efc.efc_id[k] == id as i32);
        let share = limit.map_or(0.0, |k| efc.efc_KBIP[k][2]);
        let (plain, red) = (rgba, self.m.vis.rgba.constraint);
        let mix = |k: usize| ((1.0 - share) * f64::from(plain[k]) + share * f64::from(red[k])) as f32;
        [mix(0), mix(1), mix(2), rgba[3]]
    }
}

/// The rope that a tendon of two sites is when nothing but its greatest length holds it.
fn rope(from: Source<'_>, i: usize) -> Option<Rope> {
    let Source { m, d, .. } = from;
    let gravity = m.opt.gravity;
    if m.tendon_num[i] != 2 || m.opt.disableflags.contains(Disable::GRAVITY) || norm(gravity) <= MINVAL {
        return None;
    }
    let ([shortest, longest], [slack, spring]) = (m.tendon_range[i], m.tendon_lengthspring[i]);
    let stiff = m.tendon_stiffness[i] != 0.0 || m.tendon_stiffnesspoly[i] != [0.0; 2];
    let damped = m.tendon_damping[i] != 0.0 || m.tendon_dampingpoly[i] != [0.0; 2];
    let driven = (0..m.nactuator)
        .any(|a| m.actuator_trntype[a] == TrnType::Tendon.code() && m.actuator_trnid[a][0] == i as i32);
    if damped || m.tendon_frictionloss[i] != 0.0 || driven {
        return None;
    }
    let length = if stiff {
        (slack == 0.0 && spring > 0.0).then_some(spring)
    } else {
        (m.tendon_limited[i] && shortest == 0.0 && d.ten.ten_length[i] < longest).then_some(longest)
    }?;
    let points = d.ten.wrap_xpos.as_flattened().as_chunks::<3>().0;
    let start = d.ten.ten_wrapadr[i] as usize;
    Some(Rope { ends: [*points.get(start)?, *points.get(start + 1)?], length, gravity })
}

fn slack(from: Source<'_>, i: usize, rope: &Rope, items: &mut Items<'_>) {
    let Source { m, options, .. } = from;
    let coat = from.coat(m.tendon_matid[i], m.tendon_rgba[i], Category::Dynamic);
    let mut points = [[0.0; 3]; MAX_POINTS];
    let count = (m.vis.quality.numslices + 1).clamp(2, MAX_POINTS as i32) as usize;
    let count = rope.points(count, &mut points);
    for pair in points[..count].windows(2) {
        let form = Form::connector(Shape::Capsule, m.tendon_width[i], pair[0], pair[1]);
        let item = items.add(&form, coat, element(ObjType::Tendon, i), Category::Dynamic);
        if options.label == LabelChoice::Tendon {
            item.label = from.label(ObjType::Tendon, i);
        }
    }
}
