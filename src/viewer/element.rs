//! What is known of one element: the rows that the arrays of the model and of the state have for it.

use crate::session::Session;
use physics::model::ObjType;
use physics::table::Slice;

/// Kinds of elements with the prefix of their arrays in the model, and the arrays of the state that have a row for each.
const KINDS: [(ObjType, &str, &[&str]); 8] = [
    (ObjType::Body, "body_", &["xpos", "xquat", "xipos", "subtree_com", "cvel", "xfrc_applied", "cfrc_ext"]),
    (ObjType::Joint, "jnt_", &["xanchor", "xaxis"]),
    (ObjType::Geom, "geom_", &["geom_xpos", "geom_xmat"]),
    (ObjType::Site, "site_", &["site_xpos", "site_xmat"]),
    (ObjType::Tendon, "tendon_", &["ten_length", "ten_velocity"]),
    (ObjType::Actuator, "actuator_", &["actuator_length", "actuator_velocity", "actuator_force"]),
    (ObjType::Sensor, "sensor_", &[]),
    (ObjType::Equality, "eq_", &["eq_active"]),
];

/// Most numbers of a row that are written out.
const NUMBERS: usize = 12;

/// Kinds of elements that [`rows`] knows, and how many of each a session's model has.
pub fn kinds(session: &Session) -> Vec<(ObjType, usize)> {
    let model = session.model();
    KINDS.iter().map(|(kind, ..)| (*kind, count(model, *kind))).filter(|(_, count)| *count > 0).collect()
}

fn count(model: &physics::Model, kind: ObjType) -> usize {
    match kind {
        ObjType::Body => model.nbody,
        ObjType::Joint => model.njnt,
        ObjType::Geom => model.ngeom,
        ObjType::Site => model.nsite,
        ObjType::Tendon => model.ntendon,
        ObjType::Actuator => model.nactuator,
        ObjType::Sensor => model.nsensor,
        ObjType::Equality => model.neq,
        _ => 0,
    }
}

/// The rows of an element, array by array: those of the state first, then those of the model, each with its numbers as text.
/// Nothing for an element that is not there.
pub fn rows(session: &Session, kind: ObjType, id: usize) -> Vec<(String, String)> {
    let (model, data) = (session.model(), session.data());
    let Some((_, prefix, derived)) = KINDS.iter().find(|(known, ..)| *known == kind) else {
        return Vec::new();
    };
    let count = count(model, kind);
    let mut rows = Vec::new();
    if id >= count {
        return rows;
    }
    data.visit(model, &mut |name, shape, values| {
        if derived.contains(&name) && shape.first() == Some(&count) {
            rows.push((name.to_owned(), row(values, shape.iter().skip(1).product(), id)));
        }
    });
    if kind == ObjType::Joint {
        let of = |all: &[f64], first: i32, last: Option<&i32>| {
            let end = last.map_or(all.len(), |&end| end as usize);
            written(&all[first as usize..end])
        };
        let next = |addresses: &[i32]| addresses.get(id + 1).copied();
        let qpos = of(&data.state.qpos, model.jnt_qposadr[id], next(&model.jnt_qposadr).as_ref());
        let qvel = of(&data.state.qvel, model.jnt_dofadr[id], next(&model.jnt_dofadr).as_ref());
        rows.extend([("qpos".to_owned(), qpos), ("qvel".to_owned(), qvel)]);
    }
    if kind == ObjType::Sensor {
        let first = model.sensor_adr[id] as usize;
        let readings = &data.sensor.sensordata[first..first + model.sensor_dim[id] as usize];
        rows.push(("sensordata".to_owned(), written(readings)));
    }
    model.visit(&mut |name, shape, values| {
        if name.starts_with(prefix) && shape.first() == Some(&count) {
            rows.push((name.to_owned(), row(values, shape.iter().skip(1).product(), id)));
        }
    });
    rows
}

fn row(values: Slice<'_>, width: usize, id: usize) -> String {
    written(values.to_f64().get(id * width..(id + 1) * width).unwrap_or_default())
}

/// Numbers in six digits at most.
fn written(numbers: &[f64]) -> String {
    let mut texts: Vec<String> = numbers.iter().take(NUMBERS).map(|&x| crate::text::short(x)).collect();
    if numbers.len() > NUMBERS {
        texts.push(format!("… ({} numbers)", numbers.len()));
    }
    texts.join(" ")
}
