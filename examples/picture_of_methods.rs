//! The picture of `docs/theory.md`: what each part of an order's light is computed by, as the program does it
//! for a sphere of water.
//!
//! `cargo run --release --example picture_of_methods -- docs/methods.svg` draws it anew; without a name the
//! picture in `docs/` must be the one that would be drawn.

use gonio::farfield::assignment::{Assignment, Method, Thresholds};
use gonio::farfield::{FarField, FarFieldSettings, ForwardDiffraction, Kind, Piece, PlaneSet};
use gonio::shape::Shape;
use gonio::trace::Tracer;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::fs;

const INDEX: f64 = 1.333;
const SIZE_PARAMETER: f64 = 2000.0;
const ORDERS: [u32; 8] = [0, 1, 2, 3, 4, 5, 6, 7];
/// Pixels per degree; height of a bar; left and upper margin; height of the legend.
const DEGREE: f64 = 4.0;
const BAR: usize = 7;
const LEFT: f64 = 60.0;
const TOP: usize = 24;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let picture = picture();
    match std::env::args().nth(1) {
        Some(path) => fs::write(path, picture)?,
        None => {
            let stored = fs::read_to_string("docs/methods.svg")?;
            assert!(
                stored == picture,
                "docs/methods.svg is not what the program does: draw it anew"
            );
            println!("docs/methods.svg is what the program does");
        }
    }
    Ok(())
}

/// Colour and words of what a piece is computed by.
fn look(piece: &Piece) -> (&'static str, &'static str) {
    match piece.kind {
        Some(Kind::Plain { .. }) => ("#5b8def", "single rays"),
        Some(Kind::Pair { .. }) => ("#e8833a", "pair of rays at a bow (Airy)"),
        Some(Kind::Wave) if piece.order == 0 => ("#888888", "edge of the shadow"),
        Some(Kind::Wave) => ("#3a9d5d", "integral over impacts near the rim"),
        None => ("#a05cc0", "the same about the axis (glory)"),
    }
}

/// A stretch of scattering angles (degrees, ascending), its colour and words.
type Bar = ([f64; 2], (&'static str, &'static str));

/// Colour of an order that no plane can follow.
const OTHER: &str = "#d9c04a";

/// The bars of a piece.
fn bars(piece: &Piece) -> Vec<Bar> {
    spans(piece).into_iter().map(|span| (span, look(piece))).collect()
}

/// Scattering angles of a piece, degrees, ascending; a piece that passes the axis is cut there.
fn spans(piece: &Piece) -> Vec<[f64; 2]> {
    let [low, high] = [piece.angles[0].min(piece.angles[1]), piece.angles[0].max(piece.angles[1])];
    let mut cuts = vec![low];
    cuts.extend(
        (0..).map(|k| ((low / PI).floor() + 1.0 + f64::from(k)) * PI).take_while(|c| *c < high),
    );
    cuts.push(high);
    let folded = |angle: f64| {
        let turned = angle.rem_euclid(TAU);
        if turned > PI { TAU - turned } else { turned }
    };
    let span = |ends: &[f64]| {
        // ends on the axis are those of their own side
        let inside = 1e-9 * (ends[1] - ends[0]);
        let [a, b] = [folded(ends[0] + inside), folded(ends[1] - inside)].map(f64::to_degrees);
        [a.min(b), a.max(b)]
    };
    cuts.windows(2).map(span).collect()
}

/// What is drawn so far.
#[derive(Default)]
struct Drawing {
    marks: String,
    legend: Vec<(&'static str, &'static str)>,
    /// Where the next row begins.
    y: usize,
}

