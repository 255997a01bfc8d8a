//! Flexes: skins or faces of deformable bodies, and balls and tubes at their vertices and edges (MuJoCo documentation, XML
//! reference, "deformable/flex").

use super::part::{Paint, Part};
use super::surface::Surface;
use crate::error::RenderError;
use crate::scene::SceneOptions;
use physics::math::{Vec3, add_scaled, cross, normalize, quat_from_z, quat_to_mat, scale, sub};
use physics::model::ObjType;
use physics::{Data, Model};
use std::ops::Range;

/// Vertices and edges that are drawn of a flex, world frame.
#[derive(Clone, Debug, Default)]
pub(super) struct Wires {
    /// Radius of balls and tubes \[m\].
    radius: f32,
    /// Middles of balls \[m\].
    balls: Vec<[f32; 3]>,
    /// Ends of tubes \[m\].
    tubes: Vec<[[f32; 3]; 2]>,
}

impl Wires {
    /// Appends a part for each ball and tube, as seen from an item at `origin` that is not turned.
    pub fn parts(&self, [ball, tube]: [usize; 2], origin: [f32; 3], out: &mut Vec<Part>) {
        let mut put = |surface, middle: [f32; 3], linear| {
            let offset = std::array::from_fn(|k| middle[k] - origin[k]);
            out.push(Part { surface, linear, offset, paint: Paint::Plain, two_sided: false });
        };
        let r = self.radius;
        for &middle in &self.balls {
            put(ball, middle, [[r, 0.0, 0.0], [0.0, r, 0.0], [0.0, 0.0, r]]);
        }
        for [a, b] in &self.tubes {
            let span: Vec3 = std::array::from_fn(|k| f64::from(b[k] - a[k]));
            let (direction, length) = normalize(span);
            let turn = quat_to_mat(quat_from_z(direction)).map(|x| x as f32);
            let row =
                |i: usize| [turn[3 * i] * r, turn[3 * i + 1] * r, turn[3 * i + 2] * (0.5 * length) as f32];
            put(tube, std::array::from_fn(|k| (a[k] + b[k]) * 0.5), [row(0), row(1), row(2)]);
        }
    }
}

/// What is drawn of one flex in one state.
struct Sight<'a> {
    m: &'a Model,
    flex: usize,
    /// Positions of its vertices \[m\].
    points: &'a [Vec3],
    surface: Surface,
}

/// The triangles and wires of a flex in a state whose vertices have been computed. There are no triangles when they equal
/// `last`.
///
/// # Errors
/// [`RenderError::NotFinite`] where a vertex is nowhere.
pub(super) fn posed(
    m: &Model,
    d: &Data,
    (flex, options): (usize, &SceneOptions),
    last: &Surface,
) -> Result<(Option<Surface>, Wires), RenderError> {
    let points = &d.flex.flexvert_xpos[range(m.flex_vertadr[flex], m.flex_vertnum[flex])];
    if !points.as_flattened().iter().all(|x| x.is_finite()) {
        return Err(RenderError::NotFinite { what: m.label_of(ObjType::Flex, flex) });
    }
    let mut sight = Sight { m, flex, points, surface: Surface::default() };
    let show = &options.show;
    let has_skin = show.flex_skins && m.flex_dim[flex] > 1;
    match m.flex_dim[flex] {
        2 | 3 if has_skin => sight.skin(),
        2 | 3 if show.flex_faces => sight.faces(options.flex_layer),
        // Only to tell whether it has moved.
        _ => sight.surface.positions = points.iter().map(|&p| single(p)).collect(),
    }
    let hidden = has_skin && !sight.surface.faces.is_empty();
    let wires = sight.wires(show.flex_vertices && !hidden, show.flex_edges && !hidden);
    let mut surface = sight.surface;
    if surface.positions == last.positions
        && surface.normals == last.normals
        && surface.faces == last.faces
        && surface.texcoords == last.texcoords
    {
        return Ok((None, wires));
    }
    surface.finish();
    Ok((Some(surface), wires))
}

