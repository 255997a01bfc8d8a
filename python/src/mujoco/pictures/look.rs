//! What a picture shows, as Python says it.

use crate::mujoco::error::Fault;
use pyo3::prelude::*;
use render::scene::{
    Camera, Categories, Effects, Fog, FrameChoice, FreeCamera, Groups, Haze, LabelChoice, Pull, Scene,
    SceneOptions, Selection,
};

/// A free camera: what it looks at, distance, azimuth and elevation [deg], parallel rays.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Free {
    lookat: [f64; 3],
    track: Option<usize>,
    distance: f64,
    azimuth: f64,
    elevation: f64,
    orthographic: bool,
}

/// What a picture shows.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Look {
    /// A camera of the model, or the free one.
    camera: Option<usize>,
    free: Option<Free>,
    /// Visible groups of geoms, sites, joints, tendons, actuators, skins, flexes.
    groups: [[bool; 6]; 7],
    /// Flags by the names of the fields of `render::scene::Show` that the renderer takes.
    shown: Vec<String>,
    /// Items of bodies that are fixed, of those that move, decorations.
    categories: [bool; 3],
    /// Elements that get a label or a frame, by MuJoCo's numbers.
    label: i64,
    frame: i64,
    /// Depth of bounding volumes, and layer of flexes.
    bvh_depth: i32,
    flex_layer: i32,
    /// The body that is pulled.
    selection: Option<Pulled>,
}

/// A selected body: its number, the point on it, how it is pulled, by a second hand too, and where to.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct Pulled {
    body: usize,
    point: [f64; 3],
    active: i32,
    active2: i32,
    target: [f64; 3],
    orientation: [f64; 4],
}

/// Bits of `mjtPertBit`.
const TRANSLATE: i32 = 1;
const ROTATE: i32 = 2;

impl Pulled {
    fn selection(&self) -> Selection {
        let pull = |bits: i32| Pull { translation: bits & TRANSLATE != 0, rotation: bits & ROTATE != 0 };
        Selection {
            body: self.body,
            point: self.point,
            pull: pull(self.active),
            second_pull: pull(self.active2),
            target: self.target,
            orientation: self.orientation,
        }
    }
}

/// Elements that can have labels, in the order of MuJoCo's numbers.
const LABELS: [LabelChoice; 17] = [
    LabelChoice::None,
    LabelChoice::Body,
    LabelChoice::Joint,
    LabelChoice::Geom,
    LabelChoice::Site,
    LabelChoice::Camera,
    LabelChoice::Light,
    LabelChoice::Tendon,
    LabelChoice::Actuator,
    LabelChoice::Constraint,
    LabelChoice::Flex,
    LabelChoice::Skin,
    LabelChoice::Selection,
    LabelChoice::SelectedPoint,
    LabelChoice::ContactPoint,
    LabelChoice::ContactForce,
    LabelChoice::Island,
];

/// Elements that can show their frames, in the order of MuJoCo's numbers.
const FRAMES: [FrameChoice; 8] = [
    FrameChoice::None,
    FrameChoice::Body,
    FrameChoice::Geom,
    FrameChoice::Site,
    FrameChoice::Camera,
    FrameChoice::Light,
    FrameChoice::Contact,
    FrameChoice::World,
];

/// What a number stands for.
fn chosen<T: Copy>(list: &[T], kind: &str, number: i64) -> Result<T, Fault> {
    let found = usize::try_from(number).ok().and_then(|place| list.get(place).copied());
    found.ok_or_else(|| {
        Fault::Value(format!("MjvOption.{kind} is {number}, not one of 0 to {}", list.len() - 1))
    })
}

impl Free {
    /// The camera in a model, whose field of view it has.
    pub fn of(&self, model: &physics::Model) -> FreeCamera {
        FreeCamera {
            lookat: self.lookat,
            track: self.track,
            distance: self.distance,
            azimuth: self.azimuth,
            elevation: self.elevation,
            orthographic: self.orthographic,
            ..FreeCamera::of(model)
        }
    }
}

