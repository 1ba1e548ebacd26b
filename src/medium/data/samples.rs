//! The rows of one column of optical data: sorted, merged, and honest about those that are unsound.
//!
//! One odd row does not condemn a file. Rows at one wavelength are merged (their mean, which is
//! noted where they differ), a k just below zero counts as zero (noted), and a row whose value
//! cannot be used leaves a gap between its neighbours: there, and only there, the curve has no
//! value, and asking for one gives the row's fault.

use crate::math::monotone::MonotoneCurve;
use crate::medium::data::column::Column;
use crate::medium::error::{MediumError, digits, file_error};
use std::path::{Path, PathBuf};

/// Values by ascending wavelength (metres) with the rows that could not be used.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples {
    /// Wavelengths in vacuum, metres, ascending.
    pub wavelength: Vec<f64>,
    /// Values at them.
    pub value: Vec<f64>,
    flaws: Vec<Flaw>,
    path: PathBuf,
}

/// A row without a usable value.
#[derive(Clone, Debug, PartialEq)]
struct Flaw {
    /// Its place, or one between its neighbours in the file, metres.
    wavelength: f64,
    line: usize,
    message: String,
}

/// One row as it stands in the file: the wavelength in metres where it can be read, and the value or
/// its fault.
#[derive(Clone, Debug)]
pub(in crate::medium) struct Row {
    pub line: usize,
    pub wavelength: Option<f64>,
    pub value: Result<f64, String>,
}

/// Rows this close (relative) stand at one wavelength.
const SAME: f64 = 1e-12;
/// A k below zero by at most this much may be noise.
const NOISE: f64 = 0.1;
/// Notes of one kind that are told one by one.
const TOLD: usize = 2;

impl Samples {
    /// True where there is none.
    pub fn is_empty(&self) -> bool {
        self.wavelength.is_empty()
    }

    /// True where every value is zero.
    pub(in crate::medium) fn is_zero(&self) -> bool {
        self.flaws.is_empty() && self.value.iter().all(|v| *v == 0.0)
    }

    /// The column's rows; `notes` receives what a reader should know.
    pub(in crate::medium) fn new(
        path: &Path,
        column: Column,
        mut rows: Vec<Row>,
        notes: &mut Vec<String>,
    ) -> Result<Self, MediumError> {
        let name = column.name();
        if column.is_absorption() {
            silence_noise(name, &mut rows, notes);
        }
        for row in &mut rows {
            if let Ok(value) = row.value
                && let Err(fault) = column.check(value)
            {
                row.value = Err(fault);
            }
        }
        let mut flaws = flaws(&rows, notes);
        let mut sound: Vec<(f64, f64, usize)> = rows
            .iter()
            .filter_map(|r| Some((r.wavelength?, *r.value.as_ref().ok()?, r.line)))
            .collect();
        if sound.is_empty() {
            return match flaws.into_iter().min_by_key(|f| f.line) {
                Some(flaw) => Err(file_error(path, Some(flaw.line), flaw.message)),
                None => Ok(Self::default()),
            };
        }
        let ascends = sound.windows(2).all(|w| w[0].0 <= w[1].0);
        let descends = sound.windows(2).all(|w| w[0].0 >= w[1].0);
        if !(ascends || descends) {
            notes.push(format!("rows of {name} in no order: sorted by wavelength"));
        }
        sound.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (wavelength, value) = merged(name, &sound, notes);
        flaws.sort_by(|a, b| a.wavelength.total_cmp(&b.wavelength));
        // A row that repeats a sound one takes nothing away.
        flaws.retain(|f| !wavelength.iter().any(|w| same(*w, f.wavelength)));
        Ok(Self { wavelength, value, flaws, path: path.to_path_buf() })
    }

    /// The rows, if none of them was unsound: for what needs all of them.
    pub fn complete(&self) -> Result<(&[f64], &[f64]), MediumError> {
        match self.flaws.iter().min_by_key(|f| f.line) {
            Some(flaw) => Err(file_error(&self.path, Some(flaw.line), flaw.message.clone())),
            None => Ok((&self.wavelength, &self.value)),
        }
    }

    /// The curve through the rows.
    pub(in crate::medium) fn curve(&self) -> DataCurve {
        let mut pieces = Vec::new();
        let mut from = 0;
        for i in 1..=self.wavelength.len() {
            let ends = i == self.wavelength.len()
                || self.flaw_between(self.wavelength[i - 1], self.wavelength[i]).is_some();
            if ends {
                pieces.push(Piece::new(&self.wavelength[from..i], &self.value[from..i]));
                from = i;
            }
        }
        DataCurve { samples: self.clone(), pieces }
    }

    fn flaw_between(&self, from: f64, to: f64) -> Option<&Flaw> {
        self.flaws.iter().find(|f| from < f.wavelength && f.wavelength < to)
    }
}

fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME * a.abs()
}

