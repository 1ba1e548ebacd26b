//! Fig. 3: the rays of both bows, and what interference and diffraction make of them.

use crate::figures::figure::Figure;
use crate::figures::papers;
use crate::figures::plain::{BLACK, BLUE, GREY, PURPLE, RED, WATER, disc, evenly, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::optics::rainbow_angle;
use crate::render::plots::sheet::{Axis, Chart, Curve, Label, Mark, Panel};
use crate::series::airy::AiryBow;
use crate::shape::Shape;
use crate::trace::{PlaneRay, SymmetryPlane, Tracer};
use std::f64::consts::TAU;

pub(super) const FIG_3: Figure = Figure {
    name: "sadeghi-3",
    source: papers::RAINBOWS,
    caption: "Fig. 3: rays of the primary and the secondary bow in red and violet light; two rays that leave alike; the \
              bow by rays and by Airy's theory",
    compare: "The bows at 137.7 and 139.6°, 129.5 and 126.1°; the order of colours reversed in the secondary; the \
              brightest light about a degree within the bow of rays, at 138.9°, and light beyond it",
    scenes: &[],
    pictures: false,
    make,
};

/// The paper's light: name, index, colour.
const LIGHT: [(&str, f64, [u8; 3]); 2] =
    [("red, 700 nm", 1.3314, RED), ("violet, 400 nm", 1.3445, PURPLE)];
/// The paper's bows by order and light, degrees.
const BOWS: [(u32, &str, [f64; 2]); 2] =
    [(2, "primary", [137.7, 139.6]), (3, "secondary", [129.5, 126.1])];
/// The paper's bow of rays and the brightest light about it, whose index and drop it does not tell; ours: water at
/// 589 nm, and a drop of 0.1 mm.
const BRIGHTEST: [f64; 2] = [137.86, 138.9];
const INDEX: f64 = 1.3334;
const RADIUS: f64 = 0.1e-3;
const WAVELENGTH: f64 = 589.3e-9;

fn make(_: &Workshop) -> Result<Made, FigureError> {
    let mut numbers = Vec::new();
    let mut panels = Vec::new();
    for (letter, (order, name, paper)) in ["(a)", "(b)"].iter().zip(BOWS) {
        panels.push(Panel::Chart(rays(letter, order, name)));
        for ((light, index, _), paper) in LIGHT.iter().zip(paper) {
            let ours = rainbow_angle(*index, order).unwrap_or(f64::NAN).to_degrees();
            numbers.push(Number::beside(format!("{name} bow, {light}"), "°", paper, ours));
        }
    }
    let airy = AiryBow::new(TAU * RADIUS / WAVELENGTH, INDEX.into(), 2);
    if let Some(airy) = &airy {
        let [rays, brightest] = BRIGHTEST;
        let ours = [airy.angle(), airy.maximum()].map(f64::to_degrees);
        numbers.push(Number::beside("bow of rays, water at 589 nm", "°", rays, ours[0]));
        let name = "brightest light by Airy's theory, drop of 0.1 mm";
        numbers.push(Number::beside(name, "°", brightest, ours[1]));
        panels.push(Panel::Chart(two_rays()));
        panels.push(Panel::Chart(intensity(airy)));
    }
    let notes =
        ["The paper does not tell the drop of the last number; ours is of 0.1 mm at 589 nm."];
    let title = "Rainbows by rays and by waves";
    Ok(Made::new(sheet(title, 2, (560, 470), panels, &notes), numbers))
}

/// A ray from far off to far off: along the light and to the upper side.
pub(super) fn drawn(ray: &PlaneRay, reach: f64) -> Vec<(f64, f64)> {
    let mut points = Vec::new();
    if let (Some(first), Some(last)) = (ray.points.first(), ray.points.last()) {
        points.push((-reach, first[0]));
        points.extend(ray.points.iter().map(|[x, z]| (*z, *x)));
        let direction = ray.exit.direction;
        points.push((last[1] + 2.0 * reach * direction.z, last[0] + 2.0 * reach * direction.x));
    }
    points
}

/// The bow's rays in both colours, among others of the order.
fn rays(letter: &str, order: u32, name: &str) -> Chart {
    let sphere = Shape::sphere();
    let mut curves = vec![disc(1.0, WATER)];
    let mut labels = Vec::new();
    for (i, (light, index, colour)) in LIGHT.into_iter().enumerate() {
        let tracer = Tracer::new(&sphere, index.into(), 1.0, order);
        let plane = SymmetryPlane::new(&sphere, &tracer, order);
        if i == 0 {
            for impact in evenly(0.1, 0.995, 12) {
                let ray = plane.ray(impact).map(|ray| drawn(&ray, 2.2)).unwrap_or_default();
                curves.push(Curve::new("", [205, 205, 205], ray).thin());
            }
        }
        for bow in plane.rainbows().iter().filter(|bow| bow.impact > 0.0) {
            let ray = plane.ray(bow.impact).map(|ray| drawn(&ray, 2.2)).unwrap_or_default();
            let named = format!("{light}: {:.1}°", bow.deviation.to_degrees());
            curves.push(Curve::new(&named, colour, ray));
        }
    }
    labels.push(Label { at: (-2.1, 1.35), text: "light".into(), colour: [95, 95, 95] });
    Chart {
        title: format!(
            "{letter} {name} bow: {} inner reflection{}",
            order - 1,
            if order > 2 { "s" } else { "" }
        ),
        x: Axis::linear("along the light (radii)", -2.2, 1.6),
        y: Axis::linear("across it (radii)", -2.0, 1.5),
        equal: true,
        curves,
        labels,
        ..Chart::default()
    }
}

/// Scattering angle by impact: two rays leave alike.
fn two_rays() -> Chart {
    let sphere = Shape::sphere();
    let tracer = Tracer::new(&sphere, INDEX.into(), 1.0, 2);
    let angle = |b: f64| {
        tracer.trace_order(b, 0.0, 2).map_or(f64::NAN, |exit| exit.scattering_angle().to_degrees())
    };
    let curve = evenly(0.6, 0.999, 300).into_iter().map(|b| (b, angle(b)));
    let seen = 142.0;
    let level = Curve::new("one direction, 142°", RED, [(0.6, seen), (1.0, seen)]).thin().dashed();
    Chart {
        title: "(c) two rays leave in one direction, and interfere".into(),
        x: Axis::linear("impact (radii)", 0.6, 1.0),
        y: Axis::linear("scattering angle (°)", 136.0, 160.0),
        curves: vec![level, Curve::new("rays of the primary bow", BLUE, curve)],
        ..Chart::default()
    }
}

/// Intensity by rays alone, by rays that interfere, and by Airy's theory; with the same scale.
fn intensity(bow: &AiryBow) -> Chart {
    let theta = evenly(136.0, 145.0, 1200);
    let argument = |degrees: f64| bow.argument(degrees.to_radians());
    let airy: Vec<f64> =
        theta.iter().map(|t| bow.amplitudes(t.to_radians()).0.norm_sqr()).collect();
    let most = airy.iter().copied().fold(0.0, f64::max);
    // Ai² at its maximum is 0.2869; two rays are 1/(2π√z) each, and interfere as sin² of half their phase.
    let scale = 0.286_9;
    let powers = |t: f64| {
        let z = argument(t);
        if z > 0.0 { 1.0 / (TAU * z.sqrt()) / scale } else { f64::NAN }
    };
    let beating = |t: f64| {
        let z = argument(t);
        let phase = 2.0 / 3.0 * z.powf(1.5) + TAU / 8.0;
        if z > 0.0 { 2.0 * phase.sin().powi(2) / (TAU * z.sqrt()) / scale } else { f64::NAN }
    };
    let of = |f: &dyn Fn(f64) -> f64| theta.iter().map(|&t| (t, f(t))).collect::<Vec<_>>();
    let airy: Vec<_> = theta.iter().zip(airy).map(|(&t, v)| (t, v / most)).collect();
    let mark = |angle: f64, name: &str| Mark { x: angle.to_degrees(), name: name.into() };
    Chart {
        title: "(d) the edge of the bow, drop of 0.1 mm, 589 nm".into(),
        x: Axis::linear("scattering angle (°)", 136.0, 145.0),
        y: Axis::linear("intensity (brightest by Airy's theory: 1)", 0.0, 2.0),
        curves: vec![
            Curve::new("rays", GREY, of(&powers)).dashed(),
            Curve::new("rays that interfere", BLUE, of(&beating)).thin(),
            Curve::new("Airy's theory", BLACK, airy),
        ],
        marks: vec![mark(bow.angle(), "bow of rays"), mark(bow.maximum(), "brightest")],
        ..Chart::default()
    }
}
