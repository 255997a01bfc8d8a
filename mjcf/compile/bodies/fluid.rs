//! Fluid interaction of a geom: the added mass and inertia of its equivalent ellipsoid.
//!
//! Documentation, Computation chapter, "Ellipsoid model": the kappa integrals by 15-point Kronrod quadrature
//! after the substitution l = x³/(1-x)².

use crate::vector::EPS;
use physics::math::Vec3;
use physics::math::ops;
use physics::model::GeomType;
use std::f64::consts::PI;

const WEIGHT: [f64; 15] = [
    0.01146766, 0.03154605, 0.05239501, 0.07032663, 0.08450236, 0.09517529, 0.10221647, 0.10474107,
    0.10221647, 0.09517529, 0.08450236, 0.07032663, 0.05239501, 0.03154605, 0.01146766,
];
const POINT: [f64; 15] = [
    7.865151709349917e-08,
    1.7347976913907274e-05,
    0.0003548008144506193,
    0.002846636252924549,
    0.014094260903596077,
    0.053063261727396636,
    0.17041978741317773,
    0.5,
    1.4036301548686991,
    3.9353484827022642,
    11.644841677041734,
    39.53187807410903,
    177.5711362220801,
    1429.4772912937397,
    54087.416549217705,
];
const SLOPE: [f64; 15] = [
    5.538677720489877e-05,
    0.002080868285293228,
    0.016514126520723166,
    0.07261900344370877,
    0.23985243401862602,
    0.6868318249020725,
    1.8551129519182894,
    5.0,
    14.060031152313941,
    43.28941239611009,
    156.58546376397112,
    747.9826085305024,
    5827.4042950027115,
    116754.0197944512,
    25482945.327264845,
];

/// Integral of added mass along the semiaxis `x`.
fn kappa(x: f64, y: f64, z: f64) -> f64 {
    let (ix, iy, iz) = (1.0 / (x * x), 1.0 / (y * y), 1.0 / (z * z));
    let scale = ops::pow(x * x * x * y * z, 0.4);
    let mut sum = 0.0;
    for i in 0..15 {
        let l = scale * POINT[i];
        let denominator = (1.0 + l * ix) * ((1.0 + l * ix) * (1.0 + l * iy) * (1.0 + l * iz)).sqrt();
        sum += scale * SLOPE[i] / denominator * WEIGHT[i];
    }
    sum * ix
}

fn semiaxes(kind: GeomType, s: Vec3) -> Vec3 {
    match kind {
        GeomType::Sphere => [s[0]; 3],
        GeomType::Capsule => [s[0], s[0], s[1] + s[0]],
        GeomType::Cylinder => [s[0], s[0], s[1]],
        _ => s,
    }
}

/// Row of `geom_fluid`: switch, five coefficients, virtual mass, virtual inertia.
pub(super) fn coefficients(kind: GeomType, size: Vec3, switch: f64, coefs: [f64; 5]) -> [f64; 12] {
    let [x, y, z] = semiaxes(kind, size);
    let volume = 4.0 / 3.0 * PI * x * y * z;
    let (kx, ky, kz) = (kappa(x, y, z), kappa(y, z, x), kappa(z, x, y));
    let square = |v: f64| v * v;
    let moment = |a: f64, b: f64, ka: f64, kb: f64| {
        let (difference, sum) = (a * a - b * b, a * a + b * b);
        let factor =
            square(difference) * (kb - ka).abs() / EPS.max((2.0 * difference + sum * (ka - kb)).abs());
        volume * factor / 5.0
    };
    let mass = |k: f64| volume * k / EPS.max(2.0 - k);
    let mut row = [0.0; 12];
    row[0] = switch;
    row[1..6].copy_from_slice(&coefs);
    row[6..9].copy_from_slice(&[mass(kx), mass(ky), mass(kz)]);
    row[9..12].copy_from_slice(&[moment(y, z, ky, kz), moment(z, x, kz, kx), moment(x, y, kx, ky)]);
    row
}
