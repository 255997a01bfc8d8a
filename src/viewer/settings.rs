//! Options, statistics and visual settings of a model by group and name, as MuJoCo's `model.opt.timestep` asks for them.

use physics::model::{Arrays, Draft, Options, Visual};
use physics::table::Slice;

/// Names of the groups.
pub const GROUPS: [&str; 8] =
    ["opt", "stat", "vis.global", "vis.quality", "vis.headlight", "vis.map", "vis.scale", "vis.rgba"];

/// Calls `f(name, values)` for every setting of `group`.
pub fn visit(arrays: &Arrays, group: &str, f: &mut dyn FnMut(&'static str, Slice<'_>)) {
    let vis = &arrays.vis;
    match group {
        "opt" => arrays.opt.visit(f),
        "stat" => arrays.stat.visit(f),
        "vis.global" => vis.global.visit(f),
        "vis.quality" => vis.quality.visit(f),
        "vis.headlight" => vis.headlight.visit(f),
        "vis.map" => vis.map.visit(f),
        "vis.scale" => vis.scale.visit(f),
        "vis.rgba" => vis.rgba.visit(f),
        _ => unreachable!("{group} is not one of GROUPS"),
    }
}

/// Shows the setting `name` of `group`; false when there is none.
pub fn read(arrays: &Arrays, group: &str, name: &str, show: &mut dyn FnMut(Slice<'_>)) -> bool {
    let mut found = false;
    visit(arrays, group, &mut |own, values| {
        if own == name {
            found = true;
            show(values);
        }
    });
    found
}

/// Overwrites a setting; `None` when there is none, `Some(false)` when the numbers do not fit it.
pub fn assign(draft: &mut Draft<'_>, group: &str, name: &str, values: &[f64]) -> Option<bool> {
    match group {
        "stat" => draft.stat.assign(name, values),
        _ => assign_choice(draft.opt, draft.vis, group, name, values),
    }
}

/// The same for what a description states as a model has it: options and visual settings.
pub fn assign_choice(
    options: &mut Options,
    visual: &mut Visual,
    group: &str,
    name: &str,
    values: &[f64],
) -> Option<bool> {
    match group {
        "opt" => options.assign(name, values),
        "vis.global" => visual.global.assign(name, values),
        "vis.quality" => visual.quality.assign(name, values),
        "vis.headlight" => visual.headlight.assign(name, values),
        "vis.map" => visual.map.assign(name, values),
        "vis.scale" => visual.scale.assign(name, values),
        "vis.rgba" => visual.rgba.assign(name, values),
        _ => None,
    }
}
