//! The sky with its bows: what each pixel of a camera sees, of columns of colours.
//!
//! Sunlight scattered once by drops that fill the air evenly (`RainShape::Around` of the library's pictures).
//! Geometry as there: the frame of a drop has z along the light and x towards the upper side.

use crate::colours::{PER_ANGLE, seen};
use crate::message::{Reply, Request, Trouble};
use gonio::color::{encode_srgb, fit_gamut, xyz_to_linear_srgb};
use gonio::render::camera::{Camera, Lens};
use serde::Deserialize;
use serde_json::json;
use std::cmp::Ordering;

/// Columns that a request brings, one after the other: six numbers per angle.
#[derive(Debug, Deserialize)]
pub struct Columns {
    /// First and last angle.
    pub theta_deg: [f64; 2],
    /// Angles of each.
    pub points: usize,
    /// Azimuths from 0 to 180 degrees, ascending; a single one serves all.
    pub azimuths_deg: Vec<f64>,
    /// `total`, `parallel` or `perpendicular`.
    pub polarisation: String,
}

/// Columns as seen through the filter, to be looked up.
pub struct Lookup {
    from: f64,
    step: f64,
    points: usize,
    azimuths: Vec<f64>,
    xyz: Vec<[f64; 3]>,
}

impl Lookup {
    /// Of a request's numbers.
    ///
    /// # Errors
    /// Numbers that do not fit.
    pub fn new(columns: &Columns, numbers: &[f64]) -> Result<Self, Trouble> {
        let Columns { theta_deg: [from, to], points, azimuths_deg, polarisation } = columns;
        let fits = *points >= 2 && numbers.len() == azimuths_deg.len() * points * PER_ANGLE;
        if !fits || azimuths_deg.is_empty() || from.partial_cmp(to) != Some(Ordering::Less) {
            return Err(Trouble::new("", "columns and their numbers do not fit".into()));
        }
        let xyz = numbers.chunks_exact(PER_ANGLE).map(|six| seen(six, polarisation));
        Ok(Self {
            from: from.to_radians(),
            step: (to - from).to_radians() / (points - 1) as f64,
            points: *points,
            azimuths: azimuths_deg.iter().map(|deg| deg.to_radians()).collect(),
            xyz: xyz.collect::<Result<_, _>>()?,
        })
    }

    /// Which two angles a third one (radians) is between, and its share of the second; where the columns reach.
    fn between(&self, theta: f64) -> Option<(usize, f64)> {
        let place = (theta - self.from) / self.step;
        let last = (self.points - 1) as f64;
        let reaches = (-1e-9..=last + 1e-9).contains(&place);
        reaches.then(|| bracket(place.clamp(0.0, last), self.points))
    }

    /// XYZ in a direction (radians), where the columns reach.
    pub fn at(&self, theta: f64, phi: f64) -> Option<[f64; 3]> {
        let (cell, share) = self.between(theta)?;
        let of = |column: usize| mixed(&self.xyz[column * self.points..], cell, share);
        if self.azimuths.len() == 1 {
            return Some(of(0));
        }
        // both sides of the vertical plane are alike
        let phi = phi.abs();
        let right = self.azimuths.partition_point(|a| *a < phi).clamp(1, self.azimuths.len() - 1);
        let (a, b) = (self.azimuths[right - 1], self.azimuths[right]);
        let share = ((phi - a) / (b - a)).clamp(0.0, 1.0);
        let (a, b) = (of(right - 1), of(right));
        Some(std::array::from_fn(|c| (1.0 - share) * a[c] + share * b[c]))
    }
}

fn mixed(row: &[[f64; 3]], cell: usize, share: f64) -> [f64; 3] {
    std::array::from_fn(|c| (1.0 - share) * row[cell][c] + share * row[cell + 1][c])
}

fn bracket(place: f64, points: usize) -> (usize, f64) {
    let cell = (place as usize).min(points - 2);
    (cell, place - cell as f64)
}

#[derive(Deserialize)]
struct Question {
    columns: Columns,
    sun_elevation_deg: f64,
    fov_deg: f64,
    elevation_deg: f64,
    azimuth_deg: f64,
    width: usize,
    height: usize,
    /// Stops above what gives the brightest bow the luminance [`BRIGHTEST`].
    stops: f64,
    /// Whether the ground hides what is below the horizon.
    ground: bool,
}

/// Luminance of the brightest place between [`BOWS`], at 0 stops, above the background.
pub const BRIGHTEST: f64 = 0.45;
/// Scattering angles of the bows, degrees, whose brightness sets the exposure.
const BOWS: (f64, f64) = (120.0, 160.0);
/// Colours of the air beside the bow and of the ground, linear sRGB.
pub const BACKGROUND: [f64; 3] = [0.055, 0.075, 0.105];
/// As [`BACKGROUND`].
pub const GROUND: [f64; 3] = [0.022, 0.028, 0.018];
/// Most pixels of a picture.
const MOST_PIXELS: usize = 4_000_000;

