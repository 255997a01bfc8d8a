//! Natural logarithms as numpy meets them: the operations of glibc 2.36 on a processor with fused
//! multiply-add, one by one.
//!
//! A normal draw of the legacy generator is a logarithm, so its last bit is the logarithm's. The crate `libm`
//! gives another last bit for 7 % of arguments in [0, 1) (`log`) and 0.08 % (`log1p`); these functions gave
//! none in 60 million. The methods come from Arm's optimized routines (`log`, MIT) and Sun's fdlibm
//! (`log1p`), the coefficients theirs; the order of operations, and where products are fused with sums,
//! decides the last bit.

use libm::fma;

/// log 2 as a sum: a part whose products with exponents are exact, and the rest.
const LN2: [f64; 2] = [0.6931471805598903, 5.497923018708371e-14];
/// Series of log(1 + r) after its first term, for |r| < 2⁻⁸.
const SERIES: [f64; 5] = [
    -0.5000000000000001,
    0.33333333331825593,
    -0.2499999999622955,
    0.20000304511814496,
    -0.16667054827627667,
];
/// The same for arguments between `NEAR_ONE`.
const SERIES_NEAR_ONE: [f64; 11] = [
    -0.5,
    0.3333333333333352,
    -0.24999999999998432,
    0.19999999999320328,
    -0.16666666669929706,
    0.14285715076560868,
    -0.12499997863982555,
    0.11110712032936046,
    -0.10000486757818193,
    0.09181994006195467,
    -0.08328363062289341,
];
/// Arguments whose logarithm is computed without the table: 1 - 2⁻⁴ and 1 + 265/4096.
const NEAR_ONE: std::ops::Range<f64> = 0.9375..1.064697265625;

/// log x of a positive, finite, normal `x`.
pub(crate) fn log(x: f64) -> f64 {
    if NEAR_ONE.contains(&x) { log_near_one(x) } else { log_by_table(x) }
}

/// The logarithm of 2^k z is k log 2 + log c + log(z/c), with c in the table near z.
fn log_by_table(x: f64) -> f64 {
    /// Bits of the lower end of the interval of z, about 0.69.
    const LOWEST: u64 = 0x3fe6_0000_0000_0000;
    const EXPONENT: u64 = 0xfff << 52;
    let above = x.to_bits().wrapping_sub(LOWEST);
    let exponent = (above as i64 >> 52) as f64;
    let z = f64::from_bits(x.to_bits().wrapping_sub(above & EXPONENT));
    let (reciprocal, log_c) = CENTERS[(above >> 45) as usize % CENTERS.len()];

    let r = fma(z, reciprocal, -1.0);
    let square = r * r;
    let whole = fma(exponent, LN2[0], log_c);
    let head = whole + r;
    let tail = fma(exponent, LN2[1], (whole - head) + r);
    let first = fma(r, SERIES[2], SERIES[1]);
    let second = fma(r, SERIES[4], SERIES[3]);
    fma(r * square, fma(second, square, first), fma(square, SERIES[0], tail)) + head
}

fn log_near_one(x: f64) -> f64 {
    const SPLIT: f64 = 134_217_728.0; // 2^27
    let c = &SERIES_NEAR_ONE;
    let r = x - 1.0;
    let square = r * r;
    let cube = r * square;
    let first = fma(square, c[3], fma(r, c[2], c[1]));
    let second = fma(square, c[6], fma(r, c[5], c[4]));
    let third = fma(cube, c[10], fma(square, c[9], fma(r, c[8], c[7])));
    let series = fma(fma(third, cube, second), cube, first);

    // r = upper + lower, with an exact square of the upper part: head + tail = r - r²/2.
    let upper = fma(-SPLIT, r, fma(r, SPLIT, r));
    let lower = r - upper;
    let head = fma(upper * upper, c[0], r);
    let tail = fma(c[0] * lower, r + upper, fma(upper * upper, c[0], r - head));
    head + fma(series, cube, tail)
}

