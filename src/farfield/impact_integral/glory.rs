//! Waves about the axis of a rotationally symmetric scene.
//!
//! Rays of all azimuths that leave along the axis meet there, and the two waves of a plane
//! grow like `1/√sin θ`. The ring of rays they come from has the wave
//! `∮ dα M(α) exp(-ixβγ cos(α - φ))`, so that the two waves `e^{∓i(z - π/4)}/√(2πz)`, `z = xβγ`, of an
//! impact `β` become Bessel functions of the angle `γ` from the axis: `J₀ - J₁/z` for the
//! polarisation that the amplitude is asked for, `±J₁/z` for the other (van de Hulst 1957, sec. 13.3;
//! Nussenzveig 1969). The integral over impacts is the same as that of a rim wave.

use super::integrand::Integrand;
use super::prefactor::Prefactor;
use super::rays::{RAYS, Rays};
use crate::farfield::branch::window::Window;
use crate::farfield::deflection::curve::DeflectionCurve;
use crate::farfield::deflection::scattering_plane::Node;
use crate::optics::AmplitudeMatrix;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// The wave of one order about one axis.
#[derive(Clone, Debug)]
pub struct Glory {
    forward: bool,
    /// Angle from the axis up to which this holds.
    reach: f64,
    /// Size parameter times impact, then perpendicular and parallel amplitude.
    rings: Vec<(f64, [Complex64; 2])>,
}

/// Fresnel zones of a ray within the tapers of a crossing.
const FRESNEL_ZONES: f64 = 12.0;

impl Glory {
    /// Scattering angles that it reaches, radians.
    pub(crate) fn angles(&self) -> [f64; 2] {
        if self.forward { [0.0, self.reach] } else { [PI - self.reach, PI] }
    }

    /// About the axis at the unwrapped angle `number · π`, from an integrand over impacts.
    pub(crate) fn new(
        integrand: &Integrand,
        before: &Prefactor,
        number: i64,
        reach: f64,
        x: f64,
    ) -> Self {
        let forward = number % 2 == 0;
        let factor = before.at_axis(number as f64) * x;
        let ring = |(impact, path, [perpendicular, parallel]): (f64, f64, [Complex64; 2])| {
            let wave =
                Complex64::cis(TAU * (x / TAU * (path - impact * PI * number as f64)).fract());
            let rate = x * impact.abs();
            let size = factor * wave * (TAU * rate).sqrt();
            let across = if forward { 1.0 } else { -1.0 };
            (rate, [size * perpendicular, size * parallel * across])
        };
        Self { forward, reach, rings: integrand.samples().map(ring).collect() }
    }

    /// Of the rays of a plane that cross the axis between two rays, both `reach` away from it.
    /// Others count less and less, up to the launch points `limits`; `share` of each launch point is
    /// left to this wave. `None` where rays are missing.
    pub(crate) fn of_crossing(
        curve: &DeflectionCurve,
        share: impl Fn(f64) -> f64,
        [a, b]: [&Node; 2],
        limits: [f64; 2],
        number: i64,
        reach: f64,
        x: f64,
    ) -> Option<Self> {
        let (inner, outer) = (a.alpha.sin(), b.alpha.sin());
        let rate = (b.angle - a.angle).abs() / (outer - inner);
        let taper = FRESNEL_ZONES / (x * rate).sqrt();
        let from = inner - taper.min(0.9 * (inner - limits[0]));
        let to = outer + taper.min(0.9 * (limits[1] - outer));
        let rays = Rays::between(curve, [from, to], RAYS - 1, None)?;
        let [rise, fall] = [Window { start: from, full: inner }, Window { start: outer, full: to }];
        let weight = |sin: f64| rise.weight(sin) * (1.0 - fall.weight(sin)) * share(sin);
        let axis = PI * number as f64;
        let off = |sin: f64| Some((curve.ray_at(sin)?.angle - axis).abs());
        let spread = off(from)?.max(off(to)?) + reach;
        let integrand =
            rays.integrand(weight, to, 1.5 * spread, curve.plane().tracer.index(), x)?;
        let before = Prefactor::between(curve, [inner, inner + 0.01 * (outer - inner)], x)?;
        Some(Self::new(&integrand, &before, number, reach, x))
    }

