//! What there is to draw from one camera: items, lights, surroundings.

mod camera;
mod catenary;
mod crank;
mod decor;
mod elements;
mod island;
mod item;
mod light;
mod mark;
mod options;
mod sink;
mod tendon;

pub use camera::{Camera, FreeCamera};
pub use item::{Category, Item, Look, Object, Shape};
pub use light::{Light, LightKind};
pub use options::{
    Categories, Effects, FrameChoice, GROUPS, Groups, LabelChoice, Pull, SceneOptions, Selection, Show,
};

use crate::RenderError;
use crate::view::View;
use physics::math::{Vec3, column, dot, sub};
use physics::model::{Appearance, TextureType};
use physics::pipeline::appearance::appearance;
use physics::{Data, Model};
use sink::{Items, Source};

/// Everything that one picture shows, in the order in which MuJoCo draws it.
///
/// ```
/// # use physics as robohive_physics;
/// use robohive_physics::{Data, forward};
/// use robohive_render::scene::{Camera, Scene, SceneOptions};
///
/// let model = robohive_mjcf::load_str(
///     "<mujoco><worldbody><geom type='plane' size='1 1 .1'/><body pos='0 0 1'><geom size='.1'/></body></worldbody></mujoco>",
/// )?
/// .model;
/// let mut data = Data::new(&model);
/// forward(&model, &mut data)?;
/// let view = Camera::named(&model, "free")?.view(&model, &data)?;
/// let mut scene = Scene::new();
/// scene.update(&model, &data, view, &SceneOptions::default())?;
/// assert_eq!(scene.items.len(), 2);
/// assert!(scene.lights[0].headlight);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// What is drawn. The index of an item is its segmentation id.
    pub items: Vec<Item>,
    /// What lights it, the headlight first if it is on; lights that are off or of a kind that does not light are left out.
    pub lights: Vec<Light>,
    /// Ambient light in units of the colours of the items: not zero only where nothing in the scene could light.
    pub ambient: f32,
    /// Where it is seen from.
    pub view: View,
    /// Distance at which fog begins and at which it is complete \[m\], and its colour; none by default.
    pub fog: Option<Fog>,
    /// The texture of the sky, an index into the model's textures; the background is black without one.
    pub sky: Option<usize>,
    /// Haze over the horizon; only with a sky.
    pub haze: Option<Haze>,
    /// Shadows are drawn.
    pub shadows: bool,
    /// Mirrors are drawn.
    pub reflections: bool,
    /// Surfaces are drawn as the outlines of their polygons.
    pub wireframe: bool,
    /// What is transparent is added to what is behind it, and does not weaken it.
    pub additive: bool,
    /// The backs of closed surfaces are left out.
    pub culling: bool,
    /// What plugins show; `items` have it.
    pub appearance: Appearance,
}

impl Default for Scene {
    fn default() -> Self {
        Scene {
            items: Vec::new(),
            lights: Vec::new(),
            ambient: 0.0,
            view: View::default(),
            fog: None,
            sky: None,
            haze: None,
            shadows: true,
            reflections: true,
            wireframe: false,
            additive: false,
            culling: true,
            appearance: Appearance::default(),
        }
    }
}

impl Scene {
    /// An empty scene, to be updated.
    pub fn new() -> Self {
        Scene::default()
    }

    /// Replaces the scene by the scene of another state, which a forward pass must have evaluated,
    /// seen from `view`. From the second call on, nothing is allocated where no more items are shown than before, and no
    /// labels.
    ///
    /// Infinite planes are centred below the eye of `view`. MuJoCo takes the eye of the previous update, so that its
    /// second update of the same state shows the same as this one.
    ///
    /// # Errors
    /// An item is not finite, or has no shape that can be drawn; the scene is incomplete then.
    pub fn update(
        &mut self,
        model: &Model,
        data: &Data,
        view: View,
        options: &SceneOptions,
    ) -> Result<(), RenderError> {
        appearance(model, data, &mut self.appearance);
        let from = Source { m: model, d: data, options, appearance: &self.appearance };
        let mut items = Items::within(&mut self.items);
        mark::of_plugins(from, &mut items)?;
        elements::flexes(from, &mut items);
        elements::skins(from, &mut items);
        elements::geoms(from, view.eye, &mut items)?;
        elements::sites(from, &mut items)?;
        tendon::tendons(from, &mut items);
        crank::slider_cranks(from, &mut items);
        decor::decorations(from, &mut items);
        items.finish(model)?;
        self.view = view;
        self.ambient = light::gather(model, data, &view, &mut self.lights)?;
        self.surround(model, options.effects);
        Ok(())
    }

    /// Sets what surrounds the items.
    fn surround(&mut self, model: &Model, effects: Effects) {
        let (map, extent) = (&model.vis.map, model.stat.extent);
        let sky = (0..model.ntex).find(|&i| model.tex_type[i] == TextureType::Skybox.code());
        self.shadows = effects.shadows;
        self.reflections = effects.reflections;
        (self.wireframe, self.additive, self.culling) =
            (effects.wireframe, effects.additive, effects.culling);
        self.sky = sky.filter(|_| effects.sky);
        self.haze = self.sky.filter(|_| effects.haze).and_then(|_| self.horizon(model));
        self.fog = effects.fog.then(|| Fog {
            start: (f64::from(map.fogstart) * extent) as f32,
            end: (f64::from(map.fogend) * extent) as f32,
            rgb: rgb(model.vis.rgba.fog),
        });
    }

    /// Haze over the first plane that is infinite both ways, if that is seen from above.
    fn horizon(&self, model: &Model) -> Option<Haze> {
        let infinite = |item: &&Item| {
            matches!(item.shape, Shape::Plane { .. }) && item.size[0] == 0.0 && item.size[1] == 0.0
        };
        let plane = self.items.iter().find(infinite)?;
        let (pos, mat) = (plane.pos.map(f64::from), plane.mat.map(f64::from));
        let above: Vec3 = sub(self.view.eye, pos);
        (dot(above, column(&mat, 2)) >= 0.0).then_some(Haze {
            share: model.vis.map.haze,
            rgb: rgb(model.vis.rgba.haze),
            pos: plane.pos,
            mat: plane.mat,
        })
    }
}

fn rgb([r, g, b, _]: [f32; 4]) -> [f32; 3] {
    [r, g, b]
}

/// Fog between two distances from the eye's plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fog {
    /// Where it begins \[m\].
    pub start: f32,
    /// Where it is complete \[m\].
    pub end: f32,
    /// Its colour.
    pub rgb: [f32; 3],
}

impl Fog {
    /// Share of its own colour that is left of what lies this far from the eye's plane \[m\].
    pub fn clearness(&self, depth: f32) -> f32 {
        ((self.end - depth) / (self.end - self.start)).clamp(0.0, 1.0)
    }

    /// A colour seen through a share of clear air.
    pub fn over(&self, clear: f32, rgb: [f32; 3]) -> [f32; 3] {
        std::array::from_fn(|k| clear * rgb[k] + (1.0 - clear) * self.rgb[k])
    }
}

/// Haze where an infinite plane meets the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Haze {
    /// Share of the horizon's radius that it covers (`visual/map haze`).
    pub share: f32,
    /// Its colour.
    pub rgb: [f32; 3],
    /// Position of the plane, world frame \[m\].
    pub pos: [f32; 3],
    /// Orientation of the plane, row-major.
    pub mat: [f32; 9],
}
