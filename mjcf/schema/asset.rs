//! `asset`: meshes, height fields, textures, materials and skins.

use physics::model::{ColorSpace, TextureType};

use super::Bind::*;
use super::plugin::PLUGIN;
use super::tree::CLASS;
use super::{ElementType, Kind, Row, Rule, Space, Words, any, leaf, local, required, row, section};
use crate::image::{Builtin, Mark};
use crate::mesh::{MeshInertia, Shape};
use crate::spec::{Bone, Hfield, Material, Mesh, Skin, Texture};

/// `asset`.
pub static ASSET: ElementType = section(
    "asset",
    "Geometry and looks that elements refer to",
    &[any(&MESH), any(&HFIELD), any(&TEXTURE), any(&MATERIAL), any(&SKIN), any(&MODEL)],
);
/// `mesh`.
pub static MESH: ElementType = leaf("mesh", "A triangle mesh", &[&CLASS, &MESH_ROWS])
    .children(&[any(&PLUGIN)])
    .rules(&[Rule::Exclusive(&[&["builtin"], &["file"]]), Rule::Exclusive(&[&["builtin"], &["vertex"]])]);
static HFIELD: ElementType = leaf("hfield", "A height field", &[&HFIELD_ROWS]);
static TEXTURE: ElementType = leaf("texture", "An image or a pattern", &[&TEXTURE_ROWS]);
/// `material`.
pub static MATERIAL: ElementType =
    leaf("material", "Looks of a surface", &[&CLASS, &MATERIAL_ROWS]).children(&[any(&LAYER)]);
static LAYER: ElementType = leaf("layer", "A texture of a material in one role", &[&LAYER_ROWS]);
/// `skin`.
pub static SKIN: ElementType =
    leaf("skin", "A surface that follows bodies, for pictures only", &[&SKIN_ROWS]).children(&[any(&BONE)]);
static BONE: ElementType = leaf("bone", "A body that moves vertices of a skin", &[&BONE_ROWS]);
static MODEL: ElementType = leaf("model", "A model that parts are attached from", &[&MODEL_ROWS]);

/// Attributes of `model`.
static MODEL_ROWS: [Row<()>; 3] = [
    row("name", Own(Kind::Text), "name; that of the model itself if empty"),
    required("file", Own(Kind::File), "file of the model"),
    row("content_type", Own(Kind::Text), "type of the file; only MJCF is read"),
];

const MESH_INERTIAS: Words = &[("convex", 0), ("exact", 1), ("legacy", 2), ("shell", 3)];
const BUILTIN_MESHES: Words = &[
    ("none", 0),
    ("sphere", 1),
    ("hemisphere", 2),
    ("cone", 3),
    ("supersphere", 4),
    ("supertorus", 5),
    ("wedge", 6),
    ("plate", 7),
];
const TEXTURE_TYPES: Words = &[("2d", 0), ("cube", 1), ("skybox", 2)];
const COLOR_SPACES: Words = &[("auto", 0), ("linear", 1), ("sRGB", 2)];
const BUILTINS: Words = &[("none", 0), ("gradient", 1), ("checker", 2), ("flat", 3)];
const MARKS: Words = &[("none", 0), ("edge", 1), ("cross", 2), ("random", 3)];
/// Roles of a texture in a material; the code is the slot.
pub const ROLES: Words = &[
    ("rgb", 1),
    ("occlusion", 2),
    ("roughness", 3),
    ("metallic", 4),
    ("normal", 5),
    ("opacity", 6),
    ("emissive", 7),
    ("rgba", 8),
    ("orm", 9),
];

/// Sides of a cube texture in the order of `Texture::cubefiles`.
pub const SIDES: [&str; 6] = ["fileright", "fileleft", "fileup", "filedown", "filefront", "fileback"];

