//! The diagrams that glasses are chosen by: index over Abbe number, and relative partial dispersion.

use crate::figures::figure::Figure;
use crate::figures::media::medium;
use crate::figures::papers;
use crate::figures::plain::{BLACK, BLUE, GREY, RED, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::medium::{AbbeLines, list};
use crate::render::plots::sheet::{Axis, Chart, Curve, Label, Panel};

pub(super) const DIAGRAM: Figure = Figure {
    name: "glass-abbe",
    source: papers::GLASSES,
    caption: "Abbe numbers, index, and relative partial dispersion P(g,F) = (n_g − n_F)/(n_F − n_C) of the library's glasses \
              and crystals",
    compare: "V_d and V_e of one glass differ a little; most glasses lie near one line of P over V, fluor crowns off it: the \
              Abbe number does not say how n runs between its lines",
    scenes: &[],
    pictures: false,
    make,
};

/// Wavelength of the line g, metres.
const G: f64 = 435.8343e-9;
/// Glasses that are named in the diagrams.
const NAMED: [&str; 9] =
    ["N-BK7", "F2", "SF11", "N-FK51A", "N-SF66", "N-LASF9", "fused-silica", "fluorite", "diamond"];
/// Catalogue glasses through which the normal line is drawn, by convention.
const NORMAL: [&str; 2] = ["N-K5", "F2"];

fn make(_: &Workshop) -> Result<Made, FigureError> {
    let (mut index, mut partial, mut labels) = (Vec::new(), Vec::new(), [Vec::new(), Vec::new()]);
    let mut normal = Vec::new();
    let mut numbers = Vec::new();
    for entry in list()?.iter().filter(|entry| entry.kind.starts_with("formula ")) {
        let medium = medium(&entry.name)?;
        let lines = AbbeLines::HeliumD;
        let Some(abbe) = medium.abbe(lines) else { continue };
        let [_, short, long] = lines.micrometres().map(|um| um * 1e-6);
        let (Ok(g), Ok(f), Ok(c)) = (medium.index(G), medium.index(short), medium.index(long))
        else {
            continue;
        };
        if !(15.0..100.0).contains(&abbe.number) || abbe.index > 2.5 {
            continue;
        }
        let relative = (g.re - f.re) / (f.re - c.re);
        index.push((abbe.number, abbe.index));
        partial.push((abbe.number, relative));
        if NORMAL.contains(&&*entry.name) {
            normal.push((abbe.number, relative));
        }
        if NAMED.contains(&&*entry.name) {
            let text = || entry.name.clone();
            labels[0].push(Label {
                at: (abbe.number + 0.9, abbe.index),
                text: text(),
                colour: BLACK,
            });
            labels[1].push(Label {
                at: (abbe.number + 0.9, relative),
                text: text(),
                colour: BLACK,
            });
        }
        if let Some((n, v)) = entry.catalogue.filter(|_| NAMED.contains(&&*entry.name)) {
            let number = |what: &str, catalogue, ours| {
                Number::beside(format!("{}: {what} (catalogue)", entry.name), "", catalogue, ours)
            };
            numbers.push(number("n_d", n, abbe.index));
            numbers.push(number("V_d", v, abbe.number));
        }
    }
    let glass = medium("N-BK7")?;
    for (lines, name) in [(AbbeLines::SodiumD, "V_D"), (AbbeLines::MercuryE, "V_e")] {
        if let Some(abbe) = glass.abbe(lines) {
            numbers.push(Number::alone(format!("N-BK7: {name}"), "", abbe.number));
        }
    }
    let line = match normal.as_slice() {
        [(x0, y0), (x1, y1)] => {
            [15.0, 100.0].map(|x| (x, y0 + (y1 - y0) * (x - x0) / (x1 - x0))).to_vec()
        }
        _ => Vec::new(),
    };
    let [first, second] = labels;
    let panels = vec![
        Panel::Chart(Chart {
            title: "index over Abbe number".into(),
            x: Axis::linear("Abbe number V_d", 15.0, 105.0),
            y: Axis::linear("n_d", 1.35, 2.5),
            curves: vec![Curve::new("", BLUE, index).dots()],
            labels: first,
            ..Chart::default()
        }),
        Panel::Chart(Chart {
            title: "relative partial dispersion".into(),
            x: Axis::linear("Abbe number V_d", 15.0, 105.0),
            y: Axis::linear("P(g,F)", 0.5, 0.68),
            curves: vec![
                Curve::new("line through N-K5 and F2", GREY, line).thin(),
                Curve::new("", RED, partial).dots(),
            ],
            labels: second,
            ..Chart::default()
        }),
    ];
    Ok(Made::new(sheet("Abbe diagrams", 2, (640, 480), panels, &[]), numbers))
}
