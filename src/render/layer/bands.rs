//! What a layer's particles scatter, by a few bands of wavelength.
//!
//! Light scattered many times changes slowly with the wavelength, and the ripple of single drops is lost in it: tables are
//! averaged over bands, over azimuth, and over the kinds of drops.

use crate::phase_table::{PhaseTable, Quantity};
use crate::render::RenderError;
use crate::transfer::Expansion;

/// Bands at most.
const BANDS: usize = 9;
/// Scattering angle, degrees, that tables must begin at or before: what is scattered by less counts as going straight
/// on.
const FROM: f64 = 10.0;
/// Elements that particles have which are turned at random or seen from all sides.
const ELEMENTS: [usize; 6] = [0, 1, 5, 10, 11, 15];

/// The table of a kind of particles, and how many there are.
pub(super) type Kind<'a> = (&'a PhaseTable, f64);

/// All particles together in one band.
#[derive(Clone, Debug)]
pub(super) struct Band {
    pub wavelength: f64,
    pub phase: Expansion,
    /// Share of the scattered light before the first angle of the tables.
    pub peak: f64,
    pub albedo: f64,
}

/// The bands of some particles, with `count` coefficients each; and whether all tables have polarisation.
pub(super) fn bands(kinds: &[Kind<'_>], count: usize) -> Result<(Vec<Band>, bool), RenderError> {
    kinds.iter().try_for_each(|(table, _)| check(table))?;
    let polarised = kinds.iter().all(|(table, _)| table.header.quantity == Quantity::Mueller);
    let edge = |end: fn(f64, f64) -> f64, start: f64, from: fn(f64, f64) -> f64| {
        let of = |table: &PhaseTable| table.header.axes.wavelength.iter().copied().reduce(from);
        kinds.iter().filter_map(|(table, _)| of(table)).fold(start, end)
    };
    let (from, to) = (edge(f64::max, 0.0, f64::min), edge(f64::min, f64::INFINITY, f64::max));
    let fewest = kinds.iter().map(|(table, _)| table.slabs.len()).min().unwrap_or(0);
    let number = fewest.clamp(1, BANDS);
    let step = (to - from) / number as f64;
    let band = |k: usize| {
        // the first and last stand at the ends, so that colours have the whole range
        let middle = from + (to - from) * k as f64 / (number - 1).max(1) as f64;
        let within = (middle - 0.5 * step, middle + 0.5 * step);
        mixed(kinds, middle, within, count, polarised)
    };
    Ok(((0..number).map(band).collect(), polarised))
}

fn mixed(
    kinds: &[Kind<'_>],
    wavelength: f64,
    within: (f64, f64),
    count: usize,
    polarised: bool,
) -> Band {
    let mut phase = Expansion::zero(count);
    let (mut scattered, mut lost, mut straight) = (0.0, 0.0, 0.0);
    for (table, number) in kinds {
        let (elements, [scattering, extinction]) = curves(table, wavelength, within, polarised);
        let (expansion, found) = Expansion::of_curves(&table.header.axes.theta, &elements, count);
        let scattering = number * scattering;
        let seen = found.min(1.0);
        phase.add(&expansion, scattering * seen);
        scattered += scattering;
        lost += number * extinction;
        straight += scattering * (1.0 - seen);
    }
    let rest = scattered - straight;
    let mut whole = Expansion::zero(count);
    whole.add(&phase, 1.0 / rest);
    Band {
        wavelength,
        phase: whole,
        peak: straight / scattered,
        albedo: (scattered / lost).min(1.0),
    }
}

/// Means over the slabs of a band (the nearest slab where none lies in it), and their cross-sections.
fn curves(
    table: &PhaseTable,
    wavelength: f64,
    (from, to): (f64, f64),
    polarised: bool,
) -> ([Vec<f64>; 6], [f64; 2]) {
    let axes = &table.header.axes;
    let inside = |w: f64| (from..=to).contains(&w);
    let nearest = table
        .slabs
        .iter()
        .map(|slab| (slab.wavelength - wavelength).abs())
        .fold(f64::INFINITY, f64::min);
    let any = table.slabs.iter().any(|slab| inside(slab.wavelength));
    let mut sums: [Vec<f64>; 6] = std::array::from_fn(|_| vec![0.0; axes.theta.len()]);
    let (mut sections, mut number) = ([0.0; 2], 0.0);
    for slab in &table.slabs {
        let off = (slab.wavelength - wavelength).abs();
        if any && !inside(slab.wavelength) || !any && off > nearest {
            continue;
        }
        let (scattering, extinction) =
            (slab.scattering_cross_section, slab.extinction_cross_section);
        for (sum, element) in sums.iter_mut().zip(ELEMENTS) {
            if element == 0 || polarised {
                let mean = slab.azimuth_mean(axes, element);
                sum.iter_mut().zip(mean).for_each(|(sum, value)| *sum += scattering * value);
            }
        }
        sections[0] += scattering;
        sections[1] += extinction;
        number += 1.0;
    }
    sums.iter_mut().flatten().for_each(|value| *value /= sections[0]);
    (sums, sections.map(|section| section / number))
}

/// Refuses tables that lack most of the light.
fn check(table: &PhaseTable) -> Result<(), RenderError> {
    let theta = &table.header.axes.theta;
    let [from, to] =
        [theta.first(), theta.last()].map(|end| end.map_or(0.0, |angle| angle.to_degrees()));
    if from <= FROM && to >= 180.0 - 1e-6 {
        return Ok(());
    }
    Err(RenderError::Invalid {
        field: "drops.table".into(),
        value: format!("scattering angles from {from:.1} to {to:.1}"),
        accepted: format!(
            "tables from {FROM} degrees or less to 180: light is scattered by all angles in a layer"
        ),
    })
}
