//! The kinds of draws that are compared, in the order and with the arguments of `reference/draws.py`.

use random::{
    BitGenerator, Bounds, Entropy, Generator, Integer, Mt19937, Pcg64, RandomError, RandomState, Sampling,
    SeedSequence,
};

const MILLION: usize = 1_000_000;
/// Draws of kinds that numpy is called for once each.
const SINGLE: usize = 20_000;

type Drawn = Result<Vec<u64>, RandomError>;

/// A kind of draw, from one family of generators.
pub struct Family {
    /// Family and kind.
    pub name: String,
    /// Draws with a seed.
    pub draw: Box<dyn Fn(u64) -> Drawn + Sync>,
}

/// Everything compared.
pub fn families() -> Vec<Family> {
    let mut all = Vec::new();
    for (kind, draw) in generator_kinds::<Pcg64>() {
        all.push(family("pcg64", kind, move |seed| draw(&mut Generator::pcg64(seed))));
    }
    all.push(family("pcg64", "state".into(), |seed| pcg64_state(Generator::pcg64(seed))));
    for (kind, draw) in generator_kinds::<Mt19937>() {
        all.push(family("mt19937", kind, move |seed| draw(&mut Generator::mt19937(seed))));
    }
    all.push(family("mt19937", "state".into(), |seed| mt19937_state(Generator::mt19937(seed))));
    for (kind, draw) in legacy_kinds() {
        all.push(family("legacy", kind, move |seed| draw(&mut RandomState::new(seed as u32))));
    }
    for (name, length) in [("legacy_key_short", 1), ("legacy_key_long", 1000)] {
        all.push(family(name, "random".into(), move |seed| {
            let key: Vec<_> = (0..length).map(|k: u64| (seed + k * k) as u32).collect();
            legacy_random(&mut RandomState::from_key(&key)?)
        }));
    }
    all.push(family("legacy_sequence_seeded", "random".into(), |seed| {
        legacy_random(&mut Mt19937::new(seed).into())
    }));
    all.push(family("seed_sequence", "state".into(), seed_sequences));
    all
}

fn family(name: &str, kind: String, draw: impl Fn(u64) -> Drawn + Sync + 'static) -> Family {
    Family { name: format!("{name}.{kind}"), draw: Box::new(draw) }
}

fn bits(draws: &[f64]) -> Vec<u64> {
    draws.iter().map(|draw| draw.to_bits()).collect()
}

fn indices(draws: Vec<usize>) -> Vec<u64> {
    draws.into_iter().map(|index| index as u64).collect()
}

/// The million numbers that `fill` makes.
fn million(fill: impl FnOnce(&mut [f64]) -> Result<(), RandomError>) -> Drawn {
    let mut out = vec![0.0; MILLION];
    fill(&mut out)?;
    Ok(bits(&out))
}

/// Probabilities in the proportion 1 : 2 : … : `count`.
fn weights(count: usize) -> Vec<f64> {
    let sum = (count * (count + 1) / 2) as f64;
    (1..=count).map(|k| k as f64 / sum).collect()
}

/// Ends of intervals that numbers are drawn from in turn: `linspace(-1, 0, 8)`, and others.
fn ends() -> [[f64; 8]; 2] {
    let low = std::array::from_fn(|k| if k == 7 { 0.0 } else { -1.0 + k as f64 * (1.0 / 7.0) });
    [low, [-1.0, 0.0, 1.0, 2.0, 3.0, 1e3, 1e-3, 5e300]]
}

fn in_turn(mut fill: impl FnMut([&[f64]; 2], &mut [f64]) -> Result<(), RandomError>) -> Drawn {
    let [low, high] = ends();
    million(|out| out.chunks_exact_mut(8).try_for_each(|row| fill([&low, &high], row)))
}

/// Concatenates `times` draws of several members.
fn repeat(times: usize, mut draw: impl FnMut() -> Result<Vec<usize>, RandomError>) -> Drawn {
    let mut all = Vec::new();
    for _ in 0..times {
        all.extend(indices(draw()?));
    }
    Ok(all)
}

fn shuffled(shuffle: impl FnOnce(&mut [u64])) -> Drawn {
    let mut items: Vec<u64> = (0..MILLION as u64).map(|k| 3 * k).collect();
    shuffle(&mut items);
    Ok(items)
}

/// Fills integers of one type in numpy's two ways.
trait Filler {
    fn fill<T: Integer>(&mut self, bounds: Bounds<T>, out: &mut [T]) -> Result<(), RandomError>;
}

impl<B: BitGenerator> Filler for Generator<B> {
    fn fill<T: Integer>(&mut self, bounds: Bounds<T>, out: &mut [T]) -> Result<(), RandomError> {
        self.fill_integers(bounds, out)
    }
}

impl Filler for RandomState {
    fn fill<T: Integer>(&mut self, bounds: Bounds<T>, out: &mut [T]) -> Result<(), RandomError> {
        self.fill_randint(bounds, out)
    }
}

type Draw<S> = Box<dyn Fn(&mut S) -> Drawn + Sync>;

