//! What panels remember beside the session.

use crate::signals::Signals;
use physics::model::ObjType;

/// What panels remember beside the session.
pub struct Desk {
    /// What is plotted.
    pub signals: Signals,
    /// What is watched.
    pub watched: Watched,
    /// What element is looked at.
    pub element: Element,
    /// The file that the next recording goes to; by default a new one in the folder.
    pub record_to: String,
    /// What was done last, for a person to read.
    pub notice: Option<String>,
}

/// A number by the name of its array.
pub struct Watched {
    /// The array.
    pub name: String,
    /// The place in it.
    pub index: usize,
}

/// An element that is looked at.
pub struct Element {
    /// Its kind.
    pub kind: ObjType,
    /// Its number.
    pub id: usize,
    /// The selected body that was followed here last.
    pub followed: Option<usize>,
}

impl Default for Desk {
    fn default() -> Self {
        Desk {
            signals: Signals::default(),
            watched: Watched { name: "qpos".into(), index: 0 },
            element: Element { kind: ObjType::Body, id: 0, followed: None },
            record_to: String::new(),
            notice: None,
        }
    }
}

impl Desk {
    /// Forgets what belongs to a model, when another is opened.
    pub fn forget(&mut self) {
        self.signals = Signals::default();
        self.element = Element { kind: ObjType::Body, id: 0, followed: None };
        self.notice = None;
    }
}
