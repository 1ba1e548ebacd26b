//! Glass catalogues of Zemax (`.agf`): dispersion formula, range and internal transmission of each
//! glass.
//!
//! Lines begin with a keyword (*OpticStudio User Manual*, "Using Glass Catalogs"): `NM` name, number
//! of the formula, …, n_d, V_d; `CD` coefficients; `LD` shortest and longest wavelength, µm; `IT`
//! wavelength in µm, internal transmission, thickness in mm, so that `k = −λ ln T / 4πd`. All thirteen
//! formulas are forms of those in [`Formula`]. Indices are relative to air at the temperature of the
//! catalogue. A row with T = 0 bounds k from below only, and gives no k.

use crate::medium::data::column::Column;
use crate::medium::data::material::Material;
use crate::medium::data::samples::{Row, Samples};
use crate::medium::data::unit::Unit;
use crate::medium::dispersion::formula::Formula;
use crate::medium::error::{MediumError, file_error};
use crate::medium::read::text;
use crate::medium::spelling::nearest;
use std::path::Path;

/// One glass as the catalogue's lines give it.
#[derive(Default)]
struct Glass {
    name: String,
    line: usize,
    formula: Option<u32>,
    coefficients: Vec<f64>,
    range: Option<(f64, f64)>,
    transmission: Vec<Row>,
    fault: Option<(usize, String)>,
}

/// Reads a glass from a catalogue; a catalogue of one glass needs no name.
pub(in crate::medium) fn read(path: &Path, glass: Option<&str>) -> Result<Material, MediumError> {
    let text = text::read(path)?;
    let mut material = parse(&text.text, path, glass)?;
    material.notes.splice(0..0, text.note);
    Ok(material)
}

pub(in crate::medium) fn parse(
    text: &str,
    path: &Path,
    wanted: Option<&str>,
) -> Result<Material, MediumError> {
    let mut heading = String::new();
    let mut glasses: Vec<Glass> = Vec::new();
    for (number, words) in statements(text) {
        let Some((keyword, rest)) = words.split_first() else { continue };
        match (*keyword, glasses.last_mut()) {
            ("CC", None) => heading = rest.join(" "),
            ("NM", _) => glasses.push(Glass::named(rest, number)),
            (keyword, Some(glass)) => glass.line_of(keyword, rest, number),
            _ => {}
        }
    }
    choose(glasses, path, wanted)?.material(path, &heading)
}

/// The words of each statement with the number of its first line. Some catalogues break long ones:
/// a line that begins with a number goes on with the one before.
fn statements(text: &str) -> Vec<(usize, Vec<&str>)> {
    let mut all: Vec<(usize, Vec<&str>)> = Vec::new();
    for (i, line) in text.lines().enumerate() {
        let words = line.split_whitespace();
        let goes_on = line.split_whitespace().next().is_some_and(|w| w.parse::<f64>().is_ok());
        match all.last_mut() {
            Some((_, before)) if goes_on => before.extend(words),
            _ => all.push((i + 1, words.collect())),
        }
    }
    all
}

/// The glass of a name, in small letters or capitals.
fn choose(
    mut glasses: Vec<Glass>,
    path: &Path,
    wanted: Option<&str>,
) -> Result<Glass, MediumError> {
    let Some(wanted) = wanted else {
        return match (glasses.pop(), glasses.len()) {
            (Some(only), 0) => Ok(only),
            (Some(last), rest) => {
                let message = format!(
                    "{} glasses: say which, as in {}:{}, or {{ file = …, glass = \"{}\" }}",
                    rest + 1,
                    path.display(),
                    last.name,
                    last.name
                );
                Err(file_error(path, None, message))
            }
            (None, _) => Err(file_error(path, None, "no line NM: not a Zemax glass catalogue")),
        };
    };
    let lower = wanted.to_lowercase();
    if let Some(i) = glasses.iter().position(|g| g.name.to_lowercase() == lower) {
        return Ok(glasses.swap_remove(i));
    }
    let nearest = nearest(wanted, glasses.iter().map(|g| g.name.as_str()));
    let hint = nearest.map(|n| format!(", did you mean \"{n}\"?")).unwrap_or_default();
    let message = format!("no glass \"{wanted}\" among {}{hint}", glasses.len());
    Err(file_error(path, None, message))
}

impl Glass {
    fn named(words: &[&str], line: usize) -> Self {
        let name = words.first().map_or(String::new(), |w| (*w).to_string());
        // Some catalogues write 2 as 2.0.
        let formula = words.get(1).and_then(|w| w.parse::<f64>().ok()).map(|f| f as u32);
        Self { name, line, formula, ..Self::default() }
    }

