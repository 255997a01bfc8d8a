//! Soft actor-critic with a temperature that is learnt (Haarnoja et al., 2018, "Soft actor-critic algorithms and applications", algorithm 1),
//! layer normalisation in the action values, and returns of several steps.

use super::actor::Actor;
use super::fit::Fit;
use super::replay::{Replay, Transitions, observe_returns};
use super::rollout::Episode;
use super::update::Update;
use crate::archive::{Archive, Entry, Numbers};
use crate::error::PolicyError;
use crate::nets::{Activation, Adam, Mlp, Running, Squashed, Tape, clip, exp};
use env::Rng;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::slice::from_mut;
use std::thread;

/// Logarithm of the temperature at first: entropy counts little until it is less than it is to be.
const LOG_TEMPERATURE: f32 = -4.6;

/// Settings of an update.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Sac {
    /// Steps whose rewards count before the value of what follows stands for the rest.
    pub steps: usize,
    /// Share of the parameters that the slow copies of the action values take over in an update.
    pub share: f32,
    /// Entropy of an action that the temperature is to bring about.
    pub entropy: f32,
    /// Size of a step of the policy and of the temperature.
    pub rate: f32,
    /// Most observations that are remembered.
    pub remembered: usize,
    /// Observations that are remembered before the first update.
    pub begin: usize,
}

/// What a soft actor-critic has beside its policy.
#[derive(Clone, Debug, PartialEq)]
pub struct Soft {
    sac: Sac,
    head: Squashed,
    /// From what is observed, normalised, and an action to the value of it.
    net: Mlp,
    judges: [Judge; 2],
    policy: Adam,
    log_temperature: f32,
    temperature: Adam,
    replay: Replay,
    /// Returns seen so far, by whose deviation rewards are divided.
    returns: Running,
}

/// The parameters of an action value, a copy that follows slowly, and their optimiser.
#[derive(Clone, Debug, PartialEq)]
struct Judge {
    parameters: Vec<f32>,
    slow: Vec<f32>,
    adam: Adam,
}

/// What a part of a batch has to say: sums over its rows, of which each counts as its share of the whole batch.
struct Part {
    judges: [Vec<f32>; 2],
    policy: Vec<f32>,
    log_density: f64,
    /// Sums of what is wanted of the values, of its square, and of the squares of what is left of it.
    wanted: [f64; 3],
}

/// What all steps of an update need.
struct Step<'a> {
    soft: &'a Soft,
    actor: &'a Actor,
    drawn: &'a Transitions,
    /// Noise of the actions after the steps, and of those before.
    noise: [&'a [f32]; 2],
    /// What rewards are multiplied by.
    scale: f64,
}

impl Soft {
    /// Before the first step.
    pub fn new(
        (sac, head): (Sac, Squashed),
        hidden: &[usize],
        activation: Activation,
        actor: &Actor,
        rng: &mut Rng,
    ) -> Self {
        let (observed, actions) = (actor.net.inputs(), actor.actions());
        let widths: Vec<usize> = [&[observed + actions], hidden, &[1]].concat();
        let net = Mlp::new(&widths, activation, true);
        let judges = [(); 2].map(|()| {
            let parameters = net.draw(1.0, rng);
            Judge { slow: parameters.clone(), adam: Adam::new(parameters.len()), parameters }
        });
        Soft {
            sac,
            head,
            net,
            judges,
            policy: Adam::new(actor.parameters.len()),
            log_temperature: LOG_TEMPERATURE,
            temperature: Adam::new(1),
            replay: Replay::new([observed, actions], sac.remembered),
            returns: Running::new(1),
        }
    }

    /// Remembers episodes.
    pub fn remember(&mut self, episodes: &[Episode], gamma: f64) {
        for episode in episodes {
            self.replay.add(episode);
            observe_returns(&mut self.returns, episode, gamma);
        }
    }

    /// Improves a policy after `new` steps, on two threads if it is said so; gives what became of it, and the share of the variance of
    /// returns that the values explained.
    pub fn improve(
        &mut self,
        (fit, gamma): (Fit, f64),
        actor: &mut Actor,
        (new, threads): (usize, usize),
        rng: &mut Rng,
    ) -> (Update, f64) {
        if self.replay.rows() < self.sac.begin {
            return (Update::default(), 0.0);
        }
        let (old, mut outcome) = (actor.clone(), Update::default());
        let (mut explained, mut last) = ([0.0; 2], Transitions::default());
        let updates = (fit.epochs * new).div_ceil(fit.batch);
        for _ in 0..updates {
            let drawn = self.replay.draw(fit.batch, (self.sac.steps, gamma), rng);
            let mut normals =
                || -> Vec<f32> { (0..drawn.actions.len()).map(|_| rng.standard_normal() as f32).collect() };
            let noise = [normals(), normals()];
            let scale = 1.0 / self.returns.deviations().next().unwrap_or(1.0);
            let step = Step { soft: self, actor, drawn: &drawn, noise: [&noise[0], &noise[1]], scale };
            let part = step.whole(threads);
            let [sum, squares, left] = part.wanted;
            explained[0] += left;
            explained[1] += squares - sum * sum;
            outcome.entropy -= part.log_density / updates as f64;
            self.take(fit, actor, part);
            last = drawn;
        }
        outcome.epochs = fit.epochs;
        outcome.divergence = divergence(&self.head, [&old, actor], &last.before);
        (outcome, if explained[1] > 0.0 { 1.0 - explained[0] / explained[1] } else { 0.0 })
    }

