//! Two arms and a load that both can grip: a plan of motions, stage by stage, each from where the load is when it begins.

use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::follower::Follower;
use crate::tasks::arms::frame::Frame;
use env::Env;
use env::team::prefix;
use physics::elements::{BodyId, SiteId};
use physics::math::{Quat, Vec3, add, norm, ops, quat_mul, sub};

/// Height over a grip from which a hand comes down, and to which it goes back \[m\].
const ABOVE: f64 = 0.12;
/// Height to which a tray is lifted before it is carried \[m\].
const LIFT: f64 = 0.1;
/// Where the middle of a bar is when it is handed over \[m\].
const MEETING: Vec3 = [0.0, 0.475, 1.05];

/// Time in which what the load is off its target is made up for \[s\].
const CORRECTION: f64 = 0.5;

/// Begins the motions of a stage, of which the last comes again; its length \[s\].
type Plan = fn(&mut PairArms, &Env) -> Result<f64, ControlError>;

/// The controller.
pub struct PairArms {
    arms: [Follower; 2],
    /// How their tools are turned when the arms are at home, where they point down.
    down: [Quat; 2],
    load: BodyId,
    grips: [SiteId; 2],
    target: SiteId,
    plan: Plan,
    stage: usize,
    /// When the stage ends.
    until: f64,
    controls: Vec<f64>,
}

impl PairArms {
    /// The controller of a task for two arms.
    ///
    /// # Errors
    /// An environment for another number of agents; what [`Arm::of_several`] refuses; a model without a body `load`, grips, or a target.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let scene = env.scene();
        let agents = env.team().map_or(&[][..], |team| team.agents());
        let [left, right] = agents else {
            return Err(ControlError::unfit(env, format!("it has {} agents, not two", agents.len())));
        };
        let names = [left.name(), right.name()].map(prefix);
        let grip = |prefix: &str| scene.site(&format!("{prefix}grip"));
        let arm = |prefix: &str| Arm::of_several(env, prefix, "pair_arms");
        let arms = [arm(&names[0])?, arm(&names[1])?];
        Ok(PairArms {
            down: arms.each_ref().map(|arm| arm.home(&scene.model).turn),
            arms: arms.map(|arm| Follower::new(env, arm)),
            load: scene.body("load")?,
            grips: [grip(&names[0])?, grip(&names[1])?],
            target: scene.site("target")?,
            plan: if env.spec().task == "carry_tray" { carry } else { hand_over },
            stage: 0,
            until: 0.0,
            controls: vec![0.0; scene.model.nu],
        })
    }

    /// The load's grip for the arm of a number, as the frame of a tool that points down on it.
    fn grip(&self, env: &Env, number: usize) -> Frame {
        let kin = &env.scene().data.kin;
        let axes = kin.xmat[self.load.index()];
        let (sine, cosine) = ops::sincos(ops::angle(axes[3], axes[0]) / 2.0);
        let turn = quat_mul([cosine, 0.0, 0.0, sine], self.down[number]);
        Frame { place: kin.site_xpos[self.grips[number].index()], turn }
    }

    /// The way that the load still has to go \[m\].
    fn way(&self, env: &Env) -> Vec3 {
        let kin = &env.scene().data.kin;
        sub(kin.site_xpos[self.target.index()], kin.xpos[self.load.index()])
    }

    /// Moves the tool of an arm over its grip, `height` above it.
    fn reach(&mut self, env: &Env, number: usize, height: f64, seconds: f64) -> Result<(), ControlError> {
        let grip = self.grip(env, number);
        self.arms[number].go(env, grip.moved([0.0, 0.0, height]), seconds)
    }

    /// Moves the tool of an arm by a way \[m\], pointing down.
    fn shift(&mut self, env: &Env, number: usize, way: Vec3, seconds: f64) -> Result<(), ControlError> {
        let place = add(self.arms[number].arm.tool(env).place, way);
        self.arms[number].go(env, Frame { place, turn: self.down[number] }, seconds)
    }

    /// The same for both arms.
    fn both(
        &mut self,
        mut each: impl FnMut(&mut Self, usize) -> Result<(), ControlError>,
    ) -> Result<(), ControlError> {
        (0..2).try_for_each(|number| each(self, number))
    }
}

/// Both hands grip the tray, lift it, and carry it to its target.
fn carry(arms: &mut PairArms, env: &Env) -> Result<f64, ControlError> {
    let time = [1.5, 0.8, 0.5, 1.5, 2.5].get(arms.stage).copied().unwrap_or(CORRECTION);
    match arms.stage {
        0 => arms.both(|arms, k| arms.reach(env, k, ABOVE, time))?,
        1 => arms.both(|arms, k| arms.reach(env, k, 0.0, time))?,
        2 => arms.arms.iter_mut().for_each(|arm| arm.opening = 0.0),
        3 => arms.both(|arms, k| arms.shift(env, k, [0.0, 0.0, LIFT], time))?,
        _ => {
            let way = arms.way(env);
            arms.both(|arms, k| arms.shift(env, k, way, time))?;
        }
    }
    Ok(time)
}

/// The left hand takes the bar and holds it in the middle; the right hand grips it, and brings it to its target.
fn hand_over(arms: &mut PairArms, env: &Env) -> Result<f64, ControlError> {
    let seconds = [1.5, 0.8, 0.5, 1.6, 1.5, 0.8, 0.5, 0.4, 0.8, 1.6];
    let time = seconds.get(arms.stage).copied().unwrap_or(CORRECTION);
    match arms.stage {
        0 => arms.reach(env, 0, ABOVE, time)?,
        1 => arms.reach(env, 0, 0.0, time)?,
        2 => arms.arms[0].opening = 0.0,
        3 => {
            // Where the bar lies along y, its grip is as far from its middle as it is now.
            let kin = &env.scene().data.kin;
            let grip = kin.site_xpos[arms.grips[0].index()];
            let far = norm(sub(grip, kin.xpos[arms.load.index()]));
            let meeting = Frame { place: sub(MEETING, [0.0, far, 0.0]), turn: arms.down[0] };
            arms.arms[0].go(env, meeting, time)?;
        }
        4 => arms.reach(env, 1, ABOVE, time)?,
        5 => arms.reach(env, 1, 0.0, time)?,
        6 => arms.arms[1].opening = 0.0,
        7 => arms.arms[0].opening = 1.0,
        8 => arms.shift(env, 0, [0.0, 0.0, ABOVE], time)?,
        _ => {
            let way = arms.way(env);
            arms.shift(env, 1, way, time)?;
        }
    }
    Ok(time)
}

impl Controller for PairArms {
    fn reset(&mut self, env: &Env, _: u64) -> Result<(), ControlError> {
        (self.stage, self.until) = (0, env.scene().data.time());
        self.arms.iter_mut().for_each(|arm| arm.restart(env));
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let now = env.scene().data.time();
        if now >= self.until {
            self.until = now + (self.plan)(self, env)?;
            self.stage += 1;
        }
        for arm in &mut self.arms {
            arm.act(env, &mut self.controls);
        }
        command(env, &self.controls, action)
    }
}
