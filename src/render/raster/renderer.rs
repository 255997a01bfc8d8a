//! From a scene to a picture.

use super::coverage::{Extent, Pattern};
use super::draws::{Draw, Draws};
use super::image::{Image, write_depth, write_rgb, write_segmentation};
use super::labels;
use super::layer::{Layer, Lens, Sides};
use super::mirror::Mirror;
use super::opaque::{Frame, Opaque};
use super::paint::{Brush, Canvas, Veil, eight_bits};
use super::seen::Illumination;
use super::settings::{Samples, Settings};
use super::sky::Surroundings;
use super::stage::Stage;
use super::still::{Kept, Plan, Present, Views};
use super::transparency::Transparency;
use super::visibility::Visibility;
use super::window::Projection;
use crate::error::{MAX_SIDE, RenderError};
use crate::geometry::Assets;
use crate::picture::{Channels, Picture};
use crate::scene::Scene;

/// Draws scenes on the CPU. It keeps the memory of a picture, so that the next one of the same size and scene allocates
/// nothing.
#[derive(Clone, Debug)]
pub struct Renderer {
    settings: Settings,
    draws: Draws,
    layer: Layer,
    visibility: Visibility,
    opaque: Opaque,
    mirror: Mirror,
    transparency: Transparency,
    /// The lights, none with shadows.
    light: Illumination,
    canvas: Canvas,
    views: Views,
}

impl Renderer {
    /// A renderer with the settings of a model, see [`Settings::of`].
    pub fn new(settings: Settings) -> Self {
        Renderer {
            settings,
            draws: Draws::default(),
            layer: Layer::default(),
            visibility: Visibility::new(Pattern::CENTER),
            opaque: Opaque::default(),
            mirror: Mirror::default(),
            transparency: Transparency::default(),
            light: Illumination::default(),
            canvas: Canvas::default(),
            views: Views::default(),
        }
    }

    /// How finely it draws.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// How finely it draws, to change.
    pub fn settings_mut(&mut self) -> &mut Settings {
        &mut self.settings
    }

    /// Draws a scene of the model that `assets` were made of into the wanted channels of a picture, at its size.
    ///
    /// # Errors
    /// The picture has no pixels or too many, the view's frustum is empty or not finite, or the scene has too many triangles.
    pub fn draw(
        &mut self,
        assets: &Assets,
        scene: &Scene,
        channels: Channels,
        picture: &mut Picture,
    ) -> Result<(), RenderError> {
        let (width, height) = (picture.width, picture.height);
        if !(1..=MAX_SIDE).contains(&width) || !(1..=MAX_SIDE).contains(&height) {
            return Err(RenderError::Size { width, height });
        }
        let projection = Projection::of(&scene.view, width, height)?;
        let extent = Extent { width: width as i32, height: height as i32 };
        self.settings = self.settings.within_limits();
        let lens = Lens {
            projection,
            extent,
            region: extent.region(),
            deepest: 1.0,
            mirror: None,
            sides: Sides::Seen,
        };
        self.draws.update(assets, scene)?;
        picture.rgb.clear();
        picture.depth.clear();
        picture.segmentation.clear();
        if channels.depth || channels.segmentation {
            self.layer.update(assets, &self.draws, &lens, |draw| !scene.items[draw.item].unlisted);
            let stage = Stage { assets, scene, draws: &self.draws, layer: &self.layer, lens: &lens };
            self.visibility.clear(Pattern::CENTER, width, height);
            look(&stage, &mut self.visibility, |draw| !scene.items[draw.item].unlisted);
            look_at_lines(&stage, &self.settings, &mut self.visibility);
            let image = Image { visibility: &self.visibility, extent };
            if channels.depth {
                write_depth(&image, &scene.view.frustum, &mut picture.depth);
            }
            if channels.segmentation {
                write_segmentation(&image, &self.draws, &scene.items, &mut picture.segmentation);
            }
        }
        if channels.rgb {
            self.colour(assets, scene, &lens);
            write_rgb(&Image { visibility: &self.visibility, extent }, &self.canvas, &mut picture.rgb);
            labels::draw(scene, picture);
        }
        Ok(())
    }