    fn line_of(&mut self, keyword: &str, words: &[&str], line: usize) {
        if !["CD", "LD", "IT"].contains(&keyword) {
            return;
        }
        let numbers: Result<Vec<f64>, String> = words
            .iter()
            .map(|word| {
                let value = word.parse::<f64>().ok().filter(|v| v.is_finite());
                value.ok_or_else(|| format!("{keyword}: \"{word}\" is not a finite number"))
            })
            .collect();
        let numbers = match numbers {
            Ok(numbers) => numbers,
            Err(fault) => {
                self.fault.get_or_insert((line, fault));
                return;
            }
        };
        match (keyword, numbers.as_slice()) {
            ("CD", all) => self.coefficients = all.to_vec(),
            ("LD", &[from, to, ..]) if 0.0 < from && from < to => self.range = Some((from, to)),
            ("IT", &[um, share, mm, ..]) if um > 0.0 && mm > 0.0 && share > 0.0 => {
                let wavelength = Unit::Micrometre.to_metres(um);
                let k = -share.ln() * wavelength / (4.0 * std::f64::consts::PI * mm * 1e-3);
                let value = if share <= 1.0 {
                    Ok(k.max(0.0))
                } else {
                    Err(format!("internal transmission {share} must be 0 to 1"))
                };
                self.transmission.push(Row { line, wavelength: Some(wavelength), value });
            }
            _ => {}
        }
    }

    fn material(self, path: &Path, heading: &str) -> Result<Material, MediumError> {
        let fail = |message: String| file_error(path, Some(self.line), message);
        if let Some((line, fault)) = self.fault {
            return Err(file_error(path, Some(line), fault));
        }
        let number = self.formula.unwrap_or(0);
        let formula = formula(number, &self.coefficients)
            .ok_or_else(|| fail(format!("{}: formula {number}: expected 1 to 13", self.name)))?
            .map_err(|e| fail(format!("{}: {e}", self.name)))?;
        let (from, to) = self
            .range
            .ok_or_else(|| fail(format!("{}: no line LD with two ascending µm", self.name)))?;
        let range = (Unit::Micrometre.to_metres(from), Unit::Micrometre.to_metres(to));
        let file = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        let source = format!("{file}: {heading}");
        let mut material =
            Material::from_formula(&self.name, source.trim_end_matches(": "), formula, range);
        let k = Samples::new(path, Column::K, self.transmission, &mut material.notes)?;
        Ok(if k.is_empty() { material } else { material.with_extinction(k.curve()) })
    }
}

