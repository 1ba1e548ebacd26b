//! Spheres by Airy's theory of the bows: a method to compare others with, not to rely on.

use super::{Request, ScatterError, Scattering};
use crate::farfield::assignment::{AiryRange, Thresholds};
use crate::optics::AmplitudeMatrix;
use crate::series::airy::AiryBow;
use crate::series::lorenz_mie::Sphere;

/// Orders of the primary and the secondary bow, which the theory is asked for.
const ORDERS: [u32; 2] = [2, 3];

/// A sphere by Airy's theory, the waves of orders 2 and 3 (or of just some of them) added; efficiencies are those of
/// Lorenz–Mie, and what the theory is worth goes with it.
///
/// ```
/// use gonio::scatter::{Request, airy, lorenz_mie};
///
/// let theta = vec![138.5f64.to_radians()];
/// let request =
///     Request { size_parameter: 5000.0, index: 1.333.into(), theta, azimuth: 0.0, tolerance: 0.01 };
/// let seen = airy(&request, Some(&[2])).unwrap();
/// assert!((seen.bows[0].bow.to_degrees() - 137.92).abs() < 0.01);
/// assert!(seen.bows[0].expected_error[0] < 0.1);
/// assert!(airy(&request, Some(&[4])).is_err());
/// ```
///
/// # Errors
/// [`ScatterError::NoBow`] for an order that the theory is not asked for here, or whose rays do not turn back.
pub fn airy(request: &Request, orders: Option<&[u32]>) -> Result<Scattering, ScatterError> {
    let Request { size_parameter, index, .. } = *request;
    let mut bows = Vec::new();
    for &order in orders.unwrap_or(&ORDERS) {
        let known = ORDERS.contains(&order).then(|| AiryBow::new(size_parameter, index, order));
        match known.flatten() {
            Some(bow) => bows.push((order, bow)),
            None => return Err(ScatterError::NoBow { order, index: index.re }),
        }
    }
    let at = |&theta: &f64| {
        bows.iter().fold(AmplitudeMatrix::default(), |sum, (_, bow)| {
            let (s1, s2) = bow.amplitudes(theta);
            AmplitudeMatrix { s1: sum.s1 + s1, s2: sum.s2 + s2, ..sum }
        })
    };
    let worth = |(order, bow): &(u32, AiryBow)| Thresholds::MEASURED.airy_range(*order, bow);
    let bows_told: Vec<AiryRange> = bows.iter().map(worth).collect();
    Ok(Scattering {
        amplitudes: request.theta.iter().map(at).collect(),
        efficiencies: Sphere::new(size_parameter, index)?.efficiencies(),
        diffraction_included: false,
        remainder: None,
        worth: None,
        bows: bows_told,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scatter::{DebyeTerms, debye};

    /// About the bow the stated error holds against the Debye term, for both polarisations.
    #[test]
    fn the_stated_error_holds() {
        for (order, x) in [(2, 2e3), (2, 3e4), (3, 3e4)] {
            let mut request = Request {
                size_parameter: x,
                index: 1.333.into(),
                theta: vec![],
                azimuth: 0.0,
                tolerance: 0.01,
            };
            let range = airy(&request, Some(&[order])).unwrap().bows[0];
            let [from, to] = range.theta;
            request.theta = (0..=60).map(|i| from + (to - from) * f64::from(i) / 60.0).collect();
            let found = airy(&request, Some(&[order])).unwrap().amplitudes;
            let terms = DebyeTerms { orders: Some(vec![order]), diffraction: false };
            let exact = debye(&request, &terms).unwrap().amplitudes;
            for (j, part) in
                [|m: &AmplitudeMatrix| m.s1, |m: &AmplitudeMatrix| m.s2].into_iter().enumerate()
            {
                let most = exact.iter().map(|m| part(m).norm()).fold(0.0, f64::max);
                let off = found
                    .iter()
                    .zip(&exact)
                    .map(|(a, b)| (part(a) - part(b)).norm())
                    .fold(0.0, f64::max);
                assert!(
                    off / most <= range.expected_error[j],
                    "{order} {x} {j}: {} {:?}",
                    off / most,
                    range
                );
            }
        }
    }
}
