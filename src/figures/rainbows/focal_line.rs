//! Fig. 4: rays in a drop, the wavefront on its way, and the line of its focal points.

use crate::figures::figure::Figure;
use crate::figures::papers;
use crate::figures::plain::{GREEN, GREY, RED, WATER, disc, evenly, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::render::plots::sheet::{Axis, Chart, Curve, Panel};

pub(super) const FIG_4: Figure = Figure {
    name: "sadeghi-4",
    source: papers::RAINBOWS,
    caption: "Fig. 4: rays of the primary bow in the upper half of a drop, the wavefront at even times, and the focal line",
    compare: "The wavefront shrinks towards the focal line, folds where it meets it, and has passed it afterwards; the \
              line begins on the drop's surface and leaves the drop",
    scenes: &[],
    pictures: false,
    make,
};

const INDEX: f64 = 1.333;
/// Far from the drop, radii.
const FAR: f64 = 2.4;
/// Least and greatest impact of the rays.
const IMPACTS: (f64, f64) = (0.02, 0.99);

type Plane = [f64; 2];

fn along(from: Plane, direction: Plane, length: f64) -> Plane {
    [from[0] + length * direction[0], from[1] + length * direction[1]]
}

fn dot(a: Plane, b: Plane) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: Plane, b: Plane) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// A straight stretch of a ray: from where, whither, how far, through which index.
#[derive(Clone, Copy)]
struct Stretch {
    from: Plane,
    direction: Plane,
    length: f64,
    index: f64,
}

/// The ray of an impact through the drop, with one inner reflection: `[along the light, across it]`.
fn ray(impact: f64) -> [Stretch; 4] {
    let cos = (1.0 - impact * impact).sqrt();
    let first = [-cos, impact];
    let incoming =
        Stretch { from: [-FAR, impact], direction: [1.0, 0.0], length: FAR - cos, index: 1.0 };
    // Snell's law about the outward normal, which is the place itself on a sphere of radius 1.
    let refracted = |direction: Plane, normal: Plane, ratio: f64| -> Plane {
        let c = -dot(direction, normal);
        let s = (1.0 - ratio * ratio * (1.0 - c * c)).max(0.0).sqrt();
        along([ratio * direction[0], ratio * direction[1]], normal, ratio * c - s)
    };
    let inside = refracted(incoming.direction, first, 1.0 / INDEX);
    let chord = -2.0 * dot(inside, first);
    let second = along(first, inside, chord);
    let back = along(inside, second, -2.0 * dot(inside, second));
    let third = along(second, back, chord);
    let out = refracted(back, [-third[0], -third[1]], INDEX);
    [
        incoming,
        Stretch { from: first, direction: inside, length: chord, index: INDEX },
        Stretch { from: second, direction: back, length: chord, index: INDEX },
        Stretch { from: third, direction: out, length: 2.0 * FAR, index: 1.0 },
    ]
}

/// Distance along a stretch at which neighbouring rays cross.
fn focus(impact: f64, stretch: usize) -> f64 {
    const STEP: f64 = 1e-5;
    let (a, b) = (ray(impact - STEP)[stretch], ray(impact + STEP)[stretch]);
    let here = ray(impact)[stretch];
    let apart = [b.from[0] - a.from[0], b.from[1] - a.from[1]];
    let turned = [b.direction[0] - a.direction[0], b.direction[1] - a.direction[1]];
    -cross(apart, here.direction) / cross(turned, here.direction)
}

/// Where a ray is after an optical path.
fn place(impact: f64, mut path: f64) -> Plane {
    let stretches = ray(impact);
    for stretch in &stretches[..3] {
        let optical = stretch.index * stretch.length;
        if path <= optical {
            return along(stretch.from, stretch.direction, path / stretch.index);
        }
        path -= optical;
    }
    along(stretches[3].from, stretches[3].direction, path)
}

fn make(_: &Workshop) -> Result<Made, FigureError> {
    let point = |[x, y]: Plane| (x, y);
    let mut curves = vec![disc(1.0, WATER)];
    for impact in evenly(0.05, 0.98, 16) {
        let path = ray(impact);
        let mut points: Vec<_> = path.iter().map(|stretch| point(stretch.from)).collect();
        let last = path[3];
        points.push(point(along(last.from, last.direction, last.length)));
        curves.push(Curve::new(if impact < 0.06 { "rays" } else { "" }, GREY, points).thin());
    }
    let impacts = evenly(IMPACTS.0, IMPACTS.1, 300);
    for (i, path) in evenly(1.0, 7.6, 23).into_iter().enumerate() {
        let front = impacts.iter().map(|&impact| point(place(impact, path)));
        curves.push(Curve::new(if i == 0 { "wavefront at even times" } else { "" }, GREEN, front));
    }
    let mut named = false;
    for stretch in 1..4 {
        let line = impacts.iter().map(|&impact| {
            let (here, length) = (ray(impact)[stretch], focus(impact, stretch));
            let inside = (0.0..=here.length).contains(&length);
            if inside {
                point(along(here.from, here.direction, length))
            } else {
                (f64::NAN, f64::NAN)
            }
        });
        let line: Vec<_> = line.collect();
        if line.iter().any(|p| p.0.is_finite()) {
            curves.push(Curve {
                width: 3,
                ..Curve::new(if named { "" } else { "focal line" }, RED, line)
            });
            named = true;
        }
    }
    let chart = Chart {
        title: "upper half of a drop of water, n = 1.333".into(),
        x: Axis::linear("along the light (radii)", -2.2, 1.5),
        y: Axis::linear("across it (radii)", -2.1, 1.2),
        equal: true,
        curves,
        ..Chart::default()
    };
    // A paraxial beam meets behind a sphere at n/(2(n-1)) from its centre; inside, at n/(n-1) from the vertex.
    let paraxial = focus(1e-3, 1);
    let numbers = vec![
        Number::alone("focus of the first refraction from where light enters", "radii", paraxial),
        Number::alone("the same by paraxial optics, n/(n − 1)", "radii", INDEX / (INDEX - 1.0)),
    ];
    let notes = ["The paper gives no number."];
    let sheet = sheet("Wavefront and focal line", 1, (860, 800), vec![Panel::Chart(chart)], &notes);
    Ok(Made::new(sheet, numbers))
}
