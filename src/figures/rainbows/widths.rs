//! Table II: the width of the filter that stands for diffraction, against what would suit best.

use crate::farfield::patches::gaussian_filter::{TABLE, standard_deviation};
use crate::figures::figure::Figure;
use crate::figures::papers;
use crate::figures::plain::{BLACK, BLUE, GREEN, RED, by_factors, evenly, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::math::airy::ai;
use crate::render::plots::sheet::{Axis, Chart, Curve, Panel};
use crate::series::airy::AiryBow;
use std::f64::consts::{FRAC_PI_4, PI, TAU};

pub(super) const TABLE_II: Figure = Figure {
    name: "sadeghi-table-2",
    source: papers::RAINBOWS,
    caption: "Table II: standard deviation of the Gaussian filter by the drop's radius, 0.1 to 1 mm",
    compare: "The paper's widths, found by comparison with Lorenz–Mie, against the width with which two rays that \
              interfere come nearest to Airy's theory: one law, the radius to the power -2/3",
    scenes: &[],
    pictures: false,
    make,
};

/// Light of the paper's Fig. 9.
const WAVELENGTH: f64 = 650e-9;
const INDEX: f64 = 1.3314;
/// Where the two are compared, in arguments of the Airy function: from the dark side to behind the first maximum.
const RANGE: (f64, f64) = (-2.0, 2.5);
/// Step of the integration over a filter, in arguments, and how many standard deviations it reaches.
const STEP: f64 = 0.004;
const REACH: f64 = 4.0;

/// Two rays that interfere, in the scale in which Airy's theory is Ai²(-z).
fn two_rays(z: f64) -> f64 {
    if z <= 0.0 {
        return 0.0;
    }
    (2.0 / 3.0 * z.powf(1.5) + FRAC_PI_4).sin().powi(2) / (PI * z.sqrt())
}

/// The same behind a filter. The rays' infinity at the bow is taken out by substituting the root of z.
fn filtered(z: f64, sigma: f64) -> f64 {
    let reach = REACH * sigma;
    let (from, to) = ((z - reach).max(0.0).sqrt(), (z + reach).max(0.0).sqrt());
    let count = ((to - from) / STEP).ceil().max(1.0) as usize;
    let step = (to - from) / count as f64;
    let sum: f64 = (0..count)
        .map(|i| from + (i as f64 + 0.5) * step)
        .map(|root| {
            let weight = (-0.5 * ((root * root - z) / sigma).powi(2)).exp();
            two_rays(root * root) * weight * 2.0 * root
        })
        .sum();
    sum * step / (sigma * TAU.sqrt())
}

/// The standard deviation, in arguments of the Airy function, with which filtered rays come nearest to it.
fn best() -> f64 {
    let places = evenly(RANGE.0, RANGE.1, 46);
    let misfit = |sigma: f64| -> f64 {
        places.iter().map(|&z| (filtered(z, sigma) - ai(-z).0.powi(2)).powi(2)).sum()
    };
    // Golden section.
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let (mut low, mut high) = (0.2, 2.5);
    for _ in 0..24 {
        let (a, b) = (high - golden * (high - low), low + golden * (high - low));
        if misfit(a) < misfit(b) { high = b } else { low = a }
    }
    0.5 * (low + high)
}

fn make(_: &Workshop) -> Result<Made, FigureError> {
    let best = best();
    let bow = |mm: f64| AiryBow::new(TAU * mm * 1e-3 / WAVELENGTH, INDEX.into(), 2);
    // Degrees per argument of the Airy function.
    let scale = |mm: f64| {
        bow(mm).map_or(f64::NAN, |bow| ((bow.maximum() - bow.angle()) / 1.018_793).to_degrees())
    };
    let mut numbers = Vec::new();
    for (mm, printed) in TABLE {
        let name = format!("standard deviation, {mm} mm");
        numbers.push(Number::beside(name, "°", printed, best * scale(mm)));
    }
    let filter = TABLE.map(|(mm, _)| standard_deviation(mm * 1e-3).to_degrees());
    let off = filter.iter().zip(TABLE).map(|(ours, (_, paper))| (ours - paper).abs());
    let worst = off.fold(0.0, f64::max);
    numbers.push(Number::beside(
        "largest difference of the engine's filter from the table",
        "°",
        0.0,
        worst,
    ));
    let radii = by_factors(0.1, 1.0, 60);
    let law = radii.iter().map(|&mm| (mm, best * scale(mm)));
    let z = evenly(-3.0, 5.0, 240);
    let of = |f: &dyn Fn(f64) -> f64| z.iter().map(|&z| (z, f(z))).collect::<Vec<_>>();
    let panels = vec![
        Panel::Chart(Chart {
            title: "width by radius, 650 nm".into(),
            x: Axis::logarithmic("drop radius (mm)", 0.1, 1.0),
            y: Axis::logarithmic("standard deviation (°)", 0.1, 1.0),
            curves: vec![
                Curve::new("nearest to Airy's theory", BLUE, law),
                Curve::new("Table II", RED, TABLE).dots(),
            ],
            ..Chart::default()
        }),
        Panel::Chart(Chart {
            title: format!("at the bow, filter of {best:.2} widths of the Airy function"),
            x: Axis::linear("distance within the bow (argument of the Airy function)", -3.0, 5.0),
            y: Axis::linear("intensity", 0.0, 0.6),
            curves: vec![
                Curve::new("rays that interfere", GREEN, of(&two_rays)).thin(),
                Curve::new("the same behind the filter", RED, of(&|z| filtered(z, best))),
                Curve::new("Airy's theory", BLACK, of(&|z| ai(-z).0.powi(2))).dashed(),
            ],
            ..Chart::default()
        }),
    ];
    let notes = [
        "Ours: the width with which two interfering rays of the primary bow come nearest to Airy's theory; the engine's own filter is the table.",
    ];
    Ok(Made::new(sheet("Width of the filter (Table II)", 2, (600, 460), panels, &notes), numbers))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A narrow filter leaves the rays as they are, away from the bow; a filter keeps their power.
    #[test]
    fn the_filter_is_a_mean() {
        assert!((filtered(2.0, 0.02) - two_rays(2.0)).abs() < 2e-3);
        let power =
            |f: &dyn Fn(f64) -> f64| (0..2000).map(|i| f(-3.0 + 0.004 * f64::from(i))).sum::<f64>();
        let (rays, soft) = (power(&|z| two_rays(z)), power(&|z| filtered(z, 0.3)));
        assert!((rays / soft - 1.0).abs() < 0.03, "{rays} {soft}");
    }
}