/// The answer: `rgba`, and where the horizon and the antisolar point are, in pixels.
///
/// # Errors
/// A camera that is none.
pub fn sky(request: &Request) -> Result<Reply, Trouble> {
    let asked: Question = request.parsed()?;
    let lookup = Lookup::new(&asked.columns, &request.numbers)?;
    let camera = Camera {
        // a wide view would stretch its edges
        lens: if asked.fov_deg > 120.0 { Lens::Stereographic } else { Lens::Rectilinear },
        field_of_view: asked.fov_deg.to_radians(),
        elevation: asked.elevation_deg.to_radians(),
        azimuth: asked.azimuth_deg.to_radians(),
        width: asked.width,
        height: asked.height,
    };
    camera.validate().map_err(|error| Trouble::new("fov_deg", error.to_string()))?;
    if asked.width * asked.height > MOST_PIXELS || !asked.stops.is_finite() {
        return Err(Trouble::new("width", format!("at most {MOST_PIXELS} pixels")));
    }
    let exposure = exposure(&lookup, &asked.columns, asked.stops);
    let (sine, cosine) = asked.sun_elevation_deg.to_radians().sin_cos();
    let bow = |xyz: [f64; 3]| {
        let bow = xyz_to_linear_srgb(xyz.map(|v| v * exposure));
        levels(std::array::from_fn(|c| bow[c] + BACKGROUND[c]))
    };
    let (air, ground) = (levels(BACKGROUND), levels(GROUND));
    // Of one column every angle has its colour, and few pixels ask for new ones: what lies between two angles is
    // between their colours, to a fraction of a level.
    let colours: Option<Vec<[f64; 3]>> =
        (lookup.azimuths.len() == 1).then(|| lookup.xyz.iter().map(|xyz| bow(*xyz)).collect());
    let mut rgba = Vec::with_capacity(4 * asked.width * asked.height);
    for row in 0..asked.height {
        for column in 0..asked.width {
            let Some(view) = camera.direction(column as f64 + 0.5, row as f64 + 0.5) else {
                rgba.extend([0, 0, 0, 255]);
                continue;
            };
            let (theta, phi) = scattered([view.x, view.y, view.z], sine, cosine);
            let seen = match &colours {
                _ if asked.ground && view.z < 0.0 => Some(ground),
                Some(colours) => {
                    lookup.between(theta).map(|(cell, share)| mixed(colours, cell, share))
                }
                None => lookup.at(theta, phi).map(bow),
            };
            rgba.extend(seen.unwrap_or(air).map(|v| v.round() as u8));
            rgba.push(255);
        }
    }
    Ok(Reply::new(json!({ "exposure": exposure })).with_bytes("rgba", rgba))
}

/// Linear sRGB as levels of 255, not yet rounded.
fn levels(linear: [f64; 3]) -> [f64; 3] {
    fit_gamut(linear).map(|v| 255.0 * encode_srgb(v))
}

/// Scattering angle and azimuth of the light that comes from where one looks, for the sine and cosine of the
/// sun's elevation.
fn scattered(view: [f64; 3], sine: f64, cosine: f64) -> (f64, f64) {
    let scattered = view.map(|v| -v);
    let dot = |a: [f64; 3]| a.iter().zip(&scattered).map(|(a, b)| a * b).sum::<f64>();
    // along the light, to its upper side, and across: z × x
    let (along, x, y) =
        (dot([cosine, 0.0, -sine]), dot([sine, 0.0, cosine]), dot([0.0, -1.0, 0.0]));
    (x.hypot(y).atan2(along), y.atan2(x))
}

