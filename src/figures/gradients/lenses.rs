//! Luneburg's lenses and Gaussian spheres: Figs. 28 to 30, and 55.

use super::drawing::{body, profile, rays};
use crate::figures::figure::Figure;
use crate::figures::papers;
use crate::figures::plain::sheet;
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::optics::fresnel;
use crate::render::plots::sheet::{Axis, Chart, Panel};
use crate::trace::{Chord, RadialRays};
use std::f64::consts::PI;

pub(super) const LUNEBURG: Figure = Figure {
    name: "elhoni-28",
    source: papers::VARYING_DIELECTRICS,
    caption: "Figs. 28, 29 (a) and 30 (a): rays through generalised Luneburg lenses of index √(C − r²), C = 2, 3 and 10",
    compare: "C = 2: all rays leave at one point; C = 3 and 10: they are refracted at the surface too and cross before it; \
              reflection of 2.9 % and 25 % at the surface",
    scenes: &[],
    pictures: false,
    make: luneburg,
};

pub(super) const GAUSSIAN: Figure = Figure {
    name: "elhoni-55",
    source: papers::VARYING_DIELECTRICS,
    caption: "Fig. 55: rays through Gaussian spheres of index a exp(−r² ln a), a = 1.25 and 1.5, and their profiles",
    compare: "The index is 1 at the surface, so that nothing is reflected there; the small change of a makes a big difference \
              in where the rays meet",
    scenes: &[],
    pictures: false,
    make: gaussian,
};

/// Reflected share of light that meets a surface straight on.
fn reflected(index: f64) -> f64 {
    fresnel(1.0, index.into()).r_perpendicular.norm_sqr()
}

/// The paper's index at the surface, at the centre, and reflected share, by C.
const PRINTED: [(f64, f64, Option<f64>, Option<f64>); 3] = [
    (2.0, 1.0, None, None),
    (3.0, std::f64::consts::SQRT_2, None, Some(0.029)),
    (10.0, 3.0, Some(3.16), Some(0.25)),
];

fn luneburg(_: &Workshop) -> Result<Made, FigureError> {
    let (mut panels, mut numbers, mut bodies) = (Vec::new(), Vec::new(), Vec::new());
    for (c, surface, centre, share) in PRINTED {
        let lens = body(&format!("{{ profile = \"luneburg\", c = {c:?} }}"))?;
        let index = lens.surface().re;
        numbers.push(Number::beside(format!("index at the surface, C = {c}"), "", surface, index));
        if let Some(paper) = centre {
            numbers.push(Number::beside(
                format!("index at the centre, C = {c}"),
                "",
                paper,
                lens.index(1e-9).re,
            ));
        }
        if let Some(paper) = share {
            numbers.push(Number::beside(
                format!("reflected share, C = {c}"),
                "",
                paper,
                reflected(index),
            ));
        }
        if c == 2.0 {
            // All leave at the far side's point: the largest miss of rays, radii.
            let tracer = RadialRays::new(&lens);
            let miss =
                (1..100).map(|i| f64::from(i) / 100.0).filter_map(|b| match tracer.chord(b) {
                    Chord::Through { swept, .. } => Some((swept + b.asin() - PI).abs()),
                    _ => None,
                });
            numbers.push(Number::beside(
                "spread of the rays' exits, C = 2",
                "radii",
                0.0,
                miss.fold(0.0, f64::max),
            ));
        }
        panels.push(Panel::Chart(rays(&format!("C = {c}"), &lens, 21)));
        bodies.push((format!("C = {c}"), lens));
    }
    let named: Vec<_> = bodies.iter().map(|(name, body)| (&**name, body)).collect();
    panels.push(index_panel(&named, 3.4));
    Ok(Made::new(sheet("Luneburg's lenses", 2, (560, 500), panels, &[]), numbers))
}

fn index_panel(bodies: &[(&str, &crate::medium::radial::Body)], highest: f64) -> Panel {
    Panel::Chart(Chart {
        title: "index along the radius".into(),
        x: Axis::linear("radius (of the sphere's)", 0.0, 1.0),
        y: Axis::linear("n", 0.9, highest),
        curves: profile(bodies),
        ..Chart::default()
    })
}

fn gaussian(_: &Workshop) -> Result<Made, FigureError> {
    let (mut panels, mut numbers, mut bodies) = (Vec::new(), Vec::new(), Vec::new());
    for a in [1.25, 1.5] {
        let sphere = body(&format!("{{ profile = \"gaussian\", a = {a} }}"))?;
        numbers.push(Number::beside(
            format!("index at the centre, a = {a}"),
            "",
            a,
            sphere.index(1e-9).re,
        ));
        numbers.push(Number::beside(
            format!("index at the surface, a = {a}"),
            "",
            1.0,
            sphere.surface().re,
        ));
        let turned = RadialRays::new(&sphere).deflection(0.05, 1).unwrap_or(f64::NAN);
        // A ray at a small impact b, turned by δ, meets the axis b/δ beyond the centre.
        numbers.push(Number::alone(
            format!("inner rays meet beyond the centre, a = {a}"),
            "radii",
            0.05 / turned.abs(),
        ));
        panels.push(Panel::Chart(rays(&format!("a = {a}"), &sphere, 21)));
        bodies.push((format!("a = {a}"), sphere));
    }
    let named: Vec<_> = bodies.iter().map(|(name, body)| (&**name, body)).collect();
    panels.push(index_panel(&named, 1.55));
    Ok(Made::new(sheet("Gaussian spheres", 3, (520, 480), panels, &[]), numbers))
}
