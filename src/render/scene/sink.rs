//! Where items are gathered: their form, their coat, and the list that they go into.

use super::item::{Category, Item, Look, Object, Shape};
use super::options::SceneOptions;
use crate::RenderError;
use physics::math::{Mat3, Vec3, add_scaled, column, cross, norm, ops, quat_from_axis_angle, quat_to_mat};
use physics::math::{add, scale, sub};
use physics::model::bounds::MINVAL;
use physics::model::{Appearance, GeomType, ObjType};
use physics::{Data, Model};

/// The matrix that turns nothing.
pub(super) const UPRIGHT: Mat3 = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// What items are made of.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    /// The model.
    pub m: &'a Model,
    /// Its present state, with all that follows from it.
    pub d: &'a Data,
    /// What is shown.
    pub options: &'a SceneOptions,
    /// What plugins show.
    pub appearance: &'a Appearance,
}

impl Source<'_> {
    /// Size of decorations: `factor` of `visual/scale` in metres.
    pub fn size(&self, factor: f32) -> f64 {
        f64::from(factor) * self.m.stat.meansize
    }

    /// Category of what is fixed to a body.
    pub fn category(&self, body: usize) -> Category {
        if self.m.body_weldid[body] == 0 { Category::Static } else { Category::Dynamic }
    }

    /// True when the scene holds items of a category.
    pub fn shows(&self, category: Category) -> bool {
        let categories = &self.options.categories;
        match category {
            Category::Static => categories.fixed && self.options.show.static_bodies,
            Category::Dynamic => categories.dynamic,
            Category::Decor => categories.decor,
        }
    }

    /// True when the body of an element may be shown.
    pub fn shows_body(&self, body: i32) -> bool {
        self.shows(self.category(body as usize))
    }

    /// Coat of an element of one material and colour. A colour other than the default replaces the material's colour.
    pub fn coat(&self, material: i32, rgba: [f32; 4], category: Category) -> Coat {
        let (m, show) = (self.m, &self.options.show);
        let mut coat = Coat { rgba, look: Look::default(), material: None };
        if let Ok(k) = usize::try_from(material) {
            if rgba == GREY {
                coat.rgba = m.mat_rgba[k];
            }
            coat.look = Look {
                emission: m.mat_emission[k],
                specular: m.mat_specular[k],
                shininess: m.mat_shininess[k],
                reflectance: m.mat_reflectance[k],
            };
            coat.material = show.textures.then_some(k);
        }
        if show.transparent && category == Category::Dynamic {
            coat.rgba[3] *= m.vis.map.alpha;
        }
        coat
    }

    /// Text beside an element: its name, or its kind and number.
    pub fn label(&self, kind: ObjType, id: usize) -> String {
        match self.m.name_of(kind, id) {
            "" => format!("{} {id}", format!("{kind:?}").to_lowercase()),
            name => name.to_owned(),
        }
    }
}

/// The colour of elements that were given none.
pub(super) const GREY: [f32; 4] = [0.5, 0.5, 0.5, 1.0];

/// Colour and surface of an item.
#[derive(Clone, Copy)]
pub(super) struct Coat {
    /// Colour and opacity.
    pub rgba: [f32; 4],
    /// How it answers light.
    pub look: Look,
    /// Material, for its texture.
    pub material: Option<usize>,
}

impl From<[f32; 4]> for Coat {
    fn from(rgba: [f32; 4]) -> Self {
        Coat { rgba, look: Look::default(), material: None }
    }
}

/// Shape of an item and where it is.
#[derive(Clone, Copy)]
pub(super) struct Form {
    pub shape: Shape,
    pub size: Vec3,
    pub pos: Vec3,
    pub mat: Mat3,
}

impl Form {
    /// A primitive with the sizes of a geom or site; none for shapes that a size does not tell.
    pub fn primitive(code: i32, size: Vec3, pos: Vec3, mat: &Mat3) -> Option<Self> {
        let round = [size[0], size[0], size[1]];
        let (shape, size) = match GeomType::from_code(code)? {
            GeomType::Sphere => (Shape::Sphere, [size[0]; 3]),
            GeomType::Ellipsoid => (Shape::Sphere, size),
            GeomType::Capsule => (Shape::Capsule, round),
            GeomType::Cylinder => (Shape::Cylinder, round),
            GeomType::Box => (Shape::Box, size),
            GeomType::Plane | GeomType::Hfield | GeomType::Mesh | GeomType::Sdf | GeomType::None => {
                return None;
            }
        };
        Some(Form { shape, size, pos, mat: *mat })
    }

