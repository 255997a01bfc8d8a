//! Keyframes: missing parts are the reference configuration, short ones are completed.

use super::log::{Log, title};
use super::nodes::Tree;
use crate::diagnostic::Loc;
use crate::spec::{Key, KeyPart, Keyed, Spec};
use physics::model::{JointType, Rows};

/// Name and place of every keyframe: from the file, empty ones up to `size/nkey`, then from attached models.
pub(super) fn names(spec: &Spec) -> impl Iterator<Item = (&str, Loc)> {
    let empty = (spec.size.nkey.max(0) as usize).saturating_sub(spec.keys.len());
    let own = spec.keys.iter().map(|k| (&*k.name, k.loc));
    let kept = spec.kept_keys.iter().map(|k| (&*k.name, k.loc));
    own.chain(std::iter::repeat_n(("", Loc::NONE), empty)).chain(kept)
}

/// Appends the keyframes of the file, empty ones up to `size/nkey`, then the keyframes of attached models.
pub(super) fn fill(m: &mut Rows, tree: &Tree, spec: &Spec, log: &mut Log) {
    let (nq, nv, nu) = (m.qpos0.len(), m.dof_bodyid.len(), m.actuator_ctrllimited.len());
    let na: i32 = m.actuator_actnum.iter().sum();
    let mocap: Vec<usize> = (0..m.body_mocapid.len()).filter(|&b| m.body_mocapid[b] >= 0).collect();
    let mpos0: Vec<f64> = mocap.iter().flat_map(|&b| m.body_pos[b]).collect();
    let mquat0: Vec<f64> = mocap.iter().flat_map(|&b| m.body_quat[b]).collect();
    let (empty, continued) = (Key::default(), continuation(tree));
    let count = spec.keys.len().max(spec.size.nkey.max(0) as usize);
    let kept: Vec<Key> = (0..spec.kept_keys.len()).map(|k| gather(m, tree, spec, k)).collect();
    for key in spec.keys.iter().chain(std::iter::repeat(&empty)).take(count).chain(&kept) {
        m.key_time.push(key.time);
        let mut part = Part { loc: key.loc, what: title("keyframe", &key.name), log };
        let rest = if key.qpos.is_empty() { &m.qpos0 } else { &continued };
        let mut qpos = part.complete(&key.qpos, rest, "qpos");
        let mut mquat = part.complete_rows::<4>(&key.mquat, &mquat0, "mquat");
        m.key_qvel.extend(part.complete(&key.qvel, &vec![0.0; nv], "qvel"));
        m.key_act.extend(part.complete(&key.act, &vec![0.0; na as usize], "act"));
        m.key_mpos.extend(part.complete_rows::<3>(&key.mpos, &mpos0, "mpos"));
        m.key_ctrl.extend(part.complete(&key.ctrl, &vec![0.0; nu], "ctrl"));
        normalize_rotations(m, &mut qpos[..nq]);
        mquat.chunks_exact_mut(4).for_each(normalize);
        m.key_qpos.extend(qpos);
        m.key_mquat.extend(mquat);
    }
}

