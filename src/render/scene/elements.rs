//! Flexes, skins, geoms and sites.

use super::item::{Category, Shape};
use super::options::{LabelChoice, is_visible};
use super::sink::{Form, Items, Source, UPRIGHT, element};
use crate::RenderError;
use physics::Model;
use physics::math::{Vec3, add_scaled, column, dot, sub};
use physics::model::{GeomType, ObjType};

/// Adds the visible flexes, at their first vertices.
pub(super) fn flexes(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
    let show = &options.show;
    let draws = show.flex_vertices || show.flex_edges || show.flex_faces || show.flex_skins;
    if !from.shows(Category::Dynamic) || !draws {
        return;
    }
    for i in 0..m.nflex {
        if !is_visible(&options.groups.flexes, m.flex_group[i]) {
            continue;
        }
        let coat = from.coat(m.flex_matid[i], m.flex_rgba[i], Category::Dynamic);
        let mut coat = from.island_coat(first_moving_body(m, i), coat);
        if m.flex_texcoordadr[i] < 0 {
            coat.material = None;
        }
        if coat.rgba[3] == 0.0 {
            continue;
        }
        let pos = d.flex.flexvert_xpos[m.flex_vertadr[i] as usize];
        let size = [m.flex_radius[i], 0.1, 0.1];
        let form = Form { shape: Shape::Flex { flex: i }, size, pos, mat: UPRIGHT };
        let item = items.add(&form, coat, element(ObjType::Flex, i), Category::Dynamic);
        item.rbound = 0.0;
        if options.label == LabelChoice::Flex {
            item.label = from.label(ObjType::Flex, i);
        }
    }
}

/// The first body of a flex that moves; the world where none does.
fn first_moving_body(m: &Model, flex: usize) -> i32 {
    let (all, first, count) = match m.flex_interp[flex] {
        0 => (&m.flex_vertbodyid[..], m.flex_vertadr[flex], m.flex_vertnum[flex]),
        _ => (&m.flex_nodebodyid[..], m.flex_nodeadr[flex], m.flex_nodenum[flex]),
    };
    let bodies = &all[first as usize..(first + count) as usize];
    bodies.iter().copied().find(|&body| body >= 0 && m.body_treeid[body as usize] >= 0).unwrap_or(0)
}

/// Adds the visible skins, at their first bones.
pub(super) fn skins(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
    if !from.shows(Category::Dynamic) || !options.show.skins {
        return;
    }
    for i in 0..m.nskin {
        let coat = from.coat(m.skin_matid[i], m.skin_rgba[i], Category::Dynamic);
        if !is_visible(&options.groups.skins, m.skin_group[i]) || coat.rgba[3] == 0.0 {
            continue;
        }
        let bone = m.skin_bonebodyid[m.skin_boneadr[i] as usize] as usize;
        let form =
            Form { shape: Shape::Skin { skin: i }, size: [0.1; 3], pos: d.kin.xpos[bone], mat: UPRIGHT };
        let item = items.add(&form, coat, element(ObjType::Skin, i), Category::Dynamic);
        item.rbound = 0.0;
        if options.label == LabelChoice::Skin {
            item.label = from.label(ObjType::Skin, i);
        }
    }
}

/// Adds the visible geoms; `eye` is where infinite planes are centred \[m\].
pub(super) fn geoms(from: Source<'_>, eye: Vec3, items: &mut Items<'_>) -> Result<(), RenderError> {
    let Source { m, options, appearance, .. } = from;
    for i in 0..m.ngeom {
        let category = from.category(m.geom_bodyid[i] as usize);
        if !from.shows(category) || !is_visible(&options.groups.geoms, m.geom_group[i]) {
            continue;
        }
        let rgba = appearance.colour_of(i).unwrap_or(m.geom_rgba[i]);
        let coat = from.coat(m.geom_matid[i], rgba, category);
        let mut coat = from.island_coat(m.geom_bodyid[i], coat);
        if coat.rgba[3] == 0.0 {
            continue;
        }
        coat.look.emission += from.glow(m.geom_bodyid[i]);
        let item = items.add(&form(from, i, eye)?, coat, element(ObjType::Geom, i), category);
        item.rbound = m.geom_rbound[i] as f32;
        if options.label == LabelChoice::Geom {
            item.label = from.label(ObjType::Geom, i);
        }
    }
    Ok(())
}

