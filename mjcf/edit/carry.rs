//! The state of a simulation carried from one model to another by the names of their elements.

use std::collections::BTreeMap;
use std::ops::Range;

use physics::model::ObjType;
use physics::{Data, Model};

/// Data of `to` in the state that `data`, of `from`, is in: time, positions, velocities, activations, delays, controls,
/// applied forces, poses of mocap bodies and active constraints of every element that both models have under one name and
/// with as many numbers. Joints and bodies without a name are found by their place in what has one; other elements without
/// a name by their order, where both models have as many of them. Everything else is at its reference, as after
/// [`Data::new`]; nothing is computed yet.
pub fn carry_state(from: &Model, data: &Data, to: &Model) -> Data {
    let mut out = Data::new(to);
    let (old, new) = (&data.state, &mut out.state);
    new.time = old.time;
    if from.nuserdata == to.nuserdata {
        new.userdata.copy_from_slice(&old.userdata);
    }
    let (old_bodies, new_bodies) = (body_keys(from), body_keys(to));
    let bodies = matched(&old_bodies, &new_bodies);
    for &(a, b) in &bodies {
        new.xfrc_applied[b] = old.xfrc_applied[a];
        let mocap = |m: &Model, body: usize| usize::try_from(m.body_mocapid[body]).ok();
        if let (Some(a), Some(b)) = (mocap(from, a), mocap(to, b)) {
            new.mocap_pos[b] = old.mocap_pos[a];
            new.mocap_quat[b] = old.mocap_quat[a];
        }
    }
    for (a, b) in matched(&joint_keys(from, &old_bodies), &joint_keys(to, &new_bodies)) {
        let (was, is) = (positions(from, a), positions(to, b));
        if from.jnt_type[a] == to.jnt_type[b] && was.len() == is.len() {
            new.qpos[is].copy_from_slice(&old.qpos[was]);
            let (was, is) = (velocities(from, a), velocities(to, b));
            new.qvel[is.clone()].copy_from_slice(&old.qvel[was.clone()]);
            new.qacc_warmstart[is.clone()].copy_from_slice(&old.qacc_warmstart[was.clone()]);
            new.qfrc_applied[is].copy_from_slice(&old.qfrc_applied[was]);
        }
    }
    for (a, b) in
        matched(&keys(from, ObjType::Actuator, from.nactuator), &keys(to, ObjType::Actuator, to.nactuator))
    {
        let acts = |m: &Model, i: usize| span(m.actuator_actadr[i], m.actuator_actnum[i]);
        let inputs = |m: &Model, i: usize| span(m.actuator_ctrladr[i], m.actuator_ctrlnum[i]);
        copy(&mut new.act, acts(to, b), &old.act, acts(from, a));
        copy(&mut new.ctrl, inputs(to, b), &old.ctrl, inputs(from, a));
        copy(
            &mut new.history,
            delay(to, to.actuator_historyadr[b]),
            &old.history,
            delay(from, from.actuator_historyadr[a]),
        );
    }
    for (a, b) in matched(&keys(from, ObjType::Sensor, from.nsensor), &keys(to, ObjType::Sensor, to.nsensor))
    {
        let (was, is) = (delay(from, from.sensor_historyadr[a]), delay(to, to.sensor_historyadr[b]));
        copy(&mut new.history, is, &old.history, was);
    }
    for (a, b) in matched(&keys(from, ObjType::Equality, from.neq), &keys(to, ObjType::Equality, to.neq)) {
        new.eq_active[b] = old.eq_active[a];
    }
    out
}

fn copy(to: &mut [f64], is: Range<usize>, from: &[f64], was: Range<usize>) {
    if is.len() == was.len() {
        to[is].copy_from_slice(&from[was]);
    }
}

fn span(start: i32, length: i32) -> Range<usize> {
    let start = start.max(0) as usize;
    start..start + length.max(0) as usize
}

/// Where the numbers of an element end: at the next element's, or at the end.
fn until_next(starts: &[i32], index: usize, end: usize) -> Range<usize> {
    let start = starts[index].max(0) as usize;
    start..starts.get(index + 1).map_or(end, |&next| next.max(0) as usize)
}

fn positions(m: &Model, joint: usize) -> Range<usize> {
    until_next(&m.jnt_qposadr, joint, m.nq)
}

fn velocities(m: &Model, joint: usize) -> Range<usize> {
    until_next(&m.jnt_dofadr, joint, m.nv)
}

/// The delay buffer that begins at `start`; none for -1.
fn delay(m: &Model, start: i32) -> Range<usize> {
    let Ok(begin) = usize::try_from(start) else { return 0..0 };
    let starts = m.actuator_historyadr.iter().chain(m.sensor_historyadr.iter());
    let next = starts.filter(|&&other| other > start).min();
    begin..next.map_or(m.nhistory, |&next| next as usize)
}

/// Ids of the elements that both models have.
fn matched(old: &[Option<String>], new: &[Option<String>]) -> Vec<(usize, usize)> {
    let known: BTreeMap<&str, usize> =
        old.iter().enumerate().filter_map(|(id, key)| Some((key.as_deref()?, id))).collect();
    let pairs = new.iter().enumerate().filter_map(|(id, key)| Some((*known.get(key.as_deref()?)?, id)));
    pairs.collect()
}

/// The keys of elements: their names; without one their number among those, and how many there are.
fn keys(m: &Model, kind: ObjType, count: usize) -> Vec<Option<String>> {
    let unnamed = (0..count).filter(|&id| m.name_of(kind, id).is_empty()).count();
    let mut number = 0;
    let key = |id| match m.name_of(kind, id) {
        "" => {
            number += 1;
            Some(format!("\0{number} of {unnamed}"))
        }
        name => Some(name.to_owned()),
    };
    (0..count).map(key).collect()
}

/// The keys of bodies: their names, or their place among the children without one of their parent.
fn body_keys(m: &Model) -> Vec<Option<String>> {
    let mut keys: Vec<Option<String>> = Vec::with_capacity(m.nbody);
    let mut unnamed = vec![0; m.nbody];
    for body in 0..m.nbody {
        let name = m.name_of(ObjType::Body, body);
        let parent = m.body_parentid[body].max(0) as usize;
        keys.push(match name {
            "" => {
                unnamed[parent] += 1;
                keys.get(parent).cloned().flatten().map(|above| format!("{above}\0{}", unnamed[parent]))
            }
            name => Some(name.to_owned()),
        });
    }
    keys
}

/// The keys of joints: their names, or their place in their body.
fn joint_keys(m: &Model, bodies: &[Option<String>]) -> Vec<Option<String>> {
    let key = |joint: usize| match m.name_of(ObjType::Joint, joint) {
        "" => {
            let body = m.jnt_bodyid[joint].max(0) as usize;
            let place = joint as i32 - m.body_jntadr[body];
            bodies.get(body).cloned().flatten().map(|above| format!("{above}\0{place}"))
        }
        name => Some(name.to_owned()),
    };
    (0..m.njnt).map(key).collect()
}
