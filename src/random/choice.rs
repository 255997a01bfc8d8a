//! Choices from a population, as indices into it.

use crate::bounds::{self, Bounds, Method};
use crate::{BitGenerator, RandomError};
use std::collections::HashSet;

/// How members of a population are chosen. Weights are probabilities: one for each member, with sum 1.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Sampling<'a> {
    /// Each draw from all members alike.
    WithReplacement,
    /// No member twice, in random order.
    WithoutReplacement,
    /// No member twice, in an order that is not random and quicker to make: `shuffle=False`. The legacy
    /// functions have no such choice, and order at random.
    Unordered,
    /// Each draw from all members by weight.
    Weighted(&'a [f64]),
    /// No member twice, by weight.
    WeightedWithoutReplacement(&'a [f64]),
}

/// An empty vector with room for `count` members.
pub(crate) fn room<T>(count: usize) -> Result<Vec<T>, RandomError> {
    let mut room = Vec::new();
    room.try_reserve_exact(count).map_err(|_| RandomError::OutOfMemory { count })?;
    Ok(room)
}

/// The numbers below `count`, in order.
fn numbers(count: usize) -> Result<Vec<usize>, RandomError> {
    let mut numbers = room(count)?;
    numbers.extend(0..count);
    Ok(numbers)
}

/// Refuses choices that cannot be made.
pub(crate) fn check(population: usize, count: usize, sampling: Sampling) -> Result<(), RandomError> {
    if population == 0 && count > 0 {
        return Err(RandomError::EmptyPopulation);
    }
    match sampling {
        Sampling::WithReplacement => Ok(()),
        Sampling::WithoutReplacement | Sampling::Unordered => check_size(population, count),
        Sampling::Weighted(weights) => check_weights(population, weights),
        Sampling::WeightedWithoutReplacement(weights) => {
            check_weights(population, weights)?;
            check_size(population, count)?;
            let positive = weights.iter().filter(|&&weight| weight > 0.0).count();
            if positive < count { Err(RandomError::TooFewWeights { count, positive }) } else { Ok(()) }
        }
    }
}

fn check_size(population: usize, count: usize) -> Result<(), RandomError> {
    if count > population { Err(RandomError::SampleTooLarge { count, population }) } else { Ok(()) }
}

fn check_weights(population: usize, weights: &[f64]) -> Result<(), RandomError> {
    /// Square root of the distance of 1 from the next f64.
    const TOLERANCE: f64 = 1.0 / (1 << 26) as f64;
    if weights.len() != population {
        return Err(RandomError::WeightCount { weights: weights.len(), population });
    }
    if let Some(index) = weights.iter().position(|weight| weight.is_nan() || *weight < 0.0) {
        return Err(RandomError::BadWeight { index, weight: weights[index] });
    }
    let sum = compensated_sum(weights);
    if (sum - 1.0).abs() <= TOLERANCE { Ok(()) } else { Err(RandomError::WeightSum { sum }) }
}

/// The sum without what rounding accumulates (Kahan 1965).
fn compensated_sum(terms: &[f64]) -> f64 {
    let add = |(sum, excess): (f64, f64), term: &f64| {
        let term = term - excess;
        let total = sum + term;
        (total, (total - sum) - term)
    };
    terms.iter().fold((0.0, 0.0), add).0
}

/// Exchanges members so that every order is equally likely, as numpy's `shuffle` does.
pub(crate) fn shuffle<T>(source: &mut impl BitGenerator, items: &mut [T]) {
    shuffle_from(source, 1, Method::Mask, items);
}

/// Gives each place from the last down to `first` a random one of the members up to it.
fn shuffle_from<T>(source: &mut impl BitGenerator, first: usize, method: Method, items: &mut [T]) {
    for place in (first..items.len()).rev() {
        items.swap(place, bounds::up_to(source, place as u64, method) as usize);
    }
}

/// The numbers below `count` in random order.
pub(crate) fn permutation(source: &mut impl BitGenerator, count: usize) -> Result<Vec<usize>, RandomError> {
    let mut order = numbers(count)?;
    shuffle(source, &mut order);
    Ok(order)
}

/// `count` numbers below `population`.
pub(crate) fn with_replacement(
    source: &mut impl BitGenerator,
    population: usize,
    count: usize,
    method: Method,
) -> Result<Vec<usize>, RandomError> {
    let mut chosen = room(count)?;
    if count > 0 {
        let (_, last) = Bounds::from(0..population as u64).first_and_span()?;
        chosen.extend((0..count).map(|_| bounds::up_to(source, last, method) as usize));
    }
    Ok(chosen)
}

/// `count` different numbers below `population`, in random order if `ordered_at_random`, as `Generator`
/// chooses them.
pub(crate) fn without_replacement(
    source: &mut impl BitGenerator,
    population: usize,
    count: usize,
    ordered_at_random: bool,
) -> Result<Vec<usize>, RandomError> {
    /// Larger populations are laid out and shuffled where the sample is not a small part of them.
    const SMALL: usize = 10_000;
    let part = population / if ordered_at_random { 50 } else { 20 };
    if population > SMALL && count > part {
        let mut all = numbers(population)?;
        let first = population - count;
        shuffle_from(source, first.max(1), Method::Multiply, &mut all);
        return Ok(all.split_off(first));
    }
    let mut chosen = floyd(source, population, count)?;
    if ordered_at_random {
        shuffle_from(source, 1, Method::Multiply, &mut chosen);
    }
    Ok(chosen)
}

/// Floyd's sample: each of the last `count` numbers in turn enters itself, or a random number up to it that
/// is not yet in (Bentley, "Programming pearls: a sample of brilliance", 1987).
fn floyd(source: &mut impl BitGenerator, population: usize, count: usize) -> Result<Vec<usize>, RandomError> {
    let mut chosen = room(count)?;
    let mut taken = HashSet::new();
    taken.try_reserve(count).map_err(|_| RandomError::OutOfMemory { count })?;
    for number in population - count..population {
        let candidate = bounds::up_to(source, number as u64, Method::Multiply) as usize;
        let choice = if taken.contains(&candidate) { number } else { candidate };
        taken.insert(choice);
        chosen.push(choice);
    }
    Ok(chosen)
}

/// Cumulated weights, the last of them 1.
fn cumulate(weights: &[f64], cumulated: &mut Vec<f64>) {
    cumulated.clear();
    cumulated.extend(weights.iter().scan(0.0, |sum, weight| {
        *sum += weight;
        Some(*sum)
    }));
    let total = cumulated.last().copied().unwrap_or(1.0);
    cumulated.iter_mut().for_each(|sum| *sum /= total);
}

/// `count` numbers by weight.
pub(crate) fn weighted(
    source: &mut impl BitGenerator,
    weights: &[f64],
    count: usize,
) -> Result<Vec<usize>, RandomError> {
    let (mut chosen, mut cumulated) = (room(count)?, room(weights.len())?);
    cumulate(weights, &mut cumulated);
    chosen.extend((0..count).map(|_| {
        let level = source.next_f64();
        cumulated.partition_point(|&sum| sum <= level)
    }));
    Ok(chosen)
}

/// `count` different numbers by weight: rounds of weighted draws, each of as many as are still missing, among
/// what earlier rounds left.
pub(crate) fn weighted_without_replacement(
    source: &mut impl BitGenerator,
    weights: &[f64],
    count: usize,
) -> Result<Vec<usize>, RandomError> {
    let mut chosen: Vec<usize> = room(count)?;
    let (mut left, mut cumulated) = (room(weights.len())?, room(weights.len())?);
    left.extend_from_slice(weights);
    while chosen.len() < count {
        cumulate(&left, &mut cumulated);
        for _ in chosen.len()..count {
            let level = source.next_f64();
            let index = cumulated.partition_point(|&sum| sum <= level);
            // A weight of zero marks what this round has chosen; it takes effect on the sums in the next.
            if left[index] > 0.0 {
                left[index] = 0.0;
                chosen.push(index);
            }
        }
    }
    Ok(chosen)
}
