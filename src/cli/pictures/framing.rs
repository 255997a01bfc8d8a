//! Views in which a body fills the picture.

use crate::pictures::look::Size;
use physics::math::{Vec3, add, add_scaled, dot, mul_mat_vec, norm, ops, scale, sub};
use physics::model::{GeomType, ObjType};
use physics::{Data, Model};
use render::RenderError;
use render::scene::{Camera, Category, FreeCamera, Item, Scene, SceneOptions};
use std::collections::{BTreeMap, BTreeSet};

/// Azimuths of three-quarter views [deg].
pub const AZIMUTHS: [f64; 4] = [135.0, 45.0, 225.0, 315.0];
/// Elevation of their gaze [deg].
const ELEVATION: f64 = -20.0;
/// Vertical field of view [deg].
const FOVY: f64 = 30.0;
/// Share of a picture's width or height that a body takes up, whichever it reaches first.
const FILL: f64 = 0.9;
/// Least distance of a body from the eye, in distances of the near plane.
const CLEARANCE: f64 = 2.0;
/// Least tangent of half the field of view.
const NARROWEST: f64 = 1e-3;

/// What a picture is to show: the visible geoms, skins and flexes that move, and the bodies that carry them.
#[derive(Default)]
pub struct Body {
    /// Corners of boxes around its parts, world frame [m].
    corners: Vec<Vec3>,
    /// Numbers and types of its parts, as segmentation has them.
    parts: BTreeSet<[i32; 2]>,
}

impl Body {
    /// The body of a model in a state that a forward pass has evaluated. Where nothing moves, it is all but planes and height
    /// fields. Bodies without degrees of freedom that carry moving ones belong to it, but not their geoms that are larger
    /// than all that moves: floors, walls and domes.
    ///
    /// # Errors
    /// An item of the scene is not finite or cannot be drawn.
    pub fn of(model: &Model, data: &Data) -> Result<Self, RenderError> {
        let mut scene = Scene::new();
        let view = Camera::free(model).view(model, data)?;
        scene.update(model, data, view, &SceneOptions::default())?;
        let mut body = Body::default();
        for item in scene.items.iter().filter(|item| item.category == Category::Dynamic) {
            body.add(model, data, item);
        }
        let (moves, radius) = (!body.corners.is_empty(), body.radius());
        let carriers = carriers(model);
        for item in scene.items.iter().filter(|item| item.category == Category::Static) {
            let Some(geom) = geom_of(item) else { continue };
            let carries = carriers[model.geom_bodyid[geom] as usize] && model.geom_rbound[geom] <= radius;
            if carries || !moves {
                body.add(model, data, item);
            }
        }
        Ok(body)
    }

    /// Adds what another state shows.
    pub fn join(&mut self, other: Body) {
        self.corners.extend(other.corners);
        self.parts.extend(other.parts);
    }

    /// Adds what an item shows.
    fn add(&mut self, model: &Model, data: &Data, item: &Item) {
        let before = self.corners.len();
        let id = item.object.id as usize;
        if let Some(geom) = geom_of(item) {
            let unbounded = [GeomType::Plane, GeomType::Hfield].map(GeomType::code);
            if !unbounded.contains(&model.geom_type[geom]) {
                self.corners.extend(corners(model, data, geom));
            }
        } else if item.object.kind == ObjType::Skin.code() {
            let (first, count) = (model.skin_boneadr[id] as usize, model.skin_bonenum[id] as usize);
            let bones = &model.skin_bonebodyid[first..first + count];
            self.corners.extend(bones.iter().map(|&bone| data.kin.xpos[bone as usize]));
        } else if item.object.kind == ObjType::Flex.code() {
            let (first, count) = (model.flex_vertadr[id] as usize, model.flex_vertnum[id] as usize);
            self.corners.extend(&data.flex.flexvert_xpos[first..first + count]);
        }
        if self.corners.len() > before {
            self.parts.insert([item.object.id, item.object.kind]);
        }
    }

    /// Radius of a ball around it [m].
    fn radius(&self) -> f64 {
        let Some(&first) = self.corners.first() else { return 0.0 };
        self.corners.iter().map(|&corner| norm(sub(corner, first))).fold(0.0, f64::max)
    }

    /// Pixels of each part that a segmentation shows.
    fn pixels(&self, segmentation: &[[i32; 2]]) -> BTreeMap<[i32; 2], usize> {
        let mut pixels = BTreeMap::new();
        for object in segmentation.iter().filter(|object| self.parts.contains(*object)) {
            *pixels.entry(*object).or_default() += 1;
        }
        pixels
    }

    /// Share of a segmentation's pixels that show it.
    pub fn share(&self, segmentation: &[[i32; 2]]) -> f64 {
        self.pixels(segmentation).values().sum::<usize>() as f64 / segmentation.len() as f64
    }

