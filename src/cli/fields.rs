//! Fields by name: from `Data` into arrays shaped as MuJoCo's Python bindings shape them.

use crate::Failure;
use dataset::{Array, Values};
use physics::table::Slice;
use physics::{Data, Model};
use std::collections::BTreeMap;

/// Copies reflected scalars into an array.
pub fn array(shape: Vec<usize>, values: Slice<'_>) -> Array {
    let values = match values {
        Slice::Bool(v) => Values::Bool(v.to_vec()),
        Slice::U8(v) => Values::U8(v.to_vec()),
        Slice::I32(v) => Values::I32(v.to_vec()),
        Slice::I64(v) => Values::I64(v.to_vec()),
        Slice::F32(v) => Values::F32(v.to_vec()),
        Slice::F64(v) => Values::F64(v.to_vec()),
    };
    Array { shape, values }
}

/// True for fields with one row a contact or constraint row.
pub fn is_ragged(name: &str) -> bool {
    name.starts_with("contact.") || (name.starts_with("efc_") && name != "efc_J_colind")
}

/// Rows of the chosen fields, gathered step by step or state by state.
pub struct Recorder {
    names: Vec<String>,
    columns: BTreeMap<String, Column>,
}

#[derive(Default)]
struct Column {
    shape: Vec<usize>,
    values: Option<Values>,
    rows: usize,
}

impl Recorder {
    /// Will record `names`; every one must be a field of `Data`.
    ///
    /// # Errors
    /// A name that no field bears, with the nearest ones.
    pub fn new(m: &Model, d: &Data, names: &[String]) -> Result<Self, Failure> {
        let mut known = Vec::new();
        d.visit(m, &mut |name, _, _| known.push(name));
        for name in names {
            if !known.contains(&name.as_str()) {
                let near: Vec<_> =
                    known.iter().filter(|k| k.contains(name.as_str()) || name.contains(**k)).collect();
                let hint = if near.is_empty() { String::new() } else { format!("; near it: {near:?}") };
                return Err(Failure::usage(format!("no field is called {name:?}{hint}")));
            }
        }
        Ok(Recorder { names: names.to_vec(), columns: BTreeMap::new() })
    }

    /// Appends the current values of every field.
    pub fn record(&mut self, m: &Model, d: &Data) {
        d.visit(m, &mut |name, shape, values| {
            if !self.names.iter().any(|n| n == name) {
                return;
            }
            let column = self.columns.entry(name.to_owned()).or_default();
            let array = match name {
                "efc_J" => Array::f64(vec![d.efc.nefc, m.nv], d.efc.dense_jacobian(m.nv)),
                _ => array(shape, values),
            };
            column.rows += if is_ragged(name) { array.rows() } else { 1 };
            column.shape = if is_ragged(name) { array.shape[1..].to_vec() } else { array.shape };
            append(&mut column.values, array.values);
        });
    }

    /// The gathered arrays: a leading axis of steps, states, contacts or rows.
    pub fn finish(self) -> Vec<(String, Array)> {
        let finish = |(name, column): (String, Column)| {
            let mut shape = vec![column.rows];
            shape.extend(column.shape);
            (name, Array { shape, values: column.values.unwrap_or(Values::F64(Vec::new())) })
        };
        self.columns.into_iter().map(finish).collect()
    }
}

fn append(to: &mut Option<Values>, more: Values) {
    match (to, more) {
        (Some(Values::Bool(a)), Values::Bool(b)) => a.extend(b),
        (Some(Values::U8(a)), Values::U8(b)) => a.extend(b),
        (Some(Values::I32(a)), Values::I32(b)) => a.extend(b),
        (Some(Values::I64(a)), Values::I64(b)) => a.extend(b),
        (Some(Values::F32(a)), Values::F32(b)) => a.extend(b),
        (Some(Values::F64(a)), Values::F64(b)) => a.extend(b),
        (to, more) => *to = Some(more),
    }
}
