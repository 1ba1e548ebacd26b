//! `gonio bench`: run time against error, of the paper's mode and of this engine.
//!
//! The paper's mode (Sadeghi et al. 2012): patches with bilinear paths, the Gaussian filter or none,
//! orders up to 3, one grid size per point. This engine: one tolerance per point. Both answer the
//! same directions; the truth is Lorenz–Mie for spheres and the brute-force Huygens–Fresnel sum for
//! the raindrop.

mod case;
mod figure;
mod paper;

use super::{UsageError, plot};
use anyhow::Result;
use case::Case;
use clap::Args;
use figure::BenchFigure;
use serde::Serialize;
use std::path::PathBuf;
use std::time::Instant;

/// Run time against error: the paper's mode and this engine
#[derive(Args)]
#[command(after_help = "Example: gonio bench -o bench.svg --csv bench.csv --json

Cases: spheres of size parameter 1000 and 5000 against Lorenz–Mie (10–165°), a raindrop of 0.5 mm
against the brute-force Huygens–Fresnel sum (primary bow, order 2). The default grids take about a
minute; 3000 rays across, as in the paper, need several minutes and 10 GB: --rays-across 3000.")]
pub struct BenchArgs {
    /// Plot to write (.png or .svg)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Table to write
    #[arg(long, value_name = "FILE.csv")]
    csv: Option<PathBuf>,
    /// Grid sizes of the paper's mode: rays across the drop
    #[arg(long, value_delimiter = ',', default_value = "50,100,200,400,800",
          value_parser = clap::value_parser!(u32).range(10..=6000))]
    rays_across: Vec<u32>,
    /// Tolerances of this engine
    #[arg(long, value_delimiter = ',', default_value = "0.1,0.03,0.01,0.003,0.001")]
    tolerances: Vec<f64>,
    /// Repetitions of quick runs; the fastest counts
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=1000))]
    repeat: u32,
    /// JSON on standard output
    #[arg(long)]
    json: bool,
}

/// One run.
#[derive(Clone, Debug, Serialize)]
struct Point {
    case: &'static str,
    method: Method,
    /// Rays across the drop, or the tolerance.
    setting: f64,
    seconds: f64,
    /// Relative L2 error of the unpolarised intensity.
    error: f64,
    /// This engine only: the paper's curves (with and without filter) lie above at this run time.
    below_paper: Option<bool>,
}

/// Who computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
enum Method {
    PaperGaussian,
    PaperUnfiltered,
    Engine,
}

impl Method {
    const ALL: [Method; 3] = [Method::PaperGaussian, Method::PaperUnfiltered, Method::Engine];

    fn name(self) -> &'static str {
        match self {
            Method::PaperGaussian => "paper's mode, Gaussian filter",
            Method::PaperUnfiltered => "paper's mode, no filter",
            Method::Engine => "this engine",
        }
    }
}

/// Runs quicker than this are repeated.
const QUICK: f64 = 1.0;

pub fn run(args: BenchArgs) -> Result<()> {
    for &tolerance in &args.tolerances {
        if !(tolerance > 0.0 && tolerance < 1.0) {
            let message = format!("--tolerances {tolerance}: numbers between 0 and 1 are accepted");
            return Err(UsageError(message).into());
        }
    }
    let cases = Case::all()?;
    let mut points = Vec::new();
    for case in &cases {
        points.extend(measure(case, &args)?);
    }
    judge(&mut points);
    if let Some(path) = &args.csv {
        plot::write_whole(path, csv(&points).as_bytes())?;
    }
    if let Some(path) = &args.output {
        let titles = cases.iter().map(|c| (c.name, c.title.clone())).collect();
        plot::save(&BenchFigure { titles, points: &points }, path, figure::SIZE)?;
    }
    if args.json {
        let names: Vec<_> =
            cases.iter().map(|c| serde_json::json!({"case": c.name, "title": c.title})).collect();
        let threads = rayon::current_num_threads();
        println!("{}", serde_json::json!({ "threads": threads, "cases": names, "points": points }));
    } else {
        print!("{}", csv(&points));
    }
    Ok(())
}

/// All runs of one case.
fn measure(case: &Case, args: &BenchArgs) -> Result<Vec<Point>> {
    let mut points = Vec::new();
    let mut add = |method, setting, seconds, intensities: &[f64]| {
        let error = case.error(intensities);
        points.push(Point { case: case.name, method, setting, seconds, error, below_paper: None });
    };
    for &across in &args.rays_across {
        let ((plain, filtered), seconds) =
            timed(args.repeat, || paper::intensities(case, across as usize));
        add(Method::PaperGaussian, f64::from(across), seconds, &filtered);
        add(Method::PaperUnfiltered, f64::from(across), seconds, &plain);
    }
    for &tolerance in &args.tolerances {
        let (intensities, seconds) = timed(args.repeat, || case.engine(tolerance));
        add(Method::Engine, tolerance, seconds, &intensities);
    }
    Ok(points)
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

fn csv(points: &[Point]) -> String {
    let mut text = String::from("case,method,setting,seconds,relative_l2_error,below_paper\n");
    for p in points {
        let below = p.below_paper.map(|b| b.to_string()).unwrap_or_default();
        let name = p.method.name().replace(',', "");
        text +=
            &format!("{},{name},{},{:.4},{:.5},{below}\n", p.case, p.setting, p.seconds, p.error);
    }
    text
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
