//! How spheres of these profiles scatter, by the exact series; and Fig. 31's likeness of C = 10 and a plain sphere.

use super::drawing::body;
use crate::figures::figure::Figure;
use crate::figures::papers;
use crate::figures::plain::{BLACK, BLUE, GREEN, ORANGE, PURPLE, RED, evenly, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::medium::radial::Body;
use crate::render::plots::sheet::{Axis, Chart, Curve, Panel};
use crate::series::layered::Layered;
use std::f64::consts::PI;

pub(super) const PHASE_FUNCTIONS: Figure = Figure {
    name: "elhoni-31",
    source: papers::VARYING_DIELECTRICS,
    caption: "Fig. 31's question put to waves: phase functions of spheres of x = 60 with Luneburg's and Gaussian profiles, and \
              of plain spheres",
    compare: "C = 10 is like a plain sphere of index 3, C = 2 sends nearly all forwards and nothing special back; Gaussian \
              spheres have no reflection at the surface. Inverse spheres, of infinite index, have no series",
    scenes: &[],
    pictures: false,
    make,
};

const SIZE: f64 = 60.0;
/// Relative error asked of the series.
const ERROR: f64 = 1e-6;

/// The phase function at angles in degrees, smoothed over 2° so that profiles can be told apart; and the asymmetry.
fn phase_function(body: &Body, degrees: &[f64]) -> Result<(Vec<f64>, f64), FigureError> {
    let sphere = Layered::body(SIZE, body, ERROR)?;
    const WITHIN: i32 = 6;
    let theta: Vec<f64> = degrees
        .iter()
        .flat_map(|t| {
            (-WITHIN..=WITHIN)
                .map(move |i| (t + f64::from(i) / f64::from(WITHIN)).clamp(0.0, 180.0))
        })
        .map(f64::to_radians)
        .collect();
    let scale = 1.0 / (PI * SIZE * SIZE * sphere.efficiencies().q_sca);
    let amplitudes = sphere.amplitudes_parallel(&theta);
    let values: Vec<f64> =
        amplitudes.iter().map(|(s1, s2)| 0.5 * scale * (s1.norm_sqr() + s2.norm_sqr())).collect();
    let means = values
        .chunks(2 * WITHIN as usize + 1)
        .map(|all| all.iter().sum::<f64>() / all.len() as f64);
    Ok((means.collect(), sphere.efficiencies().asymmetry))
}

fn make(_: &Workshop) -> Result<Made, FigureError> {
    let degrees = evenly(0.0, 180.0, 361);
    let luneburg = |c: &str| body(&format!("{{ profile = \"luneburg\", c = {c} }}"));
    let mut numbers = Vec::new();
    let mut chart =
        |title: &str, spheres: Vec<(&str, [u8; 3], Body, bool)>| -> Result<Panel, FigureError> {
            let mut curves = Vec::new();
            for (name, colour, body, dashed) in spheres {
                let (values, asymmetry) = phase_function(&body, &degrees)?;
                let curve = Curve::new(name, colour, degrees.iter().copied().zip(values));
                curves.push(if dashed { curve.dashed() } else { curve });
                numbers.push(Number::alone(format!("asymmetry, {name}"), "", asymmetry));
            }
            Ok(Panel::Chart(Chart {
                title: title.into(),
                x: Axis::linear("scattering angle (°)", 0.0, 180.0),
                y: Axis::logarithmic("phase function (sr⁻¹)", 1e-6, 1e3),
                curves,
                ..Chart::default()
            }))
        };
    let plain = |n: f64| Body::homogeneous(n.into());
    let panels = vec![
        chart(
            "Luneburg's lenses, x = 60",
            vec![
                ("C = 2", BLUE, luneburg("2.0")?, false),
                ("C = 3", GREEN, luneburg("3.0")?, false),
                ("C = 10", RED, luneburg("10.0")?, false),
                ("plain, n = 3", BLACK, plain(3.0), true),
            ],
        )?,
        chart(
            "Gaussian spheres, x = 60",
            vec![
                ("a = 1.25", ORANGE, body("{ profile = \"gaussian\", a = 1.25 }")?, false),
                ("a = 1.5", PURPLE, body("{ profile = \"gaussian\", a = 1.5 }")?, false),
                ("plain, n = 1.25", BLACK, plain(1.25), true),
            ],
        )?,
    ];
    let notes =
        ["Means over 2°. The exact series of radial profiles; the paper draws pictures by rays."];
    Ok(Made::new(sheet("Spheres of varying index", 2, (640, 460), panels, &notes), numbers))
}
