//! Pictures of a simulation: colours, depth, segmentation, without a display.

use super::call::caught;
use super::data::Data;
use super::error::Fault;
use super::fresh::array;
use super::items::{Guest, describe, describe_view};
use super::model::Model;
use physics::table::Slice;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use render::picture::{Channels, Picture};
use render::scene::{Camera, Categories, Effects, FreeCamera, Groups, Scene, SceneOptions};
use render::{Assets, Profile, Renderer, Settings};
use std::sync::Mutex;

/// What draws the pictures of one model.
#[pyclass(frozen, module = "robohive._core.mujoco")]
pub struct Painter {
    held: Mutex<Held>,
}

struct Held {
    assets: Option<Assets>,
    scene: Scene,
    renderer: Option<Renderer>,
    picture: Picture,
    /// Meshes of the model.
    meshes: usize,
}

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
    /// Shadows, reflections, sky, haze, fog.
    effects: [bool; 5],
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
    fn camera(&self, model: &physics::Model) -> Camera {
        match (&self.camera, &self.free) {
            (Some(id), _) => Camera::Fixed(*id),
            (None, Some(free)) => Camera::Free(free.of(model)),
            (None, None) => Camera::free(model),
        }
    }

    fn options(&self) -> SceneOptions {
        let mut options = SceneOptions::default();
        let [geoms, sites, joints, tendons, actuators, skins, flexes] = self.groups;
        options.groups = Groups { geoms, sites, joints, tendons, actuators, skins, flexes };
        let [fixed, dynamic, decorations] = self.categories;
        options.categories = Categories { fixed, dynamic, decor: decorations };
        let [shadows, reflections, sky, haze, fog] = self.effects;
        options.effects = Effects::default()
            .with_shadows(shadows)
            .with_reflections(reflections)
            .with_sky(sky)
            .with_haze(haze)
            .with_fog(fog);
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
        options
    }
}

#[pymethods]
impl Painter {
    #[new]
    fn new(width: usize, height: usize) -> Self {
        let picture = Picture::new(width, height);
        let held = Held { assets: None, scene: Scene::new(), renderer: None, picture, meshes: 0 };
        Painter { held: Mutex::new(held) }
    }

    /// Takes in what is seen of the present state, whose poses must have been computed.
    fn look(&self, py: Python<'_>, m: &Bound<'_, Model>, d: &Bound<'_, Data>, look: Look) -> PyResult<()> {
        let compiled = m.get().current_for_pictures(py)?;
        let mut simulation = d.get().lock()?;
        simulation.check_fits(m.get())?;
        simulation.pull(py)?;
        let mut held = self.lock()?;
        let (inside, simulation) = (&mut *held, &simulation.simulation);
        Ok(py.detach(|| {
            caught(|| {
                let refused = |error: render::RenderError| Fault::Value(error.to_string());
                let view = look.camera(&compiled).view(&compiled, simulation).map_err(refused)?;
                inside.scene.update(&compiled, simulation, view, &look.options()).map_err(refused)?;
                match &mut inside.assets {
                    Some(assets) => assets.refresh(&compiled).map_err(refused)?,
                    None => {
                        inside.assets = Some(Assets::new(&compiled, Profile::default()).map_err(refused)?)
                    }
                }
                if let Some(assets) = &mut inside.assets {
                    assets.pose(&compiled, simulation, &look.options()).map_err(refused)?;
                }
                inside.meshes = compiled.nmesh;
                let settings = Settings::of(&compiled);
                match &mut inside.renderer {
                    Some(renderer) => *renderer.settings_mut() = settings,
                    None => inside.renderer = Some(Renderer::new(settings)),
                }
                Ok(())
            })
        })?)
    }

    /// Draws what was last looked at: `rgb` (height, width, 3), `depth` (height, width) [m] or `segmentation` (height,
    /// width, 2).
    fn draw<'py>(&self, py: Python<'py>, channel: &str) -> PyResult<Bound<'py, PyAny>> {
        let channels = match channel {
            "rgb" => Channels::RGB,
            "depth" => Channels::DEPTH,
            _ => Channels::SEGMENTATION,
        };
        let mut held = self.ready()?;
        let inside = &mut *held;
        py.detach(|| caught(|| inside.draw(channels)))?;
        shown(py, &held.picture, channel)
    }

    /// Draws what was last looked at, and `guests`, in pictures of this size: colours, distances, objects.
    fn draw_all<'py>(
        &self,
        py: Python<'py>,
        size: (usize, usize),
        guests: Vec<Guest>,
    ) -> PyResult<[Bound<'py, PyAny>; 3]> {
        let mut held = self.ready()?;
        let inside = &mut *held;
        py.detach(|| {
            caught(|| {
                (inside.picture.width, inside.picture.height) = size;
                let (own, meshes) = (inside.scene.items.len(), inside.meshes);
                let items = guests.iter().map(|guest| guest.item(meshes)).collect::<Result<Vec<_>, _>>()?;
                inside.scene.items.extend(items);
                let outcome = inside.draw(Channels::ALL);
                inside.scene.items.truncate(own);
                outcome
            })
        })?;
        let of = |channel| shown(py, &held.picture, channel);
        Ok([of("rgb")?, of("depth")?, of("segmentation")?])
    }

    /// The items last looked at, by the fields of `MjvGeom`, and the camera, by the fields of `MjvGLCamera`.
    fn items<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyDict>)> {
        let held = self.ready()?;
        Ok((describe(py, &held.scene.items)?, describe_view(py, &held.scene.view)?))
    }
}

/// The letters of a text as pictures draw them: eight rows each from the top, of eight pixels, the lowest bit first.
#[pyfunction]
pub fn letter_rows(text: &str) -> Vec<[u8; 8]> {
    text.chars().map(render::raster::letter_rows).collect()
}

impl Held {
    fn draw(&mut self, channels: Channels) -> Result<(), Fault> {
        let Held { assets, scene, renderer, picture, .. } = self;
        let (Some(assets), Some(renderer)) = (assets.as_ref(), renderer.as_mut()) else {
            return Ok(());
        };
        renderer.draw(assets, scene, channels, picture).map_err(|error| Fault::Value(error.to_string()))
    }
}

/// One channel of a picture as an array.
fn shown<'py>(py: Python<'py>, picture: &Picture, channel: &str) -> PyResult<Bound<'py, PyAny>> {
    let (rows, columns) = (picture.height, picture.width);
    match channel {
        "rgb" => array(py, Slice::U8(&picture.rgb), vec![rows, columns, 3]),
        "depth" => array(py, Slice::F32(&picture.depth), vec![rows, columns]),
        _ => array(py, Slice::I32(picture.segmentation.as_flattened()), vec![rows, columns, 2]),
    }
}

impl Painter {
    /// What it holds, once there is a scene.
    fn ready(&self) -> PyResult<std::sync::MutexGuard<'_, Held>> {
        let held = self.lock()?;
        if held.renderer.is_none() {
            return Err(PyRuntimeError::new_err("there is no scene yet: call update_scene before render"));
        }
        Ok(held)
    }

    fn lock(&self) -> PyResult<std::sync::MutexGuard<'_, Held>> {
        self.held.try_lock().map_err(|_| {
            PyRuntimeError::new_err("this Renderer is in use by another thread; give each its own")
        })
    }
}
