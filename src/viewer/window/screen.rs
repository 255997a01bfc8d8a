//! The picture of a session, drawn as finely as time allows.

use super::channel::Channel;
use super::painters::{Painted, Painters, Sheet};
use crate::drawing::Scenery;
use crate::session::Session;
use eframe::egui::Context;
use physics::Model;
use render::raster::Projection;
use render::scene::{Camera, LabelChoice, SceneOptions};
use render::{Picture, RenderError, Renderer, Scene};
use web_time::Instant;

/// What a picture may take while things move \[s\].
const BUDGET: f64 = 0.05;
/// Coarsest picture, in parts of the window's width.
const COARSEST: usize = 4;

/// What a session is drawn of, and its last picture.
pub struct Screen {
    /// What of the scene it shows.
    pub channel: Channel,
    scenery: Scenery,
    /// What another camera sees.
    aside: Scene,
    shown: Option<(Shown, Painted)>,
    /// Pixels of the window that the picture takes.
    size: [usize; 2],
    /// What a pixel takes \[s\].
    cost: f64,
}

/// What another camera sees, on a sheet of its own.
#[derive(Default)]
pub(super) struct Aside {
    /// Columns and rows of the picture \[pixel\].
    pub(super) size: [usize; 2],
    sheet: Sheet,
    shown: Option<(Shown, Painted)>,
}

/// What a picture depends on.
#[derive(Clone, PartialEq)]
struct Shown {
    revision: u64,
    camera: Camera,
    options: SceneOptions,
    size: [usize; 2],
    uses_gpu: bool,
    channel: Channel,
}

impl Screen {
    /// Prepares triangles and textures.
    ///
    /// # Errors
    /// A texture or mesh cannot be drawn.
    pub fn new(model: &Model) -> Result<Self, RenderError> {
        Ok(Screen {
            channel: Channel::default(),
            scenery: Scenery::new(model)?,
            aside: Scene::new(),
            shown: None,
            size: [1; 2],
            cost: 0.0,
        })
    }

    /// The picture of the present state for a window of `size` pixels: coarse while things move and drawing is slow, fine
    /// when they stand still. The flag says whether a finer one is still to come.
    ///
    /// # Errors
    /// The camera or an item has no place.
    pub fn draw(
        &mut self,
        context: &Context,
        painters: &mut Painters,
        session: &Session,
        size: [usize; 2],
    ) -> Result<(Painted, bool), RenderError> {
        self.size = size;
        let channel = self.channel;
        let uses_gpu = painters.uses_gpu() && channel == Channel::Colours;
        let wanted = |size| Shown {
            revision: session.revision(),
            camera: session.camera,
            options: session.shown(),
            size,
            uses_gpu,
            channel,
        };
        let is_shown = |shown: &Option<(Shown, Painted)>, size| {
            shown.as_ref().filter(|(shown, _)| *shown == wanted(size)).map(|(_, painted)| *painted)
        };
        if let Some(painted) = is_shown(&self.shown, size) {
            return Ok((painted, false));
        }
        // A GPU draws fine pictures at once; the time that it takes is not known here.
        let parts = if uses_gpu { 1 } else { self.parts(size) };
        let coarse = size.map(|side| side.div_ceil(parts));
        let stands_still = is_shown(&self.shown, coarse).is_some();
        let chosen = if stands_still { size } else { coarse };
        let began = Instant::now();
        self.scenery.update(session)?;
        let painted = painters.paint(context, &self.scenery, channel, chosen)?;
        self.cost = began.elapsed().as_secs_f64() / (chosen[0] * chosen[1]).max(1) as f64;
        // What draws may have changed.
        self.shown = Some((Shown { uses_gpu: uses_gpu && painters.uses_gpu(), ..wanted(chosen) }, painted));
        Ok((painted, chosen != size))
    }

    /// Draws what another camera sees of the state that [`Screen::draw`] has drawn last, unless that picture is there
    /// already. It has no labels: they would hide it.
    ///
    /// # Errors
    /// The camera or an item has no place.
    pub(super) fn draw_aside(
        &mut self,
        context: &Context,
        painters: &mut Painters,
        session: &Session,
        (camera, channel): (usize, Channel),
        to: &mut Aside,
    ) -> Result<Painted, RenderError> {
        let camera = Camera::Fixed(camera);
        let mut options = session.shown();
        options.label = LabelChoice::None;
        let size = to.size;
        let wanted =
            |uses_gpu| Shown { revision: session.revision(), camera, options, size, uses_gpu, channel };
        let uses_gpu = painters.uses_gpu() && channel == Channel::Colours;
        if let Some((_, painted)) = to.shown.as_ref().filter(|(shown, _)| *shown == wanted(uses_gpu)) {
            return Ok(*painted);
        }
        let view = camera.view(session.model(), session.data())?;
        std::mem::swap(&mut self.aside, &mut self.scenery.scene);
        let drawn = self.scenery.look(session, view, &options);
        let painted =
            drawn.and_then(|()| painters.paint_sheet(context, &self.scenery, channel, size, &mut to.sheet));
        std::mem::swap(&mut self.aside, &mut self.scenery.scene);
        let painted = painted?;
        let shown = wanted(painters.uses_gpu() && channel == Channel::Colours);
        to.shown = Some((shown, painted));
        Ok(painted)
    }

    /// By how many pixels of the window a pixel of the picture is wide.
    fn parts(&self, size: [usize; 2]) -> usize {
        let whole = self.cost * (size[0] * size[1]) as f64;
        ((whole / BUDGET).sqrt().ceil() as usize).clamp(1, COARSEST)
    }

    /// Forgets its last picture, whose texture is gone.
    pub fn forget(&mut self) {
        self.shown = None;
    }

    /// The labels of the last picture, and where each begins in a window of `size` pixels: from its lower left corner
    /// \[pixel\].
    pub fn labels(&self, size: [usize; 2]) -> impl Iterator<Item = (&str, [f64; 2])> {
        let scene = &self.scenery.scene;
        let projection = Projection::of(&scene.view, size[0], size[1]).ok();
        let labelled = scene.items.iter().filter(|item| !item.label.is_empty());
        labelled.filter_map(move |item| {
            let p = item.pos.map(f64::from);
            let rows = projection.as_ref()?.0;
            let [x, y, z, w] = rows.map(|row| row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]);
            let inside = |at: f64, end: f64| (0.0..=end * w).contains(&at);
            let seen = w > 0.0 && inside(x, size[0] as f64) && inside(y, size[1] as f64) && inside(z, 1.0);
            seen.then_some((item.label.as_str(), [x / w, y / w]))
        })
    }

    /// Columns and rows of the window that the picture takes \[pixel\].
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// The picture of the present state as the CPU draws it, depth and objects in false colours, `size` pixels wide and high.
    ///
    /// # Errors
    /// The camera or an item has no place; the size is zero or too large.
    pub fn picture(
        &mut self,
        session: &Session,
        [width, height]: [usize; 2],
    ) -> Result<Picture, RenderError> {
        let mut picture = Picture::new(width, height);
        self.scenery.update(session)?;
        self.channel.draw(&self.scenery, &mut Renderer::new(self.scenery.settings), &mut picture)?;
        Ok(picture)
    }
}