/// What XYZ is multiplied with.
pub fn exposure(lookup: &Lookup, columns: &Columns, stops: f64) -> f64 {
    let [from, to] = columns.theta_deg;
    let angle =
        |i: usize| from + (to - from) * (i % columns.points) as f64 / (columns.points - 1) as f64;
    let brightest = |all: bool| {
        (lookup.xyz.iter().enumerate())
            .filter(|(i, _)| all || (BOWS.0..=BOWS.1).contains(&angle(*i)))
            .fold(0.0_f64, |most, (_, xyz)| most.max(xyz[1]))
    };
    let peak = if brightest(false) > 0.0 { brightest(false) } else { brightest(true) };
    if peak > 0.0 { BRIGHTEST / peak * stops.exp2() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The antisolar point is straight back; what stands above it is on the lower side of the drop's light.
    #[test]
    fn directions_are_those_of_the_library() {
        let (sine, cosine) = 20f64.to_radians().sin_cos();
        let (theta, _) = scattered([cosine, 0.0, -sine], sine, cosine);
        assert!((theta - std::f64::consts::PI).abs() < 1e-12);
        let (sine_up, cosine_up) = 22f64.to_radians().sin_cos();
        let (theta, phi) = scattered([cosine_up, 0.0, sine_up], sine, cosine);
        assert!((theta.to_degrees() - 138.0).abs() < 1e-9, "{}", theta.to_degrees());
        assert!((phi.abs().to_degrees() - 180.0).abs() < 1e-9, "{phi}");
    }

    /// One column's colours looked up are those of two equal columns, which are computed pixel by pixel.
    #[test]
    fn one_column_is_as_two_of_it() {
        let numbers: Vec<f64> = (0..PER_ANGLE * 226)
            .map(|i| {
                let (deg, k) = (120.0 + 0.2 * (i / PER_ANGLE) as f64, i % PER_ANGLE);
                0.01 + 0.1 * (-((deg - 138.0 - 0.2 * k as f64) / 1.5).powi(2)).exp()
            })
            .collect();
        let drawn = |azimuths: &[f64]| {
            let header = json!({
                "op": "sky", "sun_elevation_deg": 20.0, "fov_deg": 80.0, "elevation_deg": 15.0,
                "azimuth_deg": 5.0, "width": 120, "height": 72, "stops": 0.0, "ground": true,
                "columns": { "theta_deg": [120.0, 165.0], "points": 226, "azimuths_deg": azimuths,
                             "polarisation": "total" },
            });
            let reply = sky(&Request::new(header, numbers.repeat(azimuths.len()))).unwrap();
            let crate::message::Block::U8(rgba) = &reply.blocks[0].1 else { unreachable!() };
            rgba.clone()
        };
        let (one, two) = (drawn(&[0.0]), drawn(&[0.0, 180.0]));
        assert!(one.iter().max() > Some(&150), "there is a bow");
        assert!(one.iter().zip(&two).all(|(a, b)| a.abs_diff(*b) <= 1));
    }

    /// The picture of a bow is that which the library draws of a table of the same drops.
    #[test]
    fn pictures_are_those_of_the_library() {
        use gonio::color::{Illuminant, Observer};
        use gonio::render::sky::{Drops, RainShape, Sky, render};
        use gonio::scene::{Scene, SceneFile};
        let keys: SceneFile = toml::from_str(
            "[particle]\nshape = 'sphere'\nradius_um = 20\n[light]\nsun_elevation_deg = 20\n\
             wavelengths_nm = { from = 380, to = 730, count = 71 }\nsun_disc = 'limb-darkened'\n\
             [table]\ntheta_deg = { from = 120, to = 165, count = 451 }\nazimuth_deg = [0]\n\
             [model]\nmethod = 'mie'",
        )
        .unwrap();
        let table = gonio::simulate::table(&Scene::built_in(&keys).unwrap()).unwrap();
        let asked = crate::colours::Column {
            drop: crate::drop::tests::drop("sphere", 20.0),
            theta_deg: [120.0, 165.0],
            points: 451,
            azimuth_deg: 0.0,
            sun_disc: true,
            fineness: 1.0,
            wavelength_nm: None,
        };
        let column = asked.diagram().unwrap();
        let numbers: Vec<f64> = column.xyz.iter().flatten().flatten().flatten().copied().collect();
        let camera = Camera {
            lens: Lens::Rectilinear,
            field_of_view: 80f64.to_radians(),
            elevation: 15f64.to_radians(),
            azimuth: 0.1,
            width: 120,
            height: 72,
        };
        let header = json!({
            "op": "sky", "sun_elevation_deg": 20.0, "fov_deg": 80.0, "elevation_deg": 15.0,
            "azimuth_deg": 0.1f64.to_degrees(), "width": 120, "height": 72, "stops": 0.0, "ground": true,
            "columns": { "theta_deg": [120.0, 165.0], "points": 451, "azimuths_deg": [0.0],
                         "polarisation": "total" },
        });
        let reply = sky(&Request::new(header, numbers)).unwrap();
        let crate::message::Block::U8(rgba) = &reply.blocks[0].1 else { unreachable!() };
        // the same brightness: the brightest bow of both is what `BRIGHTEST` says
        let drawn = render(
            &camera,
            &Sky {
                sun_elevation: 20f64.to_radians(),
                sun_disc: true,
                illuminant: Illuminant::D65,
                observer: Observer::Cie1931,
                rain: RainShape::Around,
                optical_depth: 1.0,
                background: BACKGROUND,
                ground: Some(GROUND),
                brightness: BRIGHTEST,
                exposure: None,
                polariser: None,
                horizon_line: false,
            },
            &[Drops { table: &table, number: 1.0 }],
        )
        .unwrap();
        let off = rgba
            .chunks_exact(4)
            .zip(drawn.picture.rgb.chunks_exact(3))
            .flat_map(|(a, b)| (0..3).map(|c| a[c].abs_diff(b[c])).collect::<Vec<_>>())
            .max();
        assert!(off.is_some_and(|off| off <= PICTURE), "{off:?} of 255");
    }

    /// Levels of 255 that the two pictures may differ: their wavelengths are not the same.
    const PICTURE: u8 = 8;
}