    /// Takes a step of all optimisers, and moves the slow copies.
    fn take(&mut self, fit: Fit, actor: &mut Actor, mut part: Part) {
        let sac = self.sac;
        for (judge, gradient) in self.judges.iter_mut().zip(&mut part.judges) {
            clip(gradient, fit.longest);
            judge.adam.step(fit.rate, 0.0, gradient, &mut judge.parameters);
            let pairs = judge.slow.iter_mut().zip(&judge.parameters);
            pairs.for_each(|(slow, parameter)| *slow += sac.share * (parameter - *slow));
        }
        clip(&mut part.policy, fit.longest);
        self.policy.step(sac.rate, 0.0, &part.policy, &mut actor.parameters);
        let slope = -(part.log_density as f32 + sac.entropy * actor.actions() as f32);
        self.temperature.step(sac.rate, 0.0, &[slope], from_mut(&mut self.log_temperature));
    }

    /// All of it, by names.
    pub fn entries(&mut self) -> Vec<Entry<'_>> {
        let mut entries = Vec::new();
        for (judge, whole) in self.judges.iter_mut().zip(["values", "values2"]) {
            for (numbers, part) in [(&mut judge.parameters, "layers"), (&mut judge.slow, "slow")] {
                let (layers, _) = self.net.entries(numbers);
                entries.extend(layers.into_iter().map(|entry| entry.of(part).of(whole)));
            }
            entries.extend(judge.adam.entries().map(|entry| entry.of("adam").of(whole)));
        }
        entries.extend(self.returns.entries().map(|entry| entry.of("returns")));
        entries.extend(self.policy.entries().map(|entry| entry.of("policy.adam")));
        entries.push(Entry::new("temperature.log", Numbers::F32(from_mut(&mut self.log_temperature))));
        entries.extend(self.temperature.entries().map(|entry| entry.of("temperature.adam")));
        entries.extend(self.replay.entries());
        entries
    }

    /// Most bytes of what is remembered.
    pub fn most_bytes(&self) -> u64 {
        self.replay.most_bytes()
    }

    /// Makes room for what a file has more of than there is.
    pub fn make_room(&mut self, archive: &Archive<'_>) -> Result<(), PolicyError> {
        self.replay.make_room(archive)
    }

    /// Refuses what cannot have been kept.
    pub fn check(&self) -> Result<(), PolicyError> {
        self.replay.check()
    }
}

