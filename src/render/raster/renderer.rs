//! From a scene to a picture.

use super::colour::paint::{Brush, Canvas, Veil, eight_bits};
use super::colour::seen::Illumination;
use super::colour::sky::Surroundings;
use super::colour::transparency::Transparency;
use super::draws::{Draws, mark_shared};
use super::image::{Image, write_depth, write_rgb, write_segmentation};
use super::labels;
use super::layer::Layer;
use super::lines::Line;
use super::mirror::Mirror;
use super::opaque::{Frame, Opaque};
use super::settings::{Samples, Settings};
use super::stage::Stage;
use super::still::{Place, Plan, Present, Views};
use super::umbra::{Cast, Umbra};
use super::visibility::Visibility;
use super::window::coverage::{Extent, Pattern};
use super::window::lens::{Lens, Sides};
use super::window::projection::Projection;
use crate::error::{MAX_SIDE, RenderError};
use crate::geometry::Assets;
use crate::picture::{Channels, Picture};
use crate::scene::{Light, Scene};

/// One picture to draw.
pub struct Shot<'a> {
    /// Triangles and textures of the scene's model.
    pub assets: &'a Assets,
    /// What is drawn.
    pub scene: &'a Scene,
    /// Which arrays are wanted.
    pub channels: Channels,
    /// Where they go, at its size.
    pub picture: &'a mut Picture,
}

/// Draws scenes on the CPU. It keeps the memory of pictures, so that the next ones of the same sizes and scenes allocate
/// nothing.
#[derive(Clone, Debug)]
pub struct Renderer {
    settings: Settings,
    /// Surfaces of every picture of a group.
    draws: Vec<Draws>,
    opaques: Vec<Opaque>,
    sheets: Vec<Sheet>,
    mirror: Mirror,
    transparency: Transparency,
    umbra: Umbra,
    /// The lights, none with shadows.
    light: Illumination,
    views: Views,
}

/// The samples of a picture.
#[derive(Clone, Debug)]
struct Sheet {
    layer: Layer,
    visibility: Visibility,
    canvas: Canvas,
    /// What its colours are drawn with, where they are wanted.
    colour: Option<Colour>,
}

#[derive(Clone, Copy, Debug)]
struct Colour {
    lens: Lens,
    place: Place,
    plan: Plan,
    /// The item that mirrors.
    reflective: Option<usize>,
}

/// Most pictures that are drawn together; the views that are kept are more.
const TOGETHER: usize = 8;

