//! Run time against error: the published method and this engine.
//!
//! The paper's mode (Sadeghi et al. 2012): patches with bilinear paths, the Gaussian filter or none,
//! orders up to 3, one grid size per point. This engine: one tolerance per point. Both answer the
//! same directions; the truth is Lorenz–Mie for spheres and the brute-force Huygens–Fresnel sum for
//! the raindrop.

mod case;
mod paper;

pub use case::{SpeedCase, SpeedError};

use serde::Serialize;
use std::time::Instant;

/// How finely each method is tried.
#[derive(Clone, Debug)]
pub struct Trials {
    /// Rays across the drop, for the paper's mode.
    pub rays_across: Vec<u32>,
    /// For this engine.
    pub tolerances: Vec<f64>,
    /// Repetitions of quick runs; the fastest counts.
    pub repeat: u32,
}

/// One run.
#[derive(Clone, Debug, Serialize)]
pub struct Point {
    /// Name of the case.
    pub case: &'static str,
    pub method: Method,
    /// Rays across the drop, or the tolerance.
    pub setting: f64,
    pub seconds: f64,
    /// Relative L2 error of the unpolarised intensity.
    pub error: f64,
    /// This engine only: the paper's curves (with and without filter) lie above at this run time.
    pub below_paper: Option<bool>,
}

/// Who computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    PaperGaussian,
    PaperUnfiltered,
    Engine,
}

impl Method {
    /// In the order of the legend.
    pub const ALL: [Method; 3] = [Method::PaperGaussian, Method::PaperUnfiltered, Method::Engine];

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Method::PaperGaussian => "paper's mode, Gaussian filter",
            Method::PaperUnfiltered => "paper's mode, no filter",
            Method::Engine => "this engine",
        }
    }
}

/// Runs quicker than this are repeated.
const QUICK: f64 = 1.0;

/// All runs of some cases, judged.
pub fn measured(cases: &[SpeedCase], trials: &Trials) -> Vec<Point> {
    let mut points: Vec<Point> = cases.iter().flat_map(|case| measure(case, trials)).collect();
    judge(&mut points);
    points
}

/// All runs of one case.
fn measure(case: &SpeedCase, trials: &Trials) -> Vec<Point> {
    let mut points = Vec::new();
    let mut add = |method, setting, seconds, intensities: &[f64]| {
        let error = case.error(intensities);
        points.push(Point { case: case.name, method, setting, seconds, error, below_paper: None });
    };
    for &across in &trials.rays_across {
        let ((plain, filtered), seconds) =
            timed(trials.repeat, || paper::intensities(case, across as usize));
        add(Method::PaperGaussian, f64::from(across), seconds, &filtered);
        add(Method::PaperUnfiltered, f64::from(across), seconds, &plain);
    }
    for &tolerance in &trials.tolerances {
        let (intensities, seconds) = timed(trials.repeat, || case.engine(tolerance));
        add(Method::Engine, tolerance, seconds, &intensities);
    }
    points
}

/// A result and the least time it took.
fn timed<T>(repeat: u32, mut work: impl FnMut() -> T) -> (T, f64) {
    let mut best = f64::INFINITY;
    let mut runs = 0;
    loop {
        let start = Instant::now();
        let result = work();
        best = best.min(start.elapsed().as_secs_f64());
        runs += 1;
        if runs >= repeat || best > QUICK {
            return (result, best);
        }
    }
}

/// Mark the engine's points that lie below both curves of the paper.
fn judge(points: &mut [Point]) {
    let all = points.to_vec();
    let engine = |p: &&mut Point| p.method == Method::Engine;
    for point in points.iter_mut().filter(engine) {
        let below = |method: Method| {
            let curve: Vec<(f64, f64)> = all
                .iter()
                .filter(|p| p.case == point.case && p.method == method)
                .map(|p| (p.seconds.ln(), p.error.ln()))
                .collect();
            at(curve, point.seconds.ln()).is_none_or(|error| point.error.ln() < error)
        };
        let verdict = below(Method::PaperGaussian) && below(Method::PaperUnfiltered);
        point.below_paper = Some(verdict);
    }
}

/// A curve through points, straight between them and constant beyond its ends.
fn at(mut curve: Vec<(f64, f64)>, x: f64) -> Option<f64> {
    curve.sort_by(|a, b| a.0.total_cmp(&b.0));
    let after = curve.partition_point(|p| p.0 < x);
    let (last, first) = (*curve.last()?, *curve.first()?);
    if after == 0 {
        return Some(first.1);
    }
    if after == curve.len() {
        return Some(last.1);
    }
    let ((x0, y0), (x1, y1)) = (curve[after - 1], curve[after]);
    Some(y0 + (y1 - y0) * (x - x0) / (x1 - x0).max(f64::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_are_straight_between_their_points() {
        let curve = vec![(2.0, 1.0), (0.0, 3.0)];
        assert_eq!(at(curve.clone(), 1.0), Some(2.0));
        assert_eq!(at(curve.clone(), -5.0), Some(3.0));
        assert_eq!(at(curve, 9.0), Some(1.0));
        assert_eq!(at(vec![], 9.0), None);
    }

    #[test]
    fn a_point_above_a_curve_is_told() {
        let point = |method, seconds, error| Point {
            case: "c",
            method,
            setting: 1.0,
            seconds,
            error,
            below_paper: None,
        };
        let mut points = vec![
            point(Method::PaperGaussian, 1.0, 0.1),
            point(Method::PaperUnfiltered, 1.0, 0.5),
            point(Method::Engine, 0.5, 0.09),
            point(Method::Engine, 0.5, 0.2),
        ];
        judge(&mut points);
        let verdicts: Vec<_> = points.iter().map(|p| p.below_paper).collect();
        assert_eq!(verdicts, [None, None, Some(true), Some(false)]);
    }
}
