//! Coplanar triangles of the convex hull joined into polygons, for multi-contact clipping.
//!
//! Triangles are coplanar when their normals fall into the same cell of a grid in polar angles. The
//! order of the polygons is that in which LLVM's hash map enumerates the cells.

use physics::math::ops;
use physics::model::bounds::MINVAL;

use super::hash_order::HashOrder;
use crate::vector::{cross, dot, sub};

/// Width of a cell, in radians.
const CELL: f64 = 0.01;
/// Polygons of a hull, as mesh vertices in counter-clockwise order seen from outside.
#[derive(Debug, Default)]
pub(super) struct Polygons {
    pub paths: Vec<Vec<i32>>,
    pub normal: Vec<[f64; 3]>,
}

/// Polygons around each vertex.
pub(super) struct VertexMap {
    pub adr: Vec<i32>,
    pub num: Vec<i32>,
    pub polygon: Vec<i32>,
}

impl Polygons {
    /// Polygons of the hull with triangles `face`; normals are set by [`Polygons::update_normals`].
    pub(super) fn of_hull(vert: &[[f64; 3]], face: &[[i32; 3]]) -> Self {
        let mut cells = HashOrder::default();
        let mut outlines: Vec<Outline> = Vec::new();
        for &f in face {
            let Some(key) = cell(f.map(|v| vert[v as usize])) else { continue };
            match cells.find(key) {
                Some(k) => outlines[k].insert(f),
                None => {
                    cells.insert(key);
                    outlines.push(Outline::new(f));
                }
            }
        }
        let paths: Vec<Vec<i32>> =
            cells.order().flat_map(|k| outlines[k].paths()).filter(|path| path.len() >= 3).collect();
        Self { normal: vec![[0.0; 3]; paths.len()], paths }
    }

    /// Normals from the first three corners; degenerate ones point along x.
    pub(super) fn update_normals(&mut self, vert: &[[f64; 3]]) {
        for (normal, path) in self.normal.iter_mut().zip(&self.paths) {
            let [a, b, c] = [path[0], path[1], path[2]].map(|v| vert[v as usize]);
            let n = cross(sub(b, a), sub(c, a));
            let length = dot(n, n).sqrt();
            *normal = if length < 1e-14 { [1.0, 0.0, 0.0] } else { n.map(|x| x / length) };
        }
    }

    pub(super) fn vertadr(&self) -> Vec<i32> {
        starts(self.paths.iter().map(|p| p.len()))
    }

    pub(super) fn by_vertex(&self, nvert: usize) -> VertexMap {
        let mut lists = vec![Vec::new(); nvert];
        for (k, path) in self.paths.iter().enumerate() {
            for &v in path {
                lists[v as usize].push(k as i32);
            }
        }
        VertexMap {
            adr: starts(lists.iter().map(|l| l.len())),
            num: lists.iter().map(|l| l.len() as i32).collect(),
            polygon: lists.concat(),
        }
    }
}

fn starts(lengths: impl Iterator<Item = usize>) -> Vec<i32> {
    lengths
        .scan(0, |next, length| {
            let adr = *next;
            *next += length as i32;
            Some(adr)
        })
        .collect()
}

/// Azimuth and inclination of the outward normal in units of `CELL`, rounded; `None` for slivers.
fn cell([a, b, c]: [[f64; 3]; 3]) -> Option<(f64, f64)> {
    let n = cross(sub(b, a), sub(c, a));
    let length = dot(n, n).sqrt();
    if length < MINVAL {
        return None;
    }
    // Adding zero turns -0 into 0, to which the arc tangent is sensitive.
    let n = n.map(|x| x / length + 0.0);
    if n[2].abs() > 1.0 - 1e-7 {
        let inclination = if n[2] < 0.0 { (std::f64::consts::PI / CELL).round() } else { 0.0 };
        return Some((0.0, inclination));
    }
    Some(((ops::atan2(n[1], n[0]) / CELL).round(), (ops::acos(n[2]) / CELL).round()))
}

/// Directed boundary edges of the triangles of one cell. Triangles arrive in any order, so there are
/// several connected parts ("islands") that later triangles may join.
struct Outline {
    edges: Vec<([i32; 2], usize)>,
    islands: usize,
}

impl Outline {
    fn new([a, b, c]: [i32; 3]) -> Self {
        Self { edges: vec![([a, b], 0), ([b, c], 0), ([c, a], 0)], islands: 1 }
    }

    fn insert(&mut self, [a, b, c]: [i32; 3]) {
        let mut island = None;
        let mut open = Vec::with_capacity(3);
        for edge in [[a, b], [b, c], [c, a]] {
            let twin = [edge[1], edge[0]];
            let Some(at) = self.edges.iter().position(|(e, _)| *e == twin) else {
                open.push(edge);
                continue;
            };
            let (_, other) = self.edges[at];
            island = Some(match island {
                Some(mine) if mine != other => self.join(mine, other),
                _ => other,
            });
            self.edges.remove(at);
        }
        let island = island.unwrap_or_else(|| {
            self.islands += 1;
            self.islands - 1
        });
        self.edges.extend(open.into_iter().map(|edge| (edge, island)));
    }

    /// Renumbers two islands as one, returns its number.
    fn join(&mut self, a: usize, b: usize) -> usize {
        let (keep, drop) = (a.min(b), a.max(b));
        self.islands -= 1;
        for (_, island) in &mut self.edges {
            if *island == drop {
                *island = keep;
            } else if *island > drop {
                *island -= 1;
            }
        }
        keep
    }

    /// Closed walks along the edges, one per island.
    fn paths(&self) -> Vec<Vec<i32>> {
        if self.edges.len() == 3 {
            return vec![self.edges.iter().map(|(e, _)| e[0]).collect()];
        }
        (0..self.islands).filter_map(|island| self.walk(island)).collect()
    }

    fn walk(&self, island: usize) -> Option<Vec<i32>> {
        let (start, _) = self.edges.iter().find(|(_, i)| *i == island)?;
        let mut path = start.to_vec();
        let mut at = start[1];
        for _ in 0..self.edges.len() {
            // The first edge overall is never a continuation: a walk through it ends there.
            let next = self.edges[1..].iter().find(|(e, i)| *i == island && e[0] == at);
            if let Some(([_, to], _)) = next {
                at = *to;
                if at == path[0] {
                    return Some(path);
                }
                path.push(at);
            }
        }
        None
    }
}
