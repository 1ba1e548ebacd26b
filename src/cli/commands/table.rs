//! `gonio table`: from a scene to a tabulated phase function.

use crate::cli::args::memory::MemoryFlag;
use crate::cli::args::output::Output;
use crate::cli::args::scene_flags::SceneFlags;
use crate::cli::command_line::command_line;
use crate::cli::failure::{Failure, Result};
use crate::cli::show::{notes, progress};
use clap::Args;
use gonio::hdf5::{TableWriter, WriteOptions};
use gonio::phase_table::Slab;
use gonio::render::{Thinned, preview};
use gonio::scene::{Scene, human_bytes};
use gonio::simulate;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Tabulate the phase function of a scene (the main job)
#[derive(Args)]
#[command(after_help = "Example: gonio table data/scenes/raindrop.toml -o raindrop.h5

Without a scene: a raindrop of 0.5 mm, the sun at 20 degrees. Every key of a scene file has a flag
of the same name, which wins over the file.")]
pub struct TableArgs {
    /// Scene file; without one, the built-in raindrop
    #[arg(value_name = "SCENE.toml")]
    scene: Option<PathBuf>,
    /// HDF5 file to write; a picture of the same name is put beside it
    #[arg(short, long, value_name = "OUT.h5")]
    output: PathBuf,
    /// Replace files of these names
    #[arg(long)]
    overwrite: bool,
    /// No picture beside the table
    #[arg(long)]
    no_preview: bool,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    memory: MemoryFlag,
    #[command(flatten)]
    flags: SceneFlags,
}

/// What a finished table is judged by.
#[derive(Default)]
struct Summary {
    seconds: f64,
    /// Largest over the wavelengths, both.
    error_estimate: f64,
    error_by_band: f64,
    /// Wavelengths at which the error asked for is not met.
    missed: usize,
    /// Largest over the wavelengths; `None` where the method has no energy budget.
    energy_residual: Option<f64>,
}

pub fn run(args: TableArgs) -> Result<()> {
    let scene = args.flags.scene(args.scene.as_deref())?;
    let preview = preview_path(&args)?;
    Output { flag: "--output", path: &args.output, kind: "HDF5", endings: &[] }.check()?;
    args.memory.check(&scene)?;
    notes::step(|| {
        let (wavelengths, theta, phi) =
            (scene.wavelengths.len(), scene.theta.len(), scene.phi.len());
        format!("{wavelengths} wavelengths × {theta} scattering angles × {phi} azimuths")
    });
    let (summary, thinned) = tabulate(&scene, &args)?;
    notes::wrote(&args.output);
    if let Some(path) = &preview {
        preview::write_png(&thinned.into_table(), path)?;
        notes::wrote(path);
    }
    report(&scene, &args, preview.as_deref(), &summary)
}

/// Where the picture goes, checked before anything is computed.
fn preview_path(args: &TableArgs) -> Result<Option<PathBuf>> {
    let picture = args.output.with_extension("png");
    if picture == args.output {
        let message = "a table is an HDF5 file; give it another ending, such as .h5";
        return Err(Failure::usage(format!("--output = {}: {message}", picture.display())));
    }
    if args.no_preview {
        return Ok(None);
    }
    if picture.exists() && !args.overwrite {
        let message = "the picture of the table would replace it; choose another name, or \
                       --overwrite, or --no-preview";
        return Err(Failure::usage(format!("{}: the file exists; {message}", picture.display())));
    }
    Ok(Some(picture))
}

/// Compute and write, wavelength by wavelength.
fn tabulate(scene: &Scene, args: &TableArgs) -> Result<(Summary, Thinned)> {
    let start = Instant::now();
    let header = simulate::header(scene, command_line())?;
    let options = WriteOptions {
        bit_round: scene.bit_round,
        overwrite: args.overwrite,
        ..WriteOptions::default()
    };
    let mut writer = TableWriter::create(&args.output, &header, options)?;
    let mut thinned = Thinned::new(&header);
    let mut summary = Summary::default();
    let progress = progress::bar(scene.wavelengths.len(), "wavelengths");
    simulate::simulate(scene, |index, slab| -> Result<()> {
        writer.write_slab(index, &slab)?;
        summary.add(&slab);
        thinned.add(index, &slab);
        progress.inc(1);
        notes::step(|| {
            let (nm, error) = (slab.wavelength * 1e9, slab.error_estimate);
            format!("{nm:.3} nm: error estimate {error:.1e}")
        });
        Ok(())
    })?;
    progress.finish_and_clear();
    writer.finish()?;
    summary.seconds = start.elapsed().as_secs_f64();
    Ok((summary, thinned))
}

impl Summary {
    fn add(&mut self, slab: &Slab) {
        self.error_estimate = self.error_estimate.max(slab.error_estimate);
        self.error_by_band = self.error_by_band.max(slab.error_by_band);
        self.missed += usize::from(slab.tolerance_met == Some(false));
        if let Some(energy) = &slab.energy {
            let residual = self.energy_residual.unwrap_or(0.0).max(energy.residual.abs());
            self.energy_residual = Some(residual);
        }
    }
}

fn report(
    scene: &Scene,
    args: &TableArgs,
    preview: Option<&Path>,
    summary: &Summary,
) -> Result<()> {
    if summary.missed > 0 {
        notes::tell([format!(
            "the error asked for, {}, is not met at {} of {} wavelengths; the table says so",
            scene.tolerance,
            summary.missed,
            scene.wavelengths.len()
        )]);
    }
    let bytes = std::fs::metadata(&args.output)?.len();
    if args.json {
        let report = serde_json::json!({
            "table": args.output,
            "preview": preview,
            "bytes": bytes,
            "seconds": summary.seconds,
            "error_estimate": summary.error_estimate,
            "error_estimate_by_band": summary.error_by_band,
            "energy_residual": summary.energy_residual,
            "tolerance": scene.tolerance,
            "wavelengths_beyond_tolerance": summary.missed,
        });
        println!("{report}");
        return Ok(());
    }
    println!(
        "{}: {} wavelengths, {} scattering angles, {}",
        args.output.display(),
        scene.wavelengths.len(),
        scene.theta.len(),
        human_bytes(bytes)
    );
    if let Some(preview) = preview {
        println!("{}: picture", preview.display());
    }
    println!(
        "computed in {:.1} s on {} threads; estimated relative error {:.1e} weighted by intensity, \
         {:.1e} on average over angles",
        summary.seconds,
        rayon::current_num_threads(),
        summary.error_estimate,
        summary.error_by_band
    );
    if let Some(residual) = summary.energy_residual {
        println!("energy that the rays lost count of: {residual:.1e} of what came in");
    }
    Ok(())
}
