//! A picture of a rainbow from its scene: what drops there are, where the sun and the camera stand.
//!
//! [`BowScene`] is the file's keys, as they are written; [`BowScene::draw`] reads or computes the tables of
//! the drops, and draws the [`sky`](super::sky).

mod drops;
mod error;
mod keys;
mod plan;
mod sphere;
mod store;

pub use drops::DropKeys;
pub use error::BowError;
pub use keys::{BowScene, CameraKeys, FilterKeys, LayerKeys, RainKeys, SkyKeys, SunKeys};
pub use store::DropStore;

use super::camera::Camera;
use super::grid::draw_grid;
use super::layer::{LayerLight, LayerSky, Place};
use super::sky::{Drops, RainShape, Sky, light, render_layer};
use super::{LinearPicture, Picture};
use crate::color::decode_srgb;
use crate::phase_table::PhaseTable;
use std::path::Path;
use std::sync::Arc;

/// The sun where neither the scene nor a table says it, degrees above the horizon.
const USUAL_SUN: f64 = 20.0;
/// What a picture is drawn of.
struct Made {
    tables: Vec<(Arc<PhaseTable>, f64)>,
    sky: Sky,
    camera: Camera,
    layer: Option<LayerLight>,
}

impl Made {
    fn drops(&self) -> Vec<Drops<'_>> {
        self.tables.iter().map(|(table, number)| Drops { table, number: *number }).collect()
    }
}

/// Degrees, as people round them.
const ROUNDING: f64 = 0.01;

impl BowScene {
    /// Compute or read the drops, and draw. Files that the scene names are looked for in `folder`;
    /// `tell` hears what the user should know.
    ///
    /// # Errors
    /// Keys that make no sense, told before drops are computed; tables that do not fit the picture.
    pub fn draw(&self, folder: &Path, tell: &dyn Fn(String)) -> Result<Picture, BowError> {
        self.draw_sharing(&DropStore::default(), folder, tell)
    }

    /// The same with drops that other pictures have too, which are computed once.
    ///
    /// # Errors
    /// As [`Self::draw`].
    pub fn draw_sharing(
        &self,
        store: &DropStore,
        folder: &Path,
        tell: &dyn Fn(String),
    ) -> Result<Picture, BowError> {
        let made = self.made(store, folder, tell)?;
        let mut drawn = render_layer(&made.camera, &made.sky, &made.drops(), made.layer.as_ref())?;
        note_on_reach(&made.tables, drawn.untold).into_iter().for_each(tell);
        if self.camera.grid {
            draw_grid(&mut drawn.picture, &made.camera, made.sky.sun_elevation)?;
        }
        Ok(drawn.picture)
    }

    /// The light of the bow alone, and the luminance of its brightest place.
    ///
    /// # Errors
    /// As [`BowScene::draw`].
    pub fn light(
        &self,
        folder: &Path,
        tell: &dyn Fn(String),
    ) -> Result<(LinearPicture, f64), BowError> {
        let made = self.made(&DropStore::default(), folder, tell)?;
        Ok(light(&made.camera, &made.sky, &made.drops(), made.layer.as_ref())?)
    }

    /// The camera of the keys, for the sun at an elevation (radians).
    ///
    /// # Errors
    /// Keys that make no camera.
    pub fn camera_for(&self, sun_elevation: f64) -> Result<Camera, BowError> {
        self.camera(sun_elevation)
    }

    /// All that is drawn.
    fn made(
        &self,
        store: &DropStore,
        folder: &Path,
        tell: &dyn Fn(String),
    ) -> Result<Made, BowError> {
        let polarised = self.filter.polariser_deg.is_some();
        let asked = self.sun.elevation_deg;
        let usual = asked.unwrap_or(USUAL_SUN);
        self.sky(usual.to_radians())?;
        self.camera(usual.to_radians())?;
        self.layer(usual.to_radians())?;
        let wanted = drops::Wanted {
            sun_elevation_deg: usual,
            sun_disc: self.sun.disc.unwrap_or(true),
            polarised,
            layer: self.layer.optical_depth.is_some(),
        };
        let tables = drops::tables(&self.drops, folder, wanted, store, tell)?;
        let read = self.drops.iter().any(|kind| kind.table.is_some());
        if let Some(note) = note_on_disc(&tables, self.sun.disc).filter(|_| read) {
            tell(note);
        }
        let elevation = asked.map(f64::to_radians).unwrap_or_else(|| {
            tables
                .iter()
                .map(|(t, _)| &t.header)
                .find(|h| !h.rotational_symmetry)
                .map_or(USUAL_SUN.to_radians(), |header| header.sun_elevation)
        });
        check_sun(elevation, &tables)?;
        let sky = self.sky(elevation)?;
        let camera = self.camera(elevation)?;
        let layer = match self.layer(elevation)? {
            Some(layer) => {
                let kinds: Vec<_> =
                    tables.iter().map(|(table, number)| (&**table, *number)).collect();
                let eye = (sky.illuminant, sky.observer);
                let solved = LayerLight::new(&layer, elevation, eye, &kinds)?;
                solved.notes.iter().cloned().for_each(tell);
                Some(solved)
            }
            None => None,
        };
        Ok(Made { tables, sky, camera, layer })
    }

    /// The camera, which looks at the top of the primary bow unless told otherwise.
    fn camera(&self, sun_elevation: f64) -> Result<Camera, BowError> {
        let keys = &self.camera;
        let lens = keys.lens.as_deref().unwrap_or("rectilinear").parse()?;
        // 42° above the antisolar point
        let top = (42.0 - sun_elevation.to_degrees()).clamp(-60.0, 60.0);
        let camera = Camera {
            lens,
            field_of_view: keys.fov_deg.unwrap_or(60.0).to_radians(),
            elevation: keys.elevation_deg.unwrap_or(0.6 * top).to_radians(),
            azimuth: keys.azimuth_deg.unwrap_or(0.0).to_radians(),
            width: keys.width.unwrap_or(1280),
            height: keys.height.unwrap_or(720),
        };
        camera.validate()?;
        Ok(camera)
    }

