//! Index by wavelength of some glasses, by Sellmeier's formula and by two terms of Cauchy's.

use crate::figures::figure::Figure;
use crate::figures::media::medium;
use crate::figures::papers;
use crate::figures::plain::{PALETTE, evenly, points, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::medium::{AbbeLines, abbe_to_sellmeier};
use crate::render::plots::sheet::{Axis, Chart, Curve, Panel};

pub(super) const CURVES: Figure = Figure {
    name: "glass-cauchy",
    source: papers::GLASSES,
    caption: "Index of glasses from 400 to 800 nm by the catalogue's Sellmeier formula, and the two terms of Cauchy's and the \
              one term of Sellmeier's that have the same index and Abbe number",
    compare: "N-BK7 falls from 1.53 at 400 nm to 1.51 at 800 nm; two terms fit in the visible and part in the blue, the more \
              the stronger the dispersion",
    scenes: &[],
    pictures: false,
    make,
};

const GLASSES: [&str; 5] = ["N-BK7", "N-FK51A", "F2", "SF11", "N-SF66"];
/// LuxCore's words: n of N-BK7 by nm.
const BK7: [(f64, f64); 2] = [(400.0, 1.53), (800.0, 1.51)];
/// pbrt's words on Abbe numbers.
const TYPICAL: (f64, f64) = (20.0, 90.0);

fn make(_: &Workshop) -> Result<Made, FigureError> {
    let nm = evenly(400.0, 800.0, 401);
    let (mut curves, mut errors, mut numbers) = (Vec::new(), Vec::new(), Vec::new());
    let glass = medium("N-BK7")?;
    for (at, paper) in BK7 {
        let ours = glass.index(at * 1e-9)?.re;
        numbers.push(Number::beside(format!("n of N-BK7 at {at} nm"), "", paper, ours));
    }
    let mut abbes = Vec::new();
    for (name, colour) in GLASSES.into_iter().zip(PALETTE) {
        let glass = medium(name)?;
        let mut n = Vec::new();
        for nm in &nm {
            n.push(glass.index(nm * 1e-9)?.re);
        }
        curves.push(Curve::new(name, colour, points(&nm, &n)));
        let lines = AbbeLines::HeliumD;
        let Some(abbe) = glass.abbe(lines) else { continue };
        abbes.push((name, abbe));
        let [a, b] = abbe.to_cauchy(lines)?;
        let [s, c] = abbe_to_sellmeier(abbe, lines)?;
        let cauchy: Vec<f64> = nm.iter().map(|nm| a + b * (nm * 1e-3).powi(-2)).collect();
        let squared = |um: f64| um * um;
        let sellmeier =
            nm.iter().map(|nm| (1.0 + s * squared(nm * 1e-3) / (squared(nm * 1e-3) - c)).sqrt());
        let off = |law: Vec<f64>| -> Vec<f64> {
            law.iter().zip(&n).map(|(a, b)| 1e3 * (a - b)).collect()
        };
        curves.push(Curve::new("", colour, points(&nm, &cauchy)).thin().dashed());
        errors.push(Curve::new(name, colour, points(&nm, &off(cauchy))));
        errors.push(Curve::new("", colour, points(&nm, &off(sellmeier.collect()))).thin().dashed());
    }
    let least = abbes.iter().map(|(_, abbe)| abbe.number).fold(f64::MAX, f64::min);
    let most = abbes.iter().map(|(_, abbe)| abbe.number).fold(0.0, f64::max);
    numbers.push(Number::beside(
        "least Abbe number drawn (typical range begins)",
        "",
        TYPICAL.0,
        least,
    ));
    numbers.push(Number::beside(
        "greatest Abbe number drawn (typical range ends)",
        "",
        TYPICAL.1,
        most,
    ));
    for (name, abbe) in abbes {
        numbers.push(Number::alone(format!("{name}: Abbe number V_d"), "", abbe.number));
    }
    let panels = vec![
        Panel::Chart(Chart {
            title: "Sellmeier's formula (lines), two terms of Cauchy's (dashed)".into(),
            x: Axis::linear("wavelength (nm)", 400.0, 800.0),
            y: Axis::linear("n", 1.45, 2.05),
            curves,
            ..Chart::default()
        }),
        Panel::Chart(Chart {
            title: "two terms of Cauchy's (lines), one of Sellmeier's (dashed), less the glass"
                .into(),
            x: Axis::linear("wavelength (nm)", 400.0, 800.0),
            y: Axis::linear("difference of n (10⁻³)", -40.0, 10.0),
            curves: errors,
            ..Chart::default()
        }),
    ];
    Ok(Made::new(sheet("Dispersion of glasses", 2, (640, 480), panels, &[]), numbers))
}