impl Step<'_> {
    /// The slopes of the whole batch: those of its two halves, added in this order, on two threads or on one.
    fn whole(&self, threads: usize) -> Part {
        let rows = self.drawn.rewards.len();
        let [first, second] = [0..rows / 2, rows / 2..rows];
        let (mut one, other) = if threads > 1 {
            thread::scope(|scope| {
                let other = scope.spawn(|| self.part(second));
                (self.part(first), other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            })
        } else {
            (self.part(first), self.part(second))
        };
        let [a, b] = &mut one.judges;
        let pairs = [(a, &other.judges[0]), (b, &other.judges[1]), (&mut one.policy, &other.policy)];
        pairs.into_iter().for_each(|(to, from)| to.iter_mut().zip(from).for_each(|(to, from)| *to += from));
        one.log_density += other.log_density;
        one.wanted.iter_mut().zip(other.wanted).for_each(|(to, from)| *to += from);
        one
    }

    /// The slopes of some rows of the batch.
    fn part(&self, rows: Range<usize>) -> Part {
        let (Step { soft, actor, drawn, .. }, observed) = (self, self.actor.net.inputs());
        let (width, share) = (actor.actions(), 1.0 / drawn.rewards.len() as f32);
        let [observations, actions] = [observed, width].map(|width| rows.start * width..rows.end * width);
        let alpha = exp(soft.log_temperature);
        let wanted = self.wanted(&rows, alpha);
        let before = actor.normalized(&drawn.before[observations]);
        let taken = joined([&before, &drawn.actions[actions.clone()]], [observed, width]);
        let (mut tape, mut left) = (Tape::default(), 0.0);
        let judges = [0, 1].map(|k| {
            let parameters = &soft.judges[k].parameters;
            soft.net.forward(parameters, &taken, &mut tape);
            let away = tape.output().iter().zip(&wanted).map(|(value, wanted)| value - wanted);
            left += 0.5 * away.clone().map(|away| f64::from(away * away * share)).sum::<f64>();
            let slopes: Vec<f32> = away.map(|away| away * share).collect();
            let mut gradient = vec![0.0; parameters.len()];
            soft.net.backward(parameters, &tape, &slopes, &mut gradient);
            gradient
        });
        let noise = &self.noise[1][actions];
        actor.forward(&before, &mut tape);
        let (chosen, densities) = self.act(&tape, noise);
        let by_action = self.slopes_of_values(&joined([&before, &chosen], [observed, width]), share);
        let mut slopes = vec![0.0; tape.output().len()];
        let each = slopes.chunks_exact_mut(2 * width).zip(tape.output().chunks_exact(2 * width));
        for (k, (slopes, outputs)) in each.enumerate() {
            let row = k * width..(k + 1) * width;
            let made = [&noise[row.clone()], &chosen[row.clone()]];
            soft.head.slopes(outputs, made, alpha * share, &by_action[row], slopes);
        }
        let mut policy = vec![0.0; actor.parameters.len()];
        actor.net.backward(&actor.parameters, &tape, &slopes, &mut policy);
        let mean = |numbers: &[f32]| -> f64 {
            numbers.iter().map(|number| f64::from(*number) * f64::from(share)).sum()
        };
        let squares = wanted.iter().map(|value| f64::from(*value));
        let squares = squares.map(|value| value * value * f64::from(share)).sum();
        let (log_density, wanted) = (mean(&densities), [mean(&wanted), squares, left]);
        Part { judges, policy, log_density, wanted }
    }

    /// What the values of these rows are to be (equation 3), by the lesser of the slow copies.
    fn wanted(&self, rows: &Range<usize>, alpha: f32) -> Vec<f32> {
        let (Step { soft, actor, drawn, .. }, mut tape) = (self, Tape::default());
        let (observed, width) = (actor.net.inputs(), actor.actions());
        let after = actor.normalized(&drawn.after[rows.start * observed..rows.end * observed]);
        actor.forward(&after, &mut tape);
        let (next, densities) = self.act(&tape, &self.noise[0][rows.start * width..rows.end * width]);
        let input = joined([&after, &next], [observed, width]);
        let [one, other] = [0, 1].map(|k| {
            soft.net.forward(&soft.judges[k].slow, &input, &mut tape);
            tape.output().to_vec()
        });
        let soft_values = one
            .iter()
            .zip(&other)
            .zip(&densities)
            .map(|((one, other), density)| one.min(*other) - alpha * density);
        let steps = drawn.rewards[rows.clone()].iter().zip(&drawn.shares[rows.clone()]);
        let wanted = steps.zip(soft_values);
        wanted.map(|((reward, share), value)| (reward * self.scale) as f32 + *share as f32 * value).collect()
    }

    /// Actions for the distributions on a tape, and the logarithms of their densities.
    fn act(&self, tape: &Tape, noise: &[f32]) -> (Vec<f32>, Vec<f32>) {
        let (mut actions, width) = (vec![0.0; noise.len()], self.actor.actions());
        let rows = actions.chunks_exact_mut(width).zip(noise.chunks_exact(width));
        let rows = rows.zip(tape.output().chunks_exact(2 * width));
        let densities =
            rows.map(|((action, noise), outputs)| self.soft.head.act(outputs, noise, action)).collect();
        (actions, densities)
    }

    /// The slopes of `-share` times the lesser value of each row by its action.
    fn slopes_of_values(&self, input: &[f32], share: f32) -> Vec<f32> {
        let (net, judges, observed) = (&self.soft.net, &self.soft.judges, self.actor.net.inputs());
        let tapes = [0, 1].map(|k| {
            let mut tape = Tape::default();
            net.forward(&judges[k].parameters, input, &mut tape);
            tape
        });
        let first_is_lesser: Vec<bool> =
            tapes[0].output().iter().zip(tapes[1].output()).map(|(one, other)| one <= other).collect();
        let mut by_action = vec![0.0; tapes[0].rows() * self.actor.actions()];
        for (k, tape) in tapes.iter().enumerate() {
            let slopes: Vec<f32> =
                first_is_lesser.iter().map(|first| if *first == (k == 0) { -share } else { 0.0 }).collect();
            let by_input = net.input_slopes(&judges[k].parameters, tape, &slopes);
            let rows = by_input.chunks_exact(net.inputs()).flat_map(|row| &row[observed..]);
            by_action.iter_mut().zip(rows).for_each(|(sum, slope)| *sum += slope);
        }
        by_action
    }
}

/// Rows of two matrices joined.
fn joined([a, b]: [&[f32]; 2], widths: [usize; 2]) -> Vec<f32> {
    let rows = a.chunks_exact(widths[0]).zip(b.chunks_exact(widths[1]));
    rows.flat_map(|(a, b)| a.iter().chain(b)).copied().collect()
}

/// The mean divergence of the old policy from the new one where these observations were made.
fn divergence(head: &Squashed, [old, new]: [&Actor; 2], observations: &[f64]) -> f64 {
    let width = 2 * old.actions();
    let [old, new] = [old, new].map(|actor| {
        let mut tape = Tape::default();
        actor.forward(&actor.normalized(observations), &mut tape);
        tape
    });
    let rows = old.output().chunks_exact(width).zip(new.output().chunks_exact(width));
    rows.map(|(old, new)| f64::from(head.divergence(old, new))).sum::<f64>() / old.rows().max(1) as f64
}
