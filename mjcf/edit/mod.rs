//! Programs that edit a [`Spec`]: find elements by name, add, set, rename, remove, attach, detach and scale them, compile
//! again, and carry the state over.
//!
//! Fields of elements may be written directly; what follows keeps the model whole. Additions are read like a text, with
//! the schema's checks and suggestions; names stay unique, references follow what they name, and keyframes keep the numbers
//! of the elements that remain. An edit that is refused changes nothing.
//!
//! ```
//! # use physics as robohive_physics;
//! use robohive_mjcf::{edit, files::Memory, parse_str};
//! use robohive_physics::{Data, model::ObjType};
//!
//! let text = "<mujoco><worldbody><body name='arm'><joint name='hinge'/><geom name='rod' size='.1'/></body></worldbody></mujoco>";
//! let parsed = parse_str(text)?;
//! let mut spec = parsed.spec;
//! let before = spec.compile(&Memory::default(), &parsed.sources)?.model;
//! let mut data = Data::new(&before);
//! data.state.qpos[0] = 0.3;
//!
//! spec.add("arm", "<body name='hand' pos='0 0 1'><joint name='wrist'/><geom size='.05'/></body>")?;
//! spec.set(ObjType::Geom, "rod", "rgba", "1 0 0 1")?;
//! spec.extend("<actuator><position joint='hinge' kp='10'/></actuator>")?;
//! spec.rename(ObjType::Joint, "hinge", "shoulder")?;
//! let after = spec.compile(&Memory::default(), &parsed.sources)?.model;
//! let data = edit::carry_state(&before, &data, &after);
//! // The renamed joint is another one; names are what states are carried by.
//! assert_eq!(&data.state.qpos[..], &[0.0, 0.0]);
//!
//! let wrong = spec.set(ObjType::Geom, "rod", "rgb", "1 0 0").unwrap_err();
//! assert!(wrong.to_string().contains("did you mean 'rgba'?"));
//! # Ok::<(), robohive_mjcf::diagnostic::Diagnostics>(())
//! ```

mod add;
mod attach;
mod carry;
mod conflict;
mod find;
mod locs;
mod piece;
mod references;
mod remove;
mod rename;
mod scale;
mod shortcut;
mod spaces;

pub use crate::read::Authored;
pub use carry::carry_state;
pub use conflict::settle;
pub use shortcut::set_shortcut;

use crate::budget::Budget;
use crate::diagnostic::{Diagnostics, Sources};
use crate::files::Memory;
use crate::include::Expansion;
use crate::read::Reader;
use crate::spec::Spec;
use crate::xml::{Element, Limits};

/// Reads pieces of a model into `spec`; what is wrong comes back, and then what was read is void.
fn reading<R>(
    spec: Spec,
    mut sources: Sources,
    read: impl FnOnce(&mut Reader<'_>) -> R,
) -> Result<(R, Spec), Diagnostics> {
    let (limits, files) = (Limits::default(), Memory::default());
    let (mut budget, mut diagnostics) = (Budget::new(limits.memory), Diagnostics::default());
    let expansion = Expansion {
        files: &files,
        substitutions: &[],
        matched: &mut [],
        whole: false,
        limits: &limits,
        budget: &mut budget,
        sources: &mut sources,
        diagnostics: &mut diagnostics,
    };
    let mut reader = Reader::new(&Element::default(), expansion, Vec::new());
    reader.spec = spec;
    let result = read(&mut reader);
    let spec = std::mem::take(&mut reader.spec);
    if diagnostics.has_errors() { Err(diagnostics) } else { Ok((result, spec)) }
}

/// Gives the numbers of all keyframes to the elements that they belong to, where edits of the tree leave them: see
/// [`Spec::kept_keys`] and [`Spec::settle_keys`].
///
/// # Errors
/// A keyframe has more numbers than the elements take.
pub fn spread_keys(spec: &mut Spec) -> Result<(), Diagnostics> {
    spec.spread_keys()
}

fn refuse<T>(message: impl Into<String>) -> Result<T, Diagnostics> {
    Err(Diagnostics::of_error(message))
}
