//! Hull graphs of meshes laid out for hill climbing: beside each vertex, the coordinates of its neighbours, four at a
//! time (van den Bergen, "Collision Detection in Interactive 3D Environments", section 4.3.4).

use crate::arrays::Arrays;
use crate::math::{Vec3, dot};

/// Meshes with fewer vertices are searched in full.
const CLIMB_MIN: i32 = 10;
/// A component of a unit direction beyond this leaves the middle cell of the table of extremal vertices.
const EXTREMA_CELL: f64 = 0.4;

/// The hulls of a model's meshes, vertex by vertex.
#[derive(Clone, Debug, Default)]
pub struct Slopes {
    /// First vertex of each mesh; `None` for those that are searched in full.
    first: Vec<Option<usize>>,
    /// Vertices of all hulls.
    vertices: Vec<HullVertex>,
    neighbours: Vec<Neighbours>,
}

#[derive(Clone, Copy, Debug)]
struct HullVertex {
    point: [f32; 3],
    /// Index among the vertices of the mesh.
    vertex: u32,
    /// Where in `Slopes::neighbours` they stand.
    neighbours: [u32; 2],
}

/// Four neighbours of a vertex. The vertex itself, which is not above itself, fills up the last four.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Neighbours {
    x: [f32; 4],
    y: [f32; 4],
    z: [f32; 4],
    /// Indices among the vertices of the hull.
    at: [u32; 4],
}

/// Where a search for the farthest vertex ended.
#[derive(Clone, Copy, Debug)]
pub struct Farthest {
    /// Index among the vertices of the mesh.
    pub vertex: usize,
    /// Index among the vertices of the hull, or of the mesh when it was searched in full.
    pub start: usize,
}

/// The hull of one mesh.
#[derive(Clone, Copy, Debug)]
pub struct Slope<'a> {
    vertices: &'a [HullVertex],
    neighbours: &'a [Neighbours],
    /// A far vertex for each of 27 directions.
    extrema: &'a [i32; 27],
}

impl Slopes {
    /// The hulls of all meshes of a model.
    pub(crate) fn new(m: &Arrays) -> Self {
        let mut slopes = Slopes::default();
        for mesh in 0..m.nmesh {
            let start = usize::try_from(m.mesh_graphadr[mesh]).ok();
            let start = start.filter(|_| m.mesh_vertnum[mesh] >= CLIMB_MIN);
            slopes.first.push(start.map(|_| slopes.vertices.len()));
            if let Some(start) = start {
                let vert = &m.mesh_vert[m.mesh_vertadr[mesh] as usize..];
                slopes.push_hull(vert, m.mesh_graph[start] as usize, &m.mesh_graph[start + 2..]);
            }
        }
        slopes
    }

    /// A graph of `n` vertices: starts of the neighbour lists, mesh indices, and lists that each end in -1.
    fn push_hull(&mut self, vert: &[[f32; 3]], n: usize, graph: &[i32]) {
        let (vertex, lists) = (&graph[n..2 * n], &graph[2 * n..]);
        let point = |h: usize| vert[vertex[h] as usize];
        for h in 0..n {
            let start = self.neighbours.len() as u32;
            let list = &lists[graph[h] as usize..];
            let list = &list[..list.iter().position(|&v| v < 0).unwrap_or(list.len())];
            self.neighbours.extend(list.chunks(4).map(|four| {
                let at: [usize; 4] = std::array::from_fn(|i| four.get(i).map_or(h, |&v| v as usize));
                let [x, y, z] = [0, 1, 2].map(|axis: usize| at.map(|v| point(v)[axis]));
                Neighbours { x, y, z, at: at.map(|v| v as u32) }
            }));
            let neighbours = [start, self.neighbours.len() as u32];
            self.vertices.push(HullVertex { point: point(h), vertex: vertex[h] as u32, neighbours });
        }
    }
}

impl<'a> Slope<'a> {
    /// The hull of mesh `mesh`; `None` when the mesh is searched in full.
    pub fn new(m: &'a Arrays, slopes: &'a Slopes, mesh: usize) -> Option<Self> {
        let vertices = &slopes.vertices[slopes.first[mesh]?..];
        Some(Slope { vertices, neighbours: &slopes.neighbours, extrema: &m.mesh_extrema[mesh] })
    }

    /// A far vertex in unit direction `dir`.
    pub fn tabulated(&self, dir: Vec3) -> usize {
        let cell = |x: f64| 1 + usize::from(x > EXTREMA_CELL) - usize::from(x < -EXTREMA_CELL);
        self.extrema[9 * cell(dir[0]) + 3 * cell(dir[1]) + cell(dir[2])] as usize
    }

    /// Component of hull vertex `h` along `dir`.
    pub fn height(&self, h: usize, dir: Vec3) -> f64 {
        dot(dir, self.vertices[h].point.map(f64::from))
    }

    /// Goes to higher neighbours from a hull vertex, given with its height, until there is none.
    // Inlined to keep vectors in registers, see `Polytope::add_face`.
    #[inline(always)]
    pub fn climb(&self, dir: Vec3, (mut best, mut top): (usize, f64)) -> Farthest {
        loop {
            let from = best;
            let HullVertex { vertex, neighbours: [start, end], .. } = self.vertices[from];
            for four in &self.neighbours[start as usize..end as usize] {
                let height: [f64; 4] =
                    std::array::from_fn(|i| dot(dir, [four.x[i], four.y[i], four.z[i]].map(f64::from)));
                // Together first: the four become one comparison.
                let above = height.map(|h| u32::from(h > top));
                if above[0] | above[1] | above[2] | above[3] == 0 {
                    continue;
                }
                for i in 0..4 {
                    if height[i] > top {
                        (best, top) = (four.at[i] as usize, height[i]);
                    }
                }
            }
            if best == from {
                return Farthest { vertex: vertex as usize, start: best };
            }
        }
    }
}
