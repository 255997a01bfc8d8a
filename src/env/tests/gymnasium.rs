//! Gymnasium's tasks on models of our own: what a step does, what it is worth, and what is refused.

use robohive_env::{Env, EnvError, Options, OwnModels, Registry};

const QUADRUPED: &str = "model_path = 'hive/quadruped/tasks/walk.xml'";

fn make(id: &str, changes: &str) -> Result<Env, EnvError> {
    let options = Options::default().with_changes(changes.parse().unwrap());
    Env::make(id, &OwnModels, &options)
}

fn refused(id: &str, changes: &str) -> String {
    make(id, changes).err().unwrap().to_string()
}

#[test]
fn the_ids_are_found_and_not_listed() {
    let registry = Registry::builtin();
    assert_eq!(registry.guests().len(), 5);
    for spec in registry.guests() {
        assert_eq!(registry.spec(&spec.id).unwrap().max_episode_steps, 1000);
        assert!(registry.specs().iter().all(|listed| listed.id != spec.id));
    }
    assert!(registry.spec("gymnasium/Ant-v4").unwrap_err().to_string().contains("gymnasium/Ant-v5"));
}

#[test]
fn a_model_must_be_named() {
    let text = refused("gymnasium/Ant-v5", "");
    assert!(text.contains("model_path") && text.contains("envs/mujoco/assets/ant.xml"), "{text}");
    let text = refused("gymnasium/Ant-v5", "model_path = '/no/such/ant.xml'");
    assert!(text.contains("/no/such/ant.xml does not exist"), "{text}");
}

#[test]
fn a_step_is_whole_time_steps_with_the_action_as_controls() {
    let mut env = make("gymnasium/Ant-v5", QUADRUPED).unwrap();
    env.reset(Some(4)).unwrap();
    let (model, mut data) = (env.scene().model.clone(), env.scene().data.clone());
    for step in 0..150 {
        let action: Vec<f64> = (0..env.action_len()).map(|k| 0.3 * ((step + 5 * k) as f64).sin()).collect();
        env.step(&action).unwrap();
        data.state.ctrl.copy_from_slice(&action);
        (0..env.frame_skip()).for_each(|_| physics::step(&model, &mut data).unwrap());
        assert_eq!(env.scene().data.state.qpos, data.state.qpos);
        assert_eq!(env.scene().data.kin.xpos, data.kin.xpos);
    }
    physics::derive_body_forces(&model, &mut data);
    let forces = data.sensor.cfrc_ext[1..].as_flattened();
    assert!(forces.iter().any(|force| force.abs() > 0.1), "it touches the floor");
    assert!(env.rows()["cfrc_ext"].iter().zip(forces).all(|(seen, force)| *seen == force.clamp(-1.0, 1.0)));
}

#[test]
fn rewards_are_progress_and_health_less_effort() {
    let changes = format!("{QUADRUPED}\nforward_reward_weight = 2.0\nhealthy_z_range = [-1, 9]");
    let mut env = make("gymnasium/Ant-v5", &changes).unwrap();
    env.reset(Some(1)).unwrap();
    assert_eq!(env.terms()["reward_ctrl"], [0.0]);
    let before = env.scene().data.kin.xpos[1][0];
    let step = env.step(&vec![0.5; env.action_len()]).unwrap();
    let forward = 2.0 * (env.scene().data.kin.xpos[1][0] - before) / env.dt();
    let effort = 0.5 * 0.25 * env.action_len() as f64;
    assert!((env.terms()["reward_forward"][0] - forward).abs() < 1e-12);
    assert!((env.terms()["reward_ctrl"][0] + effort).abs() < 1e-12);
    let sum: f64 = env.terms().iter().map(|(_, term)| term[0]).sum();
    assert!((step.reward - sum).abs() < 1e-12 && !step.terminated);
}

#[test]
fn an_unhealthy_robot_ends_its_episode() {
    for (id, range) in
        [("Ant", "healthy_z_range"), ("Humanoid", "healthy_z_range"), ("Hopper", "healthy_state_range")]
    {
        let id = format!("gymnasium/{id}-v5");
        let mut env = make(&id, &format!("{QUADRUPED}\n{range} = [50, 60]")).unwrap();
        env.reset(Some(0)).unwrap();
        let zeros = vec![0.0; env.action_len()];
        assert!(env.step(&zeros).unwrap().terminated, "{id}");
        assert_eq!(env.terms()["reward_survive"], [0.0]);
        let patient = format!("{QUADRUPED}\n{range} = [50, 60]\nterminate_when_unhealthy = false");
        let mut env = make(&id, &patient).unwrap();
        env.reset(Some(0)).unwrap();
        assert!(!env.step(&zeros).unwrap().terminated, "{id}");
    }
}

#[test]
fn observations_are_chosen_by_gymnasiums_settings() {
    let model = &make("gymnasium/Humanoid-v5", QUADRUPED).unwrap().scene().model.clone();
    let (nq, nv, bodies) = (model.nq, model.nv, model.nbody - 1);
    let len = |changes: &str| {
        let changes = format!("{QUADRUPED}\n{changes}");
        make("gymnasium/Humanoid-v5", &changes).unwrap().observation().len()
    };
    assert_eq!(len(""), nq - 2 + nv + (10 + 6 + 6) * bodies + nv - 6);
    assert_eq!(len("include_cinert_in_observation = false"), nq - 2 + nv + 12 * bodies + nv - 6);
    assert_eq!(len("exclude_current_positions_from_observation = false"), nq + nv + 22 * bodies + nv - 6);
}

#[test]
fn wrong_settings_are_named() {
    let wrong =
        |id: &str, change: &str| refused(&format!("gymnasium/{id}-v5"), &format!("{QUADRUPED}\n{change}"));
    assert!(wrong("Ant", "main_body = 999").contains("main_body"));
    assert!(wrong("HalfCheetah", "healthy_reward = 1.0").contains("never unhealthy"));
    assert!(wrong("Walker2d", "healthy_state_range = [0, 1]").contains("Hopper"));
    assert!(wrong("Hopper", "speed = 1").contains("speed"));
}
