//! `gonio render`: a picture of a rainbow.

mod over;

use crate::cli::args::output::Output;
use crate::cli::command_line::command_line;
use crate::cli::failure::Result;
use crate::cli::show::{notes, progress};
use clap::Args;
use gonio::render::bow::{BowScene, DropKeys, RainKeys};
use over::OverArgs;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Picture of a rainbow, from a scene file or from a table
#[derive(Args)]
#[command(after_help = "Examples: gonio render data/scenes/bows/double.toml -o bow.png
          gonio render --table raindrop.h5 --fov-deg 60 -o bow.png
          gonio render data/scenes/bows/double.toml --over photo.jpg --horizon-px 900 --fit -o bow.png")]
pub struct RenderArgs {
    /// Scene of a picture; without one, --table
    #[arg(value_name = "SCENE.toml", required_unless_present = "table")]
    scene: Option<PathBuf>,
    /// PNG to write
    #[arg(short, long, value_name = "BOW.png")]
    output: PathBuf,
    /// Replace a picture of the same name
    #[arg(long)]
    overwrite: bool,
    /// Table of the drops, in place of the scene's
    #[arg(long, value_name = "TABLE.h5")]
    table: Vec<PathBuf>,
    /// Width in pixels
    #[arg(long)]
    width: Option<usize>,
    /// Height in pixels
    #[arg(long)]
    height: Option<usize>,
    /// Field of view across the width
    #[arg(long, value_name = "DEG")]
    fov_deg: Option<f64>,
    /// rectilinear, fisheye (equidistant), equal-area, stereographic or orthographic
    #[arg(long)]
    lens: Option<String>,
    /// Elevation of the camera's axis
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    elevation_deg: Option<f64>,
    /// Azimuth of the camera's axis from the antisolar direction, to the right
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    azimuth_deg: Option<f64>,
    /// Sun above the horizon (default: the table's)
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    sun_elevation_deg: Option<f64>,
    /// Polarising filter: angle of its axis from the horizontal
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    polariser_deg: Option<f64>,
    /// Circles of 42° and 51° about the antisolar point, it, and the horizon, with their names
    #[arg(long)]
    grid: bool,
    /// A layer of this optical depth, in which light is scattered many times, in place of the rain
    #[arg(long, value_name = "DEPTH", allow_negative_numbers = true)]
    layer_optical_depth: Option<f64>,
    /// Where the layer is: curtain (upright before the observer), above or below
    #[arg(long, value_name = "PLACE")]
    layer_place: Option<String>,
    /// Share of light that the ground behind the layer throws back
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true)]
    ground_albedo: Option<f64>,
    /// How often light is scattered in the layer: auto, single or multiple
    #[arg(long)]
    scattering: Option<String>,
    /// Light: D65, A, E, D50, 5778K, sun, sun-ground, sun@DEGREES
    #[arg(long)]
    illuminant: Option<String>,
    #[command(flatten)]
    over: OverArgs,
}

pub fn run(args: RenderArgs) -> Result<()> {
    let start = Instant::now();
    let output = Output { flag: "--output", path: &args.output, kind: "a PNG", endings: &["png"] };
    output.check_new(args.overwrite)?;
    let mut scene = match &args.scene {
        Some(path) => BowScene::load(path)?,
        None => BowScene::default(),
    };
    let folder = args.scene.as_deref().and_then(Path::parent).unwrap_or(Path::new("."));
    if !args.table.is_empty() {
        scene.drops = args.table.iter().map(|table| DropKeys::table(table)).collect();
    }
    let drop_folder = if args.table.is_empty() { folder } else { Path::new(".") };
    let lay = |flag: &Option<f64>, key: &mut Option<f64>| *key = flag.or(*key);
    lay(&args.fov_deg, &mut scene.camera.fov_deg);
    lay(&args.elevation_deg, &mut scene.camera.elevation_deg);
    lay(&args.azimuth_deg, &mut scene.camera.azimuth_deg);
    lay(&args.sun_elevation_deg, &mut scene.sun.elevation_deg);
    lay(&args.polariser_deg, &mut scene.filter.polariser_deg);
    scene.camera.grid |= args.grid;
    lay(&args.layer_optical_depth, &mut scene.layer.optical_depth);
    lay(&args.ground_albedo, &mut scene.layer.ground_albedo);
    if args.layer_optical_depth.is_some() {
        // the flag is a wish for a layer: it takes the place of the scene's rain
        scene.rain = RainKeys::default();
    }
    scene.layer.place = args.layer_place.clone().or(scene.layer.place);
    scene.layer.scattering = args.scattering.clone().or(scene.layer.scattering);
    scene.camera.width = args.width.or(scene.camera.width);
    scene.camera.height = args.height.or(scene.camera.height);
    scene.camera.lens = args.lens.clone().or(scene.camera.lens);
    scene.sun.illuminant = args.illuminant.clone().or(scene.sun.illuminant);

    let picture = match args.over.photograph() {
        Some(photo) => args.over.draw(photo, &mut scene, drop_folder, args.fov_deg)?,
        None => {
            let spinner = progress::spinner("drops and sky");
            let picture =
                scene.draw(drop_folder, &|note| spinner.suspend(|| notes::tell([note])))?;
            spinner.finish_and_clear();
            picture
        }
    };
    notes::step(|| "drawn".into());
    let mut about = vec![("Comment", command_line())];
    if let Some(path) = &args.scene {
        about.push(("Scene", std::fs::read_to_string(path)?));
    }
    let about: Vec<(&str, &str)> = about.iter().map(|(name, text)| (*name, &**text)).collect();
    picture.write_png_about(&args.output, &about)?;
    let (seconds, path) = (start.elapsed().as_secs_f64(), args.output.display());
    println!("{path}: {} × {} pixels, {seconds:.1} s", picture.width, picture.height);
    Ok(())
}
