//! How far one table is from another: numbers by angular band and polarisation, shifts of maxima,
//! and a page to look at ([`page`]).
//!
//! Curves are taken at the first azimuth of each table and at the wavelength of the middle of the
//! reference; the reference is interpolated at the angles of the other.

pub mod page;

use crate::phase_table::{EnergyBudget, PhaseTable, Quantity};
use serde::Serialize;

/// Why two tables cannot be compared.
#[derive(Debug, thiserror::Error)]
pub enum CompareError {
    #[error("{what}: {left} and {right} have nothing in common to compare")]
    Disjoint { what: &'static str, left: String, right: String },
}

/// A table with its name and what it cost.
#[derive(Clone, Debug)]
pub struct Entry {
    pub name: String,
    pub table: PhaseTable,
    /// Computing time; nothing for a table read from a file.
    pub seconds: Option<f64>,
}

/// One reference and what is held against it.
#[derive(Clone, Debug)]
pub struct Case {
    pub name: String,
    pub reference: Entry,
    pub tests: Vec<Entry>,
}

/// Everything measured on a case.
#[derive(Clone, Debug, Serialize)]
pub struct CaseReport {
    pub name: String,
    pub reference: String,
    pub reference_seconds: Option<f64>,
    pub wavelength_nm: f64,
    pub tests: Vec<TestReport>,
}

/// One table against the reference.
#[derive(Clone, Debug, Serialize)]
pub struct TestReport {
    pub name: String,
    pub seconds: Option<f64>,
    pub bands: Vec<BandReport>,
    pub maxima: Vec<Maximum>,
}

/// Relative error in a band of scattering angles, of unpolarised light unless said otherwise.
#[derive(Clone, Debug, Serialize)]
pub struct BandReport {
    pub from_deg: f64,
    pub to_deg: f64,
    pub polarisation: &'static str,
    pub samples: usize,
    pub median: f64,
    pub q99: f64,
    pub max: f64,
    /// ‖difference‖ / ‖reference‖.
    pub l2: f64,
}

/// A maximum of the reference and the nearest one of the test (both without their fine ripple).
#[derive(Clone, Debug, Serialize)]
pub struct Maximum {
    pub reference_deg: f64,
    pub shift_deg: f64,
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

/// Intensities over the scattering angle.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Degrees, ascending.
    pub theta: Vec<f64>,
    /// Unpolarised, parallel and perpendicular, sr⁻¹; the last two only from Mueller tables.
    pub intensity: Vec<(&'static str, Vec<f64>)>,
}

impl Curve {
    /// The curve of `table`, scaled by its scattering cross-section over that of `reference`: what
    /// is compared is scattered power, so that leaving out an order or the diffraction does not
    /// change the others.
    pub fn relative_to(table: &PhaseTable, reference: &PhaseTable, wavelength: f64) -> Self {
        let mut curve = Self::of(table, wavelength);
        let middle =
            |t: &PhaseTable| t.slabs.get(t.slabs.len() / 2).map(|s| s.scattering_cross_section);
        if let (Some(own), Some(other)) = (middle(table), middle(reference)) {
            for (_, values) in &mut curve.intensity {
                values.iter_mut().for_each(|v| *v *= own / other);
            }
        }
        curve
    }

    /// The curve of a table at the wavelength nearest to `wavelength` (metres).
    pub fn of(table: &PhaseTable, wavelength: f64) -> Self {
        let theta: Vec<f64> =
            table.header.axes.theta.iter().map(|t| (t.to_degrees() * 1e9).round() * 1e-9).collect();
        let slab = table.slabs.iter().min_by(|a, b| {
            (a.wavelength - wavelength).abs().total_cmp(&(b.wavelength - wavelength).abs())
        });
        let Some(slab) = slab else { return Self { theta, intensity: Vec::new() } };
        let element = |e: usize| -> Vec<f64> {
            (0..theta.len()).map(|t| f64::from(slab.values[[e, t, 0]])).collect()
        };
        let total = element(0);
        let mut intensity = Vec::new();
        if table.header.quantity == Quantity::Mueller {
            let q = element(1);
            let mix = |sign: f64| total.iter().zip(&q).map(|(i, q)| i + sign * q).collect();
            intensity.push(("parallel", mix(1.0)));
            intensity.push(("perpendicular", mix(-1.0)));
        }
        intensity.insert(0, ("unpolarised", total));
        Self { theta, intensity }
    }

