//! What varies slowly of an integrand: known at some launch points, a polynomial between them.
//!
//! What the surface makes of a wave changes over a wave zone about each place where its ray nearly grazes the surface
//! inside, and little elsewhere, while the phase between samples turns many times. So the coefficients of the curved
//! interface, the dearest part of an integrand, are computed only as closely as that asks for. Where the ray enters or
//! leaves near grazing, phases are in the coefficients, and there is no smooth part.

use num_complex::Complex64;

/// Points that a polynomial passes through.
const STENCIL: usize = 6;
/// Step in lengths over which the part changes: coefficients of the curved interface are analytic in η with their
/// nearest pole 2 away from the real axis.
const STEP: f64 = 0.2;
/// Steps at least, for what varies over the whole stretch.
const FEWEST: f64 = 32.0;
/// The shortest step over the longest.
const SHORTEST: f64 = 1e-3;

/// Four elements by launch point.
pub(super) struct SmoothPart {
    places: Vec<f64>,
    values: Vec<[Complex64; 4]>,
    /// For each run of points, what Lagrange's polynomials are divided by.
    scales: Vec<[f64; STENCIL]>,
}

impl SmoothPart {
    /// Between two places, from the part at some of them and the length over which it changes there. `None` where it
    /// is not known.
    pub(super) fn between(
        [from, to]: [f64; 2],
        length: impl Fn(f64) -> f64,
        part: impl Fn(f64) -> Option<[Complex64; 4]>,
    ) -> Option<Self> {
        let longest = (to - from) / FEWEST;
        let step = |place: f64| {
            let step = STEP * length(place);
            if step.is_finite() { step.clamp(SHORTEST * longest, longest) } else { longest }
        };
        let ahead = |place: &f64| Some(*place + step(*place)).filter(|next| *next < to);
        let mut places: Vec<f64> = std::iter::successors(Some(from), ahead).collect();
        places.push(to);
        let values = places.iter().map(|&place| part(place)).collect::<Option<_>>()?;
        let scale = |run: &[f64]| -> [f64; STENCIL] {
            std::array::from_fn(|i| {
                let others = (0..STENCIL).filter(|&j| j != i);
                others.map(|j| run[i] - run[j]).product::<f64>().recip()
            })
        };
        let scales = places.windows(STENCIL).map(scale).collect();
        Some(Self { places, values, scales })
    }

    /// The part at a place between the two ends.
    pub(super) fn at(&self, place: f64) -> [Complex64; 4] {
        let above = self.places.partition_point(|p| *p < place);
        let first = above.saturating_sub(STENCIL / 2).min(self.scales.len() - 1);
        let off: [f64; STENCIL] = std::array::from_fn(|i| place - self.places[first + i]);
        let mut sum = [Complex64::default(); 4];
        for (i, scale) in self.scales[first].iter().enumerate() {
            let others = (0..STENCIL).filter(|&j| j != i);
            let weight = others.fold(*scale, |product, j| product * off[j]);
            for (sum, value) in sum.iter_mut().zip(&self.values[first + i]) {
                *sum += value * weight;
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optics::Grazing;

    /// The coefficients of a curved interface through grazing incidence, and with the phase outside taken from them up to
    /// near that, from points as close as wave zones ask for.
    #[test]
    fn coefficients_come_back_between_their_points() {
        for size in [300.0, 5000.0, 1e5] {
            let square = |sin: f64| 1.0 - sin * sin;
            let coefficients = |sin: f64| {
                let g = Grazing::whole(square(sin), size);
                let reflected = (1.2 - g.lambda) / (g.lambda + 1.2);
                Some([g.lambda, reflected, 1.0 / (g.lambda + 1.2), reflected * reflected])
            };
            let zone = (0.5f64 * size).powf(2.0 / 3.0);
            let length = |sin: f64| (1.0 + 0.25 * (zone * square(sin)).abs()) / (2.0 * sin * zone);
            let end = 1.0 + 4.0 * size.powf(-2.0 / 3.0);
            let part = SmoothPart::between([0.6, end], length, coefficients).unwrap();
            assert!(part.places.len() < 400, "{}", part.places.len());
            for k in 0..=1000 {
                let sin = 0.6 + (end - 0.6) * f64::from(k) / 1000.0;
                let (found, known) = (part.at(sin), coefficients(sin).unwrap());
                for (found, known) in found.iter().zip(known) {
                    assert!((found - known).norm() < 1e-5 * (1.0 + known.norm()), "{size} {sin}");
                }
            }
            let turned = |sin: f64| {
                let way = Grazing::path_outside(square(sin).sqrt());
                let g = Grazing::whole(square(sin), size);
                Some([g.root * Complex64::cis(size * way); 4])
            };
            let last = (1.0 - 9.0 / zone).sqrt();
            let part = SmoothPart::between([0.5 * last, last], length, turned).unwrap();
            for k in 0..=1000 {
                let sin = last * (0.5 + 0.0005 * f64::from(k));
                let (found, known) = (part.at(sin)[0], turned(sin).unwrap()[0]);
                assert!((found - known).norm() < 1e-5 * (1.0 + known.norm()), "{size} {sin}");
            }
        }
    }

    #[test]
    fn what_is_not_known_is_told() {
        assert!(SmoothPart::between([0.0, 1.0], |_| f64::NAN, |_| None).is_none());
        let one = |_| Some([Complex64::from(1.0); 4]);
        let flat = SmoothPart::between([0.0, 1.0], |_| f64::NAN, one).unwrap();
        assert!((33..=34).contains(&flat.places.len()));
        assert!((flat.at(0.777)[2] - 1.0).norm() < 1e-14);
    }
}
