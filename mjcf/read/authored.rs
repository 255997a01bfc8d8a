//! Which settings the text of a model gives, as opposed to those left at their defaults.

use std::collections::BTreeSet;

use physics::model::{Disable, Enable, Options};

use crate::schema::Bind;
use crate::schema::option::FLAGS;
use crate::xml::Element;

/// Settings that the text of a model gives.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Authored {
    /// Attributes of `compiler`, `option` and the parts of `visual`: name of the element, name of the attribute.
    pub values: BTreeSet<(String, String)>,
    /// Flags of `option/flag` that disable something.
    pub disableflags: Disable,
    /// Flags of `option/flag` that enable something.
    pub enableflags: Enable,
    /// Actuator groups, one bit each.
    pub disableactuator: i32,
}

impl Authored {
    /// The text gives this attribute of `option` or of a part of `visual`.
    pub(crate) fn gives(&self, name: &str) -> bool {
        self.values.iter().any(|(element, attribute)| attribute == name && element != "compiler")
    }

    /// Notes the attributes of an element.
    pub(crate) fn attributes(&mut self, element: &Element) {
        self.values.extend(element.attributes.iter().map(|a| (element.name.clone(), a.name.clone())));
    }

    /// Notes the attributes of `option/flag`.
    pub(crate) fn flags(&mut self, flag: &Element) {
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
