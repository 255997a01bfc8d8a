//! What a program and its window say to each other.

use super::edits::Edit;
use super::overlay::{Bytes, Figure, Image, Place, Text};
use super::sight::Sight;
use super::state::StateCopy;
use super::wire::{Wire, WireError, cases, record};
use physics::math::{Quat, Vec3};
use render::scene::Item;

/// What a window opens with.
#[derive(Clone, Debug, Default)]
pub struct Opening {
    /// What its title says.
    pub title: String,
    /// Whether the left panel is shown.
    pub left: bool,
    /// Whether the right panel is shown.
    pub right: bool,
    /// Whether keys do what they do in MuJoCo's viewer; else the program alone hears of them.
    pub keys: bool,
    /// Whether time goes by in the window, rather than in the program.
    pub runs: bool,
    /// The model; a window without one waits for a file.
    pub model: Option<Bytes>,
    /// Its state.
    pub state: Option<StateCopy>,
    /// The file that is opened where there is no model.
    pub file: Option<String>,
}

record!(Opening { title, left, right, keys, runs, model, state, file });

/// A sight with the number of the program's last word on it that the window had heard.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnedSight {
    /// The number.
    pub turn: u64,
    /// The sight.
    pub sight: Sight,
}

record!(TurnedSight { turn, sight });

/// What a program tells its window.
#[derive(Clone, Debug)]
pub enum Order {
    /// Another model, or the first.
    Open(Box<Opening>),
    /// Arrays and settings of the model that have changed.
    Edits(Vec<Edit>),
    /// The present state.
    State(StateCopy),
    /// What it is seen with.
    Sight(Box<TurnedSight>),
    /// Items that the program adds to the scene, in place of the former.
    Items(Vec<Item>),
    /// Figures over the picture, in place of the former.
    Figures(Vec<Figure>),
    /// Texts over the picture, in place of the former.
    Texts(Vec<Text>),
    /// Images over the picture, in place of the former.
    Images(Vec<Image>),
    /// A message to show, such as why a model could not be read again.
    Trouble(String),
    /// The window is to close.
    Close,
}

cases!(Order {
    0 => Open(opening),
    1 => Edits(edits),
    2 => State(state),
    3 => Sight(sight),
    4 => Items(items),
    5 => Figures(figures),
    6 => Texts(texts),
    7 => Images(images),
    8 => Trouble(text),
    9 => Close,
});

/// A body that a person has selected, and the hand that pulls it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Grasp {
    /// The body; the world for none.
    pub body: usize,
    /// The selected point, body frame \[m\].
    pub point: Vec3,
    /// The point is pulled.
    pub pulls: bool,
    /// The body is turned.
    pub turns: bool,
    /// Mass that the point seems to have \[kg\].
    pub mass: f64,
    /// Metres for a drag over the height of the picture.
    pub reach: f64,
    /// Where the point is wanted, world frame \[m\].
    pub target: Vec3,
    /// Where the body's centre of mass is wanted, world frame \[m\].
    pub origin: Vec3,
    /// Orientation that is wanted of the frame of the body's inertia.
    pub orientation: Quat,
}

record!(Grasp { body, point, pulls, turns, mass, reach, target, origin, orientation });

/// What a window tells its program.
#[derive(Clone, Debug)]
pub enum Report {
    /// It is open.
    Ready,
    /// It cannot open.
    Failed(String),
    /// A person has moved the camera or changed what is shown.
    Sight(TurnedSight),
    /// A person has selected or pulled a body, or has let go.
    Grasp(Grasp),
    /// Controls that a person has moved, by their numbers.
    Controls(Vec<(usize, f64)>),
    /// Equality constraints that a person has switched, by their numbers.
    Equalities(Vec<(usize, bool)>),
    /// Options of the physics and visual settings that a person has changed.
    Settings(Vec<Edit>),
    /// A key was pressed, by GLFW's number.
    Key(i32),
    /// Where in the window the picture is.
    Place(Place),
    /// A person asks for the model to be read again.
    Reload,
    /// It closes; with the last state where time went by in it.
    Left(Option<StateCopy>),
}

cases!(Report {
    0 => Ready,
    1 => Failed(why),
    2 => Sight(sight),
    3 => Grasp(grasp),
    4 => Controls(moved),
    5 => Equalities(switched),
    6 => Settings(edits),
    7 => Key(key),
    8 => Place(place),
    9 => Reload,
    10 => Left(state),
});

impl<T: Wire> Wire for Box<T> {
    fn put(&self, out: &mut Vec<u8>) {
        (**self).put(out);
    }

    fn take(from: &mut &[u8]) -> Result<Self, WireError> {
        T::take(from).map(Box::new)
    }
}

impl<A: Wire, B: Wire> Wire for (A, B) {
    fn put(&self, out: &mut Vec<u8>) {
        self.0.put(out);
        self.1.put(out);
    }

    fn take(from: &mut &[u8]) -> Result<Self, WireError> {
        Ok((A::take(from)?, B::take(from)?))
    }
}
