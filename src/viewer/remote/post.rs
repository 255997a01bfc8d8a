//! What has arrived and was not looked at yet. The latest word of each kind is kept, so that a side that is slow or stopped
//! holds a bounded amount.

use super::edits::Edit;
use super::message::{Grasp, Opening, Order, Report, TurnedSight};
use super::overlay::{Figure, Image, Place, Text};
use super::state::StateCopy;
use super::wire::{Wire, receive};
use render::scene::Item;
use std::collections::BTreeMap;
use std::io::Read;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Most keys that are kept for a program that does not look; those after are dropped.
const KEYS: usize = 1000;

/// What messages of type `M` add up to.
pub trait Gather<M>: Default + Send + 'static {
    /// Takes a message in.
    fn add(&mut self, message: M);

    /// Nothing will come any more: the other side has closed its end, or what it says makes no sense.
    fn end(&mut self, why: Option<String>);
}

/// A box into which a thread puts what arrives.
#[derive(Debug, Default)]
pub struct Post<B> {
    held: Mutex<B>,
    arrived: Condvar,
}

impl<B> Post<B> {
    /// What has arrived.
    pub fn look(&self) -> MutexGuard<'_, B> {
        self.held.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until `ready` says so of what has arrived, at most `patience`. Returns what has arrived by then.
    pub fn wait(&self, patience: Duration, ready: impl Fn(&B) -> bool) -> MutexGuard<'_, B> {
        let until = Instant::now() + patience;
        let mut held = self.look();
        while !ready(&held) {
            let left = until.saturating_duration_since(Instant::now());
            if left.is_zero() {
                break;
            }
            held = self.arrived.wait_timeout(held, left).unwrap_or_else(PoisonError::into_inner).0;
        }
        held
    }
}

/// Puts all that arrives into a box, on a thread of its own, and calls `wake` after each message.
pub fn listen<M: Wire, B: Gather<M>>(
    mut from: impl Read + Send + 'static,
    wake: impl Fn() + Send + 'static,
) -> Arc<Post<B>> {
    let post = Arc::new(Post::<B>::default());
    let inside = Arc::clone(&post);
    std::thread::spawn(move || {
        loop {
            let ended = match receive(&mut from) {
                Ok(Some(message)) => {
                    inside.look().add(message);
                    false
                }
                Ok(None) => {
                    inside.look().end(None);
                    true
                }
                Err(error) => {
                    inside.look().end(Some(error.to_string()));
                    true
                }
            };
            inside.arrived.notify_all();
            wake();
            if ended {
                break;
            }
        }
    });
    post
}

/// What a program has told and its window has not yet done.
#[derive(Debug, Default)]
pub struct Orders {
    /// Another model. What follows is of it.
    pub open: Option<Box<Opening>>,
    /// Changes of the model.
    pub edits: Vec<Edit>,
    /// The state.
    pub state: Option<StateCopy>,
    /// Camera and options.
    pub sight: Option<TurnedSight>,
    /// Items of the program's own.
    pub items: Option<Vec<Item>>,
    /// Figures.
    pub figures: Option<Vec<Figure>>,
    /// Texts.
    pub texts: Option<Vec<Text>>,
    /// Images.
    pub images: Option<Vec<Image>>,
    /// A message.
    pub trouble: Option<String>,
    /// The window is to close.
    pub close: bool,
}

impl Gather<Order> for Orders {
    fn add(&mut self, order: Order) {
        match order {
            Order::Open(opening) => {
                (self.edits, self.state) = (Vec::new(), None);
                self.open = Some(opening);
            }
            Order::Edits(edits) => replace(&mut self.edits, edits),
            Order::State(state) => self.state = Some(state),
            Order::Sight(sight) => self.sight = Some(*sight),
            Order::Items(items) => self.items = Some(items),
            Order::Figures(figures) => self.figures = Some(figures),
            Order::Texts(texts) => self.texts = Some(texts),
            Order::Images(images) => self.images = Some(images),
            Order::Trouble(text) => self.trouble = Some(text),
            Order::Close => self.close = true,
        }
    }

    fn end(&mut self, why: Option<String>) {
        self.close = true;
        if why.is_some() {
            self.trouble = why;
        }
    }
}

/// What a window has told and its program has not yet looked at.
#[derive(Debug, Default)]
pub struct Reports {
    /// It has opened.
    pub ready: bool,
    /// Why it cannot open, or was lost.
    pub failed: Option<String>,
    /// Camera and options.
    pub sight: Option<TurnedSight>,
    /// The selection and the hand.
    pub grasp: Option<Grasp>,
    /// Controls.
    pub controls: BTreeMap<usize, f64>,
    /// Equality constraints.
    pub equalities: BTreeMap<usize, bool>,
    /// Options and visual settings.
    pub settings: Vec<Edit>,
    /// Keys, in the order in which they were pressed.
    pub keys: Vec<i32>,
    /// Where the picture is.
    pub place: Option<Place>,
    /// The model is to be read again.
    pub reload: bool,
    /// The last state of what ran in the window.
    pub last: Option<StateCopy>,
    /// A person has closed the window, or its program asked for it.
    pub left: bool,
    /// Nothing comes any more.
    pub over: bool,
}

impl Gather<Report> for Reports {
    fn add(&mut self, report: Report) {
        match report {
            Report::Ready => self.ready = true,
            Report::Failed(why) => self.failed = Some(why),
            Report::Sight(sight) => self.sight = Some(sight),
            Report::Grasp(grasp) => self.grasp = Some(grasp),
            Report::Controls(moved) => self.controls.extend(moved),
            Report::Equalities(switched) => self.equalities.extend(switched),
            Report::Settings(edits) => replace(&mut self.settings, edits),
            Report::Key(key) if self.keys.len() < KEYS => self.keys.push(key),
            Report::Key(_) => {}
            Report::Place(place) => self.place = Some(place),
            Report::Reload => self.reload = true,
            Report::Left(state) => (self.left, self.last) = (true, state),
        }
    }

    fn end(&mut self, why: Option<String>) {
        self.over = true;
        if why.is_some() && !self.left {
            self.failed = why;
        }
    }
}

/// Adds edits to those that are there, of which they replace what they write again.
fn replace(all: &mut Vec<Edit>, edits: Vec<Edit>) {
    for edit in edits {
        match all.iter_mut().find(|known| known.group == edit.group && known.name == edit.name) {
            Some(known) => *known = edit,
            None => all.push(edit),
        }
    }
}
