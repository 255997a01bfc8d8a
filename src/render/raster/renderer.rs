//! From a scene to a picture.

use super::coverage::{Extent, Pattern};
use super::draws::Draws;
use super::image::{Image, write_depth, write_rgb, write_segmentation};
use super::layer::{Layer, Lens};
use super::mirror::Mirror;
use super::paint::{Brush, Canvas, Veil, eight_bits};
use super::seen::{Illumination, Seen};
use super::settings::{Samples, Settings};
use super::shadow::Shadows;
use super::sky::Surroundings;
use super::stage::Stage;
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
    seen: Seen,
    light: Illumination,
    shadows: Shadows,
    mirror: Mirror,
    transparency: Transparency,
    canvas: Canvas,
}

impl Renderer {
    /// A renderer with the settings of a model, see [`Settings::of`].
    pub fn new(settings: Settings) -> Self {
        Renderer {
            settings,
            draws: Draws::default(),
            layer: Layer::default(),
            visibility: Visibility::new(Pattern::CENTER),
            seen: Seen::default(),
            light: Illumination::default(),
            shadows: Shadows::default(),
            mirror: Mirror::default(),
            transparency: Transparency::default(),
            canvas: Canvas::default(),
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
    /// The picture has no pixels or too many, or the view's frustum is empty or not finite.
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
        let lens = Lens { projection, extent, mirror: None, two_sided: false };
        self.draws.update(assets, scene);
        self.layer.update(assets, &self.draws, &lens, |_| true);
        picture.rgb.clear();
        picture.depth.clear();
        picture.segmentation.clear();
        if channels.depth || channels.segmentation {
            self.look(assets, &lens, Pattern::CENTER, |_, unlisted| !unlisted, scene);
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
        }
        Ok(())
    }

    /// Finds what is seen at the samples of a pattern, among the draws that `wanted(transparent, unlisted)` picks.
    fn look(
        &mut self,
        assets: &Assets,
        lens: &Lens,
        pattern: Pattern,
        wanted: impl Fn(bool, bool) -> bool,
        scene: &Scene,
    ) {
        let (width, height) = (lens.extent.width as usize, lens.extent.height as usize);
        self.visibility.clear(pattern, width, height);
        let Renderer { settings, visibility, layer, draws, .. } = self;
        for (index, draw) in draws.list.iter().enumerate() {
            if wanted(draw.transparent, scene.items[draw.item].unlisted) {
                layer.triangles(assets, (index, draw), lens, &pattern, |number, triangle| {
                    visibility.draw(number, triangle);
                });
            }
        }
        for (number, line) in (draws.triangles..).zip(&draws.lines) {
            if wanted(false, scene.items[line.item].unlisted) {
                line.triangles(lens, &pattern, settings.line_width, |triangle| {
                    visibility.draw(number, triangle)
                });
            }
        }
    }

    /// Paints all samples of a picture.
    fn colour(&mut self, assets: &Assets, scene: &Scene, lens: &Lens) {
        let pattern = match self.settings.samples {
            Samples::One => Pattern::CENTER,
            Samples::Four => Pattern::FOUR,
        };
        self.look(assets, lens, pattern, |transparent, _| !transparent, scene);
        let Renderer {
            settings,
            draws,
            layer,
            visibility,
            seen,
            light,
            shadows,
            mirror,
            transparency,
            canvas,
        } = self;
        let stage = Stage { assets, scene, draws, layer, lens };
        let view = &scene.view;
        let brush = Brush { assets, veil: scene.fog.map(|fog| Veil::new(fog, view.eye, view.forward)) };
        canvas.clear(visibility.groups.len());
        let reflective = draws.reflective(scene);
        if let Some(item) = reflective {
            mirror.draw(&stage, item, visibility, &brush, canvas);
        }
        seen.collect(visibility, lens.extent.width as usize, draws.triangles);
        let eye = view.eye.map(|x| x as f32);
        light.set(scene, eye, scene.shadows && settings.shadow.size > 0);
        seen.light(&stage, light);
        let casting = scene.lights.iter().filter(|light| light.shadow).take(light.shadowed.len());
        for (bit, light) in casting.enumerate() {
            shadows.cast(&stage, (light, bit), &settings.shadow, seen);
        }
        for fragment in &seen.fragments {
            let draw = &draws.list[seen.triangles[fragment.triangle as usize].draw as usize];
            let colour = brush.colour(seen, &draw.paint, 1.0, fragment);
            if reflective == Some(draw.item) {
                canvas.touch(fragment, |below| std::array::from_fn(|k| colour[k].saturating_add(below[k])));
            } else {
                canvas.touch(fragment, |_| colour);
            }
        }
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
        light.set(scene, eye, false);
        transparency.draw(&stage, visibility, light, &brush, canvas);
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
