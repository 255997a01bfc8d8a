//! Requests that cannot be met are refused and draw nothing; saved states go on as the generator would have.

use robohive_random::{
    BitGenerator, Entropy, Generator, Mt19937, Pcg64, RandomError, RandomState, Sampling, SeedSequence,
};

/// Calls that must fail, each with the error it must give.
#[test]
fn bad_requests_are_refused_before_the_first_draw() {
    let mut g = Generator::pcg64(3_u64);
    let before = g.clone();
    let nan = f64::NAN;
    let weights = |sampling: Sampling| Generator::pcg64(0_u64).choice(2, 2, sampling).unwrap_err();
    assert_eq!(g.integer(5..5).unwrap_err(), RandomError::EmptyRange { low: 5, high: 5, closed: false });
    let (first, last) = (1_u8, 0);
    assert_eq!(g.integer(first..=last), Err(RandomError::EmptyRange { low: 1, high: 0, closed: true }));
    let (first, end) = (i64::MAX, i64::MIN);
    assert!(matches!(g.integer(first..end), Err(RandomError::EmptyRange { .. })));
    assert!(matches!(g.uniform(1.0, 0.0), Err(RandomError::ReversedInterval { .. })));
    assert!(matches!(g.uniform(-1e308, 1e308), Err(RandomError::UnboundedInterval { .. })));
    assert!(matches!(g.uniform(nan, 1.0), Err(RandomError::UnboundedInterval { .. })));
    assert!(matches!(g.normal(0.0, -1.0), Err(RandomError::BadScale { .. })));
    assert!(matches!(g.normal(0.0, nan), Err(RandomError::BadScale { .. })));
    let mut three = [0.0; 3];
    assert_eq!(
        g.fill_uniform_each(&[0.0; 3], &[1.0; 2], &mut three),
        Err(RandomError::LengthMismatch { expected: 3, found: 2 })
    );
    assert!(g.fill_uniform_each(&[0.0; 3], &[1.0, 1.0, -1.0], &mut three).is_err());
    assert_eq!(three, [0.0; 3]);
    assert_eq!(g.choice(0, 1, Sampling::WithReplacement), Err(RandomError::EmptyPopulation));
    assert_eq!(g.choose::<u8>(&[]), Err(RandomError::EmptyPopulation));
    assert_eq!(
        g.choice(2, 3, Sampling::WithoutReplacement),
        Err(RandomError::SampleTooLarge { count: 3, population: 2 })
    );
    let huge = g.choice(usize::MAX, usize::MAX, Sampling::WithoutReplacement);
    assert_eq!(huge, Err(RandomError::OutOfMemory { count: usize::MAX }));
    assert_eq!(g.permutation(usize::MAX), Err(RandomError::OutOfMemory { count: usize::MAX }));
    assert_eq!(g, before);

    assert_eq!(weights(Sampling::Weighted(&[1.0])), RandomError::WeightCount { weights: 1, population: 2 });
    assert_eq!(weights(Sampling::Weighted(&[0.5, 0.4])), RandomError::WeightSum { sum: 0.9 });
    assert_eq!(weights(Sampling::Weighted(&[1.5, -0.5])), RandomError::BadWeight { index: 1, weight: -0.5 });
    assert!(matches!(weights(Sampling::Weighted(&[nan, 1.0])), RandomError::BadWeight { index: 0, .. }));
    assert!(matches!(weights(Sampling::Weighted(&[f64::INFINITY, 0.0])), RandomError::WeightSum { .. }));
    assert_eq!(
        weights(Sampling::WeightedWithoutReplacement(&[1.0, 0.0])),
        RandomError::TooFewWeights { count: 2, positive: 1 }
    );
}

/// numpy accepts sums within 2^-26 of 1.
#[test]
fn weights_may_miss_one_by_rounding() {
    let choose = |excess: f64| Generator::pcg64(0_u64).choice(2, 1, Sampling::Weighted(&[0.5, 0.5 + excess]));
    assert!(choose(1.4e-8).is_ok());
    assert!(choose(1.6e-8).is_err());
}

#[test]
fn nothing_can_be_chosen_from_nothing() {
    for sampling in [Sampling::WithReplacement, Sampling::WithoutReplacement, Sampling::Unordered] {
        assert_eq!(Generator::pcg64(0_u64).choice(0, 0, sampling), Ok(vec![]));
        assert_eq!(RandomState::new(0).choice(0, 0, sampling), Ok(vec![]));
    }
}

/// Legacy intervals may be reversed, as numpy's may.
#[test]
fn legacy_refuses_less() {
    let mut r = RandomState::new(1);
    assert!((-1.0..=2.0).contains(&r.uniform(2.0, -1.0).unwrap()));
    assert!(r.uniform(0.0, f64::INFINITY).is_err());
    assert!(r.randint(0..0).is_err());
    assert_eq!(RandomState::from_key(&[]).unwrap_err(), RandomError::EmptyKey);
}

/// Saved between two halves of a word of 64 bits.
#[test]
fn a_saved_generator_goes_on() {
    let mut pcg = Pcg64::new(9_u64);
    pcg.next_u32();
    let mut again = Pcg64::from_state(&pcg.state()).unwrap();
    let mut twister = Mt19937::new(9_u64);
    for _ in 0..700 {
        twister.next_u32();
    }
    let mut twin = Mt19937::from_state(&twister.state()).unwrap();
    for _ in 0..2000 {
        assert_eq!(pcg.next_u32(), again.next_u32());
        assert_eq!(twister.next_u64(), twin.next_u64());
    }
}

#[test]
fn impossible_states_are_refused() {
    let even = robohive_random::Pcg64State { inc: 2, ..Pcg64::new(0_u64).state() };
    assert!(matches!(Pcg64::from_state(&even), Err(RandomError::BadState { .. })));
    let state = Mt19937::new(0_u64).state();
    let beyond = robohive_random::Mt19937State { pos: 625, ..state };
    assert!(matches!(Mt19937::from_state(&beyond), Err(RandomError::BadState { .. })));
    let zero = robohive_random::Mt19937State { key: [0; 624], ..state };
    assert!(matches!(Mt19937::from_state(&zero), Err(RandomError::BadState { .. })));
}

#[test]
fn seeds_are_read_from_text() {
    let same = |text: &str, number: u128| assert_eq!(text.parse::<Entropy>(), Ok(number.into()), "{text}");
    same("0", 0);
    same("000004294967296", 1 << 32);
    same("340282366920938463463374607431768211455", u128::MAX);
    same("0xffFFffffFFFFffffffffffffffffffff", u128::MAX);
    for text in ["", "0x", "-1", "1.5", "12 ", "ten", &"9".repeat(5000)] {
        assert_eq!(text.parse::<Entropy>(), Err(RandomError::BadSeed), "{text}");
    }
}

#[test]
fn children_are_descendants_by_number() {
    let mut parent = SeedSequence::new(7_u64);
    parent.spawn();
    assert_eq!(parent.spawn(), SeedSequence::with_spawn_key(7_u64, [1]));
}

#[test]
fn errors_are_sentences() {
    let texts = [
        Generator::pcg64(0_u64).integer(3..3).unwrap_err().to_string(),
        Generator::pcg64(0_u64).choice(3, 4, Sampling::Unordered).unwrap_err().to_string(),
    ];
    assert_eq!(texts[0], "the range 3..3 contains no integer: give a larger upper end");
    assert_eq!(
        texts[1],
        "4 members cannot be chosen without replacement from 3: choose fewer, or with replacement"
    );
}
