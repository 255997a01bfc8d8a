//! Muscles: how actions drive them, and the conditions that weaken or rewire them.

use crate::error::EnvError;
use crate::peak_force::{PEAK_FORCE, peak_force};
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::fatigue::Fatigue;
use crate::task::{Defaults, Setup, Turn, View};
use physics::Model;
use physics::elements::ActuatorId;
use physics::math::ops;
use physics::model::GainType;
use robot::{Compat, Keeper};
use serde::Deserialize;

/// Part of its peak force that a muscle keeps in sarcopenia.
const SARCOPENIA: f64 = 0.5;
/// The muscle that is left without control in a tendon transfer, and the one that takes it over.
pub const TRANSFER: [&str; 2] = ["EIP", "EPL"];
/// Bound of the rows of muscle velocity \[m/s\] and force \[kN\].
const OBSERVED_BOUND: f64 = 100.0;
/// Time steps of the physics in one step of a muscle task, where the id does not say.
const FRAME_SKIP: usize = 10;

/// What is wrong with the muscles of a subject.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Condition {
    /// Nothing.
    #[default]
    #[serde(rename = "")]
    None,
    /// Muscles have half of their peak force.
    Sarcopenia,
    /// Muscles lose force as they work.
    Fatigue,
    /// The extensor of the index finger pulls the thumb instead, after a tendon transfer.
    Reafferentation,
}

/// The muscles of a model in their condition. A task hands on what its own functions receive: [`Muscles::rest`] in
/// `reset`, [`Muscles::drive`] in `act`.
#[derive(Clone)]
pub struct Muscles {
    compat: Compat,
    /// Whether actions need a map of their own, as normalised actions of models with activations do.
    mapped: bool,
    /// Whether each actuator is a muscle.
    is_muscle: Vec<bool>,
    /// Number of activations.
    na: usize,
    state: State,
}

/// What a condition does while an episode runs.
#[derive(Clone)]
enum State {
    Sound,
    Fatigue(Fatigue),
    /// One actuator takes over the control of another, which is left without.
    Transfer {
        to: ActuatorId,
        from: ActuatorId,
    },
}

impl Muscles {
    /// The muscles of the model, with the condition imposed on it.
    ///
    /// # Errors
    /// The model lacks what the condition affects.
    pub fn new(condition: Condition, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let model = &setup.scene.model;
        let is_muscle: Vec<bool> =
            model.actuator_gaintype.iter().map(|&kind| kind == GainType::Muscle as i32).collect();
        if condition != Condition::None && !is_muscle.contains(&true) {
            return Err(setup.wrong("muscle_condition is for models with muscles, and this one has none"));
        }
        let na = model.na;
        let state = match condition {
            Condition::None => State::Sound,
            Condition::Sarcopenia => {
                weaken(setup.scene, setup.compat)?;
                State::Sound
            }
            Condition::Fatigue => State::Fatigue(Fatigue::new(model, setup.compat)),
            Condition::Reafferentation => {
                let [from, to] = TRANSFER.map(|name| setup.scene.actuator(name));
                State::Transfer { to: to?, from: from? }
            }
        };
        let mapped = na > 0 && setup.spec.settings()?.0.normalize_act;
        Ok(Muscles { compat: setup.compat, mapped, is_muscle, na, state })
    }

    /// Defaults of a muscle task: its rows, then the activations where there are any.
    pub fn defaults(&self, obs_keys: &[&str], weights: &[(&str, f64)]) -> Defaults {
        let mut defaults = Defaults { show_actuators: true, ..Defaults::new(obs_keys, weights, FRAME_SKIP) };
        if self.na > 0 && !obs_keys.contains(&"act") {
            defaults.obs_keys.push("act".into());
        }
        defaults
    }

    /// Writes or reads what muscles remember.
    pub fn keep(&mut self, keeper: &mut Keeper) {
        if let State::Fatigue(fatigue) = &mut self.state {
            fatigue.keep(keeper);
        }
    }

    /// Starts an episode. The original's fatigue goes on from the episode before.
    ///
    /// # Errors
    /// The model refuses the peak forces of rested muscles.
    pub fn rest(&mut self, scene: &mut Scene) -> Result<(), EnvError> {
        if let (State::Fatigue(fatigue), Compat::Fixed) = (&mut self.state, self.compat) {
            fatigue.rest();
            fatigue.impose(scene)?;
        }
        Ok(())
    }

