//! How far one table is from another: numbers by angular band and polarisation, shifts of maxima,
//! energy, and a page to look at (`page`).
//!
//! Where the tables come from is no matter; [`against_mie`] computes those of spheres by every method, and
//! [`speed`] measures what an error costs in time.
//!
//! Errors are taken over all wavelengths and azimuths that the tables share; curves and maxima at
//! the first azimuth of each table and at the wavelength of the middle of the reference, which is
//! interpolated at the angles of the other.
//!
//! ```
//! use gonio::compare::{Case, Entry, measure};
//! use gonio::scene::{Scene, SceneFile, SceneText};
//! use gonio::simulate;
//!
//! let text = r#"
//! [particle]
//! shape = "sphere"
//! radius_um = 5
//! [light]
//! wavelengths_nm = [550]
//! [table]
//! theta_deg = { from = 0, to = 180, count = 91 }
//! azimuth_deg = [0]
//! "#;
//! let text = SceneText::parse("example", text.into())?;
//! let scene = Scene::from_text(text, &SceneFile::default())?;
//! let entry = |name: &str, table| Entry { name: name.into(), table, seconds: None };
//! let exact = simulate::table(&scene)?;
//! let mut brighter = exact.clone();
//! brighter.slabs[0].values *= 1.01;
//! let report = measure(&Case {
//!     name: "one per cent".into(),
//!     reference: entry("exact", exact),
//!     tests: vec![entry("brighter", brighter)],
//!     orders: vec![],
//! })?;
//! assert!(report.tests[0].bands.iter().all(|band| (band.l2 - 0.01).abs() < 1e-4));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod against_mie;
mod bands;
#[cfg(feature = "pictures")]
mod charts;
mod curve;
mod differences;
mod energy;
mod maxima;
#[cfg(feature = "pictures")]
pub mod page;
pub mod speed;

pub use bands::{BANDS, BandReport};
pub use energy::EnergyReport;
pub use maxima::{Maxima, Maximum};

use crate::fault::{Blame, Fault};
use crate::phase_table::PhaseTable;
use curve::{Curve, nearest};
use serde::Serialize;

/// Why two tables cannot be compared.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum CompareError {
    #[error("{what}: {left} and {right} have nothing in common to compare")]
    Disjoint { what: &'static str, left: String, right: String },
}

impl Blame for CompareError {
    fn fault(&self) -> Fault {
        Fault::Input
    }
}

/// A table with its name and what it cost.
#[derive(Clone, Debug)]
pub struct Entry {
    /// What the page calls it.
    pub name: String,
    /// The table.
    pub table: PhaseTable,
    /// Computing time; nothing for a table read from a file.
    pub seconds: Option<f64>,
}

/// One reference and what is held against it.
#[derive(Clone, Debug)]
pub struct Case {
    /// What the page calls it.
    pub name: String,
    /// What the others are compared with.
    pub reference: Entry,
    /// What is compared.
    pub tests: Vec<Entry>,
    /// Single orders by the method that is tested, each with the exact term.
    pub orders: Vec<OrderPair>,
}

/// One order, tested and exact.
#[derive(Clone, Debug)]
pub struct OrderPair {
    /// Number of chords.
    pub order: u32,
    /// By the method that is judged.
    pub test: Entry,
    /// By the exact term.
    pub exact: Entry,
}

/// Everything measured on a case.
#[derive(Clone, Debug, Serialize)]
pub struct CaseReport {
    /// As of the case.
    pub name: String,
    /// What the reference is called.
    pub reference: String,
    /// Time that the reference took.
    pub reference_seconds: Option<f64>,
    /// Cross-sections of the reference.
    pub reference_energy: Option<EnergyReport>,
    /// The scene of the reference, all keys, as TOML.
    pub scene: String,
    /// Of the curves and the maxima.
    pub wavelength_nm: f64,
    /// One per table compared.
    pub tests: Vec<TestReport>,
    /// One per order compared.
    pub orders: Vec<OrderReport>,
}

