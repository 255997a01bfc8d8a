//! One thing to draw.

/// Shape of an item, and the array that holds it where a size is not enough.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Shape {
    /// Rectangle in the frame's xy plane, seen from +z; half sizes of 0 are infinite. The geom, for its own grid.
    Plane {
        /// Geom of the model.
        geom: usize,
    },
    /// Height field.
    Hfield {
        /// Height field of the model.
        hfield: usize,
    },
    /// Ball or ellipsoid with half axes `size`.
    Sphere,
    /// Capsule along z: radius `size[0]`, half length of its cylinder `size[2]`.
    Capsule,
    /// Cylinder along z: radii `size[0]` and `size[1]`, half length `size[2]`.
    Cylinder,
    /// Box with half sides `size`.
    Box,
    /// Mesh of the model.
    Mesh {
        /// Mesh of the model.
        mesh: usize,
    },
    /// Convex hull of a mesh of the model.
    Hull {
        /// Mesh of the model.
        mesh: usize,
    },
    /// Skin of the model, whose vertices are in the world: the position only sorts it.
    Skin {
        /// Skin of the model.
        skin: usize,
    },
    /// Flex of the model, whose vertices are in the world: the position only sorts it.
    Flex {
        /// Flex of the model.
        flex: usize,
    },
    /// Arrow along +z from the origin: width `size[0]`, `size[1]`, length `size[2]`.
    Arrow,
    /// Arrow without a wider head.
    ThinArrow,
    /// Arrow with a head at both ends: as [`Shape::Arrow`], and as far along -z.
    DoubleArrow,
    /// Line along +z from the origin, of length `size[2]` and of `size[0]` times `visual/global linewidth` pixels.
    Line,
    /// Edges of a box with half sides `size`.
    LineBox,
    /// Triangle with corners at the origin, at `size[0]` along the first and `size[1]` along the second column of the
    /// orientation, which need not be normal to each other. Seen from both sides.
    Triangle,
    /// Nothing but its label.
    Label,
}

/// What an item stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Object {
    /// Type of object, the code of an `ObjType`; -1 for none.
    pub kind: i32,
    /// Number of the object, -1 for none.
    pub id: i32,
}

/// How an item came into the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Category {
    /// Of a body that is fixed to the world.
    Static,
    /// Of a body that moves.
    Dynamic,
    /// A decoration: it casts no shadow.
    Decor,
}

/// How the surface of an item answers light, without its colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Light of its own, in units of the colour.
    pub emission: f32,
    /// Strength of highlights.
    pub specular: f32,
    /// Sharpness of highlights, 0 to 1.
    pub shininess: f32,
    /// Strength of the mirror image.
    pub reflectance: f32,
}

impl Default for Look {
    /// Without a material.
    fn default() -> Self {
        Look { emission: 0.0, specular: 0.5, shininess: 0.5, reflectance: 0.0 }
    }
}

/// One thing to draw, world frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// Its shape.
    pub shape: Shape,
    /// Position \[m\].
    pub pos: [f32; 3],
    /// Orientation, row-major.
    pub mat: [f32; 9],
    /// Half sizes; what each means depends on the shape \[m\].
    pub size: [f32; 3],
    /// Colour and opacity, of the element or its material.
    pub rgba: [f32; 4],
    /// How it answers light.
    pub look: Look,
    /// Material of the model, for its texture; none for decorations.
    pub material: Option<usize>,
    /// Radius about the position within which the item lies, 0 for planes: transparent items are sorted by the distance of
    /// the eye less this \[m\].
    pub rbound: f32,
    /// What it stands for.
    pub object: Object,
    /// How it came into the scene.
    pub category: Category,
    /// It is left out of segmentation and depth.
    pub unlisted: bool,
    /// Text to show beside it; empty for none.
    pub label: String,
}
