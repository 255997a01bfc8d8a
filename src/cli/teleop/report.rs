//! Statistics of a session: ticks, latency, episodes.

use crate::terminal::show;
use ::teleop::Latencies;

/// What is counted during a session.
#[derive(Default)]
pub struct Report {
    latencies: Latencies,
    ticks: u64,
    steps: u64,
    /// Number of steps by the person, and by the policy.
    acted: [u64; 2],
    /// Ticks that were skipped because an earlier one took too long.
    pub dropped: u64,
    /// Episodes that were thrown away.
    pub discarded: usize,
    /// How long it took [s].
    pub seconds: f64,
}

impl Report {
    /// An event came.
    pub fn came(&mut self, now: f64) {
        self.latencies.came(now);
    }

    /// A tick is over: what came before it is applied now.
    pub fn applied(&mut self, now: f64, stepped: bool) {
        self.latencies.applied(now);
        self.ticks += 1;
        self.steps += u64::from(stepped);
    }

    /// Counts a step by the person or by the policy; `None` for no step, or without a policy.
    pub fn acted(&mut self, by_hand: Option<bool>) {
        if let Some(by_hand) = by_hand {
            self.acted[usize::from(!by_hand)] += 1;
        }
    }

    /// When the next tick is due; whole ticks that are late are dropped.
    pub fn next(&mut self, due: f64, now: f64, period: f64) -> f64 {
        let late = ((now - due) / period).floor().max(0.0);
        self.dropped += late as u64;
        due + (late + 1.0) * period
    }

    /// Prints the statistics.
    pub fn show(&self, id: &str, (kept, good): (usize, usize)) {
        show!("{id}: {kept} episodes kept, {good} succeeded, {} thrown away", self.discarded);
        let rate = self.ticks as f64 / self.seconds.max(1e-9);
        show!(
            "ticks        {}, {rate:.1} a second, {} dropped, {} stepped",
            self.ticks,
            self.dropped,
            self.steps
        );
        let [hand, policy] = self.acted;
        if hand + policy > 0 {
            show!("acted        {hand} steps by hand, {policy} by the policy");
        }
        let ms = |share| self.latencies.quantile(share).map_or(f64::NAN, |seconds| 1e3 * seconds);
        if self.latencies.count() > 0 {
            show!(
                "latency      {:.1} ms (p50), {:.1} ms (p99) from {} events to the control that follows",
                ms(0.5),
                ms(0.99),
                self.latencies.count()
            );
        }
    }
}

/// What keys do, on one line.
pub fn keys(mapped: bool) -> &'static str {
    if mapped {
        return "keys as the mapping says";
    }
    "d a w x q z move, arrows , . turn, [ ] gripper, Enter success, Backspace failure, Delete again, Space pause, b back, Esc end"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_ticks_that_are_late_are_dropped() {
        let mut report = Report::default();
        assert_eq!((report.next(1.0, 1.01, 0.1), report.dropped), (1.1, 0));
        let next = report.next(1.1, 1.35, 0.1);
        assert!((next - 1.4).abs() < 1e-9 && report.dropped == 2, "{next}");
    }
}
