//! Ranges of radii and angles as they are typed.

use super::usage;

/// Three numbers of `A:B:C`.
fn triple(flag: &str, text: &str, form: &str) -> anyhow::Result<[f64; 3]> {
    let numbers: Vec<f64> = text.split(':').filter_map(|part| part.trim().parse().ok()).collect();
    match numbers.as_slice() {
        &[a, b, c] if text.split(':').count() == 3 && a.is_finite() && b.is_finite() => {
            Ok([a, b, c])
        }
        _ => Err(usage(format!("{flag} = \"{text}\": expected {form}"))),
    }
}

/// Radii in metres.
pub fn radii(text: &str, linear: bool) -> anyhow::Result<Vec<f64>> {
    let form =
        "FROM:TO:COUNT in mm, such as 0.01:1:400, with 0 < FROM <= TO and 1 <= COUNT <= 10000";
    let [from, to, count] = triple("--radius-mm", text, form)?;
    let whole = (1.0..=10_000.0).contains(&count) && count.fract() == 0.0;
    if !(from > 0.0 && to >= from && whole && (count > 1.0 || from == to)) {
        return Err(usage(format!("--radius-mm = \"{text}\": expected {form}")));
    }
    let steps = (count - 1.0).max(1.0);
    let place = |i: usize| i as f64 / steps;
    let radius = |share: f64| {
        if linear { from + share * (to - from) } else { from * (to / from).powf(share) }
    };
    Ok((0..count as usize).map(|i| 1e-3 * radius(place(i))).collect())
}

/// Angles in radians.
pub fn angles(text: &str) -> anyhow::Result<Vec<f64>> {
    let form = "FROM:TO:STEP in degrees, such as 120:150:0.075, with 0 <= FROM < TO <= 180";
    let [from, to, step] = triple("--theta", text, form)?;
    let count = ((to - from) / step + 1e-9).floor();
    if !(from >= 0.0 && to > from && to <= 180.0 && step > 0.0 && (1.0..=1e6).contains(&count)) {
        return Err(usage(format!("--theta = \"{text}\": expected {form}")));
    }
    Ok((0..=count as usize).map(|i| (from + step * i as f64).to_radians()).collect())
}
