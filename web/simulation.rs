//! A simulation as JavaScript holds it.

use crate::files::Files;
use crate::recording::Recording;
use mjcf::Loaded;
use physics::Model;
use physics::model::ObjType;
use render::Picture;
use render::picture::Channels;
use viewer::{Command, Drawing, Grip, Look, Plane, Session, load_own, shortcuts, text};
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// A model or an environment that is run, drawn and touched.
#[wasm_bindgen]
pub struct Simulation {
    pub(crate) session: Session,
    pub(crate) recording: Option<Recording>,
    drawing: Drawing,
    warnings: String,
}

/// Turns a message into an exception.
pub(crate) fn exception(message: impl std::fmt::Display) -> JsError {
    JsError::new(&message.to_string())
}

/// What people call an element: its name, or its kind and number.
pub(crate) fn called(model: &Model, kind: ObjType, id: usize) -> String {
    match model.name_of(kind, id) {
        "" => model.label_of(kind, id),
        name => name.to_owned(),
    }
}

impl Simulation {
    pub(crate) fn of(session: Session, warnings: String) -> Result<Self, String> {
        let drawing = Drawing::new(session.model()).map_err(|error| error.to_string())?;
        Ok(Simulation { session, drawing, warnings, recording: None })
    }

    fn loaded(loaded: Loaded) -> Result<Self, String> {
        let session = Session::new(loaded.model).map_err(|error| error.to_string())?;
        Self::of(session, loaded.warnings.to_string())
    }
}

#[wasm_bindgen]
impl Simulation {
    /// The model at a path among files.
    ///
    /// # Errors
    /// All that is wrong with it, each with file, line and column; meshes and other files that are missing too.
    pub fn open(files: &Files, path: &str) -> Result<Simulation, JsError> {
        let loaded = files.load(path).map_err(exception)?;
        Self::loaded(loaded).map_err(exception)
    }

