//! Our own pictures of a recorded pose.

use super::items::{Differences, compare};
use super::measures::Geometry;
use super::plan::{Effect, SceneRow};
use super::recording::Recording;
use super::views::Views;
use physics::model::ObjType;
use physics::{Data, Model, forward};
use render::picture::Channels;
use render::raster::{Renderer, Samples, Settings};
use render::scene::{Camera, Effects, SceneOptions};
use render::{Assets, Picture, Profile, Scene};
use std::path::Path;

/// A scene in its recorded pose, and what draws it.
pub struct Drawn {
    model: Model,
    data: Data,
    camera: Camera,
    assets: Assets,
    renderer: Renderer,
    effects: Effects,
}

impl Drawn {
    /// Loads the model and sets the recorded pose.
    ///
    /// # Errors
    /// The model does not load, or is not the recorded one.
    pub fn open(models: Option<&Path>, scene: &SceneRow, recorded: &Recording) -> Result<Self, String> {
        let path = scene.path(models);
        let loader =
            scene.define.iter().fold(mjcf::Loader::default(), |loader, (from, to)| loader.define(from, to));
        let mut model = loader.load(&path).map_err(|error| error.to_string())?.model;
        if let Some(geom) = &scene.terrain {
            raise(&mut model, geom, recorded)?;
        }
        let mut data = Data::new(&model);
        if model.nkey > 0 {
            data.reset_to_key(&model, 0).map_err(|error| error.to_string())?;
        }
        let state = &mut data.state;
        state.qvel.fill(0.0);
        place(&mut state.qpos, recorded, "qpos")?;
        place(&mut state.act, recorded, "act")?;
        place(state.mocap_pos.as_flattened_mut(), recorded, "mocap_pos")?;
        place(state.mocap_quat.as_flattened_mut(), recorded, "mocap_quat")?;
        forward(&model, &mut data).map_err(|error| error.to_string())?;
        let camera =
            Camera::named(&model, scene.camera.as_deref().unwrap_or("free")).map_err(|e| e.to_string())?;
        let mut assets = Assets::new(&model, recorded.profile()?).map_err(|error| error.to_string())?;
        assets.pose(&model, &data, &SceneOptions::default()).map_err(|error| error.to_string())?;
        let renderer = Renderer::new(Settings::of(&model).with_samples(Samples::Four));
        let effects = scene.effects.iter().fold(Effects::default(), |effects, effect| match effect {
            Effect::Wireframe => effects.with_wireframe(true),
            Effect::Additive => effects.with_additive(true),
            Effect::NoCulling => effects.with_culling(false),
        });
        Ok(Drawn { model, data, camera, assets, renderer, effects })
    }

    /// The triangles and textures of the model.
    pub fn assets(&self) -> &Assets {
        &self.assets
    }

    /// How finely it is drawn.
    pub fn settings(&self) -> &Settings {
        self.renderer.settings()
    }

    /// What is to be drawn.
    ///
    /// # Errors
    /// The scene cannot be assembled.
    pub fn scene(&self, shadows: bool) -> Result<Scene, String> {
        let view = self.camera.view(&self.model, &self.data).map_err(|error| error.to_string())?;
        let options = SceneOptions::default().with_effects(self.effects.with_shadows(shadows));
        let mut scene = Scene::new();
        scene.update(&self.model, &self.data, view, &options).map_err(|error| error.to_string())?;
        Ok(scene)
    }

    fn draw(&mut self, side: usize, shadows: bool, channels: Channels) -> Result<Picture, String> {
        let (scene, mut picture) = (self.scene(shadows)?, Picture::new(side, side));
        self.renderer
            .draw(&self.assets, &scene, channels, &mut picture)
            .map_err(|error| error.to_string())?;
        Ok(picture)
    }
}

impl Views for Drawn {
    fn colours(&mut self, side: usize, shadows: bool) -> Result<Vec<u8>, String> {
        Ok(self.draw(side, shadows, Channels::RGB)?.rgb)
    }

    fn geometry(&mut self, side: usize) -> Result<Geometry, String> {
        let channels = Channels { rgb: false, ..Channels::ALL };
        let Picture { depth, segmentation, .. } = self.draw(side, true, channels)?;
        Ok(Geometry { width: side, depth, ids: segmentation })
    }

    fn differences(&mut self, recorded: &Recording) -> Result<Option<Differences>, String> {
        // MuJoCo 3.1.3 computes other frames of inertia for meshes, and so other numbers for the same places.
        if recorded.profile()? != Profile::Mujoco312 {
            return Ok(None);
        }
        compare(recorded, &self.scene(true)?).map(Some)
    }
}

/// Copies a recorded array of the state.
fn place(target: &mut [f64], recorded: &Recording, name: &str) -> Result<(), String> {
    let values = recorded.numbers(name)?;
    if values.len() != target.len() {
        return Err(format!("{name} has {} numbers, the recorded one {}", target.len(), values.len()));
    }
    target.copy_from_slice(&values);
    Ok(())
}

/// Raises the height field of a geom as it was recorded.
fn raise(model: &mut Model, geom: &str, recorded: &Recording) -> Result<(), String> {
    let geom = model.id_of(ObjType::Geom, geom).ok_or_else(|| format!("there is no geom {geom}"))?;
    let (pos, rgba) = (recorded.rows::<3>("model/geom_pos")?, recorded.rows::<4>("model/geom_rgba")?);
    let heights: Vec<f32> = recorded.numbers("model/hfield_data")?.into_iter().map(|x| x as f32).collect();
    let sizes = [pos.len(), rgba.len(), heights.len()];
    if sizes != [model.ngeom, model.ngeom, model.nhfielddata] {
        return Err(format!("geoms and heights recorded: {sizes:?}"));
    }
    let write = |draft: &mut physics::model::Draft<'_>| {
        draft.geom_pos[geom] = pos[geom];
        draft.geom_rgba[geom] = rgba[geom].map(|x| x as f32);
        draft.hfield_data.copy_from_slice(&heights);
    };
    model.overwrite(write).map_err(|error| error.to_string())
}
