//! How fast simulated time goes by, beside real time.

/// Speeds that can be chosen \[% of real time\], as MuJoCo's viewer has them.
pub const SPEEDS: [f64; 31] = [
    100.0, 80.0, 63.0, 50.0, 40.0, 32.0, 25.0, 20.0, 16.0, 13.0, 10.0, 8.0, 6.3, 5.0, 4.0, 3.2, 2.5, 2.0,
    1.6, 1.3, 1.0, 0.8, 0.63, 0.5, 0.4, 0.32, 0.25, 0.2, 0.16, 0.13, 0.1,
];

/// Simulated seconds behind the wanted time beyond which the difference is given up.
const GIVE_UP: f64 = 0.1;
/// Real seconds over which the speed is measured.
const WINDOW: f64 = 0.5;

/// The chosen speed, and how far the simulation is behind it.
#[derive(Clone, Debug)]
pub struct Pace {
    choice: usize,
    /// Simulated time that is still to be stepped \[s\].
    owed: f64,
    /// Simulated and real time of the current and the last measurement \[s\].
    simulated: f64,
    real: f64,
    measured: Option<f64>,
}

impl Pace {
    /// The speed next to `share` of real time (`visual/global realtime`).
    pub fn near(share: f64) -> Self {
        let away = |i: &usize| (SPEEDS[*i].ln() - (100.0 * share.max(1e-6)).ln()).abs();
        let choice = (0..SPEEDS.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0);
        Pace { choice, owed: 0.0, simulated: 0.0, real: 0.0, measured: None }
    }

    /// The chosen speed \[%\].
    pub fn percent(&self) -> f64 {
        SPEEDS[self.choice]
    }

    /// Takes the next faster speed.
    pub fn faster(&mut self) {
        self.choice = self.choice.saturating_sub(1);
        self.forget();
    }

    /// Takes the next slower speed.
    pub fn slower(&mut self) {
        self.choice = (self.choice + 1).min(SPEEDS.len() - 1);
        self.forget();
    }

    /// Forgets what is owed and measured: after a pause, a jump or another speed.
    pub fn forget(&mut self) {
        *self = Pace { choice: self.choice, ..Pace::near(1.0) };
    }

    /// The speed that was reached lately \[%\].
    pub fn reached(&self) -> Option<f64> {
        self.measured
    }

    /// Real time went by \[s\].
    pub fn elapse(&mut self, seconds: f64) {
        self.owed += seconds * self.percent() / 100.0;
        self.real += seconds;
        if self.real >= WINDOW {
            self.measured = Some(100.0 * self.simulated / self.real);
            (self.simulated, self.real) = (0.0, 0.0);
        }
    }

    /// Whether a step of `timestep` is due.
    pub fn is_due(&self, timestep: f64) -> bool {
        // What whole steps leave over by rounding counts as a step.
        self.owed >= timestep * (1.0 - 1e-6)
    }

    /// A step was taken.
    pub fn stepped(&mut self, timestep: f64) {
        self.owed -= timestep;
        self.simulated += timestep;
    }

    /// No more steps are taken now: gives up what cannot be caught up with.
    pub fn settle(&mut self) {
        if self.owed > GIVE_UP {
            self.owed = 0.0;
        }
    }
}