/// Attributes of `mesh`.
pub static MESH_ROWS: [Row<Mesh>; 16] = [
    row("name", Name(Space::Mesh, |m| &mut m.name), "name; the file's stem if absent"),
    local("content_type", Text(|m| &mut m.content_type), "media type of the file"),
    local("file", Own(Kind::File), "STL, OBJ or MSH file"),
    local("vertex", SingleList(|m| &mut m.uservert), "vertex positions"),
    local("normal", SingleList(|m| &mut m.usernormal), "vertex normals"),
    local("texcoord", SingleList(|m| &mut m.usertexcoord), "texture coordinates"),
    local("face", IntList(|m| &mut m.userface), "vertices of each triangle"),
    local("refpos", Reals { min: 3, field: |m| &mut m.refpos }, "origin in the file's frame"),
    local("refquat", Reals { min: 4, field: |m| &mut m.refquat }, "orientation in the file's frame"),
    row("scale", Reals { min: 3, field: |m| &mut m.scale }, "scale along each axis"),
    local("smoothnormal", Bool(|m| &mut m.smoothnormal), "smooth normals across sharp edges"),
    row("maxhullvert", Int(|m| &mut m.maxhullvert), "most vertices of the convex hull, -1 for any number"),
    row(
        "inertia",
        Keyword {
            words: MESH_INERTIAS,
            assign: |m, c| {
                use MeshInertia::*;
                m.inertia = [Convex, Exact, Legacy, Shell][c as usize];
            },
        },
        "how mass and inertia follow from the surface",
    ),
    local(
        "builtin",
        Keyword {
            words: BUILTIN_MESHES,
            assign: |m, c| {
                use Shape::*;
                let shapes = [Sphere, Hemisphere, Cone, Supersphere, Supertorus, Wedge, Plate];
                m.builtin = usize::try_from(c - 1).ok().map(|k| shapes[k]);
            },
        },
        "shape of a generated mesh",
    ),
    local("params", RealList(|m| &mut m.params), "parameters of a generated mesh"),
    local("material", Ref(Space::Material, |m| &mut m.material), "material"),
];

/// Attributes of `hfield`.
pub static HFIELD_ROWS: [Row<Hfield>; 7] = [
    row("name", Name(Space::Hfield, |h| &mut h.name), "name; the file's stem if absent"),
    row("content_type", Text(|h| &mut h.content_type), "media type of the file"),
    row("file", Own(Kind::File), "PNG or binary file"),
    row("nrow", Int(|h| &mut h.nrow), "rows of data"),
    row("ncol", Int(|h| &mut h.ncol), "columns of data"),
    required(
        "size",
        Reals { min: 4, field: |h| &mut h.size },
        "half lengths, height and base thickness, metres",
    ),
    row("elevation", SingleList(|h| &mut h.userdata), "heights, top row first"),
];

/// Attributes of `skin`.
pub static SKIN_ROWS: [Row<Skin>; 9] = [
    row("name", Name(Space::Skin, |s| &mut s.name), "name; the file's stem if absent"),
    row("file", Own(Kind::File), "SKN file, in place of vertices, faces and bones"),
    row("material", Ref(Space::Material, |s| &mut s.material), "material"),
    row("rgba", Singles(|s| &mut s.rgba), "colour and opacity"),
    row("inflate", Single(|s| &mut s.inflate), "distance by which vertices move along their normals, metres"),
    row("vertex", SingleList(|s| &mut s.vert), "vertex positions in the bind pose, metres"),
    row("texcoord", SingleList(|s| &mut s.texcoord), "texture coordinates of the vertices"),
    row("face", IntList(|s| &mut s.face), "vertices of each triangle"),
    row("group", Int(|s| &mut s.group), "group for visibility, 0 to 5"),
];

/// Attributes of `bone`.
pub static BONE_ROWS: [Row<Bone>; 5] = [
    required("body", Ref(Space::Body, |b| &mut b.body), "body that moves the vertices"),
    required("bindpos", Singles(|b| &mut b.bindpos), "position of the body in the bind pose, metres"),
    required("bindquat", Singles(|b| &mut b.bindquat), "orientation of the body in the bind pose"),
    required("vertid", IntList(|b| &mut b.vertid), "vertices that it moves"),
    required(
        "vertweight",
        SingleList(|b| &mut b.vertweight),
        "weight of each; divided by the sum of a vertex",
    ),
];