/// One table against the reference.
#[derive(Clone, Debug, Serialize)]
pub struct TestReport {
    /// What it is called.
    pub name: String,
    /// Time that it took.
    pub seconds: Option<f64>,
    /// The scene as TOML.
    pub scene: String,
    /// What of its particles and their light is not as in the reference.
    pub differences: Vec<String>,
    /// How many of them the tables share, and were compared.
    pub wavelengths: usize,
    /// Azimuths that both tables share.
    pub azimuths: usize,
    /// Errors by band and polarisation.
    pub bands: Vec<BandReport>,
    #[serde(flatten)]
    /// Shifts of maxima.
    pub maxima: Maxima,
    /// Cross-sections, where the table has them.
    pub energy: Option<EnergyReport>,
}

/// One order against the exact term.
#[derive(Clone, Debug, Serialize)]
pub struct OrderReport {
    /// Number of chords.
    pub order: u32,
    /// Time of the method that is judged.
    pub seconds: Option<f64>,
    /// Time of the exact term.
    pub exact_seconds: Option<f64>,
    /// Errors by band and polarisation.
    pub bands: Vec<BandReport>,
}

/// Measure a case.
///
/// # Errors
/// [`CompareError`] when the tables share no wavelengths, azimuths or angles.
pub fn measure(case: &Case) -> Result<CaseReport, CompareError> {
    let reference = &case.reference;
    let wavelengths = &reference.table.header.axes.wavelength;
    let wavelength = wavelengths.get(wavelengths.len() / 2).copied().unwrap_or(f64::NAN);
    let tests = case.tests.iter().map(|test| measure_one(test, reference, wavelength));
    let orders = case.orders.iter().map(|pair| OrderReport {
        order: pair.order,
        seconds: pair.test.seconds,
        exact_seconds: pair.exact.seconds,
        bands: bands::shared(&pair.test.table, &pair.exact.table).bands,
    });
    Ok(CaseReport {
        name: case.name.clone(),
        reference: reference.name.clone(),
        reference_seconds: reference.seconds,
        reference_energy: EnergyReport::of(&reference.table, wavelength),
        scene: reference.table.header.scene_toml.clone(),
        wavelength_nm: wavelength * 1e9,
        tests: tests.collect::<Result<_, _>>()?,
        orders: orders.collect(),
    })
}

fn measure_one(
    test: &Entry,
    reference: &Entry,
    wavelength: f64,
) -> Result<TestReport, CompareError> {
    let shared = bands::shared(&test.table, &reference.table);
    if shared.bands.is_empty() {
        let what = match (shared.wavelengths, shared.azimuths) {
            (0, _) => "wavelengths",
            (_, 0) => "azimuths",
            _ => "scattering angles from 1 to 179 degrees",
        };
        let (left, right) = (test.name.clone(), reference.name.clone());
        return Err(CompareError::Disjoint { what, left, right });
    }
    let curve = Curve::relative_to(&test.table, &reference.table, wavelength);
    let truth = Curve::relative_to(&reference.table, &reference.table, wavelength);
    let size = maxima::size_parameter(&test.table, &reference.table, wavelength);
    let index = nearest(&reference.table, wavelength).map_or(f64::NAN, |slab| slab.index.re);
    Ok(TestReport {
        name: test.name.clone(),
        seconds: test.seconds,
        scene: test.table.header.scene_toml.clone(),
        differences: differences::differences(&test.table, &reference.table),
        wavelengths: shared.wavelengths,
        azimuths: shared.azimuths,
        bands: shared.bands,
        maxima: maxima::maxima(&curve, &truth, size, index),
        energy: EnergyReport::of(&test.table, wavelength),
    })
}

/// The largest `l2` of unpolarised light over the bands of all cases' first test: what
/// `--fail-above` is held against.
pub fn worst(reports: &[CaseReport]) -> f64 {
    reports
        .iter()
        .filter_map(|report| report.tests.first())
        .flat_map(|test| &test.bands)
        .filter(|band| band.polarisation == "unpolarised")
        .map(|band| band.l2)
        .fold(0.0, |most, l2| if l2.is_nan() { l2 } else { f64::max(most, l2) })
}
