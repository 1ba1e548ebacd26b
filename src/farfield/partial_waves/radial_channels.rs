//! What is known of the rays of a radial line, as polynomials along it.

use super::radial_rays::RadialRay;
use crate::math::chebyshev::Chebyshev;

/// Real rays on a line, and the degree of the polynomials through them.
pub(super) const RAYS: usize = 24;
const DEGREE: usize = 16;

/// Polynomials through what is known of the rays: see [`RadialRay`].
pub(super) struct Channels {
    pub impact: Chebyshev<1>,
    pub path: Chebyshev<1>,
    pub inside: Chebyshev<1>,
    pub direction: Chebyshev<3>,
    pub aside: Chebyshev<3>,
    pub density: Chebyshev<2>,
    pub meetings: Vec<Chebyshev<3>>,
    pub normal: Chebyshev<2>,
}

impl Channels {
    pub(super) fn through(rays: &[RadialRay], from: f64, to: f64) -> Self {
        fn fit<const C: usize>(values: &[[f64; C]], from: f64, to: f64) -> Chebyshev<C> {
            Chebyshev::fit(values, from, to).truncated(DEGREE)
        }
        let one = |value: &dyn Fn(&RadialRay) -> f64| {
            fit(&rays.iter().map(|ray| [value(ray)]).collect::<Vec<_>>(), from, to)
        };
        let two = |value: &dyn Fn(&RadialRay) -> [f64; 2]| {
            fit(&rays.iter().map(value).collect::<Vec<_>>(), from, to)
        };
        let three = |value: &dyn Fn(&RadialRay) -> [f64; 3]| {
            fit(&rays.iter().map(value).collect::<Vec<_>>(), from, to)
        };
        let hits = rays.first().map_or(0, |ray| ray.meetings.len());
        Self {
            impact: one(&|ray| ray.impact),
            path: one(&|ray| ray.path),
            inside: one(&|ray| ray.inside),
            direction: three(&|ray| ray.direction),
            aside: three(&|ray| ray.aside),
            density: two(&|ray| ray.density),
            meetings: (0..hits).map(|hit| three(&|ray| ray.meetings[hit])).collect(),
            normal: two(&|ray| ray.normal),
        }
    }
}
