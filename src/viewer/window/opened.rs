//! A model that is open.

use super::episodes::Episodes;
use super::screen::Screen;
use super::source::Source;
use crate::session::Session;
use std::time::{Duration, SystemTime};
use web_time::Instant;

/// How often files are looked at for changes.
const LOOK: Duration = Duration::from_millis(500);

/// A session and its picture, and where they came from.
pub struct Opened {
    /// The simulation.
    pub session: Session,
    /// Its picture.
    pub screen: Screen,
    /// Its model's file.
    pub source: Source,
    /// Models that lie beside it in the same files.
    pub siblings: Vec<Source>,
    /// The recording whose episodes are shown.
    pub(super) episodes: Option<Box<Episodes>>,
    /// What was ignored or assumed when the model was read.
    pub warnings: String,
    changed: Option<SystemTime>,
    looked: Instant,
}

impl Opened {
    /// Opens a model.
    ///
    /// # Errors
    /// It cannot be read, evaluated or drawn.
    pub(super) fn open(source: Source) -> Result<Self, String> {
        let changed = source.changed();
        let (session, warnings, episodes) = match &source {
            Source::Episodes(recording) => {
                let (session, episodes) = recording.start()?;
                (session, String::new(), Some(Box::new(episodes)))
            }
            _ => {
                let (session, warnings) = source.start()?;
                (session, warnings, None)
            }
        };
        Ok(Opened { episodes, changed, ..Opened::with(source, session, warnings)? })
    }

    /// Shows a session, which `source` would make again.
    ///
    /// # Errors
    /// It cannot be drawn.
    pub(super) fn with(source: Source, session: Session, warnings: String) -> Result<Self, String> {
        let screen = Screen::new(session.model()).map_err(|error| error.to_string())?;
        let (changed, siblings) = (source.changed(), source.siblings());
        let looked = Instant::now();
        Ok(Opened { session, screen, source, siblings, episodes: None, warnings, changed, looked })
    }

    /// A session that a program has asked for.
    ///
    /// # Errors
    /// Its model cannot be drawn.
    pub(super) fn of_program(session: Session, title: &str) -> Result<Self, String> {
        let screen = Screen::new(session.model()).map_err(|error| error.to_string())?;
        let source = Source::Program(title.to_owned());
        Ok(Opened {
            session,
            screen,
            source,
            siblings: Vec::new(),
            episodes: None,
            warnings: String::new(),
            changed: None,
            looked: Instant::now(),
        })
    }

    /// Whether a program has sent the model.
    pub(super) fn is_a_programs(&self) -> bool {
        matches!(self.source, Source::Program(_))
    }

    /// Reads the model again, in the state that it is in; an environment begins anew.
    ///
    /// # Errors
    /// As [`Opened::open`]; the model stays the former one.
    pub(super) fn reload(&mut self) -> Result<(), String> {
        self.changed = self.source.changed();
        if self.session.play().is_some() || self.episodes.is_some() {
            *self = Opened::open(self.source.clone())?;
            return Ok(());
        }
        let loaded = self.source.load()?;
        let mut screen = Screen::new(&loaded.model).map_err(|error| error.to_string())?;
        screen.channel = self.screen.channel;
        self.session.replace(loaded.model).map_err(|error| error.to_string())?;
        (self.screen, self.warnings) = (screen, loaded.warnings.to_string());
        Ok(())
    }

    /// Whether its file was changed since it was read, looked up twice a second.
    pub fn is_outdated(&mut self) -> bool {
        if self.looked.elapsed() < LOOK {
            return false;
        }
        self.looked = Instant::now();
        self.source.changed().is_some_and(|now| self.changed.is_some_and(|then| now != then))
    }
}