    /// Turns an action into controls: of muscles, excitations; of other actuators, values within their range.
    ///
    /// # Errors
    /// The model refuses the peak forces that are left.
    pub fn drive(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        if self.compat == Compat::RoboHive07 {
            turn.action.copy_from_slice(turn.wanted);
        } else if self.mapped {
            for (k, action) in turn.action.iter_mut().enumerate() {
                *action = if self.is_muscle[k] {
                    excitation(*action)
                } else {
                    within_range(&turn.scene.model, k, *action)
                };
            }
        }
        turn.raw |= self.mapped;
        match &mut self.state {
            State::Sound => {}
            State::Fatigue(fatigue) => {
                fatigue.advance(&turn.scene.model, &turn.scene.data, turn.dt);
                fatigue.impose(turn.scene)?;
            }
            State::Transfer { to, from } => {
                turn.action[to.index()] = std::mem::take(&mut turn.action[from.index()]);
            }
        }
        Ok(())
    }
}

/// Writes the row `act`, the activations, where there are any.
pub fn observe_activations(view: &View<'_>, rows: &mut Rows) {
    if view.model.na > 0 {
        rows.set("act", "", &view.data.state.act);
    }
}

/// Writes lengths, velocities and forces of the muscles, the latter two bounded.
pub fn observe_muscles(view: &View<'_>, rows: &mut Rows) {
    let bounded = |value: f64| value.clamp(-OBSERVED_BOUND, OBSERVED_BOUND);
    let data = view.data;
    rows.set("muscle_length", "m", &data.trn.actuator_length);
    rows.set("muscle_velocity", "m/s", data.vel.actuator_velocity.iter().map(|&velocity| bounded(velocity)));
    rows.set("muscle_force", "kN", data.actuation.actuator_force.iter().map(|force| bounded(force / 1000.0)));
}

/// Length of the vector of activations over their number, by the row `act`.
pub fn effort(rows: &Rows) -> f64 {
    match rows.get("act") {
        Some(activations) if !activations.is_empty() => norm(activations) / activations.len() as f64,
        _ => 0.0,
    }
}

/// The normalised action that gives an actuator of a task of muscles this control, or the nearest one: the inverse of what
/// [`Muscles::drive`] does where the model has activations.
pub fn normalized(model: &Model, actuator: usize, control: f64) -> f64 {
    let [low, high] = model.actuator_ctrlrange[actuator];
    let action = if model.actuator_gaintype[actuator] == GainType::Muscle as i32 {
        let [least, most] = [-1.0, 1.0].map(excitation);
        let excited = control.clamp(least, most);
        0.5 + ops::log(excited / (1.0 - excited)) / 5.0
    } else if high > low {
        (2.0 * control - low - high) / (high - low)
    } else {
        control
    };
    action.clamp(-1.0, 1.0)
}

/// A normalised action as an excitation between 0 and 1.
fn excitation(action: f64) -> f64 {
    1.0 / (1.0 + ops::exp(-5.0 * (action - 0.5)))
}

/// A normalised action as a control; an actuator without a range takes it as it is.
fn within_range(model: &Model, actuator: usize, action: f64) -> f64 {
    let [low, high] = model.actuator_ctrlrange[actuator];
    if high > low { (low + high) / 2.0 + action * (high - low) / 2.0 } else { action }
}

