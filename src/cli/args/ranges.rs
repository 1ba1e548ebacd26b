//! Lists as they are typed: values and ranges with commas between, and the spans `FROM:TO`.
//!
//! Every range is a [`gonio::scene::Range`]; axes of scenes are [`gonio::scene::Grid`]s.

use crate::cli::failure::{Failure, Result};
use gonio::medium::wavelength_of_ghz;
use gonio::scene::{Range, Third};

/// What stands between two commas: a value, or a range.
enum Word {
    Value(f64),
    Range(Range),
}

/// A word whose third number is `usual` where no letter tells; else the part that is no number, or all of it.
fn word(text: &str, usual: fn(f64) -> Third) -> Result<Word, &str> {
    let parts: Vec<&str> = text.split(':').collect();
    let number = |part: &str| part.trim().parse::<f64>().ok().filter(|v| v.is_finite());
    match parts[..] {
        [value] => number(value).map(Word::Value).ok_or(value),
        [from, to, third] => Range::parse([from, to, third], usual).map(Word::Range),
        _ => Err(text),
    }
}

/// Most scattering angles of `gonio scatter`; more is surely a slip of the step.
const MOST_ANGLES: f64 = 1e7;

/// Whether a range has a whole number of values, one after the other.
fn leads_on(range: &Range) -> bool {
    match range.third {
        Third::Count(count) => count.fract() == 0.0 && (count > 1.0 || range.from == range.to),
        Third::Step(step) => step != 0.0,
    }
}

