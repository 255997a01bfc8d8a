//! Assets (XML reference: `asset`).

use super::element::elements;
use super::plugin::PluginUse;
use crate::files::base_name;
use crate::image::{Builtin, Mark};
pub use crate::mesh::Bone;
use crate::mesh::{MeshInertia, Shape};
use physics::model::{ColorSpace, TextureType};

elements! {
    /// A triangle mesh from a file or from the element itself.
    Mesh {
        /// Media type of the file.
        content_type: String = String::new(),
        /// What the file provider opens; empty for a mesh given in place.
        file: String = String::new(),
        /// The path MuJoCo stores in `paths`.
        path: String = String::new(),
        /// Origin in the file's frame.
        refpos: [f64; 3] = [0.0; 3],
        /// Orientation in the file's frame.
        refquat: [f64; 4] = [1.0, 0.0, 0.0, 0.0],
        /// Scale along each axis.
        scale: [f64; 3] = [1.0; 3],
        /// How volume and inertia are computed.
        inertia: MeshInertia = MeshInertia::Legacy,
        /// Smooth normals across sharp edges.
        smoothnormal: bool = false,
        /// Most vertices of the convex hull, -1 for any number.
        maxhullvert: i32 = -1,
        /// Shape of a computed mesh and its parameters.
        builtin: Option<Shape> = None,
        /// Parameters of a generated mesh.
        params: Vec<f64> = Vec::new(),
        /// Vertex positions.
        uservert: Vec<f32> = Vec::new(),
        /// Vertex normals.
        usernormal: Vec<f32> = Vec::new(),
        /// Texture coordinates.
        usertexcoord: Vec<f32> = Vec::new(),
        /// Vertices of each triangle.
        userface: Vec<i32> = Vec::new(),
        /// Normal indices, three per triangle.
        userfacenormal: Vec<i32> = Vec::new(),
        /// Texture coordinate indices, three per triangle.
        userfacetexcoord: Vec<i32> = Vec::new(),
        /// Material.
        material: String = String::new(),
        /// Plugin whose surface it is.
        plugin: Option<PluginUse> = None,
        /// Most levels of the octree of a signed distance geom.
        octree_maxdepth: i32 = 6,
    }
    /// A height field.
    Hfield {
        /// Media type of the file.
        content_type: String = String::new(),
        /// File to open, empty without one.
        file: String = String::new(),
        /// Path of the file as the model keeps it.
        path: String = String::new(),
        /// Half lengths, height and base thickness, metres.
        size: [f64; 4] = [0.0; 4],
        /// Rows of data.
        nrow: i32 = 0,
        /// Columns of data.
        ncol: i32 = 0,
        /// Heights, top row first.
        userdata: Vec<f32> = Vec::new(),
    }
    /// A surface whose vertices follow bodies.
    Skin {
        /// File to open, empty for a skin given in place.
        file: String = String::new(),
        /// Path of the file as the model keeps it.
        path: String = String::new(),
        /// Material.
        material: String = String::new(),
        /// Colour and opacity.
        rgba: [f32; 4] = [0.5, 0.5, 0.5, 1.0],
        /// Distance by which vertices move along their normals, metres.
        inflate: f32 = 0.0,
        /// Group for visibility.
        group: i32 = 0,
        /// Vertex positions in the bind pose, three numbers each, metres.
        vert: Vec<f32> = Vec::new(),
        /// Texture coordinates, two numbers a vertex, or none.
        texcoord: Vec<f32> = Vec::new(),
        /// Vertices of each triangle.
        face: Vec<i32> = Vec::new(),
        /// The bodies that move the vertices.
        bones: Vec<Bone> = Vec::new(),
    }
    /// A texture: built in, from one file, or from six.
    Texture {
        /// What it is mapped onto.
        kind: TextureType = TextureType::Cube,
        /// Colour space.
        colorspace: ColorSpace = ColorSpace::Auto,
        /// Computed pattern.
        builtin: Builtin = Builtin::None,
        /// Marks on a computed pattern.
        mark: Mark = Mark::None,
        /// First colour.
        rgb1: [f64; 3] = [0.8; 3],
        /// Second colour.
        rgb2: [f64; 3] = [0.5; 3],
        /// Colour of the mark.
        markrgb: [f64; 3] = [0.0; 3],
        /// Density of random marks.
        random: f64 = 0.01,
        /// Height, pixels.
        height: i32 = 0,
        /// Width, pixels.
        width: i32 = 0,
        /// Channels a pixel.
        nchannel: i32 = 3,
        /// Media type of the file.
        content_type: String = String::new(),
        /// File to open, empty without one.
        file: String = String::new(),
        /// Path of the file as the model keeps it.
        path: String = String::new(),
        /// Rows and columns of sides in the file.
        gridsize: [i32; 2] = [1, 1],
        /// Symbols of the faces in the grid, row by row, out of `.RLUDFB`.
        gridlayout: String = String::from("............"),
        /// Right, left, up, down, front, back; empty where none is given.
        cubefiles: [String; 6] = Default::default(),
        /// The same files as the text names them.
        cubepaths: [String; 6] = Default::default(),
        /// Mirror left and right.
        hflip: bool = false,
        /// Mirror top and bottom.
        vflip: bool = false,
    }
    /// A material.
    Material {
        /// One name a texture role (`physics::model::TextureRole`); `texture=` fills role 1 (rgb).
        textures: [String; 10] = Default::default(),
        /// Repetitions count per metre.
        texuniform: bool = false,
        /// Repetitions of the texture.
        texrepeat: [f32; 2] = [1.0, 1.0],
        /// Emission.
        emission: f32 = 0.0,
        /// Specular reflection.
        specular: f32 = 0.5,
        /// Sharpness of highlights.
        shininess: f32 = 0.5,
        /// Mirror reflection of planes and boxes.
        reflectance: f32 = 0.0,
        /// Metallic share.
        metallic: f32 = -1.0,
        /// Roughness.
        roughness: f32 = -1.0,
        /// Colour and opacity.
        rgba: [f32; 4] = [1.0; 4],
    }
}

/// Name of an asset: its own, or its file's.
pub(crate) fn asset_name(name: &str, path: &str) -> String {
    if !name.is_empty() {
        return name.to_owned();
    }
    let base = base_name(path);
    base.rfind('.').map_or(base, |dot| &base[..dot]).to_owned()
}
