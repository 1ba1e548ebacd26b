//! Figs. 1 and 12 to 17: skies.

use crate::figures::figure::Figure;
use crate::figures::papers;
use crate::figures::plain::sheet;
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::render::Picture;
use crate::render::bow::BowScene;
use crate::render::plots::sheet::{PICTURE_HEAD, Panel};
use crate::scene::{Choice, ShapeName};
use crate::shape::{RaindropModel, Shape};
use crate::trace::{SymmetryPlane, Tracer};

pub(super) const FIG_1: Figure = Figure {
    name: "sadeghi-1",
    source: papers::RAINBOWS,
    caption: "Fig. 1: (a) Lorenz–Mie, a point for the sun; (b) with the sun's disc; (c) double bow; (d) supernumeraries; (e) \
              twinned bow",
    compare: "(b) is (a) smoothed; the secondary's colours are reversed; small drops of one size have many \
              supernumeraries; the twinned bow splits at its top",
    scenes: &["sadeghi_1a", "sadeghi_1b", "sadeghi_1c", "sadeghi_1d", "sadeghi_1e"],
    pictures: true,
    make: phenomena,
};

pub(super) const FIG_12: Figure = Figure {
    name: "sadeghi-12",
    source: papers::RAINBOWS,
    caption: "Fig. 12 with Table III: double bow, full double bow, supernumeraries; multiple supernumeraries, cloud bow, \
              red bow",
    compare: "Drops, fields of view, lenses, backgrounds, intensities and light of Table III; sun and aim, which it does \
              not tell, are ours",
    scenes: &[
        "sadeghi_12a",
        "sadeghi_12b",
        "sadeghi_12c",
        "sadeghi_12d",
        "sadeghi_12e",
        "sadeghi_12f",
    ],
    pictures: true,
    make: table_iii,
};

pub(super) const FIG_13: Figure = Figure {
    name: "sadeghi-13",
    source: papers::RAINBOWS,
    caption: "Fig. 13: drops of 0.4, 0.6 and 0.8 mm as spheres (left half) and as raindrops (right half)",
    compare: "No seam at 0.4 mm; the larger the drop, the lower the raindrop's primary is at the top, while the secondary \
              hardly moves",
    scenes: &["sadeghi_13"],
    pictures: true,
    make: split,
};

pub(super) const FIG_14: Figure = Figure {
    name: "sadeghi-14",
    source: papers::RAINBOWS,
    caption: "Fig. 14: the whole bow of raindrops of 0.4, 0.6 and 0.8 mm, the sun at 20°",
    compare: "A circle at 0.4 mm; larger drops draw the primary's top in and leave its sides",
    scenes: &["sadeghi_14"],
    pictures: true,
    make: outlines,
};

pub(super) const FIG_15: Figure = Figure {
    name: "sadeghi-15",
    source: papers::RAINBOWS,
    caption: "Fig. 15: the whole circle of the bow of raindrops of 0.5 mm, the sun at 0, 20, 40 and 60°; the horizon in \
              grey",
    compare: "Out of round at every elevation, and differently; spheres would give one circle in all",
    scenes: &["sadeghi_15"],
    pictures: true,
    make: elevations,
};

pub(super) const FIG_16: Figure = Figure {
    name: "sadeghi-16",
    source: papers::RAINBOWS,
    caption: "Fig. 16: a bow of raindrops of 0.5 mm without a filter, and through polarising filters with horizontal and \
              vertical axes",
    compare: "The horizontal filter keeps the top and takes the feet; the vertical one the other way round",
    scenes: &["sadeghi_16"],
    pictures: true,
    make: filters,
};

pub(super) const FIG_17: Figure = Figure {
    name: "sadeghi-17",
    source: papers::RAINBOWS,
    caption: "Fig. 17: twinned bow of two showers, raindrops of 0.4 and 0.45 mm",
    compare: "Two primaries at the top that join at the sides; one secondary",
    scenes: &["sadeghi_17"],
    pictures: true,
    make: twinned,
};

/// A panel of a picture and its words.
fn panel(title: impl Into<String>, picture: Picture) -> Panel {
    Panel::Picture { title: title.into(), picture }
}

/// A sheet of pictures of one size.
fn gallery(
    title: &str,
    columns: usize,
    panels: Vec<Panel>,
    numbers: Vec<Number>,
    notes: &[&str],
) -> Made {
    let side = |of: fn(&Picture) -> usize| {
        let of = |panel: &Panel| match panel {
            Panel::Picture { picture, .. } => of(picture) as u32,
            Panel::Chart(_) => 0,
        };
        panels.iter().map(of).max().unwrap_or(0)
    };
    let size = (side(|p| p.width) + 14, side(|p| p.height) + PICTURE_HEAD + 4);
    Made::new(sheet(title, columns, size, panels, notes), numbers)
}

