//! The drawing of rays through a drop, as SVG: upper side up, light from the left.

use crate::shape::Shape;
use crate::trace::Rainbow;
use maud::{Markup, PreEscaped, html};
use std::f64::consts::TAU;

/// Half width of the picture in drop radii, and pixels per radius.
const REACH: f64 = 2.4;
const SCALE: f64 = 150.0;
/// Height of a line of the caption, pixels, and bows named in one.
const LINE: f64 = 22.0;
const BOWS_IN_LINE: usize = 2;
/// Most rays drawn.
const MOST_DRAWN: usize = 60;

/// One ray as it is drawn, in the frame of the light: upper side x, along z.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnRay {
    /// From where it meets the surface first, to where it leaves it or ends.
    pub points: Vec<[f64; 2]>,
    /// Its direction where it leaves, if it does.
    pub leaves: Option<[f64; 2]>,
}

/// The whole SVG: rays of one order in the vertical plane of a shape, and its rainbows.
pub fn draw_ray_paths(
    shape: &Shape,
    order: u32,
    rays: &[DrawnRay],
    rainbows: &[Rainbow],
) -> String {
    let side = 2.0 * REACH * SCALE;
    let step = rays.len().div_ceil(MOST_DRAWN).max(1);
    let bows: Vec<String> = rainbows
        .iter()
        .map(|b| format!("{:.2}° (impact {:+.3} a)", b.deviation.to_degrees(), b.impact))
        .collect();
    // Three bows would run out of the picture in one line.
    let mut caption: Vec<String> = bows.chunks(BOWS_IN_LINE).map(|line| line.join(", ")).collect();
    match caption.first_mut() {
        Some(first) => first.insert_str(0, "stationary deviation: "),
        None => caption.push("no stationary deviation".into()),
    }
    let height = side + LINE * (caption.len() + 1) as f64 + 16.0;
    let view = format!("0 0 {side} {height}");
    let body = html! {
        svg xmlns="http://www.w3.org/2000/svg" viewBox=(view) width=(side) height=(height)
            font-family="sans-serif" font-size="14" {
            rect width="100%" height="100%" fill="white" {}
            path d=(outline(shape)) fill="#e3f1fb" stroke="#20507a" stroke-width="1.5" {}
            @for ray in rays.iter().step_by(step) { (path(ray)) }
            (axes(shape))
            @for (i, line) in caption.iter().enumerate() {
                text x="12" y=(side + LINE * (i + 1) as f64) {
                    @if i == 0 { "order p = " (order) ": " }
                    (line)
                }
            }
            text x="12" y=(height - 16.0) fill="#555" {
                "a: radius of equal volume. Rays: yellow incident, grey inside, red leaving; upper side up."
            }
        }
    };
    body.into_string()
}

/// Pixel of a point of the plane: z to the right, x up.
fn pixel(x: f64, z: f64) -> (f64, f64) {
    ((z + REACH) * SCALE, (REACH - x) * SCALE)
}

fn outline(shape: &Shape) -> String {
    let mut d = String::new();
    for i in 0..=360 {
        let angle = i as f64 * TAU / 360.0;
        let (sin, cos) = angle.sin_cos();
        let radius = shape.radius_towards(sin, 0.0, cos);
        let (px, py) = pixel(radius * sin, radius * cos);
        d.push_str(&format!("{}{px:.2} {py:.2} ", if i == 0 { "M" } else { "L" }));
    }
    d + "Z"
}

/// Incoming, inner and outgoing stretches of one ray.
fn path(ray: &DrawnRay) -> Markup {
    let Some((&first, &last)) = ray.points.first().zip(ray.points.last()) else {
        return html! {};
    };
    let line = |from: [f64; 2], to: [f64; 2], colour: &str, width: f64| {
        let ((x1, y1), (x2, y2)) = (pixel(from[0], from[1]), pixel(to[0], to[1]));
        html! { line x1=(format!("{x1:.2}")) y1=(format!("{y1:.2}")) x2=(format!("{x2:.2}"))
        y2=(format!("{y2:.2}")) stroke=(colour) stroke-width=(width) {} }
    };
    let inside: Vec<String> = ray
        .points
        .iter()
        .map(|point| {
            let (x, y) = pixel(point[0], point[1]);
            format!("{x:.2},{y:.2}")
        })
        .collect();
    html! {
        (line([first[0], -REACH], first, "#c9a400", 0.8))
        polyline points=(inside.join(" ")) fill="none" stroke="#777777" stroke-width="0.6" {}
        @if let Some([x, z]) = ray.leaves {
            (line(last, [last[0] + 2.0 * REACH * x, last[1] + 2.0 * REACH * z], "#c0392b", 0.8))
        }
    }
}

/// Ticks along both edges, the vertical of the drop.
fn axes(shape: &Shape) -> Markup {
    let ticks = [-2.0, -1.0, 0.0, 1.0, 2.0];
    let down = shape.down;
    let (top, bottom) = (pixel(-1.4 * down.x, -1.4 * down.z), pixel(1.4 * down.x, 1.4 * down.z));
    html! {
        @for t in ticks {
            @let (x, _) = pixel(0.0, t);
            @let (_, y) = pixel(t, 0.0);
            line x1=(x) y1=(2.0 * REACH * SCALE) x2=(x) y2=(2.0 * REACH * SCALE - 6.0) stroke="#333" {}
            text x=(x) y=(2.0 * REACH * SCALE - 9.0) text-anchor="middle" fill="#333" { (t) (PreEscaped("&#160;")) "a" }
            line x1="0" y1=(y) x2="6" y2=(y) stroke="#333" {}
            text x="9" y=(y + 5.0) fill="#333" { (t) (PreEscaped("&#160;")) "a" }
        }
        line x1=(top.0) y1=(top.1) x2=(bottom.0) y2=(bottom.1) stroke="#20507a"
            stroke-dasharray="6 4" stroke-width="1" {}
        text x=(top.0 + 6.0) y=(top.1 + 4.0) fill="#20507a" { "vertical" }
    }
}
