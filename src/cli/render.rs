//! `gonio render`: a picture of a rainbow.

use super::UsageError;
use super::render_drops::{DropKeys, tables};
use anyhow::Context;
use clap::Args;
use gonio::color::{ColorError, decode_srgb};
use gonio::phase_table::PhaseTable;
use gonio::render::RenderError;
use gonio::render::camera::Camera;
use gonio::render::sky::{Drops, RainShape, Sky, render};
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// Picture of a rainbow, from a scene file or from a table
#[derive(Args)]
#[command(after_help = "Examples: gonio render data/scenes/bows/double.toml -o bow.png
          gonio render --table raindrop.h5 --fov-deg 60 -o bow.png")]
pub struct RenderArgs {
    /// Scene of a picture; without one, --table
    #[arg(value_name = "SCENE.toml", required_unless_present = "table")]
    scene: Option<PathBuf>,
    /// PNG to write
    #[arg(short, long, value_name = "BOW.png")]
    output: PathBuf,
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
    /// rectilinear, equidistant, equal-area, stereographic or orthographic
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
    /// Light: D65, A, E, D50, 5778K, sun, sun-ground, sun@DEGREES
    #[arg(long)]
    illuminant: Option<String>,
}

/// A picture's scene as written.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RenderScene {
    sun: SunKeys,
    camera: CameraKeys,
    rain: RainKeys,
    sky: SkyKeys,
    filter: FilterKeys,
    drops: Vec<DropKeys>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct SunKeys {
    elevation_deg: Option<f64>,
    disc: Option<bool>,
    illuminant: Option<String>,
    observer: Option<String>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct CameraKeys {
    width: Option<usize>,
    height: Option<usize>,
    fov_deg: Option<f64>,
    lens: Option<String>,
    elevation_deg: Option<f64>,
    azimuth_deg: Option<f64>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct RainKeys {
    optical_depth: Option<f64>,
    /// `curtain` or `around`.
    shape: Option<String>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct SkyKeys {
    /// sRGB, 0 to 255.
    background: Option<[u8; 3]>,
    ground: Option<[u8; 3]>,
    brightness: Option<f64>,
    exposure: Option<f64>,
    horizon_line: bool,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct FilterKeys {
    polariser_deg: Option<f64>,
}

pub fn run(args: RenderArgs) -> anyhow::Result<()> {
    let mut scene = match &args.scene {
        Some(path) => read_scene(path)?,
        None => RenderScene::default(),
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
    scene.camera.width = args.width.or(scene.camera.width);
    scene.camera.height = args.height.or(scene.camera.height);
    scene.camera.lens = args.lens.clone().or(scene.camera.lens);
    scene.sun.illuminant = args.illuminant.clone().or(scene.sun.illuminant);

    let polarised = scene.filter.polariser_deg.is_some();
    let asked = scene.sun.elevation_deg;
    // What the scene says wrong is told before drops are computed.
    sky(&scene, asked.unwrap_or(20.0).to_radians())?;
    camera(&scene, asked.unwrap_or(20.0).to_radians())?;
    let tables = tables(&scene.drops, drop_folder, asked.unwrap_or(20.0), polarised)?;
    note_on_disc(&tables, scene.sun.disc);
    let elevation = asked.map(f64::to_radians).unwrap_or_else(|| {
        tables
            .iter()
            .map(|(t, _)| &t.header)
            .find(|h| !h.rotational_symmetry)
            .map_or(20f64.to_radians(), |header| header.sun_elevation)
    });
    check_sun(elevation, &tables)?;
    let sky = sky(&scene, elevation)?;
    let camera = camera(&scene, elevation)?;
    let drops: Vec<Drops<'_>> =
        tables.iter().map(|(table, number)| Drops { table, number: *number }).collect();
    let picture = render(&camera, &sky, &drops).map_err(wrong_input)?;
    picture.write_png(&args.output)?;
    Ok(())
}

/// Say where the sun's disc is in a table already, so that the picture leaves it alone.
fn note_on_disc(tables: &[(PhaseTable, f64)], asked: Option<bool>) {
    if tables.iter().any(|(table, _)| table.header.averaging.has_sun_disc()) {
        let wish = match asked {
            Some(false) => "; sun.disc = false cannot take it out",
            _ => " and is not applied again",
        };
        eprintln!("note: the sun's disc is in the table already{wish}");
    }
}

/// Refuses a sun elsewhere than where the table of a drop that is no sphere has it.
fn check_sun(elevation: f64, tables: &[(PhaseTable, f64)]) -> anyhow::Result<()> {
    /// Degrees, as people round them.
    const ROUNDING: f64 = 0.01;
    let given = elevation.to_degrees();
    let suns = tables.iter().map(|(table, _)| &table.header);
    let bound = suns.filter(|header| !header.rotational_symmetry);
    let other = bound.map(|header| header.sun_elevation.to_degrees());
    match other.into_iter().find(|own| (own - given).abs() > ROUNDING) {
        Some(own) => Err(UsageError(format!(
            "sun.elevation_deg = {given}: a table of the drops was made for the sun at {own}°; \
             make one for {given}°, or leave the elevation out"
        ))
        .into()),
        None => Ok(()),
    }
}

fn read_scene(path: &Path) -> anyhow::Result<RenderScene> {
    let text = std::fs::read_to_string(path)
        .map_err(|error| UsageError(format!("{}: {error}", path.display())))?;
    let scene: RenderScene = toml::from_str(&text)
        .map_err(|error| UsageError(format!("{}: {error}", path.display())))
        .context("the scene of the picture cannot be read")?;
    Ok(scene)
}

/// Fields that make no sense are the user's; a failed write is not.
fn wrong_input(error: RenderError) -> anyhow::Error {
    match error {
        RenderError::Color(_) | RenderError::Invalid { .. } => UsageError(error.to_string()).into(),
        other => other.into(),
    }
}

fn camera(scene: &RenderScene, sun_elevation: f64) -> anyhow::Result<Camera> {
    let keys = &scene.camera;
    let lens = keys.lens.as_deref().unwrap_or("rectilinear").parse().map_err(wrong_input)?;
    // Look at the top of the primary bow, 42° above the antisolar point, unless told otherwise.
    let top = (42.0 - sun_elevation.to_degrees()).clamp(-60.0, 60.0);
    let camera = Camera {
        lens,
        field_of_view: keys.fov_deg.unwrap_or(60.0).to_radians(),
        elevation: keys.elevation_deg.unwrap_or(0.6 * top).to_radians(),
        azimuth: keys.azimuth_deg.unwrap_or(0.0).to_radians(),
        width: keys.width.unwrap_or(1280),
        height: keys.height.unwrap_or(720),
    };
    camera.validate().map_err(wrong_input)?;
    Ok(camera)
}

fn sky(scene: &RenderScene, sun_elevation: f64) -> anyhow::Result<Sky> {
    let degrees = sun_elevation.to_degrees();
    if !(0.0..=90.0).contains(&degrees) {
        let message = format!("sun.elevation_deg = {degrees}: accepted are 0 to 90");
        return Err(UsageError(message).into());
    }
    let rain = match scene.rain.shape.as_deref() {
        None | Some("curtain") => RainShape::Curtain,
        Some("around") => RainShape::Around,
        Some(other) => {
            let message = format!("rain.shape = \"{other}\": accepted are curtain and around");
            return Err(UsageError(message).into());
        }
    };
    let color = |error: ColorError| UsageError(error.to_string());
    let linear = |rgb: [u8; 3]| rgb.map(|v| decode_srgb(f64::from(v) / 255.0));
    Ok(Sky {
        sun_elevation,
        sun_disc: scene.sun.disc.unwrap_or(true),
        illuminant: scene.sun.illuminant.as_deref().unwrap_or("D65").parse().map_err(color)?,
        observer: scene.sun.observer.as_deref().unwrap_or("1931").parse().map_err(color)?,
        rain,
        optical_depth: scene.rain.optical_depth.unwrap_or(1.0),
        background: linear(scene.sky.background.unwrap_or([107, 114, 118])),
        ground: scene.sky.ground.map(linear),
        brightness: scene.sky.brightness.unwrap_or(0.45),
        exposure: scene.sky.exposure,
        polariser: scene.filter.polariser_deg.map(f64::to_radians),
        horizon_line: scene.sky.horizon_line,
    })
}
