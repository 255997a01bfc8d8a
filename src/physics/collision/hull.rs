//! Convex hulls of meshes: vertices, the graph of hull edges, and polygons. The vertex farthest in a direction is
//! found in small meshes by search, in larger ones by hill climbing on the graph.

use crate::caches::climb::{Farthest, Slope};
use crate::math::{Vec3, dot};
use crate::model::Model;

/// The mesh of a geom.
#[derive(Clone, Copy, Debug)]
pub struct MeshHull<'a> {
    /// Vertices in the geom frame \[m\].
    vert: &'a [[f32; 3]],
    slope: Option<Slope<'a>>,
    /// Index of the mesh.
    mesh: usize,
    m: &'a Model,
}

impl<'a> MeshHull<'a> {
    /// Mesh `mesh` of a model.
    pub fn new(m: &'a Model, mesh: usize) -> Self {
        let (start, count) = (m.mesh_vertadr[mesh] as usize, m.mesh_vertnum[mesh] as usize);
        MeshHull { vert: &m.mesh_vert[start..start + count], slope: Slope::new(m, m.slopes(), mesh), mesh, m }
    }

    /// Number of vertices.
    pub fn vertices(&self) -> usize {
        self.vert.len()
    }

    /// True when the graph of the hull was built.
    pub fn has_graph(&self) -> bool {
        self.m.mesh_graphadr[self.mesh] >= 0
    }

    /// Vertices around the farthest one. A mesh of few vertices is searched in full; the place of the answer among its
    /// vertices then stands, as in MuJoCo, for a place in the graph, which it is only where all vertices are on the hull.
    pub fn around(&self, farthest: Farthest) -> impl Iterator<Item = usize> + 'a {
        let first = usize::try_from(self.m.mesh_graphadr[self.mesh]).unwrap_or(self.m.mesh_graph.len());
        let (n, table) = match self.m.mesh_graph.get(first..) {
            Some([n, _, table @ ..]) => (*n as usize, table),
            _ => (0, &[][..]),
        };
        let index = move |at: i32| usize::try_from(at).ok();
        let list = table.get(farthest.start).and_then(|&at| index(2 * n as i32 + at)).unwrap_or(table.len());
        table.iter().skip(list).map_while(move |&h| index(*table.get(n + index(h)?)?))
    }

    /// True when the polygons of the hull are known.
    pub fn has_polygons(&self) -> bool {
        self.m.mesh_polynum[self.mesh] > 0
    }

    /// Vertex `v` in the geom frame.
    pub fn vertex(&self, v: i32) -> Vec3 {
        self.vert[v as usize].map(f64::from)
    }

    /// Polygons around vertex `v`.
    pub fn polygons_at(&self, v: i32) -> &'a [i32] {
        let k = self.m.mesh_vertadr[self.mesh] as usize + v as usize;
        let start = self.m.mesh_polymapadr[k] as usize;
        &self.m.mesh_polymap[start..start + self.m.mesh_polymapnum[k] as usize]
    }

    /// Vertices of polygon `p`, counter-clockwise seen from outside.
    pub fn polygon(&self, p: i32) -> &'a [i32] {
        let k = self.m.mesh_polyadr[self.mesh] as usize + p as usize;
        let start = self.m.mesh_polyvertadr[k] as usize;
        &self.m.mesh_polyvert[start..start + self.m.mesh_polyvertnum[k] as usize]
    }

    /// Outward normal of polygon `p` in the geom frame.
    pub fn polygon_normal(&self, p: i32) -> Vec3 {
        self.m.mesh_polynormal[self.m.mesh_polyadr[self.mesh] as usize + p as usize]
    }

    /// Component of vertex `v` along `dir`.
    pub fn height(&self, v: usize, dir: Vec3) -> f64 {
        dot(dir, self.vert[v].map(f64::from))
    }

    /// Farthest vertex in unit direction `dir`, from the better of the `last` answer and a tabulated vertex.
    // Inlined to keep vectors in registers, see `Polytope::add_face`.
    #[inline(always)]
    pub fn farthest(&self, dir: Vec3, last: Option<Farthest>) -> Farthest {
        let Some(slope) = &self.slope else { return self.search(dir, last.map(|l| l.vertex)) };
        let with_height = |h: usize| (h, slope.height(h, dir));
        let seed = with_height(slope.tabulated(dir));
        let start = match last.map(|l| with_height(l.start)) {
            // The tabulated vertex must be higher: without a direction (NaN) the last answer stays.
            Some(last) if seed.1 > last.1 => seed,
            Some(last) => last,
            None => seed,
        };
        slope.climb(dir, start)
    }

    /// Farthest vertex in direction `dir`, from the `last` answer or the first vertex of the hull. Of equally far
    /// ones it may be another than [`Self::farthest`] finds.
    pub fn farthest_untabulated(&self, dir: Vec3, last: Option<Farthest>) -> Farthest {
        let Some(slope) = &self.slope else { return self.search(dir, None) };
        let start = last.map_or(0, |l| l.start);
        slope.climb(dir, (start, slope.height(start, dir)))
    }

    /// Farthest of all vertices; the last answer wins ties.
    fn search(&self, dir: Vec3, last: Option<usize>) -> Farthest {
        let mut best = last.unwrap_or(0);
        let mut top = last.map_or(-f64::from(f32::MAX), |v| self.height(v, dir));
        for v in 0..self.vert.len() {
            let h = self.height(v, dir);
            if h > top {
                (best, top) = (v, h);
            }
        }
        Farthest { vertex: best, start: best }
    }
}
