//! Searches within the ranges of joints, near a posture.

use physics::elements::JointId;
use physics::{Data, Model, forward};
use robohive_robot::{Pose, Reach, Search};

const REST: [f64; 7] = [0.0, 0.35, 0.0, -2.2, 0.0, 2.55, 0.785];

fn arm() -> (Model, Data, Vec<JointId>) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/franka/franka_table.xml");
    let model = robohive_mjcf::load(path).unwrap().model;
    let joints: Vec<_> = (1..=7).map(|k| model.joint(&format!("joint{k}")).unwrap()).collect();
    let mut data = Data::new(&model);
    data.state.qpos[..7].copy_from_slice(&REST);
    forward(&model, &mut data).unwrap();
    (model, data, joints)
}

fn search() -> Search {
    Search { tolerance: 1e-6, max_steps: 200, ..Search::default() }
}

/// The fraction that a wave of a number without a period in it leaves: numbers that follow no pattern, the same ever again.
fn scattered(k: usize) -> f64 {
    (((k + 1) as f64) * 0.754_877_666).fract() * 2.0 - 1.0
}

#[test]
fn joints_stay_in_their_ranges_where_the_plain_search_leaves_them() {
    let (model, mut data, joints) = arm();
    let grasp = model.site("grasp").unwrap();
    let (mut left, mut reached) = (0, [0; 2]);
    for case in 0..200 {
        let start: Vec<f64> = (0..7).map(|k| REST[k] + 0.9 * scattered(9 * case + k)).collect();
        data.state.qpos[..7].copy_from_slice(&start);
        let [x, y, z] = [0, 1, 2].map(|k| scattered(31 * case + 7 + k));
        let turn = [1.0, 0.8 * x, 0.8 * y, 0.8 * z];
        let down = physics::math::quat_mul(physics::math::quat_normalize(turn), [0.0, 1.0, 0.0, 0.0]);
        let pose = Pose { position: Some([0.5 + 0.3 * x, 0.5 * y, 0.4 + 0.35 * z]), orientation: Some(down) };
        let outside = |qpos: &[f64]| {
            joints.iter().enumerate().any(|(k, joint)| {
                let [low, high] = model.jnt_range[joint.index()];
                qpos[k] < low || qpos[k] > high
            })
        };
        let plain = search().run(&model, &data, grasp, &pose, Some(&joints));
        left += usize::from(outside(&plain.qpos));
        let reach = Reach { joints: &joints, rest: None, pull: 0.0 };
        let solution = search().run_within(&model, &data, grasp, &pose, &reach);
        assert!(!outside(&solution.qpos), "case {case}: {:?}", solution.qpos);
        reached[0] += usize::from(plain.reached);
        reached[1] += usize::from(solution.reached);
        // Nothing but the arm moves.
        assert_eq!(solution.qpos[7..], data.state.qpos[7..]);
    }
    assert!(left > 20, "{left} plain searches leave the ranges");
    println!("{left} of 200 plain searches leave the ranges; reached {reached:?}");
    // Those whose plain search left the ranges may have no answer within them; all others have the same one.
    assert!(reached[1] > 100 && reached[1] + left >= reached[0], "{reached:?}");
}

#[test]
fn what_is_free_goes_to_the_posture() {
    let (model, mut data, joints) = arm();
    let grasp = model.site("grasp").unwrap();
    let mut at = data.clone();
    let pose_of = |data: &Data| {
        let turned = physics::math::mat_to_quat(&data.kin.site_xmat[grasp.index()]);
        Pose { position: Some(data.kin.site_xpos[grasp.index()]), orientation: Some(turned) }
    };
    let wanted = pose_of(&data);
    // The same pose with the elbow out: seven joints, six numbers.
    let elbow_out =
        Reach { joints: &joints, rest: Some(&[1.2, 0.35, -1.2, -2.2, 0.0, 2.55, 0.785]), pull: 0.2 };
    let back = Reach { joints: &joints, rest: Some(&REST), pull: 0.2 };
    let distance = |qpos: &[f64]| qpos.iter().zip(REST).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    let mut far = 0.0;
    for (reach, rounds) in [(&elbow_out, 40), (&back, 200)] {
        for _ in 0..rounds {
            // A pose a hair away, so that there is something to do.
            let [x, y, z] = wanted.position.unwrap();
            let nudged = Pose { position: Some([x, y, z + 1e-4]), ..wanted };
            for pose in [&nudged, &wanted] {
                let solution = search().run_within(&model, &data, grasp, pose, reach);
                assert!(solution.reached, "{}", solution.error);
                data.state.qpos.copy_from_slice(&solution.qpos);
            }
        }
        at.state.qpos.copy_from_slice(&data.state.qpos);
        forward(&model, &mut at).unwrap();
        let off: f64 =
            (0..3).map(|k| (at.kin.site_xpos[grasp.index()][k] - wanted.position.unwrap()[k]).abs()).sum();
        assert!(off < 1e-5, "{off}");
        if far == 0.0 {
            far = distance(&data.state.qpos[..7]);
        }
    }
    let near = distance(&data.state.qpos[..7]);
    assert!(far > 0.5, "the elbow was moved: {far}");
    assert!(near < 0.02, "and came back: {near}");
}