/// Coefficients in z = s² of log(1 + f) = 2 s + s R(z), s = f / (2 + f).
const REMAINDER: [f64; 7] = [
    0.6666666666666735,
    0.3999999999940942,
    0.2857142874366239,
    0.22222198432149784,
    0.1818357216161805,
    0.15313837699209373,
    0.14798198605116586,
];

/// log 2 as a sum, for [`log_one_minus`].
const LN2_COARSE: [f64; 2] = [0.6931471803691238, 1.9082149292705877e-10];

/// 1 - u as `2^exponent (1 + f)`, and what the rounding of 1 - u lost, relative to it.
struct Reduced {
    exponent: f64,
    f: f64,
    lost: f64,
}

/// log(1 - u) of `u` in [0, 1).
pub(crate) fn log_one_minus(u: f64) -> f64 {
    /// sqrt(1/2) is about 1 minus this.
    const NO_REDUCTION: f64 = 0.2928934097290039;
    if u < 1.0 / (1_u64 << 54) as f64 {
        return -u;
    }
    if u < 1.0 / (1_u64 << 29) as f64 {
        return fma(-(u * u), 0.5, -u);
    }
    if u < NO_REDUCTION {
        return log_reduced(&Reduced { exponent: 0.0, f: -u, lost: 0.0 });
    }
    let difference = 1.0 - u;
    let lost = (-u - (difference - 1.0)) / difference;
    reduce(difference, lost)
}

fn reduce(difference: f64, lost: f64) -> f64 {
    const FRACTION: u64 = (1 << 52) - 1;
    let fraction = difference.to_bits() & FRACTION;
    let exponent = (difference.to_bits() >> 52) as f64 - 1023.0;
    // The upper twenty bits decide on which side of sqrt(2) the fraction lies, and whether it is next to a
    // power of two.
    let upper = fraction >> 32;
    let reduced = if upper < 0x6_a09e {
        Reduced { exponent, f: f64::from_bits(fraction | 1.0_f64.to_bits()) - 1.0, lost }
    } else {
        Reduced { exponent: exponent + 1.0, f: f64::from_bits(fraction | 0.5_f64.to_bits()) - 1.0, lost }
    };
    if upper == 0 || upper > 0xf_fffc { log_next_to_power(&reduced) } else { log_reduced(&reduced) }
}

/// The logarithm where |f| is at most about 2⁻¹⁸: two terms of the series.
fn log_next_to_power(Reduced { exponent, f, lost }: &Reduced) -> f64 {
    let quadratic = 0.5 * f * f * fma(-f, 0.66666666666666666, 1.0);
    let small = fma(*exponent, LN2_COARSE[1], *lost);
    fma(*exponent, LN2_COARSE[0], -((quadratic - small) - f))
}

fn log_reduced(Reduced { exponent, f, lost }: &Reduced) -> f64 {
    let c = &REMAINDER;
    let half_square = 0.5 * f * f;
    let s = f / (2.0 + f);
    let z = s * s;
    let z2 = z * z;
    let z4 = z2 * z2;
    let low = fma(z, c[0], z2 * fma(z, c[2], c[1]));
    let middle = fma(z4, fma(z, c[4], c[3]), low);
    let remainder = fma(z2 * z4, fma(z, c[6], c[5]), middle);
    let correction = (remainder + half_square) * s;
    if *exponent == 0.0 {
        f - (half_square - correction)
    } else {
        let small = fma(*exponent, LN2_COARSE[1], *lost) + correction;
        fma(*exponent, LN2_COARSE[0], -((half_square - small) - f))
    }
}

