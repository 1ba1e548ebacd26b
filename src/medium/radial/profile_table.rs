//! A profile from a file: rows of r, n and, if there, k; r from 0 to 1, ascending.

use super::profile::Profile;
use crate::math::monotone::MonotoneCurve;
use crate::medium::error::{MediumError, file_error};
use crate::medium::read::text;
use std::path::Path;
use std::sync::Arc;

/// Radii at the ends may be off by this.
const SLACK: f64 = 1e-9;

/// Read a profile.
///
/// # Errors
/// With the line, what stands there, and what is accepted.
pub(super) fn read(path: &Path) -> Result<Profile, MediumError> {
    let text = text::read(path)?.text;
    let fail = |line: Option<usize>, message: String| file_error(path, line, message);
    let (mut radius, mut n, mut k): (Vec<f64>, Vec<f64>, Vec<f64>) = Default::default();
    let mut columns = None;
    for (i, line) in text.lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let words: Vec<&str> = line
            .split(|c: char| c == ',' || c == ';' || c.is_whitespace())
            .filter(|word| !word.is_empty())
            .collect();
        let numbers: Option<Vec<f64>> =
            words.iter().map(|word| word.parse().ok().filter(|v: &f64| v.is_finite())).collect();
        let Some(numbers) = numbers else {
            // One line of names may stand above the numbers.
            if radius.is_empty() && columns.is_none() {
                columns = Some(words.len());
                continue;
            }
            return Err(fail(Some(i + 1), format!("\"{line}\": expected the numbers r, n, k")));
        };
        if !(2..=3).contains(&numbers.len()) || columns.is_some_and(|c| c != numbers.len()) {
            let message = format!("{} numbers: expected r, n or r, n, k in every row", words.len());
            return Err(fail(Some(i + 1), message));
        }
        columns = Some(numbers.len());
        if let Some(before) = radius.last().filter(|before| numbers[0] <= **before) {
            let message = format!("r = {} follows {before}: r must ascend", numbers[0]);
            return Err(fail(Some(i + 1), message));
        }
        radius.push(numbers[0]);
        n.push(numbers[1]);
        k.extend(numbers.get(2));
    }
    let ends = (radius.first().copied(), radius.last().copied());
    match ends {
        (Some(first), Some(last)) if first.abs() <= SLACK && (last - 1.0).abs() <= SLACK => {}
        _ => {
            let message = "r must go from 0 (centre) to 1 (surface), in at least two rows";
            return Err(fail(None, message.into()));
        }
    }
    if let Some(last) = radius.last_mut() {
        *last = 1.0;
    }
    let curve = |values: Vec<f64>| {
        let rows = "at least two rows of finite numbers";
        let curve = MonotoneCurve::new(radius.clone(), values);
        curve.map(Arc::new).ok_or_else(|| fail(None, rows.into()))
    };
    let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into());
    let k = if k.is_empty() { None } else { Some(curve(k)?) };
    Profile::Table { name, n: curve(n)?, k }.checked()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_and_their_faults() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("profile.csv");
        let read = |text: &str| {
            std::fs::write(&path, text).unwrap();
            read(&path).map_err(|error| error.to_string())
        };
        let profile = read("# lens\nr,n,k\n0,1.4,0\n0.5,1.3,1e-4\n1,1.2,0\n").unwrap();
        assert_eq!(profile.index(0.5), num_complex::Complex64::new(1.3, 1e-4));
        for (text, message) in [
            ("0 1.4\n0.6 1.3\n0.5 1.2\n1 1.2", "line 3: r = 0.5 follows 0.6"),
            ("0 1.4\n0.5 1.3", "from 0 (centre) to 1 (surface)"),
            ("0 1.4\n0.5 -1.3\n1 1", "n above 0"),
            ("0 1.4\n0.5 x\n1 1", "line 2"),
            ("0 1.4\n0.5 1.3 0\n1 1", "line 2: 3 numbers"),
            ("", "at least two rows"),
        ] {
            let error = read(text).unwrap_err();
            assert!(error.contains(message), "{text:?}: {error}");
        }
    }
}