/// Sets values just below zero to zero, unless the column as a whole is negative.
fn silence_noise(name: &str, rows: &mut [Row], notes: &mut Vec<String>) {
    let values = || rows.iter().filter_map(|r| r.value.as_ref().ok());
    let negative: f64 = values().map(|v| (-v).max(0.0)).sum();
    let positive: f64 = values().map(|v| v.max(0.0)).sum();
    let lowest = values().copied().fold(0.0, f64::min);
    if negative == 0.0 || negative >= positive {
        // All below zero: the other sign convention, n − ik, or gain; never noise.
        return;
    }
    let mut count = 0;
    for row in rows.iter_mut() {
        if let Ok(value) = &mut row.value
            && (-NOISE..0.0).contains(value)
        {
            *value = 0.0;
            count += 1;
        }
    }
    if count > 0 {
        let rows = if count == 1 { "1 row" } else { &format!("{count} rows") };
        notes.push(format!("{rows} with {name} below 0 (lowest {lowest:e}): taken as 0"));
    }
}

/// The unsound rows with their places; those outside all sound ones are only noted.
fn flaws(rows: &[Row], notes: &mut Vec<String>) -> Vec<Flaw> {
    let mut flaws = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        let Err(message) = &row.value else { continue };
        let neighbour = |r: &Row| r.wavelength;
        let before = rows[..i].iter().rev().find_map(neighbour);
        let after = rows[i + 1..].iter().find_map(neighbour);
        let between = before.zip(after).map(|(a, b)| (a * b).sqrt());
        // A row at the end whose wavelength is unknown may belong anywhere beyond.
        let place = row.wavelength.or(between).or(before).or(after).unwrap_or(0.0);
        flaws.push(Flaw { wavelength: place, line: row.line, message: message.clone() });
    }
    for flaw in flaws.iter().take(TOLD) {
        notes.push(format!("line {}: {}", flaw.line, flaw.message));
    }
    if flaws.len() > TOLD {
        notes.push(format!("{} more rows without a usable value", flaws.len() - TOLD));
    }
    flaws
}

/// One row for each wavelength: equal ones merged, unequal ones averaged.
fn merged(name: &str, rows: &[(f64, f64, usize)], notes: &mut Vec<String>) -> (Vec<f64>, Vec<f64>) {
    let (mut wavelength, mut value) =
        (Vec::with_capacity(rows.len()), Vec::with_capacity(rows.len()));
    let mut unequal = 0;
    let mut from = 0;
    for i in 1..=rows.len() {
        if i < rows.len() && same(rows[from].0, rows[i].0) {
            continue;
        }
        let group = &rows[from..i];
        let first = group[0];
        let mean = match group.iter().all(|r| r.1 == first.1) {
            true => first.1,
            false => group.iter().map(|r| r.1).sum::<f64>() / group.len() as f64,
        };
        if mean != first.1 || group.iter().any(|r| r.1 != first.1) {
            unequal += 1;
            if unequal <= TOLD {
                let lines: Vec<String> = group.iter().take(4).map(|r| r.2.to_string()).collect();
                notes.push(format!(
                    "{} values of {name} at {} nm (lines {}): their mean {} is taken",
                    group.len(),
                    digits(first.0 * 1e9),
                    lines.join(", "),
                    digits(mean)
                ));
            }
        }
        wavelength.push(first.0);
        value.push(mean);
        from = i;
    }
    if unequal > TOLD {
        notes.push(format!("{} more wavelengths with several values of {name}", unequal - TOLD));
    }
    (wavelength, value)
}

/// A curve through sound rows, in pieces between the unsound ones.
#[derive(Clone, Debug, PartialEq)]
pub struct DataCurve {
    samples: Samples,
    pieces: Vec<Piece>,
}

#[derive(Clone, Debug, PartialEq)]
enum Piece {
    /// One row alone: a value at its wavelength only.
    Point(f64, f64),
    Curve(MonotoneCurve),
}

impl Piece {
    fn new(x: &[f64], y: &[f64]) -> Self {
        match MonotoneCurve::new(x.to_vec(), y.to_vec()) {
            Some(curve) => Self::Curve(curve),
            None => Self::Point(x[0], y[0]),
        }
    }

    fn range(&self) -> (f64, f64) {
        match self {
            Self::Point(x, _) => (*x, *x),
            Self::Curve(curve) => curve.range(),
        }
    }

    fn value(&self, x: f64) -> f64 {
        match self {
            Self::Point(_, y) => *y,
            Self::Curve(curve) => curve.value(x),
        }
    }
}

impl DataCurve {
    /// A curve of rows that are known to be sound: ascending wavelengths in metres.
    pub fn of_rows(wavelength: &[f64], value: &[f64]) -> Self {
        let samples = Samples {
            wavelength: wavelength.to_vec(),
            value: value.to_vec(),
            ..Samples::default()
        };
        samples.curve()
    }

