//! Inverse spheres, of index k/r: Figs. 38 to 40, and 42.

use super::drawing::{body, rays};
use crate::figures::figure::Figure;
use crate::figures::papers;
use crate::figures::plain::{BLUE, GREEN, GREY, PURPLE, RED, SKY, WATER, disc, evenly, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::render::plots::sheet::{Axis, Chart, Curve, Panel};
use crate::trace::{Chord, RadialRays};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

pub(super) const SPIRALS: Figure = Figure {
    name: "elhoni-42",
    source: papers::VARYING_DIELECTRICS,
    caption: "Figs. 38, 40 and 42: spirals that leave a point of an inverse sphere, tightly wound ones, and parallel rays that \
              enter such a sphere",
    compare: "Outward rays are logarithmic spirals that reach the surface, inward ones end at the centre, along the circle \
              neither; of the rays from outside none comes out again",
    scenes: &[],
    pictures: false,
    make: spirals,
};

pub(super) const TURNS: Figure = Figure {
    name: "elhoni-39",
    source: papers::VARYING_DIELECTRICS,
    caption: "Fig. 39: angle at which a spiral meets the surface, α + cot α, by its direction at the start",
    compare: "Without limit towards α = 0 and 180°, where spirals wind without end; the right half repeats the left, but its \
              rays go inwards",
    scenes: &[],
    pictures: false,
    make: turns,
};

/// The point that the spirals of Fig. 38 leave, in radii of the sphere.
const START: f64 = 0.5;

/// A spiral from the start in a direction `alpha` from the tangent, outwards: `r = START exp(φ tan α)`.
fn spiral(alpha: f64) -> Vec<(f64, f64)> {
    let slope = alpha.tan();
    // φ runs the way the tangential part of the direction points.
    let way = alpha.cos().signum();
    let (end, limit) = if alpha.sin() > 0.0 { (1.0, 1.0 / START) } else { (0.02, 0.02 / START) };
    let turns = (f64::ln(limit) / (slope * way)).abs();
    if !turns.is_finite() || alpha.cos().abs() < 1e-9 {
        return vec![(START, 0.0), (end, 0.0)];
    }
    let count = (200.0 * (1.0 + turns / TAU)) as usize;
    let place = |angle: f64| {
        let (radius, angle) = (START * (angle * way * slope).exp(), way * angle);
        (radius * angle.cos(), radius * angle.sin())
    };
    evenly(0.0, turns, count).into_iter().map(place).collect()
}

fn square(title: &str, curves: Vec<Curve>) -> Panel {
    Panel::Chart(Chart {
        title: title.into(),
        x: Axis::linear("radii", -1.1, 1.1),
        y: Axis::linear("radii", -1.1, 1.1),
        equal: true,
        curves,
        ..Chart::default()
    })
}

fn spirals(_: &Workshop) -> Result<Made, FigureError> {
    let degrees = |d: f64| d.to_radians();
    let start = || Curve::new("start", BLUE, [(START, 0.0)]).dots();
    let mut several = vec![disc(1.0, WATER)];
    for (name, angles, colour) in [
        ("outwards", &[15.0, 40.0, 65.0, 140.0][..], RED),
        ("inwards", &[200.0, 320.0][..], PURPLE),
        ("straight", &[90.0, 270.0][..], GREY),
    ] {
        for (i, &angle) in angles.iter().enumerate() {
            several.push(Curve::new(
                if i == 0 { name } else { "" },
                colour,
                spiral(degrees(angle)),
            ));
        }
    }
    let circle = (0..=120)
        .map(|i| (TAU * f64::from(i) / 120.0).sin_cos())
        .map(|(s, c)| (START * c, START * s));
    several.push(Curve::new("circle", GREEN, circle));
    several.push(start());
    let mut panels = vec![square("Fig. 38: rays from a point", several)];
    for (letter, alpha) in [("a", 0.1), ("b", 0.01)] {
        let line = Curve::new(&format!("α = {alpha}"), SKY, spiral(alpha)).thin();
        panels.push(square(
            &format!("Fig. 40 ({letter}): tightly wound"),
            vec![disc(1.0, WATER), line, start()],
        ));
    }
    let sphere = body("{ profile = \"inverse\", k = 1.0 }")?;
    let caught = (1..100).map(|i| f64::from(i) / 100.0);
    let tracer = RadialRays::new(&sphere);
    let share = caught.clone().filter(|&b| tracer.chord(b) == Chord::Centre).count() as f64 / 99.0;
    let winds = |alpha: f64| (1.0 / START).ln() / alpha.tan() / TAU;
    let numbers = vec![
        Number::beside("share of the rays from outside that end at the centre", "", 1.0, share),
        Number::alone("turns of the spiral of α = 0.1", "", winds(0.1)),
        Number::alone("turns of the spiral of α = 0.01", "", winds(0.01)),
    ];
    panels.push(Panel::Chart(rays("Fig. 42: from outside, index 1 at the surface", &sphere, 21)));
    Ok(Made::new(sheet("Inverse spheres", 2, (520, 540), panels, &[]), numbers))
}

fn turns(_: &Workshop) -> Result<Made, FigureError> {
    let angle = |alpha: f64| alpha + 1.0 / alpha.tan();
    let half = |from: f64, to: f64| {
        let alphas = evenly(from + 0.01, to - 0.01, 400);
        alphas.into_iter().map(move |alpha| (alpha.to_degrees(), angle(alpha)))
    };
    let chart = Chart {
        title: "the paper's α + cot α (its logarithm of radii set to 1)".into(),
        x: Axis::linear("direction α at the start (°)", 0.0, 360.0),
        y: Axis::linear("angle at the surface (radians)", -10.0, 15.0),
        curves: vec![
            Curve::new("outwards", RED, half(0.0, PI)),
            Curve::new("inwards", PURPLE, half(PI, TAU)),
        ],
        ..Chart::default()
    };
    let numbers = vec![Number::beside(
        "angle of the straight ray outwards, α = 90°",
        "radians",
        FRAC_PI_2,
        angle(FRAC_PI_2),
    )];
    Ok(Made::new(
        sheet("Where spirals meet the surface", 1, (760, 460), vec![Panel::Chart(chart)], &[]),
        numbers,
    ))
}