/// Halves peak forces. The original halves the parameter, which leaves a muscle that takes its force from the model as
/// strong as it was.
fn weaken(scene: &mut Scene, compat: Compat) -> Result<(), EnvError> {
    for k in 0..scene.model.nactuator {
        let parameter = match compat {
            Compat::RoboHive07 => scene.model.actuator_gainprm[k][PEAK_FORCE],
            Compat::Fixed if scene.model.actuator_gaintype[k] == GainType::Muscle as i32 => {
                peak_force(&scene.model, k)
            }
            Compat::Fixed => continue,
        };
        scene.overwrite(|m| m.actuator_gainprm[k][PEAK_FORCE] = SARCOPENIA * parameter)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assets::OwnModels;
    use crate::draws::Rng;
    use crate::spec::Spec;

    /// Two muscles, one that states its peak force and one that does not, and a motor.
    const LIMB: &str = "<mujoco>
        <worldbody><body><joint name='hinge' axis='0 1 0'/><geom size='.1' pos='.3 0 0'/></body></worldbody>
        <actuator>
            <muscle name='EPL' joint='hinge' lengthrange='-1 1' ctrllimited='true' ctrlrange='0 1' force='40'/>
            <muscle name='EIP' joint='hinge' lengthrange='-1 1' ctrllimited='true' ctrlrange='0 1' scale='200'/>
            <motor name='motor' joint='hinge' ctrllimited='true' ctrlrange='-2 4'/>
        </actuator></mujoco>";

    fn limb(condition: Condition, compat: Compat) -> (Scene, Muscles) {
        let mut scene = Scene::new(mjcf::load_str(LIMB).unwrap().model).unwrap();
        let args = "model_path = 'limb.xml'".parse().unwrap();
        let spec = Spec {
            id: "limb-v0".into(),
            suite: "test".into(),
            task: "none".into(),
            max_episode_steps: 1,
            args,
        };
        let mut rng = Rng::pcg64(0_u64);
        let mut setup =
            Setup { spec: &spec, assets: &OwnModels, scene: &mut scene, compat, rng: &mut rng, config: None };
        let muscles = Muscles::new(condition, &mut setup).unwrap();
        (scene, muscles)
    }

    /// What the muscles make of an action, and whether it goes to the actuators as it is.
    fn driven(scene: &mut Scene, muscles: &mut Muscles, wanted: [f64; 3]) -> ([f64; 3], bool) {
        let mut action = wanted.map(|value| value.clamp(-1.0, 1.0));
        let mut rng = Rng::pcg64(0_u64);
        let mut turn = Turn {
            scene,
            rng: &mut rng,
            wanted: &wanted,
            action: &mut action,
            raw: false,
            dt: 0.02,
            steps: 0,
        };
        muscles.drive(&mut turn).unwrap();
        let raw = turn.raw;
        (action, raw)
    }

    #[test]
    fn actions_become_excitations_and_controls() {
        let (mut scene, mut muscles) = limb(Condition::None, Compat::Fixed);
        let (control, raw) = driven(&mut scene, &mut muscles, [0.5, 7.0, 1.0]);
        assert_eq!((control[0], control[2], raw), (0.5, 4.0, true));
        assert!((control[1] - 1.0 / (1.0 + (-2.5_f64).exp())).abs() < 1e-15);
        let (mut scene, mut muscles) = limb(Condition::None, Compat::RoboHive07);
        assert_eq!(driven(&mut scene, &mut muscles, [0.5, 7.0, -1.0]), ([0.5, 7.0, -1.0], true));
    }

    #[test]
    fn a_transferred_tendon_follows_the_other_muscle() {
        let (mut scene, mut muscles) = limb(Condition::Reafferentation, Compat::RoboHive07);
        assert_eq!(driven(&mut scene, &mut muscles, [0.1, 0.8, 0.3]).0, [0.8, 0.0, 0.3]);
    }

    #[test]
    fn sarcopenia_halves_the_force_of_every_muscle() {
        let (sound, _) = limb(Condition::None, Compat::Fixed);
        let (weak, _) = limb(Condition::Sarcopenia, Compat::Fixed);
        for muscle in [0, 1] {
            assert_eq!(peak_force(&weak.model, muscle), peak_force(&sound.model, muscle) / 2.0);
        }
        let (original, _) = limb(Condition::Sarcopenia, Compat::RoboHive07);
        assert_eq!(peak_force(&original.model, 0), 20.0);
        assert_eq!(peak_force(&original.model, 1), peak_force(&sound.model, 1), "still that of the model");
    }

    #[test]
    fn fatigue_follows_work_and_ends_with_the_episode() {
        let (mut scene, mut muscles) = limb(Condition::Fatigue, Compat::Fixed);
        let rested = peak_force(&scene.model, 0);
        scene.data.state.act[0] = 1.0;
        scene.forward().unwrap();
        let force = scene.data.actuation.actuator_force[0].abs();
        assert!(force > 0.0);
        driven(&mut scene, &mut muscles, [1.0; 3]);
        let expected = rested * (-force * 0.02 / 60.0 / rested).exp();
        assert!((peak_force(&scene.model, 0) - expected).abs() < 1e-12);
        muscles.rest(&mut scene).unwrap();
        assert_eq!(peak_force(&scene.model, 0), rested);
    }
}
