//! Radial profiles: each partial wave from its own start below the turning point to the surface.
//!
//! A wave starts 24 e-folds inside its turning point with the logarithmic derivative of a
//! homogeneous ball (what the ball really is like there is forgotten on the way out), and is then
//! carried by [`super::steps`]. Every profile is solved with a grid and with half its steps; the
//! difference, 15/16 of the error of the coarser grid, gives the error stated, and is also taken off
//! (Richardson): the result is better than its statement.

use super::matching::{self, Coefficients, Surface};
use super::nodes;
use super::radial_index::RadialIndex;
use super::steps::{Complex, Fields, LANES, Lanes, Real, Step, advance_complex, advance_real};
use crate::math::parallel::*;
use crate::series::{SeriesError, checked_term_count, term_count};
use num_complex::Complex64;

/// e-folds between the start of a wave and its turning point.
const DEPTH: f64 = 24.0;
/// Phase per step of the coarse grid that meets a relative error of 1 at size parameter 1: error
/// falls with its fourth power and about as x^-1.35 (measured, x = 100 to 5000).
const PHASE: f64 = 3.0;
/// Bounds of the phase per step.
const PHASES: (f64, f64) = (2e-3, 1.0);
/// Most steps along the radius.
const MAX_STEPS: f64 = 5e6;
/// Grids are refined at most so often.
const ROUNDS: usize = 6;
/// Rounding errors of a long integration, per step.
const ROUNDING: f64 = 1e-16;

/// Coefficients and their relative error.
pub(super) fn coefficients(
    x: f64,
    index: &impl RadialIndex,
    tolerance: f64,
) -> Result<(Coefficients, f64), SeriesError> {
    checked_term_count(x, Complex64::ONE)?;
    let invalid = |field, value: String, accepted| SeriesError::Invalid { field, value, accepted };
    if !(tolerance > 0.0 && tolerance.is_finite()) {
        return Err(invalid("tolerance", tolerance.to_string(), "a number above 0"));
    }
    let guess = PHASE * (tolerance * x.powf(1.35)).powf(0.25);
    let grid = nodes::coarse(index, x, guess.clamp(PHASES.0, PHASES.1));
    let mut parts = 1;
    let mut coarse = solved(x, index, &grid)?;
    for _ in 0..ROUNDS {
        let steps = 2.0 * (parts * grid.len()) as f64;
        if steps > MAX_STEPS {
            let accepted = "a larger tolerance or a smaller particle (at most 5e6 steps)";
            return Err(invalid("steps of the radial profile", format!("{steps:e}"), accepted));
        }
        let fine = solved(x, index, &nodes::divided(&grid, 2 * parts))?;
        let rounding = ROUNDING * steps;
        let error = distance(&fine, &coarse) / 15.0;
        if error <= tolerance.max(rounding) {
            return Ok((extrapolated(fine, &coarse), error.max(rounding)));
        }
        let factor = (1.3 * (error / tolerance).powf(0.25)).ceil().clamp(2.0, 32.0) as usize;
        (parts, coarse) = if factor == 2 {
            (2 * parts, fine)
        } else {
            let parts = parts * factor;
            (parts, solved(x, index, &nodes::divided(&grid, parts))?)
        };
    }
    let accepted = "a smooth profile whose jumps are told, or a larger tolerance";
    Err(invalid("radial profile: tolerance", tolerance.to_string(), accepted))
}

/// Root mean square of the difference over that of the coefficients, weights 2n + 1.
fn distance(fine: &Coefficients, coarse: &Coefficients) -> f64 {
    let (mut difference, mut size) = (0.0, 0.0);
    for (f, c) in [(&fine.a, &coarse.a), (&fine.b, &coarse.b)] {
        for (n, (f, c)) in f.iter().zip(c).enumerate() {
            let weight = (2 * n + 3) as f64;
            difference += weight * (f - c).norm_sqr();
            size += weight * f.norm_sqr();
        }
    }
    (difference / size).sqrt()
}

/// `fine + (fine - coarse)/15`.
fn extrapolated(mut fine: Coefficients, coarse: &Coefficients) -> Coefficients {
    let pairs = fine.a.iter_mut().zip(&coarse.a).chain(fine.b.iter_mut().zip(&coarse.b));
    for (f, c) in pairs {
        *f += (*f - c) / 15.0;
    }
    fine.absorbed += (fine.absorbed - coarse.absorbed) / 15.0;
    fine
}

