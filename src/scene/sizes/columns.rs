//! Sizes and numbers from the columns of a text file.
//!
//! ```text
//! # comments
//! from_diameter_mm,to_diameter_mm,number      or      radius_um,number_per_radius
//! 0.2,0.4,310
//! ```
//! The first line that is no comment names the columns; they are parted by commas, semicolons or blanks.

use super::kind;
use std::io::Read;
use std::path::Path;

/// Most bytes of a file; distributions have some hundred rows.
const MOST_BYTES: u64 = 4 << 20;

/// Named columns of a file.
pub(super) struct Columns {
    /// For messages.
    file: String,
    names: Vec<String>,
    /// By column.
    values: Vec<Vec<f64>>,
}

impl Columns {
    /// # Errors
    /// A file that cannot be read, or a cell that is no number.
    pub(super) fn read(path: &Path) -> Result<Self, String> {
        let file = path.display().to_string();
        let wrong = |message: String| format!("file = {file}: {message}");
        let size = std::fs::metadata(path).map_err(|error| wrong(error.to_string()))?.len();
        if size > MOST_BYTES {
            return Err(wrong(format!("{size} bytes; at most {MOST_BYTES} are accepted")));
        }
        // devices have no size
        let mut text = String::new();
        let opened = std::fs::File::open(path).map_err(|error| wrong(error.to_string()))?;
        let read = opened.take(MOST_BYTES + 1).read_to_string(&mut text);
        let read = read.map_err(|error| wrong(error.to_string()))?;
        if read as u64 > MOST_BYTES {
            return Err(wrong(format!("more than {MOST_BYTES} bytes")));
        }
        Self::parse(&file, &text)
    }

    fn parse(file: &str, text: &str) -> Result<Self, String> {
        let split = |line: &str| -> Vec<String> {
            let cells = line.split(|c: char| matches!(c, ',' | ';') || c.is_whitespace());
            cells.filter(|cell| !cell.is_empty()).map(String::from).collect()
        };
        let mut lines = text
            .lines()
            .enumerate()
            .map(|(i, line)| (i + 1, line.trim_start_matches('\u{feff}').trim()))
            .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
        let names = lines.next().map(|(_, line)| split(line)).unwrap_or_default();
        let mut values = vec![Vec::new(); names.len()];
        for (number, line) in lines {
            let cells = split(line);
            if cells.len() != names.len() {
                let (found, named) = (cells.len(), names.len());
                return Err(format!(
                    "file = {file}, line {number}: {found} cells for {named} columns"
                ));
            }
            for (column, cell) in values.iter_mut().zip(&cells) {
                let value = cell.parse().ok().filter(|value: &f64| value.is_finite());
                let wrong = || format!("file = {file}, line {number}: {cell} is no number");
                column.push(value.ok_or_else(wrong)?);
            }
        }
        Ok(Self { file: file.into(), names, values })
    }

    /// A length column in metres of radius.
    fn length(&self, base: &str) -> Option<Vec<f64>> {
        kind::spellings(base).into_iter().find_map(|(name, unit)| {
            let place = self.names.iter().position(|column| *column == name)?;
            Some(self.values[place].iter().map(|value| value * unit).collect())
        })
    }

    fn numbers(&self, accepted: &str) -> Result<Vec<f64>, String> {
        let place = self.names.iter().position(|name| name.starts_with("number"));
        place.map(|place| self.values[place].clone()).ok_or_else(|| self.untold(accepted))
    }

    fn untold(&self, accepted: &str) -> String {
        let names = self.names.join(", ");
        format!("file = {}: its columns are [{names}]; accepted: {accepted}", self.file)
    }

