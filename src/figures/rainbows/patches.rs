//! Fig. 10: two patches of the wavefront that overlap in one direction.

use crate::figures::figure::Figure;
use crate::figures::papers;
use crate::figures::plain::{BLACK, GREY, ORANGE, RED, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::render::plots::sheet::{Axis, Chart, Curve, Label, Panel};
use crate::shape::Shape;
use crate::trace::Tracer;

pub(super) const FIG_10: Figure = Figure {
    name: "sadeghi-10",
    source: papers::RAINBOWS,
    caption: "Fig. 10: a direction r within two patches k1 and k2, parts of two sheets of the same order",
    compare: "One direction inside the bow lies in two cells of the wavefront, one on each side of the bow's ray; they are \
              folded over each other on the collecting sphere",
    scenes: &[],
    pictures: false,
    make,
};

const INDEX: f64 = 1.333;
const ORDER: u32 = 2;
/// Cells of the emitting plane, radii.
const CELL: f64 = 0.02;
/// The direction r: scattering angle and azimuth, degrees.
const DIRECTION: (f64, f64) = (139.4, 180.4);

/// Scattering angle and azimuth (degrees, 0 to 360) of a ray.
fn direction(tracer: &Tracer<'_>, (u, v): (f64, f64)) -> Option<(f64, f64)> {
    let exit = tracer.trace_order(u, v, ORDER)?;
    let azimuth = exit.direction.y.atan2(exit.direction.x).to_degrees().rem_euclid(360.0);
    Some((exit.scattering_angle().to_degrees(), azimuth))
}

/// Where the launch plane has rays of a direction: on both sides of the bow's ray.
fn launches(tracer: &Tracer<'_>) -> Vec<(f64, f64)> {
    let sphere_angle = |b: f64| direction(tracer, (b, 0.0)).map_or(f64::NAN, |d| d.0);
    let wanted = |b: f64| sphere_angle(b) - DIRECTION.0;
    let steps: Vec<f64> = (0..2000).map(|i| 0.7 + 0.2995 * f64::from(i) / 2000.0).collect();
    let found = steps.windows(2).filter(|pair| wanted(pair[0]) * wanted(pair[1]) < 0.0);
    // Rays of a sphere stay in the plane of their launch.
    let turn = (DIRECTION.1 - 180.0).to_radians();
    let place = |pair: &[f64]| {
        let (mut a, mut b) = (pair[0], pair[1]);
        for _ in 0..50 {
            let middle = 0.5 * (a + b);
            if wanted(a) * wanted(middle) <= 0.0 { b = middle } else { a = middle }
        }
        let side = if direction(tracer, (a, 0.0)).is_some_and(|d| (d.1 - 180.0).abs() < 90.0) {
            1.0
        } else {
            -1.0
        };
        (side * a * turn.cos(), side * a * turn.sin())
    };
    found.map(place).collect()
}

fn make(_: &Workshop) -> Result<Made, FigureError> {
    let sphere = Shape::sphere();
    let tracer = Tracer::new(&sphere, INDEX.into(), 1.0, ORDER);
    let launches = launches(&tracer);
    let corners = |(u, v): (f64, f64)| {
        let (i, j) = ((u / CELL).floor(), (v / CELL).floor());
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)]
            .map(|(a, b)| ((i + a) * CELL, (j + b) * CELL))
    };
    let (mut plane, mut collected) = (Vec::new(), Vec::new());
    let side = launches.first().map_or(1.0, |place| place.0.signum());
    for i in 36..50 {
        for j in -4..4 {
            let cell = corners((side * (f64::from(i) + 0.5) * CELL, (f64::from(j) + 0.5) * CELL));
            let image: Vec<_> =
                cell.iter().filter_map(|&corner| direction(&tracer, corner)).collect();
            if image.len() == cell.len() {
                plane.push(Curve::new("", GREY, cell).thin());
                collected.push(Curve::new("", [210, 210, 210], image).thin());
            }
        }
    }
    let mut numbers = Vec::new();
    for ((name, colour), &launch) in [("k1", RED), ("k2", ORANGE)].into_iter().zip(&launches) {
        let cell = corners(launch);
        let image: Vec<_> = cell.iter().filter_map(|&corner| direction(&tracer, corner)).collect();
        plane.push(Curve::new(&format!("patch {name}"), colour, cell));
        plane.push(Curve::new("", colour, [launch]).dots());
        collected.push(Curve::new(&format!("patch {name}"), colour, image));
        let impact = launch.0.hypot(launch.1);
        numbers.push(Number::alone(format!("impact of the ray of r in {name}"), "radii", impact));
    }
    collected.push(Curve::new("direction r", BLACK, [DIRECTION]).dots());
    let label = Label { at: (DIRECTION.0 + 0.08, DIRECTION.1), text: "r".into(), colour: BLACK };
    let (from, to) = if side > 0.0 { (0.7, 1.0) } else { (-1.0, -0.7) };
    let panels = vec![
        Panel::Chart(Chart {
            title: "the emitting plane, cells of 0.02 radii".into(),
            x: Axis::linear("u (radii)", from, to),
            y: Axis::linear("v (radii)", -0.1, 0.1),
            curves: plane,
            ..Chart::default()
        }),
        Panel::Chart(Chart {
            title: "the same cells on the collecting sphere".into(),
            x: Axis::linear("scattering angle (°)", 137.5, 143.0),
            y: Axis::linear("azimuth (°)", 174.0, 186.0),
            curves: collected,
            labels: vec![label],
            ..Chart::default()
        }),
    ];
    Ok(Made::new(sheet("Two patches in one direction", 2, (620, 460), panels, &[]), numbers))
}
