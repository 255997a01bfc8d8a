//! Laws of distributions, with bounds of five standard deviations: seeds are fixed, so a draw that once passes always does.

use robohive_random::{Generator, Integer, Mt19937, Pcg64, Sampling};

const DRAWS: usize = 60_000;

/// Pearson's sum over cells with these expected counts must lie within five standard deviations of its mean.
#[track_caller]
fn assert_fits(counts: &[usize], expected: &[f64]) {
    let sum: f64 = counts.iter().zip(expected).map(|(&n, e)| (n as f64 - e).powi(2) / e).sum();
    let freedom = (counts.len() - 1) as f64;
    assert!((sum - freedom).abs() < 5.0 * (2.0 * freedom).sqrt(), "{sum} with {freedom} degrees: {counts:?}");
}

fn counts(cells: usize, draws: impl IntoIterator<Item = usize>) -> Vec<usize> {
    let mut counts = vec![0; cells];
    draws.into_iter().for_each(|cell| counts[cell] += 1);
    counts
}

#[test]
fn uniform_draws_fill_the_interval() {
    let mut g = Generator::new(Pcg64::new(1_u64));
    let mut twister = Generator::new(Mt19937::new(1_u64));
    let tenths = |x: f64| {
        assert!((0.0..1.0).contains(&x), "{x}");
        (x * 10.0) as usize
    };
    assert_fits(&counts(10, (0..DRAWS).map(|_| tenths(g.random()))), &[DRAWS as f64 / 10.0; 10]);
    assert_fits(&counts(10, (0..DRAWS).map(|_| tenths(twister.random()))), &[DRAWS as f64 / 10.0; 10]);
    let scaled = |x: f64| tenths((x + 3.0) / 8.0);
    let drawn = (0..DRAWS).map(|_| scaled(g.uniform(-3.0, 5.0).unwrap()));
    assert_fits(&counts(10, drawn), &[DRAWS as f64 / 10.0; 10]);
}

#[test]
fn normal_draws_have_their_moments_and_tails() {
    let mut g = Generator::pcg64(2_u64);
    let n = 400_000;
    let draws: Vec<f64> = (0..n).map(|_| g.standard_normal()).collect();
    let moment = |k: i32| draws.iter().map(|x| x.powi(k)).sum::<f64>() / n as f64;
    // Variances of the estimates: 1, 2, 15 and 96, divided by the number of draws.
    for (k, (expected, variance)) in
        [(0.0, 1.0), (1.0, 2.0), (0.0, 15.0), (3.0, 96.0f64)].into_iter().enumerate()
    {
        let found = moment(k as i32 + 1);
        assert!((found - expected).abs() < 5.0 * (variance / n as f64).sqrt(), "moment {}: {found}", k + 1);
    }
    // Beyond 3.654 draws come from the tail of the ziggurat.
    for (bound, share) in [(1.0, 0.317_310_5), (2.0, 0.045_500_3), (3.654_152_9, 0.000_258_1)] {
        let beyond = draws.iter().filter(|x| x.abs() > bound).count() as f64;
        let expected: f64 = share * n as f64;
        assert!((beyond - expected).abs() < 5.0 * expected.sqrt(), "{beyond} beyond {bound}, not {expected}");
    }
}

/// Spans that do not divide the range of words would be uneven without rejection.
#[test]
fn integers_are_equally_frequent() {
    fn check<T: Integer + Into<i64>>(low: T, high: T) {
        let mut g = Generator::pcg64(3_u64);
        let (low_number, high_number): (i64, i64) = (low.into(), high.into());
        let cells = (high_number - low_number + 1) as usize;
        let single = (0..DRAWS).map(|_| (g.integer(low..=high).unwrap().into() - low_number) as usize);
        assert_fits(&counts(cells, single), &vec![DRAWS as f64 / cells as f64; cells]);
        let mut many = vec![low; DRAWS];
        g.fill_integers(low..=high, &mut many).unwrap();
        let many = many.into_iter().map(|x| (x.into() - low_number) as usize);
        assert_fits(&counts(cells, many), &vec![DRAWS as f64 / cells as f64; cells]);
    }
    check(0_u8, 170);
    check(-100_i8, 99);
    check(-7_i16, 5);
    check(0_u16, 255);
    check(-3_i32, 3);
    check(0_u32, 99);
    check(i64::MAX - 12, i64::MAX);
}

