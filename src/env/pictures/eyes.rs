//! Visual observations: what the visual keys of an environment show.

use crate::error::EnvError;
use crate::pictures::cameras::Cameras;
use crate::pictures::network::{Network, NetworkError, Networks};
use crate::pictures::sight::Shot;
use crate::pictures::visual::{Channel, VisualKey};
use physics::Model;
use render::picture::Channels;
use render::scene::Camera;
use render::{Assets, Picture, Scene, raster};
use robot::Compat;
use std::sync::{Arc, Mutex, PoisonError};

/// The values of an image.
#[derive(Clone, Debug, PartialEq)]
pub enum Pixels {
    /// Colours, 8 bits each.
    Bytes(Vec<u8>),
    /// Depths \[m\], or the features that a network finds.
    Numbers(Vec<f32>),
}

impl Pixels {
    /// How many values there are.
    pub fn len(&self) -> usize {
        match self {
            Pixels::Bytes(bytes) => bytes.len(),
            Pixels::Numbers(numbers) => numbers.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// What one visual key shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    name: String,
    shape: Vec<usize>,
    pixels: Pixels,
}

impl Image {
    fn empty(key: &VisualKey) -> Self {
        let bytes = key.channel == Channel::Rgb && key.encoder.network().is_none();
        let pixels = if bytes { Pixels::Bytes(Vec::new()) } else { Pixels::Numbers(Vec::new()) };
        Image { name: key.to_string(), shape: key.shape(), pixels }
    }

    /// The visual key, as text.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its shape, as [`VisualKey::shape`].
    pub fn shape(&self) -> &[usize] {
        &self.shape
    }

    /// Its values, row 0 at the top.
    pub fn pixels(&self) -> &Pixels {
        &self.pixels
    }
}

/// Images of one state, in the order of the visual keys. What the original calls `visual_dict`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Exteroception {
    time: f64,
    images: Vec<Image>,
}

impl Exteroception {
    /// Simulation time at which they were taken \[s\].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The images.
    pub fn images(&self) -> &[Image] {
        &self.images
    }

    /// The image of a visual key.
    pub fn get(&self, name: &str) -> Option<&Image> {
        self.images.iter().find(|image| image.name == name)
    }
}

/// The visual keys of an environment, and what draws them.
pub(crate) struct Eyes {
    takes: Vec<Take>,
    /// What the takes show, when they are drawn together with takes of other environments.
    scenes: Vec<Scene>,
    seen: Exteroception,
    current: bool,
    network: Arc<Loaded>,
}

/// A network that is loaded when it is first used, and shared by clones.
struct Loaded {
    networks: Arc<dyn Networks>,
    network: Mutex<Option<Arc<dyn Network>>>,
}

/// One drawing, and the images that are made of it.
#[derive(Clone)]
struct Take {
    camera: Camera,
    /// Its name.
    name: String,
    channels: Channels,
    picture: Picture,
    rgb: Option<usize>,
    depth: Option<usize>,
}

impl Eyes {
    /// Groups the keys of the same camera and size into one drawing.
    pub(crate) fn new(
        keys: &[VisualKey],
        model: &Model,
        networks: Arc<dyn Networks>,
    ) -> Result<Self, EnvError> {
        let mut takes: Vec<Take> = Vec::new();
        for (index, key) in keys.iter().enumerate() {
            let camera = Camera::named(model, &key.camera)?;
            let fits = |take: &&mut Take| {
                take.camera == camera && (take.picture.height, take.picture.width) == (key.height, key.width)
            };
            let take = match takes.iter_mut().find(fits) {
                Some(take) => take,
                None => {
                    let channels = Channels { rgb: false, depth: false, segmentation: false };
                    let picture = Picture::new(key.width, key.height);
                    let name = key.camera.clone();
                    takes.push(Take { camera, name, channels, picture, rgb: None, depth: None });
                    takes.last_mut().expect("one was pushed")
                }
            };
            match key.channel {
                Channel::Rgb => (take.rgb, take.channels.rgb) = (Some(index), true),
                Channel::Depth => (take.depth, take.channels.depth) = (Some(index), true),
            }
        }
        let images = keys.iter().map(Image::empty).collect();
        let network = Arc::new(Loaded { networks, network: Mutex::default() });
        let seen = Exteroception { time: 0.0, images };
        Ok(Eyes { takes, scenes: Vec::new(), seen, current: false, network })
    }

