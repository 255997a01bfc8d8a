//! Visual observations: what the visual keys of an environment show.

use crate::environment::Env;
use crate::error::EnvError;
use crate::network::{Network, NetworkError, Networks};
use crate::sight::Shot;
use crate::visual::{Channel, Encoder, VisualKey};
use physics::Model;
use render::picture::Channels;
use render::scene::Camera;
use render::{Picture, Scene, raster};
use robot::Compat;
use std::sync::{Arc, Mutex, PoisonError};

/// The values of an image.
#[derive(Clone, Debug, PartialEq)]
pub enum Pixels {
    /// Colours, 8 bits each.
    Bytes(Vec<u8>),
    /// Depths [m], or the features that a network finds.
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
    /// Simulation time at which they were taken [s].
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
                    takes.push(Take { camera, channels, picture, rgb: None, depth: None });
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

impl Env {
    /// The images of the visual keys, drawn of the state that the last observation shows, as the robot's sensors see it. No
    /// other method draws them, so that an environment with visual keys costs nothing more until they are asked for. Asked
    /// again in the same state they are not drawn again.
    ///
    /// An environment without visual keys has no images. Depth is in metres, of shape 1 x H x W as in the original. A `d:`
    /// key is drawn whether or not its colours are asked for too; the original leaves it out without them.
    ///
    /// # Errors
    /// The model or a camera cannot be drawn; a network is missing, with the file that has its weights.
    pub fn exteroception(&mut self) -> Result<&Exteroception, EnvError> {
        if self.eyes.current {
            return Ok(&self.eyes.seen);
        }
        let network = self.network()?;
        let data = if self.differs { &self.observed } else { &self.scene.data };
        let shots = self.eyes.takes.iter_mut().map(|take| Shot {
            camera: take.camera,
            channels: take.channels,
            picture: &mut take.picture,
        });
        self.sight.draw(&self.scene.model, data, shots)?;
        self.take_images(network.as_deref())
    }

    /// The network of the visual keys, where one of them needs it.
    fn network(&self) -> Result<Option<Arc<dyn Network>>, EnvError> {
        let encoded = self.visual_keys.iter().find(|key| key.is_encoded());
        encoded.map(|key| self.eyes.network.get(key, self.compat)).transpose()
    }

    /// Lists what the images show, if they are out of date: [`Env::shots`] draw them.
    pub(crate) fn list_images(&mut self) -> Result<(), EnvError> {
        if self.eyes.current {
            return Ok(());
        }
        self.network()?;
        let data = if self.differs { &self.observed } else { &self.scene.data };
        let Eyes { takes, scenes, .. } = &mut self.eyes;
        self.sight.list(&self.scene.model, data, takes.iter().map(|take| take.camera), scenes)
    }

    /// What was listed, to be drawn; [`Env::finish_images`] follows.
    pub(crate) fn shots(&mut self) -> impl Iterator<Item = raster::Shot<'_>> {
        let Eyes { takes, scenes, current, .. } = &mut self.eyes;
        let assets = self.sight.assets().filter(|_| !*current);
        let listed = takes.iter_mut().zip(&*scenes);
        assets.into_iter().zip(std::iter::once(listed)).flat_map(|(assets, listed)| {
            listed.map(move |(take, scene)| raster::Shot {
                assets,
                scene,
                channels: take.channels,
                picture: &mut take.picture,
            })
        })
    }

    /// Makes images of the drawings, if they are out of date.
    pub(crate) fn finish_images(&mut self) -> Result<(), EnvError> {
        if !self.eyes.current {
            let network = self.network()?;
            self.take_images(network.as_deref())?;
        }
        Ok(())
    }

    /// Makes images of the drawings.
    fn take_images(&mut self, network: Option<&dyn Network>) -> Result<&Exteroception, EnvError> {
        let Eyes { takes, seen, current, .. } = &mut self.eyes;
        seen.time = self.scene.data.time();
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

    /// The images, where they were drawn of the present state; RoboHive's `visual_dict`, which is empty otherwise.
    pub fn visuals(&self) -> Option<&Exteroception> {
        self.eyes.current.then_some(&self.eyes.seen)
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

impl Encoder {
    /// The number of features, where a network finds them.
    pub fn network(self) -> Option<usize> {
        match self {
            Encoder::Flat | Encoder::Image => None,
            Encoder::R3m(depth) | Encoder::Rrl(depth) => Some(if depth == 50 { 2048 } else { 512 }),
            Encoder::Vc1 { large } => Some(if large { 1024 } else { 768 }),
        }
    }
}

impl VisualKey {
    /// Shape of the image: H x W x 3 colours (`2d`), all of them in one row (`1d`), the features of a network, or 1 x H x W
    /// depths.
    pub fn shape(&self) -> Vec<usize> {
        let (height, width) = (self.height, self.width);
        match (self.channel, self.encoder) {
            (Channel::Depth, _) => vec![1, height, width],
            (Channel::Rgb, Encoder::Flat) => vec![height * width * 3],
            (Channel::Rgb, Encoder::Image) => vec![height, width, 3],
            (Channel::Rgb, encoder) => encoder.network().into_iter().collect(),
        }
    }

    /// Whether it is what a network makes of colours.
    pub fn is_encoded(&self) -> bool {
        self.channel == Channel::Rgb && self.encoder.network().is_some()
    }
}
