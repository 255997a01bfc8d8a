//! `inspect`: what is in a model.

use crate::failure::{Failure, unwritable};
use crate::input::loading::load;
use crate::input::source::ModelSource;
use crate::models::fields::array;
use crate::output::{archive_file, check_place};
use crate::terminal::{show, show_json};
use clap::{Args, ValueHint};
use dataset::{Array, NpzWriter};
use physics::Model;
use physics::model::{GeomType, JointType, ObjType};
use physics::table::Slice;
use serde_json::{Map, Value};
use std::path::{Path, PathBuf};

/// Summarise a model, or write out every compiled array
#[derive(Args)]
#[command(
    after_help = "In JSON, numbers that are not finite are the strings \"Infinity\", \"-Infinity\" and \"NaN\".

Examples:
  robohive inspect assets/elbow/elbow.xml                   sizes, options, bodies
  robohive inspect assets/elbow/elbow.xml --npz elbow.npz   every array under its MuJoCo name
  robohive inspect assets/elbow/elbow.xml --json | jq .sizes
  robohive inspect - < assets/pile/pile.xml"
)]
pub struct Inspect {
    /// The model
    #[command(flatten)]
    pub model: ModelSource,
    /// Write every model array to this numpy archive
    #[arg(long, value_name = "FILE.npz", value_hint = ValueHint::FilePath, value_parser = archive_file)]
    pub npz: Option<PathBuf>,
    /// Print one JSON object instead of the summary
    #[arg(long)]
    pub json: bool,
}

/// Runs the command.
pub fn run(a: &Inspect) -> Result<(), Failure> {
    a.npz.as_deref().map_or(Ok(()), check_place)?;
    let m = load(&a.model.path, &a.model.reading)?;
    if let Some(path) = &a.npz {
        write_arrays(&m, path)?;
    }
    if a.json {
        show_json(&json(&m));
    } else {
        summary(&m);
    }
    Ok(())
}

/// Every array under its own name; options and statistics as `opt.NAME` and `stat.NAME`, what is seen as
/// `vis.GROUP.NAME`, sizes and flags as scalars.
fn write_arrays(m: &Model, path: &Path) -> Result<(), Failure> {
    let mut arrays: Vec<(String, Array)> = Vec::new();
    m.visit_sizes(&mut |name, n| arrays.push((name.into(), Array::scalar_i64(n as i64))));
    m.visit_flags(&mut |name, flag| arrays.push((name.into(), Array::scalar_i64(flag.into()))));
    m.visit(&mut |name, shape, values| arrays.push((name.into(), array(shape, values))));
    m.opt.visit(&mut |name, values| arrays.push((format!("opt.{name}"), setting(values))));
    m.stat.visit(&mut |name, values| arrays.push((format!("stat.{name}"), setting(values))));
    m.vis.visit(&mut |group, name, values| arrays.push((format!("vis.{group}.{name}"), setting(values))));
    let mut writer = NpzWriter::create(path).map_err(unwritable(path))?;
    for (name, array) in &arrays {
        writer.add(name, array).map_err(unwritable(path))?;
    }
    writer.finish().map_err(unwritable(path))
}

fn setting(values: Slice<'_>) -> Array {
    let shape = if values.len() == 1 { vec![] } else { vec![values.len()] };
    array(shape, values)
}

fn json(m: &Model) -> Value {
    let mut sizes = Map::new();
    // A limit that is not given has all bits set: -1 as MuJoCo shows it.
    m.visit_sizes(&mut |name, n| _ = sizes.insert(name.into(), (n as i64).into()));
    let mut options = Map::new();
    m.opt.visit(&mut |name, values| _ = options.insert(name.into(), setting_json(values)));
    let name = |kind, i: usize| match m.name_of(kind, i) {
        "" => m.label_of(kind, i),
        name => name.to_owned(),
    };
    let names = |kind, n: usize| (0..n).map(|i| name(kind, i)).collect::<Vec<_>>();
    serde_json::json!({
        "model": m.name,
        "sizes": sizes,
        "options": options,
        "bodies": names(ObjType::Body, m.nbody),
        "joints": names(ObjType::Joint, m.njnt),
        "actuators": names(ObjType::Actuator, m.nactuator),
        "sensors": names(ObjType::Sensor, m.nsensor),
        "keyframes": names(ObjType::Key, m.nkey),
        "mass": m.body_subtreemass.first().map(|&mass| number(mass)),
    })
}

