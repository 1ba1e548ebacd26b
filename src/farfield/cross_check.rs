//! Scattering planes against a sum on a complex wavefront, two independent ways to the same wave.
//!
//! On flattened particles rays may gather where no plane tells (a fold across its plane), or go on beyond
//! total reflection, where no plane follows them. A sum sees every ray. So where rays of an order stray from a
//! sphere's, both are computed at some directions; how far they are apart is a value, which goes into
//! the stated error. Which orders are compared is said by [`super::assignment`].

use crate::farfield::azimuth::plane_set::PlaneSet;
use crate::farfield::complex_wavefront::ComplexWavefront;
use crate::optics::AmplitudeMatrix;
use crate::trace::Tracer;

/// `S11` of what parts the waves of some orders from sums alone, by scattering angle, mean over some azimuths
/// in [0, π]; `shares` are orders with the share of their amplitude that planes have.
pub(crate) fn disagreement(
    planes: &PlaneSet,
    tracer: &Tracer,
    shares: &[(u32, f64)],
    theta: &[f64],
    azimuths: &[f64],
) -> Vec<f64> {
    let mut apart = vec![0.0; theta.len()];
    for sum in ComplexWavefront::of_orders(tracer, shares, planes.size_parameter()) {
        let found = planes.columns_of(sum.order(), theta, azimuths);
        for (one, other) in found.iter().zip(sum.columns(theta, azimuths)) {
            add_difference(&mut apart, one, &other, azimuths.len());
        }
    }
    apart
}

fn add_difference(
    apart: &mut [f64],
    one: &[AmplitudeMatrix],
    other: &[AmplitudeMatrix],
    count: usize,
) {
    for (sum, (a, b)) in apart.iter_mut().zip(one.iter().zip(other)) {
        *sum += (*a - *b).s11() / count as f64;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Phases count, and azimuths alike.
    #[test]
    fn differences_are_those_of_waves() {
        let column =
            |s: f64| vec![AmplitudeMatrix { s1: s.into(), s2: s.into(), ..Default::default() }; 2];
        let mut apart = vec![0.0; 2];
        add_difference(&mut apart, &column(1.0), &column(-1.0), 2);
        add_difference(&mut apart, &column(3.0), &column(3.0), 2);
        assert_eq!(apart, [2.0; 2]);
    }
}
