//! Monotone cubic interpolation of a table: no overshoot between neighbouring rows.
//!
//! A table of positive values stays positive in between, which no ordinary spline can promise.
//! Slopes after Fritsch & Butland, SIAM J. Sci. Stat. Comput. 5, 300 (1984), with the end formula
//! of Moler (*Numerical Computing with MATLAB*, 2004, sec. 3.4).

/// A piecewise cubic through the rows of a table, continuous with its first derivative.
#[derive(Clone, Debug, PartialEq)]
pub struct MonotoneCurve {
    x: Vec<f64>,
    y: Vec<f64>,
    slope: Vec<f64>,
}

impl MonotoneCurve {
    /// A curve through the points; `None` unless there are at least two, all finite, `x` ascending.
    pub fn new(x: Vec<f64>, y: Vec<f64>) -> Option<Self> {
        let finite = x.iter().chain(&y).all(|v| v.is_finite());
        if x.len() < 2 || x.len() != y.len() || !finite || x.windows(2).any(|w| w[0] >= w[1]) {
            return None;
        }
        let slope = slopes(&x, &y);
        Some(Self { x, y, slope })
    }

    /// The curve at `x`; beyond the ends the end value is held.
    pub fn value(&self, x: f64) -> f64 {
        let last = self.x.len() - 1;
        if x <= self.x[0] {
            return self.y[0];
        }
        if x >= self.x[last] {
            return self.y[last];
        }
        let i = self.x.partition_point(|&node| node <= x) - 1;
        let h = self.x[i + 1] - self.x[i];
        let t = (x - self.x[i]) / h;
        let (a, b) = (self.y[i], self.y[i + 1]);
        let (p, q) = (self.slope[i] * h, self.slope[i + 1] * h);
        let chord = b - a;
        a + t * (p + t * (3.0 * chord - 2.0 * p - q + t * (p + q - 2.0 * chord)))
    }

    /// First and last abscissa.
    pub fn range(&self) -> (f64, f64) {
        (self.x[0], self.x[self.x.len() - 1])
    }

    /// Abscissae and ordinates of the rows.
    pub fn points(&self) -> (&[f64], &[f64]) {
        (&self.x, &self.y)
    }
}

fn slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let n = x.len();
    let h: Vec<f64> = x.windows(2).map(|w| w[1] - w[0]).collect();
    let chord: Vec<f64> = y.windows(2).zip(&h).map(|(w, h)| (w[1] - w[0]) / h).collect();
    if n == 2 {
        return vec![chord[0]; 2];
    }
    let mut slope = vec![0.0; n];
    for i in 1..n - 1 {
        let (left, right) = (chord[i - 1], chord[i]);
        if left * right > 0.0 {
            // The weighted harmonic mean keeps both neighbouring pieces monotone.
            let (u, v) = (2.0 * h[i] + h[i - 1], h[i] + 2.0 * h[i - 1]);
            slope[i] = (u + v) / (u / left + v / right);
        }
    }
    slope[0] = end_slope(h[0], h[1], chord[0], chord[1]);
    slope[n - 1] = end_slope(h[n - 2], h[n - 3], chord[n - 2], chord[n - 3]);
    slope
}

/// Three-point slope at an end, limited so that the end piece stays monotone.
fn end_slope(h0: f64, h1: f64, chord0: f64, chord1: f64) -> f64 {
    let slope = ((2.0 * h0 + h1) * chord0 - h0 * chord1) / (h0 + h1);
    if slope * chord0 <= 0.0 {
        0.0
    } else if chord0 * chord1 <= 0.0 && slope.abs() > 3.0 * chord0.abs() {
        3.0 * chord0
    } else {
        slope
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_not_overshot_and_rows_are_met() {
        let x = vec![0.0, 1.0, 2.0, 4.0, 5.0, 5.5];
        let y = vec![0.0, 0.0, 1e-9, 1.0, 1.0, 0.2];
        let curve = MonotoneCurve::new(x.clone(), y.clone()).unwrap();
        for (a, b) in x.iter().zip(&y) {
            assert!((curve.value(*a) - b).abs() < 1e-15);
        }
        for i in 0..=5500 {
            let value = curve.value(i as f64 * 1e-3);
            assert!((0.0..=1.0).contains(&value), "{value} at {i}");
        }
    }

    #[test]
    fn a_smooth_function_is_met_to_third_order() {
        let error = |n: usize| {
            let x: Vec<f64> = (0..=n).map(|i| 0.2 + i as f64 / n as f64).collect();
            let y: Vec<f64> = x.iter().map(|x| x.exp()).collect();
            let curve = MonotoneCurve::new(x, y).unwrap();
            (0..1000)
                .map(|i| 0.2 + i as f64 * 1e-3)
                .fold(0.0_f64, |m, x| m.max((curve.value(x) - x.exp()).abs()))
        };
        assert!(error(40) < 2e-5, "{}", error(40));
        assert!(error(20) / error(40) > 5.0);
    }

    #[test]
    fn rows_out_of_order_make_no_curve() {
        assert!(MonotoneCurve::new(vec![0.0, 2.0, 1.0], vec![0.0; 3]).is_none());
        assert!(MonotoneCurve::new(vec![0.0, 0.0], vec![0.0; 2]).is_none());
        assert!(MonotoneCurve::new(vec![0.0], vec![0.0]).is_none());
    }
}
