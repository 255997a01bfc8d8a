//! First draws of numpy 2.4.6, as `python -c` prints them. A million draws of every kind and twenty seeds are compared by
//! digests in the package `robohive-validation`.

use robohive_random::{BitGenerator, Generator, Mt19937, Pcg64, RandomState, Sampling, SeedSequence};

#[test]
fn words_of_seed_sequences() {
    let zero: [u32; 4] = SeedSequence::new(0_u64).generate_state();
    assert_eq!(zero, [0xb0f478be, 0xdb2cd7e7, 0x2c71ba49, 0xabf4641a]);
    let child: [u32; 4] = SeedSequence::with_spawn_key(5_u64, [7, 1 << 40]).generate_state();
    assert_eq!(child, [0x71610032, 0x670aeb0a, 0x6a531154, 0xdb408660]);
    let large: [u32; 3] = SeedSequence::new((1_u128 << 100) + 17).generate_state();
    assert_eq!(large, [0xf88a1086, 0x2737768a, 0xcb5112dd]);
    let mut parent = SeedSequence::new(42_u64);
    parent.spawn();
    let grandchild: [u32; 2] = parent.spawn().spawn().generate_state();
    assert_eq!(grandchild, [0x45fbc4b8, 0xe66843fe]);
}

#[test]
fn words_of_bit_generators() {
    assert_eq!(Pcg64::new(5_u64).next_u64(), 0xce14abeeabb8e5a8);
    assert_eq!(Mt19937::new(5_u64).next_u32(), 0x573e90b8);
}

/// One generator through draws of several kinds, so that each leaves it where numpy's would be.
#[test]
fn a_sequence_of_kinds() {
    let mut g = Generator::pcg64(12345_u64);
    assert_eq!(g.random(), 0.22733602246716966);
    assert_eq!(g.normal(2.0, 3.0), Ok(5.791185374387331));
    assert_eq!(g.integer(0..10), Ok(2));
    assert_eq!(g.integer::<u8>(0..=255), Ok(130));
    assert_eq!(g.integer(-5..=5), Ok(2));
    assert_eq!(g.uniform(-1.0, 3.0), Ok(0.564438202407636));
}

#[test]
fn orders_and_choices() {
    let g = || Generator::pcg64(7_u64);
    let choice = |population, count, sampling| g().choice(population, count, sampling).unwrap();
    assert_eq!(g().permutation(8).unwrap(), [0, 6, 7, 2, 4, 5, 1, 3]);
    assert_eq!(choice(20, 5, Sampling::WithReplacement), [18, 12, 13, 17, 11]);
    // Few of many are drawn by another algorithm than a good part of them.
    assert_eq!(choice(20, 5, Sampling::WithoutReplacement), [10, 12, 15, 11, 17]);
    assert_eq!(choice(100_000, 4, Sampling::WithoutReplacement), [94487, 62508, 89721, 68417]);
    assert_eq!(choice(4, 6, Sampling::Weighted(&[0.1, 0.2, 0.3, 0.4])), [3, 3, 3, 1, 2, 3]);
    let weights = [0.1, 0.2, 0.3, 0.2, 0.2];
    assert_eq!(choice(5, 3, Sampling::WeightedWithoutReplacement(&weights)), [3, 4, 1]);
}

#[test]
fn the_legacy_state() {
    let mut r = RandomState::new(99);
    assert_eq!(r.random(), 0.6722785586307918);
    assert_eq!(r.normal(2.0, 3.0), Ok(5.92537595000416));
    assert_eq!(r.randint(0..10), Ok(2));
    assert_eq!(r.uniform(-1.0, 3.0), Ok(1.8040362241283048));
    assert_eq!(r.permutation(6).unwrap(), [0, 5, 2, 3, 1, 4]);
    assert_eq!(r.choice(10, 4, Sampling::WithoutReplacement).unwrap(), [4, 9, 6, 2]);
    // The second of the pair that the first normal draw made.
    assert_eq!(r.normal(0.0, 1.0), Ok(-0.04792366486453975));
}