/// Adds the visible sites.
pub(super) fn sites(from: Source<'_>, items: &mut Items<'_>) -> Result<(), RenderError> {
    let Source { m, d, options, .. } = from;
    for i in 0..m.nsite {
        let category = from.category(m.site_bodyid[i] as usize);
        if !from.shows(category) || !is_visible(&options.groups.sites, m.site_group[i]) {
            continue;
        }
        let mut coat = from.coat(m.site_matid[i], m.site_rgba[i], category);
        if coat.rgba[3] == 0.0 {
            continue;
        }
        coat.look.emission += from.glow(m.site_bodyid[i]);
        let (pos, mat) = (d.kin.site_xpos[i], &d.kin.site_xmat[i]);
        let form = Form::primitive(m.site_type[i], m.site_size[i], pos, mat)
            .ok_or_else(|| shapeless(from, ObjType::Site, i))?;
        let item = items.add(&form, coat, element(ObjType::Site, i), category);
        if options.label == LabelChoice::Site {
            item.label = from.label(ObjType::Site, i);
        }
    }
    Ok(())
}

impl Source<'_> {
    /// Emission that is added to what belongs to the selected body.
    pub fn glow(&self, body: i32) -> f32 {
        let selected = self.options.selection.is_some_and(|s| s.body > 0 && s.body == body as usize);
        if selected { self.m.vis.global.glow } else { 0.0 }
    }
}

fn shapeless(from: Source<'_>, kind: ObjType, id: usize) -> RenderError {
    RenderError::Model { message: format!("{} has no shape that can be drawn", from.m.label_of(kind, id)) }
}

/// Shape and place of a geom.
fn form(from: Source<'_>, i: usize, eye: Vec3) -> Result<Form, RenderError> {
    let Source { m, d, .. } = from;
    let (size, pos, mat) = (m.geom_size[i], d.kin.geom_xpos[i], &d.kin.geom_xmat[i]);
    if let Some(form) = Form::primitive(m.geom_type[i], size, pos, mat) {
        return Ok(form);
    }
    let data = usize::try_from(m.geom_dataid[i]).ok();
    let shape = match (GeomType::from_code(m.geom_type[i]), data) {
        (Some(GeomType::Plane), _) => {
            let pos = plane_center(from, i, eye);
            return Ok(Form { shape: Shape::Plane { geom: i }, size, pos, mat: *mat });
        }
        (Some(GeomType::Hfield), Some(hfield)) => Shape::Hfield { hfield },
        (Some(GeomType::Mesh | GeomType::Sdf), Some(mesh)) => {
            let collides = m.geom_contype[i] != 0 || m.geom_conaffinity[i] != 0;
            if from.options.show.convex_hulls && collides && m.mesh_graphadr[mesh] >= 0 {
                Shape::Hull { mesh }
            } else {
                Shape::Mesh { mesh }
            }
        }
        _ => return Err(shapeless(from, ObjType::Geom, i)),
    };
    Ok(Form { shape, size, pos, mat: *mat })
}

/// Cells along a side of a plane, at most.
const PLANE_GRID: f64 = 200.0;

/// Where a plane is drawn. Infinite ones follow the eye in steps of twice the period of their texture, or of a cell of
/// their grid, so that they seem to stand still.
fn plane_center(from: Source<'_>, i: usize, eye: Vec3) -> Vec3 {
    let Source { m, d, .. } = from;
    let (origin, mat) = (d.kin.geom_xpos[i], &d.kin.geom_xmat[i]);
    let mut center = origin;
    for k in 0..2 {
        if m.geom_size[i][k] > 0.0 {
            continue;
        }
        let repeat = usize::try_from(m.geom_matid[i]).map_or(0.0, |material| m.mat_texrepeat[material][k]);
        let step = if repeat > 0.0 {
            f64::from(2.0 / repeat)
        } else {
            2.1 * f64::from(m.vis.map.zfar) * m.stat.extent / (PLANE_GRID - 2.0)
        };
        let axis = column(mat, k);
        let steps = (0.5 * dot(sub(eye, origin), axis) / step).round();
        center = add_scaled(center, axis, 2.0 * step * steps);
    }
    center
}
