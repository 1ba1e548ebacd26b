//! Figs. 5 and 6: the light of spheres by Lorenz–Mie, of one and of all sizes.

use super::strips::{daylight, exposure, strip};
use crate::figures::figure::Figure;
use crate::figures::papers;
use crate::figures::plain::{BLACK, BLUE, RED, by_factors, evenly, maximum, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::lee::{Diagram, PEAK, Polarisation, column_exposures, spheres};
use crate::optics::rainbow_angle;
use crate::render::ColorDiagram;
use crate::render::plots::sheet::{Axis, Chart, Curve, Mark, Panel};

pub(super) const FIG_5: Figure = Figure {
    name: "sadeghi-5",
    source: papers::RAINBOWS,
    caption: "Fig. 5: sunlight scattered by a drop of 0.1 mm by Lorenz–Mie theory, with strips of both polarisations and \
              of all light",
    compare: "Primary bow near 139°, secondary near 127°, dark band from 130 to 136°; both bows polarised across the \
              scattering plane; supernumeraries within the primary",
    scenes: &[],
    pictures: false,
    make: one_size,
};

pub(super) const FIG_6: Figure = Figure {
    name: "sadeghi-6",
    source: papers::RAINBOWS,
    caption: "Fig. 6: Lee diagram of spheres, radius 0.01 to 1 mm",
    compare: "A white bow at the left that breaks into colours to the right; supernumeraries crowd towards the primary; the \
              secondary has its colours reversed; dark band between both",
    scenes: &[],
    pictures: true,
    make: all_sizes,
};

const RADIUS: f64 = 0.1e-3;
/// The paper's: bows near these angles, a dark band between those, degrees.
const BOWS: [(&str, f64, (f64, f64)); 2] =
    [("primary bow", 139.0, (136.0, 145.0)), ("secondary bow", 127.0, (120.0, 130.0))];
const DARK: (f64, f64) = (130.0, 136.0);

fn luminance(diagram: &Diagram, polarisation: Polarisation) -> Vec<f64> {
    diagram.seen(polarisation)[0].iter().map(|xyz| xyz[1]).collect()
}

fn one_size(_: &Workshop) -> Result<Made, FigureError> {
    let theta = evenly(120.0, 150.0, 601);
    let diagram = spheres(&daylight(vec![RADIUS], &theta)?)?;
    let all = luminance(&diagram, Polarisation::Total);
    let light = exposure(&diagram.seen(Polarisation::Total)[0]);
    let mut numbers = Vec::new();
    for (name, paper, (from, to)) in BOWS {
        let found = maximum(&theta, &all, from, to);
        numbers.push(Number::beside(format!("{name}, brightest"), "°", paper, found));
    }
    // The dark band ends where there is a tenth of the nearest bow's light more than at its darkest.
    let dark: Vec<f64> = all.iter().map(|v| -v).collect();
    let darkest = maximum(&theta, &dark, DARK.0, DARK.1);
    let value = |at: f64| all[theta.iter().position(|t| *t >= at).unwrap_or(0)];
    let end = |bow: f64, way: f64| {
        let level = value(darkest) + 0.1 * (value(bow) - value(darkest));
        let steps = (0..400).map(|i| darkest + way * 0.05 * f64::from(i));
        steps.into_iter().find(|&t| value(t.clamp(120.0, 150.0)) > level).unwrap_or(f64::NAN)
    };
    let (secondary, primary) = (numbers[1].ours, numbers[0].ours);
    numbers.push(Number::beside("dark band, from", "°", DARK.0, end(secondary, -1.0)));
    numbers.push(Number::beside("dark band, to", "°", DARK.1, end(primary, 1.0)));
    let names = [
        ("across the plane", Polarisation::Perpendicular, RED),
        ("along the plane", Polarisation::Parallel, BLUE),
        ("all light", Polarisation::Total, BLACK),
    ];
    let strips = names.map(|(name, light_of, _)| strip(name, &diagram.seen(light_of)[0], light));
    let curves = names.map(|(name, light_of, colour)| {
        let values = luminance(&diagram, light_of);
        Curve::new(name, colour, theta.iter().copied().zip(values))
    });
    let most = all.iter().copied().fold(0.0, f64::max);
    let chart = Chart {
        title: "drop of 0.1 mm, D65, sun's disc of 0.53°".into(),
        x: Axis::linear("scattering angle (°)", 120.0, 150.0),
        y: Axis::logarithmic(
            "luminance (perfect white in every direction: 1)",
            1e-3 * most,
            2.0 * most,
        ),
        curves: curves.to_vec(),
        strips: strips.to_vec(),
        ..Chart::default()
    };
    let notes = [
        "The paper says near and between; ours are the brightest angles, and where the band has a tenth of the bow's light above its own.",
    ];
    let sheet = sheet(
        "Sunlight on a sphere by Lorenz–Mie",
        1,
        (900, 620),
        vec![Panel::Chart(chart)],
        &notes,
    );
    Ok(Made::new(sheet, numbers))
}

/// Columns and rows of the diagram: half of what `gonio lee` has by itself.
const COLUMNS: usize = 180;
const ROWS: usize = 301;

fn all_sizes(_: &Workshop) -> Result<Made, FigureError> {
    let theta = evenly(120.0, 150.0, ROWS);
    let diagram = spheres(&daylight(by_factors(0.01e-3, 1e-3, COLUMNS), &theta)?)?;
    let seen = diagram.seen(Polarisation::Total);
    let radii = diagram.radii_mm();
    let mark = |name: &str, index: f64, order| {
        rainbow_angle(index, order).map(|angle| (angle.to_degrees(), format!("{name}, rays")))
    };
    let marks = [("primary 650 nm", 1.3314, 2), ("secondary 650 nm", 1.3314, 3)];
    let marks: Vec<_> =
        marks.iter().filter_map(|(name, n, order)| mark(name, *n, *order)).collect();
    let picture = ColorDiagram {
        title: "Lee diagram of spheres of water",
        subtitle: "Lorenz–Mie, all polarisations, D65, sun's disc 0.53°; every radius scaled to the same brightest luminance",
        radii: &radii,
        logarithmic: true,
        theta: &theta,
        xyz: &seen,
        exposure: &column_exposures(&seen, PEAK),
        marks: &marks,
    }
    .picture()?;
    // The brightest angle of the largest drops.
    let last: Vec<f64> = seen[COLUMNS - 1].iter().map(|xyz| xyz[1]).collect();
    let first: Vec<f64> = seen[0].iter().map(|xyz| xyz[1]).collect();
    let numbers = vec![
        Number::alone("brightest angle, 0.01 mm", "°", maximum(&theta, &first, 120.0, 150.0)),
        Number::alone("brightest angle, 1 mm", "°", maximum(&theta, &last, 120.0, 150.0)),
    ];
    let panel = (picture.width as u32 + 24, picture.height as u32 + 40);
    let panels = vec![Panel::Picture { title: String::new(), picture }];
    Ok(Made::new(sheet("Lee diagram", 1, panel, panels, &[]), numbers))
}

/// Marks of the bows of rays of an index, for charts over the scattering angle.
pub(super) fn bows_of_rays(index: f64) -> Vec<Mark> {
    let mark = |order, name: &str| {
        let angle = rainbow_angle(index, order)?.to_degrees();
        Some(Mark { x: angle, name: name.into() })
    };
    [mark(3, "secondary, rays"), mark(2, "primary, rays")].into_iter().flatten().collect()
}
