//! Fig. 11: five sizes, rays beside Lorenz–Mie.

use super::stages::section;
use super::strips::{exposure, of_table, strip};
use crate::color::SUN_ANGULAR_RADIUS;
use crate::figures::figure::Figure;
use crate::figures::papers;
use crate::figures::plain::{BLACK, ORANGE, RED, evenly, maximum, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::render::plots::sheet::{Axis, Chart, Curve, Panel};
use crate::scene::{Choice, Grid, Method, SceneFile, ShapeName};
use crate::simulate;
use crate::sun_disc::smooth_over_sun;

pub(super) const FIG_11: Figure = Figure {
    name: "sadeghi-11",
    source: papers::RAINBOWS,
    caption: "Fig. 11: drops of 0.1 to 0.5 mm by rays (a) and by Lorenz–Mie theory (b): strips, curves at 650 nm, and how \
              far one is from the other",
    compare: "Up to 0.4 mm drops are spheres, and both methods agree; at 0.5 mm the flattened drop's primary lies \
              elsewhere, the secondary hardly; seen at the bow's top, the sun at 20°",
    scenes: &["sadeghi_11"],
    pictures: false,
    make,
};

const RADII_MM: [f64; 5] = [0.1, 0.2, 0.3, 0.4, 0.5];
const WAVELENGTH: f64 = 650.0;

/// The same drop as a sphere by Lorenz–Mie.
fn by_series(mut file: SceneFile) -> SceneFile {
    file.particle.shape = Some(Choice(ShapeName::Sphere));
    file.model.method = Some(Choice(Method::Mie));
    file
}

fn make(workshop: &Workshop) -> Result<Made, FigureError> {
    let scene = workshop.table("sadeghi_11")?;
    let theta = evenly(120.0, 150.0, 601);
    let (mut upper, mut lower, mut numbers) = (Vec::new(), Vec::new(), Vec::new());
    for mm in RADII_MM {
        let mut rays = scene.clone();
        rays.particle.radius_mm = Some(mm);
        let series = by_series(rays.clone());
        let mut strips = Vec::new();
        let mut smooth = Vec::new();
        for (name, file) in [("(a) rays", &rays), ("(b) Mie", &series)] {
            let xyz = of_table(&simulate::table(&file.validate()?)?, &theta)?;
            strips.push(strip(name, &xyz, exposure(&xyz)));
            let mut one = file.clone();
            one.light.wavelengths_nm = Some(Grid::List(vec![WAVELENGTH]));
            let table = simulate::table(&one.validate()?)?;
            let out: Vec<f64> = theta.iter().map(|t| t.to_radians()).collect();
            let nm = WAVELENGTH * 1e-9;
            let values = section(&table);
            smooth.push(smooth_over_sun(
                &table.header.axes.theta,
                &values,
                nm,
                SUN_ANGULAR_RADIUS,
                &out,
            ));
        }
        let [ours, exact] = [&smooth[0], &smooth[1]];
        let error: Vec<f64> = ours.iter().zip(exact).map(|(a, b)| 100.0 * (a / b - 1.0)).collect();
        let named = |name: &str, colour, y: &[f64]| {
            Curve::new(name, colour, theta.iter().copied().zip(y.iter().copied()))
        };
        upper.push(Panel::Chart(Chart {
            title: format!("{mm} mm"),
            x: Axis::linear("scattering angle (°)", 120.0, 150.0),
            y: Axis::logarithmic("scattered light (sr⁻¹)", 2e-3, 2.0),
            curves: vec![named("Lorenz–Mie", BLACK, exact), named("rays", ORANGE, ours).dashed()],
            strips,
            ..Chart::default()
        }));
        lower.push(Panel::Chart(Chart {
            title: "rays less Lorenz–Mie".into(),
            x: Axis::linear("scattering angle (°)", 120.0, 150.0),
            y: Axis::linear("error (%)", -20.0, 20.0),
            curves: vec![named("", RED, &error)],
            ..Chart::default()
        }));
        let mean = (error.iter().map(|e| e * e).sum::<f64>() / error.len() as f64).sqrt();
        numbers.push(Number::alone(
            format!("difference, {mm} mm, root mean square 120 to 150°"),
            "%",
            mean,
        ));
        let shift = maximum(&theta, ours, 135.0, 146.0) - maximum(&theta, exact, 135.0, 146.0);
        numbers.push(Number::alone(
            format!("brightest angle of the primary, rays less Lorenz–Mie, {mm} mm"),
            "°",
            shift,
        ));
    }
    let panels = upper.into_iter().chain(lower).collect();
    let notes = [
        "Strips: 33 wavelengths, D65. Curves and errors: 650 nm. All with the sun's disc of 0.53°.",
    ];
    let title = "Rays beside Lorenz–Mie for five sizes";
    Ok(Made::new(sheet(title, 5, (400, 400), panels, &notes), numbers))
}