/// A setting as a number, or an array of them.
fn setting_json(values: Slice<'_>) -> Value {
    let numbers: Vec<Value> = match values {
        Slice::Bool(v) => v.iter().map(|&x| x.into()).collect(),
        Slice::U8(v) => v.iter().map(|&x| x.into()).collect(),
        Slice::I32(v) => v.iter().map(|&x| x.into()).collect(),
        Slice::I64(v) => v.iter().map(|&x| x.into()).collect(),
        Slice::F32(v) => v.iter().map(|&x| number(x.into())).collect(),
        Slice::F64(v) => v.iter().map(|&x| number(x)).collect(),
    };
    match &numbers[..] {
        [one] => one.clone(),
        _ => numbers.into(),
    }
}

/// A number, spelt where JSON has none for it.
fn number(x: f64) -> Value {
    match x {
        f64::INFINITY => "Infinity".into(),
        f64::NEG_INFINITY => "-Infinity".into(),
        x if x.is_nan() => "NaN".into(),
        x => x.into(),
    }
}

fn summary(m: &Model) {
    let line = |key: &str, value: String| show!("{key:<12} {value}");
    line("model", m.name.clone());
    line("state", format!("nq {}, nv {}, na {}, nu {}, nmocap {}", m.nq, m.nv, m.na, m.nu, m.nmocap));
    line("tree", format!("{} bodies, {} joints, {} trees", m.nbody, m.njnt, m.ntree));
    line("mass", format!("{:.6} kg", m.body_subtreemass.first().copied().unwrap_or(0.0)));
    line("joints", tally(&m.jnt_type, |c| JointType::from_code(c).map(|t| format!("{t:?}"))));
    line("geoms", tally(&m.geom_type, |c| GeomType::from_code(c).map(|t| format!("{t:?}"))));
    line("meshes", format!("{} with {} vertices, {} faces", m.nmesh, m.nmeshvert, m.nmeshface));
    line("tendons", format!("{} with {} path points", m.ntendon, m.nwrap));
    line("actuators", format!("{}", m.nactuator));
    line("sensors", format!("{} with {} values", m.nsensor, m.nsensordata));
    line("constraints", format!("{} equality, {} pairs, {} excludes", m.neq, m.npair, m.nexclude));
    line("keyframes", format!("{}", m.nkey));
    line(
        "option",
        format!(
            "timestep {} s, integrator {:?}, solver {:?}, cone {:?}, iterations {}, noslip {}",
            m.opt.timestep,
            m.opt.integrator,
            m.opt.solver,
            m.opt.cone,
            m.opt.iterations,
            m.opt.noslip_iterations
        ),
    );
}

/// Counts of each kind, in order of first appearance.
fn tally(codes: &[i32], name: impl Fn(i32) -> Option<String>) -> String {
    let mut counts: Vec<(i32, usize)> = Vec::new();
    for &code in codes {
        match counts.iter_mut().find(|(c, _)| *c == code) {
            Some((_, n)) => *n += 1,
            None => counts.push((code, 1)),
        }
    }
    let kinds: Vec<_> =
        counts.iter().map(|&(c, n)| format!("{n} {}", name(c).unwrap_or_default().to_lowercase())).collect();
    if kinds.is_empty() { "none".into() } else { kinds.join(", ") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_numbers_or_arrays_and_what_json_lacks_is_spelt() {
        assert_eq!(setting_json(Slice::F64(&[0.002])).to_string(), "0.002");
        assert_eq!(setting_json(Slice::I32(&[-1])).to_string(), "-1");
        let text = setting_json(Slice::F64(&[f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1.0])).to_string();
        assert_eq!(text, "[\"Infinity\",\"-Infinity\",\"NaN\",1.0]");
    }
}
