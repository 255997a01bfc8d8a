//! Items of a scene as `MjvGeom` has them, in both directions.

use super::error::Fault;
use super::fresh::array;
use physics::table::Slice;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use render::View;
use render::scene::{Category, Item, Look, Object, Shape};

/// A geom that a program adds to a scene.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Guest {
    r#type: i32,
    dataid: i32,
    objtype: i32,
    objid: i32,
    size: [f32; 3],
    pos: [f32; 3],
    mat: [f32; 9],
    rgba: [f32; 4],
    /// Emission, specularity, shininess, reflectance.
    look: [f32; 4],
    label: String,
}

/// `mjtGeom` of shapes without data; spheres and ellipsoids are one shape here.
const PLAIN: [(Shape, i32); 10] = [
    (Shape::Sphere, 2),
    (Shape::Capsule, 3),
    (Shape::Sphere, 4),
    (Shape::Cylinder, 5),
    (Shape::Box, 6),
    (Shape::Arrow, 100),
    (Shape::ThinArrow, 101),
    (Shape::DoubleArrow, 102),
    (Shape::Line, 103),
    (Shape::LineBox, 104),
];
const LABEL: i32 = 107;
const TRIANGLE: i32 = 108;

impl Guest {
    /// The item to draw.
    ///
    /// # Errors
    /// It has a type that only elements of a model have, or a number that is not finite.
    pub fn item(&self, model_meshes: usize) -> Result<Item, Fault> {
        let mesh = usize::try_from(self.dataid).ok().filter(|id| id / 2 < model_meshes);
        let shape = match (self.r#type, mesh) {
            (7, Some(id)) if id % 2 == 0 => Shape::Mesh { mesh: id / 2 },
            (7, Some(id)) => Shape::Hull { mesh: id / 2 },
            (LABEL, _) => Shape::Label,
            (TRIANGLE, _) => Shape::Triangle,
            (code, _) => match PLAIN.iter().find(|(_, plain)| *plain == code) {
                Some((shape, _)) => *shape,
                None => {
                    return Err(Fault::Value(format!("a geom of type {code} cannot be added to a scene")));
                }
            },
        };
        let numbers = [&self.size[..], &self.pos, &self.mat, &self.rgba, &self.look];
        if numbers.iter().any(|part| part.iter().any(|x| !x.is_finite())) {
            return Err(Fault::Value(
                "a geom that was added to a scene has a number that is not finite".into(),
            ));
        }
        let [emission, specular, shininess, reflectance] = self.look;
        Ok(Item {
            shape,
            pos: self.pos,
            mat: self.mat,
            size: self.size,
            rgba: self.rgba,
            look: Look { emission, specular, shininess, reflectance },
            material: None,
            rbound: self.size.iter().map(|x| x * x).sum::<f32>().sqrt(),
            object: Object { kind: self.objtype, id: self.objid },
            category: Category::Decor,
            unlisted: false,
            label: self.label.clone(),
        })
    }
}

/// `type` and `dataid` of a shape.
fn codes(item: &Item) -> [i32; 2] {
    let plain = |shape| PLAIN.iter().find(|(own, _)| *own == shape).map_or(1001, |(_, code)| *code);
    match item.shape {
        Shape::Plane { .. } => [0, -1],
        Shape::Hfield { hfield } => [1, hfield as i32],
        Shape::Sphere if item.size[0] != item.size[1] || item.size[1] != item.size[2] => [4, -1],
        Shape::Mesh { mesh } => [7, 2 * mesh as i32],
        Shape::Hull { mesh } => [7, 2 * mesh as i32 + 1],
        Shape::Skin { skin } => [106, skin as i32],
        Shape::Label => [LABEL, -1],
        Shape::Triangle => [TRIANGLE, -1],
        shape => [plain(shape), -1],
    }
}

/// Fields of all items, arrays with one row for each; labels are a list.
pub fn describe<'py>(py: Python<'py>, items: &[Item]) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    let integers = |name: &str, of: &dyn Fn(&Item) -> i32| {
        let column: Vec<i32> = items.iter().map(of).collect();
        all.set_item(name, array(py, Slice::I32(&column), vec![items.len()])?)
    };
    integers("type", &|item| codes(item)[0])?;
    integers("dataid", &|item| codes(item)[1])?;
    integers("objtype", &|item| item.object.kind)?;
    integers("objid", &|item| item.object.id)?;
    integers("matid", &|item| item.material.map_or(-1, |id| id as i32))?;
    integers("unlisted", &|item| item.unlisted.into())?;
    integers("category", &|item| match item.category {
        Category::Static => 1,
        Category::Dynamic => 2,
        Category::Decor => 4,
    })?;
    let reals = |name: &str, width: usize, of: &dyn Fn(&Item) -> Vec<f32>| {
        let rows: Vec<f32> = items.iter().flat_map(of).collect();
        all.set_item(name, array(py, Slice::F32(&rows), vec![items.len(), width])?)
    };
    reals("size", 3, &|item| item.size.to_vec())?;
    reals("pos", 3, &|item| item.pos.to_vec())?;
    reals("mat", 9, &|item| item.mat.to_vec())?;
    reals("rgba", 4, &|item| item.rgba.to_vec())?;
    reals("rbound", 1, &|item| vec![item.rbound])?;
    reals("look", 4, &|item| {
        let Look { emission, specular, shininess, reflectance } = item.look;
        vec![emission, specular, shininess, reflectance]
    })?;
    all.set_item("label", items.iter().map(|item| item.label.as_str()).collect::<Vec<_>>())?;
    Ok(all)
}

/// Fields of a camera by their names in `MjvGLCamera`.
pub fn describe_view<'py>(py: Python<'py>, view: &View) -> PyResult<Bound<'py, PyDict>> {
    let all = PyDict::new(py);
    for (name, vector) in [("pos", view.eye), ("forward", view.forward), ("up", view.up)] {
        all.set_item(name, vector)?;
    }
    let frustum = &view.frustum;
    for (name, number) in [
        ("frustum_center", frustum.center),
        ("frustum_width", frustum.half_width.unwrap_or(0.0)),
        ("frustum_bottom", frustum.bottom),
        ("frustum_top", frustum.top),
        ("frustum_near", frustum.near),
        ("frustum_far", frustum.far),
    ] {
        all.set_item(name, number)?;
    }
    all.set_item("orthographic", i32::from(frustum.orthographic))?;
    Ok(all)
}
