//! `gonio compare`: how far a result is from Lorenz–Mie, or one table from another.

use super::UsageError;
use super::render_drops::mie_table;
use anyhow::Context;
use clap::Args;
use gonio::compare::{Case, Entry, measure, page, worst};
use gonio::phase_table::PhaseTable;
use gonio::render::write_complete;
use gonio::scene::{
    Choice, Diffraction, Grid, Method, Orders, Particle, Scene, SceneFile, ShapeName,
};
use gonio::simulate::{self, SimulateError};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Report of rays against Lorenz–Mie, or of two tables: HTML page and JSON
#[derive(Args)]
#[command(after_help = "Examples: gonio compare -o report.html --json report.json
          gonio compare --table mine.h5 --reference exact.h5 -o report.html

Without a case: spheres of 0.1 and 0.3 mm at 550 nm. Exit code 1 when an L2 error is above
--fail-above in any band.")]
pub struct CompareArgs {
    /// Scene of a sphere to compute by rays and by Lorenz–Mie (repeatable)
    #[arg(long, value_name = "CASE.toml")]
    case: Vec<PathBuf>,
    /// Table to compare with --reference
    #[arg(long, value_name = "TABLE.h5", requires = "reference", conflicts_with = "case")]
    table: Option<PathBuf>,
    /// Table that counts as the truth
    #[arg(long, value_name = "TABLE.h5", requires = "table")]
    reference: Option<PathBuf>,
    /// HTML page to write
    #[arg(short, long, value_name = "REPORT.html")]
    output: PathBuf,
    /// JSON of every number to write
    #[arg(long, value_name = "REPORT.json")]
    json: Option<PathBuf>,
    /// Fail (exit code 1) if the L2 error of any band is above this
    #[arg(long, value_name = "ERROR")]
    fail_above: Option<f64>,
}

pub fn run(args: CompareArgs) -> anyhow::Result<()> {
    let cases = match (&args.table, &args.reference) {
        (Some(table), Some(reference)) => vec![Case {
            name: format!("{} against {}", table.display(), reference.display()),
            reference: read(reference)?,
            tests: vec![read(table)?],
        }],
        _ if args.case.is_empty() => {
            [0.1, 0.3].iter().map(|&radius| built_in(radius)).collect::<anyhow::Result<Vec<_>>>()?
        }
        _ => {
            let load = |path: &PathBuf| {
                let scene = Scene::load(path, &SceneFile::default())?;
                against_mie(path.display().to_string(), scene)
            };
            args.case.iter().map(load).collect::<anyhow::Result<Vec<_>>>()?
        }
    };
    let reports = cases.iter().map(measure).collect::<Result<Vec<_>, _>>()?;
    let command = std::env::args().collect::<Vec<_>>().join(" ");
    write_complete(&args.output, page::html(&cases, &reports, &command).as_bytes())?;
    if let Some(path) = &args.json {
        write_complete(path, serde_json::to_string_pretty(&reports)?.as_bytes())?;
    }
    let worst = worst(&reports);
    match args.fail_above {
        Some(limit) if worst.is_nan() || worst > limit => {
            anyhow::bail!("the largest L2 error of a band is {worst:.4}, above {limit}")
        }
        _ => Ok(()),
    }
}

fn read(path: &Path) -> anyhow::Result<Entry> {
    let table = gonio::hdf5::read(path)?;
    Ok(Entry { name: path.display().to_string(), table, seconds: None })
}

fn built_in(radius_mm: f64) -> anyhow::Result<Case> {
    let mut file = SceneFile::default();
    file.particle.shape = Some(Choice(ShapeName::Sphere));
    file.particle.radius_mm = Some(radius_mm);
    file.light.wavelengths_nm = Some(Grid::List(vec![550.0]));
    file.table.theta_deg = Some(Grid::Range { from: 0.0, to: 180.0, count: 7201 });
    file.table.azimuth_deg = Some(Grid::List(vec![0.0]));
    file.table.quantity = Some(Choice(gonio::phase_table::Quantity::Mueller));
    file.table.forward_peak = Some(Choice(gonio::phase_table::ForwardPeak::Point));
    against_mie(format!("Sphere of {radius_mm} mm, water, 550 nm"), file.validate()?)
}

/// Rays with everything, without diffraction, and with the first orders only, against Lorenz–Mie.
fn against_mie(name: String, scene: Scene) -> anyhow::Result<Case> {
    let Particle::Sphere { radius } = scene.particle else {
        let message = format!("{name}: shape: Lorenz–Mie is the reference, so a sphere is needed");
        return Err(UsageError(message).into());
    };
    let start = Instant::now();
    let reference = mie_table(
        &scene.medium,
        radius,
        scene.wavelengths.clone(),
        scene.theta.clone(),
        scene.quantity,
    )?;
    let reference = Entry {
        name: "Lorenz–Mie".into(),
        table: reference,
        seconds: Some(start.elapsed().as_secs_f64()),
    };
    let mut rays = scene;
    rays.method = Method::Rays;
    let with = |change: &dyn Fn(&mut Scene)| {
        let mut scene = rays.clone();
        change(&mut scene);
        scene
    };
    let variants = [
        ("rays", rays.clone()),
        ("rays, orders 0 to 3", with(&|s| s.orders = Orders::List(vec![0, 1, 2, 3]))),
        ("rays, without order 2", with(&|s| s.orders = Orders::List(vec![0, 1, 3]))),
        ("rays, diffraction off", with(&|s| s.diffraction = Diffraction::None)),
        ("rays, interference off", with(&|s| s.interference = false)),
    ];
    let tests = variants
        .into_iter()
        .map(|(name, scene)| {
            let start = Instant::now();
            let table = table(&scene).with_context(|| name.to_string())?;
            let seconds = Some(start.elapsed().as_secs_f64());
            Ok(Entry { name: name.into(), table, seconds })
        })
        .collect::<anyhow::Result<Vec<_>>>()?;
    Ok(Case { name, reference, tests })
}

fn table(scene: &Scene) -> anyhow::Result<PhaseTable> {
    let header = simulate::header(scene, String::new())?;
    let mut slabs = Vec::new();
    simulate::simulate::<SimulateError>(scene, |_, slab| {
        slabs.push(slab);
        Ok(())
    })?;
    Ok(PhaseTable { header, slabs })
}
