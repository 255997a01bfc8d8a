//! What a mesh is compiled from.

use super::mass::MeshInertia;

/// Where the arrays of a [`RawMesh`] come from; the formats differ in how they are completed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Format {
    /// Attributes of the XML element.
    #[default]
    Inline,
    /// Stereolithography file.
    Stl,
    /// Wavefront file.
    Obj,
    /// MuJoCo's legacy binary file.
    Msh,
}

/// Arrays as a file or the XML gives them, before any processing; absent ones are empty.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RawMesh {
    /// Origin of the arrays.
    pub format: Format,
    /// Vertex coordinates, three per vertex.
    pub vert: Vec<f32>,
    /// Normal coordinates, three per normal.
    pub normal: Vec<f32>,
    /// Texture coordinates, two per entry, v downwards.
    pub texcoord: Vec<f32>,
    /// Vertex indices, three per triangle.
    pub face: Vec<i32>,
    /// Normal indices, three per triangle.
    pub facenormal: Vec<i32>,
    /// Texture coordinate indices, three per triangle.
    pub facetexcoord: Vec<i32>,
    /// Vertex indices, two per line; only deformable bodies use them.
    pub line: Vec<i32>,
}

/// Everything an `asset/mesh` element says, with its file already read.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshSource {
    /// Name for messages.
    pub name: String,
    /// Decoded file; `None` when the mesh is inline only.
    pub file: Option<RawMesh>,
    /// Attributes `vertex`, `normal`, `texcoord`, `face`, `facenormal`, `facetexcoord`.
    pub inline: RawMesh,
    /// Factors on the vertex coordinates, applied after `refpos` and `refquat`.
    pub scale: [f64; 3],
    /// Origin of the mesh frame in file coordinates.
    pub refpos: [f64; 3],
    /// Orientation of the mesh frame in file coordinates, not necessarily of unit length.
    pub refquat: [f64; 4],
    /// How volume and inertia are computed.
    pub inertia: MeshInertia,
    /// Keep normals smooth across sharp edges.
    pub smoothnormal: bool,
    /// Largest number of hull vertices, -1 for no limit; at least 4 otherwise.
    pub maxhullvert: i32,
    /// A geom collides with this mesh, or its inertia mode is convex.
    pub needhull: bool,
    /// Most levels of an octree of signed distances; `None` for no octree.
    pub octree: Option<i32>,
    /// Vertices stay in the frame they are given in.
    pub keep_frame: bool,
}

impl Default for MeshSource {
    fn default() -> Self {
        Self {
            name: String::new(),
            file: None,
            inline: RawMesh::default(),
            scale: [1.0; 3],
            refpos: [0.0; 3],
            refquat: [1.0, 0.0, 0.0, 0.0],
            inertia: MeshInertia::Legacy,
            smoothnormal: false,
            maxhullvert: -1,
            needhull: false,
            octree: None,
            keep_frame: false,
        }
    }
}
