//! Which items stand still in a view, and the backdrops made of them.
//!
//! An item that has not changed for some pictures of a view is taken into the view's backdrop; when one of them changes, the
//! backdrop is made again without it.

use super::backdrop::{Backdrop, Stills};
use super::colour::sky::Sky;
use super::draws::Draws;
use super::settings::Settings;
use super::window::coverage::Extent;
use crate::geometry::{Assets, Paint, Surface};
use crate::scene::{Category, Fog, Item, Light, Scene};
use crate::texture::Texture;
use crate::view::View;
use std::sync::Arc;

/// An item of a body that can move counts as standing still after this many unchanged pictures.
const QUIET: u16 = 8;
/// The same number for items that are fixed to the world.
const QUIET_STATIC: u16 = 1;
/// Share of the triangles at rest that may be missing from a backdrop before it is made again.
const MISSING: f64 = 0.2;
/// Views that are kept; the one used longest ago gives way.
const VIEWS: usize = 16;

/// What to do with the backdrop of a view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plan {
    /// Nothing stands still.
    Without,
    /// It is to be made first.
    Make,
    /// It holds.
    Use,
}

/// A picture that is about to be drawn.
#[derive(Clone, Copy)]
pub struct Present<'a> {
    /// Triangles and textures.
    pub assets: &'a Assets,
    /// What there is to draw.
    pub scene: &'a Scene,
    /// Its surfaces.
    pub draws: &'a Draws,
    /// Size of the window \[pixel\].
    pub extent: Extent,
    /// How finely it is drawn.
    pub settings: Settings,
}

/// The views of a renderer.
#[derive(Clone, Debug)]
pub struct Views {
    views: Vec<Kept>,
    now: u64,
    /// A view in which nothing stands still.
    nothing: Kept,
}

impl Default for Views {
    fn default() -> Self {
        let nothing = Kept::new(View::default(), Extent { width: 0, height: 0 }, Settings::default());
        Views { views: Vec::new(), now: 0, nothing }
    }
}

/// Which view a picture is of; none where nothing is kept.
pub type Place = Option<usize>;

/// One view and its backdrops.
#[derive(Clone, Debug)]
pub struct Kept {
    around: Around,
    surfaces: Vec<Arc<Surface>>,
    textures: Vec<Arc<Texture>>,
    items: Vec<Item>,
    paints: Vec<Paint>,
    quiet: Vec<u16>,
    used: u64,
    /// What its backdrops show.
    pub stills: Stills,
    /// Of the picture itself.
    pub main: Backdrop,
    /// Of what its mirror shows, and the item that mirrors.
    pub mirror: Backdrop,
    /// Its sky.
    pub sky: Sky,
}

/// Everything but items that decides on a picture.
#[derive(Clone, Debug, PartialEq)]
struct Around {
    view: View,
    extent: Extent,
    settings: Settings,
    lights: Vec<Light>,
    ambient: f32,
    fog: Option<Fog>,
    shadows: bool,
    reflections: bool,
    culling: bool,
}

impl Views {
    /// The view that a scene is seen from, and what to do with its backdrop. The view stays in its place until as many others
    /// as there is room for are found.
    pub fn find(&mut self, now: &Present<'_>) -> (Place, Plan) {
        if !now.settings.keep || now.scene.wireframe {
            return (None, Plan::Without);
        }
        let Present { scene, extent, settings, .. } = *now;
        self.now += 1;
        let same = |kept: &Kept| kept.around.view == scene.view && kept.around.extent == extent;
        let place = self.views.iter().position(same).unwrap_or_else(|| {
            if self.views.len() < VIEWS {
                self.views.push(Kept::new(scene.view, extent, settings));
                return self.views.len() - 1;
            }
            (0..VIEWS).min_by_key(|&place| self.views[place].used).unwrap_or(0)
        });
        let kept = &mut self.views[place];
        kept.used = self.now;
        let plan = kept.plan(now);
        (Some(place), plan)
    }

    /// What is kept of a view.
    pub fn kept(&self, place: Place) -> &Kept {
        place.map_or(&self.nothing, |place| &self.views[place])
    }

    /// What is kept of a view, to change.
    pub fn kept_mut(&mut self, place: Place) -> &mut Kept {
        place.map_or(&mut self.nothing, |place| &mut self.views[place])
    }
}