/// Attributes of `texture`.
pub static TEXTURE_ROWS: [Row<Texture>; 24] = [
    row("name", Name(Space::Texture, |t| &mut t.name), "name; the file's stem if absent"),
    row(
        "type",
        Keyword { words: TEXTURE_TYPES, assign: |t, c| t.kind = TextureType::from_code(c).unwrap_or(t.kind) },
        "what it is mapped onto",
    ),
    row(
        "colorspace",
        Keyword {
            words: COLOR_SPACES,
            assign: |t, c| t.colorspace = ColorSpace::from_code(c).unwrap_or(t.colorspace),
        },
        "colour space",
    ),
    row("content_type", Text(|t| &mut t.content_type), "media type of the file"),
    row("file", Own(Kind::File), "PNG or custom file"),
    row("gridsize", Ints(|t| &mut t.gridsize), "rows and columns of sides in the file"),
    row("gridlayout", Own(Kind::Text), "which side each grid cell holds"),
    row("fileright", Own(Kind::File), "file of one side"),
    row("fileleft", Own(Kind::File), "file of one side"),
    row("fileup", Own(Kind::File), "file of one side"),
    row("filedown", Own(Kind::File), "file of one side"),
    row("filefront", Own(Kind::File), "file of one side"),
    row("fileback", Own(Kind::File), "file of one side"),
    row(
        "builtin",
        Keyword {
            words: BUILTINS,
            assign: |t, c| {
                use Builtin::*;
                t.builtin = [None, Gradient, Checker, Flat][c as usize];
            },
        },
        "generated pattern",
    ),
    row("rgb1", Reals { min: 3, field: |t| &mut t.rgb1 }, "first colour"),
    row("rgb2", Reals { min: 3, field: |t| &mut t.rgb2 }, "second colour"),
    row(
        "mark",
        Keyword {
            words: MARKS,
            assign: |t, c| {
                use Mark::*;
                t.mark = [None, Edge, Cross, Random][c as usize];
            },
        },
        "mark over the pattern",
    ),
    row("markrgb", Reals { min: 3, field: |t| &mut t.markrgb }, "colour of the mark"),
    row("random", Real(|t| &mut t.random), "density of random marks"),
    row("width", Int(|t| &mut t.width), "width, pixels"),
    row("height", Int(|t| &mut t.height), "height, pixels"),
    row("hflip", Bool(|t| &mut t.hflip), "mirror left and right"),
    row("vflip", Bool(|t| &mut t.vflip), "mirror top and bottom"),
    row("nchannel", Int(|t| &mut t.nchannel), "channels a pixel"),
];

/// Attributes of `material`.
pub static MATERIAL_ROWS: [Row<Material>; 11] = [
    row("name", Name(Space::Material, |m| &mut m.name), "name"),
    row("texture", Ref(Space::Texture, |m| &mut m.textures[1]), "texture of the surface colour"),
    row("texrepeat", Singles(|m| &mut m.texrepeat), "repetitions of the texture"),
    row("texuniform", Bool(|m| &mut m.texuniform), "repetitions count per metre"),
    row("emission", Single(|m| &mut m.emission), "emission"),
    row("specular", Single(|m| &mut m.specular), "specular reflection"),
    row("shininess", Single(|m| &mut m.shininess), "sharpness of highlights"),
    row("reflectance", Single(|m| &mut m.reflectance), "mirror reflection of planes and boxes"),
    row("metallic", Single(|m| &mut m.metallic), "metallic share"),
    row("roughness", Single(|m| &mut m.roughness), "roughness"),
    row("rgba", Singles(|m| &mut m.rgba), "colour and opacity"),
];

/// Attributes of `layer`.
pub static LAYER_ROWS: [Row<()>; 2] = [
    required("texture", Own(Kind::Ref(Space::Texture)), "texture"),
    required("role", Own(Kind::Keyword(ROLES)), "what the texture sets"),
];
