//! Contacts of flexes at random places (`reference/flex_pairs.py`): a line, triangle or tetrahedron with a geom, with one of
//! another flex, or with another of its own.

use super::archive::{largest, numbers};
use super::report::{Report, Tally};
use crate::reference::ReferenceError;
use crate::tolerance::CONTACT_BAR;
use dataset::NpzReader;
use physics::collision::{CollisionScratch, World, collide_awake};
use physics::data::{Contact, Contacts};
use physics::position::{com::com_pos, kinematics::kinematics};
use physics::{Data, Model, flex};

/// A contact is deep beyond this depth [m]: a tenth of the size of elements and geoms.
const DEEP: f64 = 0.01;

/// Adds one chunk of placements to the report.
///
/// # Errors
/// An array is missing or does not fit the model.
pub fn compare(
    m: &mut Model,
    d: &mut Data,
    archive: &NpzReader,
    report: &mut Report,
) -> Result<(), ReferenceError> {
    let text = |name: &str| -> Result<String, ReferenceError> {
        let bytes = numbers(archive, name)?.iter().map(|&x| x as u8).collect();
        String::from_utf8(bytes).map_err(|_| ReferenceError::Shape(name.to_owned()))
    };
    let key = (text("variant")?, text("flexes")?);
    for name in archive.names() {
        let set = match name.split_once('.') {
            Some(("model", field)) => m.unchecked_mut().assign(field, &numbers(archive, name)?),
            Some(("opt", field)) => m.options_mut().assign(field, &numbers(archive, name)?),
            _ => continue,
        };
        if set != Some(true) {
            return Err(ReferenceError::Shape(name.to_owned()));
        }
    }
    let mut recorded = Contacts::default();
    for name in archive.names().filter(|name| name.starts_with("contact.")) {
        if recorded.assign(name, &numbers(archive, name)?) != Some(true) {
            return Err(ReferenceError::Shape(name.to_owned()));
        }
    }
    let (counts, unstable) = (numbers(archive, "ncon")?, numbers(archive, "unstable")?);
    let mut places = Vec::new();
    for name in ["qpos", "mocap_pos", "mocap_quat"] {
        places.push((name, numbers(archive, name)?));
    }
    let (mut scratch, mut theirs) = (CollisionScratch::default(), recorded.contact.as_slice());
    let mut tally = report.flexes.remove(&key).unwrap_or_default();
    for (row, (&count, &unstable)) in counts.iter().zip(&unstable).enumerate() {
        for (name, values) in &places {
            let width = values.len() / counts.len();
            let set = d.assign(name, &values[row * width..(row + 1) * width]);
            if width > 0 && set != Some(true) {
                return Err(ReferenceError::Shape((*name).to_owned()));
            }
        }
        find(m, d, &mut scratch);
        let misfit = || ReferenceError::Shape("ncon".into());
        let (expected, rest) = theirs.split_at_checked(count as usize).ok_or_else(misfit)?;
        theirs = rest;
        let error = difference(&d.con.contact, expected);
        count_placement(&mut tally, expected, error, unstable != 0.0);
        if error.is_none() && unstable == 0.0 {
            let (ours, theirs) = (d.con.contact.len(), expected.len());
            report.note(|| {
                format!("{} ({}), placement {row}: {ours} contacts (MuJoCo {theirs})", key.1, key.0)
            });
        }
    }
    report.flexes.insert(key, tally);
    Ok(())
}

/// All contacts of the state.
fn find(m: &Model, d: &mut Data, scratch: &mut CollisionScratch) {
    kinematics(m, &d.state, &mut d.kin);
    com_pos(m, &d.kin, &mut d.com);
    flex::flexes(m, &d.kin, &d.com, &mut d.flex, &mut d.scratch.flex);
    let world = World { m, kin: &d.kin, flexes: &d.flex };
    collide_awake(world, &d.state, d.budget, scratch, &mut d.con).expect("contacts within the budget");
}

/// Largest differences in `dist`, `pos` and `frame`; none where contacts are not the same ones or beyond the bar.
fn difference(ours: &[Contact], theirs: &[Contact]) -> Option<[f64; 3]> {
    let mut worst = [0.0_f64; 3];
    for (a, b) in ours.iter().zip(theirs) {
        let same = a.geom == b.geom && a.flex == b.flex && a.elem == b.elem && a.vert == b.vert;
        let apart = [(a.dist - b.dist).abs(), largest(&a.pos, &b.pos), largest(&a.frame, &b.frame)];
        if !same || !apart.iter().all(|&e| e <= CONTACT_BAR) {
            return None;
        }
        worst = std::array::from_fn(|k| worst[k].max(apart[k]));
    }
    (ours.len() == theirs.len()).then_some(worst)
}

fn count_placement(tally: &mut Tally, theirs: &[Contact], error: Option<[f64; 3]>, unstable: bool) {
    tally.placements += 1;
    tally.touching += usize::from(!theirs.is_empty());
    tally.deep += usize::from(theirs.iter().any(|c| c.dist < -DEEP));
    tally.unstable += usize::from(unstable);
    match error {
        Some(error) => tally.worst = std::array::from_fn(|k| tally.worst[k].max(error[k])),
        None if unstable => tally.excepted += 1,
        None => tally.different += 1,
    }
}