    /// The layer, if there is one.
    pub(super) fn layer(&self, sun_elevation: f64) -> Result<Option<LayerSky>, BowError> {
        let keys = &self.layer;
        if *keys == LayerKeys::default() {
            return Ok(None);
        }
        let rain = [
            ("optical_depth", self.rain.optical_depth.map(|depth| depth.to_string())),
            ("shape", self.rain.shape.as_ref().map(|shape| format!("\"{shape}\""))),
        ];
        if let Some((key, Some(value))) = rain.into_iter().find(|(_, value)| value.is_some()) {
            return Err(BowError::Keys(format!(
                "rain.{key} = {value} with [layer]: the layer takes the place of the rain; keep one"
            )));
        }
        let Some(optical_depth) = keys.optical_depth else {
            let message = "layer.optical_depth: none given; a number above 0 is needed, along the layer's normal";
            return Err(BowError::Keys(message.into()));
        };
        let place = keys.place.as_deref().map_or(Ok(Place::default()), str::parse)?;
        let usual = LayerSky::new(optical_depth, place);
        let layer = LayerSky {
            ground_albedo: keys.ground_albedo.unwrap_or(usual.ground_albedo),
            scattering: keys.scattering.as_deref().map_or(Ok(usual.scattering), str::parse)?,
            streams: keys.streams.unwrap_or(usual.streams),
            ..usual
        };
        layer.check(sun_elevation)?;
        Ok(Some(layer))
    }

    /// What is behind and around the drops.
    fn sky(&self, sun_elevation: f64) -> Result<Sky, BowError> {
        let degrees = sun_elevation.to_degrees();
        if !(0.0..=90.0).contains(&degrees) {
            let message = format!("sun.elevation_deg = {degrees}: accepted are 0 to 90");
            return Err(BowError::Keys(message));
        }
        let rain = match self.rain.shape.as_deref() {
            None | Some("curtain") => RainShape::Curtain,
            Some("around") => RainShape::Around,
            Some(other) => {
                let message = format!("rain.shape = \"{other}\": accepted are curtain and around");
                return Err(BowError::Keys(message));
            }
        };
        // a layer has light of its own beside the bow
        let behind = if self.layer.optical_depth.is_some() { [0; 3] } else { [107, 114, 118] };
        let linear = |rgb: [u8; 3]| rgb.map(|v| decode_srgb(f64::from(v) / 255.0));
        Ok(Sky {
            sun_elevation,
            sun_disc: self.sun.disc.unwrap_or(true),
            illuminant: self.sun.illuminant.as_deref().unwrap_or("D65").parse()?,
            observer: self.sun.observer.as_deref().unwrap_or("1931").parse()?,
            rain,
            optical_depth: self.rain.optical_depth.unwrap_or(1.0),
            background: linear(self.sky.background.unwrap_or(behind)),
            ground: self.sky.ground.map(linear),
            brightness: self.sky.brightness.unwrap_or(0.45),
            exposure: self.sky.exposure,
            polariser: self.filter.polariser_deg.map(f64::to_radians),
            horizon_line: self.sky.horizon_line,
        })
    }
}

/// Says where the sun's disc is in a table already, so that the picture leaves it alone.
fn note_on_disc(tables: &[(Arc<PhaseTable>, f64)], asked: Option<bool>) -> Option<String> {
    let there = tables.iter().any(|(table, _)| table.header.averaging.has_sun_disc());
    there.then(|| {
        let wish = match asked {
            Some(false) => "; sun.disc = false cannot take it out",
            _ => " and is not applied again",
        };
        format!("the sun's disc is in the table already{wish}")
    })
}

/// Share of the rain without any light of its own above which it is said.
const UNTOLD: f64 = 1e-3;

/// Says that the camera sees scattering angles which the tables lack.
fn note_on_reach(tables: &[(Arc<PhaseTable>, f64)], untold: f64) -> Option<String> {
    let ends = |end: fn(&[f64]) -> Option<&f64>| {
        tables.iter().filter_map(move |(table, _)| end(&table.header.axes.theta).copied())
    };
    let from = ends(<[f64]>::first).fold(0.0, f64::max);
    let to = ends(<[f64]>::last).fold(f64::INFINITY, f64::min);
    let [from, to] = [from, to].map(|angle| (angle.to_degrees() * 100.0).round() / 100.0);
    (untold > UNTOLD).then(|| {
        format!(
            "{:.1} % of the rain that the camera sees has scattering angles that not all tables have \
             ({from} to {to}°): only the background is drawn there",
            100.0 * untold
        )
    })
}

/// Refuses a sun elsewhere than where the table of a drop that is no sphere has it.
fn check_sun(elevation: f64, tables: &[(Arc<PhaseTable>, f64)]) -> Result<(), BowError> {
    let given = elevation.to_degrees();
    let suns = tables.iter().map(|(table, _)| &table.header);
    let bound = suns.filter(|header| !header.rotational_symmetry);
    let other = bound.map(|header| header.sun_elevation.to_degrees());
    match other.into_iter().find(|own| (own - given).abs() > ROUNDING) {
        Some(own) => Err(BowError::Keys(format!(
            "sun.elevation_deg = {given}: a table of the drops was made for the sun at {own}°; \
             make one for {given}°, or leave the elevation out"
        ))),
        None => Ok(()),
    }
}
