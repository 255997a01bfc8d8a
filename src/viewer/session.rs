//! A model that is run, looked at and touched: all that a viewer does but drawing and windows.

mod follow;
mod keys;
mod replayed;
mod taped;
mod touch;

pub use keys::KEPT_KEYS;
pub use replayed::ForeignTrajectory;
pub use taped::TapeError;

use crate::camera::Plane;
use crate::hand::Hand;
use crate::history::History;
use crate::noise::Noise;
use crate::play::{Play, PlayError};
use crate::profile::Profile;
use crate::replay::{Reference, Replay};
use crate::speed::Pace;
use crate::tape::StateTape;
use mjcf::edit::carry_state;
use physics::data::ForeignSnapshot;
use physics::math::Vec3;
use physics::model::{Options, Visual};
use physics::{Data, Model, Snapshot, StepError, forward, step, step_watched};
use render::scene::{Camera, FreeCamera, Item, SceneOptions};

/// A model, its state, and what a person does with it.
pub struct Session {
    model: Model,
    data: Data,
    running: bool,
    pace: Pace,
    history: History,
    hand: Option<Hand>,
    selected: Option<Selected>,
    fault: Option<String>,
    revision: u64,
    /// The environment whose model and state these are, where it is one.
    play: Option<Box<Play>>,
    /// States that are being recorded.
    tape: Option<StateTape>,
    /// States that a person keeps.
    kept: Vec<Snapshot>,
    /// Recorded states that are shown instead of a simulation.
    replay: Option<Box<Replay>>,
    /// Recorded states that are drawn beside it.
    reference: Option<Box<Reference>>,
    /// Where the time of steps goes, while a person looks at it.
    pub profile: Option<Profile>,
    /// Another program has the time.
    follows: bool,
    /// Items that a program adds to the scene.
    guests: Vec<Item>,
    /// Noise on controls.
    pub noise: Noise,
    /// What it is seen with.
    pub camera: Camera,
    /// What is shown.
    pub options: SceneOptions,
}

/// A body that a person has chosen, and a point of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Selected {
    /// The body, not the world.
    pub body: usize,
    /// The point, in the frame of the body \[m\].
    pub point: Vec3,
}

/// What a drag does while nothing is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// Turns about the point that is looked at.
    Orbit,
    /// Moves that point in a plane.
    Pan(Plane),
    /// Comes nearer.
    Zoom,
}

impl Session {
    /// A session that begins, paused, at the first keyframe, or at the reference where there is none.
    ///
    /// # Errors
    /// This state cannot be evaluated.
    pub fn new(model: Model) -> Result<Self, StepError> {
        let mut data = Data::new(&model);
        if model.nkey > 0 {
            // There is a keyframe 0.
            let _ = data.reset_to_key(&model, 0);
        }
        forward(&model, &mut data)?;
        Ok(Session::at(model, data))
    }

    /// A session with an environment, paused at the first state of its episode. Its steps are control periods; the states
    /// that were are shown, and it goes on from the latest.
    pub fn playing(play: Play) -> Self {
        let scene = play.env().scene();
        let mut session = Session::at(scene.model.clone(), scene.data.clone());
        session.pace = Pace::near(100.0);
        session.play = Some(Box::new(play));
        session
    }

    fn at(model: Model, data: Data) -> Self {
        let mut session = Session {
            running: false,
            pace: Pace::near(f64::from(model.vis.global.realtime)),
            history: History::of(&model),
            hand: None,
            selected: None,
            fault: None,
            revision: 0,
            play: None,
            tape: None,
            profile: None,
            kept: Vec::new(),
            replay: None,
            reference: None,
            follows: false,
            guests: Vec::new(),
            noise: Noise::new(0),
            camera: Camera::free(&model),
            options: SceneOptions::default(),
            model,
            data,
        };
        if let Ok(camera) = usize::try_from(session.model.vis.global.cameraid)
            && camera < session.model.ncam
        {
            session.camera = Camera::Fixed(camera);
        }
        session.history.push(&session.data);
        session
    }

    /// The environment that is played.
    pub fn play(&self) -> Option<&Play> {
        self.play.as_deref()
    }

    /// The same, to choose what acts.
    pub fn play_mut(&mut self) -> Option<&mut Play> {
        self.play.as_deref_mut()
    }

    /// The model.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Its state, evaluated.
    pub fn data(&self) -> &Data {
        &self.data
    }

