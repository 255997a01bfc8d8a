//! How alike two pictures are.

/// Luma of BT.601 in the limited range, rounded, of each pixel.
pub fn luma(rgb: &[u8]) -> Vec<u8> {
    let weigh = |[r, g, b]: &[u8; 3]| {
        let luma = 0.299 * f64::from(*r) + 0.587 * f64::from(*g) + 0.114 * f64::from(*b);
        (16.0 + luma * 219.0 / 255.0).round() as u8
    };
    rgb.as_chunks::<3>().0.iter().map(weigh).collect()
}

/// Peak signal to noise ratio \[dB\]; infinite for equal pictures.
pub fn psnr(a: &[u8], b: &[u8]) -> f64 {
    assert_eq!(a.len(), b.len());
    let squares: f64 = a.iter().zip(b).map(|(&a, &b)| f64::from(a.abs_diff(b)).powi(2)).sum();
    10.0 * (255.0 * 255.0 * a.len() as f64 / squares).log10()
}
