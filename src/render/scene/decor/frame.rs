//! Frames of bodies, geoms and sites.

use crate::scene::options::{FrameChoice, GROUPS, is_visible};
use crate::scene::sink::{Items, Source};
use physics::math::{Mat3, Vec3};

impl Source<'_> {
    /// Width and length of the axes of a frame \[m\].
    pub(super) fn axis_size(&self) -> [f64; 2] {
        let scale = &self.m.vis.scale;
        [self.size(scale.framewidth), self.size(scale.framelength)]
    }
}

/// What frames of geoms and of sites are made of.
struct Frames<'a> {
    body: &'a [i32],
    group: &'a [i32],
    visible: &'a [bool; GROUPS],
    material: &'a [i32],
    rgba: &'a [[f32; 4]],
    pos: &'a [Vec3],
    mat: &'a [Mat3],
}

/// Adds the frames of visible geoms or sites.
pub(super) fn of_geoms_and_sites(from: Source<'_>, items: &mut Items<'_>) {
    let (m, kin, groups) = (from.m, &from.d.kin, &from.options.groups);
    let frames = match from.options.frame {
        FrameChoice::Geom => Frames {
            body: &m.geom_bodyid,
            group: &m.geom_group,
            visible: &groups.geoms,
            material: &m.geom_matid,
            rgba: &m.geom_rgba,
            pos: &kin.geom_xpos,
            mat: &kin.geom_xmat,
        },
        FrameChoice::Site => Frames {
            body: &m.site_bodyid,
            group: &m.site_group,
            visible: &groups.sites,
            material: &m.site_matid,
            rgba: &m.site_rgba,
            pos: &kin.site_xpos,
            mat: &kin.site_xmat,
        },
        _ => return,
    };
    let [width, length] = from.axis_size();
    for (i, (&pos, mat)) in frames.pos.iter().zip(frames.mat).enumerate() {
        let rgba = usize::try_from(frames.material[i]).map_or(frames.rgba[i], |k| m.mat_rgba[k]);
        let visible = from.shows_body(frames.body[i]) && is_visible(frames.visible, frames.group[i]);
        if visible && rgba[3] != 0.0 {
            items.axes(width, length, pos, mat, i);
        }
    }
}

/// Adds the frames of bodies, or the world's frame, which is twice as large.
pub(super) fn of_bodies(from: Source<'_>, items: &mut Items<'_>) {
    let (m, kin) = (from.m, &from.d.kin);
    let (bodies, times) = match from.options.frame {
        FrameChoice::World => (0..1, 2.0),
        FrameChoice::Body => (1..m.nbody, 1.0),
        _ => return,
    };
    let (pos, mat) =
        if from.options.show.inertias { (&kin.xipos, &kin.ximat) } else { (&kin.xpos, &kin.xmat) };
    let [width, length] = from.axis_size();
    for i in bodies.filter(|&i| i == 0 || from.shows_body(i as i32)) {
        items.axes(width * times, length * times, pos[i], &mat[i], i);
    }
}
