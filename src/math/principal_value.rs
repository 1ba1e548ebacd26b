//! Principal values `P∫ f(x)/(x − s) dx` of a piecewise cubic, integrated exactly through the pole.
//!
//! On one piece `f` is a cubic; written in powers of `t = x − s` its integral is
//! `c₀ ln|t₂/t₁| + c₁(t₂ − t₁) + c₂(t₂² − t₁²)/2 + c₃(t₂³ − t₁³)/3`. At a common end of two pieces
//! the logarithms cancel, because `f` is continuous. Far from the pole the powers of `t` would
//! cancel each other, so there the piece is integrated by Gauss's rule, which is then exact to
//! rounding.

/// One cubic piece: ends, values and slopes there.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    x: [f64; 2],
    y: [f64; 2],
    slope: [f64; 2],
}

/// A continuous piecewise cubic that is zero outside its pieces.
#[derive(Clone, Debug, PartialEq)]
pub struct PiecewiseCubic {
    pieces: Vec<Piece>,
}

/// Abscissae and weights of Gauss's eight-point rule on [-1, 1], positive half.
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_361_96),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

impl PiecewiseCubic {
    /// Straight lines between the points, `x` ascending.
    pub fn linear(x: &[f64], y: &[f64]) -> Self {
        let pieces = x.windows(2).zip(y.windows(2)).map(|(x, y)| line(x[0], x[1], y[0], y[1]));
        Self { pieces: pieces.collect() }
    }

    /// The twice continuously differentiable spline with free ends through the points.
    pub fn spline(x: &[f64], y: &[f64]) -> Self {
        let slope = spline_slopes(x, y);
        let piece = |i: usize| Piece {
            x: [x[i], x[i + 1]],
            y: [y[i], y[i + 1]],
            slope: [slope[i], slope[i + 1]],
        };
        Self { pieces: (0..x.len().saturating_sub(1)).map(piece).collect() }
    }

    /// Lets the function fall to zero along a straight line beyond either end, over the given
    /// lengths; a jump at an end would make the principal value infinite there.
    pub fn tapered(mut self, below: f64, above: f64) -> Self {
        if let Some(&first) = self.pieces.first()
            && first.y[0] != 0.0
        {
            self.pieces.insert(0, line(first.x[0] - below, first.x[0], 0.0, first.y[0]));
        }
        if let Some(&last) = self.pieces.last()
            && last.y[1] != 0.0
        {
            self.pieces.push(line(last.x[1], last.x[1] + above, last.y[1], 0.0));
        }
        self
    }

    /// `P∫ f(x)/(x − s) dx` over all pieces.
    pub fn principal_value(&self, s: f64) -> f64 {
        self.pieces.iter().map(|piece| piece.integral(s)).sum()
    }
}

impl Piece {
    fn integral(&self, s: f64) -> f64 {
        let half = 0.5 * (self.x[1] - self.x[0]);
        let middle = 0.5 * (self.x[0] + self.x[1]);
        if (s - middle).abs() > 8.0 * half { self.far(s, middle, half) } else { self.near(s) }
    }

    fn far(&self, s: f64, middle: f64, half: f64) -> f64 {
        let term = |x: f64| self.value(x) / (x - s);
        let sum: f64 = GAUSS
            .iter()
            .map(|&(u, w)| w * (term(middle - half * u) + term(middle + half * u)))
            .sum();
        half * sum
    }

    fn near(&self, s: f64) -> f64 {
        let (t1, t2) = (self.x[0] - s, self.x[1] - s);
        let c = self.powers_about(s);
        // At an end the logarithm is infinite, and cancels with the neighbour's.
        let ln = |t: f64| if t == 0.0 { 0.0 } else { t.abs().ln() };
        let difference = |n: i32| (t2.powi(n) - t1.powi(n)) / f64::from(n);
        c[0] * (ln(t2) - ln(t1))
            + c[1] * difference(1)
            + c[2] * difference(2)
            + c[3] * difference(3)
    }

    fn value(&self, x: f64) -> f64 {
        let c = self.powers_about(self.x[0]);
        let t = x - self.x[0];
        c[0] + t * (c[1] + t * (c[2] + t * c[3]))
    }

