//! From what a file says to a `Model`: every array that needs no simulation, then `physics::constants::set_const`.
//!
//! Stages, each in its file: assets; the tree of bodies (poses, shapes, inertia, degrees of freedom), fused if
//! asked; the arrays, with references between elements resolved by name; sparsity patterns. Arrays are filled row
//! by row in the order of ids; sizes follow from them. Errors are collected, not thrown at the first.

mod actuator;
mod assets;
mod body;
mod constraint;
mod custom;
mod discard;
mod fixed;
mod fluid;
pub(crate) mod frame;
mod fuse;
mod geom;
mod inertia;
mod joint;
mod keyframe;
mod lookup;
mod names;
mod sensor;
mod shape;
mod sizes;
mod tendon;
mod tree;
mod viewpoint;

pub(crate) use actuator::sizes as actuator_sizes;
pub(crate) use assets::asset_name;
pub(crate) use joint::dimensions as joint_dimensions;

use crate::cache::Cache;
use crate::diagnostic::{Diagnostics, Loc, Sources};
use crate::files::FileProvider;
use crate::spec::{Limited, Spec, StatisticOverride};
use physics::Model;
use physics::constants::length_range::set_length_ranges;
use physics::constants::set_const::set_const;
use physics::inertia::sparsity;
use physics::model::Arrays;
use physics::pipeline::validity::check_model;

/// Largest length a file may ask for without giving the data.
const MAX_LENGTH: i64 = 1 << 24;

/// A length from the file: not negative, and not a way to use up the memory.
fn bounded(length: i64, what: &str) -> Result<usize, String> {
    match length {
        0..=MAX_LENGTH => Ok(length as usize),
        _ => Err(format!("{what} must be between 0 and {MAX_LENGTH}, is {length}")),
    }
}

/// Where findings of the compile go.
struct Log<'a> {
    sources: &'a Sources,
    diagnostics: &'a mut Diagnostics,
}

impl Log<'_> {
    fn error(&mut self, loc: Loc, message: impl Into<String>) {
        self.diagnostics.error(self.sources, loc, message);
    }

    fn error_with(&mut self, loc: Loc, message: impl Into<String>, advice: Option<String>) {
        self.diagnostics.error_with(self.sources, loc, message, advice);
    }

    /// The value, or its error reported for the element called `what`.
    fn check<T>(&mut self, loc: Loc, what: &str, result: Result<T, String>) -> Option<T> {
        result.map_err(|message| self.error(loc, format!("{what}: {message}"))).ok()
    }
}

/// `kind 'name'`, or the kind alone for a nameless element.
fn title(kind: &str, name: &str) -> String {
    if name.is_empty() { kind.to_owned() } else { format!("{kind} '{name}'") }
}

/// Whether limits are active; an error when `autolimits` is off and the file leaves it open.
fn resolve_limited(limited: Limited, range: [f64; 2], autolimits: bool, which: &str) -> Result<bool, String> {
    match limited {
        Limited::False => Ok(false),
        Limited::True => Ok(true),
        Limited::Auto if !autolimits && range != [0.0, 0.0] => Err(format!(
            "`{which}range` without `{which}limited`: set it, or turn on `autolimits` of the compiler"
        )),
        Limited::Auto => Ok(range[0] < range[1]),
    }
}

/// Appends user data padded to the width of the model.
fn push_user(array: &mut Vec<f64>, values: &[f64], width: usize, size: &str) -> Result<(), String> {
    if values.len() > width {
        return Err(format!("user has {} values, {size} is {width}", values.len()));
    }
    array.extend_from_slice(values);
    array.resize(array.len() + width - values.len(), 0.0);
    Ok(())
}

/// Compiles `spec`; files of assets come from `files`, processed meshes from `cache`, findings go to `diagnostics`.
///
/// `None` when there is an error; then `diagnostics` says which.
pub fn compile(
    spec: &Spec,
    files: &dyn FileProvider,
    cache: Option<&Cache>,
    sources: &Sources,
    diagnostics: &mut Diagnostics,
) -> Option<Model> {
    let log = &mut Log { sources, diagnostics };
    let (arrays, springdampers) = compile_static(spec, files, cache, log)?;
    let mut m = Model::unchecked(arrays);
    if let Err(error) = set_const(&mut m) {
        log.error(Loc::NONE, error.to_string());
        return None;
    }
    if let Err(error) = check_model(&m) {
        log.error(Loc::NONE, error.to_string());
        return None;
    }
    joint::set_springdampers(m.unchecked_mut(), &springdampers);
    if let Err(error) = set_length_ranges(&mut m, &spec.compiler.lengthrange) {
        log.error(Loc::NONE, error.to_string());
        return None;
    }
    override_statistic(m.unchecked_mut(), &spec.stat);
    Some(m)
}

/// Statistics that the file gives replace the computed ones.
fn override_statistic(m: &mut Arrays, given: &StatisticOverride) {
    let stat = &mut m.stat;
    stat.meaninertia = given.meaninertia.unwrap_or(stat.meaninertia);
    stat.meanmass = given.meanmass.unwrap_or(stat.meanmass);
    stat.meansize = given.meansize.unwrap_or(stat.meansize);
    stat.extent = given.extent.unwrap_or(stat.extent);
    stat.center = given.center.unwrap_or(stat.center);
}

/// Everything that needs no configuration, and the `springdamper` of every joint, which needs the inertia at `qpos0`.
fn compile_static(
    spec: &Spec,
    files: &dyn FileProvider,
    cache: Option<&Cache>,
    log: &mut Log,
) -> Option<(Arrays, Vec<[f64; 2]>)> {
    let mut assets = assets::compile(spec, files, cache, log);
    let mut tree = tree::compile(spec, &assets, log);
    if log.diagnostics.has_errors() {
        return None;
    }
    if spec.compiler.fusestatic {
        let result = fuse::fuse_static(&mut tree, spec);
        log.check(Loc::NONE, "fusestatic", result);
    }
    if spec.compiler.discardvisual {
        discard::discard_visual(&mut tree, &mut assets, spec);
    }
    let lookup = lookup::Lookup::new(spec, &tree, &assets, log);
    let mut m = Arrays { name: spec.modelname.clone(), ..Arrays::default() };
    m.opt = spec.option.clone();
    m.vis = spec.visual.clone();
    sizes::set_user_widths(&mut m, spec, log);
    if log.diagnostics.has_errors() {
        return None;
    }
    assets::fill(&mut m, &assets, spec, &lookup, log);
    tree::fill(&mut m, &tree, spec, &lookup, log);
    assets::fill_hierarchies(&mut m, &assets);
    constraint::fill(&mut m, spec, &lookup, log);
    tendon::fill(&mut m, spec, &lookup, log);
    actuator::fill(&mut m, spec, &lookup, log);
    sensor::fill(&mut m, spec, &lookup, log);
    custom::fill(&mut m, spec, &lookup, log);
    keyframe::fill(&mut m, &tree, spec, log);
    if log.diagnostics.has_errors() {
        return None;
    }
    names::fill(&mut m, spec, &tree, &assets, &lookup);
    sizes::set(&mut m, spec);
    fixed::fill(&mut m, &tree, log);
    sparsity::fill(&mut m);
    sizes::allocate_derived(&mut m);
    sizes::check(&m, log);
    let springdampers = tree.joints().map(|j| j.spec.springdamper).collect();
    (!log.diagnostics.has_errors()).then_some((m, springdampers))
}
