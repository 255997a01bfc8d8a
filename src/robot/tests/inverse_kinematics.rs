//! Searches for poses find what RoboHive's find, as validation/reference/robot.py recorded it.

use physics::{Data, Model, forward};
use robohive_robot::{Pose, Search, Solution};

const RECORDED: &str = include_str!("inverse_kinematics.txt");

/// One search of the original.
struct Case {
    search: Search,
    start: Vec<f64>,
    pose: Pose,
    found: Solution,
}

fn arm() -> Model {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/franka/franka_table.xml");
    robohive_mjcf::load(path).unwrap().model
}

fn numbers(line: &str) -> Vec<f64> {
    line.split(' ').skip(1).map(|word| word.parse().unwrap()).collect()
}

fn cases() -> Vec<Case> {
    let lines: Vec<_> = RECORDED.lines().map(numbers).collect();
    let case = |rows: &[Vec<f64>]| {
        let [asked, start, pose, found] = rows else { panic!("{rows:?}") };
        Case {
            search: Search { damping: asked[2], tolerance: 1e-9, max_steps: 200, ..Search::default() },
            start: start.clone(),
            pose: Pose {
                position: (asked[0] == 1.0).then(|| [pose[0], pose[1], pose[2]]),
                orientation: (asked[1] == 1.0).then(|| [pose[3], pose[4], pose[5], pose[6]]),
            },
            found: Solution {
                reached: found[0] == 1.0,
                steps: found[1] as usize,
                error: found[2],
                qpos: found[3..].to_vec(),
            },
        }
    };
    lines.chunks(4).map(case).collect()
}

#[test]
fn searches_find_what_the_originals_find() {
    let model = arm();
    let grasp = model.site("grasp").unwrap();
    let mut data = Data::new(&model);
    let (mut equal, mut failed) = (0, 0);
    let cases = cases();
    for case in &cases {
        data.state.qpos.copy_from_slice(&case.start);
        let solution = case.search.run(&model, &data, grasp, &case.pose, None);
        assert_eq!(solution.reached, case.found.reached);
        if solution.steps == case.search.max_steps {
            // The original counts from 0 to the last update, and gives the error before it.
            assert_eq!(case.found.steps + 1, solution.steps);
        } else {
            assert_eq!(solution.steps, case.found.steps);
            assert!((solution.error - case.found.error).abs() < 1e-9);
        }
        let apart =
            solution.qpos.iter().zip(&case.found.qpos).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        if apart > 1e-12 {
            // The original inverts a matrix of the size of all joints, whose smallest singular values are rounding errors
            // about the cut-off: joints move also where the pose leaves them free.
            let free = case.pose.position.is_none() || case.pose.orientation.is_none();
            assert!(free && apart < 0.01, "{apart}");
        } else {
            equal += 1;
        }
        failed += usize::from(!solution.reached);
        assert_eq!(data.state.qpos, case.start);
    }
    assert_eq!((cases.len(), failed), (24, 4));
    assert!(equal >= 20, "only {equal} equal");
}

#[test]
fn what_is_reached_is_where_the_site_stands() {
    let model = arm();
    let grasp = model.site("grasp").unwrap();
    let mut data = Data::new(&model);
    for case in cases().iter().filter(|case| case.found.reached) {
        data.state.qpos.copy_from_slice(&case.start);
        let solution = case.search.run(&model, &data, grasp, &case.pose, None);
        data.state.qpos.copy_from_slice(&solution.qpos);
        forward(&model, &mut data).unwrap();
        for (found, wanted) in
            case.pose.position.iter().flat_map(|wanted| data.site(grasp).xpos().iter().zip(wanted))
        {
            assert!((found - wanted).abs() < 2e-9, "{found} for {wanted}");
        }
    }
}

#[test]
fn only_the_joints_that_may_move_do() {
    let model = arm();
    let grasp = model.site("grasp").unwrap();
    let joints: Vec<_> = ["joint2", "joint4", "joint6"].map(|name| model.joint(name).unwrap()).to_vec();
    let mut data = Data::new(&model);
    data.state.qpos[..7].copy_from_slice(&[0.1, 0.2, 0.3, -1.5, 0.1, 1.5, 0.2]);
    forward(&model, &mut data).unwrap();
    let mut goal = data.clone();
    for (address, change) in [(1, 0.2), (3, -0.3), (5, 0.1)] {
        goal.state.qpos[address] += change;
    }
    forward(&model, &mut goal).unwrap();
    let pose = Pose { position: Some(*goal.site(grasp).xpos()), orientation: None };
    let search = Search { tolerance: 1e-10, ..Search::default() };
    let solution = search.run(&model, &data, grasp, &pose, Some(&joints));
    assert!(solution.reached, "{solution:?}");
    for (address, (now, then)) in solution.qpos.iter().zip(&data.state.qpos).enumerate() {
        assert_eq!(now != then, [1, 3, 5].contains(&address), "position {address}");
    }
}

#[test]
fn a_pose_that_asks_for_nothing_is_reached() {
    let model = arm();
    let grasp = model.site("grasp").unwrap();
    let data = Data::new(&model);
    let solution = Search::default().run(&model, &data, grasp, &Pose::default(), None);
    assert_eq!((solution.reached, solution.steps, solution.error), (true, 0, 0.0));
    assert_eq!(solution.qpos, data.state.qpos);
}