/// Solve on one grid.
fn solved(x: f64, index: &impl RadialIndex, nodes: &[f64]) -> Result<Coefficients, SeriesError> {
    let squared = |r: f64| index.squared(r);
    let steps: Vec<Step<Complex64>> =
        nodes.windows(2).map(|pair| Step::new(pair[0], pair[1], x, squared)).collect();
    let at_nodes: Vec<Complex64> = nodes.windows(2).map(|pair| squared(middle(pair))).collect();
    let largest = checked_largest(nodes, &at_nodes)?;
    let starts = Starts { x, largest, nodes, at_nodes: &at_nodes };
    let orders = term_count(x) as usize;
    let chunks = orders.div_ceil(LANES);
    if at_nodes.iter().all(|n2| n2.im == 0.0) {
        let steps: Vec<Step<f64>> = steps.iter().map(Step::real).collect();
        let fields: Vec<_> = (0..chunks)
            .into_par_iter()
            .map(|chunk| {
                let (first, ll, start) = starts.of(chunk);
                let real = |values: [Complex64; LANES]| Real(values.map(|v| v.re));
                let mut fields = Fields {
                    magnetic: start.magnetic.map(real),
                    electric: start.electric.map(real),
                };
                advance_real(&steps[first..], &ll, &mut fields);
                fields
            })
            .collect();
        let pairs = |pick: fn(&Fields<Real>) -> &[Real; 2]| -> Vec<(f64, f64)> {
            let all = fields.iter().flat_map(|f| {
                let [p, c] = *pick(f);
                (0..LANES).map(move |l| (p.0[l], c.0[l]))
            });
            all.take(orders).collect()
        };
        let surface =
            Surface { electric: pairs(|f| &f.electric), magnetic: pairs(|f| &f.magnetic) };
        return Ok(matching::transparent(x, &surface));
    }
    let fields: Vec<_> = (0..chunks)
        .into_par_iter()
        .map(|chunk| {
            let (first, ll, start) = starts.of(chunk);
            let split = |values: [Complex64; LANES]| Complex {
                re: values.map(|v| v.re),
                im: values.map(|v| v.im),
            };
            let mut fields =
                Fields { magnetic: start.magnetic.map(split), electric: start.electric.map(split) };
            advance_complex(&steps[first..], &ll, &mut fields);
            fields
        })
        .collect();
    let pairs = |pick: fn(&Fields<Complex>) -> &[Complex; 2]| -> Vec<(Complex64, Complex64)> {
        let all = fields.iter().flat_map(|f| {
            let [p, c] = *pick(f);
            let value = |v: &Complex, l: usize| Complex64::new(v.re[l], v.im[l]);
            (0..LANES).map(move |l| (value(&p, l), value(&c, l)))
        });
        all.take(orders).collect()
    };
    let surface = Surface { electric: pairs(|f| &f.electric), magnetic: pairs(|f| &f.magnetic) };
    Ok(matching::absorbing(x, &surface))
}

fn middle(pair: &[f64]) -> f64 {
    0.5 * (pair[0] + pair[1])
}

/// The largest |n|; refuses what is no index.
fn checked_largest(nodes: &[f64], squares: &[Complex64]) -> Result<f64, SeriesError> {
    let mut largest = 0.0f64;
    for (pair, n2) in nodes.windows(2).zip(squares) {
        let index = n2.sqrt();
        // A metal's n² may have any real part; n + ik itself has n > 0, k ≥ 0.
        let accepted = n2.is_finite() && index.re > 0.0 && index.im >= 0.0 && n2.norm() < 1e8;
        if !accepted {
            return Err(SeriesError::Invalid {
                field: "index of the radial profile",
                value: format!("{}{:+}i at r = {:.4}", index.re, index.im, middle(pair)),
                accepted: "n + ik with n > 0 and k ≥ 0 (below 1e4) everywhere inside",
            });
        }
        largest = largest.max(index.norm());
    }
    Ok(largest)
}

/// Where waves start.
struct Starts<'a> {
    x: f64,
    largest: f64,
    nodes: &'a [f64],
    at_nodes: &'a [Complex64],
}

