//! Fig. 9: one drop by rays, with interference, with the filter, by this engine, and by Lorenz–Mie.

use super::spheres::bows_of_rays;
use super::strips::{exposure, of_table, strip};
use crate::figures::figure::Figure;
use crate::figures::papers;
use crate::figures::plain::{BLACK, BLUE, GREEN, ORANGE, PURPLE, evenly, maximum, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::phase_table::PhaseTable;
use crate::render::plots::sheet::{Axis, Chart, Curve, Panel};
use crate::scene::{Choice, Diffraction, Grid, Interference, Method, Orders, SceneFile};
use crate::simulate;
use std::f64::consts::PI;

pub(super) const FIG_9: Figure = Figure {
    name: "sadeghi-9",
    source: papers::RAINBOWS,
    caption: "Fig. 9: a spherical drop of 0.4 mm: dispersion alone, with interference, with the filter in place of \
              diffraction, Lorenz–Mie theory, and this engine",
    compare: "Rays alone have sharp edges and no supernumeraries; interference brings them; the filter takes the edge's \
              peak away, and errs in the dark band; Lorenz–Mie is brightest near 138.5° in red light",
    scenes: &["sadeghi_9"],
    pictures: false,
    make,
};

/// How each stage is computed.
const STAGES: [(&str, [u8; 3]); 5] = [
    ("rays", PURPLE),
    ("with interference", BLUE),
    ("with the filter", GREEN),
    ("this engine", ORANGE),
    ("Lorenz–Mie", BLACK),
];
/// The curve's wavelength, nm, and the paper's brightest angle there.
const WAVELENGTH: f64 = 650.0;
const BRIGHTEST: f64 = 138.5;

/// The scene of a stage.
fn staged(mut file: SceneFile, stage: usize) -> SceneFile {
    let model = &mut file.model;
    model.method = Some(Choice(if stage == 4 { Method::Mie } else { Method::Rays }));
    if stage < 3 {
        model.orders = Some(Orders::List((0..=3).collect()));
        let filtered = if stage == 2 { Diffraction::Gaussian } else { Diffraction::None };
        model.diffraction = Some(Choice(filtered));
        model.interference = (stage == 0).then_some(Interference::Powers);
    } else {
        model.rays_across = None;
    }
    file
}

/// Differential cross-section over the shadow's area, sr⁻¹, at one wavelength.
pub(super) fn section(table: &PhaseTable) -> Vec<f64> {
    let slab = &table.slabs[0];
    let scale = slab.scattering_cross_section / (PI * table.header.radius.powi(2));
    let values = slab.values.index_axis(ndarray::Axis(0), 0);
    values.column(0).iter().map(|&v| f64::from(v) * scale).collect()
}

fn make(workshop: &Workshop) -> Result<Made, FigureError> {
    let scene = workshop.table("sadeghi_9")?;
    let theta = evenly(120.0, 150.0, 601);
    let (mut strips, mut curves, mut numbers) = (Vec::new(), Vec::new(), Vec::new());
    let mut sections = Vec::new();
    let mut fine = Vec::new();
    for (stage, (name, colour)) in STAGES.into_iter().enumerate() {
        let file = staged(scene.clone(), stage);
        let colours = simulate::table(&file.validate()?)?;
        let xyz = of_table(&colours, &theta)?;
        strips.push(strip(name, &xyz, exposure(&xyz)));
        let mut one = file;
        one.light.wavelengths_nm = Some(Grid::List(vec![WAVELENGTH]));
        let one = simulate::table(&one.validate()?)?;
        fine = one.header.axes.theta.iter().map(|t| t.to_degrees()).collect();
        let values = section(&one);
        let points = fine.iter().copied().zip(values.iter().copied());
        curves.push(Curve::new(name, colour, points).thin());
        sections.push(values);
    }
    let exact = sections.pop().unwrap_or_default();
    let brightest = maximum(&fine, &exact, 136.0, 142.0);
    numbers.push(Number::beside("brightest by Lorenz–Mie, 650 nm", "°", BRIGHTEST, brightest));
    for (values, (name, _)) in sections.iter().zip(STAGES) {
        for (from, to, place) in
            [(138.0, 146.0, "within the primary"), (131.0, 136.0, "in the dark band")]
        {
            let inside = || (0..fine.len()).filter(|&i| (from..to).contains(&fine[i]));
            let power: f64 = inside().map(|i| exact[i].powi(2)).sum();
            let off: f64 = inside().map(|i| (values[i] - exact[i]).powi(2)).sum();
            let words = format!("{name}: error {place} (root mean square over that of Lorenz–Mie)");
            numbers.push(Number::alone(words, "", (off / power).sqrt()));
        }
    }
    let chart = Chart {
        title:
            "drop of 0.4 mm; strips: 33 wavelengths, D65, sun's disc; curves: 650 nm, point source"
                .into(),
        x: Axis::linear("scattering angle (°)", 120.0, 150.0),
        y: Axis::logarithmic("scattered light over the shadow's (sr⁻¹)", 2e-4, 20.0),
        curves,
        strips,
        marks: bows_of_rays(1.3314),
        ..Chart::default()
    };
    let sheet = sheet("From rays to the rainbow", 1, (1000, 760), vec![Panel::Chart(chart)], &[]);
    Ok(Made::new(sheet, numbers))
}
