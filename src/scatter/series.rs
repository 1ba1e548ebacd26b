//! Spheres by the exact series: Lorenz–Mie, and sums of Debye's terms.

use super::{Remainder, Request, Scattering};
use crate::medium::radial::Body;
use crate::optics::AmplitudeMatrix;
use crate::plan::last_order;
use crate::series::SeriesError;
use crate::series::debye::{DebyeSeries, Term};
use crate::series::layered::Layered;
use crate::series::lorenz_mie::Sphere;
use crate::series::table::PROFILE_ERROR;
use num_complex::Complex64;

/// Terms to be summed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DebyeTerms {
    /// Just these orders; `None`: all that matter at the tolerance.
    pub orders: Option<Vec<u32>>,
    /// The ½ term. Without orders it is alone.
    pub diffraction: bool,
}

/// A sphere by Lorenz–Mie.
///
/// # Errors
/// A size or an index that the series refuses.
pub fn lorenz_mie(request: &Request) -> Result<Scattering, SeriesError> {
    let sphere = Sphere::new(request.size_parameter, request.index)?;
    Ok(Scattering {
        amplitudes: diagonal(sphere.amplitudes_parallel(&request.theta)),
        efficiencies: sphere.efficiencies(),
        diffraction_included: true,
        remainder: None,
        worth: None,
        bows: Vec::new(),
    })
}

/// A sphere that varies along its radius; the request's index is that at its surface.
///
/// # Errors
/// A size, layers or a profile that the series refuses.
pub fn layered(request: &Request, body: &Body) -> Result<Scattering, SeriesError> {
    let error = PROFILE_ERROR * request.tolerance;
    let sphere = Layered::body(request.size_parameter, body, error)?;
    Ok(Scattering {
        amplitudes: diagonal(sphere.amplitudes_parallel(&request.theta)),
        efficiencies: sphere.efficiencies(),
        diffraction_included: true,
        remainder: None,
        worth: None,
        bows: Vec::new(),
    })
}

/// A sphere by a sum of Debye's terms; efficiencies are those of the whole sphere.
///
/// # Errors
/// As [`lorenz_mie`].
pub fn debye(request: &Request, terms: &DebyeTerms) -> Result<Scattering, SeriesError> {
    let auto = terms.orders.is_none() && !terms.diffraction;
    let list = match &terms.orders {
        Some(list) => list.clone(),
        None if terms.diffraction => Vec::new(),
        None => (0..=last_order(request.index.re, request.tolerance)).collect(),
    };
    // Only a sum from the first order on stands for the whole.
    let all_up_to = list.last().copied().filter(|_| (0..).zip(&list).all(|(k, order)| k == *order));
    let mut summed: Vec<Term> = list.into_iter().map(Term::Order).collect();
    let diffraction_included = auto || terms.diffraction;
    if diffraction_included {
        summed.push(Term::Diffraction);
    }
    let series = DebyeSeries::new(request.size_parameter, request.index)?;
    let amplitudes = diagonal(series.sum_parallel(&summed, &request.theta));
    let remainder = all_up_to.map(|last_order| {
        let share = series.missing_share(last_order);
        Remainder {
            largest: series.remainder(last_order),
            share,
            last_order,
            not_converged: auto && share > request.tolerance,
        }
    });
    let efficiencies = Sphere::new(request.size_parameter, request.index)?.efficiencies();
    Ok(Scattering {
        amplitudes,
        efficiencies,
        diffraction_included,
        remainder,
        worth: None,
        bows: Vec::new(),
    })
}

fn diagonal(pairs: Vec<(Complex64, Complex64)>) -> Vec<AmplitudeMatrix> {
    pairs.into_iter().map(|(s1, s2)| AmplitudeMatrix { s1, s2, ..Default::default() }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn request() -> Request {
        Request {
            size_parameter: 80.0,
            index: 1.33.into(),
            theta: (0..=18).map(|i| f64::from(10 * i).to_radians()).collect(),
            azimuth: 0.0,
            tolerance: 1e-6,
        }
    }

    /// Enough of Debye's terms are Lorenz–Mie, and what they leave out is told.
    #[test]
    fn the_sum_of_terms_is_the_whole() {
        let whole = lorenz_mie(&request()).unwrap();
        let sum = debye(&request(), &DebyeTerms::default()).unwrap();
        let left = sum.remainder.unwrap();
        assert!(sum.diffraction_included && left.last_order > 10);
        let largest = |values: &[AmplitudeMatrix]| {
            values.iter().map(|s| s.s1.norm().max(s.s2.norm())).fold(0.0, f64::max)
        };
        for (a, b) in sum.amplitudes.iter().zip(&whole.amplitudes) {
            let off = (a.s1 - b.s1).norm().max((a.s2 - b.s2).norm());
            assert!(off < 10.0 * left.share.max(1e-9) * largest(&whole.amplitudes), "{off}");
        }
        assert_eq!(sum.efficiencies, whole.efficiencies);
    }

    /// Terms are what is asked for: parts add up, and a list with a gap stands for no whole.
    #[test]
    fn listed_terms_are_just_those() {
        let of = |orders: Option<Vec<u32>>, diffraction| {
            debye(&request(), &DebyeTerms { orders, diffraction }).unwrap()
        };
        let (alone, half, both) =
            (of(Some(vec![2]), false), of(None, true), of(Some(vec![2]), true));
        for ((a, b), c) in alone.amplitudes.iter().zip(&half.amplitudes).zip(&both.amplitudes) {
            assert!((a.s1 + b.s1 - c.s1).norm() < 1e-9 * c.s1.norm());
        }
        assert!(alone.remainder.is_none() && !alone.diffraction_included);
        assert!(of(Some(vec![0, 1]), false).remainder.is_some_and(|left| !left.not_converged));
    }
}
