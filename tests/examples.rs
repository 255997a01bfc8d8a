//! The examples run, and stay small.

#[path = "../examples/controller.rs"]
mod controller;
#[path = "../examples/custom_task.rs"]
mod custom_task;
#[path = "../examples/edit_model.rs"]
mod edit_model;
#[path = "../examples/embed.rs"]
mod embed;
#[path = "../examples/many_environments.rs"]
mod many_environments;
#[path = "../examples/pictures.rs"]
mod pictures;
#[path = "../examples/record_policy.rs"]
mod record_policy;
#[path = "../examples/recording.rs"]
mod recording;
#[path = "../examples/robot_config.rs"]
mod robot_config;

#[test]
fn the_embedded_engine_runs_in_sixty_lines() {
    embed::main().unwrap();
    assert!(include_str!("../examples/embed.rs").lines().count() <= 60);
}

#[test]
fn a_policy_is_recorded_and_filmed_in_a_hundred_lines() {
    record_policy::main().unwrap();
    assert!(include_str!("../examples/record_policy.rs").lines().count() <= 100);
}

#[test]
fn a_controller_solves_a_task() {
    controller::main().unwrap();
}

#[test]
fn environments_step_together() {
    many_environments::main().unwrap();
}

#[test]
fn pictures_show_what_is_there() {
    pictures::main().unwrap();
}

#[test]
fn a_model_is_edited() {
    edit_model::main().unwrap();
}

#[test]
fn a_recording_is_written_and_read() {
    recording::main().unwrap();
}

#[test]
fn a_robot_follows_its_config() {
    robot_config::main().unwrap();
}

#[test]
fn a_task_of_a_programs_own_runs() {
    custom_task::main().unwrap();
}

#[test]
fn examples_name_this_crate_alone() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut seen = 0;
    for file in std::fs::read_dir(folder).unwrap() {
        let text = std::fs::read_to_string(file.unwrap().path()).unwrap();
        for line in text.lines().filter(|line| line.trim_start().starts_with("use ")) {
            let path = line.trim_start().trim_start_matches("use ");
            assert!(path.starts_with("robohive::") || path.starts_with("std::"), "{line}");
        }
        seen += 1;
    }
    assert!(seen >= 9, "{seen} examples");
}
