//! Spherical vector waves on the surface: radial functions at every node, angular ones by order.
//!
//! Waves after Mishchenko, Travis & Lacis 2002 (sec. 5.1):
//! `M_mn = γ_n e^{imφ} z_n (iπ θ̂ - τ φ̂)`,
//! `N_mn = γ_n e^{imφ} [n(n+1) z_n/ρ d r̂ + (ρ z_n)'/ρ (τ θ̂ + iπ φ̂)]`, with `d = d^n_{0m}(θ)`,
//! `π = m d/sin θ`, `τ = dd/dθ`, `γ_n² = (2n+1)/(n(n+1))` up to a constant. For a star-shaped surface
//! the tangential components are those along φ̂ and along `θ̂ + (r'/r) r̂`.

use super::surface::SurfaceNode;
use num_complex::Complex64;

/// A radial function at one node, by n: `z`, `(ρ z)'/ρ` and `n(n+1) z/ρ`.
#[derive(Clone, Debug, Default)]
pub(in crate::series::tmatrix) struct Radial<T> {
    pub value: Vec<T>,
    pub derivative: Vec<T>,
    pub across: Vec<T>,
}

/// All radial functions at one node of the surface.
#[derive(Clone, Debug)]
pub(in crate::series::tmatrix) struct NodeWaves {
    pub node: SurfaceNode,
    /// Outside: `j_n` and `y_n`.
    pub regular: Radial<f64>,
    pub irregular: Radial<f64>,
    /// Inside: `j_n`, each n scaled by a power of two, and all by `exp(-Im)` at the farthest point.
    pub inside: Radial<Complex64>,
}

/// Radial functions to degree `top` at all nodes.
pub(in crate::series::tmatrix) fn on_surface(
    nodes: &[SurfaceNode],
    size_parameter: f64,
    index: Complex64,
    top: usize,
) -> Vec<NodeWaves> {
    let farthest = nodes.iter().fold(0.0f64, |far, node| far.max(node.radius));
    let attenuation = index.im * size_parameter * farthest;
    let typical = spherical_bessel(index * size_parameter, top, attenuation);
    let scales: Vec<f64> = (0..=top)
        .map(|n| {
            let before = if n > 0 { 0.5 * typical[n - 1].norm() } else { 0.0 };
            power_of_two(typical[n].norm().max(before))
        })
        .collect();
    nodes
        .iter()
        .map(|&node| {
            let rho = size_parameter * node.radius;
            let regular = spherical_bessel(rho.into(), top, 0.0).iter().map(|j| j.re).collect();
            let inner = index * rho;
            let mut inside = radial(spherical_bessel(inner, top, attenuation), inner.inv());
            for part in [&mut inside.value, &mut inside.derivative, &mut inside.across] {
                part.iter_mut().zip(&scales).for_each(|(value, scale)| *value *= *scale);
            }
            NodeWaves {
                node,
                regular: radial(regular, 1.0 / rho),
                irregular: radial(spherical_neumann(rho, top), 1.0 / rho),
                inside,
            }
        })
        .collect()
}

/// The reciprocal of a positive number, rounded to a power of two; 1 where there is none.
pub(in crate::series::tmatrix) fn power_of_two(value: f64) -> f64 {
    if value > 1e-290 && value < 1e290 { (-value.log2().round()).exp2() } else { 1.0 }
}

/// Derivatives `z_{n-1} - n z_n/ρ` and transverse parts from the functions themselves.
fn radial<T>(value: Vec<T>, inverse: T) -> Radial<T>
where
    T: Copy + Default + std::ops::Mul<Output = T> + std::ops::Mul<f64, Output = T>,
    T: std::ops::Sub<Output = T>,
{
    let over: Vec<T> = value.iter().map(|&z| z * inverse).collect();
    let derivative = (0..value.len())
        .map(|n| if n == 0 { T::default() } else { value[n - 1] - over[n] * n as f64 })
        .collect();
    let across = over.iter().enumerate().map(|(n, &z)| z * (n * (n + 1)) as f64).collect();
    Radial { value, derivative, across }
}

/// `j_n(z) exp(-attenuation)` for n = 0 … `top`, by downward recurrence from where its arbitrary
/// start is forgotten, normalised by the larger of `j_0` and `j_1`.
fn spherical_bessel(z: Complex64, top: usize, attenuation: f64) -> Vec<Complex64> {
    const LARGE: f64 = 1e100;
    let modulus = z.norm();
    let start = (top as f64).max(modulus).ceil() as usize + 20 + (10.0 * modulus.cbrt()) as usize;
    let inverse = z.inv();
    let mut out = vec![Complex64::ZERO; top.max(1) + 1];
    let (mut above, mut now) = (Complex64::ZERO, Complex64::from(1.0 / LARGE));
    for n in (1..=start).rev() {
        (above, now) = (now, inverse * now * (2 * n + 1) as f64 - above);
        if n - 1 < out.len() {
            out[n - 1] = now;
        }
        if now.norm() > LARGE {
            above /= LARGE;
            now /= LARGE;
            out.iter_mut().skip(n - 1).for_each(|value| *value /= LARGE);
        }
    }
    let (plus, minus) = (
        (Complex64::I * z - attenuation).exp() * 0.5,
        (-Complex64::I * z - attenuation).exp() * 0.5,
    );
    let (sin, cos) = ((plus - minus) * -Complex64::I, plus + minus);
    let zeroth = sin * inverse;
    let first = if modulus > 0.3 { (zeroth - cos) * inverse } else { Complex64::ZERO };
    let factor = if zeroth.norm() > first.norm() { zeroth / out[0] } else { first / out[1] };
    out.iter_mut().for_each(|value| *value *= factor);
    out.truncate(top + 1);
    out
}

