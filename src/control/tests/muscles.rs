//! Controllers of limbs that muscles move, and of legs.

use env::{Env, Options, OwnModels};
use robohive_control::make;

/// Steps of an episode in which the task was solved, and its last action.
fn solved(id: &str, controller: &str, seed: u64) -> (usize, Vec<f64>) {
    let mut env = Env::make(id, &OwnModels, &Options::default()).unwrap();
    let mut controller = make(controller, &env).unwrap();
    let (mut action, mut count) = (vec![0.0; env.action_len()], 0);
    env.reset(Some(seed)).unwrap();
    controller.reset(&env, seed).unwrap();
    loop {
        controller.act(&env, &mut action).unwrap();
        let step = env.step(&action).unwrap();
        count += usize::from(env.verdict().solved);
        if step.terminated || step.truncated {
            return (count, action);
        }
    }
}

/// Poses are taken and kept: by six muscles, with a motor beside them, by five, and by 39, after a tendon transfer too.
#[test]
fn limbs_take_their_poses() {
    let ids = [
        "hive/myoElbowPose1D6MRandom-v0",
        "hive/myoElbowPose1D6MExoRandom-v0",
        "hive/myoFingerPoseRandom-v0",
        "hive/myoHandPose3Fixed-v0",
        "hive/myoReafHandPose7Fixed-v0",
    ];
    for id in ids {
        let (count, action) = solved(id, "muscle_pose", 4);
        assert!(count > 30, "{id} is solved in {count} steps");
        assert!(action.iter().all(|value| (-1.0..=1.0).contains(value)), "{id}");
        assert!(solved(id, "muscle_pose", 4).1 == action, "{id} acts otherwise in the same episode");
    }
}

#[test]
fn five_tips_and_one_reach_their_targets() {
    for id in ["hive/myoHandReachFixed-v0", "hive/myoFingerReachFixed-v0"] {
        let (count, _) = solved(id, "muscle_reach", 0);
        assert!(count > 10, "{id} is solved in {count} steps");
    }
}

/// Two legs keep the heights that are asked of them through pushes, and do the same again.
#[test]
fn legs_stand() {
    let id = "hive/MuscleLegsStand-v0";
    for seed in [0, 1] {
        let (count, action) = solved(id, "muscle_stand", seed);
        assert!(count > 350, "{id} is solved in {count} steps");
        assert!(action.iter().all(|value| (-1.0..=1.0).contains(value)), "{id}");
    }
    assert!(solved(id, "muscle_stand", 1).1 == solved(id, "muscle_stand", 1).1, "{id} differs");
}