impl Drawing {
    /// The orders of a particle, each a row of lanes, over an axis of scattering angles.
    fn panel(&mut self, title: &str, shape: &Shape) {
        let last = ORDERS[ORDERS.len() - 1];
        let tracer = Tracer::new(shape, INDEX.into(), SIZE_PARAMETER, last);
        let settings = FarFieldSettings {
            size_parameter: SIZE_PARAMETER,
            orders: &ORDERS,
            tolerance: 0.01,
            diffraction: true,
        };
        let shadow = ForwardDiffraction::new(shape);
        let pieces = PlaneSet::new(&tracer, &settings, &shadow, &Thresholds::MEASURED).pieces();
        let field = FarField::meridians(&tracer, &settings);
        self.text(LEFT, self.y + 15, "start", title);
        let top = self.y + TOP;
        self.y = top;
        let before = std::mem::take(&mut self.marks);
        for order in ORDERS {
            let mut bars: Vec<Bar> =
                pieces.iter().filter(|p| p.order == order).flat_map(bars).collect();
            let assigned = field.assignment().into_iter().flat_map(Assignment::entries);
            for other in assigned.filter(|a| a.order == order && a.method != Method::Planes) {
                bars.push(([0.0, 180.0], (OTHER, other.method.words())));
            }
            self.row(order, &bars);
        }
        let rows = std::mem::replace(&mut self.marks, before);
        for degrees in (0..=180).step_by(20) {
            let (x, bottom) = (LEFT + DEGREE * f64::from(degrees), self.y);
            // writing to a string does not fail
            let _ = writeln!(
                self.marks,
                r##"<line x1="{x}" y1="{top}" x2="{x}" y2="{bottom}" stroke="#dddddd"/>"##
            );
            self.text(x, bottom + 16, "middle", &format!("{degrees}°"));
        }
        self.marks += &rows;
        self.y += 32;
    }

    fn row(&mut self, order: u32, bars: &[Bar]) {
        let mut lanes: Vec<Vec<[f64; 2]>> = vec![];
        for &([from, to], (colour, words)) in bars {
            if !self.legend.contains(&(colour, words)) {
                self.legend.push((colour, words));
            }
            // the first lane in which it meets no other
            let meets = |lane: &Vec<[f64; 2]>| lane.iter().any(|s| s[0] < to && from < s[1]);
            let lane = lanes.iter().position(|lane| !meets(lane)).unwrap_or(lanes.len());
            if lane == lanes.len() {
                lanes.push(vec![]);
            }
            lanes[lane].push([from, to]);
            let (x, width) = (LEFT + DEGREE * from, (DEGREE * (to - from)).max(1.0));
            let (y, height) = (self.y + lane * BAR, BAR - 1);
            let _ = writeln!(
                self.marks,
                r##"<rect x="{x:.0}" y="{y}" width="{width:.0}" height="{height}" fill="{colour}"/>"##
            );
        }
        let height = lanes.len().max(2) * BAR;
        self.text(10.0, self.y + height / 2 + 5, "start", &format!("p = {order}"));
        self.y += height + BAR;
    }

    fn text(&mut self, x: f64, y: usize, anchor: &str, text: &str) {
        let _ =
            writeln!(self.marks, r#"<text x="{x}" y="{y}" text-anchor="{anchor}">{text}</text>"#);
    }
}

fn picture() -> String {
    let mut drawing = Drawing::default();
    let words = format!("n = {INDEX}, x = {SIZE_PARAMETER}; one lane per ray");
    drawing.panel(&format!("Sphere, {words}, both half-planes"), &Shape::sphere());
    let spheroid =
        Shape::spheroid(0.97, 20f64.to_radians()).expect("an axis ratio that is accepted");
    let title =
        format!("Spheroid of axis ratio 0.97, light at 20°, {words}, upper vertical half-plane");
    drawing.panel(&title, &spheroid);
    for (i, (colour, text)) in drawing.legend.clone().into_iter().enumerate() {
        let (x, y) = (LEFT + 250.0 * (i % 3) as f64, drawing.y + 8 + 18 * (i / 3));
        let _ = writeln!(
            drawing.marks,
            r##"<rect x="{x}" y="{y}" width="12" height="8" fill="{colour}"/>"##
        );
        drawing.text(x + 18.0, y + 9, "start", text);
    }
    let height = drawing.y + 16 + 18 * drawing.legend.len().div_ceil(3);
    let (width, marks) = (LEFT + 180.0 * DEGREE + 20.0, drawing.marks);
    format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="12">
<rect width="{width}" height="{height}" fill="#ffffff"/>
{marks}</svg>
"##
    )
}
