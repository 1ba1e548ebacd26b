//! Airy's theory of the rainbow (1838): the light of one order near its bow, as an integral over a cubic wavefront.
//!
//! Near the ray of least deviation the turn of rays is `Θ = Θ₀ + h (b - b₀)²/2` of their impact b, and their phase
//! `x (W₀ + b₀ δ ± ⅔ √(2/h) δ^{3/2})` with `δ = Θ - Θ₀`. Two rays interfere within the bow; the integral over the
//! wavefront that makes of them one wave on both sides is Airy's (van de Hulst 1957, section 13.2):
//!
//! `S_j = -i e^{-iπ(2m+1)/4} e^{ix(W₀ + b₀δ)} 2^{5/6} √π √(b₀/sin θ₀) x^{7/6} h^{-1/3} T_j Ai(-z)`, `z = (2x²/h)^{1/3} δ`,
//!
//! with T_j the transfer of the bow's ray (Fresnel's coefficients at its incidence, for both polarisations) and m its focal
//! lines on the side that has fewer. Nothing else is in it: no other order, and the coefficients of one ray stand for
//! all. What that costs falls as `x^{-1/3}`; along the scattering plane it costs more, since inner reflection is
//! near Brewster's angle, where the coefficient changes from ray to ray (Können & de Boer 1979; Lee 1998; Wang & van
//! de Hulst 1991). The uniform formula of rays ([`crate::farfield`]) and the Debye series have none of these limits.
//!
//! ```
//! use gonio::series::airy::AiryBow;
//!
//! // a drop of 0.1 mm at 550 nm: the maximum is a degree within the bow of ray optics
//! let bow = AiryBow::new(1142.0, 1.333.into(), 2).expect("water has a primary bow");
//! assert!((bow.angle().to_degrees() - 137.92).abs() < 0.01);
//! assert!((bow.maximum().to_degrees() - 138.9).abs() < 0.1);
//! ```

use crate::math::airy::{FROM, ai};
use crate::math::vec3::Vec3;
use crate::shape::Shape;
use crate::trace::{Tracer, transfer};
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_4, PI, TAU};

/// One order's bow by Airy's theory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AiryBow {
    size_parameter: f64,
    /// Turn of the bow's ray, radians, and its impact.
    turn: f64,
    impact: f64,
    /// Whether more turn is a larger scattering angle.
    outwards: bool,
    /// Argument of the Airy function per radian of turn.
    rate: f64,
    /// Amplitudes S1 and S2 over Ai, at the bow.
    at_bow: [Complex64; 2],
}

/// Where the Airy function has its first maximum.
const FIRST_MAXIMUM: f64 = 1.018_792_971_647_471;
/// Neighbours of the bow's ray, to count focal lines on both sides.
const BESIDE: f64 = 1e-3;

impl AiryBow {
    /// The bow of an order of a sphere; nothing where rays of the order do not turn back.
    pub fn new(size_parameter: f64, index: Complex64, order: u32) -> Option<Self> {
        let (p, n) = (f64::from(order), index.re);
        let squared = (n * n - 1.0) / (p * p - 1.0);
        if order < 2 || !(squared > 0.0 && squared < 1.0) {
            return None;
        }
        let (cos, sin) = (squared.sqrt(), (1.0 - squared).sqrt());
        let turn = (p - 1.0) * PI + 2.0 * sin.asin() - 2.0 * p * (sin / n).asin();
        let bend = 2.0 * (p * p - 1.0) / (p * p) * sin / cos.powi(3);

        let sphere = Shape::sphere();
        let tracer = Tracer::new(&sphere, index, size_parameter, order);
        let exit = tracer.trace_order(sin, 0.0, order)?;
        let lines = [1.0 - BESIDE, 1.0 + BESIDE]
            .map(|by| tracer.trace_order((sin * by).min(1.0 - 1e-9), 0.0, order));
        let fewest = lines.iter().flatten().map(|exit| exit.focal_lines).min()?;
        let direction = exit.direction;
        let (side, theta) = (direction.x.signum(), exit.scattering_angle());
        let theta_hat = Vec3::new(theta.cos() * side, 0.0, -theta.sin());
        let matrix = transfer(&exit.field, theta_hat, Vec3::new(0.0, side, 0.0), side, 0.0);

        let x = size_parameter;
        let strength =
            2f64.powf(5.0 / 6.0) * PI.sqrt() * (sin / theta.sin()).sqrt() * x.powf(7.0 / 6.0)
                / bend.cbrt();
        let phase = x * exit.path - FRAC_PI_4 * f64::from(2 * fewest + 1);
        let wave = Complex64::new(0.0, -strength) * Complex64::cis(phase);
        Some(Self {
            size_parameter,
            turn,
            impact: sin,
            outwards: turn.rem_euclid(TAU) < PI,
            rate: (2.0 * x * x / bend).cbrt(),
            at_bow: [wave * matrix.s1, wave * matrix.s2],
        })
    }

    /// The bow of ray optics, radians.
    pub fn angle(&self) -> f64 {
        let turned = self.turn.rem_euclid(TAU);
        turned.min(TAU - turned)
    }

    /// Where the light is strongest, radians.
    pub fn maximum(&self) -> f64 {
        self.at_argument(FIRST_MAXIMUM)
    }

    /// `2πa/λ` of the drop.
    pub fn size_parameter(&self) -> f64 {
        self.size_parameter
    }

    /// The scattering angle (radians) of an argument z of `Ai(-z)`.
    pub fn at_argument(&self, z: f64) -> f64 {
        self.angle() + self.side() * z / self.rate
    }

