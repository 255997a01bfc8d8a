//! Convex hulls of meshes: vertices, the graph of hull edges, and polygons. The vertex farthest in a direction is
//! found in small meshes by search, in larger ones by hill climbing on the graph (van den Bergen, "Collision
//! Detection in Interactive 3D Environments", section 4.3.4).

use crate::math::{Vec3, dot};
use crate::model::Model;

/// Meshes with fewer vertices are searched in full.
const HILL_CLIMB_MIN: usize = 10;
/// A component of a unit direction beyond this leaves the middle cell of the table of extremal vertices.
const EXTREMA_CELL: f64 = 0.4;

/// The mesh of a geom.
#[derive(Clone, Copy, Debug)]
pub struct MeshHull<'a> {
    /// Vertices in the geom frame [m].
    vert: &'a [[f32; 3]],
    graph: Option<HullGraph<'a>>,
    /// Index of the mesh.
    mesh: usize,
    m: &'a Model,
}

/// Hull vertices, which have numbers of their own, and their neighbours.
#[derive(Clone, Copy, Debug)]
pub struct HullGraph<'a> {
    /// Starts of the neighbour lists.
    start: &'a [i32],
    /// Mesh indices of the hull vertices.
    vertex: &'a [i32],
    /// Neighbour lists, each ended by -1.
    neighbour: &'a [i32],
    /// A far vertex for each of 27 directions.
    extrema: &'a [i32; 27],
}

/// Where a search for the farthest vertex ended.
#[derive(Clone, Copy, Debug)]
pub struct Farthest {
    /// Index among the vertices of the mesh.
    pub vertex: usize,
    /// Index among the vertices of the hull; that of the mesh when it was searched in full.
    pub start: usize,
}

impl<'a> HullGraph<'a> {
    fn new(m: &'a Model, mesh: usize) -> Option<Self> {
        let start = usize::try_from(m.mesh_graphadr[mesh]).ok()?;
        let (n, table) = (m.mesh_graph[start] as usize, &m.mesh_graph[start + 2..]);
        Some(HullGraph {
            start: &table[..n],
            vertex: &table[n..2 * n],
            neighbour: &table[2 * n..],
            extrema: &m.mesh_extrema[mesh],
        })
    }

    /// Mesh index of hull vertex `h`.
    pub fn vertex(&self, h: usize) -> usize {
        self.vertex[h] as usize
    }

    /// Hull vertices that share an edge with hull vertex `h`.
    pub fn neighbours(&self, h: usize) -> impl Iterator<Item = usize> + 'a {
        let list = &self.neighbour[self.start[h] as usize..];
        list.iter().map_while(|&v| usize::try_from(v).ok())
    }

    /// A far vertex in unit direction `dir`.
    fn tabulated(&self, dir: Vec3) -> usize {
        let cell = |x: f64| 1 + usize::from(x > EXTREMA_CELL) - usize::from(x < -EXTREMA_CELL);
        self.extrema[9 * cell(dir[0]) + 3 * cell(dir[1]) + cell(dir[2])] as usize
    }
}

impl<'a> MeshHull<'a> {
    /// Mesh `mesh` of a model.
    pub fn new(m: &'a Model, mesh: usize) -> Self {
        let (start, count) = (m.mesh_vertadr[mesh] as usize, m.mesh_vertnum[mesh] as usize);
        MeshHull { vert: &m.mesh_vert[start..start + count], graph: HullGraph::new(m, mesh), mesh, m }
    }

    /// Number of vertices.
    pub fn vertices(&self) -> usize {
        self.vert.len()
    }

    /// The graph of the hull, if it was built.
    pub fn graph(&self) -> Option<&HullGraph<'a>> {
        self.graph.as_ref()
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
    pub fn farthest(&self, dir: Vec3, last: Option<Farthest>) -> Farthest {
        let Some(graph) = self.climbed() else { return self.search(dir, last.map(|l| l.vertex)) };
        let with_height = |h: usize| (h, self.height(graph.vertex(h), dir));
        let seed = with_height(graph.tabulated(dir));
        let start = match last.map(|l| with_height(l.start)) {
            // The tabulated vertex must be higher: without a direction (NaN) the last answer stays.
            Some(last) if seed.1 > last.1 => seed,
            Some(last) => last,
            None => seed,
        };
        self.climb(graph, dir, start)
    }

    /// Farthest vertex in direction `dir`, from the `last` answer or the first vertex of the hull. Of equally far
    /// ones it may be another than that of [`Self::farthest`].
    pub fn farthest_untabulated(&self, dir: Vec3, last: Option<Farthest>) -> Farthest {
        match self.climbed() {
            Some(graph) => {
                let start = last.map_or(0, |l| l.start);
                self.climb(graph, dir, (start, self.height(graph.vertex(start), dir)))
            }
            None => self.search(dir, None),
        }
    }

    fn climbed(&self) -> Option<&HullGraph<'a>> {
        self.graph.as_ref().filter(|_| self.vert.len() >= HILL_CLIMB_MIN)
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

    /// Goes to higher neighbours from a hull vertex, given with its height, until there is none.
    fn climb(&self, graph: &HullGraph, dir: Vec3, start: (usize, f64)) -> Farthest {
        let (mut best, mut top) = start;
        loop {
            let from = best;
            for next in graph.neighbours(from) {
                let h = self.height(graph.vertex(next), dir);
                if h > top {
                    (best, top) = (next, h);
                }
            }
            if best == from {
                return Farthest { vertex: graph.vertex(best), start: best };
            }
        }
    }
}
