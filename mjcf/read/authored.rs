//! Which settings the text of a model gives, as opposed to those left at their defaults.

use std::collections::BTreeSet;

use physics::model::{Disable, Enable, Options};

use crate::schema::Bind;
use crate::schema::option::FLAGS;
use crate::xml::Element;

/// Settings that the text of a model gives.
#[derive(Debug, Default)]
pub(crate) struct Authored {
    /// Attributes of `option` and of the parts of `visual`.
    pub values: BTreeSet<String>,
    /// Flags of `option/flag` that disable something.
    pub disableflags: Disable,
    /// Flags of `option/flag` that enable something.
    pub enableflags: Enable,
    /// Actuator groups.
    pub disableactuator: i32,
}

impl Authored {
    /// Notes the attributes of `option/flag`.
    pub fn flags(&mut self, flag: &Element) {
        for row in FLAGS.iter().filter(|row| flag.attribute(row.name).is_some()) {
            if let Bind::Keyword { assign, .. } = row.bind {
                let (mut off, mut on) = (Options::default(), Options::default());
                assign(&mut off, 0);
                assign(&mut on, 1);
                self.disableflags |= off.disableflags ^ on.disableflags;
                self.enableflags |= off.enableflags ^ on.enableflags;
            }
        }
    }
}
