//! Tag: a pair of legs that walks catches an opponent, or escapes from one.

mod noise;
mod opponent;
mod relief;
mod repeller;
mod settings;
mod start;
mod terrain;
mod window;

use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::{euler_of_quat, norm};
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::muscle::{Condition, Muscles, effort, observe_activations, observe_muscles};
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use opponent::Opponent;
use physics::elements::{BodyId, GeomId, SensorId, SiteId};
use robot::{Compat, Keeper};
use settings::{Args, Choice};
use start::Start;
use terrain::{Terrain, flatten};

/// Length of a game \[s\].
const GAME: f64 = 20.0;
/// Distance from the middle, along x or y, beyond which the agent is out \[m\].
const OUT: f64 = 6.5;
/// Height of the pelvis below which the agent has fallen on flat ground \[m\].
const FALLEN_PELVIS: f64 = 0.5;
/// Height of the head above the feet below which it has fallen elsewhere \[m\].
const FALLEN_HEAD: f64 = 0.2;
/// Where unused ground is put \[m\].
const BELOW: [f64; 3] = [0.0, 0.0, -10.0];
/// Coordinates of the root: positions and degrees of freedom.
const ROOT: [usize; 2] = [7, 6];

/// What the agent has to do in an episode, by the original's numbers.
#[derive(Clone, Copy, PartialEq)]
enum Role {
    Chase = 0,
    Evade = 1,
}

/// Parts of the agent.
#[derive(Clone)]
struct Agent {
    pelvis: BodyId,
    feet: [BodyId; 2],
    head: SiteId,
    /// Touch sensors of feet and toes.
    touch: [SensorId; 4],
    ground: GeomId,
}

#[derive(Clone)]
pub struct ChaseTag {
    compat: Compat,
    muscles: Muscles,
    agent: Agent,
    opponent: Opponent,
    /// Pose and velocity of the opponent that the first observation of an episode shows in the original: where the model has it,
    /// and as it last moved.
    before: Option<([f64; 3], [f64; 2])>,
    terrain: Option<Terrain>,
    start: Start,
    choice: Choice,
    role: Role,
    catch: f64,
}

impl ChaseTag {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings are wrong, the model lacks agent, opponent or ground, or the relief is missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let opponent = args.opponent().map_err(|message| setup.wrong(message))?;
        let muscles = Muscles::new(Condition::None, setup)?;
        let agent = Agent::new(setup.scene)?;
        if let Some(keys) = args.reset_type.missing_keys(&setup.scene.model) {
            return Err(setup.wrong(keys));
        }
        let mut terrain = args.ground(setup, setup.assets).map_err(|message| setup.wrong(message))?;
        if let Some(terrain) = &mut terrain {
            draw_ground(terrain, setup.scene, setup.rng)?;
        }
        Ok(ChaseTag {
            compat: setup.compat,
            muscles,
            agent,
            opponent: Opponent::new(opponent, setup.scene, setup.rng)?,
            before: None,
            terrain,
            start: args.reset_type,
            choice: args.task_choice,
            role: Role::Chase,
            catch: args.win_distance,
        })
    }
}

impl Agent {
    fn new(scene: &Scene) -> Result<Self, EnvError> {
        let touch = |name| scene.sensor(name);
        Ok(Agent {
            pelvis: scene.body("pelvis")?,
            feet: [scene.body("talus_l")?, scene.body("talus_r")?],
            head: scene.site("head")?,
            touch: [touch("r_foot")?, touch("r_toes")?, touch("l_foot")?, touch("l_toes")?],
            ground: scene.geom("terrain")?,
        })
    }
}

fn draw_ground(terrain: &mut Terrain, scene: &mut Scene, rng: &mut Rng) -> Result<(), EnvError> {
    let mut outcome = Ok(());
    scene.overwrite(|m| outcome = terrain.draw(&mut m.hfield_data, rng))?;
    outcome
}

impl ChaseTag {
    /// Where the opponent is, and how it moved, as observed.
    fn opponent(&self, view: &View<'_>) -> ([f64; 3], [f64; 2]) {
        self.before.unwrap_or_else(|| (self.opponent.pose(view.data), self.opponent.velocity()))
    }

    fn fallen(&self, view: &View<'_>) -> bool {
        match self.terrain {
            None => view.data.body(self.agent.pelvis).xpos()[2] < FALLEN_PELVIS,
            Some(_) => {
                let feet: f64 = self.agent.feet.iter().map(|&foot| view.data.body(foot).xpos()[2]).sum();
                view.data.site(self.agent.head).xpos()[2] - feet / 2.0 < FALLEN_HEAD
            }
        }
    }

    /// Whether the agent has won, and whether it has lost.
    fn outcome(&self, view: &View<'_>, rows: &Rows) -> (bool, bool) {
        let over = rows["time"][0] >= GAME;
        let [x, y, _] = *view.data.body(self.agent.pelvis).xpos();
        let opponent = &rows["opponent_pose"];
        let caught = norm(&[x - opponent[0], y - opponent[1]]) <= self.catch;
        let out = x.abs() > OUT || y.abs() > OUT;
        match self.role {
            Role::Chase => (caught, over || out || self.fallen(view)),
            Role::Evade => (over, caught || out),
        }
    }
}