    /// FNV-1a over the bits of time, positions, velocities, activations and accelerations. Every build computes the same.
    pub fn hash(&self) -> u64 {
        let state = &self.data.state;
        let numbers = [&[state.time][..], &state.qpos, &state.qvel, &state.act, &self.data.acc.qacc].concat();
        numbers.into_iter().flat_map(f64::to_le_bytes).fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        })
    }

    /// Whether time goes by.
    pub fn is_running(&self) -> bool {
        self.running
    }

    /// Lets time go by, or stops it. From a state of the past, the states after it are dropped when it goes on.
    pub fn run(&mut self, running: bool) {
        if running && self.play.is_some() && self.history.behind() > 0 {
            self.show_past(0);
        }
        self.running = running && self.fault.is_none() && !self.follows;
        self.pace.forget();
    }

    /// The chosen speed, and what is reached of it.
    pub fn pace(&self) -> &Pace {
        &self.pace
    }

    /// The same, to be changed.
    pub fn pace_mut(&mut self) -> &mut Pace {
        &mut self.pace
    }

    /// The states so far.
    pub fn history(&self) -> &History {
        &self.history
    }

    /// Why the simulation has stopped, if a step failed.
    pub fn fault(&self) -> Option<&str> {
        self.fault.as_deref()
    }

    /// Real time went by \[s\]: takes the steps that are due while `may_go_on`, which is asked before each. Returns how many.
    pub fn advance(&mut self, seconds: f64, may_go_on: &mut dyn FnMut() -> bool) -> usize {
        if !self.running {
            if self.play.is_none() && self.replay.is_none() && !self.follows {
                self.place_held(true);
            }
            return 0;
        }
        if self.replay.is_some() {
            return self.advance_replay(seconds);
        }
        self.pace.elapse(seconds);
        let (span, mut steps) = (self.span(), 0);
        while self.running && self.pace.is_due(span) && may_go_on() {
            self.step();
            self.pace.stepped(span);
            steps += 1;
        }
        self.pace.settle();
        if steps > 0 {
            self.history.push(&self.data);
            if let Some(profile) = &mut self.profile {
                profile.end_frame(&self.data);
            }
            self.follow();
        }
        steps
    }

    /// What a step takes: a time step of the model, or a control period of the environment \[s\].
    pub fn span(&self) -> f64 {
        match (&self.play, &self.replay) {
            (Some(play), _) => play.env().dt(),
            (_, Some(replay)) => replay.span().unwrap_or(self.model.opt.timestep),
            _ => self.model.opt.timestep,
        }
    }

    /// One step forward: to the next state of the history where there is one, else a new one.
    pub fn step_forward(&mut self) {
        if self.follows {
            return;
        }
        self.running = false;
        if let Some(replay) = &self.replay {
            return self.seek(replay.row() + 1);
        }
        match self.history.behind() {
            0 => {
                self.step();
                self.history.push(&self.data);
                self.follow();
            }
            behind => self.show_past(behind - 1),
        }
    }

    /// One state back in the history.
    pub fn step_back(&mut self) {
        if let Some(replay) = &self.replay {
            return self.seek(replay.row().saturating_sub(1));
        }
        self.show_past(self.history.behind() + 1);
    }

    /// The state that lies `behind` the latest, or the oldest that is kept; the simulation pauses.
    pub fn show_past(&mut self, behind: usize) {
        if self.follows {
            return;
        }
        self.running = false;
        if let Some(snapshot) = self.history.go_to(behind) {
            let snapshot = snapshot.clone();
            // States of the history are of this model.
            let _ = self.show(&snapshot);
        }
    }

    /// The first keyframe, or the reference; of an environment, the start of the next episode; of a replay, its first state.
    pub fn reset(&mut self) {
        if self.replay.is_some() {
            return self.seek(0);
        }
        if let Some(play) = &self.play {
            return self.begin(play.seed().wrapping_add(1));
        }
        self.reset_to((self.model.nkey > 0).then_some(0));
    }

    /// The start of the episode of a seed. A session without an environment stays as it is.
    pub fn begin(&mut self, seed: u64) {
        let Some(play) = &mut self.play else { return };
        let begun = play.begin(seed);
        self.mirror(begun);
        self.history.push(&self.data);
    }

    /// A keyframe, or the reference. A keyframe that the model does not have changes nothing; nor does any in an environment,
    /// which starts as its task says.
    pub fn reset_to(&mut self, key: Option<usize>) {
        if self.play.is_some() || self.replay.is_some() || self.follows {
            return;
        }
        match key {
            None => self.data.reset(&self.model),
            Some(key) => {
                if self.data.reset_to_key(&self.model, key).is_err() {
                    return;
                }
            }
        }
        self.settle();
        self.history.push(&self.data);
    }

    /// A state that was saved of this model: the steps that follow are those that followed it.
    ///
    /// # Errors
    /// It is one of another model; nothing changes.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), ForeignSnapshot> {
        self.show(snapshot)?;
        self.history.push(&self.data);
        Ok(())
    }

    fn show(&mut self, snapshot: &Snapshot) -> Result<(), ForeignSnapshot> {
        self.data.restore(snapshot)?;
        self.settle();
        // The evaluation has changed where the solver starts from.
        self.data.restore(snapshot)
    }

    /// Writes controls, positions or other inputs, and evaluates what follows. In an environment the next step forgets them.
    pub fn edit(&mut self, write: impl FnOnce(&Model, &mut Data)) {
        write(&self.model, &mut self.data);
        self.settle();
    }

    /// Writes options of the physics, and evaluates what follows.
    pub fn edit_options(&mut self, write: impl FnOnce(&mut Options)) {
        write(self.model.options_mut());
        self.settle();
    }

    /// Writes visualisation options, on which no motion depends. In an environment the next step forgets them.
    pub fn edit_visual(&mut self, write: impl FnOnce(&mut Visual)) {
        write(self.model.visual_mut());
        self.revision += 1;
    }

    /// A number that grows with every change of the state or the model.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Evaluates a state that was put here rather than stepped to.
    fn settle(&mut self) {
        self.pace.forget();
        self.evaluate();
    }

    fn evaluate(&mut self) {
        self.revision += 1;
        self.fault = forward(&self.model, &mut self.data).err().map(|error| error.to_string());
        self.running &= self.fault.is_none();
        self.follow();
    }

    /// Another model in its place, in the state of the former by the names of elements; camera, options and kept states stay
    /// where they can, and a recording is completed.
    ///
    /// # Errors
    /// Its state cannot be evaluated; the session stays as it was.
    pub fn replace(&mut self, model: Model) -> Result<(), StepError> {
        let mut data = carry_state(&self.model, &self.data, &model);
        forward(&model, &mut data)?;
        let unwritten = self.end_recording();
        self.camera = self.camera_in(&model);
        self.play = None;
        self.kept = self.kept_in(&model);
        self.replay = self.replay.take().filter(|replay| replay.trajectory().fits(&model));
        let reference = self.reference.take().filter(|reference| reference.trajectory().fits(&model));
        self.reference = reference.map(|old| Box::new(Reference::new(old.trajectory().clone(), &model)));
        (self.hand, self.selected, self.fault) = (None, None, unwritten);
        self.history = History::of(&model);
        self.history.push(&data);
        (self.model, self.data) = (model, data);
        self.revision += 1;
        self.pace.forget();
        self.follow();
        Ok(())
    }

    /// The present camera in another model, by name.
    fn camera_in(&self, model: &Model) -> Camera {
        match self.camera {
            Camera::Fixed(camera) => {
                let name =
                    self.model.camera_names().find(|(id, _)| id.index() == camera).map(|(_, name)| name);
                name.and_then(|name| model.camera(name)).map_or_else(|| Camera::free(model), Camera::from)
            }
            Camera::Free(free) => {
                Camera::Free(FreeCamera { track: free.track.filter(|&b| b < model.nbody), ..free })
            }
        }
    }

    fn step(&mut self) {
        self.revision += 1;
        self.data.state.xfrc_applied.iter_mut().for_each(|wrench| *wrench = [0.0; 6]);
        if let Some(hand) = &self.hand {
            if self.play.is_none() {
                hand.place(&self.model, &mut self.data, false);
            }
            let [force, torque] = hand.wrench(&self.model, &self.data);
            let [x, y, z] = force;
            let [a, b, c] = torque;
            self.data.state.xfrc_applied[hand.body()] = [x, y, z, a, b, c];
        }
        if let Some(play) = &mut self.play {
            let stepped = play.step(&self.data.state.xfrc_applied);
            return self.mirror(stepped);
        }
        self.noise.step(&self.model, &mut self.data, None);
        if let Some(Err(why)) = self.tape.as_mut().map(|tape| tape.before(&self.data)) {
            return self.stop_at(why.to_string());
        }
        let stepped = match &mut self.profile {
            Some(profile) => {
                let clock = profile.clock();
                clock.begin();
                step_watched(&self.model, &mut self.data, clock)
            }
            None => step(&self.model, &mut self.data),
        };
        let taped = self.tape.as_mut().map(|tape| tape.after(&self.data, stepped.is_ok()));
        if let Err(error) = stepped {
            self.stop_at(error.to_string());
        } else if let Some(Err(why)) = taped {
            self.stop_at(why.to_string());
        }
    }

    /// Something failed: time stops, and what was recorded so far stays.
    fn stop_at(&mut self, why: String) {
        self.fault = Some(why);
        self.running = false;
    }

    /// Shows where the environment is.
    fn mirror(&mut self, went: Result<(), PlayError>) {
        let Some(play) = &self.play else { return };
        let scene = play.env().scene();
        self.revision += 1;
        // Resets may have changed the model; its arrays are shared.
        self.model = scene.model.clone();
        self.data.clone_from(&scene.data);
        self.fault = went.err().map(|error| error.to_string());
        self.running &= self.fault.is_none();
        self.follow();
    }

    /// Moves what is held without physics.
    fn place_held(&mut self, paused: bool) {
        let moved = self.hand.as_ref().is_some_and(|hand| hand.place(&self.model, &mut self.data, paused));
        if moved {
            self.settle();
        }
    }
}