/// A million integers from `low` to `high`.
fn integers<S: Filler, T: Integer + Sync + 'static>(name: &str, low: T, high: T) -> (String, Draw<S>) {
    let draw = move |source: &mut S| {
        let mut out = vec![low; MILLION];
        source.fill(Bounds::from(low..=high), &mut out)?;
        Ok(out.into_iter().map(|integer| integer.widen() as u64).collect())
    };
    (name.to_owned(), Box::new(draw))
}

fn ranges<S: Filler>() -> Vec<(String, Draw<S>)> {
    vec![
        integers("single", 5_i64, 5),
        integers("pair", 0_i64, 1),
        integers("ten", 0_i64, 9),
        integers("negative", -7_i64, 5),
        integers("below_2_32", 0, (1_i64 << 32) - 2),
        integers("at_2_32", 0, (1_i64 << 32) - 1),
        integers("above_2_32", 0, 1_i64 << 32),
        integers("many_rejections_32", 0, 1_i64 << 31),
        integers("many_rejections_64", -(1_i64 << 62), 1_i64 << 62),
        integers("to_largest", 0, i64::MAX),
        integers("all_i64", i64::MIN, i64::MAX),
        integers("at_2_63", 0, 1_u64 << 63),
        integers("all_u64", 0, u64::MAX),
        integers("i32", -1000_i32, 999),
        integers("all_i32", i32::MIN, i32::MAX),
        integers("u32", 7_u32, 3_000_000_000),
        integers("i16", -300_i16, 299),
        integers("all_u16", 0, u16::MAX),
        integers("u8", 0_u8, 199),
        integers("many_rejections_8", 0_u8, 128),
        integers("all_i8", i8::MIN, i8::MAX),
        integers("bool", false, true),
    ]
}

fn generator_kinds<B: BitGenerator + 'static>() -> Vec<(String, Draw<Generator<B>>)> {
    let mut kinds: Vec<(String, Draw<Generator<B>>)> = Vec::new();
    let mut add =
        |name: &str, draw: fn(&mut Generator<B>) -> Drawn| kinds.push((name.to_owned(), Box::new(draw)));
    add("random", |g| {
        million(|out| {
            g.fill_random(out);
            Ok(())
        })
    });
    add("uniform", |g| million(|out| g.fill_uniform(-1.5, 2.5, out)));
    add("uniform_each", |g| in_turn(|[low, high], out| g.fill_uniform_each(low, high, out)));
    add("standard_normal", |g| {
        million(|out| {
            g.fill_standard_normal(out);
            Ok(())
        })
    });
    add("normal", |g| million(|out| g.fill_normal(0.25, 3.0, out)));
    kinds.extend(ranges().into_iter().map(|(name, draw)| (format!("integers_{name}"), draw)));
    let mut add =
        |name: &str, draw: fn(&mut Generator<B>) -> Drawn| kinds.push((name.to_owned(), Box::new(draw)));
    add("integer_single_u8", |g| (0..SINGLE).map(|_| g.integer(0..200_u8).map(u64::from)).collect());
    add("mixed", |g| {
        let mut all = Vec::new();
        for _ in 0..SINGLE / 4 {
            all.extend([g.integer(0..10_u64)?, g.random().to_bits()]);
            all.extend([g.integer(0..200_u8)?.into(), g.standard_normal().to_bits()]);
        }
        Ok(all)
    });
    add("choice", |g| repeat(1, || g.choice(1000, MILLION, Sampling::WithReplacement)));
    add("choice_one", |g| (0..SINGLE).map(|_| g.choose(&[0, 1, 2, 3, 4]).copied()).collect());
    add("choice_weighted", |g| repeat(1, || g.choice(100, MILLION, Sampling::Weighted(&weights(100)))));
    add("choice_part", |g| repeat(1000, || g.choice(MILLION, 1000, Sampling::WithoutReplacement)));
    add("choice_part_unordered", |g| repeat(1000, || g.choice(MILLION, 1000, Sampling::Unordered)));
    add("choice_few", |g| repeat(SINGLE, || g.choice(5, 3, Sampling::WithoutReplacement)));
    add("choice_half", |g| repeat(1, || g.choice(2 * MILLION, MILLION, Sampling::WithoutReplacement)));
    add("choice_half_unordered", |g| repeat(1, || g.choice(2 * MILLION, MILLION, Sampling::Unordered)));
    add("choice_all", |g| repeat(1, || g.choice(MILLION, MILLION, Sampling::WithoutReplacement)));
    add("choice_at_limit", |g| repeat(100, || g.choice(10_001, 200, Sampling::WithoutReplacement)));
    add("choice_above_limit", |g| repeat(100, || g.choice(10_001, 201, Sampling::WithoutReplacement)));
    add("choice_weighted_part", |g| {
        let weights = weights(2000);
        repeat(1000, || g.choice(2000, 1000, Sampling::WeightedWithoutReplacement(&weights)))
    });
    add("shuffle", |g| shuffled(|items| g.shuffle(items)));
    add("permutation", |g| repeat(1, || g.permutation(MILLION)));
    kinds
}