impl Kept {
    fn new(view: View, extent: Extent, settings: Settings) -> Self {
        let around = Around {
            view,
            extent,
            settings,
            lights: Vec::new(),
            ambient: 0.0,
            fog: None,
            shadows: false,
            reflections: false,
            culling: true,
        };
        Kept {
            around,
            surfaces: Vec::new(),
            textures: Vec::new(),
            items: Vec::new(),
            paints: Vec::new(),
            quiet: Vec::new(),
            used: 0,
            stills: Stills::default(),
            main: Backdrop::default(),
            mirror: Backdrop::default(),
            sky: Sky::default(),
        }
    }

    fn plan(&mut self, now: &Present<'_>) -> Plan {
        let Present { assets, scene, draws, .. } = *now;
        if !self.is_as_before(now) {
            self.remember(now);
            self.quiet.clear();
            self.quiet.resize(scene.items.len(), 0);
            self.stills.set(scene.items.len(), |_| false);
            return Plan::Without;
        }
        let holds = self.count_quiet(scene, draws);
        let rests = |kept: &Kept, item: usize| {
            let enough = if scene.items[item].category == Category::Static { QUIET_STATIC } else { QUIET };
            kept.quiet[item] >= enough
        };
        let (mut at_rest, mut missing) = (0, 0);
        for draw in &draws.list {
            if rests(self, draw.item) {
                let triangles = draw.surface(assets).faces.len();
                at_rest += triangles;
                missing += if self.stills.has(draw) { 0 } else { triangles };
            }
        }
        if holds && f64::from(missing as u32) <= MISSING * f64::from(at_rest as u32) {
            return if self.stills.any() { Plan::Use } else { Plan::Without };
        }
        let mut stills = std::mem::take(&mut self.stills);
        stills.set(scene.items.len(), |item| rests(self, item));
        self.stills = stills;
        if self.stills.any() { Plan::Make } else { Plan::Without }
    }

    /// Whether nothing but items has changed, and no item has changed its shape.
    fn is_as_before(&self, now: &Present<'_>) -> bool {
        let Present { assets, scene, draws, extent, settings } = *now;
        let a = &self.around;
        let around = a.view == scene.view && a.extent == extent && a.settings == settings;
        let lights = a.lights == scene.lights && a.ambient == scene.ambient && a.fog == scene.fog;
        let flags =
            (a.shadows, a.reflections, a.culling) == (scene.shadows, scene.reflections, scene.culling);
        let surfaces = self.surfaces.len() == assets.surfaces.len()
            && self.surfaces.iter().zip(&assets.surfaces).all(|(a, b)| Arc::ptr_eq(a, b));
        let textures = self.textures.len() == assets.textures.len()
            && self.textures.iter().zip(&assets.textures).all(|(a, b)| Arc::ptr_eq(a, b));
        let shapes = self.items.len() == scene.items.len()
            && self.items.iter().zip(&scene.items).all(|(a, b)| a.shape == b.shape);
        around && lights && flags && surfaces && textures && shapes && self.paints.len() == draws.list.len()
    }

    fn remember(&mut self, now: &Present<'_>) {
        let Present { assets, scene, draws, extent, settings } = *now;
        self.sky.forget();
        let a = &mut self.around;
        (a.view, a.extent, a.settings) = (scene.view, extent, settings);
        a.lights.clone_from(&scene.lights);
        (a.ambient, a.fog) = (scene.ambient, scene.fog);
        (a.shadows, a.reflections, a.culling) = (scene.shadows, scene.reflections, scene.culling);
        self.surfaces.clone_from(&assets.surfaces);
        self.textures.clone_from(&assets.textures);
        self.items.clone_from(&scene.items);
        self.paints.clear();
        self.paints.extend(draws.list.iter().map(|draw| draw.paint));
    }

    /// Counts for how long each item has been as it is; whether all in the backdrop still are.
    fn count_quiet(&mut self, scene: &Scene, draws: &Draws) -> bool {
        for ((old, new), quiet) in self.items.iter_mut().zip(&scene.items).zip(&mut self.quiet) {
            if old == new {
                *quiet = quiet.saturating_add(1);
            } else {
                old.clone_from(new);
                *quiet = 0;
            }
        }
        for (old, draw) in self.paints.iter_mut().zip(&draws.list) {
            if *old != draw.paint {
                (*old, self.quiet[draw.item]) = (draw.paint, 0);
            }
        }
        self.stills.all(|item| self.quiet[item] > 0)
    }
}
