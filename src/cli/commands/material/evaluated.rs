//! A medium at some wavelengths, as text and as JSON; two of them side by side.

use crate::cli::failure::Result;
use gonio::medium::{Abbe, AbbeLines, Medium};
use num_complex::Complex64;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// A medium with its values at the wavelengths asked for.
pub(super) struct Evaluated {
    medium: Medium,
    nm: Vec<f64>,
    index: Vec<Complex64>,
}

impl Evaluated {
    pub(super) fn new(medium: Medium, nm: &[f64]) -> Result<Self> {
        let index = nm.iter().map(|nm| medium.index(nm / 1e9)).collect::<Result<_, _>>()?;
        Ok(Self { medium, nm: nm.to_vec(), index })
    }

    fn abbe(&self) -> [(&'static str, Option<Abbe>); 2] {
        [
            ("vd", self.medium.abbe(AbbeLines::HeliumD)),
            ("ve", self.medium.abbe(AbbeLines::MercuryE)),
        ]
    }

    pub(super) fn json(&self) -> Value {
        let mut value = json!({
            "name": self.medium.name(),
            "source": self.medium.source(),
            "wavelength_nm": self.nm,
            "n": self.index.iter().map(|i| i.re).collect::<Vec<_>>(),
            "k": self.index.iter().map(|i| i.im).collect::<Vec<_>>(),
        });
        for (key, abbe) in self.abbe() {
            if let Some(abbe) = abbe {
                value[key] = json!(abbe.number);
                if key == "vd" {
                    value["nd"] = json!(abbe.index);
                }
            }
        }
        value
    }

    pub(super) fn text(&self) -> String {
        let mut text = heading(&self.medium);
        for (key, abbe) in self.abbe() {
            if let Some(Abbe { index, number }) = abbe {
                let line = &key[1..];
                let _ = writeln!(text, "n_{line} = {index:.6}, V_{line} = {number:.3}");
            }
        }
        let _ = writeln!(text, "{:>14}  {:>12}  {:>12}", "wavelength_nm", "n", "k");
        for (nm, index) in self.nm.iter().zip(&self.index) {
            let _ = writeln!(text, "{nm:>14}  {:>12.8}  {:>12.5e}", index.re, index.im);
        }
        text
    }
}

/// Name and source.
pub(super) fn heading(medium: &Medium) -> String {
    format!("{}\nsource: {}\n", medium.name(), medium.source())
}

/// Both, and their differences.
pub(super) fn comparison_json(a: &Evaluated, b: &Evaluated) -> Value {
    let difference: Vec<Complex64> = b.index.iter().zip(&a.index).map(|(b, a)| b - a).collect();
    let mut value = a.json();
    value["compare"] = b.json();
    value["n_difference"] = json!(difference.iter().map(|d| d.re).collect::<Vec<_>>());
    value["k_difference"] = json!(difference.iter().map(|d| d.im).collect::<Vec<_>>());
    value
}

/// Both, and their differences.
pub(super) fn comparison_text(a: &Evaluated, b: &Evaluated) -> String {
    let mut text = format!("1: {}2: {}", heading(&a.medium), heading(&b.medium));
    let _ = writeln!(
        text,
        "{:>14}  {:>11}  {:>11}  {:>11}  {:>11}  {:>11}  {:>11}",
        "wavelength_nm", "n 1", "n 2", "n 2 - n 1", "k 1", "k 2", "k 2 - k 1"
    );
    for ((nm, p), q) in a.nm.iter().zip(&a.index).zip(&b.index) {
        let d = q - p;
        let _ = writeln!(
            text,
            "{nm:>14}  {:>11.7}  {:>11.7}  {:>11.3e}  {:>11.4e}  {:>11.4e}  {:>11.3e}",
            p.re, q.re, d.re, p.im, q.im, d.im
        );
    }
    text
}

/// Least and greatest.
pub(super) fn extent(values: &[f64]) -> (f64, f64) {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    (low, high)
}
