//! Recorded episodes of an environment, trial by trial.

use crate::session::Session;
use dataset::trace::TraceReader;
use eframe::egui::{ComboBox, Ui};
use env::{Env, EnvError, Options, OwnModels};
use record::{Description, Trajectory};
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What makes an environment, or says why it cannot.
type Maker = dyn Fn(&Description) -> Result<Env, EnvError> + Send + Sync;

/// How the environment that a recording describes is made.
#[derive(Clone)]
pub struct Making(Arc<Maker>);

impl Making {
    /// Environments are made by `make`.
    pub fn by(make: impl Fn(&Description) -> Result<Env, EnvError> + Send + Sync + 'static) -> Self {
        Making(Arc::new(make))
    }
}

impl Default for Making {
    /// Environments on models of our own.
    fn default() -> Self {
        Making::by(|described| {
            let options =
                Options::default().with_compat(described.compat).with_changes(described.settings.clone());
            Env::make(&described.id, &OwnModels, &options)
        })
    }
}

impl fmt::Debug for Making {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Making")
    }
}

/// A recording of episodes, and the one that is shown.
pub(super) struct Episodes {
    trace: TraceReader,
    env: Env,
    shown: usize,
}

/// A recording of episodes that can be opened.
#[derive(Clone, Debug)]
pub struct Recording {
    /// The file: HDF5 in the layout of RoboHive or RoboSet, as `robohive run --record` writes it.
    pub path: PathBuf,
    /// The id of its environment, where it does not name it.
    pub environment: Option<String>,
    /// What makes its environment.
    pub making: Making,
}

impl Recording {
    /// A session that shows the first episode.
    pub(super) fn start(&self) -> Result<(Session, Episodes), String> {
        let trace = TraceReader::open(&self.path).map_err(|error| error.to_string())?;
        let described =
            Description::of(&trace, self.environment.as_deref()).map_err(|error| error.to_string())?;
        let env = (self.making.0)(&described).map_err(|error| error.to_string())?;
        if trace.trials().is_empty() {
            return Err(format!("{} has no episodes", self.path.display()));
        }
        let mut episodes = Episodes { trace, env, shown: 0 };
        let session = episodes.session(0)?;
        Ok((session, episodes))
    }
}

impl Episodes {
    /// Names of all trials.
    pub(super) fn trials(&self) -> &[String] {
        self.trace.trials()
    }

    /// Which of them is shown.
    pub(super) fn shown(&self) -> usize {
        self.shown
    }

    /// A session that shows a trial. Its model is the trial's own: resets change models.
    pub(super) fn session(&mut self, trial: usize) -> Result<Session, String> {
        let name = self.trace.trials()[trial].clone();
        let trajectory =
            Trajectory::of_trial(&self.trace, &name, &mut self.env).map_err(|error| error.to_string())?;
        let mut session = Session::new(self.env.scene().model.clone()).map_err(|error| error.to_string())?;
        session.set_replay(Some(trajectory)).map_err(|error| error.to_string())?;
        self.shown = trial;
        Ok(session)
    }
}

/// The trajectory in a numpy archive, of the model of a session.
pub(super) fn trajectory(path: &Path, session: &Session) -> Result<Trajectory, String> {
    let archive = dataset::NpzReader::open(path).map_err(|error| error.to_string())?;
    Trajectory::of_archive(&path.display().to_string(), &archive, session.model())
        .map_err(|error| error.to_string())
}

/// The episodes of a recording, one of which is shown. The error says why another one is not.
pub(super) fn trials_panel(
    ui: &mut Ui,
    session: &mut Session,
    episodes: &mut Episodes,
) -> Result<(), String> {
    let mut chosen = episodes.shown();
    let names = episodes.trials();
    ComboBox::from_label("Episode").selected_text(&names[chosen]).show_ui(ui, |ui| {
        for (trial, name) in names.iter().enumerate() {
            ui.selectable_value(&mut chosen, trial, name);
        }
    });
    if chosen != episodes.shown() {
        let (camera, options) = (session.camera, session.options);
        *session = episodes.session(chosen)?;
        (session.camera, session.options) = (camera, options);
    }
    Ok(())
}
