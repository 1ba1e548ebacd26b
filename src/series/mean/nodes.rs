//! The spheres that stand for a mean: where they lie and what each of them counts.
//!
//! Small spheres have no resonance that a few Gauss panels would miss, and all their orders are
//! coherent: they enter with their exact coefficients. Large ones have resonances without end, and
//! enter with the Debye series cut behind an order, by the rule of equal steps. Between the two, and
//! between cuts, one fades into the other, so that neither sees an edge.

use super::sum::Node;
use crate::math::gauss_legendre;
use crate::medium::{Medium, MediumError};
use crate::series::{SeriesError, checked_term_count};
use crate::size_distribution::SizeDistribution;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Light that runs round inside leaks as `exp(-2 n g)` for the n-th partial wave, with
/// `g = arcosh m - √(1 - 1/m²)`, at x = n/m and beyond (the tunnel through its barrier). Where the
/// exponent comes to this, resonances are about 0.01 wide in x; narrower ones lie beyond.
const NARROW: f64 = 7.2;
/// Least size parameter of that place; for soft spheres it is far, and for m ≤ 1 there is none.
const LEAST_FULL: f64 = 2.0;
/// Below this share of it nothing is cut.
const FADE_START: f64 = 0.5;
/// Distributions that end this little beyond it are summed exactly to their end.
const FADE_SLACK: f64 = 1.5;
/// Resonances that are this wide in x need no cut.
const BROAD: f64 = 0.5;
/// Steepness of the error function between the two: at its ends 8e-9 is left.
const STEEP: f64 = 4.0;
/// Standard deviation of that step in units of its width.
const STEP_DEVIATION: f64 = 1.0 / (2.0 * STEEP * std::f64::consts::SQRT_2);

/// Gauss nodes per panel; panels are no wider than this share of the radius, than this phase inside
/// over the index, and than this share of the distribution.
const NODES: usize = 8;
const SHARE_OF_RADIUS: f64 = 0.2;
const PHASE: f64 = 1.3;
const SHARE_OF_STRETCH: f64 = 1.0 / 12.0;

/// The longest paths kept that carry light are those of rays near the rim, `2 √(n² - 1)` radii per
/// order; with this margin, and this much for the ways outside, the steps resolve the beat of the
/// last order with diffraction, and more steps change nothing.
const PATH_MARGIN: f64 = 1.1;
const WAYS_OUTSIDE: f64 = 4.0;
/// Fewest steps of a stretch: a bell between its tails is whole with a fifth of them.
const LEAST_STEPS: f64 = 64.0;
/// The largest spheres cost most and count least: those beyond which this share of the light lies
/// have half the orders before the cut, then a quarter. An error falls about as cut⁻⁵.
const RARE: [f64; 2] = [1e-2, 1e-3];
/// The way from one cut to the next takes this share of the way between the two.
const SHARE_OF_RARE: f64 = 0.3;
/// Width in x of the way from one cut to the next, at least: the beats of one order are well inside.
const LEAST_FADE: f64 = 8.0;

/// What is averaged along.
#[derive(Clone, Debug)]
pub(super) enum Line<'a> {
    /// Radii at one wavelength.
    Sizes { sizes: &'a SizeDistribution, wavelength: f64, index: Complex64 },
    /// Wavenumbers 1/λ of a band of the shape cos², one radius.
    Band { radius: f64, centre: f64, width: f64, medium: &'a Medium },
}

/// Spheres with the Debye series cut behind one order, in ascending order of x.
#[derive(Debug)]
pub(super) struct Zone {
    pub nodes: Vec<Node>,
    pub cut: u32,
}

/// A part of the line: places (metres or 1/m), whether it ends in a step, and size parameter per
/// place.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    from: f64,
    to: f64,
    step: bool,
}

/// A smooth step from 0 to 1 between two places.
#[derive(Clone, Copy, Debug)]
struct Rise(f64, f64);