fn phenomena(workshop: &Workshop) -> Result<Made, FigureError> {
    let titles = [
        ("sadeghi_1a", "(a) Lorenz–Mie, the sun a point"),
        ("sadeghi_1b", "(b) with the sun's disc"),
        ("sadeghi_1c", "(c) double bow, 0.4 mm"),
        ("sadeghi_1d", "(d) supernumeraries, 0.1 mm"),
        ("sadeghi_1e", "(e) twinned, 0.4 and 0.5 mm"),
    ];
    let mut panels = Vec::new();
    for (scene, title) in titles {
        panels.push(panel(title, workshop.draw(&workshop.sky(scene)?)?));
    }
    Ok(gallery("Kinds of rainbows", 3, panels, Vec::new(), &[]))
}

/// A column of Table III: scene, what it shows, radius in mm, field of view in degrees, lens, background, intensity in %.
type Column = (&'static str, &'static str, f64, f64, &'static str, [u8; 3], f64);

/// Table III as printed.
const TABLE_III: [Column; 6] = [
    ("sadeghi_12a", "double bow", 0.4, 20.0, "rectilinear", [107, 114, 118], 55.0),
    ("sadeghi_12b", "full double bow", 0.4, 100.0, "fisheye", [183, 202, 212], 100.0),
    ("sadeghi_12c", "supernumeraries", 0.3, 30.0, "rectilinear", [172, 172, 172], 90.0),
    ("sadeghi_12d", "multiple supernumeraries", 0.3, 10.0, "fisheye", [69, 99, 112], 80.0),
    ("sadeghi_12e", "cloud bow", 0.1, 100.0, "rectilinear", [141, 180, 223], 60.0),
    ("sadeghi_12f", "red bow", 0.4, 30.0, "rectilinear", [154, 83, 58], 80.0),
];
/// Luminance that the brightest light of a bow of 100 % adds to the background.
const FULL: f64 = 0.4;

fn table_iii(workshop: &Workshop) -> Result<Made, FigureError> {
    let (mut panels, mut numbers) = (Vec::new(), Vec::new());
    for (name, title, radius, field, lens, background, intensity) in TABLE_III {
        let scene = workshop.sky(name)?;
        let drops = scene.drops[0].particle.radius_mm.unwrap_or(f64::NAN);
        let camera = &scene.camera;
        let number = |what: &str, unit, paper, ours| {
            Number::beside(format!("{title}: {what}"), unit, paper, ours)
        };
        numbers.push(number("drop", "mm", radius, drops));
        numbers.push(number("field of view", "°", field, camera.fov_deg.unwrap_or(f64::NAN)));
        let shown = 100.0 * scene.sky.brightness.unwrap_or(f64::NAN) / FULL;
        numbers.push(number("intensity", "%", intensity, shown));
        let same = scene.sky.background == Some(background) && camera.lens.as_deref() == Some(lens);
        let light = scene.sun.illuminant.as_deref().unwrap_or("D65");
        let words = format!("{title}: {radius} mm, {field}°, {lens}, {light}");
        let as_printed = if same { "" } else { " (not as printed)" };
        panels.push(panel(words + as_printed, workshop.draw(&scene)?));
    }
    // Numbers that are those of the scene stand in it; the sheet shows pictures.
    let notes = [
        "Drop, field of view, lens, background and intensity as printed in Table III; 100 % adds a luminance of 0.4 to the background.",
        "Sun and aim are ours: Table III does not tell them. Red bow: sunlight through clean air at 1° in place of D65 with Rayleigh's air.",
    ];
    let made = gallery("Six rainbows by Table III", 3, panels, Vec::new(), &notes);
    Ok(made.with_numbers(numbers))
}

/// The radius of a scene's first drops, and their shape.
fn with_drops(mut scene: BowScene, radius_mm: f64, shape: ShapeName) -> BowScene {
    scene.drops[0].particle.radius_mm = Some(radius_mm);
    scene.drops[0].particle.shape = Some(Choice(shape));
    if shape == ShapeName::Sphere {
        scene.drops[0].wavelengths = None;
    }
    scene
}

/// What is drawn of a raindrop's radius: below 0.4 mm it is a sphere, and shares the sphere's table.
fn raindrop(scene: BowScene, radius_mm: f64) -> BowScene {
    let flat = RaindropModel::BeardChuang1987.sphere_up_to().is_none_or(|r| radius_mm * 1e-3 > r);
    with_drops(scene, radius_mm, if flat { ShapeName::Raindrop } else { ShapeName::Sphere })
}

/// Left half of one picture, right half of another, with a seam between.
fn halves(left: &Picture, right: &Picture) -> Picture {
    let mut both = left.clone();
    let middle = left.width / 2;
    for (row, from) in
        both.rgb.chunks_exact_mut(3 * left.width).zip(right.rgb.chunks_exact(3 * left.width))
    {
        row[3 * middle..].copy_from_slice(&from[3 * middle..]);
        row[3 * middle..3 * middle + 3].copy_from_slice(&[255; 3]);
    }
    both
}

const RADII_MM: [f64; 3] = [0.4, 0.6, 0.8];

fn split(workshop: &Workshop) -> Result<Made, FigureError> {
    let scene = workshop.sky("sadeghi_13")?;
    let mut panels = Vec::new();
    for mm in RADII_MM {
        let sphere = workshop.draw(&with_drops(scene.clone(), mm, ShapeName::Sphere))?;
        let drop = workshop.draw(&raindrop(scene.clone(), mm))?;
        panels.push(panel(format!("{mm} mm: sphere | raindrop"), halves(&sphere, &drop)));
    }
    let notes = ["The paper does not print its radii above 0.4 mm; sun at 20°."];
    Ok(gallery("Spheres and raindrops", 3, panels, bows_at_top()?, &notes))
}

/// How far a raindrop's bow at the top is from a sphere's, sun at 20°, degrees.
fn bows_at_top() -> Result<Vec<Number>, FigureError> {
    let mut numbers = Vec::new();
    for (order, name) in [(2, "primary"), (3, "secondary")] {
        for mm in [0.6, 0.8] {
            let shape =
                Shape::raindrop(mm * 1e-3, RaindropModel::BeardChuang1987, 20f64.to_radians())?;
            let sphere = Shape::sphere();
            // The bow's top is light that goes down: primary rays enter the lower half.
            let top = |shape: &Shape| {
                let tracer = Tracer::new(shape, 1.3334.into(), 1.0, order);
                let plane = SymmetryPlane::new(shape, &tracer, order);
                let down = |bow: &&crate::trace::Rainbow| {
                    plane.ray(bow.impact).is_some_and(|ray| ray.exit.direction.x < 0.0)
                };
                plane
                    .rainbows()
                    .iter()
                    .find(down)
                    .map_or(f64::NAN, |bow| bow.deviation.to_degrees())
            };
            let moved = top(&shape) - top(&sphere);
            numbers.push(Number::alone(format!("{name}'s top moved, {mm} mm"), "°", moved));
        }
    }
    Ok(numbers)
}

fn outlines(workshop: &Workshop) -> Result<Made, FigureError> {
    let scene = workshop.sky("sadeghi_14")?;
    let mut panels = Vec::new();
    for mm in RADII_MM {
        panels.push(panel(format!("{mm} mm"), workshop.draw(&raindrop(scene.clone(), mm))?));
    }
    let notes = [
        "Circles of 42° and 51° about the antisolar point, and the horizon, are drawn to compare with.",
    ];
    Ok(gallery("The bow's shape by the size of the drops", 3, panels, Vec::new(), &notes))
}

fn elevations(workshop: &Workshop) -> Result<Made, FigureError> {
    let scene = workshop.sky("sadeghi_15")?;
    let mut panels = Vec::new();
    for degrees in [0.0, 20.0, 40.0, 60.0] {
        let mut scene = scene.clone();
        scene.sun.elevation_deg = Some(degrees);
        // along the sun's rays
        scene.camera.elevation_deg = Some(-degrees);
        panels.push(panel(format!("sun at {degrees}°"), workshop.draw(&scene)?));
    }
    Ok(gallery("Raindrops of 0.5 mm under four suns", 4, panels, Vec::new(), &[]))
}

fn filters(workshop: &Workshop) -> Result<Made, FigureError> {
    let scene = workshop.sky("sadeghi_16")?;
    let mut panels = Vec::new();
    for (title, axis) in
        [("without a filter", None), ("axis horizontal", Some(0.0)), ("axis vertical", Some(90.0))]
    {
        let mut scene = scene.clone();
        scene.filter.polariser_deg = axis;
        panels.push(panel(title, workshop.draw(&scene)?));
    }
    let notes = ["One exposure in all three: a filter takes half of unpolarised light."];
    Ok(gallery("The bow through polarising filters", 3, panels, Vec::new(), &notes))
}

fn twinned(workshop: &Workshop) -> Result<Made, FigureError> {
    let picture = workshop.draw(&workshop.sky("sadeghi_17")?)?;
    let panels = vec![panel("drops of 0.4 and 0.45 mm, sun at 30°", picture)];
    Ok(gallery("Twinned bow", 1, panels, Vec::new(), &[]))
}