impl Look {
    /// Where it is seen from.
    pub fn camera(&self, model: &physics::Model) -> Camera {
        match (&self.camera, &self.free) {
            (Some(id), _) => Camera::Fixed(*id),
            (None, Some(free)) => Camera::Free(free.of(model)),
            (None, None) => Camera::free(model),
        }
    }

    /// What it shows, with all effects.
    ///
    /// # Errors
    /// A label or frame is none.
    pub fn options(&self) -> Result<SceneOptions, Fault> {
        let mut options = SceneOptions::default();
        options.label = chosen(&LABELS, "label", self.label)?;
        options.frame = chosen(&FRAMES, "frame", self.frame)?;
        (options.tree_depth, options.flex_layer) = (self.bvh_depth, self.flex_layer);
        options.selection = self.selection.as_ref().map(Pulled::selection);
        options.effects = Effects::default().with_fog(true);
        let [geoms, sites, joints, tendons, actuators, skins, flexes] = self.groups;
        options.groups = Groups { geoms, sites, joints, tendons, actuators, skins, flexes };
        let [fixed, dynamic, decorations] = self.categories;
        options.categories = Categories { fixed, dynamic, decor: decorations };
        let has = |name: &str| self.shown.iter().any(|shown| shown == name);
        let show = &mut options.show;
        show.textures = has("TEXTURE");
        show.static_bodies = has("STATIC");
        show.tendons = has("TENDON");
        show.skins = has("SKIN");
        show.flex_vertices = has("FLEXVERT");
        show.flex_edges = has("FLEXEDGE");
        show.flex_faces = has("FLEXFACE");
        show.flex_skins = has("FLEXSKIN");
        show.rangefinders = has("RANGEFINDER");
        show.convex_hulls = has("CONVEXHULL");
        show.transparent = has("TRANSPARENT");
        show.joints = has("JOINT");
        show.actuators = has("ACTUATOR");
        show.cameras = has("CAMERA");
        show.lights = has("LIGHT");
        show.constraints = has("CONSTRAINT");
        show.inertias = has("INERTIA");
        show.centers_of_mass = has("COM");
        show.contact_points = has("CONTACTPOINT");
        show.contact_forces = has("CONTACTFORCE");
        show.activations = has("ACTIVATION");
        show.scaled_inertias = has("SCLINERTIA");
        show.applied_forces = has("PERTFORCE");
        show.perturbation = has("PERTOBJ");
        show.islands = has("ISLAND");
        show.split_forces = has("CONTACTSPLIT");
        show.connections = has("AUTOCONNECT");
        show.selected_point = has("SELECT");
        show.body_trees = has("BODYBVH");
        show.mesh_trees = has("MESHBVH");
        Ok(options)
    }
}

/// Whether pictures have shadows, reflections, sky, haze, fog, wireframe, additive transparency, and no backs of surfaces.
pub type Switches = [bool; 8];

/// What surrounds a scene with all effects, of which pictures take some.
#[derive(Clone, Copy, Default)]
pub struct Around {
    sky: Option<usize>,
    haze: Option<Haze>,
    fog: Option<Fog>,
}

impl Around {
    /// Of a scene with all effects.
    pub fn of(scene: &Scene) -> Self {
        Around { sky: scene.sky, haze: scene.haze, fog: scene.fog }
    }

    /// Gives the scene the effects that are on.
    pub fn set(&self, scene: &mut Scene, effects: Switches) {
        let [shadows, reflections, sky, haze, fog, wireframe, additive, culling] = effects;
        (scene.shadows, scene.reflections) = (shadows, reflections);
        scene.sky = self.sky.filter(|_| sky);
        scene.haze = self.haze.filter(|_| sky && haze);
        scene.fog = self.fog.filter(|_| fog);
        (scene.wireframe, scene.additive, scene.culling) = (wireframe, additive, culling);
    }
}