    /// Coefficients of the cubic in powers of `x − s`.
    fn powers_about(&self, s: f64) -> [f64; 4] {
        let h = self.x[1] - self.x[0];
        let chord = (self.y[1] - self.y[0]) / h;
        let b = (3.0 * chord - 2.0 * self.slope[0] - self.slope[1]) / h;
        let a = (self.slope[0] + self.slope[1] - 2.0 * chord) / (h * h);
        let d = s - self.x[0];
        [
            self.y[0] + d * (self.slope[0] + d * (b + d * a)),
            self.slope[0] + d * (2.0 * b + 3.0 * d * a),
            b + 3.0 * d * a,
            a,
        ]
    }
}

fn line(x0: f64, x1: f64, y0: f64, y1: f64) -> Piece {
    let slope = (y1 - y0) / (x1 - x0);
    Piece { x: [x0, x1], y: [y0, y1], slope: [slope; 2] }
}

/// Slopes of the natural spline: a tridiagonal system, solved by elimination.
fn spline_slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let n = x.len();
    if n < 2 {
        return vec![0.0; n];
    }
    let h: Vec<f64> = x.windows(2).map(|w| w[1] - w[0]).collect();
    let chord: Vec<f64> = y.windows(2).zip(&h).map(|(w, h)| (w[1] - w[0]) / h).collect();
    let (mut diagonal, mut right) = (vec![2.0; n], vec![0.0; n]);
    let (mut lower, mut upper) = (vec![0.0; n], vec![0.0; n]);
    (upper[0], right[0]) = (1.0, 3.0 * chord[0]);
    (lower[n - 1], right[n - 1]) = (1.0, 3.0 * chord[n - 2]);
    for i in 1..n - 1 {
        let weight = h[i] / (h[i - 1] + h[i]);
        (lower[i], upper[i]) = (weight, 1.0 - weight);
        right[i] = 3.0 * (weight * chord[i - 1] + (1.0 - weight) * chord[i]);
    }
    for i in 1..n {
        let factor = lower[i] / diagonal[i - 1];
        diagonal[i] -= factor * upper[i - 1];
        right[i] -= factor * right[i - 1];
    }
    let mut slope = vec![0.0; n];
    slope[n - 1] = right[n - 1] / diagonal[n - 1];
    for i in (0..n - 1).rev() {
        slope[i] = (right[i] - upper[i] * slope[i + 1]) / diagonal[i];
    }
    slope
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `P∫₀¹ x³/(x − s) dx = s³ ln((1−s)/s) + s² + s/2 + 1/3`.
    #[test]
    fn a_cubic_is_exact_inside_and_outside() {
        let piece = Piece { x: [0.0, 1.0], y: [0.0, 1.0], slope: [0.0, 3.0] };
        let cubic = PiecewiseCubic { pieces: vec![piece] };
        for s in [0.3, 0.5, 0.999, -0.7, 1.5, 4.4, -4.6, 60.0] {
            let s: f64 = s;
            let exact = s.powi(3) * ((1.0 - s) / s).abs().ln() + s * s + s / 2.0 + 1.0 / 3.0;
            // Far away the closed form itself loses digits; a series takes its place.
            let series: f64 = -(0..40).map(|n| s.powi(-n - 1) / f64::from(4 + n)).sum::<f64>();
            let exact = if s.abs() > 3.0 { series } else { exact };
            let value = cubic.principal_value(s);
            assert!((value - exact).abs() < 3e-14 * exact.abs().max(1.0), "{s}: {value} {exact}");
        }
    }

    /// The Hilbert transform of `1/(1+x²)` is `−π s/(1+s²)` over the whole line.
    #[test]
    fn a_lorentzian_through_nodes_and_between() {
        let nodes: Vec<f64> = (-4000..=4000).map(|i| f64::from(i) * 0.05).collect();
        let values: Vec<f64> = nodes.iter().map(|x| 1.0 / (1.0 + x * x)).collect();
        let spline = PiecewiseCubic::spline(&nodes, &values).tapered(1e3, 1e3);
        let straight = PiecewiseCubic::linear(&nodes, &values).tapered(1e3, 1e3);
        for s in [0.0_f64, 0.5, 0.5123, 1.0, 2.0] {
            let exact = -std::f64::consts::PI * s / (1.0 + s * s);
            // The cut at ±200 alone leaves 2s/(3·200³) and the taper a little more.
            assert!((spline.principal_value(s) - exact).abs() < 2e-4 * s.max(1e-2), "{s}");
            assert!((straight.principal_value(s) - exact).abs() < 3e-3, "{s}");
        }
    }
}