    /// How much of it a segmentation shows: the sum of the roots of the pixels of its parts, so that many parts count for more
    /// than a large one that hides the others.
    pub fn clarity(&self, segmentation: &[[i32; 2]]) -> f64 {
        self.pixels(segmentation).values().map(|&pixels| ops::sqrt(pixels as f64)).sum()
    }

    /// The free camera that looks along `azimuth` [deg] and is as near as the body fits into a picture of this size; the
    /// model's own where there is no body.
    ///
    /// A corner at (a, b, c) to the right, up and along the gaze is inside a window of tangent t where |a - x| <= t (c - z)
    /// for an eye at (x, y, z). So a - t c <= x - t z and a + t c >= x + t z: the greatest of the left sides and the least of
    /// the right sides give the nearest z that leaves room for x, and the middle of that room is x; the same upwards.
    pub fn camera(&self, model: &Model, azimuth: f64, size: Size) -> FreeCamera {
        let free = FreeCamera { azimuth, elevation: ELEVATION, orthographic: false, ..FreeCamera::of(model) };
        if self.corners.is_empty() {
            return free;
        }
        let [right, up, forward] = axes(azimuth, ELEVATION);
        let corners = || self.corners.iter().map(|&p| [dot(p, right), dot(p, up), dot(p, forward)]);
        let aspect = size.width as f64 / size.height as f64;
        let tangent = FILL * ops::tan(FOVY.to_radians() / 2.0);
        let tangents = [tangent * aspect, tangent];
        let (mut low, mut high) = ([f64::NEG_INFINITY; 2], [f64::INFINITY; 2]);
        let (mut nearest, mut farthest) = (f64::INFINITY, f64::NEG_INFINITY);
        for corner in corners() {
            for k in 0..2 {
                low[k] = low[k].max(corner[k] - tangents[k] * corner[2]);
                high[k] = high[k].min(corner[k] + tangents[k] * corner[2]);
            }
            (nearest, farthest) = (nearest.min(corner[2]), farthest.max(corner[2]));
        }
        let near = f64::from(model.vis.map.znear) * model.stat.extent;
        let room = |k: usize| (high[k] - low[k]) / (2.0 * tangents[k]);
        let depth = room(0).min(room(1)).min(nearest - CLEARANCE * near);
        let [x, y] = [0, 1].map(|k| 0.5 * (low[k] + high[k]));
        // An eye held back by the near plane looks through a narrower window.
        let needed = corners()
            .map(|[a, b, c]| ((a - x).abs() / aspect).max((b - y).abs()) / (c - depth))
            .fold(FILL * NARROWEST, f64::max);
        let distance = 0.5 * (nearest + farthest) - depth;
        let beside = add(scale(right, x), scale(up, y));
        FreeCamera {
            lookat: add_scaled(beside, forward, depth + distance),
            distance,
            fovy: 2.0 * ops::atan(needed / FILL).to_degrees(),
            ..free
        }
    }
}

/// The geom that an item stands for.
fn geom_of(item: &Item) -> Option<usize> {
    (item.object.kind == ObjType::Geom.code()).then_some(item.object.id as usize)
}

/// The corners of the box around a geom.
fn corners(model: &Model, data: &Data, geom: usize) -> [Vec3; 8] {
    let [x, y, z, dx, dy, dz] = model.geom_aabb[geom];
    std::array::from_fn(|corner| {
        let side = |bit: usize| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
        let within = [x + side(0) * dx, y + side(1) * dy, z + side(2) * dz];
        add(data.kin.geom_xpos[geom], mul_mat_vec(&data.kin.geom_xmat[geom], within))
    })
}

/// Which bodies but the world carry one that moves.
fn carriers(model: &Model) -> Vec<bool> {
    let mut carriers = vec![false; model.nbody];
    for body in (1..model.nbody).rev() {
        if model.body_weldid[body] != 0 || carriers[body] {
            carriers[model.body_parentid[body] as usize] = true;
        }
    }
    carriers[0] = false;
    carriers
}

/// Right, up and forward of a gaze [deg].
fn axes(azimuth: f64, elevation: f64) -> [Vec3; 3] {
    let (sin_azimuth, cos_azimuth) = ops::sincos(azimuth.to_radians());
    let (sin_elevation, cos_elevation) = ops::sincos(elevation.to_radians());
    let up = [-sin_elevation * cos_azimuth, -sin_elevation * sin_azimuth, cos_elevation];
    let forward = [cos_elevation * cos_azimuth, cos_elevation * sin_azimuth, sin_elevation];
    [[sin_azimuth, -cos_azimuth, 0.0], up, forward]
}
