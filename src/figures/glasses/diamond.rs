//! The fire of diamond.

use crate::figures::figure::Figure;
use crate::figures::media::medium;
use crate::figures::papers;
use crate::figures::plain::{BLUE, GREY, RED, evenly, points, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::medium::{AbbeLines, fit_cauchy};
use crate::render::plots::sheet::{Axis, Chart, Curve, Mark, Panel};

pub(super) const FIRE: Figure = Figure {
    name: "glass-diamond",
    source: papers::GLASSES,
    caption: "Index of diamond, its fire (n at Fraunhofer's G less that at B), and Cauchy's formula of two terms",
    compare: "0.044 is a difference of indices, not Cauchy's B, which is 0.012 µm²: taken for B it makes diamond nearly four \
              times as dispersive",
    scenes: &[],
    pictures: false,
    make,
};

/// LuxCore's: the dispersion commonly quoted, and Cauchy's B in µm².
const QUOTED: f64 = 0.044;
const CAUCHY_B: f64 = 0.0121;
/// Fraunhofer's lines B and G, nm, between which jewellers take fire.
const LINES: (f64, f64) = (686.7, 430.8);

fn make(_: &Workshop) -> Result<Made, FigureError> {
    let diamond = medium("diamond")?;
    let nm = evenly(400.0, 750.0, 351);
    let mut n = Vec::new();
    for nm in &nm {
        n.push(diamond.index(nm * 1e-9)?.re);
    }
    let fire = diamond.index(LINES.1 * 1e-9)?.re - diamond.index(LINES.0 * 1e-9)?.re;
    let mut numbers =
        vec![Number::beside("fire of diamond, n at 430.8 less that at 686.7 nm", "", QUOTED, fire)];
    let abbe = diamond.abbe(AbbeLines::HeliumD);
    let cauchy =
        abbe.map(|abbe| abbe.to_cauchy(AbbeLines::HeliumD)).transpose()?.unwrap_or([f64::NAN; 2]);
    numbers.push(Number::beside("Cauchy's B by index and Abbe number", "µm²", CAUCHY_B, cauchy[1]));
    let (fitted, _) = fit_cauchy(2, (0.4, 0.75), |um| Ok(diamond.index(um * 1e-6)?.re))?;
    numbers.push(Number::beside(
        "Cauchy's B by least squares, 400 to 750 nm",
        "µm²",
        CAUCHY_B,
        fitted[1],
    ));
    if let Some(abbe) = abbe {
        numbers.push(Number::alone("Abbe number V_d", "", abbe.number));
    }
    let law =
        |a: f64, b: f64| -> Vec<f64> { nm.iter().map(|nm| a + b * (nm * 1e-3).powi(-2)).collect() };
    let middle = abbe.map_or(f64::NAN, |abbe| abbe.index);
    let wrong = law(middle - QUOTED * 0.587_561_8f64.powi(-2), QUOTED);
    let mark = |x: f64, name: &str| Mark { x, name: name.into() };
    let chart = Chart {
        title: "diamond".into(),
        x: Axis::linear("wavelength (nm)", 400.0, 750.0),
        y: Axis::linear("n", 2.35, 2.6),
        curves: vec![
            Curve::new("0.044 taken for B", GREY, points(&nm, &wrong)).dashed(),
            Curve::new(
                "two terms of Cauchy's, by Abbe number",
                RED,
                points(&nm, &law(cauchy[0], cauchy[1])),
            ),
            Curve::new("diamond", BLUE, points(&nm, &n)),
        ],
        marks: vec![mark(LINES.1, "G"), mark(LINES.0, "B")],
        ..Chart::default()
    };
    Ok(Made::new(sheet("Fire of diamond", 1, (760, 500), vec![Panel::Chart(chart)], &[]), numbers))
}
