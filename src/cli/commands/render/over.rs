//! `gonio render --over`: the bow over a photograph, and the drops that fit it.

use crate::cli::failure::Result;
use crate::cli::show::{notes, progress};
use clap::Args;
use gonio::color::xyz_to_linear_srgb;
use gonio::lee::{self, LeeError, Polarisation, Request};
use gonio::medium::MediumSpec;
use gonio::render::Picture;
use gonio::render::bow::{BowScene, DropKeys};
use gonio::render::camera::Camera;
use gonio::render::photo::{
    Bow, Curve, CutPlan, Fitted, LinearPicture, PhotoError, Start, Taken, aimed_by_antisolar,
    aimed_by_horizon, cut, fit, sun_position, unix_seconds,
};
use image::imageops;
use std::path::{Path, PathBuf};

/// What a photograph needs besides.
#[derive(Args)]
pub struct OverArgs {
    /// Photograph (JPEG or PNG) that the bow is added to, as light; its EXIF tells lens, time and place
    #[arg(long, value_name = "PHOTO.jpg")]
    over: Option<PathBuf>,
    /// Row of the horizon at the middle of the photograph, pixels from the top
    #[arg(
        long,
        value_name = "ROW",
        requires = "over",
        allow_negative_numbers = true,
        conflicts_with = "elevation_deg"
    )]
    horizon_px: Option<f64>,
    /// Antisolar point of the photograph (the shadow of the camera), pixels from the left and the top; may lie outside
    #[arg(long, value_name = "COLUMN,ROW", requires = "over", value_parser = pair, allow_hyphen_values = true,
          conflicts_with_all = ["horizon_px", "elevation_deg", "azimuth_deg"])]
    antisolar_px: Option<[f64; 2]>,
    /// When it was taken, as 2024-06-20T19:30:00+02:00
    #[arg(long, value_name = "TIME", requires = "over")]
    time: Option<String>,
    /// Where it was taken: latitude and longitude, north and east positive
    #[arg(long, value_name = "LAT,LON", requires = "over", value_parser = pair, allow_hyphen_values = true)]
    place: Option<[f64; 2]>,
    /// Luminance that the bow adds at its brightest; 1 is white
    #[arg(long, requires = "over", allow_negative_numbers = true)]
    strength: Option<f64>,
    /// Find drop size, spread, sun and aim that fit the photograph's bow, from the aim given
    #[arg(long, requires = "over")]
    fit: bool,
}

/// Two numbers with a comma between them.
fn pair(text: &str) -> Result<[f64; 2], String> {
    let read = |part: &str| part.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    let numbers = text.split_once(',').and_then(|(a, b)| Some([read(a)?, read(b)?]));
    numbers.ok_or_else(|| "two numbers with a comma between them are accepted".into())
}

/// Luminance of the bow unless told.
const USUAL_STRENGTH: f64 = 0.2;
/// Scattering angles of cuts and curves, degrees, and their steps.
const CUT: [f64; 2] = [124.0, 160.0];
const CUT_STEPS: usize = 240;
const CURVE: [f64; 2] = [116.0, 168.0];
const CURVE_STEPS: usize = 700;
const SECTORS: usize = 24;
/// Times that the photograph is cut anew for what was found.
const AGAIN: usize = 2;
/// Of colours of spheres.
const FINENESS: f64 = 0.25;

impl OverArgs {
    pub fn photograph(&self) -> Option<&Path> {
        self.over.as_deref()
    }