    /// Linear interpolation; nothing outside.
    fn at(&self, which: usize, theta: f64) -> Option<f64> {
        let values = &self.intensity.get(which)?.1;
        let above = self.theta.partition_point(|&t| t <= theta + 1e-9);
        if above == 0 {
            return None;
        }
        let low = above - 1;
        if (theta - self.theta[low]).abs() < 1e-7 {
            return Some(values[low]);
        }
        let high = self.theta.get(above)?;
        let share = (theta - self.theta[low]) / (high - self.theta[low]);
        Some(values[low] + share * (values[above] - values[low]))
    }
}

/// Measure a case.
///
/// # Errors
/// [`CompareError`] when the tables share no angles.
pub fn measure(case: &Case) -> Result<CaseReport, CompareError> {
    let axes = &case.reference.table.header.axes;
    let wavelength = axes.wavelength.get(axes.wavelength.len() / 2).copied().unwrap_or(f64::NAN);
    let reference = Curve::of(&case.reference.table, wavelength);
    let mut tests = Vec::new();
    for test in &case.tests {
        let curve = Curve::relative_to(&test.table, &case.reference.table, wavelength);
        let bands = bands(&curve, &reference);
        if bands.is_empty() {
            return Err(CompareError::Disjoint {
                what: "scattering angles",
                left: test.name.clone(),
                right: case.reference.name.clone(),
            });
        }
        tests.push(TestReport {
            name: test.name.clone(),
            seconds: test.seconds,
            bands,
            maxima: maxima(&curve, &reference, ripple(&test.table, &case.reference.table)),
        });
    }
    Ok(CaseReport {
        name: case.name.clone(),
        reference: case.reference.name.clone(),
        reference_seconds: case.reference.seconds,
        wavelength_nm: wavelength * 1e9,
        tests,
    })
}

fn bands(curve: &Curve, reference: &Curve) -> Vec<BandReport> {
    let mut reports = Vec::new();
    let shared = curve.intensity.len().min(reference.intensity.len());
    for which in 0..shared {
        let (polarisation, values) = &curve.intensity[which];
        for (from, to) in BANDS {
            let pairs: Vec<(f64, f64)> = curve
                .theta
                .iter()
                .zip(values)
                .filter(|(t, _)| (from..=to).contains(*t))
                .filter_map(|(&t, &value)| Some((value, reference.at(which, t)?)))
                .collect();
            if pairs.is_empty() {
                continue;
            }
            let mut errors: Vec<f64> = pairs.iter().map(|(a, b)| ((a - b) / b).abs()).collect();
            errors.sort_by(f64::total_cmp);
            let at = |q: f64| errors[(q * (errors.len() - 1) as f64).round() as usize];
            let norm =
                |f: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(|p| f(p).powi(2)).sum::<f64>();
            reports.push(BandReport {
                from_deg: from,
                to_deg: to,
                polarisation,
                samples: pairs.len(),
                median: at(0.5),
                q99: at(0.99),
                max: at(1.0),
                l2: (norm(&|p| p.0 - p.1) / norm(&|p| p.1)).sqrt(),
            });
        }
    }
    reports
}

/// Period in degrees of the fine ripple on the bows at the middle wavelength, of whichever drop has
/// the longer one: external reflection meets the bow's rays from the other side of the drop, about
/// `1.2 r` away, so that crests are `360° / (1.2 x)` apart.
fn ripple(test: &PhaseTable, reference: &PhaseTable) -> f64 {
    let period = |table: &PhaseTable| {
        let wavelengths = &table.header.axes.wavelength;
        let wavelength = wavelengths.get(wavelengths.len() / 2).copied().unwrap_or(f64::NAN);
        let size_parameter = std::f64::consts::TAU * table.header.radius / wavelength;
        360.0 / (1.2 * size_parameter)
    };
    period(test).max(period(reference))
}

/// Angles of the bow's maxima, 120° to 150°, once a ripple of that period (degrees) is taken away.
fn maxima(curve: &Curve, reference: &Curve, ripple: f64) -> Vec<Maximum> {
    let found = peaks(curve, ripple);
    peaks(reference, ripple)
        .into_iter()
        .filter_map(|reference_deg| {
            let nearest = found
                .iter()
                .min_by(|a, b| (*a - reference_deg).abs().total_cmp(&(*b - reference_deg).abs()))?;
            Some(Maximum { reference_deg, shift_deg: nearest - reference_deg })
        })
        .collect()
}

/// Maxima of the smoothed curve, refined by a parabola, that rise above their surroundings.
fn peaks(curve: &Curve, ripple: f64) -> Vec<f64> {
    // A Gaussian of 0.6 periods leaves exp(-½ (2π 0.6)²) = 1e-3 of the ripple.
    let width = if ripple.is_finite() { 0.6 * ripple } else { 0.2 };
    let Some((_, values)) = curve.intensity.first() else { return Vec::new() };
    let theta: Vec<f64> = (0..=1500).map(|i| 120.0 + 0.02 * f64::from(i)).collect();
    let smooth: Vec<f64> = theta.iter().map(|&t| smoothed(curve, values, t, width)).collect();
    let highest = smooth.iter().copied().fold(0.0, f64::max);
    let mut out = Vec::new();
    for i in 1..smooth.len() - 1 {
        let (a, b, c) = (smooth[i - 1], smooth[i], smooth[i + 1]);
        if !(b > a && b >= c && b > 0.02 * highest) {
            continue;
        }
        let window = i.saturating_sub(50)..(i + 51).min(smooth.len());
        let lowest = smooth[window].iter().copied().fold(f64::INFINITY, f64::min);
        if b > 1.1 * lowest {
            out.push(theta[i] + 0.02 * 0.5 * (a - c) / (a - 2.0 * b + c));
        }
    }
    out
}

/// Mean of a curve about an angle, weighted by a Gaussian (degrees).
fn smoothed(curve: &Curve, values: &[f64], centre: f64, width: f64) -> f64 {
    let from = curve.theta.partition_point(|&t| t < centre - 3.0 * width);
    let to = curve.theta.partition_point(|&t| t <= centre + 3.0 * width);
    let (mut sum, mut norm) = (0.0, 0.0);
    for (t, v) in curve.theta[from..to].iter().zip(&values[from..to]) {
        let weight = (-0.5 * ((t - centre) / width).powi(2)).exp();
        sum += weight * v;
        norm += weight;
    }
    if norm > 0.0 { sum / norm } else { 0.0 }
}

/// The largest `l2` of unpolarised light between `from` and `to` degrees over all cases' first
/// test: what `--fail-above` is held against.
pub fn worst(reports: &[CaseReport]) -> f64 {
    reports
        .iter()
        .filter_map(|report| report.tests.first())
        .flat_map(|test| &test.bands)
        .filter(|band| band.polarisation == "unpolarised")
        .map(|band| band.l2)
        .fold(0.0, f64::max)
}

/// The energy budget of a table's middle wavelength.
pub fn energy(table: &PhaseTable) -> Option<&EnergyBudget> {
    table.slabs.get(table.slabs.len() / 2)?.energy.as_ref()
}
