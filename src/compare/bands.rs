//! Relative error by band of scattering angle and by polarisation, over all wavelengths and
//! azimuths that two tables share.

use super::curve::Curve;
use crate::phase_table::{PhaseTable, Slab};
use serde::Serialize;

/// Relative error in a band of scattering angles, of unpolarised light unless said otherwise.
#[derive(Clone, Debug, Serialize)]
pub struct BandReport {
    /// Where the band begins, degrees.
    pub from_deg: f64,
    /// Where it ends, degrees.
    pub to_deg: f64,
    /// `total`, `parallel` or `perpendicular`.
    pub polarisation: &'static str,
    /// Angles × wavelengths × azimuths.
    pub samples: usize,
    /// Median of the relative error.
    pub median: f64,
    /// Its 99th percentile.
    pub q99: f64,
    /// Its maximum.
    pub max: f64,
    /// ‖difference‖ / ‖reference‖.
    pub l2: f64,
}

/// Bands, degrees: forward lobe, sides, secondary bow, dark band, primary bow, back.
pub const BANDS: [(f64, f64); 7] = [
    (1.0, 10.0),
    (10.0, 90.0),
    (90.0, 120.0),
    (120.0, 129.0),
    (129.0, 137.5),
    (137.5, 150.0),
    (150.0, 179.0),
];

/// Most azimuths that are compared, evenly taken from the table.
const MOST_AZIMUTHS: usize = 13;
/// Wavelengths and azimuths (radians) that differ by less, relative, are the same.
const SAME: f64 = 1e-6;

/// What two tables share: wavelengths, azimuths, and the errors there.
pub(super) struct Shared {
    pub wavelengths: usize,
    pub azimuths: usize,
    pub bands: Vec<BandReport>,
}

/// A sample of the test, and of the reference in the same direction.
struct Pair {
    theta: f64,
    value: f64,
    truth: f64,
}

/// Compare two tables wherever both have values.
pub(super) fn shared(test: &PhaseTable, reference: &PhaseTable) -> Shared {
    let slabs = common_slabs(test, reference);
    let azimuths = common_azimuths(test, reference);
    let mut pairs: Vec<(&'static str, Vec<Pair>)> = Vec::new();
    for &(own, other) in &slabs {
        let factor = own.scattering_cross_section / other.scattering_cross_section;
        for &(place, truth_place) in &azimuths {
            let curve = Curve::of(test, own, place, factor);
            let truth = Curve::of(reference, other, truth_place, 1.0);
            let kinds = curve.intensity.len().min(truth.intensity.len());
            for which in 0..kinds {
                let (polarisation, values) = &curve.intensity[which];
                if pairs.len() <= which {
                    pairs.push((polarisation, Vec::new()));
                }
                pairs[which].1.extend(curve.theta.iter().zip(values).filter_map(
                    |(&theta, &value)| Some(Pair { theta, value, truth: truth.at(which, theta)? }),
                ));
            }
        }
    }
    let bands = pairs
        .iter()
        .flat_map(|(polarisation, pairs)| {
            BANDS.iter().filter_map(|&band| report(band, polarisation, pairs))
        })
        .collect();
    Shared { wavelengths: slabs.len(), azimuths: azimuths.len(), bands }
}

fn report((from, to): (f64, f64), polarisation: &'static str, all: &[Pair]) -> Option<BandReport> {
    let pairs: Vec<&Pair> = all.iter().filter(|p| (from..=to).contains(&p.theta)).collect();
    if pairs.is_empty() {
        return None;
    }
    let mut errors: Vec<f64> =
        pairs.iter().map(|p| ((p.value - p.truth) / p.truth).abs()).collect();
    errors.sort_by(f64::total_cmp);
    let at = |q: f64| errors[(q * (errors.len() - 1) as f64).round() as usize];
    let norm = |f: &dyn Fn(&Pair) -> f64| pairs.iter().map(|p| f(p).powi(2)).sum::<f64>();
    Some(BandReport {
        from_deg: from,
        to_deg: to,
        polarisation,
        samples: pairs.len(),
        median: at(0.5),
        q99: at(0.99),
        max: at(1.0),
        l2: (norm(&|p| p.value - p.truth) / norm(&|p| p.truth)).sqrt(),
    })
}

/// Slabs of the same wavelength; of one wavelength each, they are compared whatever it is.
fn common_slabs<'a>(test: &'a PhaseTable, reference: &'a PhaseTable) -> Vec<(&'a Slab, &'a Slab)> {
    let same = |a: &Slab, b: &Slab| (a.wavelength / b.wavelength - 1.0).abs() < SAME;
    let found = test.slabs.iter().filter_map(|own| {
        reference.slabs.iter().find(|other| same(own, other)).map(|other| (own, other))
    });
    let found: Vec<_> = found.collect();
    match (found.is_empty(), test.slabs.as_slice(), reference.slabs.as_slice()) {
        (true, [own], [other]) => vec![(own, other)],
        _ => found,
    }
}

/// Places of the same azimuth in both tables; a table without azimuth dependence stands for all.
fn common_azimuths(test: &PhaseTable, reference: &PhaseTable) -> Vec<(usize, usize)> {
    let (own, other) = (&test.header.axes.phi, &reference.header.axes.phi);
    let place = |phi: f64| match reference.header.rotational_symmetry {
        true => Some(0),
        false => other.iter().position(|&b| (b - phi).abs() < SAME),
    };
    if test.header.rotational_symmetry {
        let each = other.len().div_ceil(MOST_AZIMUTHS);
        return (0..other.len()).step_by(each).map(|j| (0, j)).collect();
    }
    let found: Vec<_> =
        own.iter().enumerate().filter_map(|(i, &phi)| Some((i, place(phi)?))).collect();
    let each = found.len().div_ceil(MOST_AZIMUTHS).max(1);
    found.into_iter().step_by(each).collect()
}
