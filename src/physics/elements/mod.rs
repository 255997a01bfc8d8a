//! Elements of a model by name: typed ids, and views of what the model says of an element and of what a simulation
//! makes of it.
//!
//! A name is looked up once, in the model; the id it yields holds all addresses of the element, so that
//! [`Data`](crate::Data), which does not know its model, can be read and written with it at the cost of an index:
//!
//! | call | result |
//! |---|---|
//! | `m.joint("elbow")` | `Option<JointId>`, by a hash table |
//! | `m.joint(id)` | what the model says: `.name()`, `.range()`, `.body()` |
//! | `m.joints()`, `m.joint_names()` | all of them |
//! | `d.joint(id)` | what a simulation says: `.qpos()`, `.qvel()` |
//! | `d.joint_mut(id)` | the same to write: `.set_qpos(…)` |
//!
//! An id also indexes the arrays of its kind: `m.jnt_range[id]`, and to write, `m.edit(|m| m.jnt_range[id] = [0.0, 1.0])`.
//!
//! The same holds for bodies, geoms, sites, cameras, lights, tendons, actuators, sensors and equality constraints;
//! meshes, textures and the like have ids and names. An id belongs to its model and to models edited from it. With that
//! of another model a view shows another element, or panics where there is none.
//!
//! ```
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><body name='arm'><joint name='elbow' axis='0 1 0'/>
//!        <geom type='capsule' fromto='0 0 0 .3 0 0' size='.02'/></body></worldbody>
//!      <actuator><motor name='pull' joint='elbow'/></actuator></mujoco>",
//! )?
//! .model;
//! let elbow = model.joint("elbow").ok_or("no elbow")?;
//! let pull = model.actuator("pull").ok_or("no pull")?;
//! assert!(model.joint("knee").is_none());
//! assert_eq!(model.joint(elbow).body(), model.body("arm").unwrap());
//!
//! let mut data = robohive_physics::Data::new(&model);
//! data.actuator_mut(pull).set_ctrl(2.0);
//! robohive_physics::step(&model, &mut data)?;
//! assert!(data.joint(elbow).qvel()[0] > 0.0);
//! assert_eq!(data.actuator(pull).force(), [2.0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod contact;
mod data;
mod ids;
mod model;
mod query;

pub use contact::ContactView;
pub use data::{DataView, DataViewMut, MocapPose};
pub use ids::*;
pub use model::ModelView;

use crate::model::{Arrays, Model, ObjType};
use std::ops::Range;

/// An id of one kind of element.
pub trait Element: Copy {
    /// The kind.
    const KIND: ObjType;
    /// Number of such elements in a model.
    fn count(m: &Arrays) -> usize;
    /// The element at `index` in the arrays of its kind, which must exist.
    fn of(m: &Arrays, index: usize) -> Self;
    /// Place in the arrays of its kind.
    fn index(self) -> usize;
    /// The element at `index` in the arrays of its kind; `None` beyond the last.
    fn at(m: &Arrays, index: usize) -> Option<Self> {
        (index < Self::count(m)).then(|| Self::of(m, index))
    }
}

/// What finds elements of one kind in a model: a name an id, an id a view.
pub trait Key<'m, I> {
    /// What is found.
    type Found;
    /// Finds it.
    fn find_in(self, m: &'m Model) -> Self::Found;
}

impl<'m, I: Element> Key<'m, I> for &str {
    type Found = Option<I>;

    fn find_in(self, m: &'m Model) -> Option<I> {
        Some(I::of(m, m.id_of(I::KIND, self)?))
    }
}

impl<'m, I: Element> Key<'m, I> for &String {
    type Found = Option<I>;

    fn find_in(self, m: &'m Model) -> Option<I> {
        self.as_str().find_in(m)
    }
}

impl<'m, I: Element> Key<'m, I> for I {
    type Found = ModelView<'m, I>;

    fn find_in(self, m: &'m Model) -> ModelView<'m, I> {
        ModelView::new(m, self)
    }
}

/// Where the numbers of an element stand in an array.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
struct Span {
    start: u32,
    len: u32,
}

impl Span {
    /// `len` numbers from an address, -1 for none.
    fn new(start: i32, len: i32) -> Self {
        Span { start: start.max(0) as u32, len: len.max(0) as u32 }
    }

    fn range(self) -> Range<usize> {
        self.start as usize..(self.start + self.len) as usize
    }
}
