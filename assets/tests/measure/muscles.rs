//! What bodies with muscles are tried with: moment arms over the range of a joint, and paths that stay out of bones.

use super::run;
use physics::elements::BodyId;
use physics::math::{add_scaled, cross, dot, mul_mat_t_vec, sub};
use physics::{Data, Model, forward};
use std::ops::Range;
use workshop::Mesh;

/// A bone: its name, the body that it is on, and its surface in that body's frame.
pub type Bone = (&'static str, BodyId, Mesh);

/// The model with its muscles' activations at a pose.
pub fn flexed(m: &Model, pose: &[f64], act: &[f64]) -> Data {
    let mut d = Data::new(m);
    d.state.qpos.copy_from_slice(pose);
    d.state.act.copy_from_slice(act);
    forward(m, &mut d).unwrap();
    d
}

/// The tendon that an actuator pulls.
fn tendon(m: &Model, actuator: usize) -> usize {
    m.actuator_trnid[actuator][0] as usize
}

/// Moment arms of all actuators about a degree of freedom \[m\]: positive where a pull moves the joint to larger angles.
pub fn arms(m: &Model, pose: &[f64], dof: usize) -> Vec<f64> {
    arms_in(m, &flexed(m, pose, &vec![0.0; m.na]), dof)
}

/// The same where a model is.
pub fn arms_in(m: &Model, d: &Data, dof: usize) -> Vec<f64> {
    let mut motion = vec![0.0; m.nv];
    motion[dof] = 1.0;
    arms_along(m, d, &motion)
}

/// Moment arms of all actuators, where a model is, about a motion of several joints, given by the speed of each degree of freedom \[m\].
pub fn arms_along(m: &Model, d: &Data, motion: &[f64]) -> Vec<f64> {
    let arm = |actuator| {
        let tendon = tendon(m, actuator);
        let start = m.ten_J_rowadr[tendon] as usize;
        let row = start..start + m.ten_J_rownnz[tendon] as usize;
        row.map(|i| -d.ten.ten_J[i] * motion[m.ten_J_colind[i] as usize]).sum()
    };
    (0..m.nu).map(arm).collect()
}

/// Moment arms at 181 angles over the whole range of a joint, all other joints as in `pose`: a row for each angle.
pub fn arms_over_range(m: &Model, pose: &[f64], dof: usize) -> Vec<Vec<f64>> {
    let [low, high] = m.jnt_range[dof];
    let at = |step: i32| {
        let mut pose = pose.to_vec();
        pose[dof] = low + (high - low) * f64::from(step) / 180.0;
        arms(m, &pose, dof)
    };
    (0..=180).map(at).collect()
}

/// The largest change of a moment arm between neighbouring rows \[m\].
pub fn jump(rows: &[Vec<f64>]) -> f64 {
    let change =
        |pair: &[Vec<f64>]| pair[0].iter().zip(&pair[1]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    rows.windows(2).map(change).fold(0.0, f64::max)
}

/// Excites the muscles for some time \[s\].
pub fn excite(m: &Model, d: &mut Data, excited: &[f64], seconds: f64) {
    d.state.ctrl.copy_from_slice(excited);
    run(m, d, seconds, |_| ());
}

/// Where an edge passes a height y: its z there. Both faces at an edge get the same bits.
fn passes([p, q]: [[f64; 3]; 2], y: f64) -> Option<f64> {
    let [low, high] = if p[1] < q[1] { [p, q] } else { [q, p] };
    let crossed = low[1] <= y && y < high[1];
    crossed.then(|| low[2] + (high[2] - low[2]) * (y - low[1]) / (high[1] - low[1]))
}

/// How often a surface goes round a point: how often a ray along x leaves it, less how often it enters it.
fn winding(mesh: &Mesh, [x, y, z]: [f64; 3]) -> f64 {
    let corners = mesh.faces().iter().map(|face| face.map(|vertex| mesh.vertices()[vertex]));
    let through = corners.filter_map(|[a, b, c]| {
        let beyond =
            [[a, b], [b, c], [c, a]].into_iter().filter_map(|edge| passes(edge, y)).filter(|at| z < *at);
        if beyond.count() != 1 {
            return None;
        }
        let normal = cross(sub(b, a), sub(c, a));
        let hit = a[0] - (normal[1] * (y - a[1]) + normal[2] * (z - a[2])) / normal[0];
        (hit > x).then(|| normal[0].signum())
    });
    through.sum()
}

/// Whether a point is in a surface, whose lowest and highest coordinates are given.
fn inside(mesh: &Mesh, [low, high]: [[f64; 3]; 2], point: [f64; 3]) -> bool {
    (0..3).all(|axis| low[axis] < point[axis] && point[axis] < high[axis]) && winding(mesh, point) > 0.5
}

/// Points of the straight stretches of a muscle's path, 20 each, beyond `near` \[m\] of its ends: near where it is fixed to a bone, its line
/// may be below the bone's surface. A stretch round a cylinder is shown by its two ends alone; the cylinders are thicker than the
/// bones in them.
fn points(m: &Model, d: &Data, muscle: usize, near: f64) -> Vec<[f64; 3]> {
    let tendon = tendon(m, muscle);
    let start = d.ten.ten_wrapadr[tendon] as usize;
    let all = d.ten.wrap_xpos.as_flattened().as_chunks::<3>().0;
    let path = &all[start..start + d.ten.ten_wrapnum[tendon] as usize];
    let ends = [path[0], path[path.len() - 1]];
    let round = &d.ten.wrap_obj.as_flattened()[start..];
    let straight = path.windows(2).enumerate().filter(|(i, _)| round[*i] < 0 || round[i + 1] < 0);
    let between = straight.flat_map(|(_, pair)| {
        (0..20).map(|step| add_scaled(pair[0], sub(pair[1], pair[0]), f64::from(step) / 20.0))
    });
    let far =
        |point: &[f64; 3]| ends.iter().all(|end| dot(sub(*point, *end), sub(*point, *end)) >= near * near);
    between.filter(far).collect()
}

/// Asserts that at these poses no muscle passes through a bone, and returns how many points were looked at.
pub fn stay_outside(m: &Model, bones: &[Bone], near: f64, poses: &[Vec<f64>]) -> usize {
    some_stay_outside(m, 0..m.nu, bones, near, poses)
}

/// The same of some muscles.
pub fn some_stay_outside(
    m: &Model,
    muscles: Range<usize>,
    bones: &[Bone],
    near: f64,
    poses: &[Vec<f64>],
) -> usize {
    let bounds: Vec<_> = bones.iter().map(|(.., mesh)| mesh.bounds()).collect();
    let mut looked = 0;
    for pose in poses {
        let d = flexed(m, pose, &vec![0.0; m.na]);
        for muscle in muscles.clone() {
            for point in points(m, &d, muscle, near) {
                for ((name, body, mesh), bounds) in bones.iter().zip(&bounds) {
                    let local = mul_mat_t_vec(d.body(*body).xmat(), sub(point, *d.body(*body).xpos()));
                    assert!(
                        !inside(mesh, *bounds, local),
                        "muscle {muscle} in the {name} at {pose:?}: {local:?}"
                    );
                    looked += 1;
                }
            }
        }
    }
    looked
}

/// A bone of one of our own models.
pub fn bone(m: &Model, robot: &str, name: &'static str, body: &str) -> Bone {
    (name, m.body(body).unwrap(), robohive_assets::mesh(&format!("{robot}/{name}.obj")).unwrap())
}