/// What a `qpos` that is given in part goes on with, as MuJoCo has it: free and ball joints at the identity whatever the pose
/// of their bodies is, and the numbers of `ref` as they stand in the text, degrees of hinges too.
fn continuation(tree: &Tree) -> Vec<f64> {
    tree.joints()
        .flat_map(|joint| match joint.spec.kind {
            JointType::Free => vec![0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
            JointType::Ball => vec![1.0, 0.0, 0.0, 0.0],
            JointType::Slide | JointType::Hinge => vec![joint.spec.ref_],
        })
        .collect()
}

/// A keyframe of an attached model: what its elements took along, and the reference elsewhere.
fn gather(m: &Rows, tree: &Tree, spec: &Spec, index: usize) -> Key {
    let head = &spec.kept_keys[index];
    let mut key = Key { name: head.name.clone(), loc: head.loc, time: head.time, ..Key::default() };
    let mut put = |keyed: &[Keyed], part: KeyPart, address: i32, default: &[f64]| {
        let all = match part {
            KeyPart::Qpos => &mut key.qpos,
            KeyPart::Qvel => &mut key.qvel,
            KeyPart::Mpos => &mut key.mpos,
            KeyPart::Mquat => &mut key.mquat,
            KeyPart::Act => &mut key.act,
            KeyPart::Ctrl => &mut key.ctrl,
        };
        for share in keyed.iter().filter(|k| k.key == index && k.part == part) {
            if all.is_empty() {
                all.extend_from_slice(default);
            }
            let start = address.max(0) as usize;
            if let Some(place) = all.get_mut(start..start + share.values.len()) {
                place.copy_from_slice(&share.values);
            }
        }
    };
    let mocap: Vec<usize> = (0..m.body_mocapid.len()).filter(|&b| m.body_mocapid[b] >= 0).collect();
    let mpos0: Vec<f64> = mocap.iter().flat_map(|&b| m.body_pos[b]).collect();
    let mquat0: Vec<f64> = mocap.iter().flat_map(|&b| m.body_quat[b]).collect();
    for (b, body) in tree.bodies.iter().enumerate() {
        put(&body.spec.keyed, KeyPart::Mpos, 3 * m.body_mocapid[b], &mpos0);
        put(&body.spec.keyed, KeyPart::Mquat, 4 * m.body_mocapid[b], &mquat0);
    }
    let rest = vec![0.0; m.dof_bodyid.len()];
    for (j, joint) in tree.joints().enumerate() {
        put(&joint.spec.keyed, KeyPart::Qpos, m.jnt_qposadr[j], &m.qpos0);
        put(&joint.spec.keyed, KeyPart::Qvel, m.jnt_dofadr[j], &rest);
    }
    let act = vec![0.0; m.actuator_actnum.iter().sum::<i32>() as usize];
    let ctrl = vec![0.0; m.actuator_ctrllimited.len()];
    for (a, actuator) in spec.actuators.iter().enumerate() {
        put(&actuator.keyed, KeyPart::Act, m.actuator_actadr[a], &act);
        put(&actuator.keyed, KeyPart::Ctrl, m.actuator_ctrladr[a], &ctrl);
    }
    key
}

struct Part<'a, 'b> {
    loc: Loc,
    what: String,
    log: &'a mut Log<'b>,
}

impl Part<'_, '_> {
    /// `given`, rows of `N` numbers, continued by `default`; a row that is not whole counts as missing, as in MuJoCo.
    fn complete_rows<const N: usize>(&mut self, given: &[f64], default: &[f64], name: &str) -> Vec<f64> {
        let whole = given.len() - given.len() % N;
        if whole < given.len() && given.len() <= default.len() {
            let message = format!(
                "{}: the last {} of {} numbers of {name} are ignored: give {N} for each mocap body",
                self.what,
                given.len() - whole,
                given.len()
            );
            self.log.diagnostics.warning(self.log.sources, self.loc, message);
            return self.complete(&given[..whole], default, name);
        }
        self.complete(given, default, name)
    }

    /// `given`, continued by `default`.
    fn complete(&mut self, given: &[f64], default: &[f64], name: &str) -> Vec<f64> {
        if given.len() > default.len() {
            let message =
                format!("{}: {name} has {} values, {} expected", self.what, given.len(), default.len());
            self.log.error(self.loc, message);
            return default.to_vec();
        }
        let mut values = default.to_vec();
        values[..given.len()].copy_from_slice(given);
        values
    }
}

fn normalize_rotations(m: &Rows, qpos: &mut [f64]) {
    for joint in 0..m.jnt_type.len() {
        let start = match JointType::from_code(m.jnt_type[joint]) {
            Some(JointType::Free) => m.jnt_qposadr[joint] as usize + 3,
            Some(JointType::Ball) => m.jnt_qposadr[joint] as usize,
            _ => continue,
        };
        normalize(&mut qpos[start..start + 4]);
    }
}

fn normalize(quat: &mut [f64]) {
    let mut q = [quat[0], quat[1], quat[2], quat[3]];
    if crate::vector::normalize(&mut q) == 0.0 {
        q = [1.0, 0.0, 0.0, 0.0];
    }
    quat.copy_from_slice(&q);
}