    /// Edges and counts of bins that follow each other without holes.
    pub(super) fn bins(&self) -> Result<(Vec<f64>, Vec<f64>), String> {
        const ACCEPTED: &str = "from_diameter_mm, to_diameter_mm, number (or radius, _um, _nm)";
        let (Some(from), Some(to)) = (self.length("from_{}"), self.length("to_{}")) else {
            return Err(self.untold(ACCEPTED));
        };
        let number = self.numbers(ACCEPTED)?;
        let mut edges: Vec<f64> = from.first().copied().into_iter().collect();
        for (row, (low, high)) in from.iter().zip(&to).enumerate() {
            let before = edges[edges.len() - 1];
            if (low - before).abs() > 1e-6 * high.abs() {
                let [end, start] =
                    [before, *low].map(|r| crate::math::digits::to_digits(r * 1e6, 6));
                return Err(format!(
                    "file = {}: bin {} starts at a radius of {start} µm, the one before ends at {end} µm: \
                     bins must follow each other without holes",
                    self.file,
                    row + 1
                ));
            }
            edges.push(*high);
        }
        Ok((edges, number))
    }

    /// Radii and number per radius.
    pub(super) fn densities(&self) -> Result<(Vec<f64>, Vec<f64>), String> {
        const ACCEPTED: &str = "radius_um, number (or diameter, _mm, _nm)";
        let radii = self.length("{}").ok_or_else(|| self.untold(ACCEPTED))?;
        Ok((radii, self.numbers(ACCEPTED)?))
    }
}

/// Refuse what does not ascend from a positive radius.
pub(super) fn ascend(what: &str, radii: &[f64]) -> Result<(), String> {
    if radii.len() < 2 {
        return Err(format!("{what}: {} given; at least two are accepted", radii.len()));
    }
    let um = |r: f64| crate::math::digits::to_digits(r * 1e6, 6);
    if let Some(bad) = radii.iter().find(|r| !(**r >= 0.0 && **r <= 1e-2)) {
        return Err(format!("{what}: a radius of {} µm; 0 to 10000 µm is accepted", um(*bad)));
    }
    match radii.windows(2).find(|pair| pair[0] >= pair[1]) {
        Some(pair) => {
            let [before, after] = [pair[0], pair[1]].map(um);
            Err(format!("{what}: a radius of {before} µm is followed by {after}; they must ascend"))
        }
        None => Ok(()),
    }
}

/// Refuse negative counts, and none at all.
pub(super) fn counts(what: &str, values: &[f64]) -> Result<(), String> {
    if let Some(bad) = values.iter().find(|value| !(**value >= 0.0 && value.is_finite())) {
        return Err(format!("{what} = {bad}: 0 or more is accepted"));
    }
    if values.iter().all(|value| *value == 0.0) {
        return Err(format!("{what}: no particles in any bin; at least one is needed"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_by_name() {
        let text = "# parsivel\nfrom_diameter_mm; to_diameter_mm; number\n0.2;0.5;3\n0.5;1;1\n";
        let (edges, number) = Columns::parse("f", text).unwrap().bins().unwrap();
        assert_eq!(number, [3.0, 1.0]);
        assert!((edges[2] - 0.5e-3).abs() < 1e-18 && edges.len() == 3);
        let hole = text.replace("0.5;1;1", "0.6;1;1");
        let error = Columns::parse("f", &hole).unwrap().bins().unwrap_err();
        assert!(error.contains("bin 2 starts at a radius of 300 µm"), "{error}");
        let (radii, _) = Columns::parse("f", "radius_nm number_per_nm\n1 2\n3 4\n")
            .unwrap()
            .densities()
            .unwrap();
        assert!((radii[1] - 3e-9).abs() < 1e-24);
        for (text, words) in [
            ("radius_um,number\n1,2,3\n", "line 2: 3 cells for 2 columns"),
            ("radius_um,number\n1,x\n", "x is no number"),
        ] {
            let error = Columns::parse("f", text).err().unwrap();
            assert!(error.contains(words), "{error}");
        }
        let error = Columns::parse("f", "size,number\n1,2\n").unwrap().densities().unwrap_err();
        assert!(error.contains("its columns are [size, number]"), "{error}");
        assert!(ascend("edges", &[1e-6]).is_err() && counts("number", &[0.0]).is_err());
    }
}