    /// Least and largest scattering angle that it serves.
    pub(crate) fn theta(&self) -> [f64; 2] {
        if self.forward { [0.0, self.reach] } else { [PI - self.reach, PI] }
    }

    /// Add the wave to amplitudes at ascending scattering angles.
    pub(crate) fn add(&self, theta: &[f64], amplitudes: &mut [AmplitudeMatrix]) {
        let off_axis = |theta: f64| if self.forward { theta } else { PI - theta };
        for (&theta, sum) in theta.iter().zip(amplitudes) {
            let angle = off_axis(theta);
            if angle < self.reach {
                let [s1, s2] = self.at(angle);
                sum.s1 += s1;
                sum.s2 += s2;
            }
        }
    }

    /// S1 and S2 at an angle from the axis.
    fn at(&self, angle: f64) -> [Complex64; 2] {
        let mut sums = [Complex64::default(); 2];
        for &(rate, [perpendicular, parallel]) in &self.rings {
            let z = rate * angle;
            let aside = if z < 1e-6 { 0.5 } else { libm::j1(z) / z };
            let along = libm::j0(z) - aside;
            sums[0] += perpendicular * along + parallel * aside;
            sums[1] += parallel * along + perpendicular * aside;
        }
        let widening = if angle < 1e-6 { 1.0 } else { (angle / angle.sin()).sqrt() };
        let parallel_sign = if self.forward { 1.0 } else { -1.0 };
        [sums[0] * widening, sums[1] * (widening * parallel_sign)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(forward: bool, rate: f64) -> (Glory, [Complex64; 2]) {
        let fields = [Complex64::new(0.7, -0.2), Complex64::new(-0.4, 0.9)];
        (Glory { forward, reach: 0.2, rings: vec![(rate, fields)] }, fields)
    }

    /// The integral round the ring: `∮ dα M(α) exp(iz cos α)/2π`, with `M` the fields turned into the plane.
    #[test]
    fn a_ring_is_its_integral_round_the_axis() {
        const STEPS: usize = 200;
        for (forward, sign) in [(true, 1.0), (false, -1.0)] {
            let (glory, [perpendicular, parallel]) = ring(forward, 150.0);
            for angle in [0.0, 1e-7, 0.01, 0.05, 0.15] {
                let mut expected = [Complex64::default(); 2];
                for k in 0..STEPS {
                    let (sin, cos) = (TAU * k as f64 / STEPS as f64).sin_cos();
                    let wave = Complex64::cis(150.0 * angle * cos) / STEPS as f64;
                    expected[0] += (perpendicular * cos * cos + parallel * sin * sin) * wave;
                    expected[1] += (parallel * cos * cos + perpendicular * sin * sin) * wave;
                }
                let widening = if angle == 0.0 { 1.0 } else { (angle / angle.sin()).sqrt() };
                let found = glory.at(angle);
                assert!((found[0] - expected[0] * widening).norm() < 1e-8, "{angle}: {found:?}");
                assert!((found[1] - expected[1] * widening * sign).norm() < 1e-8, "{angle}");
            }
        }
    }

    /// On the axis there is no plane: `S1 = S2` forward, `S1 = -S2` backward; beyond its reach nothing.
    #[test]
    fn the_wave_is_added_about_its_own_axis() {
        for (forward, theta) in [(true, [0.0, 0.1, 0.5]), (false, [PI, PI - 0.1, PI - 0.5])] {
            let (glory, _) = ring(forward, 80.0);
            let mut sums = [AmplitudeMatrix::default(); 3];
            glory.add(&theta, &mut sums);
            let sign = if forward { 1.0 } else { -1.0 };
            assert!((sums[0].s1 - sums[0].s2 * sign).norm() < 1e-15 && sums[0].s11() > 0.0);
            assert!((sums[1].s1 - glory.at(0.1)[0]).norm() < 1e-13);
            assert_eq!(sums[2], AmplitudeMatrix::default());
        }
    }
}
