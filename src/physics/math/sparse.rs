//! Rows of compressed matrices against dense vectors.

/// Inner product of a sparse row (`values` at `columns`) with dense `x`, summed in four lanes.
pub fn dot_sparse(values: &[f64], columns: &[i32], x: &[f64]) -> f64 {
    let (v4, v_rest) = values.as_chunks::<4>();
    let (c4, c_rest) = columns.as_chunks::<4>();
    let mut lane = [0.0; 4];
    for (v, c) in v4.iter().zip(c4) {
        for i in 0..4 {
            lane[i] += v[i] * x[c[i] as usize];
        }
    }
    let mut sum = (lane[0] + lane[2]) + (lane[1] + lane[3]);
    for (v, c) in v_rest.iter().zip(c_rest) {
        sum += v * x[*c as usize];
    }
    sum
}

/// `x[columns] += s values`.
pub fn scatter_scaled(values: &[f64], columns: &[i32], s: f64, x: &mut [f64]) {
    for (v, c) in values.iter().zip(columns) {
        x[*c as usize] += v * s;
    }
}

/// `y += s x`.
pub fn add_scaled_slice(y: &mut [f64], x: &[f64], s: f64) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += s * x;
    }
}
