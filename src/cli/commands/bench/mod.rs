//! `gonio bench`: run time against error, of the paper's mode and of this engine.

mod figure;

use crate::cli::args::output::Output;
use crate::cli::failure::{Failure, Result};
use crate::cli::show::{plot, progress};
use clap::Args;
use figure::BenchFigure;
use gonio::compare::speed::{Point, SpeedCase, Trials, measured};
use std::path::PathBuf;

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

pub fn run(args: BenchArgs) -> Result<()> {
    if let Some(path) = &args.output {
        Output { flag: "--output", path, kind: "a plot", endings: &["png", "svg"] }.check()?;
    }
    if let Some(path) = &args.csv {
        Output { flag: "--csv", path, kind: "CSV", endings: &[] }.check()?;
    }
    for &tolerance in &args.tolerances {
        if !(tolerance > 0.0 && tolerance < 1.0) {
            let message = format!("--tolerances {tolerance}: numbers between 0 and 1 are accepted");
            return Err(Failure::usage(message));
        }
    }
    let cases = SpeedCase::all()?;
    let BenchArgs { rays_across, tolerances, repeat, .. } = &args;
    let (rays_across, tolerances) = (rays_across.clone(), tolerances.clone());
    let spinner = progress::spinner("runs");
    let points = measured(&cases, &Trials { rays_across, tolerances, repeat: *repeat });
    spinner.finish_and_clear();
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
