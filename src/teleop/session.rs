//! A session: episode after episode that a person drives, tick by tick, without a clock, a terminal or a file.

use crate::error::TeleopError;
use crate::handover::{Handover, INTERVENTION};
use crate::mapping::Mapping;
use crate::moments::{Moment, Moments};
use crate::motion::{Input, Mark};
use crate::pilot::{Control, Pilot};
use crate::plan::{Finished, Plan, Ticked};
use crate::reached::Reached;
use agents::Policy;
use env::Env;
use record::Kept;
use robot::ActionMode;

/// The dataset of a trial with the person's judgement: 1 for success, 0 for failure.
pub const JUDGED: &str = "teleop/success";

/// Episode after episode that a person drives.
pub struct Session {
    env: Env,
    pilot: Pilot,
    handover: Option<Handover>,
    plan: Plan,
    seed: u64,
    kept: Kept,
    moments: Moments,
    paused: bool,
    slow: bool,
    reward: f64,
    solved: usize,
    /// Finished episodes, and those of them that succeeded.
    counts: (usize, usize),
}

impl Session {
    /// Resets the environment for the first episode. Time is paused until there is a motion. On hardware the robot holds its position: see
    /// [`Session::tick`].
    ///
    /// # Errors
    /// The reset fails, or there is nothing to drive; hardware in another mode than positions, which would continue to
    /// move without input.
    pub fn new(mut env: Env, control: Control, mapping: &Mapping, plan: Plan) -> Result<Self, TeleopError> {
        if env.is_live() && env.robot().options().mode != ActionMode::Position {
            return Err(TeleopError::Control {
                message: format!(
                    "hardware cannot be teleoperated in the action mode '{}', in which it moves without input: add --set act_mode=pos",
                    env.robot().options().mode
                ),
            });
        }
        env.reset(Some(plan.seed))?;
        let pilot = Pilot::new(&env, control, mapping)?;
        let kept = Kept::new(plan.seed);
        let mut session = Session {
            env,
            pilot,
            handover: None,
            seed: plan.seed,
            plan,
            kept,
            moments: Moments::default(),
            paused: true,
            slow: false,
            reward: 0.0,
            solved: 0,
            counts: (0, 0),
        };
        let first = session.moment();
        session.moments.begin(first);
        Ok(session)
    }

    /// Shares control with a policy, which acts first: any motion of the person, or [`Mark::Policy`], takes control, and this mark hands
    /// it back. Rows then record who acted, see [`INTERVENTION`]; random actions depend on the seed of each episode.
    ///
    /// # Errors
    /// The reset fails.
    pub fn with_policy(mut self, policy: &Policy) -> Result<Self, TeleopError> {
        self.handover = Some(Handover::new(policy, self.seed));
        self.moments.begin(self.moment());
        Ok(self)
    }

    /// Begins an episode from the reset of the present seed.
    fn begin(&mut self) -> Result<(), TeleopError> {
        self.env.reset(Some(self.seed))?;
        self.pilot.begin(&self.env)?;
        if let Some(handover) = &mut self.handover {
            handover.begin(self.seed);
        }
        self.kept = Kept::new(self.seed);
        (self.reward, self.solved, self.paused) = (0.0, 0, true);
        self.moments.begin(self.moment());
        Ok(())
    }

    fn moment(&self) -> Moment {
        Moment {
            env: self.env.state(),
            pilot: self.pilot.clone(),
            handover: self.handover.clone(),
            reward: self.reward,
            solved: self.solved,
        }
    }

