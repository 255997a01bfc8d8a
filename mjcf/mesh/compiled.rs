//! What a mesh is compiled to.

use super::octree::Octree;
use physics::geometry::hierarchy::Bvh;

/// The rows one mesh contributes to a model. Addresses inside are relative to the mesh's own first
/// row; the model compiler adds its offsets.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CompiledMesh {
    /// `mesh_vert`: metres, inertial frame of the mesh.
    pub vert: Vec<[f32; 3]>,
    /// `mesh_normal`: unit vectors, inertial frame.
    pub normal: Vec<[f32; 3]>,
    /// `mesh_texcoord`; empty when the mesh has none.
    pub texcoord: Vec<[f32; 2]>,
    /// `mesh_face`: vertices of each triangle.
    pub face: Vec<[i32; 3]>,
    /// `mesh_facenormal`: normals of each triangle.
    pub facenormal: Vec<[i32; 3]>,
    /// `mesh_facetexcoord`: zeros when the mesh has no texture coordinates.
    pub facetexcoord: Vec<[i32; 3]>,
    /// `mesh_graph`: convex hull; empty when none was needed. Layout: number of vertices, number of
    /// faces, edge address per vertex, mesh vertex per hull vertex, -1-terminated neighbour lists,
    /// mesh vertices of the faces.
    pub graph: Vec<i32>,
    /// `mesh_extrema`: hull vertex farthest in each of the 3×3×3 grid directions.
    pub extrema: [i32; 27],
    /// `mesh_polynormal`: normals of the hull's polygons.
    pub poly_normal: Vec<[f64; 3]>,
    /// `mesh_polyvertadr`, relative.
    pub poly_vertadr: Vec<i32>,
    /// `mesh_polyvertnum`.
    pub poly_vertnum: Vec<i32>,
    /// `mesh_polyvert`: mesh vertices of the polygons.
    pub poly_vert: Vec<i32>,
    /// `mesh_polymapadr`, one per mesh vertex, relative.
    pub poly_mapadr: Vec<i32>,
    /// `mesh_polymapnum`, one per mesh vertex.
    pub poly_mapnum: Vec<i32>,
    /// `mesh_polymap`: polygons around each vertex, numbered within the mesh.
    pub poly_map: Vec<i32>,
    /// `oct_*` rows; empty when no geom measures distances.
    pub octree: Octree,
    /// `mesh_scale`.
    pub scale: [f64; 3],
    /// `mesh_pos`: centre of mass in the mesh frame of the file.
    pub pos: [f64; 3],
    /// `mesh_quat`: principal axes in the mesh frame of the file.
    pub quat: [f64; 4],
    /// Corners of the bounding box in the inertial frame: minimum, then maximum.
    pub aamm: [f64; 6],
    /// Half sizes of the box of uniform density with the mesh's inertia.
    pub boxsz: [f64; 3],
    /// Volume in m³, or area in m² when the inertia mode is shell.
    pub volume: f64,
    /// `bvh_*` rows; leaves are faces.
    pub bvh: Bvh,
}

impl CompiledMesh {
    /// Bounding box as centre and half sizes: `geom_aabb` of a mesh geom.
    pub fn aabb(&self) -> [f64; 6] {
        let a = &self.aamm;
        std::array::from_fn(|k| if k < 3 { (a[k + 3] + a[k]) / 2.0 } else { (a[k] - a[k - 3]) / 2.0 })
    }

    /// `geom_size` of a mesh geom: farthest coordinate along each axis.
    pub fn geom_size(&self) -> [f64; 3] {
        std::array::from_fn(|k| self.aamm[k].abs().max(self.aamm[k + 3].abs()))
    }

    /// Diagonal inertia of a geom with this mesh and `mass`, in kg m².
    pub fn inertia(&self, mass: f64) -> [f64; 3] {
        let [x, y, z] = self.boxsz;
        [mass * (y * y + z * z) / 3.0, mass * (x * x + z * z) / 3.0, mass * (x * x + y * y) / 3.0]
    }
}
