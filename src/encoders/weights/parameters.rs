//! The tensors that a network needs, checked against the tensors of a file.

use super::file::WeightFile;
use crate::error::EncoderError;
use std::collections::{BTreeSet, HashMap};

/// A tensor that a network needs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// Its name, as PyTorch gives it.
    pub name: String,
    /// Its axes.
    pub shape: Vec<usize>,
}

impl Parameter {
    /// A tensor of that name and shape.
    pub fn new(name: impl Into<String>, shape: &[usize]) -> Self {
        Parameter { name: name.into(), shape: shape.to_vec() }
    }
}

/// How files name the tensors of a network.
pub struct Naming {
    /// What may stand before each name; the first that fits is used.
    pub prefixes: &'static [&'static str],
    /// Tensors, without prefix, that belong to other parts of what was trained.
    pub ignored: fn(&str) -> bool,
}

/// The numbers of all tensors of a network.
pub struct Parameters {
    values: HashMap<String, Vec<f32>>,
}

impl Parameters {
    /// The tensors of `layout` with the numbers that `values` gives for each.
    ///
    /// # Errors
    /// Those of `values`.
    ///
    /// # Panics
    /// `values` gives more or fewer numbers than a tensor has.
    pub fn collect<E>(
        layout: &[Parameter],
        mut values: impl FnMut(&Parameter) -> Result<Vec<f32>, E>,
    ) -> Result<Self, E> {
        let pair = |parameter: &Parameter| {
            let numbers = values(parameter)?;
            assert_eq!(numbers.len(), parameter.shape.iter().product::<usize>(), "{}", parameter.name);
            Ok((parameter.name.clone(), numbers))
        };
        Ok(Parameters { values: layout.iter().map(pair).collect::<Result<_, E>>()? })
    }

    /// Reads the tensors of `layout` from a file.
    ///
    /// # Errors
    /// [`EncoderError::Mismatch`]: the file lacks tensors, has others, or has them in other shapes.
    /// [`EncoderError::Weights`]: a tensor cannot be read.
    pub fn read(file: &mut WeightFile, layout: &[Parameter], naming: &Naming) -> Result<Self, EncoderError> {
        let fits =
            |prefix: &&str| layout.iter().any(|p| file.shape(&format!("{prefix}{}", p.name)).is_some());
        let prefix = naming.prefixes.iter().copied().find(fits).unwrap_or("");
        check(file, layout, prefix, naming)?;
        Self::collect(layout, |parameter| {
            let values = file.read(&format!("{prefix}{}", parameter.name))?;
            match negative_variance(&parameter.name, &values) {
                Some(value) => Err(EncoderError::Weights {
                    path: file.path().to_owned(),
                    reason: format!("tensor {}: a variance of {value} is negative", parameter.name),
                }),
                None => Ok(values),
            }
        })
    }

    /// Takes out a tensor of the layout.
    ///
    /// # Panics
    /// The layout had no such tensor, or it was taken before.
    pub(crate) fn take(&mut self, name: &str) -> Vec<f32> {
        self.values.remove(name).unwrap_or_else(|| panic!("{name} is in no layout, or was taken"))
    }
}

/// The first number that is no variance, in a tensor of variances.
fn negative_variance(name: &str, values: &[f32]) -> Option<f32> {
    if name.ends_with("running_var") { values.iter().copied().find(|&value| value < 0.0) } else { None }
}

/// Compares names and shapes of a file with a layout.
fn check(file: &WeightFile, layout: &[Parameter], prefix: &str, naming: &Naming) -> Result<(), EncoderError> {
    let needed: BTreeSet<&str> = layout.iter().map(|parameter| parameter.name.as_str()).collect();
    let (mut missing, mut misshaped) = (Vec::new(), Vec::new());
    for Parameter { name, shape } in layout {
        match file.shape(&format!("{prefix}{name}")) {
            None => missing.push(name.clone()),
            Some(found) if found != shape => {
                misshaped.push(format!("{name} ({found:?} instead of {shape:?})"))
            }
            Some(_) => {}
        }
    }
    let foreign = |name: &&str| match name.strip_prefix(prefix) {
        Some(bare) => !needed.contains(bare) && !(naming.ignored)(bare),
        None => !(naming.ignored)(name),
    };
    let unexpected: Vec<String> = file.names().filter(foreign).map(str::to_owned).collect();
    if missing.is_empty() && unexpected.is_empty() && misshaped.is_empty() {
        return Ok(());
    }
    Err(EncoderError::Mismatch { path: file.path().to_owned(), missing, unexpected, misshaped })
}
