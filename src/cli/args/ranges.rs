//! Ranges and lists as they are typed: `FROM:TO:STEP`, `FROM:TO:COUNT`, `FROM:TO`, and commas between.
//!
//! Axes of scenes (`FROM:TO:COUNT` or a list) are [`gonio::scene::Grid`]s.

use crate::cli::failure::{Failure, Result};
use gonio::medium::wavelength_of_ghz;

/// Shares of a step by which rounding may miss the last value: 380:780:0.1 shall hold 780.
const ROUNDING: (f64, f64) = (1e-12, 1e-9);

/// The finite numbers between colons; else the part that is none.
fn numbers(text: &str) -> Result<Vec<f64>, &str> {
    let number = |part: &str| part.trim().parse::<f64>().ok().filter(|v| v.is_finite());
    text.split(':').map(|part| number(part).ok_or(part)).collect()
}

/// Number of steps from one value to another; below 0 or no number where they lead away.
fn steps(from: f64, to: f64, step: f64) -> f64 {
    ((to - from) / step * (1.0 + ROUNDING.0) + ROUNDING.1).floor()
}

/// The values of a range, both ends in.
fn values(from: f64, step: f64, steps: f64) -> impl Iterator<Item = f64> {
    (0..=steps as usize).map(move |i| from + i as f64 * step)
}

/// Most scattering angles of `gonio scatter`; more is surely a slip of the step.
const MOST_ANGLES: f64 = 1e7;

/// Scattering angles, degrees: a comma list of values and FROM:TO:STEP ranges, order kept.
pub fn scattering_angles(text: &str) -> Result<Vec<f64>, String> {
    let accepted = "a comma list of angles 0 to 180 and from:to:step ranges is accepted";
    let wrong = |word: &str| format!("--theta {word:?}: {accepted}");
    let mut angles = Vec::new();
    for word in text.split(',') {
        match numbers(word).map_err(|_| wrong(word))?[..] {
            [angle] => angles.push(angle),
            [from, to, step] if step != 0.0 && (to - from) * step >= 0.0 => {
                let count = (to - from) / step;
                if count > MOST_ANGLES {
                    return Err(format!("--theta {word:?}: {count:.1e} angles; at most 1e7"));
                }
                angles.extend(values(from, step, steps(from, to, step)));
            }
            _ => return Err(wrong(word)),
        }
    }
    // from + i·step may pass 180 by a rounding
    for angle in &mut angles {
        if !(*angle >= -1e-9 && *angle <= 180.0 + 1e-9) {
            return Err(format!("--theta {angle}: {accepted}"));
        }
        *angle = angle.clamp(0.0, 180.0);
    }
    Ok(angles)
}

/// Frequencies in GHz as wavelengths: a comma list of values and FROM:TO:STEP ranges.
pub fn frequencies(text: &str) -> Result<Wavelengths, String> {
    let ghz = wavelengths(text).map_err(|error| error.replace("nanometres", "GHz"))?;
    Ok(Wavelengths(ghz.0.into_iter().map(|ghz| 1e9 * wavelength_of_ghz(ghz)).collect()))
}

/// Most values of a list.
const MOST_VALUES: f64 = 1e5;

/// Positive numbers: a comma list of values and FROM:TO:COUNT ranges, evenly spaced.
pub fn positive_range(flag: &str, text: &str) -> Result<Vec<f64>> {
    let wrong = |word: &str| {
        let accepted = "a comma list of numbers above 0 and FROM:TO:COUNT ranges is accepted";
        Failure::usage(format!("{flag} {word:?}: {accepted}"))
    };
    let mut all = Vec::new();
    for word in text.split(',') {
        match numbers(word).map_err(|_| wrong(word))?[..] {
            [value] if value > 0.0 => all.push(value),
            [from, to, count]
                if from > 0.0
                    && to > 0.0
                    && (2.0..=MOST_VALUES).contains(&count)
                    && count.fract() == 0.0 =>
            {
                let step = (to - from) / (count - 1.0);
                all.extend(values(from, step, count - 1.0));
            }
            _ => return Err(wrong(word)),
        }
    }
    Ok(all)
}

/// So many positive numbers, separated by commas.
pub fn positive_list<const N: usize>(flag: &str, text: &str) -> Result<[f64; N]> {
    let number = |word: &str| word.trim().parse::<f64>().ok().filter(|v| v.is_finite() && *v > 0.0);
    let found: Option<Vec<f64>> = text.split(',').map(number).collect();
    found.and_then(|list| list.try_into().ok()).ok_or_else(|| {
        Failure::usage(format!(
            "{flag} {text:?}: {N} numbers above 0, separated by commas, are accepted"
        ))
    })
}

/// Wavelengths in nanometres, in the order given.
#[derive(Clone, Debug, PartialEq)]
pub struct Wavelengths(pub Vec<f64>);

/// Most wavelengths of one call.
const MOST_WAVELENGTHS: f64 = 1e6;

