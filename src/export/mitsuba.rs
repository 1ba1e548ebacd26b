//! Mitsuba 3: a folder with the spectral table, a Python plugin that renders it, and `tabphase`
//! strings for those who have no plugin.
//!
//! `tabphase` takes one curve on a grid uniform in cos θ from −1 to +1 (+1 forward); its first
//! cells are degrees wide, so the forward peak must be cut. The plugin takes the mean over azimuth
//! too (drops in air turn with the sun, but a medium's phase function in Mitsuba knows only the
//! angle between two directions), at every wavelength: colours come out.

use super::average::Averaged;

/// The plugin.
pub const PLUGIN: &str = include_str!("mitsuba_plugin.py");
/// A scene that renders the bow.
pub const SCENE: &str = include_str!("mitsuba_scene.py");

/// `phase.csv`: first line the wavelengths (nm), then per line cos θ (ascending, uniform in θ) and
/// P11 in sr⁻¹ per wavelength.
pub fn spectral_table(averaged: &Averaged) -> String {
    let mut text = String::from("cos_theta");
    for curve in &averaged.curves {
        text.push_str(&format!(",{}", curve.wavelength * 1e9));
    }
    text.push('\n');
    for (i, theta) in averaged.theta.iter().enumerate().rev() {
        text.push_str(&format!("{:.17}", theta.cos()));
        for curve in &averaged.curves {
            text.push_str(&format!(",{:e}", curve.elements[0][i]));
        }
        text.push('\n');
    }
    text
}

/// `tabphase.txt`: per wavelength a line `wavelength_nm: v1, v2, …` with `count` values uniform in
/// cos θ from −1 to +1, each the mean over its cell's neighbourhood by linear interpolation.
pub fn tabphase(averaged: &Averaged, count: usize) -> String {
    let count = count.max(2);
    let mut text = format!(
        "# forward peak cut below {} degree; grid uniform in cos(theta) from -1 to 1\n",
        averaged.cap.to_degrees()
    );
    for curve in &averaged.curves {
        let cosine = |i: usize| -1.0 + 2.0 * i as f64 / (count - 1) as f64;
        let values: Vec<String> = (0..count)
            .map(|i| format!("{:.7e}", averaged.at(curve, 0, cosine(i).clamp(-1.0, 1.0).acos())))
            .collect();
        text.push_str(&format!("{}: {}\n", curve.wavelength * 1e9, values.join(", ")));
    }
    text
}