    /// The picture: the scene's bow over the photograph.
    pub fn draw(
        &self,
        path: &Path,
        scene: &mut BowScene,
        folder: &Path,
        told_fov: Option<f64>,
    ) -> Result<Picture> {
        let bytes = std::fs::read(path)
            .map_err(|error| PhotoError::Unread(format!("{}: {error}", path.display())))?;
        let taken = Taken::of(&bytes)?;
        let photo = decoded(&bytes, taken.orientation.unwrap_or(1))?;
        let light = LinearPicture::of(&photo);
        (scene.camera.width, scene.camera.height) = (Some(photo.width), Some(photo.height));
        let by_lens = taken.field_of_view(photo.width, photo.height).map(f64::to_degrees);
        scene.camera.fov_deg = told_fov.or(by_lens).or(scene.camera.fov_deg);
        if scene.camera.fov_deg.is_none() {
            return Err(PhotoError::Untold { what: "field of view", flag: "--fov-deg" }.into());
        }
        self.place_sun(&taken, scene)?;
        let Some(sun) = scene.sun.elevation_deg.map(f64::to_radians) else {
            let flag = "--sun-elevation-deg, or --time and --place";
            return Err(PhotoError::Untold { what: "sun", flag }.into());
        };
        let mut camera = scene.camera_for(sun)?;
        if let Some(row) = self.horizon_px {
            camera = aimed_by_horizon(&camera, row)?;
        }
        if let Some(place) = &self.antisolar_px {
            camera = aimed_by_antisolar(&camera, *place, sun)?;
        }
        let fitted = if self.fit { Some(fitted(&light, &camera, sun, scene)?) } else { None };
        if let Some((found, _)) = &fitted {
            report(found, &camera);
            camera.azimuth += found.bow.turn;
            scene.sun.elevation_deg = Some(found.bow.sun_elevation.to_degrees());
            scene.drops = vec![DropKeys::spheres(found.bow.radius, found.bow.spread)];
        }
        scene.camera.elevation_deg = Some(camera.elevation.to_degrees());
        scene.camera.azimuth_deg = Some(camera.azimuth.to_degrees());
        let spinner = progress::spinner("drops and sky");
        let (bow, brightest) =
            scene.light(folder, &|note| spinner.suspend(|| notes::tell([note])))?;
        spinner.finish_and_clear();
        let usual = scene.sky.brightness.unwrap_or(USUAL_STRENGTH);
        let luminance = self.strength.or(fitted.map(|(_, luminance)| luminance)).unwrap_or(usual);
        if !(luminance.is_finite() && luminance >= 0.0) {
            let accepted = "numbers of 0 and more";
            let value = luminance.to_string();
            return Err(PhotoError::Invalid { field: "--strength", value, accepted }.into());
        }
        Ok(light.plus(&bow, if brightest > 0.0 { luminance / brightest } else { 0.0 }))
    }

    /// The sun of time and place, where the scene and flags do not tell it.
    fn place_sun(&self, taken: &Taken, scene: &mut BowScene) -> Result<()> {
        let time = match &self.time {
            Some(text) => Some(seconds(text)?),
            None => taken.time,
        };
        let place = match &self.place {
            Some(place) if place[0].abs() <= 90.0 && place[1].abs() <= 180.0 => {
                Some([place[0].to_radians(), place[1].to_radians()])
            }
            Some(place) => {
                let accepted = "a latitude from -90 to 90 and a longitude from -180 to 180 degrees";
                let value = format!("{},{}", place[0], place[1]);
                return Err(PhotoError::Invalid { field: "--place", value, accepted }.into());
            }
            None => taken.place,
        };
        let (Some(time), Some([latitude, longitude])) = (time, place) else { return Ok(()) };
        let sun = sun_position(time, latitude, longitude);
        let told = format!(
            "sun by time and place: elevation {:.2}°, azimuth {:.1}° (the antisolar point at {:.1}°)",
            sun.elevation.to_degrees(),
            sun.azimuth.to_degrees(),
            (sun.azimuth.to_degrees() + 180.0).rem_euclid(360.0)
        );
        notes::tell([told]);
        let from_flags = self.time.is_some() || self.place.is_some();
        if scene.sun.elevation_deg.is_none() || from_flags {
            scene.sun.elevation_deg = Some(sun.elevation.to_degrees());
        }
        if let Some(heading) = taken.heading {
            let antisolar = sun.azimuth + std::f64::consts::PI;
            let azimuth = (heading - antisolar).to_degrees();
            let azimuth = (azimuth + 180.0).rem_euclid(360.0) - 180.0;
            scene.camera.azimuth_deg = scene.camera.azimuth_deg.or(Some(azimuth));
        }
        Ok(())
    }
}

/// Seconds since 1970 of a time as RFC 3339 writes it.
fn seconds(text: &str) -> Result<f64> {
    let read = || -> Option<f64> {
        let (date, clock) = text.split_once(['T', ' '])?;
        let (clock, offset) = match clock.strip_suffix(['Z', 'z']) {
            Some(clock) => (clock, 0.0),
            None => {
                let at = clock.rfind(['+', '-'])?;
                let sign = if clock[at..].starts_with('-') { -1.0 } else { 1.0 };
                let (hours, minutes) = clock[at + 1..].split_once(':')?;
                (
                    &clock[..at],
                    sign * (3600.0 * hours.parse::<f64>().ok()?
                        + 60.0 * minutes.parse::<f64>().ok()?),
                )
            }
        };
        let mut date = date.split('-');
        let year = date.next()?.parse().ok()?;
        let day = [date.next()?.parse().ok()?, date.next()?.parse().ok()?];
        let clock: Vec<f64> = clock.split(':').map(str::parse).collect::<Result<_, _>>().ok()?;
        let clock = [*clock.first()?, *clock.get(1)?, clock.get(2).copied().unwrap_or(0.0)];
        Some(unix_seconds(year, day, clock)? - offset)
    };
    let accepted = "a date, a time and an offset such as 2024-06-20T19:30:00+02:00";
    let invalid = || PhotoError::Invalid { field: "--time", value: text.into(), accepted };
    Ok(read().ok_or_else(invalid)?)
}