fn legacy_random(r: &mut RandomState) -> Drawn {
    million(|out| {
        r.fill_random(out);
        Ok(())
    })
}

fn legacy_kinds() -> Vec<(String, Draw<RandomState>)> {
    let mut kinds: Vec<(String, Draw<RandomState>)> = Vec::new();
    let mut add =
        |name: &str, draw: fn(&mut RandomState) -> Drawn| kinds.push((name.to_owned(), Box::new(draw)));
    add("random", legacy_random);
    add("uniform", |r| million(|out| r.fill_uniform(-1.5, 2.5, out)));
    add("uniform_reversed", |r| million(|out| r.fill_uniform(2.5, -1.5, out)));
    add("uniform_each", |r| in_turn(|[low, high], out| r.fill_uniform_each(low, high, out)));
    add("standard_normal", |r| {
        million(|out| {
            r.fill_standard_normal(out);
            Ok(())
        })
    });
    add("normal", |r| million(|out| r.fill_normal(0.25, 3.0, out)));
    kinds.extend(ranges().into_iter().map(|(name, draw)| (format!("randint_{name}"), draw)));
    let mut add =
        |name: &str, draw: fn(&mut RandomState) -> Drawn| kinds.push((name.to_owned(), Box::new(draw)));
    add("randint_single_u8", |r| (0..SINGLE).map(|_| r.randint(0..200_u8).map(u64::from)).collect());
    add("mixed", |r| {
        let mut all = Vec::new();
        for _ in 0..SINGLE / 4 {
            all.extend([r.randint(0..10_u64)?, r.random().to_bits()]);
            all.extend([r.randint(0..200_u8)?.into(), r.standard_normal().to_bits()]);
        }
        Ok(all)
    });
    add("choice", |r| repeat(1, || r.choice(1000, MILLION, Sampling::WithReplacement)));
    add("choice_one", |r| (0..SINGLE).map(|_| r.choose(&[0, 1, 2, 3, 4]).copied()).collect());
    add("choice_weighted", |r| repeat(1, || r.choice(100, MILLION, Sampling::Weighted(&weights(100)))));
    add("choice_few", |r| repeat(SINGLE, || r.choice(5, 3, Sampling::WithoutReplacement)));
    add("choice_half", |r| repeat(1, || r.choice(2 * MILLION, MILLION, Sampling::WithoutReplacement)));
    add("choice_weighted_part", |r| {
        let weights = weights(2000);
        repeat(1000, || r.choice(2000, 1000, Sampling::WeightedWithoutReplacement(&weights)))
    });
    add("shuffle", |r| shuffled(|items| r.shuffle(items)));
    add("permutation", |r| repeat(1, || r.permutation(MILLION)));
    add("state", legacy_state);
    kinds
}

/// The state after an odd number of draws of 32 bits.
fn pcg64_state(mut g: Generator<Pcg64>) -> Drawn {
    g.fill_integers(0..10_i64, &mut [0; 1001])?;
    let s = g.bits().state();
    let halves = [s.state, s.inc].into_iter().flat_map(|n| [(n >> 64) as u64, n as u64]);
    Ok(halves.chain([s.has_uint32.into(), s.uinteger.into()]).collect())
}

fn mt19937_state(mut g: Generator<Mt19937>) -> Drawn {
    g.fill_integers(0..10_i64, &mut [0; 1001])?;
    let s = g.bits().state();
    Ok(s.key.into_iter().map(u64::from).chain([s.pos as u64]).collect())
}

/// The state after an odd number of normal draws.
fn legacy_state(r: &mut RandomState) -> Drawn {
    r.fill_standard_normal(&mut [0.0; 1001]);
    let s = r.state();
    let words = s.state.key.into_iter().map(u64::from);
    Ok(words.chain([s.state.pos as u64, s.has_gauss.into(), s.gauss.to_bits()]).collect())
}

/// States of seed sequences: small and large entropy, sequences of numbers, spawn keys, children's children.
fn seed_sequences(seed: u64) -> Drawn {
    let product = u128::from(seed) * 3_u128.pow(50);
    // seed + 10^300 and product + 2^130.
    let [large, larger] = [format!("1{seed:0300}"), format!("0x4{product:032x}")];
    let mut parent = SeedSequence::new(seed);
    let [_, _, mut child] = std::array::from_fn(|_| parent.spawn());
    let [_, grandchild] = std::array::from_fn(|_| child.spawn());
    let sequences = [
        SeedSequence::new(seed),
        SeedSequence::new(product),
        SeedSequence::new(large.parse::<Entropy>()?),
        SeedSequence::new([seed, 0, 1 << 40, 7, 1 << 63].into_iter().collect::<Entropy>()),
        SeedSequence::new(std::iter::empty().collect::<Entropy>()),
        SeedSequence::with_spawn_key(seed, [0]),
        SeedSequence::with_spawn_key(larger.parse::<Entropy>()?, [5, 1 << 33]),
        child,
        grandchild,
    ];
    Ok(sequences.iter().flat_map(|s| s.generate_state::<11>()).map(u64::from).collect())
}