impl Sight<'_> {
    fn wires(&self, vertices: bool, edges: bool) -> Wires {
        let m = self.m;
        let radius = m.flex_radius[self.flex] as f32;
        let mut wires = Wires { radius, ..Wires::default() };
        if radius <= 0.0 {
            return wires;
        }
        let place = |v: i32| single(self.points[v as usize]);
        if vertices {
            wires.balls = self.points.iter().map(|&p| single(p)).collect();
        }
        if edges {
            let all = &m.flex_edge[range(m.flex_edgeadr[self.flex], m.flex_edgenum[self.flex])];
            wires.tubes = all.iter().map(|edge| edge.map(place)).collect();
        }
        wires
    }

    fn elements(&self) -> impl Iterator<Item = (usize, Range<usize>)> + use<> {
        let corners = self.m.flex_dim[self.flex] as usize + 1;
        let first = self.m.flex_elemdataadr[self.flex] as usize;
        let elements = self.m.flex_elemnum[self.flex] as usize;
        (0..elements).map(move |e| (e, first + e * corners..first + (e + 1) * corners))
    }

    fn shells(&self) -> impl Iterator<Item = Range<usize>> + use<> {
        let (m, dim) = (self.m, self.m.flex_dim[self.flex] as usize);
        let first = m.flex_shelldataadr[self.flex] as usize;
        (0..m.flex_shellnum[self.flex] as usize).map(move |s| first + s * dim..first + (s + 1) * dim)
    }

    /// Copies the texture coordinates; false where there are none.
    fn take_texcoords(&mut self) -> bool {
        let Ok(first) = usize::try_from(self.m.flex_texcoordadr[self.flex]) else { return false };
        self.surface.texcoords = self.m.flex_texcoord[first..].to_vec();
        !self.surface.texcoords.is_empty()
    }

    fn normal(&self, [a, b, c]: [i32; 3]) -> Vec3 {
        let [a, b, c] = [a, b, c].map(|v| self.points[v as usize]);
        normalize(cross(sub(b, a), sub(c, a))).0
    }

    /// Triangles of the elements of a layer, flat, each raised by the radius.
    fn faces(&mut self, layer: i32) {
        const OF_TRIANGLE: &[[usize; 3]] = &[[0, 1, 2], [0, 2, 1]];
        const OF_TETRAHEDRON: &[[usize; 3]] = &[[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];
        let (m, radius, textured) = (self.m, self.m.flex_radius[self.flex], self.take_texcoords());
        let is_solid = m.flex_dim[self.flex] == 3;
        let first = m.flex_elemadr[self.flex] as usize;
        for (e, data) in self.elements() {
            if is_solid && m.flex_elemlayer[first + e] != layer {
                continue;
            }
            for sides in if is_solid { OF_TETRAHEDRON } else { OF_TRIANGLE } {
                let corners = sides.map(|k| m.flex_elem[data.start + k]);
                let normal = self.normal(corners);
                let next = self.surface.positions.len() as u32;
                let raised = corners.map(|v| single(add_scaled(self.points[v as usize], normal, radius)));
                self.surface.positions.extend(raised);
                self.surface.normals.push(single(normal));
                let rows = sides.map(|k| m.flex_elemtexcoord[data.start + k] as u32);
                let light = self.surface.normals.len() as u32 - 1;
                self.push([next, next + 1, next + 2], [light; 3], textured.then_some(rows));
            }
        }
    }

    /// The surface, raised by the radius along smooth normals; of triangles both sides, joined where they end.
    fn skin(&mut self) {
        let (m, radius, textured) = (self.m, self.m.flex_radius[self.flex], self.take_texcoords());
        let is_solid = m.flex_dim[self.flex] == 3;
        let triangles: Vec<[usize; 3]> = match is_solid {
            true => self.shells().map(|data| [0, 1, 2].map(|k| data.start + k)).collect(),
            false => self.elements().map(|(_, data)| [0, 1, 2].map(|k| data.start + k)).collect(),
        };
        let corners = if is_solid { &m.flex_shell[..] } else { &m.flex_elem[..] };
        // Shell fragments of solids have the texture coordinates of their vertices.
        let paints = if is_solid { &m.flex_shell[..] } else { &m.flex_elemtexcoord[..] };
        let upwards = self.smooth(triangles.iter().map(|rows| rows.map(|k| corners[k])));
        let outwards = if radius > 0.0 { 1.0 } else { -1.0 };
        let count = self.points.len() as u32;
        let sides: &[(f64, f64, u32)] = &[(radius, outwards, 0), (-radius, -1.0, count)];
        for &(raise, sign, _) in &sides[..if is_solid { 1 } else { 2 }] {
            for (&point, &normal) in self.points.iter().zip(&upwards) {
                self.surface.positions.push(single(add_scaled(point, normal, raise)));
                self.surface.normals.push(single(scale(normal, sign)));
            }
        }
        for rows in triangles {
            for &(_, sign, first) in &sides[..if is_solid { 1 } else { 2 }] {
                let [a, b, c] = rows;
                let rows = if first == 0 { rows } else { [a, c, b] };
                let corner = rows.map(|k| corners[k]);
                let place = corner.map(|v| first + v as u32);
                let light = match m.flex_flatskin[self.flex] {
                    true => self.flat(scale(self.normal(corner), if first == 0 { sign } else { -1.0 })),
                    false => place,
                };
                self.push(place, light, textured.then(|| rows.map(|k| paints[k] as u32)));
            }
        }
        if !is_solid {
            self.rim(&upwards, textured);
        }
    }

    /// Joins both sides of a surface along the edges at which it ends.
    fn rim(&mut self, upwards: &[Vec3], textured: bool) {
        let count = self.points.len() as u32;
        for data in self.shells() {
            let [a, b] = [0, 1].map(|k| self.m.flex_shell[data.start + k] as u32);
            let span = sub(self.points[b as usize], self.points[a as usize]);
            let first = self.flat(normalize(cross(span, upwards[b as usize])).0);
            self.push([a, b + count, b], first, textured.then_some([a, b, b]));
            let second = self.flat(normalize(cross(span, upwards[a as usize])).0);
            self.push([b + count, a, a + count], second, textured.then_some([b, a, a]));
        }
    }

    /// Unit normals of the vertices: normalised sums of the unit normals of the triangles, not weighted by area.
    fn smooth(&self, triangles: impl Iterator<Item = [i32; 3]>) -> Vec<Vec3> {
        let mut normals = vec![[0.0; 3]; self.points.len()];
        for corners in triangles {
            let normal = self.normal(corners);
            for v in corners {
                (0..3).for_each(|k| normals[v as usize][k] += normal[k]);
            }
        }
        normals.into_iter().map(|n| normalize(n).0).collect()
    }

    /// Rows of a normal that three corners share.
    fn flat(&mut self, normal: Vec3) -> [u32; 3] {
        self.surface.normals.push(single(normal));
        [self.surface.normals.len() as u32 - 1; 3]
    }

    fn push(&mut self, position: [u32; 3], normal: [u32; 3], texcoord: Option<[u32; 3]>) {
        let last = self.surface.texcoords.len().saturating_sub(1) as u32;
        self.surface.push(position, normal, texcoord.map_or([0; 3], |rows| rows.map(|row| row.min(last))));
    }
}

fn single(v: Vec3) -> [f32; 3] {
    v.map(|x| x as f32)
}

fn range(first: i32, count: i32) -> Range<usize> {
    let first = first.max(0) as usize;
    first..first + count.max(0) as usize
}
