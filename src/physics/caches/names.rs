//! Ids by name, in hash tables.

use crate::arrays::{Arrays, ObjType};
use std::collections::HashMap;
use std::sync::OnceLock;

/// Ids by name, a table for each kind of element, made when a name of that kind is first looked up.
#[derive(Clone, Debug, Default)]
pub(crate) struct NameIndex {
    /// In the order of the codes of [`ObjType`].
    tables: [OnceLock<HashMap<Box<str>, u32>>; KINDS],
}

/// Codes of named kinds are below this.
const KINDS: usize = ObjType::Plugin.code() as usize + 1;

impl NameIndex {
    /// Id of the element called `name`; of several, the first.
    pub fn get(&self, m: &Arrays, kind: ObjType, name: &str) -> Option<usize> {
        let table = self.tables.get(kind.code() as usize)?.get_or_init(|| {
            let mut table = HashMap::new();
            for id in 0..m.name_addresses(kind).len() {
                let name = m.name_of(kind, id);
                if !name.is_empty() {
                    table.entry(name.into()).or_insert(id as u32);
                }
            }
            table
        });
        table.get(name).map(|&id| id as usize)
    }
}
