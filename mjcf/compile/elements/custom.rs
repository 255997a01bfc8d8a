//! Custom numbers, texts and tuples.

use crate::compile::log::{Log, title};
use crate::compile::lookup::Lookup;
use crate::compile::values::bounded;
use crate::spec::Spec;
use physics::model::Rows;

/// Appends all custom data.
pub(super) fn fill(m: &mut Rows, spec: &Spec, lookup: &Lookup, log: &mut Log) {
    for numeric in &spec.numerics {
        let what = title("numeric", &numeric.name);
        let size =
            if numeric.size == 0 { Ok(numeric.data.len()) } else { bounded(numeric.size.into(), "size") };
        let Some(size) = log.check(numeric.loc, &what, size) else { continue };
        if size == 0 || size < numeric.data.len() {
            log.error(
                numeric.loc,
                format!("{}: size is smaller than the data", title("numeric", &numeric.name)),
            );
        }
        m.numeric_adr.push(m.numeric_data.len() as i32);
        m.numeric_size.push(size as i32);
        m.numeric_data.extend(numeric.data.iter().copied().chain(std::iter::repeat(0.0)).take(size));
    }
    for text in &spec.texts {
        if text.data.is_empty() {
            log.error(text.loc, format!("{}: empty text", title("text", &text.name)));
        }
        m.text_adr.push(m.text_data.len() as i32);
        m.text_size.push(text.data.len() as i32 + 1);
        m.text_data.extend(text.data.bytes());
        m.text_data.push(0);
    }
    for tuple in &spec.tuples {
        let what = title("tuple", &tuple.name);
        if tuple.entries.is_empty() {
            log.error(tuple.loc, format!("{what}: no entries"));
        }
        m.tuple_adr.push(m.tuple_objtype.len() as i32);
        m.tuple_size.push(tuple.entries.len() as i32);
        for entry in &tuple.entries {
            let id = lookup.require(entry.objtype, &entry.objname, tuple.loc, &what, log);
            m.tuple_objtype.push(entry.objtype.code());
            m.tuple_objid.push(id.map_or(-1, |id| id as i32));
            m.tuple_objprm.push(entry.prm);
        }
    }
}