    /// A ball.
    pub fn ball(radius: f64, pos: Vec3, mat: &Mat3) -> Self {
        Form { shape: Shape::Sphere, size: [radius; 3], pos, mat: *mat }
    }

    /// From one point to another: round shapes lie between them, arrows and lines begin at the first.
    pub fn connector(shape: Shape, width: f64, from: Vec3, to: Vec3) -> Self {
        let span = sub(to, from);
        let (length, mat) = (norm(span), from_z(span));
        match shape {
            Shape::Capsule | Shape::Cylinder => {
                Form { shape, size: [width, width, length * 0.5], pos: scale(add(from, to), 0.5), mat }
            }
            _ => Form { shape, size: [width, width, length], pos: from, mat },
        }
    }
}

/// Radius about its position within which an item lies, by MuJoCo's formula for items that are not geoms.
fn reach(form: &Form) -> f64 {
    let [x, y, z] = form.size;
    match form.shape {
        Shape::Capsule => x + z,
        Shape::Cylinder => norm([x, 0.0, z]),
        Shape::Box => norm(form.size),
        _ => x.max(y).max(z),
    }
}

/// The smallest rotation that takes z to the direction of `v`; about x where it is opposite, none for a vector without
/// direction.
pub(super) fn from_z(v: Vec3) -> Mat3 {
    let length = norm(v);
    if length < MINVAL {
        return UPRIGHT;
    }
    let v = scale(v, 1.0 / length);
    let across = cross([0.0, 0.0, 1.0], v);
    let sine = norm(across);
    if sine < MINVAL {
        return if v[2] < 0.0 { [1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0] } else { UPRIGHT };
    }
    quat_to_mat(quat_from_axis_angle(scale(across, 1.0 / sine), ops::atan2(sine, v[2])))
}

/// The items of a scene.
pub(super) struct Items<'a> {
    list: &'a mut Vec<Item>,
    /// What the first item that is not finite stands for.
    broken: Option<Object>,
}

impl<'a> Items<'a> {
    /// An empty list in the memory of `list`.
    pub fn within(list: &'a mut Vec<Item>) -> Self {
        list.clear();
        Items { list, broken: None }
    }

    /// Adds an item.
    pub fn add(&mut self, form: &Form, coat: Coat, object: Object, category: Category) -> &mut Item {
        let item = Item {
            shape: form.shape,
            pos: form.pos.map(|x| x as f32),
            mat: form.mat.map(|x| x as f32),
            size: form.size.map(|x| x as f32),
            rgba: coat.rgba,
            look: coat.look,
            material: coat.material,
            rbound: reach(form) as f32,
            object,
            category,
            unlisted: false,
            label: String::new(),
        };
        if !item.pos.iter().chain(&item.mat).chain(&item.size).all(|x| x.is_finite()) {
            self.broken = self.broken.or(Some(object));
        }
        self.list.push(item);
        let last = self.list.len() - 1;
        &mut self.list[last]
    }

    /// Adds a decoration.
    pub fn decor(&mut self, form: &Form, rgba: [f32; 4], object: Object) -> &mut Item {
        self.add(form, rgba.into(), object, Category::Decor)
    }

    /// Adds the axes of a frame: red x, green y, blue z.
    pub fn axes(&mut self, width: f64, length: f64, pos: Vec3, mat: &Mat3, id: usize) {
        for axis in 0..3 {
            let tip = add_scaled(pos, column(mat, axis), length);
            let mut rgba = [0.0, 0.0, 0.0, 1.0];
            rgba[axis] = 0.9;
            self.decor(&Form::connector(Shape::Cylinder, width, pos, tip), rgba, unnamed(id));
        }
    }

    /// An error when some item is not finite.
    pub fn finish(self, m: &Model) -> Result<(), RenderError> {
        self.broken.map_or(Ok(()), |object| {
            let kind = [
                ObjType::Flex,
                ObjType::Skin,
                ObjType::Geom,
                ObjType::Site,
                ObjType::Tendon,
                ObjType::Actuator,
                ObjType::Joint,
            ]
            .into_iter()
            .chain([ObjType::Body, ObjType::Camera, ObjType::Light, ObjType::Sensor, ObjType::Equality])
            .find(|kind| kind.code() == object.kind);
            let what = kind.map_or("a decoration".to_owned(), |kind| m.label_of(kind, object.id as usize));
            Err(RenderError::NotFinite { what })
        })
    }
}

/// An element of the model.
pub(super) fn element(kind: ObjType, id: usize) -> Object {
    Object { kind: kind.code(), id: id as i32 }
}

/// A decoration that belongs to a numbered thing that is not told.
pub(super) fn unnamed(id: usize) -> Object {
    element(ObjType::Unknown, id)
}