impl Starts<'_> {
    /// First step, `l(l+1)`, and fields of the waves of one chunk.
    fn of(&self, chunk: usize) -> (usize, Lanes, Fields<[Complex64; LANES]>) {
        let order = |l: usize| chunk * LANES + l + 1;
        let lowest = order(0) as f64 + 0.5;
        let turning = (lowest / (self.largest * self.x)).min(1.0);
        let start = turning / depth_ratio(DEPTH / lowest);
        let last = self.at_nodes.len() - 1;
        let first = self.nodes.partition_point(|r| *r <= start).saturating_sub(1).min(last);
        // Just outside the node, where the index is that of the step.
        let n2 = self.at_nodes[first];
        let index = n2.sqrt();
        let z = index * (self.x * self.nodes[first]);
        let slopes: [Complex64; LANES] = std::array::from_fn(|l| log_derivative(order(l), z));
        let one = [Complex64::ONE; LANES];
        let fields = Fields {
            magnetic: [one, slopes.map(|d| d * index)],
            electric: [one, slopes.map(|d| d / index)],
        };
        let ll = std::array::from_fn(|l| (order(l) * (order(l) + 1)) as f64);
        (first, ll, fields)
    }
}

/// `cosh u` where `u - tanh u = depth`: that deep, in e-folds per order, is the radius smaller by it.
fn depth_ratio(depth: f64) -> f64 {
    let mut u = (3.0 * depth).cbrt().max(depth);
    for _ in 0..30 {
        let tanh = u.tanh();
        u -= (u - tanh - depth) / (tanh * tanh);
    }
    u.cosh()
}

/// `ψ'_l/ψ_l` for |z| below l.
fn log_derivative(l: usize, z: Complex64) -> Complex64 {
    let inverse = 1.0 / z;
    // One step shrinks an error by (|z|/2l)² or, near the turning point, by exp(-2√(2s/|z|)).
    let reach = 40 + (10.0 * z.norm().cbrt()) as usize;
    let mut u = Complex64::ZERO;
    for n in (l + 1..=l + reach).rev() {
        u = 1.0 / (inverse * (2 * n + 1) as f64 - u);
    }
    inverse * (l + 1) as f64 - u
}

#[cfg(test)]
mod tests {
    use super::super::Layered;
    use super::*;

    struct Smooth(fn(f64) -> Complex64, Vec<f64>);

    impl RadialIndex for Smooth {
        fn squared(&self, r: f64) -> Complex64 {
            (self.0)(r)
        }
        fn breaks(&self) -> Vec<f64> {
            self.1.clone()
        }
    }

    /// The error falls 16 times when steps are halved: the sign of the commutator shows here.
    #[test]
    fn fourth_order() {
        for profile in [
            Smooth(|r| (2.0 - r * r).into(), vec![]),
            Smooth(|r| (1.4 * (-(1.4f64.ln()) * r * r).exp()).powi(2).into(), vec![]),
            Smooth(|r| Complex64::new(1.3 + 0.1 * r * r, 0.002 * r).powi(2), vec![]),
            Smooth(|r| if r < 0.6 { 1.9.into() } else { (2.4 - r).into() }, vec![0.6]),
        ] {
            let x = 100.0;
            let grid = nodes::coarse(&profile, x, 0.35);
            let at = |parts| solved(x, &profile, &nodes::divided(&grid, parts)).unwrap();
            let (one, two, four) = (at(1), at(2), at(4));
            let gain = distance(&one, &two) / distance(&two, &four);
            assert!((14.5..17.5).contains(&gain), "{gain}");
        }
    }

    /// A profile of constant pieces is a sphere of layers, with absorption too.
    #[test]
    fn constant_pieces_as_layers() {
        use super::super::Layer;
        let profile = Smooth(
            |r| {
                let index = if r < 0.7 { (1.33, 0.01) } else { (1.5, 0.0) };
                Complex64::new(index.0, index.1).powi(2)
            },
            vec![0.7],
        );
        let layers = [
            Layer { radius: 0.7, index: Complex64::new(1.33, 0.01) },
            Layer { radius: 1.0, index: Complex64::new(1.5, 0.0) },
        ];
        for x in [0.3, 5.0, 90.0] {
            let smooth = Layered::profile(x, &profile, 1e-9).unwrap();
            let exact = Layered::layers(x, &layers).unwrap();
            for (p, q) in smooth.a().iter().zip(exact.a()).chain(smooth.b().iter().zip(exact.b())) {
                assert!((p - q).norm() < 1e-8, "{x}: {p} {q}");
            }
            let (p, q) = (smooth.efficiencies(), exact.efficiencies());
            assert!((p.q_abs / q.q_abs - 1.0).abs() < 1e-7, "{x}: {} {}", p.q_abs, q.q_abs);
            assert!(smooth.error() < 1e-9);
        }
    }
}
