//! `info`: what an environment observes, rewards and runs on.

use crate::failure::Failure;
use crate::input::library::Source;
use crate::terminal::{show, show_json};
use clap::Args;
use env::team::{Agent, Team};
use env::visual::{Channel, VisualKey};
use env::{Env, Registry, Row, Success};
use serde_json::{Value, json};

/// Describe an environment: spaces, observations, rewards, success, model
#[derive(Args)]
#[command(after_help = "Ids of RoboHive need its models: robohive assets import PATH.

Examples:
  robohive info hive/FrankaReach-v0
  robohive info hive/FrankaReach-v0 --json | jq .observation")]
pub struct Info {
    /// The environment
    #[command(flatten)]
    source: Source,
    /// Print one JSON object instead
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(a: &Info) -> Result<(), Failure> {
    let spec = Registry::builtin().spec(&a.source.id).map_err(Failure::usage)?;
    // All or nothing: half of a description looks like the whole.
    let env = a.source.make()?;
    if a.json {
        let mut value = json!({
            "id": spec.id, "suite": spec.suite, "task": spec.task, "max_episode_steps": spec.max_episode_steps,
            "settings": serde_json::to_value(&spec.args).map_err(Failure::new)?,
        });
        describe_json(&env, &mut value);
        show_json(&value);
        return Ok(());
    }
    show!("id           {}", spec.id);
    show!("suite        {}, task {}", spec.suite, spec.task);
    show!("episode      {} steps", spec.max_episode_steps);
    for (name, value) in spec.args.iter() {
        show!("setting      {name} = {value}");
    }
    describe(&env);
    Ok(())
}

fn describe(env: &Env) {
    let m = &env.scene().model;
    show!(
        "model        nq {}, nv {}, nu {}, na {}, {} bodies, {} geoms",
        m.nq,
        m.nv,
        m.nu,
        m.na,
        m.nbody,
        m.ngeom
    );
    show!("period       {} s: {} time steps of {} s", env.dt(), env.frame_skip(), m.opt.timestep);
    show!("action       {} values, {}", env.action_len(), bounds(env));
    let [low, high] = env.settings().obs_range;
    show!("observation  {} values, declared {low} to {high}", env.observation().len());
    for key in env.obs_keys() {
        if let Some(row) = env.rows().rows().iter().find(|row| row.name() == key) {
            show!("  {:<28} {:>4}  {}", key, row.len(), row.unit());
        }
    }
    let further = env.rows().rows().iter().filter(|row| !env.obs_keys().iter().any(|key| key == row.name()));
    let further: Vec<_> = further.map(Row::name).collect();
    show!("also known   {}", further.join(", "));
    if let Some(keys) = env.proprio_keys() {
        show!("proprio      {}", keys.join(", "));
    }
    for key in env.visual_keys() {
        let shape: Vec<_> = key.shape().iter().map(ToString::to_string).collect();
        show!("image        {key:<36} {}, {}", shape.join(" x "), values(key));
    }
    show!("reward       the sum of");
    for (name, weight) in env.weights() {
        let unit = env.terms().rows().iter().find(|row| row.name() == name).map_or("", Row::unit);
        show!("  {weight:>10} x {name:<24} {unit}");
    }
    for agent in env.team().map_or(&[][..], Team::agents) {
        let observes: Vec<_> = agent.observes().map(|(name, _)| name).collect();
        let earns: Vec<_> = agent.earns().iter().map(|(term, weight)| format!("{weight} x {term}")).collect();
        let (commands, len) = (agent.commands().len(), agent.observation(env.rows()).len());
        show!("agent        {}: {commands} values of the action", agent.name());
        show!("  observes   {len} values: {}", observes.join(", "));
        show!("  earns      {}", earns.join(", "));
    }
    let success = match env.success() {
        Success::MoreThan(steps) => format!("solved in more than {steps} steps"),
        Success::Share => "share of the steps in which it is solved".into(),
    };
    show!("success      {success}");
}

/// What the values of an image are.
fn values(key: &VisualKey) -> &'static str {
    match key.channel {
        Channel::Depth => "depth in metres, float32",
        Channel::Rgb if key.is_encoded() => "features, float32",
        Channel::Rgb => "colours, uint8",
    }
}

fn bounds(env: &Env) -> String {
    if env.settings().normalize_act { "-1 to 1".into() } else { "the actuators' control ranges".into() }
}

fn describe_json(env: &Env, value: &mut Value) {
    let rows = |rows: &[Row]| -> Vec<Value> {
        rows.iter().map(|row| json!({"name": row.name(), "len": row.len(), "unit": row.unit()})).collect()
    };
    let m = &env.scene().model;
    value["model"] =
        json!({"nq": m.nq, "nv": m.nv, "nu": m.nu, "na": m.na, "nbody": m.nbody, "ngeom": m.ngeom});
    value["dt"] = env.dt().into();
    value["frame_skip"] = env.frame_skip().into();
    let action: Vec<_> = (0..env.action_len()).map(|k| env.action_bounds(k)).collect();
    value["action"] = json!(action);
    value["observation"] =
        json!({"len": env.observation().len(), "keys": env.obs_keys(), "rows": rows(env.rows().rows())});
    value["proprioception"] = json!(env.proprio_keys());
    let image =
        |key: &VisualKey| json!({"key": key.to_string(), "shape": key.shape(), "values": values(key)});
    value["images"] = env.visual_keys().iter().map(image).collect();
    let agent = |agent: &Agent| {
        let observes: Vec<_> =
            agent.observes().map(|(name, row)| json!({"name": name, "row": row})).collect();
        json!({"name": agent.name(), "action": agent.commands(), "observation": observes, "reward": agent.earns()})
    };
    value["agents"] = env.team().map_or(&[][..], Team::agents).iter().map(agent).collect();
    value["reward"] = json!({"terms": rows(env.terms().rows()), "weights": env.weights()});
}