/// Scattering angles, degrees: a comma list of values and FROM:TO:STEP ranges, order kept.
pub fn scattering_angles(text: &str) -> Result<Vec<f64>, String> {
    let accepted =
        "a comma list of angles 0 to 180 and from:to:step or from:to:nCOUNT ranges is accepted";
    let wrong = |word: &str| format!("--theta {word:?}: {accepted}");
    let mut angles = Vec::new();
    for text in text.split(',') {
        match word(text, Third::Step).map_err(|_| wrong(text))? {
            Word::Value(angle) => angles.push(angle),
            Word::Range(range) if range.steps() >= 0.0 && leads_on(&range) => {
                let count = range.steps();
                if count > MOST_ANGLES {
                    return Err(format!("--theta {text:?}: {count:.1e} angles; at most 1e7"));
                }
                angles.extend(range.values());
            }
            Word::Range(_) => return Err(wrong(text)),
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
        let accepted =
            "a comma list of numbers above 0 and FROM:TO:COUNT or FROM:TO:sSTEP ranges is accepted";
        Failure::usage(format!("{flag} {word:?}: {accepted}"))
    };
    let mut all = Vec::new();
    for text in text.split(',') {
        match word(text, Third::Count).map_err(|_| wrong(text))? {
            Word::Value(value) if value > 0.0 => all.push(value),
            Word::Range(range)
                if range.from > 0.0
                    && range.to > 0.0
                    && leads_on(&range)
                    && (1.0..MOST_VALUES).contains(&range.steps()) =>
            {
                all.extend(range.values());
            }
            _ => return Err(wrong(text)),
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
    let range = "expected FROM:TO:STEP or FROM:TO:nCOUNT with FROM below TO";
    let mut all = Vec::new();
    for item in text.split(',') {
        if ![1, 3].contains(&item.split(':').count()) {
            return Err(format!("\"{item}\": expected a value or FROM:TO:STEP"));
        }
        match word(item, Third::Step).map_err(|part| format!("\"{part}\": {positive}"))? {
            Word::Value(value) if value > 0.0 => all.push(value),
            Word::Range(Range { from, to, .. }) if from <= 0.0 || to <= 0.0 => {
                let part = item.split(':').nth(usize::from(from > 0.0)).unwrap_or_default();
                return Err(format!("\"{part}\": {positive}"));
            }
            Word::Range(found) => {
                let rises = found.step() > 0.0 || found.from == found.to;
                if !(leads_on(&found) && rises && (0.0..MOST_WAVELENGTHS).contains(&found.steps()))
                {
                    return Err(format!("\"{item}\": {range}"));
                }
                all.extend(found.values());
            }
            Word::Value(_) => return Err(format!("\"{item}\": {positive}")),
        }
    }
    Ok(Wavelengths(all))
}

/// The one range of a flag.
fn range(flag: &str, text: &str, usual: fn(f64) -> Third, form: &str) -> Result<Range> {
    match word(text, usual) {
        Ok(Word::Range(range)) => Ok(range),
        _ => Err(Failure::usage(format!("{flag} = \"{text}\": expected {form}"))),
    }
}

/// Radii of a Lee diagram.
pub struct Radii {
    /// Ascending.
    pub metres: Vec<f64>,
    /// Whether they are evenly spaced in their logarithm.
    pub logarithmic: bool,
}

/// Radii of a Lee diagram: FROM:TO:COUNT in millimetres, log-spaced or even; FROM:TO:sSTEP, even.
pub fn radii(text: &str, linear: bool) -> Result<Radii> {
    let form = "FROM:TO:COUNT in mm, such as 0.01:1:400, or FROM:TO:sSTEP, with 0 < FROM <= TO and 1 <= COUNT <= 10000";
    let range = range("--radius-mm", text, Third::Count, form)?;
    let (Range { from, to, .. }, steps) = (range, range.steps());
    if !(from > 0.0 && to >= from && leads_on(&range) && (0.0..10_000.0).contains(&steps)) {
        return Err(Failure::usage(format!("--radius-mm = \"{text}\": expected {form}")));
    }
    let logarithmic = !linear && matches!(range.third, Third::Count(_));
    let place = |i: usize| i as f64 / steps.max(1.0);
    let metres = match logarithmic {
        true => (0..=steps as usize).map(|i| 1e-3 * (from * (to / from).powf(place(i)))).collect(),
        false => range.values().map(|mm| 1e-3 * mm).collect(),
    };
    Ok(Radii { metres, logarithmic })
}

/// Scattering angles of a Lee diagram, in radians: FROM:TO:STEP in degrees.
pub fn diagram_angles(text: &str) -> Result<Vec<f64>> {
    let form = "FROM:TO:STEP in degrees, such as 120:150:0.075, or FROM:TO:nCOUNT, with 0 <= FROM < TO <= 180";
    let range = range("--theta", text, Third::Step, form)?;
    let Range { from, to, .. } = range;
    let rises = from >= 0.0 && to > from && to <= 180.0 && range.step() > 0.0;
    if !(rises && leads_on(&range) && (1.0..=1e6).contains(&range.steps())) {
        return Err(Failure::usage(format!("--theta = \"{text}\": expected {form}")));
    }
    Ok(range.values().map(f64::to_radians).collect())
}

/// Two different angles, degrees: FROM:TO within 0 to 180, in either order.
pub fn angle_span(text: &str) -> Result<(f64, f64), String> {
    let numbers: Result<Vec<f64>, _> = text.split(':').map(|part| part.trim().parse()).collect();
    match numbers.as_deref() {
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

    /// Numbers of values where steps are usual, and the reverse.
    #[test]
    fn a_letter_tells_what_the_third_number_is() {
        assert_eq!(scattering_angles("120:150:n301"), scattering_angles("120:150:0.1"));
        assert_eq!(wavelengths("400:700:n4").unwrap().0, [400.0, 500.0, 600.0, 700.0]);
        assert_eq!(positive_range("--x", "1:2:s0.5").unwrap(), [1.0, 1.5, 2.0]);
        assert_eq!(diagram_angles("120:150:n3").unwrap(), diagram_angles("120:150:15").unwrap());
        let steps = radii("0.1:0.3:s0.1", false).unwrap();
        assert!(!steps.logarithmic && steps.metres.len() == 3);
        assert!((steps.metres[1] - 2e-4).abs() < 1e-18);
        assert!(scattering_angles("120:150:n2.5").is_err() && radii("0.1:1:n1", false).is_err());
        assert!(wavelengths("700:400:n4").is_err() && diagram_angles("150:120:n3").is_err());
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
        let radii = radii("0.01:1:3", false).unwrap().metres;
        assert!((radii[1] - 1e-4).abs() < 1e-18 && radii.len() == 3);
        assert_eq!(angle_span("150:120"), Ok((150.0, 120.0)));
        assert!(angle_span("150:150").is_err() && angle_span("1:x").is_err());
    }
}