    /// Paints all samples of a picture.
    fn colour(&mut self, assets: &Assets, scene: &Scene, lens: &Lens) {
        let Renderer {
            settings,
            draws,
            layer,
            visibility,
            opaque,
            mirror,
            transparency,
            light,
            canvas,
            views,
        } = self;
        let nothing = &mut Kept::nothing(scene);
        let (kept, plan) = match settings.keep {
            true => views.find(&Present { assets, scene, draws, extent: lens.extent, settings: *settings }),
            false => (nothing, Plan::Without),
        };
        let view = &scene.view;
        let brush = Brush { assets, veil: scene.fog.map(|fog| Veil::new(fog, view.eye, view.forward)) };
        let frame = Frame { settings, brush: &brush, plan };
        let pattern = match settings.samples {
            Samples::One => Pattern::CENTER,
            Samples::Four => Pattern::FOUR,
        };
        visibility.clear(pattern, lens.extent.width as usize, lens.extent.height as usize);
        if plan == Plan::Make {
            layer.update(assets, draws, lens, |draw| kept.stills.has(draw) && !draw.transparent);
            let stage = Stage { assets, scene, draws, layer, lens };
            look(&stage, visibility, |draw| kept.stills.has(draw) && !draw.transparent);
            opaque.keep(&stage, &frame, visibility, kept);
        }
        if plan != Plan::Without {
            visibility.copy(&kept.main.visibility);
        }
        layer.update(assets, draws, lens, |draw| draw.transparent || !kept.stills.has(draw));
        let stage = Stage { assets, scene, draws, layer, lens };
        look(&stage, visibility, |draw| !draw.transparent && !kept.stills.has(draw));
        look_at_lines(&stage, settings, visibility);
        canvas.clear(visibility.groups.len());
        let reflective = draws.reflective(scene);
        if let Some(item) = reflective {
            mirror.draw(&stage, (item, visibility), &frame, kept, canvas);
        }
        opaque.draw(&stage, &frame, visibility, kept, (reflective, canvas));
        if !draws.lines.is_empty() {
            paint_lines(scene, draws, visibility, canvas);
        }
        if let Some(texture) = scene.sky.and_then(|sky| assets.textures.get(sky)) {
            let around = Surroundings {
                visibility,
                projection: &lens.projection,
                extent: lens.extent,
                scene,
                slices: settings.slices,
            };
            around.sky(texture, canvas);
            if let Some(haze) = &scene.haze {
                around.haze(haze, canvas);
            }
        }
        light.set(scene, scene.view.eye.map(|x| x as f32), false);
        transparency.draw(&stage, visibility, light, &brush, canvas);
    }
}

/// Finds what is seen at the samples of a window, among the draws that `wanted` picks.
pub fn look(stage: &Stage<'_>, visibility: &mut Visibility, wanted: impl Fn(&Draw) -> bool) {
    let pattern = visibility.pattern;
    for (index, draw) in stage.draws.list.iter().enumerate().filter(|(_, draw)| wanted(draw)) {
        stage.layer.triangles(stage.assets, (index, draw), stage.lens, &pattern, |number, triangle| {
            visibility.draw(number, triangle);
        });
    }
}

/// Adds the lines.
fn look_at_lines(stage: &Stage<'_>, settings: &Settings, visibility: &mut Visibility) {
    let pattern = visibility.pattern;
    for (number, line) in (stage.draws.triangles..).zip(&stage.draws.lines) {
        if pattern == Pattern::FOUR || !stage.scene.items[line.item].unlisted {
            line.triangles(stage.lens, &pattern, settings.line_width, |triangle| {
                visibility.draw(number, triangle);
            });
        }
    }
}

/// Paints the samples at which lines are seen, in their own colour.
fn paint_lines(scene: &Scene, draws: &Draws, visibility: &Visibility, canvas: &mut Canvas) {
    for (group, samples) in visibility.groups.iter().zip(&mut canvas.groups) {
        for (number, sample) in group.triangle.to_array().into_iter().zip(samples) {
            if number >= draws.triangles {
                let line = draws.lines[(number - draws.triangles) as usize];
                *sample = scene.items[line.item].rgba.map(eight_bits);
            }
        }
    }
}
