//! What has changed in a model between two looks at it.

use super::numbers::Numbers;
use super::wire::record;
use crate::settings;
use physics::Model;
use physics::model::{Arrays, EditError};
use physics::table::Slice;

/// A changed array or setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Edit {
    /// Group of a setting, one of [`settings::GROUPS`]; empty for an array.
    pub group: String,
    /// Name of the array or setting.
    pub name: String,
    /// What it holds now.
    pub numbers: Numbers,
}

record!(Edit { group, name, numbers });

/// Settings that differ from those of `old`.
pub fn changed_settings(old: &Arrays, new: &Arrays) -> Vec<Edit> {
    let mut changed = Vec::new();
    for group in settings::GROUPS {
        let mut before = Vec::new();
        settings::visit(old, group, &mut |_, slice| before.push(Numbers::from(slice)));
        let mut rows = before.iter();
        settings::visit(new, group, &mut |name, slice| {
            if rows.next().is_none_or(|row| row.slice() != slice) {
                changed.push(Edit { group: group.to_owned(), name: name.to_owned(), numbers: slice.into() });
            }
        });
    }
    changed
}

/// Arrays and settings that differ from those of `old`, a model of the same sizes. Arrays that both models share are not
/// looked at.
pub fn changes(old: &Arrays, new: &Arrays) -> Vec<Edit> {
    let mut changed = changed_settings(old, new);
    let mut number = 0;
    new.visit(&mut |name, _, slice| {
        let before = old.array(number);
        number += 1;
        if before.is_none_or(|before| !same_memory(before, slice) && before != slice) {
            changed.push(Edit { group: String::new(), name: name.to_owned(), numbers: slice.into() });
        }
    });
    changed
}

fn same_memory(a: Slice<'_>, b: Slice<'_>) -> bool {
    match (a, b) {
        (Slice::Bool(a), Slice::Bool(b)) => std::ptr::eq(a, b),
        (Slice::U8(a), Slice::U8(b)) => std::ptr::eq(a, b),
        (Slice::I32(a), Slice::I32(b)) => std::ptr::eq(a, b),
        (Slice::I64(a), Slice::I64(b)) => std::ptr::eq(a, b),
        (Slice::F32(a), Slice::F32(b)) => std::ptr::eq(a, b),
        (Slice::F64(a), Slice::F64(b)) => std::ptr::eq(a, b),
        _ => false,
    }
}

/// Writes changes into a model; names that it does not have are left out.
///
/// # Errors
/// A change does not fit the model, which stays as it was.
pub fn apply(model: &mut Model, edits: &[Edit]) -> Result<(), EditError> {
    model.overwrite(|draft| {
        for Edit { group, name, numbers } in edits {
            let values = numbers.slice().to_f64();
            if group.is_empty() {
                draft.assign(name, &values);
            } else {
                settings::assign(draft, group, name, &values);
            }
        }
    })
}
