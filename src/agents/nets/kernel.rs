//! The product of two matrices, every sum in one order.
//!
//! An element of the product is the sum over the inner index, from the first on, whatever the sizes, the vectors of the machine and the number of
//! threads: registers hold several elements at once, never several parts of one sum, and nothing is fused. So its bits are the same everywhere.

use std::array::from_fn;
use wide::f32x8;

/// Rows of a block of the product, which stays in registers during the sum; a row of it is a vector.
const ROWS: usize = 8;
const COLUMNS: usize = 8;

/// A matrix whose element of row `i` and column `k` is at `i * strides[0] + k * strides[1]`.
#[derive(Clone, Copy)]
pub struct View<'a> {
    values: &'a [f32],
    strides: [usize; 2],
}

impl<'a> View<'a> {
    /// A matrix of `columns` columns that lies row after row.
    pub fn rows(values: &'a [f32], columns: usize) -> Self {
        View { values, strides: [columns, 1] }
    }

    /// The transpose of a matrix of `columns` columns that lies row after row.
    pub fn transposed(values: &'a [f32], columns: usize) -> Self {
        View { values, strides: [1, columns] }
    }

    fn at(&self, row: usize, column: usize) -> f32 {
        self.values[row * self.strides[0] + column * self.strides[1]]
    }
}

/// Adds the product of `a`, `[rows × inner]`, and `b`, `[inner × columns]` row after row, to `sum`, `[rows × columns]` row after row.
///
/// # Panics
/// `b` or `sum` has another size; `a` is smaller.
pub fn add_product(a: View<'_>, b: &[f32], inner: usize, sum: &mut [f32]) {
    assert!(inner > 0 && b.len().is_multiple_of(inner), "a factor of {} values in {inner} rows", b.len());
    let columns = b.len() / inner;
    assert!(sum.len().is_multiple_of(columns), "a product of {} values in {columns} columns", sum.len());
    let full = sum.len() / (ROWS * columns) * ROWS;
    let (blocks, rest) = sum.split_at_mut(full * columns);
    let mut packed = Vec::with_capacity(inner);
    for (k, strip) in blocks.chunks_exact_mut(ROWS * columns).enumerate() {
        add_strip::<ROWS>(a, k * ROWS, b, &mut packed, strip);
    }
    let mut packed = Vec::with_capacity(inner);
    for (k, row) in rest.chunks_exact_mut(columns).enumerate() {
        add_strip::<1>(a, full + k, b, &mut packed, row);
    }
}

/// Adds rows `first` to `first + R` of the product to `strip`.
fn add_strip<const R: usize>(
    a: View<'_>,
    first: usize,
    b: &[f32],
    packed: &mut Vec<[f32; R]>,
    strip: &mut [f32],
) {
    let columns = strip.len() / R;
    packed.clear();
    packed.resize(b.len() / columns, [0.0; R]);
    for (k, column) in packed.iter_mut().enumerate() {
        for (row, value) in column.iter_mut().enumerate() {
            *value = a.at(first + row, k);
        }
    }
    let whole = columns / COLUMNS * COLUMNS;
    for column in (0..whole).step_by(COLUMNS) {
        add_block(packed, b, [column, COLUMNS], strip, |row| {
            row.first_chunk().map_or(f32x8::ZERO, |row| f32x8::new(*row))
        });
    }
    if whole < columns {
        add_block(packed, b, [whole, columns - whole], strip, padded);
    }
}

/// Adds `count` columns, from `first` on, of `R` rows of the product to `strip`.
#[inline(always)]
fn add_block<const R: usize>(
    a: &[[f32; R]],
    b: &[f32],
    [first, count]: [usize; 2],
    strip: &mut [f32],
    load: impl Fn(&[f32]) -> f32x8,
) {
    let columns = strip.len() / R;
    let place = |row: usize| row * columns + first..row * columns + first + count;
    let mut sums: [f32x8; R] = from_fn(|row| load(&strip[place(row)]));
    for (k, a) in a.iter().enumerate() {
        let b = load(&b[place(k)]);
        for row in 0..R {
            sums[row] += f32x8::splat(a[row]) * b;
        }
    }
    for (row, sums) in sums.iter().enumerate() {
        strip[place(row)].copy_from_slice(&sums.as_array()[..count]);
    }
}

/// Less numbers than a vector has, and zeros.
fn padded(row: &[f32]) -> f32x8 {
    f32x8::new(from_fn(|k| row.get(k).copied().unwrap_or(0.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers that no sum has exactly.
    fn numbers(len: usize, salt: u32) -> Vec<f32> {
        (0..len as u32).map(|k| ((k * 7919 + salt * 104_729) % 2003) as f32 / 1001.0 - 0.9).collect()
    }

    #[test]
    fn every_element_is_the_sum_in_order_whatever_the_block() {
        for (rows, inner, columns) in [(1, 1, 1), (4, 8, 8), (7, 5, 19), (9, 3, 1), (13, 17, 24)] {
            let (a, b) = (numbers(rows * inner, 1), numbers(inner * columns, 2));
            let start = numbers(rows * columns, 3);
            let mut product = start.clone();
            add_product(View::rows(&a, inner), &b, inner, &mut product);
            let turned: Vec<f32> = (0..inner * rows).map(|k| a[k % rows * inner + k / rows]).collect();
            let mut second = start.clone();
            add_product(View::transposed(&turned, rows), &b, inner, &mut second);
            for (place, (value, other)) in product.iter().zip(&second).enumerate() {
                let (row, column) = (place / columns, place % columns);
                let sum = (0..inner)
                    .fold(start[place], |sum, k| sum + a[row * inner + k] * b[k * columns + column]);
                assert_eq!((value.to_bits(), other.to_bits()), (sum.to_bits(), sum.to_bits()));
            }
        }
    }
}