/// A formula by its number in the catalogue; `None` for a number that has none.
fn formula(number: u32, coefficients: &[f64]) -> Option<Result<Formula, MediumError>> {
    let c = |i: usize| coefficients.get(i).copied().unwrap_or(0.0);
    // n² = Σ c λ^p.
    let powers = |powers: &[i32]| {
        let mut all = vec![c(0)];
        all.extend(powers.iter().enumerate().flat_map(|(i, p)| [c(i + 1), f64::from(*p)]));
        Formula::new(3, all)
    };
    // n² = 1 + Σ K λ²/(λ² − L).
    let sellmeier = |terms: usize| {
        let pairs = (0..terms).flat_map(|i| [c(2 * i), c(2 * i + 1)]);
        Formula::new(2, std::iter::once(0.0).chain(pairs).collect())
    };
    // n² = a + b λ^p/(λ² − e^f) + g λ^q/(λ² − h^i) + r λ².
    let general = |a: f64, one: [f64; 4], two: [f64; 4], square: f64| {
        let mut all = vec![a];
        all.extend(one.iter().chain(&two));
        all.extend([square, 2.0]);
        Formula::new(4, all)
    };
    let none = [0.0, 0.0, 0.0, 1.0];
    Some(match number {
        1 => powers(&[2, -2, -4, -6, -8]),
        2 => sellmeier(3),
        3 => Formula::new(7, (0..6).map(c).collect()),
        4 => general(1.0 + c(0), [c(1), 2.0, c(2), 2.0], [c(3), 0.0, c(4), 2.0], 0.0),
        5 => Formula::new(5, vec![c(0), c(1), -1.0, c(2), -3.5]),
        6 => sellmeier(4),
        7 => general(c(0), [c(1), 0.0, c(2), 1.0], none, -c(3)),
        8 => general(c(0), [c(1), 2.0, c(2), 1.0], none, -c(3)),
        9 => general(c(0), [c(1), 2.0, c(2), 1.0], [c(3), 2.0, c(4), 1.0], 0.0),
        10 => powers(&[2, -2, -4, -6, -8, -10, -12]),
        11 => sellmeier(5),
        12 => powers(&[2, -2, -4, -6, -8, 4, 6]),
        13 => powers(&[2, 4, -2, -4, -6, -8, -10, -12]),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each number against its law in the manual, written out by hand.
    #[test]
    fn every_law_gives_what_the_manual_says() {
        let um: f64 = 0.6;
        let l = um * um;
        let c = [2.2, 0.011, 0.012, 0.0013, 0.0014, 0.00015, 0.00016, 0.000017, 0.00002];
        let h = 1.0 / (l - 0.028);
        let powers = |p: &[i32]| {
            (c[0] + p.iter().zip(&c[1..]).map(|(p, c)| c * um.powi(*p)).sum::<f64>()).sqrt()
        };
        let s = [1.0, 0.01, 0.2, 0.02, 0.9, 100.0, 0.05, 0.03, 0.04, 50.0];
        let sell = |terms: usize| {
            (1.0 + (0..terms).map(|i| s[2 * i] * l / (l - s[2 * i + 1])).sum::<f64>()).sqrt()
        };
        let cases: [(u32, &[f64], f64); 13] = [
            (1, &c[..6], powers(&[2, -2, -4, -6, -8])),
            (2, &s[..6], sell(3)),
            (
                3,
                &c[..6],
                c[0] + c[1] * h + c[2] * h * h + c[3] * l + c[4] * l * l + c[5] * l.powi(3),
            ),
            (
                4,
                &[1.1, 0.2, 0.15, 0.3, 9.0],
                (2.1 + 0.2 * l / (l - 0.0225) + 0.3 / (l - 81.0)).sqrt(),
            ),
            (5, &[1.5, 0.01, 0.002], 1.5 + 0.01 / um + 0.002 / um.powf(3.5)),
            (6, &s[..8], sell(4)),
            (7, &[2.2, 0.01, 0.02, 0.003], (2.2 + 0.01 / (l - 0.02) - 0.003 * l).sqrt()),
            (8, &[2.2, 0.01, 0.02, 0.003], (2.2 + 0.01 * l / (l - 0.02) - 0.003 * l).sqrt()),
            (
                9,
                &[2.2, 0.1, 0.02, 0.3, 90.0],
                (2.2 + 0.1 * l / (l - 0.02) + 0.3 * l / (l - 90.0)).sqrt(),
            ),
            (10, &c[..8], powers(&[2, -2, -4, -6, -8, -10, -12])),
            (11, &s, sell(5)),
            (12, &c[..8], powers(&[2, -2, -4, -6, -8, 4, 6])),
            (13, &c, powers(&[2, 4, -2, -4, -6, -8, -10, -12])),
        ];
        for (number, coefficients, expected) in cases {
            let found = formula(number, coefficients).unwrap().unwrap().index(um);
            assert!((found - expected).abs() < 1e-13, "formula {number}: {found} {expected}");
        }
        assert!(formula(14, &c).is_none());
    }

    const CATALOGUE: &str = "CC a maker\nNM F2 2 620364.360 1.62004 36.37 0 1\nGC leaded\n\
        CD 1.34533359 0.00997743871 0.209073176 0.0470450767\n0.937357162 111.886764 0 0\n\
        LD 0.32 2.5\nIT 0.32 0.0 25\nIT 0.4 0.985 25\nIT 0.7 0.998 25\n\
        NM X 2 0 1.5 60 0 1\nCD 1.2 a\nLD 0.3 2\n";

    #[test]
    fn glasses_are_chosen_by_name() {
        let read = |glass| parse(CATALOGUE, Path::new("m.agf"), glass);
        let glass = read(Some("f2")).unwrap();
        let index = glass.index(587.5618e-9).unwrap();
        assert!((index.re - 1.62004).abs() < 5e-6, "{index}");
        let k = -0.985_f64.ln() * 0.4e-6 / (4.0 * std::f64::consts::PI * 25e-3);
        assert!((glass.index(0.4e-6).unwrap().im - k).abs() < 1e-15);
        assert!(glass.index(0.35e-6).unwrap_err().to_string().contains("k of F2 (400 to 700 nm)"));
        for (glass, expected) in [
            (None, "2 glasses: say which"),
            (Some("F3"), "no glass \"F3\" among 2, did you mean \"F2\"?"),
            (Some("X"), "line 11: CD: \"a\" is not a finite number"),
        ] {
            let found = read(glass).unwrap_err().to_string();
            assert!(found.contains(expected), "{found}");
        }
    }
}