/// Wavelengths: a comma list of values and FROM:TO:STEP ranges.
pub fn wavelengths(text: &str) -> Result<Wavelengths, String> {
    let positive = "expected a positive number of nanometres";
    let mut all = Vec::new();
    for item in text.split(',') {
        let parts = item.split(':').count();
        if parts != 1 && parts != 3 {
            return Err(format!("\"{item}\": expected a value or FROM:TO:STEP"));
        }
        let found = numbers(item).map_err(|part| format!("\"{part}\": {positive}"))?;
        if let Some(at) = found.iter().position(|v| *v <= 0.0) {
            let part = item.split(':').nth(at).unwrap_or_default();
            return Err(format!("\"{part}\": {positive}"));
        }
        match found[..] {
            [from, to, step] => {
                let count = steps(from, to, step);
                if !(0.0..MOST_WAVELENGTHS).contains(&count) {
                    return Err(format!("\"{item}\": expected FROM:TO:STEP with FROM below TO"));
                }
                all.extend(values(from, step, count));
            }
            _ => all.extend(found),
        }
    }
    Ok(Wavelengths(all))
}

/// Three numbers of a flag's `A:B:C`.
fn triple(flag: &str, text: &str, form: &str) -> Result<[f64; 3]> {
    let found = numbers(text).ok().and_then(|found| <[f64; 3]>::try_from(found).ok());
    found.ok_or_else(|| Failure::usage(format!("{flag} = \"{text}\": expected {form}")))
}

/// Radii of a Lee diagram, in metres: FROM:TO:COUNT in millimetres, log-spaced or even.
pub fn radii(text: &str, linear: bool) -> Result<Vec<f64>> {
    let form =
        "FROM:TO:COUNT in mm, such as 0.01:1:400, with 0 < FROM <= TO and 1 <= COUNT <= 10000";
    let [from, to, count] = triple("--radius-mm", text, form)?;
    let whole = (1.0..=10_000.0).contains(&count) && count.fract() == 0.0;
    if !(from > 0.0 && to >= from && whole && (count > 1.0 || from == to)) {
        return Err(Failure::usage(format!("--radius-mm = \"{text}\": expected {form}")));
    }
    let steps = (count - 1.0).max(1.0);
    let place = |i: usize| i as f64 / steps;
    let radius = |share: f64| {
        if linear { from + share * (to - from) } else { from * (to / from).powf(share) }
    };
    Ok((0..count as usize).map(|i| 1e-3 * radius(place(i))).collect())
}

/// Scattering angles of a Lee diagram, in radians: FROM:TO:STEP in degrees.
pub fn diagram_angles(text: &str) -> Result<Vec<f64>> {
    let form = "FROM:TO:STEP in degrees, such as 120:150:0.075, with 0 <= FROM < TO <= 180";
    let [from, to, step] = triple("--theta", text, form)?;
    let count = steps(from, to, step);
    if !(from >= 0.0 && to > from && to <= 180.0 && step > 0.0 && (1.0..=1e6).contains(&count)) {
        return Err(Failure::usage(format!("--theta = \"{text}\": expected {form}")));
    }
    Ok(values(from, step, count).map(f64::to_radians).collect())
}

/// Two different angles, degrees: FROM:TO within 0 to 180, in either order.
pub fn angle_span(text: &str) -> Result<(f64, f64), String> {
    match numbers(text).as_deref() {
        Ok(&[from, to]) if [from, to].iter().all(|v| (0.0..=180.0).contains(v)) && from != to => {
            Ok((from, to))
        }
        _ => Err(format!("{text:?} is no FROM:TO within 0 to 180, such as 120:150")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_the_contract() {
        let theta = scattering_angles("10,120:150:0.1,0").unwrap();
        assert_eq!((theta.len(), theta[0], theta[302]), (303, 10.0, 0.0));
        assert!((theta[301] - 150.0).abs() < 1e-9);
        assert_eq!(scattering_angles("3:1:-1").unwrap(), [3.0, 2.0, 1.0]);
        assert!(scattering_angles("190").is_err() && scattering_angles("0:180:0").is_err());
    }

    /// Both ends are in, whatever the step's rounding.
    #[test]
    fn both_ends_are_in() {
        let Wavelengths(all) = wavelengths("380:780:0.1,400").unwrap();
        assert_eq!((all.len(), all[4001]), (4002, 400.0));
        assert!((all[4000] - 780.0).abs() < 1e-9);
        assert!(wavelengths("700:400:5").is_err() && wavelengths("1:2").is_err());
        let angles = diagram_angles("120:150:0.075").unwrap();
        assert_eq!(angles.len(), 401);
        let radii = radii("0.01:1:3", false).unwrap();
        assert!((radii[1] - 1e-4).abs() < 1e-18 && radii.len() == 3);
        assert_eq!(angle_span("150:120"), Ok((150.0, 120.0)));
        assert!(angle_span("150:150").is_err() && angle_span("1:x").is_err());
    }
}
