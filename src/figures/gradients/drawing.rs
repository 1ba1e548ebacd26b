//! Spheres whose index varies along the radius: as bodies, and as drawings of rays and profiles.

use crate::figures::FigureError;
use crate::figures::media::medium;
use crate::figures::plain::{BLUE, GREY, ORANGE, RED, WATER, disc};
use crate::medium::radial::Body;
use crate::render::plots::sheet::{Axis, Chart, Curve};
use crate::trace::RadialRays;

/// A sphere by what a scene says of its profile.
pub(super) fn body(spec: &str) -> Result<Body, FigureError> {
    // no profile of these depends on the wavelength or the radius
    let body = medium(spec)?.body(500e-9, 1e-3)?;
    Ok(body.unwrap_or_else(|| Body::homogeneous(1.0.into())))
}

/// Rays of one chord through a sphere: along the light to the right, across it upwards.
pub(super) fn rays(title: &str, body: &Body, count: usize) -> Chart {
    const REACH: f64 = 2.6;
    let tracer = RadialRays::new(body);
    let (mut before, mut inside, mut behind) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..count {
        let impact = 0.97 * (2.0 * i as f64 / (count - 1) as f64 - 1.0);
        let side = if impact < 0.0 { -1.0 } else { 1.0 };
        let b = f64::abs(impact);
        let path: Vec<(f64, f64)> =
            tracer.path(b, 1).into_iter().map(|[x, z]| (z, side * x)).collect();
        let (Some(&first), Some(&last)) = (path.first(), path.last()) else { continue };
        before.push([(-REACH, first.1), first]);
        if let Some(turned) = tracer.deflection(b, 1).filter(|_| path.len() > 1) {
            let away =
                (last.0 + 2.0 * REACH * turned.cos(), last.1 - 2.0 * REACH * side * turned.sin());
            behind.push([last, away]);
        }
        inside.push(path);
    }
    let mut curves = vec![disc(1.0, WATER)];
    let mut add = |name: &str, colour, lines: Vec<Vec<(f64, f64)>>| {
        for (i, line) in lines.into_iter().enumerate() {
            curves.push(Curve::new(if i == 0 { name } else { "" }, colour, line).thin());
        }
    };
    let pairs = |lines: Vec<[(f64, f64); 2]>| lines.into_iter().map(|line| line.to_vec()).collect();
    add("incident", ORANGE, pairs(before));
    add("inside", GREY, inside);
    add("leaving", RED, pairs(behind));
    Chart {
        title: title.into(),
        x: Axis::linear("along the light (radii)", -1.6, 2.4),
        y: Axis::linear("across it (radii)", -1.6, 1.6),
        equal: true,
        curves,
        ..Chart::default()
    }
}

/// Index along the radius.
pub(super) fn profile(bodies: &[(&str, &Body)]) -> Vec<Curve> {
    let colours = [BLUE, RED, ORANGE, GREY];
    let curve = |((name, body), colour): (&(&str, &Body), [u8; 3])| {
        let points = (1..=100).map(|i| f64::from(i) / 100.0).map(|r| (r, body.index(r).re));
        Curve::new(name, colour, points)
    };
    bodies.iter().zip(colours).map(curve).collect()
}