    /// One tick: marks first, then a step of the environment unless time is paused. Any motion ends a pause. During a
    /// pause the last command to hardware is repeated ([`Env::hold`]), so that watchdogs do not trip; when a
    /// session hangs or dies, they make the devices safe.
    ///
    /// # Errors
    /// The environment, its robot or its pictures refuse.
    pub fn tick(&mut self, input: &Input) -> Result<Ticked, TeleopError> {
        let mut ticked = Ticked::default();
        for &mark in &input.marks {
            self.mark(mark, &mut ticked)?;
            if ticked.over || ticked.finished.is_some() || ticked.discarded {
                return Ok(ticked);
            }
        }
        let rewinds = !self.env.is_live() && input.marks.iter().any(|mark| mark.repeats());
        if input.motion.moves() && !rewinds && !input.marks.contains(&Mark::Pause) {
            self.paused = false;
        }
        if !rewinds && self.handover.as_mut().is_some_and(|handover| handover.takes_over(&input.motion)) {
            self.pilot.take_over(&self.env)?;
        }
        if !self.paused && !rewinds {
            self.step(input, &mut ticked)?;
        } else {
            self.pilot.let_go();
            self.env.hold()?;
        }
        Ok(ticked)
    }

    fn mark(&mut self, mark: Mark, ticked: &mut Ticked) -> Result<(), TeleopError> {
        let second = (1.0 / self.env.dt()).round().max(1.0) as isize;
        match mark {
            Mark::Slow | Mark::Back | Mark::Forward | Mark::BackSecond | Mark::ForwardSecond
                if self.env.is_live() =>
            {
                ticked.impossible.get_or_insert(mark);
            }
            Mark::Success => self.finish(true, ticked)?,
            Mark::Failure => self.finish(false, ticked)?,
            Mark::Discard => {
                self.begin()?;
                ticked.discarded = true;
            }
            Mark::Skip => {
                self.seed = self.seed.wrapping_add(1);
                self.begin()?;
                ticked.discarded = true;
            }
            Mark::Pause => self.paused = !self.paused,
            Mark::Slow => self.slow = !self.slow,
            Mark::Back => self.go(-1)?,
            Mark::Forward => self.go(1)?,
            Mark::BackSecond => self.go(-second)?,
            Mark::ForwardSecond => self.go(second)?,
            Mark::Policy => match self.handover.as_mut().map(Handover::hand_over) {
                Some(true) => self.pilot.take_over(&self.env)?,
                Some(false) => {}
                None => ticked.impossible = Some(mark),
            },
            Mark::End => ticked.over = true,
        }
        Ok(())
    }

    /// Shows another state of the episode, and pauses time.
    fn go(&mut self, by: isize) -> Result<(), TeleopError> {
        self.paused = true;
        if let Some(moment) = self.moments.go(by) {
            self.env.set_state(&moment.env)?;
            (self.pilot, self.handover) = (moment.pilot.clone(), moment.handover.clone());
            (self.reward, self.solved) = (moment.reward, moment.solved);
        }
        Ok(())
    }

    fn step(&mut self, input: &Input, ticked: &mut Ticked) -> Result<(), TeleopError> {
        let policy = self.handover.as_mut().map(|handover| handover.action(&self.env)).transpose()?.flatten();
        let (action, reached) = match policy {
            Some(action) => (action, Reached::Yes),
            None => self.pilot.act(&mut self.env, &input.motion)?,
        };
        let action = action.to_vec();
        ticked.refused = Some(reached).filter(|reached| *reached != Reached::Yes);
        // Later states are removed from the episode.
        self.kept.truncate(self.moments.at());
        self.keep(&action, self.by_hand() == Some(true))?;
        let step = self.env.step(&action)?;
        if let Some(fault) = step.fault {
            ticked.fault = Some(fault.to_string());
            if self.env.is_live() {
                ticked.discarded = true;
                return self.begin();
            }
            let seed = self.seed;
            self.env.reset(Some(seed))?;
            return self.return_to_last();
        }
        (ticked.stepped, ticked.by_hand) = (true, self.by_hand());
        self.reward += step.reward;
        self.solved = if self.env.verdict().solved { self.solved + 1 } else { 0 };
        self.moments.push(self.moment());
        let steps = self.moments.at();
        if self.plan.solved_for > 0 && self.solved >= self.plan.solved_for {
            return self.finish(true, ticked);
        }
        if step.terminated || (self.plan.horizon > 0 && steps >= self.plan.horizon) {
            return self.finish(self.env.verdict().solved, ticked);
        }
        Ok(())
    }