/// The picture, upright.
fn decoded(bytes: &[u8], orientation: u32) -> Result<Picture> {
    let unread = |error: image::ImageError| {
        PhotoError::Unread(format!("{error}; JPEG and PNG are accepted"))
    };
    let picture = image::load_from_memory(bytes).map_err(unread)?.into_rgb8();
    let picture = match orientation {
        2 => imageops::flip_horizontal(&picture),
        3 => imageops::rotate180(&picture),
        4 => imageops::flip_vertical(&picture),
        5 => imageops::flip_horizontal(&imageops::rotate90(&picture)),
        6 => imageops::rotate90(&picture),
        7 => imageops::flip_horizontal(&imageops::rotate270(&picture)),
        8 => imageops::rotate270(&picture),
        _ => picture,
    };
    let (width, height) = picture.dimensions();
    Ok(Picture { width: width as usize, height: height as usize, rgb: picture.into_raw() })
}

/// The bow that fits, and its luminance at its brightest.
fn fitted(
    light: &LinearPicture,
    camera: &Camera,
    sun: f64,
    scene: &BowScene,
) -> Result<(Fitted, f64)> {
    let cells = |camera: &Camera, sun_elevation: f64| {
        let theta = CUT.map(f64::to_radians);
        cut(light, camera, &CutPlan { sun_elevation, theta, steps: CUT_STEPS, sectors: SECTORS })
    };
    let illuminant = scene.sun.illuminant.as_deref().unwrap_or("D65").parse()?;
    let observer = scene.sun.observer.as_deref().unwrap_or("1931").parse()?;
    let medium = MediumSpec::parse("water")?.resolve(Path::new("."))?;
    let [from, to] = CURVE.map(f64::to_radians);
    let theta: Vec<f64> = (0..CURVE_STEPS)
        .map(|i| from + (to - from) * i as f64 / (CURVE_STEPS - 1) as f64)
        .collect();
    let spinner = progress::spinner("drops that fit");
    let curve = |radius: f64, spread: f64| -> Result<Curve, LeeError> {
        let request = Request {
            radii: vec![radius],
            theta: theta.clone(),
            medium: medium.clone(),
            sun_disc: scene.sun.disc.unwrap_or(true),
            size_spread: spread,
            illuminant,
            observer,
            fineness: FINENESS,
        };
        let seen = lee::spheres(&request)?.seen(Polarisation::Total);
        Ok(Curve {
            theta: [from, to],
            rgb: seen[0].iter().map(|xyz| xyz_to_linear_srgb(*xyz)).collect(),
        })
    };
    let guess = Bow { radius: 0.3e-3, spread: 0.1, sun_elevation: sun, turn: 0.0 };
    let mut found =
        fit(&cells(camera, sun), Start::Aim(guess), curve)?.map_err(PhotoError::NoFit)?;
    for _ in 0..AGAIN {
        let Bow { sun_elevation, turn, .. } = found.bow;
        let aimed = Camera { azimuth: camera.azimuth + turn, ..*camera };
        let start = Start::Near(Bow { turn: 0.0, ..found.bow });
        found = fit(&cells(&aimed, sun_elevation), start, curve)?.map_err(PhotoError::NoFit)?;
        found.bow.turn += turn;
    }
    spinner.finish_and_clear();
    let best = curve(found.bow.radius, found.bow.spread)?;
    let luminance = |rgb: &[f64; 3]| 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
    let brightest = best.rgb.iter().map(luminance).fold(0.0, f64::max);
    Ok((found, found.strength * brightest))
}

fn report(found: &Fitted, camera: &Camera) {
    let (bow, off) = (found.bow, found.deviation);
    println!("radius {:.2} ± {:.2} µm", 1e6 * bow.radius, 1e6 * off.radius);
    println!(
        "spread of sizes {:.4} ± {:.4} (standard deviation of ln radius)",
        bow.spread, off.spread
    );
    println!(
        "sun elevation {:.3} ± {:.3}°",
        bow.sun_elevation.to_degrees(),
        off.sun_elevation.to_degrees()
    );
    println!(
        "camera azimuth from the antisolar direction {:.3} ± {:.3}°",
        (camera.azimuth + bow.turn).to_degrees(),
        off.turn.to_degrees()
    );
    println!("left over: {:.4} of white (root mean square)", found.rms);
}
