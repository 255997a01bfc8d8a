//! Assets (XML reference: `asset`).

use super::element::elements;
use crate::files::base_name;
use crate::image::{Builtin, Mark};
use crate::mesh::{MeshInertia, Shape};
use physics::model::{ColorSpace, TextureType};

elements! {
    /// A triangle mesh from a file or from the element itself.
    Mesh {
        content_type: String = String::new(),
        /// What the file provider opens; empty for a mesh given in place.
        file: String = String::new(),
        /// The path MuJoCo stores in `paths`.
        path: String = String::new(),
        refpos: [f64; 3] = [0.0; 3],
        refquat: [f64; 4] = [1.0, 0.0, 0.0, 0.0],
        scale: [f64; 3] = [1.0; 3],
        inertia: MeshInertia = MeshInertia::Legacy,
        smoothnormal: bool = false,
        maxhullvert: i32 = -1,
        /// Shape of a computed mesh and its parameters.
        builtin: Option<Shape> = None,
        params: Vec<f64> = Vec::new(),
        uservert: Vec<f32> = Vec::new(),
        usernormal: Vec<f32> = Vec::new(),
        usertexcoord: Vec<f32> = Vec::new(),
        userface: Vec<i32> = Vec::new(),
        userfacenormal: Vec<i32> = Vec::new(),
        userfacetexcoord: Vec<i32> = Vec::new(),
        material: String = String::new(),
        octree_maxdepth: i32 = 6,
    }
    /// A height field.
    Hfield {
        content_type: String = String::new(),
        file: String = String::new(),
        path: String = String::new(),
        size: [f64; 4] = [0.0; 4],
        nrow: i32 = 0,
        ncol: i32 = 0,
        userdata: Vec<f32> = Vec::new(),
    }
    /// A texture: built in, from one file, or from six.
    Texture {
        kind: TextureType = TextureType::Cube,
        colorspace: ColorSpace = ColorSpace::Auto,
        builtin: Builtin = Builtin::None,
        mark: Mark = Mark::None,
        rgb1: [f64; 3] = [0.8; 3],
        rgb2: [f64; 3] = [0.5; 3],
        markrgb: [f64; 3] = [0.0; 3],
        random: f64 = 0.01,
        height: i32 = 0,
        width: i32 = 0,
        nchannel: i32 = 3,
        content_type: String = String::new(),
        file: String = String::new(),
        path: String = String::new(),
        gridsize: [i32; 2] = [1, 1],
        gridlayout: String = String::from("............"),
        /// Right, left, up, down, front, back; empty where none is given.
        cubefiles: [String; 6] = Default::default(),
        hflip: bool = false,
        vflip: bool = false,
    }
    /// A material.
    Material {
        /// One name a texture role (`physics::model::TextureRole`); `texture=` fills role 1 (rgb).
        textures: [String; 10] = Default::default(),
        texuniform: bool = false,
        texrepeat: [f32; 2] = [1.0, 1.0],
        emission: f32 = 0.0,
        specular: f32 = 0.5,
        shininess: f32 = 0.5,
        reflectance: f32 = 0.0,
        metallic: f32 = -1.0,
        roughness: f32 = -1.0,
        rgba: [f32; 4] = [1.0; 4],
    }
}

/// Name of an asset: its own, or that of its file.
pub(crate) fn asset_name(name: &str, path: &str) -> String {
    if !name.is_empty() {
        return name.to_owned();
    }
    let base = base_name(path);
    base.rfind('.').map_or(base, |dot| &base[..dot]).to_owned()
}
