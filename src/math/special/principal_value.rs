//! Principal values `P∫ f(x)/(x − s) dx` of a piecewise polynomial, integrated exactly through the
//! pole.
//!
//! On one piece, written in powers of `t = x − s`, the integral is
//! `c₀ ln|t₂/t₁| + Σ cⱼ (t₂ʲ − t₁ʲ)/j`. At a common end of two pieces the logarithms cancel,
//! because `f` is continuous. Far from the pole the powers of `t` would cancel each other, so there
//! the piece is integrated by Gauss's rule, which is then exact to rounding.

use crate::math::curves::spline::quintic_derivatives;

/// Highest power of a piece.
const DEGREE: usize = 5;

/// One piece: ends, and coefficients in powers of the distance from the left end.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    x: [f64; 2],
    c: [f64; DEGREE + 1],
}

/// A continuous piecewise polynomial that is zero outside its pieces.
#[derive(Clone, Debug, PartialEq)]
pub struct PiecewisePolynomial {
    pieces: Vec<Piece>,
}

/// Abscissae and weights of Gauss's eight-point rule on [-1, 1], positive half.
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_361_96),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

impl PiecewisePolynomial {
    /// Straight lines between the points, `x` ascending.
    pub fn linear(x: &[f64], y: &[f64]) -> Self {
        let pieces = x.windows(2).zip(y.windows(2)).map(|(x, y)| line(x[0], x[1], y[0], y[1]));
        Self { pieces: pieces.collect() }
    }

    /// The quintic spline through the points, `x` ascending: smooth to the fourth derivative.
    pub fn spline(x: &[f64], y: &[f64]) -> Self {
        let derivatives = quintic_derivatives(x, y);
        let pieces = (1..x.len()).map(|i| {
            let [a, b] = [derivatives[i - 1], derivatives[i]];
            hermite([x[i - 1], x[i]], [y[i - 1], y[i]], a, b)
        });
        Self { pieces: pieces.collect() }
    }

    /// Lets the function fall to zero along a straight line beyond either end, over the given
    /// lengths; a jump at an end would make the principal value infinite there.
    pub fn tapered(mut self, below: f64, above: f64) -> Self {
        if let Some(&first) = self.pieces.first()
            && first.c[0] != 0.0
        {
            self.pieces.insert(0, line(first.x[0] - below, first.x[0], 0.0, first.c[0]));
        }
        if let Some(&last) = self.pieces.last() {
            let end = last.value(last.x[1]);
            if end != 0.0 {
                self.pieces.push(line(last.x[1], last.x[1] + above, end, 0.0));
            }
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
        let mut sum = c[0] * (ln(t2) - ln(t1));
        let (mut power1, mut power2) = (1.0, 1.0);
        for (j, c) in c.iter().enumerate().skip(1) {
            (power1, power2) = (power1 * t1, power2 * t2);
            sum += c * (power2 - power1) / j as f64;
        }
        sum
    }

    fn value(&self, x: f64) -> f64 {
        let t = x - self.x[0];
        self.c.iter().rev().fold(0.0, |sum, c| sum * t + c)
    }

    /// Coefficients in powers of `x − s`: repeated division by `x − s`.
    fn powers_about(&self, s: f64) -> [f64; DEGREE + 1] {
        let mut c = self.c;
        let d = s - self.x[0];
        for first in 0..DEGREE {
            for j in (first..DEGREE).rev() {
                c[j] += d * c[j + 1];
            }
        }
        c
    }
}

fn line(x0: f64, x1: f64, y0: f64, y1: f64) -> Piece {
    Piece { x: [x0, x1], c: [y0, (y1 - y0) / (x1 - x0), 0.0, 0.0, 0.0, 0.0] }
}

/// The quintic with given values, and first and second derivatives, at both ends.
fn hermite(x: [f64; 2], y: [f64; 2], a: [f64; 2], b: [f64; 2]) -> Piece {
    let h = x[1] - x[0];
    let value = y[1] - y[0] - h * (a[0] + 0.5 * h * a[1]);
    let slope = h * (b[0] - a[0] - h * a[1]);
    let curvature = h * h * (b[1] - a[1]);
    let cubic = 10.0 * value - 4.0 * slope + 0.5 * curvature;
    let quartic = -15.0 * value + 7.0 * slope - curvature;
    let quintic = 6.0 * value - 3.0 * slope + 0.5 * curvature;
    let c = [y[0], a[0], 0.5 * a[1], cubic / h.powi(3), quartic / h.powi(4), quintic / h.powi(5)];
    Piece { x, c }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `P∫₀¹ x⁵/(x − s) dx = s⁵ ln((1−s)/s) + s⁴ + s³/2 + s²/3 + s/4 + 1/5`.
    #[test]
    fn a_quintic_is_exact_inside_and_outside() {
        let piece = hermite([0.0, 1.0], [0.0, 1.0], [0.0, 0.0], [5.0, 20.0]);
        assert!(piece.c[..5].iter().all(|c| c.abs() < 1e-14), "{piece:?}");
        let polynomial = PiecewisePolynomial { pieces: vec![piece] };
        for s in [0.3, 0.5, 0.999, -0.7, 1.5, 4.4, -4.6, 60.0] {
            let s: f64 = s;
            let exact = s.powi(5) * ((1.0 - s) / s).abs().ln()
                + s.powi(4)
                + s.powi(3) / 2.0
                + s * s / 3.0
                + s / 4.0
                + 0.2;
            // Far away the closed form itself loses digits; a series takes its place.
            let series = -(0..60).map(|n| s.powi(-n - 1) / f64::from(6 + n)).sum::<f64>();
            let exact = if s.abs() > 3.0 { series } else { exact };
            let value = polynomial.principal_value(s);
            assert!((value - exact).abs() < 2e-12 * exact.abs().max(1.0), "{s}: {value} {exact}");
        }
    }

    /// The Hilbert transform of `1/(1+x²)` is `−π s/(1+s²)` over the whole line.
    #[test]
    fn a_lorentzian_through_nodes_and_between() {
        // Nodes crowd near the middle, and reach far enough that the cut leaves 1e-9.
        let nodes: Vec<f64> = (-3000..=3000).map(|i| (f64::from(i) * 0.003).sinh()).collect();
        let values: Vec<f64> = nodes.iter().map(|x| 1.0 / (1.0 + x * x)).collect();
        let spline = PiecewisePolynomial::spline(&nodes, &values).tapered(10.0, 10.0);
        let straight = PiecewisePolynomial::linear(&nodes, &values).tapered(10.0, 10.0);
        for s in [0.0_f64, 0.5, nodes[3123], 1.0, 2.0] {
            let exact = -std::f64::consts::PI * s / (1.0 + s * s);
            let (smooth, rough) = (spline.principal_value(s), straight.principal_value(s));
            assert!((smooth - exact).abs() < 1e-9, "{s}: {:e}", smooth - exact);
            assert!((rough - exact).abs() < 1e-4, "{s}: {:e}", rough - exact);
        }
    }
}
