//! What the window does beside showing a session: files that it opens and writes, videos, and actions that a person steers.

use super::app::App;
use super::episodes::{Recording, trajectory};
use super::exports::Export;
use super::film::Film;
use super::source::{Source, dropped};
use eframe::egui::Context;
use std::path::Path;

/// Trajectories and recordings of episodes by the endings of their files.
const TRAJECTORIES: [&str; 1] = ["npz"];
const EPISODES: [&str; 2] = ["h5", "hdf5"];

impl App {
    /// Opens what a path leads to: a trajectory of the open model, recorded episodes, a model, or a folder or archive with one. In the
    /// window of a program that simulates, nothing.
    pub(super) fn open_path(&mut self, path: &Path) {
        if self.opened.as_ref().is_some_and(|opened| opened.session.is_following()) {
            self.trouble = Some(format!("{}: this window shows what a program simulates", path.display()));
            return;
        }
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_lowercase();
        if TRAJECTORIES.contains(&ending.as_str()) {
            self.trouble = self.show_trajectory(path).err();
        } else if EPISODES.contains(&ending.as_str()) {
            let making = self.making.clone();
            self.open(Source::Episodes(Recording { path: path.to_owned(), environment: None, making }));
        } else {
            match dropped(path) {
                Ok(source) => self.open(source),
                Err(why) => self.trouble = Some(why),
            }
        }
    }

    /// Replays a trajectory of the open model; the second one is shown beside the first.
    fn show_trajectory(&mut self, path: &Path) -> Result<(), String> {
        let Some(opened) = &mut self.opened else {
            return Err(format!("{}: open the model first whose states these are", path.display()));
        };
        let session = &mut opened.session;
        let states = trajectory(path, session)?;
        session.add_trajectory(states).map_err(|error| error.to_string())
    }

    /// Writes what a menu offers.
    pub(super) fn export(&mut self, export: &Export) {
        let Some(opened) = &self.opened else { return };
        let contents = (export.contents)(&opened.source, &opened.session);
        let written =
            contents.and_then(|bytes| (self.save)(export.file, &bytes).map_err(|error| error.to_string()));
        match written {
            Ok(place) => self.desk.notice = Some(format!("written {place}")),
            Err(why) => self.trouble = Some(why),
        }
    }

    /// Begins a video of what is shown, or completes the one that was begun.
    pub(super) fn film(&mut self) {
        let Some(opened) = &self.opened else { return };
        if self.film.is_some() {
            return self.end_film();
        }
        match Film::begin_new(&opened.session) {
            Ok(film) => self.film = Some(film),
            Err(why) => self.trouble = Some(why),
        }
    }

    /// Completes the video that was begun: it is of the model that is open.
    pub(super) fn end_film(&mut self) {
        match self.film.take().map(Film::finish) {
            Some(Ok(written)) => self.desk.notice = Some(format!("written {written}")),
            Some(Err(why)) => self.trouble = Some(why),
            None => {}
        }
    }

    /// After time went by: the video gets its frames.
    pub(super) fn film_on(&mut self) {
        let (Some(opened), Some(film)) = (&self.opened, &mut self.film) else { return };
        if let Err(why) = film.show(&opened.session) {
            (self.film, self.trouble) = (None, Some(why));
        }
    }

    /// Before time goes by: keys and gamepad move the action.
    pub(super) fn steer(&mut self, context: &Context, seconds: f64) {
        let Some(opened) = &mut self.opened else { return };
        if let Err(why) = self.steering.steer(context, &mut opened.session, seconds) {
            self.trouble = Some(why);
        }
    }
}
