//! How long it takes from what a person does to what the robot is told.

/// Times that were measured \[s\].
#[derive(Clone, Debug, Default)]
pub struct Latencies {
    pending: Vec<f64>,
    times: Vec<f64>,
}

impl Latencies {
    /// Something came at `now` \[s\].
    pub fn came(&mut self, now: f64) {
        self.pending.push(now);
    }

    /// All that came was sent on at `now` \[s\].
    pub fn applied(&mut self, now: f64) {
        self.times.extend(self.pending.drain(..).map(|then| now - then));
    }

    /// The time that a share of all stayed below \[s\].
    pub fn quantile(&self, share: f64) -> Option<f64> {
        let mut times = self.times.clone();
        times.sort_by(f64::total_cmp);
        let place = (share * times.len() as f64).ceil() as usize;
        times.get(place.saturating_sub(1)).copied()
    }

    /// How many were measured.
    pub fn count(&self) -> usize {
        self.times.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_times_that_were_measured() {
        let mut latencies = Latencies::default();
        assert_eq!(latencies.quantile(0.5), None);
        for k in 0..100 {
            latencies.came(f64::from(k));
            latencies.applied(f64::from(k) + f64::from(k + 1) / 1000.0);
        }
        let near = |a: Option<f64>, b: f64| (a.unwrap() - b).abs() < 1e-9;
        assert!(near(latencies.quantile(0.5), 0.05) && near(latencies.quantile(0.99), 0.099));
        assert!(near(latencies.quantile(1.0), 0.1) && latencies.count() == 100);
    }
}
