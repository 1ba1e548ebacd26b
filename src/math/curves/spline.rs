//! Quintic splines through points of any spacing.
//!
//! The unknowns are slope and second derivative at every point; third and fourth derivative are
//! continuous there and zero at the ends. That is a block-tridiagonal system of 2 × 2 blocks. The
//! error falls as h⁶, against h⁴ of the cubic spline.

/// First and second derivatives of the quintic spline at the points, `x` ascending.
pub fn quintic_derivatives(x: &[f64], y: &[f64]) -> Vec<[f64; 2]> {
    let n = x.len();
    if n < 3 {
        let slope = if n == 2 { (y[1] - y[0]) / (x[1] - x[0]) } else { 0.0 };
        return vec![[slope, 0.0]; n];
    }
    // In units of the mean spacing all blocks are of one size.
    let unit = (x[n - 1] - x[0]) / (n - 1) as f64;
    let step = |i: usize| (x[i + 1] - x[i]) / unit;
    let rise = |i: usize| y[i + 1] - y[i];
    // Forward: each point's unknowns in terms of the next one's, v = r − Q w.
    let mut coupling: Vec<Block> = Vec::with_capacity(n);
    let mut right: Vec<[f64; 2]> = Vec::with_capacity(n);
    for i in 0..n {
        let mut own = Block::default();
        let mut next = Block::default();
        let mut known = [0.0; 2];
        if i > 0 {
            let end = Jump::at_right_end(step(i - 1), rise(i - 1));
            own = end.right;
            known = end.known;
            let before = coupling[i - 1];
            own = own.minus(end.left.times(before));
            let carried = end.left.apply(right[i - 1]);
            known = [known[0] + carried[0], known[1] + carried[1]];
        }
        if i + 1 < n {
            let start = Jump::at_left_end(step(i), rise(i));
            own = own.minus(start.left);
            next = Block::default().minus(start.right);
            known = [known[0] - start.known[0], known[1] - start.known[1]];
        }
        let inverse = own.inverse();
        coupling.push(inverse.times(next));
        let r = inverse.apply(known);
        right.push([-r[0], -r[1]]);
    }
    let mut solution = vec![[0.0; 2]; n];
    solution[n - 1] = right[n - 1];
    for i in (0..n - 1).rev() {
        let w = coupling[i].apply(solution[i + 1]);
        solution[i] = [right[i][0] - w[0], right[i][1] - w[1]];
    }
    solution.iter().map(|v| [v[0] / unit, v[1] / (unit * unit)]).collect()
}

/// A 2 × 2 matrix, row by row.
#[derive(Clone, Copy, Debug, Default)]
struct Block([[f64; 2]; 2]);

impl Block {
    fn minus(self, other: Self) -> Self {
        let (a, b) = (self.0, other.0);
        Self([[a[0][0] - b[0][0], a[0][1] - b[0][1]], [a[1][0] - b[1][0], a[1][1] - b[1][1]]])
    }

    fn times(self, other: Self) -> Self {
        let b = other.0;
        let columns = [self.apply([b[0][0], b[1][0]]), self.apply([b[0][1], b[1][1]])];
        Self([[columns[0][0], columns[1][0]], [columns[0][1], columns[1][1]]])
    }

    fn apply(self, v: [f64; 2]) -> [f64; 2] {
        self.0.map(|row| row[0] * v[0] + row[1] * v[1])
    }

    fn inverse(self) -> Self {
        let [[a, b], [c, d]] = self.0;
        let determinant = a * d - b * c;
        Self([[d / determinant, -b / determinant], [-c / determinant, a / determinant]])
    }
}

/// Third and fourth derivative of a piece at one of its ends, linear in the unknowns (slope, second
/// derivative) of its left and its right end: `left·v + right·w + known`.
struct Jump {
    left: Block,
    right: Block,
    known: [f64; 2],
}

impl Jump {
    fn at_left_end(h: f64, rise: f64) -> Self {
        let (h2, h3, h4) = (h * h, h.powi(3), h.powi(4));
        Self {
            left: Block([[-36.0 / h2, -9.0 / h], [192.0 / h3, 36.0 / h2]]),
            right: Block([[-24.0 / h2, 3.0 / h], [168.0 / h3, -24.0 / h2]]),
            known: [60.0 * rise / h3, -360.0 * rise / h4],
        }
    }

    fn at_right_end(h: f64, rise: f64) -> Self {
        let (h2, h3, h4) = (h * h, h.powi(3), h.powi(4));
        Self {
            left: Block([[-24.0 / h2, -3.0 / h], [-168.0 / h3, -24.0 / h2]]),
            right: Block([[-36.0 / h2, 9.0 / h], [-192.0 / h3, 36.0 / h2]]),
            known: [60.0 * rise / h3, 360.0 * rise / h4],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_its_own_spline() {
        let x = [0.0, 0.3, 0.4, 1.0, 1.1, 1.5];
        let y = x.map(|x| 2.0 + 3.0 * x - 4.0 * x * x);
        for (x, d) in x.iter().zip(quintic_derivatives(&x, &y)) {
            assert!((d[0] - (3.0 - 8.0 * x)).abs() < 1e-11, "{d:?}");
            assert!((d[1] + 8.0).abs() < 1e-9, "{d:?}");
        }
    }

    /// Inside, the slope of a sine is met to the order of the spline: halving h divides by 64.
    #[test]
    fn the_order_is_six() {
        let error = |n: usize| {
            let x: Vec<f64> = (0..=n).map(|i| 12.0 * i as f64 / n as f64).collect();
            let y: Vec<f64> = x.iter().map(|x| x.sin()).collect();
            let d = quintic_derivatives(&x, &y);
            let inner = x.iter().zip(&d).filter(|(x, _)| (4.0..=8.0).contains(*x));
            inner.fold(0.0_f64, |worst, (x, d)| worst.max((d[0] - x.cos()).abs()))
        };
        let (coarse, fine) = (error(48), error(96));
        assert!(coarse < 1e-5 && coarse / fine > 40.0, "{coarse:e} {fine:e}");
    }
}
