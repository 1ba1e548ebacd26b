//! Fig. 4: solutions of dyes, by band models, and a dye that is measured.

use crate::figures::figure::Figure;
use crate::figures::media::{curve, medium};
use crate::figures::papers;
use crate::figures::plain::{BLACK, PALETTE, evenly, maximum, points, sheet};
use crate::figures::{FigureError, Made, Number, Workshop};
use crate::render::plots::sheet::{Axis, Chart, Curve, Panel};

pub(super) const FIG_4: Figure = Figure {
    name: "weidlich-4",
    source: papers::ANOMALOUS_DISPERSION,
    caption: "Fig. 4: n and k of solutions of rose bengal of 10, 3.3 and 1 % in water (a band model), of fuchsine in alcohol \
              (a band model), and of a film of rhodamine 6G (measured)",
    compare: "n rises towards long waves within the band, the more the stronger the solution; k of 10 % reaches 0.04; \
              water's n is the dashed line. The dyes' bands are models, not van der Plaats' data",
    scenes: &[],
    pictures: false,
    make,
};

/// The paper's concentrations.
const ROSE_BENGAL: [(&str, f64); 3] = [("10 %", 0.10), ("3.3 %", 0.033), ("1 %", 0.01)];
/// The end of the paper's axis of k, which its strongest curve reaches.
const HIGHEST: f64 = 0.04;

fn make(_: &Workshop) -> Result<Made, FigureError> {
    let nm = evenly(400.0, 700.0, 601);
    let (mut indices, mut extinctions, mut numbers) = (Vec::new(), Vec::new(), Vec::new());
    for ((name, fraction), colour) in ROSE_BENGAL.into_iter().zip(PALETTE) {
        let solution = medium(&format!(
            "{{ solute = \"rose-bengal\", fraction = {fraction}, host = \"water\" }}"
        ))?;
        let (n, k) = curve(&solution, &nm)?;
        if fraction == 0.10 {
            let most = k.iter().copied().fold(0.0, f64::max);
            numbers.push(Number::beside(
                "k of 10 % rose bengal at its band (end of the axis)",
                "",
                HIGHEST,
                most,
            ));
        }
        let rise = n.iter().copied().fold(0.0, f64::max) - n.iter().copied().fold(9.0, f64::min);
        numbers.push(Number::alone(format!("span of n from 400 to 700 nm, {name}"), "", rise));
        indices.push(Curve::new(&format!("rose bengal, {name}"), colour, points(&nm, &n)));
        extinctions.push(Curve::new(&format!("rose bengal, {name}"), colour, points(&nm, &k)));
    }
    let (n, _) = curve(&medium("water")?, &nm)?;
    indices.push(Curve::new("water", BLACK, points(&nm, &n)).dashed());
    let (mut others, mut bands) = (Vec::new(), Vec::new());
    for (name, spec, colour) in [
        (
            "fuchsine, 19 % in alcohol (model)",
            "{ solute = \"fuchsine\", fraction = 0.19, host = \"ethanol\" }",
            PALETTE[3],
        ),
        ("rhodamine 6G, film (measured)", "rhodamine6g", PALETTE[4]),
    ] {
        let (n, k) = curve(&medium(spec)?, &nm)?;
        numbers.push(Number::alone(
            format!("{name}: strongest at"),
            "nm",
            maximum(&nm, &k, 400.0, 700.0),
        ));
        others.push(Curve::new(name, colour, points(&nm, &n)));
        bands.push(Curve::new(name, colour, points(&nm, &k)));
    }
    let chart = |title: &str, y: Axis, curves| {
        Panel::Chart(Chart {
            title: title.into(),
            x: Axis::linear("wavelength (nm)", 400.0, 700.0),
            y,
            curves,
            ..Chart::default()
        })
    };
    let panels = vec![
        chart("(a) rose bengal in water, model: n", Axis::linear("n", 1.31, 1.37), indices),
        chart("(b) rose bengal in water, model: k", Axis::linear("k", 0.0, 0.042), extinctions),
        chart("fuchsine and rhodamine: n", Axis::linear("n", 1.1, 2.6), others),
        chart("fuchsine and rhodamine: k", Axis::linear("k", 0.0, 0.9), bands),
    ];
    let notes = [
        "Rose bengal and fuchsine: sums of Gaussian bands chosen for this program, n by Kramers–Kronig; the height of rose bengal's is set by the paper's axis.",
        "Rhodamine 6G: measured by Seçkin et al. 2023.",
    ];
    Ok(Made::new(sheet("Dyes", 2, (620, 400), panels, &notes), numbers))
}
