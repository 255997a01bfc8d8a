//! The window's side: what a program orders is done to a session, and what a person does there is reported.

use super::PROTOCOL;
use super::client::greet;
use super::edits::{apply, changed_settings};
use super::message::{Grasp, Opening, Order, Report, TurnedSight};
use super::overlay::Place;
use super::post::{Orders, Post, listen};
use super::sight::Sight;
use super::state::StateCopy;
use super::wire::{WireError, receive, send};
use crate::hand::Grip;
use crate::session::Session;
use physics::binary::BinaryError;
use physics::model::EditError;
use physics::{Data, Model, StepError};
use std::fmt;
use std::io::{Read, Write};
use std::sync::Arc;

/// Why an order of the program cannot be done.
#[derive(Debug)]
#[non_exhaustive]
pub enum Refused {
    /// The model cannot be read.
    Model(BinaryError),
    /// A change does not fit the model.
    Edit(Box<EditError>),
    /// The state is one of another model.
    State,
    /// The state cannot be evaluated.
    Step(Box<StepError>),
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refused::Model(error) => write!(f, "the program's model: {error}"),
            Refused::Edit(error) => write!(f, "a change of the program's model: {error}"),
            Refused::State => f.write_str("the program's state is one of another model"),
            Refused::Step(error) => write!(f, "the program's state: {error}"),
        }
    }
}

impl std::error::Error for Refused {}

/// A way to the program whose window this is.
pub struct Link {
    orders: Arc<Post<Orders>>,
    to: Box<dyn Write + Send>,
    /// What the program knows.
    known: Option<Known>,
    turn: u64,
    place: Place,
}

/// What the program knows of a session.
struct Known {
    sight: Sight,
    grasp: Grasp,
    controls: Vec<f64>,
    equalities: Vec<bool>,
    model: Model,
}

impl Known {
    fn of(session: &Session) -> Self {
        let state = &session.data().state;
        Known {
            sight: sight(session),
            grasp: grasp(session),
            controls: state.ctrl.clone(),
            equalities: state.eq_active.clone(),
            model: session.model().clone(),
        }
    }
}

impl Link {
    /// Greets the program and waits for what its window is to open with; `None` where the program is gone. What comes
    /// later is read on a thread of its own, which calls `wake`.
    ///
    /// # Errors
    /// The program speaks another version, or nothing that is understood.
    pub fn meet(
        mut from: impl Read + Send + 'static,
        mut to: impl Write + Send + 'static,
        wake: impl Fn() + Send + 'static,
    ) -> Result<Option<(Link, Opening)>, WireError> {
        send(&PROTOCOL.to_owned(), &mut to)?;
        greet(&mut from)?;
        let opening = match receive(&mut from)? {
            Some(Order::Open(opening)) => *opening,
            Some(_) => return Err(WireError::Unknown("first order", 0)),
            None => return Ok(None),
        };
        let orders = listen(from, wake);
        let link = Link { orders, to: Box::new(to), known: None, turn: 0, place: Place::default() };
        Ok(Some((link, opening)))
    }

    /// The orders that have arrived since the last call.
    pub fn orders(&self) -> Orders {
        std::mem::take(&mut *self.orders.look())
    }

    /// Tells the program something. It may be gone; then the orders say so.
    pub fn tell(&mut self, report: &Report) {
        // Reading ends too when the program is gone.
        let _ = send(report, &mut self.to);
    }

    /// The session of an opening; `None` where it has no model.
    ///
    /// # Errors
    /// The model cannot be read, or its state not be evaluated.
    pub fn open(&mut self, opening: &Opening) -> Result<Option<Session>, Refused> {
        let Some(bytes) = &opening.model else { return Ok(None) };
        let model = Model::from_bytes(&bytes.0).map_err(Refused::Model)?;
        let mut data = Data::new(&model);
        if let Some(state) = &opening.state
            && !state.write(&mut data)
        {
            return Err(Refused::State);
        }
        let session =
            Session::in_state(model, data, opening.runs).map_err(|error| Refused::Step(Box::new(error)))?;
        self.known = Some(Known::of(&session));
        Ok(Some(session))
    }

    /// Does to a session what the program orders, and takes it out of `orders`.
    ///
    /// # Errors
    /// An order does not fit the session's model.
    pub fn follow(&mut self, session: &mut Session, orders: &mut Orders) -> Result<(), Refused> {
        if let Some(TurnedSight { turn, sight }) = orders.sight.take() {
            self.turn = turn;
            (session.camera, session.options) = (sight.camera, sight.options);
        }
        if let Some(items) = orders.items.take() {
            session.set_guests(items);
        }
        let (edits, state) = (std::mem::take(&mut orders.edits), orders.state.take());
        let done = if edits.is_empty() && state.is_none() {
            Ok(())
        } else {
            session.take_over(|model, data| {
                apply(model, &edits).map_err(|error| Refused::Edit(Box::new(error)))?;
                match state {
                    Some(state) if !state.write(data) => Err(Refused::State),
                    _ => Ok(()),
                }
            })
        };
        self.known = Some(Known::of(session));
        done
    }

    /// Reports what a person has done to a session since the last call.
    pub fn report(&mut self, session: &Session) {
        let now = Known::of(session);
        let Some(before) = self.known.replace(now) else { return };
        let Some(now) = &self.known else { return };
        let mut reports = Vec::new();
        if now.sight != before.sight {
            reports.push(Report::Sight(TurnedSight { turn: self.turn, sight: now.sight }));
        }
        if now.grasp != before.grasp {
            reports.push(Report::Grasp(now.grasp));
        }
        // What moves where time goes by is no doing of a person.
        if session.is_following() {
            let moved = differing(&before.controls, &now.controls);
            let switched = differing(&before.equalities, &now.equalities);
            if !moved.is_empty() {
                reports.push(Report::Controls(moved));
            }
            if !switched.is_empty() {
                reports.push(Report::Equalities(switched));
            }
        }
        let settings = changed_settings(&before.model, &now.model);
        if !settings.is_empty() {
            reports.push(Report::Settings(settings));
        }
        reports.iter().for_each(|report| self.tell(report));
    }

    /// Reports where the picture is, if it has moved.
    pub fn report_place(&mut self, place: Place) {
        if place != self.place {
            self.place = place;
            self.tell(&Report::Place(place));
        }
    }

    /// Takes leave: with the state of a session in which time went by.
    pub fn leave(&mut self, session: Option<&Session>) {
        let ran = session.filter(|session| !session.is_following());
        self.tell(&Report::Left(ran.map(|session| StateCopy::of(session.data()))));
    }
}

fn differing<T: Copy + PartialEq>(before: &[T], now: &[T]) -> Vec<(usize, T)> {
    let pairs = before.iter().zip(now).enumerate();
    pairs.filter(|(_, (before, now))| before != now).map(|(place, (_, now))| (place, *now)).collect()
}

fn sight(session: &Session) -> Sight {
    Sight { camera: session.camera, options: session.options }
}

fn grasp(session: &Session) -> Grasp {
    let Some(selected) = session.selected() else { return Grasp::default() };
    let chosen = Grasp { body: selected.body, point: selected.point, ..Grasp::default() };
    let Some(hand) = session.hand() else { return chosen };
    Grasp {
        pulls: hand.grip == Grip::Pull,
        turns: hand.grip == Grip::Turn,
        mass: hand.mass,
        reach: hand.reach,
        target: hand.target,
        origin: hand.origin,
        orientation: hand.orientation,
        ..chosen
    }
}