/// For each of 128 intervals of z a number 1/c, and log c, with c near the middle and chosen so that log c is
/// known to more digits than its own.
static CENTERS: [(f64, f64); 128] = [
    (1.4504249240398293, -0.3718565645633589),
    (1.442253508327276, -0.36620682668944937),
    (1.4341736174350004, -0.3605888069791945),
    (1.426183816329995, -0.3550022171419869),
    (1.4182825527052965, -0.34944666968829097),
    (1.4104682921759335, -0.3439217713603284),
    (1.4027396147468003, -0.3384271921261188),
    (1.3950954438932313, -0.332962831494342),
    (1.3875338232485754, -0.32752794345742586),
    (1.3800539211058593, -0.32212257167088865),
    (1.3726542695419708, -0.3167462884799761),
    (1.3653332798446802, -0.3113985598928366),
    (1.358090204587874, -0.3060794515165526),
    (1.3509234892132138, -0.300788424667644),
    (1.3438320840699889, -0.2955252968476998),
    (1.3368146974742003, -0.29028969275850613),
    (1.329870114677736, -0.2850812793277555),
    (1.322997339161106, -0.27989987391470095),
    (1.316195352741367, -0.27474526621870154),
    (1.3094628125672239, -0.2696169863701243),
    (1.3027990455471041, -0.26451506180308115),
    (1.2962024229438942, -0.2594387762767383),
    (1.2896726275815547, -0.2543884090981692),
    (1.2832080305745537, -0.24936321635129843),
    (1.276807885983376, -0.24436312405975968),
    (1.2704714060687552, -0.23938801747897287),
    (1.2641976054949482, -0.23443761696705678),
    (1.257985357514882, -0.22951151871518505),
    (1.2518337750655457, -0.2246094963439873),
    (1.2457421919097305, -0.21973149037705753),
    (1.2397094966625508, -0.2148770752847895),
    (1.2337348463589233, -0.210046029103637),
    (1.2278176973028803, -0.20523836373934046),
    (1.2219570190618474, -0.20045368751368642),
    (1.2161519732977757, -0.1956917537758045),
    (1.2104018095009725, -0.19095237845203883),
    (1.204705805718973, -0.18623539250290833),
    (1.1990631185441964, -0.18154051731551135),
    (1.1934733004462308, -0.1768677957431919),
    (1.1879350812847385, -0.17221657406412305),
    (1.1824481322833125, -0.16758697765942543),
    (1.1770114976921955, -0.16297859687290384),
    (1.1716248121809465, -0.15839151377804228),
    (1.1662869231674715, -0.15382513241456763),
    (1.1609977486762766, -0.14927976358922024),
    (1.1557563220795803, -0.14475495398119165),
    (1.1505619105480347, -0.14025044090817573),
    (1.1454138888505974, -0.1357660466685502),
    (1.140311877374656, -0.1313018016355727),
    (1.1352550225747513, -0.12685731518763532),
    (1.1302429094831266, -0.1224325737671279),
    (1.1252747693068048, -0.11802724521862729),
    (1.1203501571039876, -0.11364127671663482),
    (1.1154683327680124, -0.10927434611278386),
    (1.1106291463292157, -0.10492665324943573),
    (1.1058315813301596, -0.10059761422644442),
    (1.1010752177696026, -0.09628717309055901),
    (1.0963597137952512, -0.09199534069557558),
    (1.0916844827550398, -0.08772190036688698),
    (1.0870487291277784, -0.08346643613867855),
    (1.082452357388312, -0.07922916827544668),
    (1.0778948225025884, -0.0750099004750382),
    (1.0733751731601076, -0.07080805133352897),
    (1.068893585073351, -0.06662408085151128),
    (1.0644491706655506, -0.06245745471915143),
    (1.0600414846328305, -0.0583080438042316),
    (1.0556701316181605, -0.05417576112313327),
    (1.051334750556926, -0.050060547896805474),
    (1.0470347288442157, -0.045962101199052086),
    (1.0427699229652954, -0.04188056008865715),
    (1.0385395013738175, -0.03781540056183985),
    (1.034343418940345, -0.03376684757915882),
    (1.0301811073173315, -0.029734619131772888),
    (1.026052043621297, -0.025718470239212365),
    (1.0219561082336197, -0.021718543925430822),
    (1.0178926505784922, -0.01773446126981071),
    (1.0138614436244586, -0.013766252464051831),
    (1.0098620186501341, -0.009813706322574944),
    (1.0058938559734134, -0.005876555150052809),
    (1.00195696235014, -0.0019550499938532084),
    (0.9961089923088509, 0.0038985973556009412),
    (0.9884170338185201, 0.011650571286395461),
    (0.9808429191005297, 0.019342955478919066),
    (0.9733840169987446, 0.0269766014846482),
    (0.9660377568876556, 0.034552359728422744),
    (0.9588014945307369, 0.04207121767183253),
    (0.9516728569073111, 0.049533940950141186),
    (0.9446494635965822, 0.056941358295944156),
    (0.9377288993026223, 0.06429439168346107),
    (0.9309091073790681, 0.0715936354946507),
    (0.924187681612722, 0.07884010933776153),
    (0.9175626765599192, 0.08603438905970506),
    (0.9110320403624034, 0.09317721180013905),
    (0.9045935839762024, 0.10026951462748457),
    (0.8982456375922825, 0.10731170956330516),
    (0.8919860966782501, 0.11430473320717738),
    (0.8858131121185129, 0.12124928503033061),
    (0.879725075760676, 0.12814583422959913),
    (0.8737201372634685, 0.1349951636851756),
    (0.8677966405782273, 0.1417978768189414),
    (0.8619528050060739, 0.14855476039031146),
    (0.8561872354420692, 0.1552661937658968),
    (0.8504983927816893, 0.16193275688146969),
    (0.8448844572790304, 0.16855539792220497),
    (0.8393442741575965, 0.1751343179947753),
    (0.8338762249349438, 0.1816702989864325),
    (0.8284789320557778, 0.18816387146023317),
    (0.8231510800065832, 0.1946155228479256),
    (0.8178913903778707, 0.20102572579389744),
    (0.8126984007245374, 0.2073952090795501),
    (0.8075710029460227, 0.21372429840596396),
    (0.8025078881160415, 0.2200135945981856),
    (0.7975077379364331, 0.22626374162859975),
    (0.792569604966373, 0.23247494747693054),
    (0.7876923641254114, 0.23864766620658884),
    (0.7828746724940998, 0.24478265647405806),
    (0.7781155388790811, 0.25088025827324145),
    (0.7734139557869777, 0.2569408552510595),
    (0.7687687179914933, 0.26296511155101143),
    (0.7641790698041854, 0.2689531327189343),
    (0.7596438763692399, 0.27490553924610595),
    (0.7551621951078668, 0.2808227248478943),
    (0.7507331780216866, 0.286704979267256),
    (0.7463557196361751, 0.29255295645509705),
    (0.7420289364869653, 0.2983670386142876),
    (0.7377521537065876, 0.30414734587282055),
    (0.7335242966002608, 0.30989455774829366),
    (0.729344777457841, 0.31560871301871884),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Against another library's logarithm, whose error is below one unit of the last place.
    #[test]
    fn agree_with_another_method() {
        for k in 1..1 << 15 {
            let u = f64::from(k) / f64::from(1 << 15);
            for (ours, x) in [(log(u), u), (log_one_minus(u), 1.0 - u)] {
                let expected = libm::log(x);
                assert!((ours - expected).abs() <= 4e-16 * expected.abs(), "{x}: {ours} {expected}");
            }
        }
    }

    #[test]
    fn small_arguments_keep_their_digits() {
        assert_eq!(log_one_minus(0.0), 0.0);
        assert_eq!(log_one_minus(1e-20), -1e-20);
        assert_eq!(log_one_minus(1e-10), -1.00000000005e-10);
        assert_eq!(log(1.0), 0.0);
    }
}
