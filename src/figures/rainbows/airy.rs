//! Airy's theory beside Lorenz–Mie, as strips such as AirySim draws.

use super::strips::{daylight, exposure, strip};
use crate::figures::figure::Figure;
use crate::figures::papers;
use crate::figures::plain::{BLACK, RED, evenly, maximum, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::lee::{Diagram, Polarisation, airy_spheres, spheres};
use crate::render::plots::sheet::{Axis, Chart, Curve, Panel};

pub(super) const STRIPS: Figure = Figure {
    name: "airy",
    source: papers::AIRY,
    caption: "Airy's theory of both bows beside Lorenz–Mie theory, drops of 0.05, 0.1, 0.2 and 0.5 mm",
    compare: "The primary's colours agree; Airy's secondary is near the truth at its bow alone; between the bows and beyond \
              them is light that Airy's theory has not; along the scattering plane it fails",
    scenes: &[],
    pictures: false,
    make,
};

const RADII_MM: [f64; 4] = [0.05, 0.1, 0.2, 0.5];

fn luminance(diagram: &Diagram, column: usize) -> Vec<f64> {
    diagram.seen(Polarisation::Total)[column].iter().map(|xyz| xyz[1]).collect()
}

fn make(_: &Workshop) -> Result<Made, FigureError> {
    let theta = evenly(120.0, 150.0, 601);
    let request = daylight(RADII_MM.iter().map(|mm| mm * 1e-3).collect(), &theta)?;
    let (exact, airy) = (spheres(&request)?, airy_spheres(&request)?);
    let (mut panels, mut numbers) = (Vec::new(), Vec::new());
    for (column, mm) in RADII_MM.into_iter().enumerate() {
        let light = exposure(&exact.seen(Polarisation::Total)[column]);
        let strips = [("Mie", &exact), ("Airy", &airy)]
            .map(|(name, diagram)| strip(name, &diagram.seen(Polarisation::Total)[column], light));
        let [mie, theory] = [&exact, &airy].map(|diagram| luminance(diagram, column));
        let most = mie.iter().copied().fold(0.0, f64::max);
        let curve = |name: &str, colour, y: &[f64]| {
            Curve::new(name, colour, theta.iter().copied().zip(y.iter().copied()))
        };
        panels.push(Panel::Chart(Chart {
            title: format!("{mm} mm, D65, sun's disc"),
            x: Axis::linear("scattering angle (°)", 120.0, 150.0),
            y: Axis::logarithmic("luminance", 1e-3 * most, 2.0 * most),
            curves: vec![
                curve("Lorenz–Mie", BLACK, &mie),
                curve("Airy's theory", RED, &theory).dashed(),
            ],
            strips: strips.to_vec(),
            ..Chart::default()
        }));
        for (name, from, to) in [("primary", 136.0, 146.0), ("secondary", 121.0, 130.0)] {
            let [exact, ours] = [&mie, &theory].map(|y| maximum(&theta, y, from, to));
            numbers.push(Number::alone(
                format!("brightest of the {name} by Lorenz–Mie, {mm} mm"),
                "°",
                exact,
            ));
            let words = format!("brightest of the {name} by Airy's theory less that, {mm} mm");
            numbers.push(Number::alone(words, "°", ours - exact));
        }
    }
    let notes = ["Both are computed here; Airy's theory has orders 2 and 3 alone."];
    let title = "Airy's theory beside Lorenz–Mie";
    Ok(Made::new(sheet(title, 2, (620, 420), panels, &notes), numbers))
}