    /// The argument z of `Ai(-z)` at a scattering angle (radians): positive within the bow.
    pub fn argument(&self, theta: f64) -> f64 {
        self.rate * self.side() * (theta - self.angle())
    }

    /// Amplitudes S1 and S2 at a scattering angle (radians).
    pub fn amplitudes(&self, theta: f64) -> (Complex64, Complex64) {
        let z = self.argument(theta);
        let turned = z / self.rate;
        let wave = Complex64::cis(self.size_parameter * self.impact * turned) * airy_function(-z);
        (self.at_bow[0] * wave, self.at_bow[1] * wave)
    }

    fn side(&self) -> f64 {
        if self.outwards { 1.0 } else { -1.0 }
    }
}

/// Ai of any real argument: far on the left by its first asymptotic term.
fn airy_function(x: f64) -> f64 {
    if x > FROM {
        return ai(x).0;
    }
    let z = -x;
    (2.0 / 3.0 * z.powf(1.5) + FRAC_PI_4).sin() / (PI.sqrt() * z.sqrt().sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optics::rainbow_angle;
    use crate::series::debye::{DebyeSeries, Term};

    /// The bow is Descartes', and light is on the side where rays are.
    #[test]
    fn the_bow_is_that_of_rays() {
        for order in [2, 3, 4] {
            let bow = AiryBow::new(1e4, 1.333.into(), order).unwrap();
            assert!((bow.angle() - rainbow_angle(1.333, order).unwrap()).abs() < 1e-12);
        }
        let at = |order, away: f64| {
            let bow = AiryBow::new(1e4, 1.333.into(), order).unwrap();
            bow.amplitudes(bow.angle() + away.to_radians()).0.norm()
        };
        assert!(at(2, 0.2) > 3.0 * at(2, -0.2) && at(3, -0.2) > 2.0 * at(3, 0.2));
        assert!(AiryBow::new(1e4, 1.333.into(), 1).is_none());
        assert!(AiryBow::new(1e4, 2.5.into(), 2).is_none());
    }

    /// Largest difference from the Debye term about the first maximum (from z = -2 to 3), over the largest amplitude, for
    /// both polarisations.
    fn error(x: f64, order: u32) -> [f64; 2] {
        let bow = AiryBow::new(x, 1.333.into(), order).unwrap();
        let theta: Vec<f64> = (0..=50)
            .map(|i| bow.angle() + bow.side() * (-2.0 + 0.1 * f64::from(i)) / bow.rate)
            .collect();
        let mut sorted = theta.clone();
        sorted.sort_by(f64::total_cmp);
        let exact = DebyeSeries::new(x, 1.333.into()).unwrap();
        let exact = exact.amplitudes(Term::Order(order), &sorted);
        let (mut off, mut most) = ([0.0f64; 2], [0.0f64; 2]);
        for (&theta, exact) in sorted.iter().zip(&exact) {
            let found = bow.amplitudes(theta);
            for (j, (found, exact)) in
                [(found.0, exact.0), (found.1, exact.1)].into_iter().enumerate()
            {
                off[j] = off[j].max((found - exact).norm());
                most[j] = most[j].max(exact.norm());
            }
        }
        [off[0] / most[0], off[1] / most[1]]
    }

    /// The error falls as the cube root of the size, phases included; next terms of the theory are of that order.
    #[test]
    fn errors_fall_as_the_cube_root_of_the_size() {
        for (order, bounds) in [(2, [4.6, 15.3]), (3, [6.7, 11.8])] {
            let sizes = [1e4, 1e5];
            let errors = sizes.map(|x| error(x, order));
            for j in 0..2 {
                for (x, error) in sizes.iter().zip(&errors) {
                    let scaled = error[j] * x.cbrt();
                    println!(
                        "order {order}, polarisation {j}, x = {x}: {:.4}, {scaled:.3} x^(-1/3)",
                        error[j]
                    );
                    assert!(scaled < bounds[j], "{order} {j} {x}: {scaled}");
                }
                let fall = errors[1][j] / errors[0][j];
                assert!((0.38..0.56).contains(&fall), "{order} {j}: {fall}");
            }
        }
    }

    /// The place of the first maximum of a Debye term is Airy's, with what the next term shifts it by: a share of its
    /// distance from the bow of order x^(-2/3).
    #[test]
    fn the_maximum_is_where_the_debye_term_has_it() {
        for (order, x) in [(2, 1e4), (2, 1e5), (3, 1e4)] {
            let bow = AiryBow::new(x, 1.333.into(), order).unwrap();
            let theta: Vec<f64> = (0..=400)
                .map(|i| bow.maximum() + (f64::from(i) - 200.0) * 2e-3 / bow.rate)
                .collect();
            let exact = DebyeSeries::new(x, 1.333.into()).unwrap();
            let exact = exact.amplitudes(Term::Order(order), &theta);
            let brightest =
                (0..theta.len()).max_by(|&a, &b| exact[a].0.norm().total_cmp(&exact[b].0.norm()));
            let found = theta[brightest.unwrap()];
            let off = (found - bow.maximum()).abs() * bow.rate / FIRST_MAXIMUM;
            println!("order {order}, x = {x}: {off:.5}");
            let bound = if order == 2 { 6.0 } else { 9.0 };
            assert!(off < bound * x.powf(-2.0 / 3.0), "{order} {x}: {off}");
        }
    }

    /// Beyond the table of Ai its asymptotic form goes on without a step.
    #[test]
    fn ai_goes_on() {
        let (near, far) = (airy_function(FROM + 1e-9), airy_function(FROM - 1e-9));
        // The next term is 5/72ζ of the amplitude, ζ = ⅔ · 64^(3/2).
        assert!((near - far).abs() < 4.2e-5, "{near} {far}");
    }
}
