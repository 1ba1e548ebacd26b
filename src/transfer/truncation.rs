//! The forward peak cut off: what is scattered next to nowhere counts as not scattered.
//!
//! δ-M (Wiscombe 1977; for phase matrices Hovenier, van der Mee & Domke 2004, section 5.6): of the scattered light
//! the share f goes straight on, and the rest has the coefficients `(α - f(2l+1))/(1-f)`, `β/(1-f)` up to the degree
//! that the streams resolve. With f from the first coefficient beyond, `α1/(2l+1)`, the rest has next to none there.

use super::expansion::Expansion;

/// A phase matrix without its peak, and the share of the light that the peak held.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Truncated {
    pub expansion: Expansion,
    pub forward: f64,
}

/// Share of the light that goes straight on where coefficients below `degree` are kept.
pub(super) fn forward_share(expansion: &Expansion, degree: usize) -> f64 {
    let first = expansion.alpha[0].get(degree).copied().unwrap_or(0.0);
    (first / (2 * degree + 1) as f64).clamp(0.0, 0.95)
}

/// Keep the coefficients below `degree`, and let the share `forward` go straight on.
pub(super) fn truncated(expansion: &Expansion, degree: usize, forward: f64) -> Truncated {
    let rest = 1.0 - forward;
    let count = degree.min(expansion.len());
    let count = if forward > 0.0 { degree } else { count };
    let mut kept = Expansion::zero(count);
    kept.add(expansion, 1.0 / rest);
    for (kind, list) in kept.alpha.iter_mut().enumerate() {
        for (l, value) in list.iter_mut().enumerate() {
            // d_2±2 begin at l = 2, so that the second and third have no peak before
            if l >= 2 || kind == 0 || kind == 3 {
                *value -= forward * (2 * l + 1) as f64 / rest;
            }
        }
    }
    Truncated { expansion: kept, forward }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first coefficient stays 1; of Henyey & Greenstein's function the share is a power of g, and the
    /// asymmetry of peak and rest together is the old one.
    #[test]
    fn what_is_left_scatters_all_the_rest() {
        let g = 0.85f64;
        let whole = Expansion::henyey_greenstein(g, 60);
        let forward = forward_share(&whole, 24);
        assert!((forward - g.powi(24)).abs() < 1e-14);
        let left = truncated(&whole, 24, forward);
        assert_eq!(left.expansion.len(), 24);
        assert!((left.expansion.alpha[0][0] - 1.0).abs() < 1e-15);
        let asymmetry = forward + (1.0 - forward) * left.expansion.alpha[0][1] / 3.0;
        assert!((asymmetry - g).abs() < 1e-14);
    }

    /// Nothing is cut of what the streams resolve.
    #[test]
    fn smooth_functions_stay() {
        let air = Expansion::rayleigh();
        assert_eq!(forward_share(&air, 16), 0.0);
        assert_eq!(truncated(&air, 16, 0.0).expansion, air);
    }
}