impl Renderer {
    /// A renderer with the settings of a model, see [`Settings::of`].
    pub fn new(settings: Settings) -> Self {
        Renderer {
            settings,
            draws: Vec::new(),
            opaques: Vec::new(),
            sheets: Vec::new(),
            mirror: Mirror::default(),
            transparency: Transparency::default(),
            umbra: Umbra::default(),
            light: Illumination::default(),
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
        self.draw_all(&mut [Shot { assets, scene, channels, picture }])
    }

    /// Draws several pictures, each with the bits that it has alone. Pictures of one state from several cameras that follow
    /// each other share the work on shadows.
    ///
    /// # Errors
    /// The error of [`Renderer::draw`] for the first shot that fails; all other shots are drawn.
    pub fn draw_all(&mut self, shots: &mut [Shot<'_>]) -> Result<(), RenderError> {
        self.settings = self.settings.within_limits();
        let mut outcome = Ok(());
        let mut rest = shots;
        while !rest.is_empty() {
            let (group, others) = rest.split_at_mut(together(rest));
            outcome = outcome.and(self.draw_group(group));
            rest = others;
        }
        outcome
    }

    fn draw_group(&mut self, shots: &mut [Shot<'_>]) -> Result<(), RenderError> {
        let count = shots.len();
        while self.sheets.len() < count {
            self.sheets.push(Sheet::new());
            self.draws.push(Draws::default());
            self.opaques.push(Opaque::default());
        }
        let mut outcome = Ok(());
        for (view, shot) in shots.iter_mut().enumerate() {
            let seen = self.look(view, shot);
            if seen.is_err() {
                self.sheets[view].colour = None;
                self.opaques[view].clear();
            }
            outcome = outcome.and(seen);
        }
        mark_shared(&mut self.draws[..count]);
        self.shade(shots);
        for (view, shot) in shots.iter_mut().enumerate() {
            self.paint(view, shot);
        }
        outcome
    }

    /// Finds what a shot shows: its depth and segmentation, and what its colours are of.
    fn look(&mut self, view: usize, shot: &mut Shot<'_>) -> Result<(), RenderError> {
        let Shot { assets, scene, channels, ref mut picture } = *shot;
        let (draws, sheet) = (&mut self.draws[view], &mut self.sheets[view]);
        draws.clear();
        let lens = lens(scene, picture, &self.settings)?;
        draws.update(assets, scene)?;
        picture.rgb.clear();
        picture.depth.clear();
        picture.segmentation.clear();
        if channels.depth || channels.segmentation {
            // Wireframes have the depth and the objects of filled surfaces, as MuJoCo's renderer has them.
            let lens = Lens { wire: None, ..lens };
            let Sheet { layer, visibility, .. } = sheet;
            layer.update(assets, draws, &lens, |draw| !scene.items[draw.item].unlisted);
            let stage = Stage { assets, scene, draws, layer, lens: &lens };
            visibility.clear(Pattern::CENTER, picture.width, picture.height);
            stage.look(visibility, |draw| !scene.items[draw.item].unlisted);
            look_at_lines(&stage, &self.settings, visibility, |line| !scene.items[line.item].unlisted);
            let image = Image { visibility, extent: lens.extent };
            if channels.depth {
                write_depth(&image, &scene.view.frustum, &mut picture.depth);
            }
            if channels.segmentation {
                write_segmentation(&image, draws, &scene.items, &mut picture.segmentation);
            }
        }
        match channels.rgb {
            true => self.look_at_colours(view, (assets, scene), lens),
            false => {
                self.sheets[view].colour = None;
                self.opaques[view].clear();
            }
        }
        Ok(())
    }

    /// Finds what is seen at all samples of a picture, lights it, and paints what is mirrored.
    fn look_at_colours(&mut self, view: usize, (assets, scene): (&Assets, &Scene), lens: Lens) {
        let Renderer { settings, draws, opaques, sheets, mirror, umbra, views, .. } = self;
        let (draws, opaque) = (&draws[view], &mut opaques[view]);
        let Sheet { layer, visibility, canvas, colour } = &mut sheets[view];
        let (place, plan) =
            views.find(&Present { assets, scene, draws, extent: lens.extent, settings: *settings });
        let kept = views.kept_mut(place);
        let frame = Frame { settings, brush: &brush(assets, scene), plan };
        let pattern = match settings.samples {
            Samples::One => Pattern::CENTER,
            Samples::Four => Pattern::FOUR,
        };
        if plan != Plan::Use {
            visibility.clear(pattern, lens.extent.width as usize, lens.extent.height as usize);
        }
        if plan == Plan::Make {
            layer.update(assets, draws, &lens, |draw| kept.stills.has(draw) && !draw.transparent);
            let stage = Stage { assets, scene, draws, layer, lens: &lens };
            stage.look(visibility, |draw| kept.stills.has(draw) && !draw.transparent);
            opaque.collect_still(&stage, &frame, visibility);
            let (settings, wire) = (&settings.shadow, lens.wire);
            let cast = Cast { stage: &stage, settings, wire, draws: std::slice::from_ref(draws) };
            umbra.fall_from(&cast, |draw| kept.stills.has(draw), opaque);
            opaque.keep(&stage, &frame, visibility, kept);
        }
        // What has been made of the backdrop shows it already.
        if plan == Plan::Use {
            visibility.copy(&kept.main.visibility);
        }
        layer.update(assets, draws, &lens, |draw| draw.transparent || !kept.stills.has(draw));
        let stage = Stage { assets, scene, draws, layer, lens: &lens };
        stage.look(visibility, |draw| !draw.transparent && !kept.stills.has(draw));
        look_at_lines(&stage, settings, visibility, |line| !line.transparent);
        canvas.clear(visibility.groups.len());
        let reflective = draws.reflective(scene);
        if let Some(item) = reflective {
            let mirrors = mirror.draw(&stage, (item, visibility), &frame, kept, canvas);
            if mirrors && scene.wireframe {
                mirror.mark(visibility);
            }
        }
        opaque.collect(&stage, &frame, visibility, kept);
        *colour = Some(Colour { lens, place, plan, reflective });
    }

    /// Finds which fragments of a group lie in shadow.
    fn shade(&mut self, shots: &[Shot<'_>]) {
        let Renderer { settings, draws, opaques, sheets, umbra, views, .. } = self;
        let count = shots.len();
        let Some((view, colour)) =
            sheets[..count].iter().enumerate().find_map(|(view, sheet)| Some((view, sheet.colour?)))
        else {
            return;
        };
        let Shot { assets, scene, .. } = shots[view];
        let stage =
            Stage { assets, scene, draws: &draws[view], layer: &sheets[view].layer, lens: &colour.lens };
        let (settings, wire) = (&settings.shadow, colour.lens.wire);
        let cast = Cast { stage: &stage, settings, wire, draws: &draws[..count] };
        umbra.fall(&cast, &mut opaques[..count], |view| {
            let Colour { place, plan, .. } = sheets[view].colour?;
            (plan != Plan::Without).then(|| views.kept(place))
        });
    }

    /// Paints all samples of a picture.
    fn paint(&mut self, view: usize, shot: &mut Shot<'_>) {
        let Renderer { settings, draws, opaques, sheets, transparency, light, views, .. } = self;
        let Sheet { layer, visibility, canvas, colour } = &mut sheets[view];
        let Some(Colour { lens, place, plan, reflective }) = colour else { return };
        let Shot { assets, scene, ref mut picture, .. } = *shot;
        let (draws, brush) = (&draws[view], brush(assets, scene));
        let stage = Stage { assets, scene, draws, layer, lens };
        let kept = views.kept_mut(*place);
        opaques[view].paint(&stage, &brush, kept, (*reflective, canvas));
        if !draws.lines.is_empty() {
            paint_lines(scene, draws, visibility, canvas);
        }
        if let Some((sky, texture)) = scene.sky.and_then(|sky| Some((sky, assets.textures.get(sky)?))) {
            let around = Surroundings {
                visibility,
                projection: &lens.projection,
                extent: lens.extent,
                scene,
                slices: settings.slices,
            };
            kept.sky.hold(sky, if *plan == Plan::Without { None } else { Some(lens.extent) });
            around.sky(texture, &mut kept.sky, canvas);
            if let Some(haze) = &scene.haze {
                around.haze(haze, canvas);
            }
        }
        light.set(scene, scene.view.eye.map(|x| x as f32), false);
        transparency.draw(&stage, (visibility, settings.line_width), light, &brush, canvas);
        write_rgb(&Image { visibility, extent: lens.extent }, canvas, &mut picture.rgb);
        labels::draw(scene, picture);
    }
}

impl Sheet {
    fn new() -> Self {
        Sheet {
            layer: Layer::default(),
            visibility: Visibility::new(Pattern::CENTER),
            canvas: Canvas::default(),
            colour: None,
        }
    }
}

/// How many shots from the first on are drawn together. They have the same lamps, with maps of the same depths, and different
/// views, since what is kept of a view is kept once.
fn together(shots: &[Shot<'_>]) -> usize {
    let depths = |shot: &Shot<'_>| (shot.scene.view.frustum.near, shot.scene.view.frustum.far);
    let fits = |shot: &Shot<'_>, before: &[Shot<'_>]| {
        let first = &before[0];
        std::ptr::eq(shot.assets, first.assets)
            && depths(shot) == depths(first)
            && (shot.scene.shadows, shot.scene.wireframe) == (first.scene.shadows, first.scene.wireframe)
            && lamps(shot.scene).eq(lamps(first.scene))
            && before.iter().all(|other| shot.scene.view != other.scene.view)
    };
    let most = shots.len().min(TOGETHER);
    (1..most).find(|&count| !fits(&shots[count], &shots[..count])).unwrap_or(most)
}

/// The lamps that cast shadows.
fn lamps(scene: &Scene) -> impl Iterator<Item = &Light> {
    scene.lights.iter().filter(|light| light.shadow)
}

/// What a picture is seen through.
fn lens(scene: &Scene, picture: &Picture, settings: &Settings) -> Result<Lens, RenderError> {
    let (width, height) = (picture.width, picture.height);
    if !(1..=MAX_SIDE).contains(&width) || !(1..=MAX_SIDE).contains(&height) {
        return Err(RenderError::Size { width, height });
    }
    let extent = Extent { width: width as i32, height: height as i32 };
    Ok(Lens {
        projection: Projection::of(&scene.view, width, height)?,
        extent,
        region: extent.region(),
        deepest: 1.0,
        mirror: None,
        sides: Sides::Seen,
        wire: scene.wireframe.then_some(settings.line_width),
    })
}

fn brush<'a>(assets: &'a Assets, scene: &Scene) -> Brush<'a> {
    Brush { assets, veil: scene.fog.map(|fog| Veil::new(fog, scene.view.eye, scene.view.forward)) }
}

/// Adds the lines that `wanted` picks.
fn look_at_lines(
    stage: &Stage<'_>,
    settings: &Settings,
    visibility: &mut Visibility,
    wanted: impl Fn(&Line) -> bool,
) {
    let pattern = visibility.pattern;
    for (number, line) in (stage.draws.triangles..).zip(&stage.draws.lines) {
        if wanted(line) {
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
            let line = number.checked_sub(draws.triangles).and_then(|place| draws.lines.get(place as usize));
            if let Some(line) = line {
                *sample = scene.items[line.item].rgba.map(eight_bits);
            }
        }
    }
}
