//! Elements of a model by name, and its arrays.

use crate::simulation::{Simulation, exception};
use physics::Model;
use physics::model::{ObjType, Suggestions};
use physics::table::Slice;
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// How many elements of a kind a model has.
type Count = fn(&Model) -> usize;

/// Kinds of elements that have names, as MJCF calls them.
const KINDS: [(&str, ObjType, Count); 16] = [
    ("body", ObjType::Body, |m| m.nbody),
    ("joint", ObjType::Joint, |m| m.njnt),
    ("geom", ObjType::Geom, |m| m.ngeom),
    ("site", ObjType::Site, |m| m.nsite),
    ("camera", ObjType::Camera, |m| m.ncam),
    ("light", ObjType::Light, |m| m.nlight),
    ("mesh", ObjType::Mesh, |m| m.nmesh),
    ("flex", ObjType::Flex, |m| m.nflex),
    ("hfield", ObjType::Hfield, |m| m.nhfield),
    ("texture", ObjType::Texture, |m| m.ntex),
    ("material", ObjType::Material, |m| m.nmat),
    ("equality", ObjType::Equality, |m| m.neq),
    ("tendon", ObjType::Tendon, |m| m.ntendon),
    ("actuator", ObjType::Actuator, |m| m.nactuator),
    ("sensor", ObjType::Sensor, |m| m.nsensor),
    ("key", ObjType::Key, |m| m.nkey),
];

fn kind_of(name: &str) -> Result<(ObjType, Count), JsError> {
    let found = KINDS.iter().find(|(kind, ..)| *kind == name);
    found.map(|&(_, kind, count)| (kind, count)).ok_or_else(|| {
        let kinds: Vec<&str> = KINDS.iter().map(|(kind, ..)| *kind).collect();
        exception(format!("no kind of elements is called {name:?}: {}", kinds.join(", ")))
    })
}

/// An array of a model or of a simulation: its shape, and its numbers row by row.
#[wasm_bindgen]
pub struct NamedArray {
    shape: Vec<usize>,
    values: Vec<f64>,
}

#[wasm_bindgen]
impl NamedArray {
    /// Numbers along each axis; empty for a single number.
    #[wasm_bindgen(getter)]
    pub fn shape(&self) -> Vec<usize> {
        self.shape.clone()
    }

    /// The numbers, row by row.
    #[wasm_bindgen(getter)]
    pub fn values(&self) -> Vec<f64> {
        self.values.clone()
    }
}

#[wasm_bindgen]
impl Simulation {
    /// Names of all elements of a kind (`body`, `joint`, `geom`, `site`, `camera`, `light`, `mesh`, `flex`, `hfield`, `texture`,
    /// `material`, `equality`, `tendon`, `actuator`, `sensor`, `key`), in the order of their ids; empty where there is no name.
    ///
    /// # Errors
    /// There is no such kind.
    pub fn names(&self, kind: &str) -> Result<Vec<String>, JsError> {
        let (kind, count) = kind_of(kind)?;
        let model = self.session.model();
        Ok((0..count(model)).map(|id| model.name_of(kind, id).to_owned()).collect())
    }

    /// The id of an element by its name.
    ///
    /// # Errors
    /// There is no such kind or element.
    pub fn id(&self, kind: &str, name: &str) -> Result<usize, JsError> {
        let (object, count) = kind_of(kind)?;
        let model = self.session.model();
        model.id_of(object, name).ok_or_else(|| {
            let names = (0..count(model)).map(|id| model.name_of(object, id));
            let nearest = Suggestions::default().nearest(name, names);
            let hint = nearest.map_or(String::new(), |nearest| format!("; did you mean {nearest:?}?"));
            exception(format!("no {kind} is called {name:?}{hint}"))
        })
    }

    /// An array by MuJoCo's name, of the simulation (`xpos`, `qfrc_constraint`, `contact.dist`) or else of the model
    /// (`body_mass`, `jnt_range`): a copy, as every array that JavaScript gets.
    ///
    /// # Errors
    /// There is no such array.
    pub fn array(&self, name: &str) -> Result<NamedArray, JsError> {
        let (model, data) = (self.session.model(), self.session.data());
        let (mut found, mut names) = (None, Vec::new());
        let mut look = |field: &'static str, shape: Vec<usize>, values: Slice<'_>| {
            if field == name && found.is_none() {
                found = Some(NamedArray { shape, values: values.to_f64() });
            }
            names.push(field);
        };
        data.visit(model, &mut look);
        model.visit(&mut look);
        model.visit_sizes(&mut |name, size| look(name, vec![], Slice::I32(&[size as i32])));
        found.ok_or_else(|| {
            let nearest = Suggestions::default().nearest(name, names.into_iter());
            let hint = nearest.map_or(String::new(), |nearest| format!("; did you mean {nearest:?}?"));
            exception(format!("no array is called {name:?}{hint}"))
        })
    }
}