#[test]
fn every_order_is_equally_frequent() {
    let mut g = Generator::pcg64(4_u64);
    // The number of an order of four in the factorial system.
    let rank = |order: &[usize]| {
        (0..4).fold(0, |sum, i| sum * (4 - i) + order[i + 1..].iter().filter(|&&x| x < order[i]).count())
    };
    let drawn: Vec<usize> = (0..24_000).map(|_| rank(&g.permutation(4).unwrap())).collect();
    assert_fits(&counts(24, drawn), &[1000.0; 24]);
    let drawn: Vec<usize> = (0..24_000)
        .map(|_| {
            let mut items = [0, 1, 2, 3];
            g.shuffle(&mut items);
            rank(&items)
        })
        .collect();
    assert_fits(&counts(24, drawn), &[1000.0; 24]);
}

#[test]
fn samples_have_no_member_twice_and_every_member_as_often() {
    let mut g = Generator::pcg64(5_u64);
    for sampling in [Sampling::WithoutReplacement, Sampling::Unordered] {
        let mut seen = vec![0; 30];
        for _ in 0..6000 {
            let mut sample = g.choice(30, 5, sampling).unwrap();
            sample.iter().for_each(|&member| seen[member] += 1);
            sample.sort_unstable();
            sample.dedup();
            assert_eq!(sample.len(), 5);
        }
        assert_fits(&seen, &[1000.0; 30]);
    }
    let all = g.choice(50, 50, Sampling::WithoutReplacement).unwrap();
    assert_eq!(counts(50, all), [1; 50]);
}

#[test]
fn members_are_as_frequent_as_their_weights() {
    let mut g = Generator::pcg64(6_u64);
    let weights = [0.05, 0.0, 0.5, 0.2, 0.25];
    let seen = counts(5, g.choice(5, DRAWS, Sampling::Weighted(&weights)).unwrap());
    assert_eq!(seen[1], 0);
    let drawn = [seen[0], seen[2], seen[3], seen[4]];
    assert_fits(&drawn, &[0.05, 0.5, 0.2, 0.25].map(|weight| weight * DRAWS as f64));
    // Of two without replacement, the first is as frequent as its weight.
    let first =
        (0..20_000).map(|_| g.choice(5, 2, Sampling::WeightedWithoutReplacement(&weights)).unwrap()[0]);
    let seen = counts(5, first);
    assert_fits(
        &[seen[0], seen[2], seen[3], seen[4]],
        &[0.05, 0.5, 0.2, 0.25].map(|weight| weight * 20_000.0),
    );
}

/// Arrays draw what as many single draws give, for types of 32 and 64 bits and real numbers.
#[test]
fn arrays_are_draws_in_order() {
    let (mut one, mut all) = (Generator::mt19937(7_u64), Generator::mt19937(7_u64));
    let mut normal = [0.0; 100];
    all.fill_normal(-1.0, 0.5, &mut normal).unwrap();
    assert!(normal.iter().all(|&x| Ok(x) == one.normal(-1.0, 0.5)));
    let mut integers = [0_i64; 100];
    all.fill_integers(-1_000_000_000_000_i64..7, &mut integers).unwrap();
    assert!(integers.iter().all(|&x| Ok(x) == one.integer(-1_000_000_000_000_i64..7)));
    let (low, high) = ([-1.0, 0.0, 5.0], [1.0, 0.0, 50.0]);
    let mut each = [0.0; 3];
    all.fill_uniform_each(&low, &high, &mut each).unwrap();
    assert!((0..3).all(|k| Ok(each[k]) == one.uniform(low[k], high[k])) && each[1] == 0.0);
    assert_eq!(one, all);
}
