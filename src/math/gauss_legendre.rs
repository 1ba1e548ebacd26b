//! Nodes and weights of Gauss–Legendre quadrature on [−1, 1], by Newton's method on P_n.

use std::f64::consts::PI;

/// `count` nodes, ascending, with their weights.
pub fn nodes(count: usize) -> Vec<(f64, f64)> {
    (0..count).map(|i| node(count, i)).collect()
}

/// The node number `i` of `count`, from 0, and its weight: for those who share the work out.
pub fn node(count: usize, i: usize) -> (f64, f64) {
    // Tricomi's start is within the basin of every root.
    let mut x = -(PI * (i as f64 + 0.75) / (count as f64 + 0.5)).cos();
    let mut slope = 1.0;
    for _ in 0..100 {
        let (value, derivative) = legendre(count, x);
        slope = derivative;
        let step = value / derivative;
        x -= step;
        if step.abs() < 1e-15 {
            break;
        }
    }
    (x, 2.0 / ((1.0 - x * x) * slope * slope))
}

/// P_n and its derivative.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut now) = (1.0, x);
    for k in 1..n {
        let k = k as f64;
        (before, now) = (now, ((2.0 * k + 1.0) * x * now - k * before) / (k + 1.0));
    }
    (now, n as f64 * (before - x * now) / (1.0 - x * x))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Exact for polynomials up to degree 2n − 1.
    #[test]
    fn powers_are_integrated_exactly() {
        for count in [1, 2, 5, 20, 101] {
            for power in (0..(2 * count).min(40)).step_by(2) {
                let sum: f64 = nodes(count).iter().map(|(x, w)| w * x.powi(power as i32)).sum();
                let expected = 2.0 / (power + 1) as f64;
                assert!((sum - expected).abs() < 1e-13, "{count} {power}: {sum}");
            }
        }
    }
}
