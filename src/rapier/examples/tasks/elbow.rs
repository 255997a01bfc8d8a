//! An elbow is brought to an angle by feedback: what its angle lacks excites the muscles that pull that way.

use env::Env;

/// Excitation of all muscles, as an action, that keeps the joint stiff.
const TONE: f64 = 0.2;
/// Action for an error of the angle \[1/rad\], for its integral \[1/(rad s)\], and against a velocity \[s/rad\].
const GAINS: [f64; 3] = [1.0, 2.0, 0.1];

/// Feedback during an episode.
pub struct Elbow {
    /// Whether each muscle bends the elbow: 1, or extends it: -1.
    pulls: Vec<f64>,
    /// Integral of the error \[rad s\].
    sum: f64,
}

impl Elbow {
    /// The muscles of an environment; extensors are those called triceps.
    pub fn new(env: &Env) -> Self {
        let pull = |name: &str| if name.starts_with("TRI") { -1.0 } else { 1.0 };
        Elbow { pulls: env.scene().model.actuator_names().map(|(_, name)| pull(name)).collect(), sum: 0.0 }
    }

    /// The action of the next step.
    pub fn act(&mut self, env: &Env) -> Vec<f64> {
        let [error, rate] = [env.rows()["pose_err"][0], env.scene().data.state.qvel[0]];
        self.sum += error * env.dt();
        let [proportional, integral, derivative] = GAINS;
        let effort = proportional * error + integral * self.sum - derivative * rate;
        self.pulls.iter().map(|pull| (TONE + pull * effort).clamp(-1.0, 1.0)).collect()
    }
}