    /// First and last wavelength, metres.
    pub fn range(&self) -> (f64, f64) {
        let rows = &self.samples.wavelength;
        (rows[0], rows[rows.len() - 1])
    }

    /// The value at a wavelength in metres; `None` outside the range. Between the neighbours of an
    /// unsound row, the row's fault.
    pub fn value(&self, wavelength: f64) -> Option<Result<f64, MediumError>> {
        let slack = |(from, to): (f64, f64)| {
            wavelength >= from * (1.0 - SAME) && wavelength <= to * (1.0 + SAME)
        };
        if let Some(piece) = self.pieces.iter().find(|p| slack(p.range())) {
            return Some(Ok(piece.value(wavelength)));
        }
        let rows = &self.samples.wavelength;
        let above = rows.partition_point(|w| *w < wavelength);
        let from = if above > 0 { rows[above - 1] } else { 0.0 };
        let to = rows.get(above).copied().unwrap_or(f64::INFINITY);
        let flaw = self.samples.flaws.iter().find(|f| {
            let f = f.wavelength;
            (from < f && f < to) || (to == f64::INFINITY && f >= from) || (from == 0.0 && f <= to)
        })?;
        Some(Err(file_error(&self.samples.path, Some(flaw.line), flaw.message.clone())))
    }

    /// True where every row is zero.
    pub(in crate::medium) fn is_zero(&self) -> bool {
        self.samples.is_zero()
    }

    /// The value with the end rows held beyond the range.
    pub fn held(&self, wavelength: f64) -> Result<f64, MediumError> {
        let (from, to) = self.range();
        match self.value(wavelength.clamp(from, to)) {
            Some(value) => value,
            None => Ok(self.samples.value[0]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(column: Column, rows: &[(f64, f64)]) -> (Samples, Vec<String>) {
        let row = |(i, &(w, v)): (usize, &(f64, f64))| Row {
            line: i + 1,
            wavelength: Some(w),
            value: Ok(v),
        };
        let mut notes = Vec::new();
        let rows = rows.iter().enumerate().map(row).collect();
        (Samples::new(Path::new("f.csv"), column, rows, &mut notes).unwrap(), notes)
    }

    #[test]
    fn rows_are_sorted_and_merged() {
        let (s, notes) = samples(Column::N, &[(3.0, 1.3), (2.0, 1.2), (1.0, 1.1)]);
        assert_eq!((s.wavelength, notes.len()), (vec![1.0, 2.0, 3.0], 0));
        let (s, notes) = samples(Column::N, &[(1.0, 1.1), (3.0, 1.3), (2.0, 1.2)]);
        assert_eq!((s.value, notes.len()), (vec![1.1, 1.2, 1.3], 1));
        let (s, notes) = samples(Column::N, &[(1.0, 1.1), (1.0, 1.1), (2.0, 1.2)]);
        assert_eq!((s.value, notes.len()), (vec![1.1, 1.2], 0));
        let (s, notes) = samples(Column::N, &[(1.0, 1.1), (1.0, 1.3), (2.0, 1.2)]);
        assert!((s.value[0] - 1.2).abs() < 1e-15 && notes[0].contains("lines 1, 2"), "{notes:?}");
    }

    #[test]
    fn noise_below_zero_is_zero_and_the_other_sign_is_not() {
        let (s, notes) = samples(Column::K, &[(1.0, 0.02), (2.0, -6e-19), (3.0, -0.001)]);
        assert_eq!(s.value, [0.02, 0.0, 0.0]);
        assert!(notes[0].contains("2 rows with k below 0"), "{notes:?}");
        let curve = samples(Column::K, &[(1.0, 0.0), (2.0, -0.1), (3.0, 0.0)]).0.curve();
        assert!(curve.value(1.5).unwrap().unwrap_err().to_string().contains("0 or more"));
    }

    /// An unsound row takes the values between its neighbours with it, and no others.
    #[test]
    fn a_flaw_leaves_a_gap() {
        let rows = [(1.0, 1.1), (2.0, 1.2), (3.0, -1.3), (4.0, 1.4), (5.0, 1.5), (6.0, 0.0)];
        let curve = samples(Column::N, &rows).0.curve();
        for at in [1.0, 1.5, 2.0, 4.0, 4.5, 5.0] {
            assert!((curve.value(at).unwrap().unwrap() - (1.0 + at / 10.0)).abs() < 1e-12, "{at}");
        }
        for at in [2.5, 3.0, 3.5] {
            let error = curve.value(at).unwrap().unwrap_err().to_string();
            assert!(error.contains("line 3: n = -1.3 must be positive"), "{error}");
            assert!(curve.held(at).is_err());
        }
        assert!(curve.value(5.5).unwrap().unwrap_err().to_string().contains("line 6"));
        assert!(curve.value(0.5).is_none());
        assert_eq!(curve.held(0.5).unwrap(), 1.1);
    }
}
