//! Figs. 1 and 5: what thin prisms make of white light, by wavelength and in colour.

use crate::color::{Illuminant, Observer, spectrum_to_xyz, to_srgb};
use crate::figures::figure::Figure;
use crate::figures::media::{curve, medium};
use crate::figures::papers;
use crate::figures::plain::{PALETTE, evenly, points, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::medium::Medium;
use crate::render::plots::sheet::{Axis, Chart, Curve, Panel, Strip};
use std::f64::consts::PI;

pub(super) const FIG_1: Figure = Figure {
    name: "weidlich-1",
    source: papers::ANOMALOUS_DISPERSION,
    caption: "Fig. 1: light through prisms of 1°14′ of BK7 glass and of fuchsine in alcohol (19 %, a band model), \
              Christiansen's of 1871",
    compare: "Glass: red to violet in order and narrow; fuchsine: blue and violet are deviated less than red, green is \
              absorbed, and the fan is wider",
    scenes: &[],
    pictures: false,
    make: fuchsine,
};

pub(super) const FIG_5: Figure = Figure {
    name: "weidlich-5",
    source: papers::ANOMALOUS_DISPERSION,
    caption: "Fig. 5: the prism of 1°14′ filled with rose bengal of 10, 3.3 and 1 % (a band model), beside water's index with \
              the same absorption",
    compare: "10 %: the fan is much wider than water's, its order partly reversed, green absorbed; 3.3 %: weaker; 1 %: nearly \
              water's",
    scenes: &[],
    pictures: false,
    make: rose_bengal,
};

/// The prism's refracting angle: 1°14′.
const APEX: f64 = (1.0 + 14.0 / 60.0) * PI / 180.0;
/// Wavelengths, nm.
const LIGHT: (f64, f64) = (400.0, 700.0);
/// Thickness of the prism where the light goes through, near its edge: metres.
const THICKNESS: f64 = 2e-6;

/// Deviation in minutes of arc of light that meets the first face straight on: `asin(n sin A) - A`.
fn deviation(n: f64) -> f64 {
    60.0 * ((n * APEX.sin()).asin() - APEX).to_degrees()
}

/// One prism's curve and strip: deviations by wavelength, and the colours seen along them.
struct Fan {
    nm: Vec<f64>,
    minutes: Vec<f64>,
    passed: Vec<f64>,
}

impl Fan {
    /// `colour` gives the absorption, `index` the index.
    fn new(index: &Medium, colour: &Medium) -> Result<Self, FigureError> {
        let nm = evenly(LIGHT.0, LIGHT.1, 601);
        let (n, _) = curve(index, &nm)?;
        let (_, k) = curve(colour, &nm)?;
        let minutes = n.into_iter().map(deviation).collect();
        let passed = nm
            .iter()
            .zip(&k)
            .map(|(nm, k)| (-4.0 * PI * k * THICKNESS / (nm * 1e-9)).exp())
            .collect();
        Ok(Self { nm, minutes, passed })
    }

    /// From the least to the greatest deviation.
    fn width(&self) -> f64 {
        let all = || self.minutes.iter().copied();
        all().fold(f64::MIN, f64::max) - all().fold(f64::MAX, f64::min)
    }

    /// Colours along an axis of deviations, where light is smeared over a share of the axis as a slit does.
    fn strip(&self, name: &str, from: f64, to: f64) -> Result<Strip, FigureError> {
        const PLACES: usize = 300;
        let slit = 0.012 * (to - from);
        let wavelength: Vec<f64> = self.nm.iter().map(|nm| nm * 1e-9).collect();
        let mut colours = Vec::new();
        for place in evenly(from, to, PLACES) {
            let smear = |minutes: &f64| (-0.5 * ((minutes - place) / slit).powi(2)).exp();
            let here: Vec<f64> =
                self.minutes.iter().map(smear).zip(&self.passed).map(|(a, b)| a * b).collect();
            let xyz = spectrum_to_xyz(&wavelength, &here, Illuminant::D65, Observer::Cie1931);
            colours.push(xyz.map_err(crate::render::RenderError::from)?);
        }
        let most = colours.iter().map(|xyz| xyz[1]).fold(f64::MIN_POSITIVE, f64::max);
        let colours = colours.into_iter().map(|xyz| to_srgb(xyz, 0.8 / most)).collect();
        Ok(Strip { name: name.into(), colours })
    }
}

/// Charts of some prisms: deviation by wavelength, and the fans in colour over the deviation.
fn panels(fans: &[(&str, Fan)]) -> Result<Vec<Panel>, FigureError> {
    let all = || fans.iter().flat_map(|(_, fan)| fan.minutes.iter().copied());
    let (low, high) = (all().fold(f64::MAX, f64::min), all().fold(f64::MIN, f64::max));
    let margin = 0.06 * (high - low);
    let (low, high) = (low - margin, high + margin);
    let curves = |swapped: bool| -> Vec<Curve> {
        let one = |((name, fan), colour): (&(&str, Fan), [u8; 3])| {
            let places = match swapped {
                true => points(&fan.minutes, &fan.nm),
                false => points(&fan.nm, &fan.minutes),
            };
            Curve::new(name, colour, places)
        };
        fans.iter().zip(PALETTE).map(one).collect()
    };
    let mut strips = Vec::new();
    for (name, fan) in fans {
        strips.push(fan.strip(name, low, high)?);
    }
    Ok(vec![
        Panel::Chart(Chart {
            title: "deviation by wavelength".into(),
            x: Axis::linear("wavelength (nm)", LIGHT.0, LIGHT.1),
            y: Axis::linear("deviation (minutes of arc)", low, high),
            curves: curves(false),
            ..Chart::default()
        }),
        Panel::Chart(Chart {
            title: "what is seen behind the prism, each fan scaled to its brightest".into(),
            x: Axis::linear("deviation (minutes of arc)", low, high),
            y: Axis::linear("wavelength (nm)", LIGHT.0, LIGHT.1),
            curves: curves(true),
            strips,
            ..Chart::default()
        }),
    ])
}

fn numbers(fans: &[(&str, Fan)]) -> Vec<Number> {
    let mut numbers = vec![Number::beside(
        "refracting angle of the prism",
        "°",
        1.0 + 14.0 / 60.0,
        APEX.to_degrees(),
    )];
    for (name, fan) in fans {
        numbers.push(Number::alone(format!("width of the fan, {name}"), "′", fan.width()));
        let at = |nm: f64| fan.minutes[fan.nm.partition_point(|v| *v < nm).min(fan.nm.len() - 1)];
        numbers.push(Number::alone(
            format!("deviation at 450 less that at 650 nm, {name}"),
            "′",
            at(450.0) - at(650.0),
        ));
    }
    numbers
}

fn fuchsine(_: &Workshop) -> Result<Made, FigureError> {
    let dyed = medium("{ solute = \"fuchsine\", fraction = 0.19, host = \"ethanol\" }")?;
    let (alcohol, glass) = (medium("ethanol")?, medium("N-BK7")?);
    let fans = [
        ("BK7 glass", Fan::new(&glass, &glass)?),
        ("alcohol", Fan::new(&alcohol, &alcohol)?),
        ("fuchsine", Fan::new(&dyed, &dyed)?),
    ];
    let notes = [
        "Fuchsine: a band model, no measurement. Light goes through 2 µm of it, near the prism's edge.",
    ];
    let sheet =
        sheet("Thin prisms of glass and of dyed alcohol", 2, (660, 480), panels(&fans)?, &notes);
    Ok(Made::new(sheet, numbers(&fans)))
}

fn rose_bengal(_: &Workshop) -> Result<Made, FigureError> {
    let water = medium("water")?;
    let mut fans = Vec::new();
    for (name, fraction) in [("10 %", 0.10), ("3.3 %", 0.033), ("1 %", 0.01)] {
        let dyed = medium(&format!(
            "{{ solute = \"rose-bengal\", fraction = {fraction}, host = \"water\" }}"
        ))?;
        fans.push((name, Fan::new(&dyed, &dyed)?));
        if fraction == 0.10 {
            fans.push(("10 %, n of water", Fan::new(&water, &dyed)?));
        }
    }
    let notes = [
        "Rose bengal: a band model, no measurement. Light goes through 2 µm of it, near the prism's edge.",
    ];
    let sheet =
        sheet("A thin prism of rose bengal in water", 2, (660, 500), panels(&fans)?, &notes);
    Ok(Made::new(sheet, numbers(&fans)))
}