impl Task for ChaseTag {
    fn defaults(&self) -> Defaults {
        let keys = [
            "internal_qpos",
            "internal_qvel",
            "grf",
            "torso_angle",
            "opponent_pose",
            "opponent_vel",
            "model_root_pos",
            "model_root_vel",
            "muscle_length",
            "muscle_velocity",
            "muscle_force",
        ];
        self.muscles.defaults(&keys, &[("distance", -0.1), ("lose", -1000.0)])
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        start::set_key(&scene.model, 0, pose);
        pose.qvel.fill(0.0);
        Ok(())
    }

    fn seed(&mut self, seed: u64) {
        if let Some(terrain) = &mut self.terrain {
            terrain.seed(seed);
        }
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.muscles.rest(episode.scene)?;
        let scene = &mut *episode.scene;
        let ground = self.agent.ground.index();
        match &mut self.terrain {
            None => scene.overwrite(|m| m.geom_pos[ground] = BELOW),
            Some(terrain) => {
                draw_ground(terrain, scene, episode.rng)?;
                scene.overwrite(|m| m.geom_pos[ground] = [0.0; 3])
            }
        }?;
        self.role = match self.choice {
            Choice::Chase => Role::Chase,
            Choice::Evade => Role::Evade,
            Choice::Random => *episode.rng.choose(&[Role::Chase, Role::Evade])?,
        };
        self.start.draw(&scene.model, episode.start, episode.rng, self.compat)?;
        if self.terrain.is_some() {
            let place = [episode.start.qpos[0], episode.start.qpos[1]];
            scene.overwrite(|m| flatten(&mut m.hfield_data, place))?;
        }
        Ok(())
    }

    fn begin(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let seen = (self.opponent.pose(&episode.scene.data), self.opponent.velocity());
        self.before = (self.compat == Compat::RoboHive07).then_some(seen);
        self.opponent.reset(self.role == Role::Evade, episode.scene, episode.rng)
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.before = None;
        self.opponent.advance(&mut turn.scene.data, turn.rng, turn.dt)?;
        self.muscles.drive(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (state, data) = (&view.data.state, view.data);
        let [positions, speeds] = ROOT;
        rows.set("internal_qpos", "rad", &state.qpos[positions..]);
        rows.set("internal_qvel", "rad", state.qvel[speeds..].iter().map(|speed| speed * view.dt));
        rows.set("grf", "N", self.agent.touch.iter().map(|&sensor| data.sensor(sensor).data()[0]));
        rows.set("torso_angle", "", data.body(self.agent.pelvis).xquat());
        observe_muscles(view, rows);
        observe_activations(view, rows);
        let (pose, velocity) = self.opponent(view);
        rows.set("opponent_pose", "m, rad", pose);
        rows.set("opponent_vel", "m/s, rad/s", velocity);
        rows.set("model_root_pos", "m", &state.qpos[..2]);
        rows.set("model_root_vel", "m/s", &state.qvel[..2]);
        rows.set("task", "", [f64::from(self.role as u8)]);
        if self.terrain.is_some() {
            let [x, y, _, w, i, j, k, ..] = state.qpos[..] else { return };
            let heading = euler_of_quat([w, i, j, k])[2];
            rows.set("hfield", "m", window::heights(&view.model.hfield_data, [x, y], heading));
        }
    }

    fn reward(&self, view: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (won, lost) = self.outcome(view, rows);
        let (root, opponent) = (&rows["model_root_pos"], &rows["opponent_pose"]);
        terms.set("act_reg", "", [effort(rows)]);
        terms.set("distance", "m", [norm(&[root[0] - opponent[0], root[1] - opponent[1]])]);
        terms.set("lose", "", [f64::from(lost)]);
        // Time to hundredths of a second.
        let share = (rows["time"][0] * 100.0).round_ties_even() / 100.0 / GAME;
        let sparse = match self.role {
            Role::Chase if won => 1.0 - share,
            Role::Evade if won || lost => share,
            _ => 0.0,
        };
        Verdict { sparse, solved: won, done: won || lost }
    }

    fn rewards_paths(&self) -> bool {
        false
    }

    fn resting_rows(&self) -> Vec<String> {
        vec!["opponent_vel".into()]
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.muscles.keep(keeper);
        self.opponent.keep(keeper);
        let (mut known, (mut pose, mut velocity)) = (self.before.is_some(), self.before.unwrap_or_default());
        keeper.flag(&mut known);
        keeper.numbers(&mut pose);
        keeper.numbers(&mut velocity);
        self.before = known.then_some((pose, velocity));
        keeper.choice(&mut self.role, &[Role::Chase, Role::Evade]);
        if let Some(terrain) = &mut self.terrain {
            terrain.keep(keeper);
        }
    }
}
