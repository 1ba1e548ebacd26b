//! Tabulated spectra: the shipped CSV files, read once and interpolated linearly.

/// Columns over wavelength (metres, ascending).
#[derive(Debug)]
pub(super) struct Tabulated<const COLUMNS: usize> {
    pub wavelength: Vec<f64>,
    pub value: Vec<[f64; COLUMNS]>,
}

impl<const COLUMNS: usize> Tabulated<COLUMNS> {
    /// Parse a shipped file: `#` lines, one header line, then `wavelength_nm,value,…`; further
    /// columns are left out.
    pub(super) fn parse(csv: &str) -> Self {
        let mut table = Self { wavelength: Vec::new(), value: Vec::new() };
        for line in csv.lines().filter(|line| !line.starts_with('#')) {
            let mut numbers = line.split(',').map_while(|cell| cell.trim().parse::<f64>().ok());
            let Some(nanometres) = numbers.next() else { continue };
            let mut row = [0.0; COLUMNS];
            for (slot, number) in row.iter_mut().zip(numbers) {
                *slot = number;
            }
            table.wavelength.push(nanometres * 1e-9);
            table.value.push(row);
        }
        table
    }

    /// First and last wavelength, metres.
    pub(super) fn range(&self) -> (f64, f64) {
        (self.wavelength[0], self.wavelength[self.wavelength.len() - 1])
    }

    /// Linear interpolation; the end values hold beyond the ends.
    pub(super) fn at(&self, wavelength: f64) -> [f64; COLUMNS] {
        let (index, fraction) = bracket(&self.wavelength, wavelength);
        let (low, high) =
            (self.value[index], self.value[(index + 1).min(self.wavelength.len() - 1)]);
        std::array::from_fn(|c| low[c] + fraction * (high[c] - low[c]))
    }
}

/// Index of the interval of an ascending axis that holds `x`, and the position in it (0 to 1).
/// Clamped at both ends.
pub(super) fn bracket(axis: &[f64], x: f64) -> (usize, f64) {
    let above = axis.partition_point(|&value| value <= x);
    if above == 0 {
        return (0, 0.0);
    }
    if above == axis.len() {
        return (axis.len() - 1, 0.0);
    }
    let (low, high) = (axis[above - 1], axis[above]);
    (above - 1, (x - low) / (high - low))
}
