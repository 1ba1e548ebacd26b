//! A drop of dyed water: its bow has the colours of an index that rises towards long waves.

use crate::color::{Illuminant, Observer, to_srgb};
use crate::figures::figure::Figure;
use crate::figures::media::{curve, medium};
use crate::figures::papers;
use crate::figures::plain::{BLUE, RED, evenly, maximum, points, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::lee::{Polarisation, Request, spheres};
use crate::optics::rainbow_angle;
use crate::render::plots::sheet::{Axis, Chart, Curve, Panel, Strip};

pub(super) const DYED_DROP: Figure = Figure {
    name: "weidlich-drop",
    source: papers::ANOMALOUS_DISPERSION,
    caption: "The paper's question put to a drop: bows of 0.3 mm drops of water with 2 % of fuchsine (a band model), with \
              and without its change of n",
    compare: "With the change of n the bow has blue outside and red inside; with water's index red outside, as every bow has",
    scenes: &[],
    pictures: false,
    make,
};

const DYED: &str = "{ solute = \"fuchsine\", fraction = 0.02, host = \"water\" }";
const COLOURED: &str =
    "{ solute = \"fuchsine\", fraction = 0.02, host = \"water\", dispersion = false }";
const RADIUS: f64 = 0.3e-3;

fn make(_: &Workshop) -> Result<Made, FigureError> {
    let theta = evenly(125.0, 150.0, 501);
    let nm = evenly(400.0, 700.0, 301);
    let (mut strips, mut light, mut bows, mut numbers) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for (name, spec, colour) in
        [("dyed, n changes", DYED, RED), ("dyed, n of water", COLOURED, BLUE)]
    {
        let medium = medium(spec)?;
        let diagram = spheres(&Request {
            radii: vec![RADIUS],
            theta: theta.iter().map(|t| t.to_radians()).collect(),
            medium: medium.clone(),
            sun_disc: true,
            size_spread: 0.0,
            illuminant: Illuminant::D65,
            observer: Observer::Cie1931,
            fineness: 1.0,
        })?;
        let seen = diagram.seen(Polarisation::Total).swap_remove(0);
        let luminance: Vec<f64> = seen.iter().map(|xyz| xyz[1]).collect();
        let most = luminance.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        let colours = seen.iter().map(|&xyz| to_srgb(xyz, 0.8 / most)).collect();
        strips.push(Strip { name: name.into(), colours });
        let relative: Vec<f64> = luminance.iter().map(|y| y / most).collect();
        light.push(Curve::new(name, colour, points(&theta, &relative)));
        let (n, _) = curve(&medium, &nm)?;
        let angle = |n: &f64| rainbow_angle(*n, 2).map_or(f64::NAN, f64::to_degrees);
        let angles: Vec<f64> = n.iter().map(angle).collect();
        let at = |wanted: f64| angles[nm.partition_point(|v| *v < wanted)];
        numbers.push(Number::alone(
            format!("bow of rays at 450 less that at 650 nm, {name}"),
            "°",
            at(450.0) - at(650.0),
        ));
        numbers.push(Number::alone(
            format!("brightest angle, {name}"),
            "°",
            maximum(&theta, &luminance, 125.0, 150.0),
        ));
        bows.push(Curve::new(name, colour, points(&nm, &angles)));
    }
    let panels = vec![
        Panel::Chart(Chart {
            title: "colours and luminance, D65, sun's disc".into(),
            x: Axis::linear("scattering angle (°)", 125.0, 150.0),
            y: Axis::linear("luminance, brightest 1", 0.0, 1.05),
            curves: light,
            strips,
            ..Chart::default()
        }),
        Panel::Chart(Chart {
            title: "bow of ray optics by wavelength".into(),
            x: Axis::linear("wavelength (nm)", 400.0, 700.0),
            y: Axis::linear("scattering angle (°)", 130.0, 146.0),
            curves: bows,
            ..Chart::default()
        }),
    ];
    let notes = ["Fuchsine: a band model, no measurement. The paper has no drop, and no number."];
    Ok(Made::new(sheet("A rainbow of dyed water", 2, (660, 440), panels, &notes), numbers))
}