    /// Keeps the row of the present state.
    fn keep(&mut self, action: &[f64], by_hand: bool) -> Result<(), TeleopError> {
        if self.plan.images {
            self.env.exteroception()?;
        }
        self.kept.row(&self.env, action)?;
        if self.handover.is_some() {
            self.kept.flag(INTERVENTION, by_hand)?;
        }
        Ok(())
    }

    /// An episode of one step that holds the position after the reset, as an example of the data of an episode.
    ///
    /// # Errors
    /// A picture cannot be drawn.
    pub fn example(&mut self) -> Result<Kept, TeleopError> {
        let (rest, kept) = (vec![0.0; self.env.action_len()], self.kept.clone());
        self.keep(&rest, false)?;
        self.keep(&rest, false)?;
        let mut example = std::mem::replace(&mut self.kept, kept);
        example.note(JUDGED, 0);
        Ok(example)
    }

    /// Restores the state that is shown, after a step from it failed.
    fn return_to_last(&mut self) -> Result<(), TeleopError> {
        let back = self.moments.at();
        self.moments.go(-1);
        self.go((back - self.moments.at()).cast_signed())?;
        if back == 0 { self.begin() } else { Ok(()) }
    }

    /// Completes the episode at the state that is shown, and begins the next. An episode without a step is not kept.
    fn finish(&mut self, success: bool, ticked: &mut Ticked) -> Result<(), TeleopError> {
        let steps = self.moments.at();
        if steps == 0 {
            return Ok(());
        }
        self.kept.truncate(steps);
        self.keep(&vec![f64::NAN; self.env.action_len()], false)?;
        let mut kept = std::mem::take(&mut self.kept);
        kept.note(JUDGED, u8::from(success));
        ticked.finished = Some(Finished { kept, seed: self.seed, success, steps, reward: self.reward });
        self.counts.0 += 1;
        self.counts.1 += usize::from(success);
        self.seed = self.seed.wrapping_add(1);
        ticked.over |= self.plan.episodes > 0 && self.counts.0 >= self.plan.episodes;
        self.begin()
    }

    /// The environment.
    pub fn env(&self) -> &Env {
        &self.env
    }

    /// The pilot.
    pub fn pilot(&self) -> &Pilot {
        &self.pilot
    }

    /// Whether the person acts; `None` without a policy.
    pub fn by_hand(&self) -> Option<bool> {
        self.handover.as_ref().map(Handover::by_hand)
    }

    /// Whether time is paused.
    pub fn is_paused(&self) -> bool {
        self.paused
    }

    /// Duration of a tick \[s\].
    pub fn period(&self) -> f64 {
        self.env.dt() * if self.slow { 4.0 } else { 1.0 }
    }

    /// Finished episodes, and those of them that succeeded.
    pub fn counts(&self) -> (usize, usize) {
        self.counts
    }

    /// Seed of the episode.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Number of steps before the state that is shown, and after it.
    pub fn steps(&self) -> (usize, usize) {
        (self.moments.at(), self.moments.ahead())
    }

    /// The status line of the episode.
    pub fn line(&self) -> String {
        let ((kept, good), (steps, ahead)) = (self.counts, self.steps());
        let time = steps as f64 * self.env.dt();
        let mut line = format!("episode {}  seed {}  {time:.1} s", kept + 1, self.seed);
        if ahead > 0 {
            line += &format!(" (-{:.1} s)", ahead as f64 * self.env.dt());
        }
        line += &format!("  reward {:.2}", self.reward);
        line += if self.env.verdict().solved { "  solved" } else { "  open" };
        for (arm, hand) in self.pilot.arms().iter().zip(["hand", "left"]) {
            let [x, y, z] = self.env.scene().data.kin.site_xpos[arm.site().index()];
            line += &format!("  {hand} {x:.3} {y:.3} {z:.3} m");
        }
        line += &format!("  {good} of {kept} succeeded");
        match self.by_hand() {
            Some(true) => line += "  BY HAND",
            Some(false) => line += "  policy acts",
            None => {}
        }
        if self.slow {
            line += "  slow";
        }
        if self.paused {
            line += "  PAUSED";
        }
        line
    }
}
