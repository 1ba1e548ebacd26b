//! The cells of a line of a text table, in the dialects that instruments, spreadsheets and Fortran
//! programs write: any separator, quotes, comment signs, decimal commas, `D` exponents.

/// What cuts a line into cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::medium) enum Separator {
    Sign(char),
    Blanks,
}

/// Signs that begin a comment, at the start of a line or behind its cells.
const COMMENTS: [&str; 4] = ["#", "!", "%", "//"];

/// The text of a line that is a comment as a whole.
pub(in crate::medium) fn comment(line: &str) -> Option<&str> {
    COMMENTS.iter().chain(&[";"]).find_map(|sign| line.strip_prefix(sign))
}

/// The line without a comment behind its cells, and without separators that close it.
fn content(line: &str) -> &str {
    let mut quoted = false;
    let mut end = line.len();
    for (i, c) in line.char_indices() {
        if c == '"' {
            quoted = !quoted;
        }
        if !quoted && i > 0 && COMMENTS.iter().any(|sign| line[i..].starts_with(sign)) {
            end = i;
            break;
        }
    }
    line[..end].trim()
}

impl Separator {
    /// The separator of a header: a semicolon or a tab before a comma, which may stand for the
    /// decimal point; blanks where there is nothing else.
    pub(in crate::medium) fn of_header(line: &str) -> Self {
        let mut quoted = false;
        let bare: String = line
            .chars()
            .filter(|c| {
                quoted ^= *c == '"';
                !quoted
            })
            .collect();
        let sign = [';', '\t', ','].into_iter().find(|sign| bare.contains(*sign));
        sign.map_or(Self::Blanks, Self::Sign)
    }

    /// The cells of a line, quotes off, empty ones at the end left out.
    pub(in crate::medium) fn cells(self, line: &str) -> Vec<String> {
        let mut cells = vec![String::new()];
        let mut quoted = false;
        for c in content(line).chars() {
            match c {
                '"' => quoted = !quoted,
                _ if !quoted && self.cuts(c) => cells.push(String::new()),
                _ => {
                    if let Some(cell) = cells.last_mut() {
                        cell.push(c);
                    }
                }
            }
        }
        let mut cells: Vec<String> =
            cells.into_iter().map(|cell| cell.trim().to_string()).collect();
        if self == Self::Blanks {
            cells.retain(|cell| !cell.is_empty());
        }
        while cells.last().is_some_and(String::is_empty) {
            cells.pop();
        }
        cells
    }

    fn cuts(self, c: char) -> bool {
        match self {
            Self::Sign(sign) => c == sign,
            Self::Blanks => c.is_whitespace(),
        }
    }
}

/// The number in a cell; a comma in it is a decimal one.
pub(in crate::medium) fn number(cell: &str) -> Result<f64, String> {
    let wrong = || {
        let shown: String = cell.chars().take(40).collect();
        format!("\"{shown}\" is not a number")
    };
    if let Ok(value) = cell.parse::<f64>() {
        return if value.is_finite() {
            Ok(value)
        } else {
            Err(format!("{value} is not a finite number"))
        };
    }
    let plain: String = cell
        .chars()
        .map(|c| match c {
            '\u{2212}' => '-',
            'd' | 'D' => 'e',
            other => other,
        })
        .collect();
    let plain = match plain.matches(',').count() {
        1 if !plain.contains('.') => plain.replace(',', "."),
        _ => plain,
    };
    // "1d" or "inf,": words are no numbers.
    let numeric = plain.chars().all(|c| c.is_ascii_digit() || "+-.eE".contains(c));
    plain.parse::<f64>().ok().filter(|v| numeric && v.is_finite()).ok_or_else(wrong)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_of_every_dialect() {
        let cells = |line: &str| Separator::of_header(line).cells(line);
        assert_eq!(cells("\"Wavelength, um\",n,k"), ["Wavelength, um", "n", "k"]);
        assert_eq!(cells("0,4;1,5; 0 "), ["0,4", "1,5", "0"]);
        assert_eq!(cells("0,4\t1,5"), ["0,4", "1,5"]);
        assert_eq!(cells("  0.4   1.5 ! first"), ["0.4", "1.5"]);
        assert_eq!(cells("400,1.5,,"), ["400", "1.5"]);
        assert_eq!(cells("400,,1e-3 # no n"), ["400", "", "1e-3"]);
        assert_eq!(comment("% of all"), Some(" of all"));
        assert_eq!(comment("400, 1.5"), None);
    }

    #[test]
    fn numbers_of_every_hand() {
        for (cell, value) in [
            ("4.0D+02", 400.0),
            ("1,50", 1.5),
            ("1d-3", 1e-3),
            ("-1,5E2", -150.0),
            ("\u{2212}0.5", -0.5),
            ("+.5", 0.5),
        ] {
            assert_eq!(number(cell), Ok(value), "{cell}");
        }
        for cell in ["", "1,234.5", "1,2,3", "d", "zero", "0x10"] {
            assert!(number(cell).unwrap_err().contains("is not a number"), "{cell}");
        }
        assert!(number("NaN").unwrap_err().contains("not a finite number"));
    }
}
