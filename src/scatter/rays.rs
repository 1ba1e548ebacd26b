//! Any shape by rays: amplitudes, and efficiencies from the optical theorem and the budget of energy.

use super::{Request, ScatterError, Scattering};
use crate::farfield::patches::gaussian_filter;
use crate::plan::{Engine, Plan, Symmetry, check_rays, last_order, orders_that_matter};
use crate::series::Efficiencies;
use crate::shape::Shape;
use crate::simulate::{self, Seen};
use crate::trace::{Fates, Tracer, Wavefront, energy_by_fate};
use std::f64::consts::PI;

/// What of diffraction goes with rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RayDiffraction {
    /// None: rays alone, in patches.
    None,
    /// Intensities of patches smoothed near bows by the filter of Sadeghi et al. 2012 for a drop of
    /// this radius (metres); phases are those of the rays.
    Gaussian {
        /// Metres.
        radius: f64,
    },
    /// Uniform formulas at every bow.
    Airy,
}

/// A particle for rays, and how it is done.
#[derive(Clone, Debug)]
pub struct RayRequest {
    /// The particle.
    pub shape: Shape,
    /// Just these; `None`: all that matter at the tolerance, and forward diffraction.
    pub orders: Option<Vec<u32>>,
    /// What of diffraction goes with them.
    pub diffraction: RayDiffraction,
    /// Rays across the silhouette for patches; `None`: by the tolerance.
    pub rays_across: Option<usize>,
}

/// Rays per side of the grid on which the energy is added up.
const GRID: usize = 64;

/// A particle by rays.
///
/// # Errors
/// A particle that rays cannot serve.
pub fn rays(request: &Request, particle: &RayRequest) -> Result<Scattering, ScatterError> {
    let Request { size_parameter, index, azimuth, tolerance, .. } = *request;
    check_rays(index, size_parameter, "")?;
    let engine = match particle.diffraction {
        RayDiffraction::Airy => Engine::Meridians,
        RayDiffraction::None | RayDiffraction::Gaussian { .. } => Engine::Patches,
    };
    let auto = particle.orders.is_none();
    let orders = match &particle.orders {
        Some(orders) => orders.clone(),
        None if engine == Engine::Patches => (0..=last_order(index.re, tolerance)).collect(),
        None => orders_that_matter(index.re, tolerance, &particle.shape),
    };
    let diffraction = auto && particle.diffraction != RayDiffraction::None;
    let shape = particle.shape.clone();
    let plan =
        Plan::direct(shape, 1.0, engine, orders, diffraction, tolerance, particle.rays_across);
    let filter = match particle.diffraction {
        RayDiffraction::Gaussian { radius } => Some(gaussian_filter::standard_deviation(radius)),
        _ => None,
    };
    // The backward direction rides along: rays are traced once.
    let asked = request.theta.iter().map(|&theta| (theta, azimuth));
    let directions: Vec<(f64, f64)> = asked.chain([(PI, azimuth)]).collect();
    let fates = fates(&plan, request)?;
    let Seen { mut amplitudes, sections, worth } = simulate::scatter_with_sections(
        &plan,
        index,
        size_parameter,
        &directions,
        fates.absorbed,
        filter,
    )?;
    let back = amplitudes.pop().unwrap_or_default();
    let shadow = plan.shape.silhouette().area() / PI;
    let (q_ext, q_abs) = (sections.extinction / PI, sections.absorption / PI);
    let q_sca = q_ext - q_abs;
    // Rays by their angles; what is beyond them goes straight on.
    let straight = q_sca - shadow * (1.0 - fates.absorbed);
    let efficiencies = Efficiencies {
        q_ext,
        q_sca,
        q_abs,
        q_back: 4.0 * back.s11() / size_parameter.powi(2),
        asymmetry: (shadow * fates.forward_momentum + straight) / q_sca,
    };
    let diffraction_included = diffraction;
    Ok(Scattering {
        amplitudes,
        efficiencies,
        diffraction_included,
        remainder: None,
        worth: Some(worth),
        bows: Vec::new(),
    })
}

/// What becomes of the light on the shadow, by rays.
fn fates(plan: &Plan, request: &Request) -> Result<Fates, ScatterError> {
    let spokes = if plan.symmetry == Symmetry::Rotational { 4 } else { GRID };
    // light that a list leaves out is followed too: it may be absorbed
    let listed = plan.orders.iter().copied().max().unwrap_or(0);
    let last = listed.max(last_order(request.index.re, plan.tolerance));
    let tracer = Tracer::new(&plan.shape, request.index, request.size_parameter, last);
    let fates = energy_by_fate(&tracer, &Wavefront::midpoints(&plan.shape, GRID, spokes));
    if simulate::adds_up(fates.residual, request.index, last) {
        Ok(fates)
    } else {
        Err(ScatterError::Energy(fates.residual))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scatter::lorenz_mie;

    fn request(size_parameter: f64) -> Request {
        let theta = (40..=160).map(|i| f64::from(i).to_radians()).collect();
        Request { size_parameter, index: 1.33.into(), theta, azimuth: 0.3, tolerance: 0.01 }
    }

    fn sphere(diffraction: RayDiffraction) -> RayRequest {
        RayRequest { shape: Shape::sphere(), orders: None, diffraction, rays_across: None }
    }

    /// Efficiencies of a large sphere against Lorenz–Mie, which knows them.
    #[test]
    fn efficiencies_are_those_of_the_sphere() {
        let request = request(600.0);
        let exact = lorenz_mie(&request).unwrap().efficiencies;
        let seen = rays(&request, &sphere(RayDiffraction::Airy)).unwrap();
        let found = seen.efficiencies;
        assert!((found.q_ext / exact.q_ext - 1.0).abs() < 2e-3, "{found:?} {exact:?}");
        assert!((found.asymmetry - exact.asymmetry).abs() < 6e-3, "{found:?} {exact:?}");
        assert!(seen.diffraction_included && seen.worth.unwrap().weighted < 0.1);
    }

    /// How far rays are off is told; where they cannot, they are refused.
    #[test]
    fn doubt_is_told_and_impossible_is_refused() {
        let worth = rays(&request(25.0), &sphere(RayDiffraction::Airy)).unwrap().worth.unwrap();
        assert!(worth.weighted > 0.05, "{worth:?}");
        let refused = rays(&request(0.5), &sphere(RayDiffraction::None)).unwrap_err();
        assert_eq!(crate::fault::Blame::fault(&refused), crate::fault::Fault::Input);
    }

    /// Without diffraction a sphere takes out its shadow alone, with the filter twice that.
    #[test]
    fn patches_know_the_shadow() {
        let request = request(300.0);
        let plain = rays(&request, &sphere(RayDiffraction::None)).unwrap();
        let filter = RayDiffraction::Gaussian { radius: 30e-6 };
        let smooth = rays(&request, &sphere(filter)).unwrap();
        assert!((plain.efficiencies.q_ext - 1.0).abs() < 1e-9);
        assert!((smooth.efficiencies.q_ext - 2.0).abs() < 1e-9);
        assert!(!plain.diffraction_included && smooth.diffraction_included);
    }
}
