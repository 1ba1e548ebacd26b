//! All figures, and those of a name.

use super::error::FigureError;
use super::figure::Figure;
use super::{dispersion, glasses, gradients, rainbows};

/// All figures, paper by paper.
pub fn all() -> impl Iterator<Item = &'static Figure> {
    rainbows::FIGURES
        .iter()
        .chain(dispersion::FIGURES)
        .chain(glasses::FIGURES)
        .chain(gradients::FIGURES)
}

/// The figure of a name.
///
/// # Errors
/// [`FigureError::Unknown`] with the nearest names.
pub fn named(name: &str) -> Result<&'static Figure, FigureError> {
    all().find(|figure| figure.name == name).ok_or_else(|| unknown(name))
}

/// How alike names must be to be offered, and how many are.
const ALIKE: f64 = 0.8;
const OFFERED: usize = 3;

fn unknown(name: &str) -> FigureError {
    let wanted = name.to_lowercase();
    let likeness = |known: &str| strsim::jaro_winkler(&wanted, known);
    let mut near: Vec<&str> =
        all().map(|figure| figure.name).filter(|known| likeness(known) > ALIKE).collect();
    near.sort_by(|a, b| likeness(b).total_cmp(&likeness(a)));
    near.truncate(OFFERED);
    let near = match near.is_empty() {
        true => String::new(),
        false => format!("near are {}; ", near.join(", ")),
    };
    FigureError::Unknown { name: name.into(), near }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::SCENES;
    use std::collections::BTreeSet;

    /// Names are told apart, tell what they are, and their scenes are there; no scene is without a figure.
    #[test]
    fn every_figure_is_told() {
        let names: BTreeSet<&str> = all().map(|figure| figure.name).collect();
        assert!(names.len() == all().count() && names.len() >= 30, "{}", names.len());
        for figure in all() {
            assert!(figure.caption.len() > 20 && figure.compare.len() > 20, "{}", figure.name);
            let known = |scene: &&str| SCENES.iter().any(|known| known.name == *scene);
            assert!(figure.scenes.iter().all(known), "{}", figure.name);
        }
        let used: BTreeSet<&str> = all().flat_map(|figure| figure.scenes).copied().collect();
        assert_eq!(used, SCENES.iter().map(|scene| scene.name).collect());
    }

    #[test]
    fn near_names_are_offered() {
        let words = named("sadeghi5").unwrap_err().to_string();
        assert!(words.contains("sadeghi-5") && words.contains("--list"), "{words}");
        assert!(!named("qqq").unwrap_err().to_string().contains("near are"));
        assert_eq!(named("weidlich-2").unwrap().name, "weidlich-2");
    }
}
