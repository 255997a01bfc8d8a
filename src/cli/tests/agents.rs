//! Environments of several agents, as the command describes and plays them.

mod command;

use command::{robohive, text};

const ID: &str = "hive/DKittyPairPushBox-v0";

#[test]
fn info_says_what_each_agent_commands_observes_and_earns() {
    let said = text(&robohive(&["info", ID]).stdout);
    assert!(said.contains("agent        left: 12 values of the action\n"), "{said}");
    assert!(said.contains("mate_error, box_error, box_turn, target_error\n"), "{said}");
    assert!(said.contains("earns      0.5 x right_reach, "), "{said}");
    let info: serde_json::Value = serde_json::from_slice(&robohive(&["info", ID, "--json"]).stdout).unwrap();
    assert_eq!(info["agents"][1]["name"], "right");
    assert_eq!(info["agents"][1]["action"], serde_json::json!((12..24).collect::<Vec<_>>()));
    assert_eq!(
        info["agents"][0]["observation"][0],
        serde_json::json!({"name": "height", "row": "left_height"})
    );
    assert!(!text(&robohive(&["info", "hive/FrankaReach-v0"]).stdout).contains("agent "));
}

#[test]
fn the_joint_view_is_played_as_any_environment() {
    let out = robohive(&["run", ID, "--policy", "random", "--episodes", "1", "--set", "max_episode_steps=5"]);
    let said = text(&out.stdout);
    assert!(out.status.success() && said.contains("1 episodes, 5 steps"), "{said}");
}
