//! From what a file says to a `Model`: every array that needs no simulation, then `physics::constants::set_const`.
//!
//! Stages, each in its file: assets; the tree of bodies (poses, shapes, inertia, degrees of freedom), fused if
//! asked; the arrays, with references between elements resolved by name; sparsity patterns. Arrays are filled row
//! by row in the order of ids; sizes follow from them. Errors are collected, not thrown at the first.

mod asset_rows;
mod assets;
mod bodies;
mod demand;
mod discard;
mod elements;
mod fixed;
mod flex;
mod frame;
mod fuse;
mod hierarchy;
mod inertia;
mod keyframe;
mod log;
mod lookup;
mod names;
mod nodes;
mod plugins;
mod resources;
mod sizes;
mod values;

pub(crate) use elements::{datatype, needstage};
pub(crate) use resources::Resources;

use crate::budget::Budget;
use crate::diagnostic::{Diagnostics, Loc, Sources};
use crate::files::FileProvider;
use crate::loaded::Loaded;
use crate::spec::{Spec, StatisticOverride};
use crate::xml::Limits;
use log::Log;
use physics::Model;
use physics::constants::length_range::set_length_ranges;
use physics::constants::set_const::set_const;
use physics::constants::{bending_factor, flex_pattern, sparsity};
use physics::model::{Arrays, Rows};
use physics::pipeline::validity::{check_model, check_start};
use physics::plugin::Registry;

/// Compiles `spec`; files of assets come from `files`, processed meshes from `meshes`, findings go to `diagnostics`,
/// memory is taken from `budget`.
///
/// `None` when there is an error; then `diagnostics` says which.
pub(crate) fn compile(
    spec: &Spec,
    resources: Resources<'_>,
    sources: &Sources,
    diagnostics: &mut Diagnostics,
    budget: Budget,
) -> Option<Model> {
    let log = &mut Log { sources, diagnostics, budget };
    let Static { arrays, springdampers, plugins } = compile_static(spec, resources, log)?;
    let mut m = Model::unchecked(arrays);
    if let Err(error) = set_const(&mut m) {
        log.error(Loc::NONE, error.to_string());
        return None;
    }
    if let Err(error) = check_model(&m) {
        log.error(Loc::NONE, error.to_string());
        return None;
    }
    bodies::set_springdampers(m.unchecked_mut(), &springdampers);
    if let Err(error) = set_length_ranges(&mut m, &spec.compiler.lengthrange) {
        log.error(Loc::NONE, error.to_string());
        return None;
    }
    override_statistic(m.unchecked_mut(), &spec.stat);
    if let Err(error) = m.start_plugins(resources.registry) {
        let loc = plugins.get(error.instance).copied().unwrap_or(Loc::NONE);
        log.error(loc, error.to_string());
        return None;
    }
    if let Err(error) = check_start(&m) {
        log.error(Loc::NONE, error.to_string());
        return None;
    }
    Some(m)
}

/// What needs no simulation.
struct Static {
    arrays: Arrays,
    /// The `springdamper` of every joint, which needs the inertia at `qpos0`.
    springdampers: Vec<[f64; 2]>,
    /// Where the instances of plugins are declared.
    plugins: Vec<Loc>,
}

impl Spec {
    /// Compiles the elements; files of assets come from `files`, places in findings from `sources`, which is empty for
    /// elements that no text declares.
    ///
    /// ```
    /// use robohive_mjcf::{files::Memory, parse_str};
    ///
    /// let mut parsed = parse_str("<mujoco><worldbody><geom size='0.1'/></worldbody></mujoco>")?;
    /// parsed.spec.world.geoms[0].size[0] = 0.2;
    /// let loaded = parsed.spec.compile(&Memory::default(), &parsed.sources)?;
    /// assert_eq!(loaded.model.geom_size[0][0], 0.2);
    /// # Ok::<(), robohive_mjcf::diagnostic::Diagnostics>(())
    /// ```
    ///
    /// # Errors
    /// All that is wrong with the elements and the assets, not the first finding alone.
    pub fn compile(&self, files: &dyn FileProvider, sources: &Sources) -> Result<Loaded, Diagnostics> {
        self.compile_with(files, sources, &Registry::default())
    }

    /// [`Spec::compile`] of a model whose plugins are in `registry`.
    ///
    /// # Errors
    /// As `compile`.
    pub fn compile_with(
        &self,
        files: &dyn FileProvider,
        sources: &Sources,
        registry: &Registry,
    ) -> Result<Loaded, Diagnostics> {
        let mut diagnostics = Diagnostics::default();
        let budget = Budget::new(Limits::default().memory);
        let resources = Resources { files, meshes: None, registry };
        match compile(self, resources, sources, &mut diagnostics, budget) {
            Some(model) => Ok(Loaded { model, warnings: diagnostics }),
            None => Err(diagnostics),
        }
    }
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

/// Everything that needs no configuration.
fn compile_static(spec: &Spec, resources: Resources<'_>, log: &mut Log) -> Option<Static> {
    let mut m = Rows { name: spec.modelname.clone(), ..Rows::default() };
    sizes::set_user_widths(&mut m, spec, log);
    if log.diagnostics.has_errors() || !demand::charge(&m, spec, log) {
        return None;
    }
    let plugins = plugins::compile(spec, resources.registry, log);
    let mut assets = assets::compile(spec, resources, &plugins, log);
    let mut tree = bodies::compile(spec, &assets, log);
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
    m.opt = spec.option.clone();
    m.vis = spec.visual.clone();
    if log.diagnostics.has_errors() {
        return None;
    }
    asset_rows::fill(&mut m, &assets, spec, &lookup, log);
    plugins.fill(&mut m, log);
    bodies::fill(&mut m, &tree, (spec, &plugins), &lookup, log);
    hierarchy::fill_meshes(&mut m, &assets);
    if spec.flexes.is_empty() {
        hierarchy::fill_spare(&mut m, &tree);
    }
    let flexes = flex::compile(spec, &tree, &lookup, log);
    flex::fill(&mut m, &flexes, &tree, spec, &lookup, log);
    elements::fill(&mut m, (spec, &plugins), &lookup, log);
    keyframe::fill(&mut m, &tree, spec, log);
    if log.diagnostics.has_errors() {
        return None;
    }
    names::fill(&mut m, (spec, &plugins), &tree, &assets, &lookup);
    let mut m = m.finish();
    sizes::set(&mut m, spec);
    fixed::fill(&mut m, &tree, log);
    if !demand::charge_patterns(&m, spec, log) {
        return None;
    }
    sparsity::fill(&mut m);
    flex_pattern::set_sizes(&mut m);
    bending_factor::set_sizes(&mut m);
    sizes::allocate_derived(&mut m);
    sizes::check(&m, log);
    let springdampers = tree.joints().map(|j| j.spec.springdamper).collect();
    let plugins = plugins.list.iter().map(|one| one.loc).collect();
    (!log.diagnostics.has_errors()).then_some(Static { arrays: m, springdampers, plugins })
}