    /// Others for the same keys, which share the network.
    pub(crate) fn fork(&self) -> Self {
        let Eyes { takes, seen, current, network, .. } = self;
        Eyes {
            takes: takes.clone(),
            scenes: Vec::new(),
            seen: seen.clone(),
            current: *current,
            network: network.clone(),
        }
    }

    /// Marks the images as out of date.
    pub(crate) fn close(&mut self) {
        self.current = false;
    }

    /// Whether the images are up to date.
    pub(crate) fn open(&self) -> bool {
        self.current
    }

    /// The images that were made last.
    pub(crate) fn seen(&self) -> &Exteroception {
        &self.seen
    }

    /// The network that finds the features of a key.
    pub(crate) fn network(&self, key: &VisualKey, compat: Compat) -> Result<Arc<dyn Network>, EnvError> {
        self.network.get(key, compat)
    }

    /// The drawings, to be filled; [`Eyes::finish`] follows.
    pub(crate) fn shots(&mut self) -> impl Iterator<Item = Shot<'_>> {
        self.takes.iter_mut().map(|take| Shot {
            camera: take.camera,
            channels: take.channels,
            picture: &mut take.picture,
        })
    }

    /// Fills the images with frames of connected cameras; call [`Eyes::finish`] next.
    pub(crate) fn look_through(&mut self, cameras: &mut dyn Cameras) -> Result<(), EnvError> {
        let mut fill = |take: &mut Take| cameras.take(&take.name, take.channels, &mut take.picture);
        self.takes
            .iter_mut()
            .try_for_each(&mut fill)
            .map_err(|error| EnvError::Camera { message: error.into() })
    }

    /// The cameras of the drawings, and where what they show is listed.
    pub(crate) fn scenes(&mut self) -> (impl ExactSizeIterator<Item = Camera>, &mut Vec<Scene>) {
        (self.takes.iter().map(|take| take.camera), &mut self.scenes)
    }

    /// The drawings of what was listed, to be filled; [`Eyes::finish`] follows.
    pub(crate) fn listed<'a>(&'a mut self, assets: &'a Assets) -> impl Iterator<Item = raster::Shot<'a>> {
        self.takes.iter_mut().zip(&self.scenes).map(move |(take, scene)| raster::Shot {
            assets,
            scene,
            channels: take.channels,
            picture: &mut take.picture,
        })
    }

    /// Makes images of the drawings, which were taken at a time \[s\].
    pub(crate) fn finish(
        &mut self,
        time: f64,
        network: Option<&dyn Network>,
    ) -> Result<&Exteroception, EnvError> {
        let Eyes { takes, seen, current, .. } = self;
        seen.time = time;
        for take in takes {
            if let Some(index) = take.rgb {
                let Image { name, pixels, .. } = &mut seen.images[index];
                encode(take, network, pixels)
                    .map_err(|error| EnvError::Network { key: name.clone(), message: error.into() })?;
            }
            if let Some(index) = take.depth
                && let Pixels::Numbers(depth) = &mut seen.images[index].pixels
            {
                std::mem::swap(depth, &mut take.picture.depth);
            }
        }
        *current = true;
        Ok(seen)
    }
}

impl Loaded {
    fn get(&self, key: &VisualKey, compat: Compat) -> Result<Arc<dyn Network>, EnvError> {
        let mut network = self.network.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(network) = &*network {
            return Ok(network.clone());
        }
        let wrong = |error: NetworkError| EnvError::Network { key: key.to_string(), message: error.into() };
        let loaded = self.networks.load(key.encoder, compat).map_err(wrong)?;
        Ok(network.insert(loaded).clone())
    }
}

/// Turns the colours of a drawing into the values of an image. Bytes change places with those of the image before, whose
/// memory the next drawing fills.
fn encode(take: &mut Take, network: Option<&dyn Network>, pixels: &mut Pixels) -> Result<(), NetworkError> {
    let Picture { width, height, rgb, .. } = &mut take.picture;
    match (pixels, network) {
        (Pixels::Bytes(bytes), _) => std::mem::swap(bytes, rgb),
        (Pixels::Numbers(features), Some(network)) => {
            features.clear();
            network.encode([*height, *width], rgb, features)?;
        }
        (Pixels::Numbers(_), None) => {}
    }
    Ok(())
}
