//! Fig. 2: ice from the ultraviolet to the far infrared.

use crate::figures::figure::Figure;
use crate::figures::media::{curve, medium};
use crate::figures::papers;
use crate::figures::plain::{BLUE, RED, by_factors, maximum, points, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::render::plots::sheet::{Axis, Chart, Curve, Mark, Panel};

pub(super) const FIG_2: Figure = Figure {
    name: "weidlich-2",
    source: papers::ANOMALOUS_DISPERSION,
    caption: "Fig. 2: n and k of ice from 0.1 to 100 µm (Warren & Brandt 2008; the paper's are Warren's of 1984)",
    compare: "Smooth and transparent in the visible; n falls before each band of absorption and jumps within it; k reaches \
              0.4 in the ultraviolet and 0.6 at 3 µm",
    scenes: &[],
    pictures: false,
    make,
};

fn make(_: &Workshop) -> Result<Made, FigureError> {
    let um = by_factors(0.1, 100.0, 1500);
    let nm: Vec<f64> = um.iter().map(|um| (um * 1e3).clamp(100.0, 1e5)).collect();
    let (n, k) = curve(&medium("ice")?, &nm)?;
    let visible =
        || vec![Mark { x: 0.4, name: "visible".into() }, Mark { x: 0.7, name: String::new() }];
    let x = || Axis::logarithmic("wavelength (µm)", 0.1, 100.0);
    let panels = vec![
        Panel::Chart(Chart {
            title: "(a) index of refraction".into(),
            x: x(),
            y: Axis::linear("n", 0.9, 1.9),
            curves: vec![Curve::new("", BLUE, points(&um, &n))],
            marks: visible(),
            ..Chart::default()
        }),
        Panel::Chart(Chart {
            title: "(b) extinction coefficient".into(),
            x: x(),
            y: Axis::linear("k", 0.0, 0.95),
            curves: vec![Curve::new("", RED, points(&um, &k))],
            marks: visible(),
            ..Chart::default()
        }),
        Panel::Chart(Chart {
            title: "the same over eleven decades".into(),
            x: x(),
            y: Axis::logarithmic("k", 1e-11, 1.0),
            curves: vec![Curve::new("", RED, points(&um, &k))],
            marks: visible(),
            ..Chart::default()
        }),
    ];
    let at = |from: f64, to: f64, y: &[f64]| maximum(&um, y, from, to);
    let value = |at: f64, y: &[f64]| y[um.partition_point(|u| *u < at).min(y.len() - 1)];
    let lowest: Vec<f64> = n.iter().map(|n| -n).collect();
    let band = at(2.5, 3.6, &k);
    let numbers = vec![
        Number::alone("strongest band of the infrared, at", "µm", band),
        Number::alone("k there", "", value(band, &k)),
        Number::alone("least n before it, at", "µm", at(2.5, 3.2, &lowest)),
        Number::alone("greatest n behind it", "", value(at(3.0, 3.6, &n), &n)),
        Number::alone("n at 589 nm", "", value(0.589, &n)),
    ];
    let notes = [
        "Table: Warren & Brandt 2008, a revision of Warren 1984, which the paper draws; it prints no numbers.",
    ];
    Ok(Made::new(sheet("Ice", 3, (480, 420), panels, &notes), numbers))
}
