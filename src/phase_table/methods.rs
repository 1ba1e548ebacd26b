//! By which method each order of a table was computed, why, and how far it may be off: in words, so that
//! whoever reads a table years later need not know the program.
//!
//! Wavelengths in a row that have the same methods are one [`MethodRange`]; a table's file stores those.
//!
//! ```
//! use gonio::phase_table::{MethodPart, MethodRange};
//! let part = MethodPart { method: "Lorenz–Mie series".into(), ..MethodPart::default() };
//! let parts = [vec![part.clone()], vec![part]];
//! let ranges = MethodRange::collect([400e-9, 700e-9].into_iter().zip(&parts));
//! assert_eq!((ranges.len(), ranges[0].count), (1, 2));
//! ```

use serde::{Deserialize, Serialize};

/// The method of one order at one wavelength.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MethodPart {
    /// `None`: all orders in one.
    pub order: Option<u32>,
    /// The method in words.
    pub method: String,
    /// Why this one.
    pub reason: String,
    /// Share of its amplitude by which its wave may be off; `None` where it is exact.
    pub expected_error: Option<f64>,
    /// Share of the light on the shadow that leaves in this order, by rays.
    pub share_of_light: Option<f64>,
    /// Share of the light on the shadow that the order's amplitudes scatter, added up over the sphere: that of
    /// its rays, and what tunnels at the rim, as far as the wave is right.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub share_scattered: Option<f64>,
    /// What stands for the method's plain form in some directions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub formulas: Vec<FormulaPart>,
}

/// A formula and where it stands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FormulaPart {
    /// The formula in words.
    pub formula: String,
    /// Least and largest scattering angle, at some azimuth, degrees.
    pub theta_deg: [f64; 2],
}

/// Wavelengths in a row with the same methods and formulas. Errors and angles are those of all of them:
/// the largest, the widest; reasons and light are those of the first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MethodRange {
    /// Number of the first wavelength, and how many there are.
    pub first: usize,
    /// How many wavelengths there are.
    pub count: usize,
    /// The first and the last, nanometres.
    pub from_nm: f64,
    /// The last, nanometres.
    pub to_nm: f64,
    /// Methods by order.
    pub parts: Vec<MethodPart>,
}

impl MethodRange {
    /// Of wavelengths (metres) in their order.
    pub fn collect<'p>(
        slabs: impl IntoIterator<Item = (f64, &'p Vec<MethodPart>)>,
    ) -> Vec<MethodRange> {
        let mut ranges: Vec<MethodRange> = Vec::new();
        for (number, (wavelength, parts)) in slabs.into_iter().enumerate() {
            let nm = (1e15 * wavelength).round() / 1e6;
            match ranges.last_mut().filter(|range| alike(&range.parts, parts)) {
                Some(range) => range.add(nm, parts),
                None => {
                    let (from_nm, to_nm, parts) = (nm, nm, parts.clone());
                    ranges.push(MethodRange { first: number, count: 1, from_nm, to_nm, parts });
                }
            }
        }
        ranges
    }

    fn add(&mut self, nm: f64, parts: &[MethodPart]) {
        self.count += 1;
        self.to_nm = nm;
        for (mine, other) in self.parts.iter_mut().zip(parts) {
            // `None` is less than any error
            if other.expected_error > mine.expected_error {
                mine.expected_error = other.expected_error;
            }
            for (mine, other) in mine.formulas.iter_mut().zip(&other.formulas) {
                let ([low, high], [from, to]) = (mine.theta_deg, other.theta_deg);
                mine.theta_deg = [low.min(from), high.max(to)];
            }
        }
    }

    /// The methods of the wavelength number `index`; none where no range has it.
    pub fn at(ranges: &[MethodRange], index: usize) -> Vec<MethodPart> {
        let holds =
            |range: &&MethodRange| (range.first..range.first + range.count).contains(&index);
        ranges.iter().find(holds).map_or_else(Vec::new, |range| range.parts.clone())
    }
}

/// The same methods for the same orders, with the same formulas.
fn alike(a: &[MethodPart], b: &[MethodPart]) -> bool {
    let same = |(a, b): (&MethodPart, &MethodPart)| {
        let formulas = |part: &MethodPart| -> Vec<String> {
            part.formulas.iter().map(|formula| formula.formula.clone()).collect()
        };
        a.order == b.order && a.method == b.method && formulas(a) == formulas(b)
    };
    a.len() == b.len() && a.iter().zip(b).all(same)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(method: &str, error: f64, theta: [f64; 2]) -> Vec<MethodPart> {
        let formulas = vec![FormulaPart { formula: "bow".into(), theta_deg: theta }];
        let method = method.to_string();
        vec![MethodPart {
            order: Some(2),
            method,
            expected_error: Some(error),
            formulas,
            ..MethodPart::default()
        }]
    }

    #[test]
    fn a_range_ends_where_a_method_does() {
        let all = [
            parts("a", 0.1, [137.0, 139.0]),
            parts("a", 0.2, [136.0, 138.0]),
            parts("b", 0.3, [1.0, 2.0]),
        ];
        let ranges = MethodRange::collect([4e-7, 5e-7, 6e-7].into_iter().zip(&all));
        assert_eq!(ranges.len(), 2);
        assert_eq!((ranges[0].from_nm, ranges[0].to_nm), (400.0, 500.0));
        assert_eq!(ranges[0].parts[0].expected_error, Some(0.2));
        assert_eq!(ranges[0].parts[0].formulas[0].theta_deg, [136.0, 139.0]);
        assert_eq!(MethodRange::at(&ranges, 1), ranges[0].parts);
        assert_eq!(MethodRange::at(&ranges, 2), all[2]);
        assert!(MethodRange::at(&ranges, 3).is_empty());
    }

    #[test]
    fn text_and_back() {
        let all = [parts("a", 0.1, [137.0, 139.0])];
        let ranges = MethodRange::collect([4e-7].into_iter().zip(&all));
        let text = serde_json::to_string(&ranges).unwrap();
        assert_eq!(serde_json::from_str::<Vec<MethodRange>>(&text).unwrap(), ranges);
    }
}