impl Rise {
    fn at(&self, place: f64) -> f64 {
        let t = (place - self.0) / (self.1 - self.0);
        if t <= 0.0 {
            0.0
        } else if t >= 1.0 {
            1.0
        } else {
            0.5 * libm::erfc(STEEP * (1.0 - 2.0 * t))
        }
    }
}

/// How much brighter a sphere of a tail may be by its first resonances than by its size: those of dense small
/// spheres stand far above the light of the bell below them (n = 3.84, normal law about x = 0.63: 11 times).
fn resonance(index: Complex64) -> f64 {
    (index.norm() / 1.5).powi(4).max(1.0)
}

impl Line<'_> {
    fn stretches(&self, tail: f64) -> Vec<Stretch> {
        match self {
            Line::Sizes { sizes, wavelength, index, .. } => {
                let stretches = sizes.stretches(tail / resonance(*index), TAU / wavelength);
                let stretch = |(from, to)| Stretch { from, to, step: sizes.has_step((from, to)) };
                stretches.into_iter().map(stretch).collect()
            }
            Line::Band { centre, width, .. } => {
                let (from, to) = (1.0 / (centre + width), 1.0 / (centre - width));
                vec![Stretch { from, to, step: false }]
            }
        }
    }

    /// Size parameter per place.
    fn per_place(&self) -> f64 {
        match self {
            Line::Sizes { wavelength, .. } => TAU / wavelength,
            Line::Band { radius, .. } => TAU * radius,
        }
    }

    /// The index that stands for the whole line.
    fn index(&self) -> Result<Complex64, MediumError> {
        match self {
            Line::Sizes { index, .. } => Ok(*index),
            Line::Band { centre, medium, .. } => medium.index(*centre),
        }
    }

    /// The sphere at a place that stands for a width of the line times a factor.
    fn node(&self, place: f64, width: f64) -> Result<Node, MediumError> {
        match *self {
            Line::Sizes { sizes, wavelength, index } => {
                Ok(Node { radius: place, wavelength, index, weight: sizes.density(place) * width })
            }
            Line::Band { radius, centre, width: band, medium } => {
                let wavelength = 1.0 / place;
                let offset = (0.5 * PI * (wavelength - centre) / band).cos();
                // cos² by wavelength with the integral 1, dλ = λ² dν.
                let weight = offset * offset * wavelength * wavelength / band * width;
                Ok(Node { radius, wavelength, index: medium.index(wavelength)?, weight })
            }
        }
    }

    /// The step from exact coefficients to the cut series, if any sphere is cut.
    fn rise(&self, stretches: &[Stretch]) -> Result<Option<Rise>, MediumError> {
        let index = self.index()?;
        if index.re <= 1.0 {
            return Ok(None);
        }
        let barrier = index.re.acosh() - (1.0 - index.re.powi(-2)).sqrt();
        let full = (NARROW / (2.0 * index.re * barrier)).max(LEAST_FULL);
        // Absorption makes every resonance 2kx/n wide.
        let broad = BROAD * index.re / (2.0 * index.im) < FADE_SLACK * full;
        let last = stretches.last().map_or(0.0, |stretch| stretch.to) * self.per_place();
        let full = full / self.per_place();
        let cut = last > FADE_SLACK * full * self.per_place() && !broad;
        Ok(cut.then_some(Rise(FADE_START * full, full)))
    }

    fn largest(&self, tail: f64) -> f64 {
        self.stretches(tail).last().map_or(0.0, |stretch| stretch.to) * self.per_place()
    }

    /// Least and largest size parameter.
    pub fn range(&self, tail: f64) -> (f64, f64) {
        let first = self.stretches(tail).first().map_or(0.0, |stretch| stretch.from);
        (first * self.per_place(), self.largest(tail))
    }

    /// The spheres with exact coefficients on panels halved `level` times; how many there would be, if
    /// there are more than `most`.
    pub fn exact(
        &self,
        tail: f64,
        level: u32,
        most: f64,
    ) -> Result<Result<Vec<Node>, f64>, ZoneError> {
        let stretches = self.stretches(tail);
        let rise = self.rise(&stretches)?;
        let end = rise.map_or(f64::INFINITY, |rise| rise.1);
        let rule = gauss_legendre::nodes(NODES);
        let phase = PHASE / self.index()?.re / self.per_place();
        let finer = 0.5f64.powi(level as i32);
        let panels = |&Stretch { from, to, .. }: &Stretch| {
            let to_here = to.min(end).max(from);
            let by_share = (to_here / from).ln() / SHARE_OF_RADIUS + 1.0 / SHARE_OF_STRETCH;
            (by_share + (to_here - from) / phase) / finer
        };
        let count = NODES as f64 * stretches.iter().map(panels).sum::<f64>();
        if count > most {
            return Ok(Err(count));
        }
        checked_term_count(self.largest(tail).min(end * self.per_place()), self.index()?)?;
        let mut nodes = Vec::new();
        for Stretch { from, to, .. } in stretches {
            let to_here = to.min(end);
            let mut low = from;
            while low < to_here {
                let width = (SHARE_OF_RADIUS * low).min(phase).min(SHARE_OF_STRETCH * (to - from));
                let mut high = low + width * finer;
                if high > to_here || to_here - high < 0.5 * width * finer {
                    high = to_here;
                }
                for (node, share) in &rule {
                    let place = 0.5 * (low + high) + 0.5 * (high - low) * node;
                    let part = rise.map_or(1.0, |rise| 1.0 - rise.at(place));
                    nodes.push(self.node(place, 0.5 * share * (high - low) * part)?);
                }
                low = high;
            }
        }
        Ok(Ok(nodes))
    }

    /// The spheres with the series cut behind an order, and how many there are before they are made.
    pub fn zones(
        &self,
        tail: f64,
        cut: u32,
        most: f64,
    ) -> Result<Result<Vec<Zone>, f64>, ZoneError> {
        let stretches = self.stretches(tail);
        let Some(rise) = self.rise(&stretches)? else { return Ok(Ok(Vec::new())) };
        let mut planned = Vec::new();
        for stretch in stretches.into_iter().filter(|stretch| stretch.to > rise.0) {
            let start = stretch.from.max(rise.0);
            for (from, to, cut, up, down) in self.parts(start, stretch, cut) {
                let steps = self.steps(from, to, cut, stretch.step, [Some(rise), up, down])?;
                planned.push((from, to, cut, [Some(rise), up], down, steps, stretch.step));
            }
        }
        let count: f64 = planned.iter().map(|plan| plan.5).sum();
        if count > most {
            return Ok(Err(count));
        }
        let mut zones = Vec::new();
        for (from, to, cut, ups, down, steps, step) in planned {
            let steps = 2 * (0.5 * steps).ceil() as usize;
            let mut nodes = Vec::with_capacity(steps);
            for i in 0..steps {
                let t = (i as f64 + 0.5) / steps as f64;
                // sin² steps make a function that ends in a step end smoothly.
                let (place, share) = if step {
                    (t - (TAU * t).sin() / TAU, 1.0 - (TAU * t).cos())
                } else {
                    (t, 1.0)
                };
                let place = from + (to - from) * place;
                let up: f64 = ups.iter().flatten().map(|rise| rise.at(place)).product();
                let down = down.map_or(1.0, |rise| 1.0 - rise.at(place));
                let width = share * (to - from) / steps as f64;
                nodes.push(self.node(place, width * up * down)?);
            }
            zones.push(Zone { nodes, cut });
        }
        Ok(Ok(zones))
    }

    /// Parts of a stretch, ascending, each with its cut and with the steps that it fades in and out by.
    fn parts(&self, start: f64, stretch: Stretch, cut: u32) -> Vec<Part> {
        let to = stretch.to;
        let whole = vec![(start, to, cut, None, None)];
        let Line::Sizes { sizes, wavelength, .. } = self else { return whole };
        if stretch.step {
            return whole;
        }
        let [one, two] = RARE.map(|share| sizes.limits(share, TAU / wavelength).1);
        let least = LEAST_FADE / self.per_place();
        let width = (SHARE_OF_RARE * (two - one)).min(to - two);
        if !(one - width > start && width > least) {
            return whole;
        }
        let about = |middle: f64| Rise(middle - 0.5 * width, middle + 0.5 * width);
        let (first, second) = (about(one), about(two));
        let (half, quarter) = (cut.div_ceil(4) * 2, cut.div_ceil(8) * 2);
        vec![
            (start, first.1, cut, None, Some(first)),
            (first.0, second.1, half, Some(first), Some(second)),
            (second.0, to, quarter, Some(second), None),
        ]
    }

    /// Number of steps between two places with the series cut behind an order.
    fn steps(
        &self,
        from: f64,
        to: f64,
        cut: u32,
        step: bool,
        rises: [Option<Rise>; 3],
    ) -> Result<f64, ZoneError> {
        let index = self.index()?;
        let per_order = 2.0 * (index.re * index.re - 1.0).max(0.06).sqrt();
        let longest = PATH_MARGIN * per_order * f64::from(cut) + WAYS_OUTSIDE;
        let resolved = (to - from) * self.per_place() * longest / TAU;
        // A step is resolved by nodes one standard deviation apart.
        let inside = |rise: &Rise| rise.1 > from && rise.0 < to;
        let steps = rises.iter().flatten().filter(|rise| inside(rise));
        let smooth = steps.map(|rise| (to - from) / (STEP_DEVIATION * (rise.1 - rise.0)));
        checked_term_count(to * self.per_place(), index)?;
        let least = smooth.fold(LEAST_STEPS, f64::max);
        Ok(resolved.max(least) * if step { 2.0 } else { 1.0 })
    }
}