/// `y_n(x)` for n = 0 … `top`, upward.
fn spherical_neumann(x: f64, top: usize) -> Vec<f64> {
    let (sin, cos) = x.sin_cos();
    let inverse = 1.0 / x;
    let mut out = vec![-cos * inverse, (-cos * inverse - sin) * inverse];
    for n in 1..top {
        out.push((2 * n + 1) as f64 * inverse * out[n] - out[n - 1]);
    }
    out.truncate(top + 1);
    out
}

/// Angular functions of one order m at one angle, by n (zero below `max(m, 1)`).
#[derive(Clone, Debug, Default)]
pub(in crate::series::tmatrix) struct Angular {
    pub d: Vec<f64>,
    pub pi: Vec<f64>,
    pub tau: Vec<f64>,
}

impl Angular {
    /// For n to `top`; `m ≥ 0`. By upward recurrence of `d/sin θ`, stable in this normalisation.
    pub(in crate::series::tmatrix) fn new(m: usize, top: usize, cos: f64, sin: f64) -> Self {
        let mut it =
            Self { d: vec![0.0; top + 1], pi: vec![0.0; top + 1], tau: vec![0.0; top + 1] };
        if m == 0 {
            it.fill_axial(top, cos, sin)
        } else {
            it.fill(m, top, cos, sin)
        }
        it
    }

    fn fill_axial(&mut self, top: usize, cos: f64, sin: f64) {
        let (mut before, mut now) = (1.0, cos);
        let (mut slope_before, mut slope) = (0.0, 1.0);
        self.d[0] = 1.0;
        for n in 1..=top {
            let k = n as f64;
            self.d[n] = now;
            self.tau[n] = -sin * slope;
            (slope_before, slope) = (slope, slope_before + (2.0 * k + 1.0) * now);
            (before, now) = (now, ((2.0 * k + 1.0) * cos * now - k * before) / (k + 1.0));
        }
    }

    fn fill(&mut self, m: usize, top: usize, cos: f64, sin: f64) {
        let square = (m * m) as f64;
        let central = (1..=m).fold(1.0, |p, k| p * (2 * k - 1) as f64 / (2 * k) as f64).sqrt();
        // d^m_{0m} / sin θ
        let mut now = central * sin.powi(m as i32 - 1);
        let (mut before, mut root) = (0.0, 0.0);
        for n in m..=top {
            let k = n as f64;
            let next_root = ((k + 1.0) * (k + 1.0) - square).sqrt();
            self.d[n] = now * sin;
            self.pi[n] = now * m as f64;
            self.tau[n] = k * cos * now - root * before;
            (before, now, root) =
                (now, ((2.0 * k + 1.0) * cos * now - root * before) / next_root, next_root);
        }
    }
}

/// `γ_n = √((2n+1)/(n(n+1)))`.
pub(in crate::series::tmatrix) fn gamma(n: usize) -> f64 {
    ((2 * n + 1) as f64 / (n * (n + 1)) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `j_n y_{n-1} - j_{n-1} y_n = 1/x²` across the turning point.
    #[test]
    fn wronskian_holds_everywhere() {
        for x in [0.05, 1.0, 40.0] {
            let top = x as usize + 12;
            let (j, y) = (spherical_bessel(x.into(), top, 0.0), spherical_neumann(x, top));
            for n in 1..=top {
                let wronskian = (j[n].re * y[n - 1] - j[n - 1].re * y[n]) * x * x;
                assert!((wronskian - 1.0).abs() < 1e-12, "{x} {n}: {wronskian}");
            }
        }
    }

    /// `j_1(z) = sin z/z² - cos z/z` for a strongly absorbed wave, attenuation taken out.
    #[test]
    fn absorbed_waves_keep_their_digits() {
        let z = Complex64::new(30.0, 20.0);
        let scaled = spherical_bessel(z, 8, 20.0);
        let first = (z.sin() / (z * z) - z.cos() / z) * (-20.0f64).exp();
        assert!((scaled[1] - first).norm() < 1e-13 * first.norm());
    }

    /// Legendre functions in closed form: `d^2_{01} = √(3/2) sin cos`, and its derivative.
    #[test]
    fn second_degree_in_closed_form() {
        let (sin, cos) = 0.7f64.sin_cos();
        let first = Angular::new(1, 3, cos, sin);
        let root = 1.5f64.sqrt();
        assert!((first.d[2] - root * sin * cos).abs() < 1e-15);
        assert!((first.pi[2] - root * cos).abs() < 1e-15);
        assert!((first.tau[2] - root * (cos * cos - sin * sin)).abs() < 1e-15);
        let axial = Angular::new(0, 3, cos, sin);
        assert!((axial.tau[2] + 3.0 * sin * cos).abs() < 1e-15);
    }
}
