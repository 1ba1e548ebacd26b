//! Radii between which a profile is integrated.
//!
//! Steps are a fraction of the wavelength inside, and of the radius near the centre, where the
//! centrifugal term `l(l+1)/ρ²` varies fastest; every jump and every kink of the index is a node, or
//! the order of the integration is lost. Finer grids halve (or divide by any number) every step.

use super::radial_index::RadialIndex;

/// Steps near the centre, in units of the radius; half of it after one halving.
const GRADE: f64 = 0.12;
/// Innermost node in units of 1/(k n): nothing depends on the index inside it.
const INNERMOST: f64 = 0.01;
/// A last step this much longer than its neighbours is better than a sliver.
const SLIVER: f64 = 0.25;

/// Nodes ascending to 1, for phases of at most `phase` per step.
pub(super) fn coarse(index: &impl RadialIndex, x: f64, phase: f64) -> Vec<f64> {
    let mut breaks = index.breaks();
    breaks.retain(|r| *r > 0.0 && *r < 1.0);
    breaks.push(0.0);
    breaks.sort_by(f64::total_cmp);
    let mut nodes = vec![1.0];
    let mut radius = 1.0;
    while let Some(below) = breaks.pop() {
        while radius > below {
            // A hair inside, where a jump at this node does not matter.
            let inside = index.squared(radius - 1e-9 * (radius - below)).norm().sqrt();
            let step = (phase / (x * inside.max(0.3))).min(GRADE * radius);
            let next = radius - step;
            radius = if next < below + SLIVER * step { below } else { next };
            if radius < INNERMOST / (x * inside.max(1.0)) {
                break;
            }
            nodes.push(radius);
        }
        radius = below;
    }
    nodes.reverse();
    nodes
}

/// Every step in so many equal ones.
pub(super) fn divided(nodes: &[f64], parts: usize) -> Vec<f64> {
    let mut out = Vec::with_capacity(parts * nodes.len());
    for pair in nodes.windows(2) {
        for k in 0..parts {
            out.push(pair[0] + (pair[1] - pair[0]) * k as f64 / parts as f64);
        }
    }
    out.extend(nodes.last());
    out
}