/// From, to, cut, and the steps up and down.
type Part = (f64, f64, u32, Option<Rise>, Option<Rise>);

/// Why there are no zones.
#[derive(Debug, thiserror::Error)]
pub(super) enum ZoneError {
    #[error(transparent)]
    Series(#[from] SeriesError),
    #[error(transparent)]
    Medium(#[from] MediumError),
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::size_distribution::SizeLaw;

    /// Exact and cut spheres together count every particle once, whatever the law.
    #[test]
    fn every_particle_counts_once() {
        let index = Complex64::new(1.333, 0.0);
        let soot = SizeLaw::LogNormal { median: 12e-9, spread: 0.7 };
        let rain = SizeLaw::marshall_palmer(1.0);
        for sizes in [
            SizeDistribution::whole(SizeLaw::gamma(10e-6, 0.1)),
            SizeDistribution::whole(SizeLaw::gamma(2e-6, 0.3)),
            SizeDistribution::whole(SizeLaw::LogNormal { median: 3e-6, spread: 1e-3 }),
            SizeDistribution::whole(soot.clone()),
            SizeDistribution::between(soot, 5e-9, 2e-6),
            SizeDistribution::between(rain, 1e-6, 30e-6),
        ] {
            let sizes = sizes.unwrap();
            let line = Line::Sizes { sizes: &sizes, wavelength: 550e-9, index };
            let mut number = 0.0;
            let mut shadow = 0.0;
            let zones = line.zones(1e-9, 16, 1e7).unwrap().unwrap();
            let exact = line.exact(1e-9, 0, 1e7).unwrap().unwrap();
            for node in zones.iter().flat_map(|zone| &zone.nodes).chain(&exact) {
                number += node.weight;
                shadow += node.weight * node.radius * node.radius;
            }
            let off = shadow / sizes.moment(2.0) - 1.0;
            assert!(off.abs() < 1e-7, "{sizes:?}: {off:e}, {number}");
        }
    }
}
