//! Wavelengths at which a medium is shown where nobody says which.

use crate::medium::kinds::Medium;

/// Steps of the visible, and of a range outside it.
const STEPS: u32 = 20;

/// Every 20 nm of visible light that the data of all media cover, in nanometres; where there is none, an
/// even sample of what the first medium's data cover.
pub fn shown_wavelengths_nm(media: &[&Medium]) -> Vec<f64> {
    let covers = |m: &Medium, nm: f64| m.index(nm / 1e9).is_ok();
    let visible = (0..=20).map(|i| 380.0 + 20.0 * f64::from(i));
    let inside: Vec<f64> =
        visible.filter(|&nm| media.iter().all(|medium| covers(medium, nm))).collect();
    let Some(first) = media.first().filter(|_| inside.is_empty()) else { return inside };
    let all = even_sample_nm(first.valid_range());
    let inside: Vec<f64> = all.iter().copied().filter(|&nm| covers(first, nm)).collect();
    if inside.is_empty() { all } else { inside }
}

/// An even sample of a range of wavelengths (metres), both ends in, in nanometres.
pub fn even_sample_nm((from, to): (f64, f64)) -> Vec<f64> {
    let count = if to > from { STEPS } else { 0 };
    let share = |i: u32| f64::from(i) / f64::from(STEPS);
    (0..=count).map(|i| 1e9 * (from + (to - from) * share(i))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::medium::MediumSpec;

    #[test]
    fn the_visible_where_it_is_covered() {
        let water = MediumSpec::default().resolve(".".as_ref()).unwrap();
        let shown = shown_wavelengths_nm(&[&water]);
        assert_eq!((shown.len(), shown[0], shown[20]), (21, 380.0, 780.0));
        assert_eq!(even_sample_nm((1e-6, 1e-6)).len(), 1);
        assert_eq!(shown_wavelengths_nm(&[]), shown);
    }
}