    /// A model of our own, by its name in `ownModels()`.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn own(name: &str) -> Result<Simulation, JsError> {
        let loaded = load_own(name).map_err(exception)?;
        Self::loaded(loaded).map_err(exception)
    }

    /// What was ignored or assumed when the model was read; empty if nothing was.
    #[wasm_bindgen(getter)]
    pub fn warnings(&self) -> String {
        self.warnings.clone()
    }

    /// Name of the model, or id of the environment.
    #[wasm_bindgen(getter)]
    pub fn name(&self) -> String {
        match self.session.play() {
            Some(play) => play.env().spec().id.clone(),
            None => self.session.model().name.clone(),
        }
    }

    /// Simulated time \[s\].
    #[wasm_bindgen(getter)]
    pub fn time(&self) -> f64 {
        self.session.data().time()
    }

    /// Time that a step takes \[s\].
    #[wasm_bindgen(getter)]
    pub fn timestep(&self) -> f64 {
        self.session.span()
    }

    /// Number of contacts.
    #[wasm_bindgen(getter)]
    pub fn contacts(&self) -> usize {
        self.session.data().con.contact.len()
    }

    /// Why the simulation has stopped, if a step failed.
    #[wasm_bindgen(getter)]
    pub fn fault(&self) -> Option<String> {
        self.session.fault().map(str::to_owned)
    }

    /// Whether time goes by.
    #[wasm_bindgen(getter)]
    pub fn running(&self) -> bool {
        self.session.is_running()
    }

    /// Lets time go by in `advance`, or stops it.
    #[wasm_bindgen(setter)]
    pub fn set_running(&mut self, running: bool) {
        self.session.run(running);
    }

    /// Real time went by \[s\]: takes the steps that are due, as many as `budget` milliseconds allow. Returns how many.
    pub fn advance(&mut self, seconds: f64, budget: f64) -> usize {
        let end = clock::now() + budget;
        let Some(recording) = self.recording.as_mut().filter(|_| self.session.is_running()) else {
            return self.session.advance(seconds, &mut || clock::now() < end);
        };
        // Step by step, each of which becomes a row.
        let (mut left, mut steps) = (seconds, 0);
        loop {
            let piece = left.min(self.session.span());
            left -= piece;
            let stepped = recording.around(&mut self.session, |session| {
                let mut first = true;
                session.advance(piece, &mut || std::mem::take(&mut first) && clock::now() < end)
            });
            steps += stepped;
            if left <= 0.0 && stepped == 0 {
                return steps;
            }
        }
    }

    /// Takes `count` steps. Returns how many were taken; fewer when one failed, then `fault` says why.
    pub fn step(&mut self, count: usize) -> usize {
        let one = |session: &mut Session| {
            session.step_forward();
            usize::from(session.fault().is_none())
        };
        (0..count)
            .take_while(|_| match &mut self.recording {
                Some(recording) => recording.around(&mut self.session, one) > 0,
                None => one(&mut self.session) > 0,
            })
            .count()
    }

    /// One state back in the history.
    #[wasm_bindgen(js_name = stepBack)]
    pub fn step_back(&mut self) {
        self.session.step_back();
    }

    /// How many states the one that is shown lies behind the latest.
    #[wasm_bindgen(getter)]
    pub fn behind(&self) -> usize {
        self.session.history().behind()
    }

    /// The first keyframe, or the reference; of an environment, the start of the next episode.
    pub fn reset(&mut self) {
        self.session.reset();
    }

    /// Hash of the state: time, positions, velocities, activations and accelerations, in 16 hexadecimal digits. Every build
    /// computes the same.
    pub fn hash(&self) -> String {
        format!("{:016x}", self.session.hash())
    }

    /// The present state as an element of `<keyframe>`, every number exact.
    #[wasm_bindgen(js_name = keyText)]
    pub fn key_text(&self) -> String {
        text::key(self.session.model(), self.session.data(), true)
    }

    /// Distance from the camera's plane \[m\] of what each pixel shows, row by row from the top.
    ///
    /// # Errors
    /// The size is zero or above 8192, or the camera has no place.
    #[wasm_bindgen(js_name = drawDepth)]
    pub fn draw_depth(&mut self, width: usize, height: usize) -> Result<Vec<f32>, JsError> {
        let picture = self.picture([width, height], Channels::DEPTH)?;
        Ok(picture.depth.clone())
    }

    /// Number and type (MuJoCo's `mjtObj`) of what each pixel shows, row by row from the top; -1 and -1 where there is nothing.
    ///
    /// # Errors
    /// The size is zero or above 8192, or the camera has no place.
    #[wasm_bindgen(js_name = drawSegmentation)]
    pub fn draw_segmentation(&mut self, width: usize, height: usize) -> Result<Vec<i32>, JsError> {
        let picture = self.picture([width, height], Channels::SEGMENTATION)?;
        Ok(picture.segmentation.as_flattened().to_vec())
    }

    /// Draws the present state: bytes R, G, B, A of each pixel, row by row from the top, as `ImageData` takes them.
    ///
    /// # Errors
    /// The size is zero or above 8192, or the camera has no place.
    pub fn draw(&mut self, width: usize, height: usize) -> Result<Vec<u8>, JsError> {
        let picture = self.picture([width, height], Channels::RGB)?;
        let (pixels, _) = picture.rgb.as_chunks::<3>();
        Ok(pixels.iter().flat_map(|&[r, g, b]| [r, g, b, 255]).collect())
    }

    fn picture(&mut self, size: [usize; 2], channels: Channels) -> Result<&Picture, JsError> {
        const MOST: usize = 8192;
        let [width, height] = size;
        if !size.iter().all(|side| (1..=MOST).contains(side)) {
            return Err(exception(format!(
                "a picture has 1 to {MOST} pixels a side, not {width} by {height}"
            )));
        }
        self.drawing.draw_channels(&self.session, size, channels).map_err(exception)
    }

    /// A number that grows with every change of the state: a picture of the same one need not be drawn again.
    #[wasm_bindgen(getter)]
    pub fn revision(&self) -> f64 {
        self.session.revision() as f64
    }

    /// Turns the free camera by a drag, in heights of the picture to the right and up.
    pub fn orbit(&mut self, right: f64, up: f64) {
        self.session.look(Look::Orbit, [right, up]);
    }

    /// Moves it in the vertical plane.
    pub fn pan(&mut self, right: f64, up: f64) {
        self.session.look(Look::Pan(Plane::Vertical), [right, up]);
    }

    /// Brings it nearer.
    pub fn zoom(&mut self, nearer: f64) {
        self.session.look(Look::Zoom, [0.0, nearer]);
    }

    /// Selects the body at a place of the picture, from its lower left corner to 1: its name, or nothing.
    pub fn select(&mut self, aspect: f64, right: f64, up: f64) -> Option<String> {
        self.session.select(aspect, [right, up])?;
        self.selected()
    }

    /// Selects a body by its place in `names("body")`; none at 0, which is the world.
    #[wasm_bindgen(js_name = selectBody)]
    pub fn select_body(&mut self, body: usize) -> Option<String> {
        self.session.set_selected(Some(body));
        self.selected()
    }

    /// Name of the selected body.
    #[wasm_bindgen(getter)]
    pub fn selected(&self) -> Option<String> {
        let selected = self.session.selected()?;
        Some(called(self.session.model(), ObjType::Body, selected.body))
    }

    /// Takes hold of the selected body, to pull it, or to turn it. False when none is selected.
    pub fn grab(&mut self, turn: bool) -> bool {
        self.session.grab(if turn { Grip::Turn } else { Grip::Pull });
        self.session.holds()
    }

    /// Moves what is held by a drag, in heights of the picture; in the horizontal plane, or the vertical one.
    pub fn drag(&mut self, right: f64, up: f64, horizontal: bool) {
        let plane = if horizontal { Plane::Horizontal } else { Plane::Vertical };
        self.session.drag(plane, [right, up]);
    }

    /// Lets go.
    pub fn release(&mut self) {
        self.session.release();
    }

    /// Chosen speed \[% of real time\].
    #[wasm_bindgen(getter)]
    pub fn speed(&self) -> f64 {
        self.session.pace().percent()
    }

    /// Speed that was reached lately \[% of real time\]; nothing before there is a measurement.
    #[wasm_bindgen(getter, js_name = reachedSpeed)]
    pub fn reached_speed(&self) -> Option<f64> {
        self.session.pace().reached()
    }

    /// Keys and what they do, one after the other.
    #[wasm_bindgen(js_name = shortcuts)]
    pub fn keys() -> Vec<String> {
        shortcuts().into_iter().flat_map(|shortcut| [shortcut.key, shortcut.name]).collect()
    }

    /// Does what a key does in MuJoCo's viewer (`KeyboardEvent.code` without `Key`, `Shift+` before it). False for other keys.
    pub fn key(&mut self, key: &str) -> bool {
        let command: Option<Command> =
            shortcuts().into_iter().find(|shortcut| shortcut.key == key).map(|shortcut| shortcut.command);
        command.map(|command| self.session.perform(command)).is_some()
    }
}

/// Milliseconds that go by.
mod clock {
    #[cfg(target_arch = "wasm32")]
    mod page {
        use wasm_bindgen::prelude::wasm_bindgen;

        #[wasm_bindgen]
        extern "C" {
            #[wasm_bindgen(js_namespace = performance)]
            pub fn now() -> f64;
        }
    }

    #[cfg(target_arch = "wasm32")]
    pub use page::now;

    #[cfg(not(target_arch = "wasm32"))]
    pub fn now() -> f64 {
        use std::sync::OnceLock;
        use std::time::Instant;
        static START: OnceLock<Instant> = OnceLock::new();
        START.get_or_init(Instant::now).elapsed().as_secs_f64() * 1e3
    }
}
