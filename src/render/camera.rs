//! A camera: which direction each pixel sees.
//!
//! World frame: z up, x towards the point of the horizon above or below the antisolar point,
//! y = z × x. The sun stands behind the camera, at azimuth 180°.

use super::error::RenderError;
use glam::{DMat3, DVec3};
use std::f64::consts::PI;
use std::str::FromStr;

/// How the distance from the picture's centre grows with the angle from the optical axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Lens {
    /// `f tan α`: straight lines stay straight.
    #[default]
    Rectilinear,
    /// `f α`
    Equidistant,
    /// `2 f sin(α/2)`
    EqualArea,
    /// `2 f tan(α/2)`
    Stereographic,
    /// `f sin α`
    Orthographic,
}

impl Lens {
    /// Distance from the centre in focal lengths; nothing beyond what the lens can show.
    pub fn distance(self, angle: f64) -> Option<f64> {
        let shown = match self {
            Lens::Rectilinear | Lens::Orthographic => angle < 0.5 * PI,
            Lens::Stereographic => angle < PI,
            Lens::Equidistant | Lens::EqualArea => angle <= PI,
        };
        shown.then(|| match self {
            Lens::Rectilinear => angle.tan(),
            Lens::Equidistant => angle,
            Lens::EqualArea => 2.0 * (0.5 * angle).sin(),
            Lens::Stereographic => 2.0 * (0.5 * angle).tan(),
            Lens::Orthographic => angle.sin(),
        })
    }

    /// The inverse of [`Lens::distance`].
    pub fn angle(self, distance: f64) -> Option<f64> {
        let angle = match self {
            Lens::Rectilinear => distance.atan(),
            Lens::Equidistant => distance,
            Lens::EqualArea => 2.0 * (0.5 * distance).asin(),
            Lens::Stereographic => 2.0 * (0.5 * distance).atan(),
            Lens::Orthographic => distance.asin(),
        };
        (angle.is_finite() && angle <= PI).then_some(angle)
    }
}

impl FromStr for Lens {
    type Err = RenderError;
    fn from_str(text: &str) -> Result<Self, RenderError> {
        match text {
            "rectilinear" => Ok(Lens::Rectilinear),
            "equidistant" | "fisheye" => Ok(Lens::Equidistant),
            "equal-area" => Ok(Lens::EqualArea),
            "stereographic" => Ok(Lens::Stereographic),
            "orthographic" => Ok(Lens::Orthographic),
            _ => Err(RenderError::Invalid {
                field: "camera.lens".into(),
                value: format!("\"{text}\""),
                accepted:
                    "rectilinear, fisheye (equidistant), equal-area, stereographic or orthographic"
                        .into(),
            }),
        }
    }
}

/// Where the camera looks and how wide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// How directions are spread over the picture.
    pub lens: Lens,
    /// Angle across the picture's width, radians.
    pub field_of_view: f64,
    /// Direction of the optical axis: elevation above the horizon, radians.
    pub elevation: f64,
    /// Its azimuth from the antisolar direction, to the right, radians.
    pub azimuth: f64,
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
}

impl Camera {
    /// Refuse what no camera can be.
    ///
    /// # Errors
    /// [`RenderError::Invalid`] naming the field.
    pub fn validate(&self) -> Result<(), RenderError> {
        let invalid = |field: &str, value: String, accepted: &str| {
            let (field, accepted) = (field.to_owned(), accepted.to_owned());
            Err(RenderError::Invalid { field, value, accepted })
        };
        let degrees = self.field_of_view.to_degrees();
        let widest = match self.lens {
            Lens::Rectilinear => 170.0,
            Lens::Orthographic => 180.0,
            Lens::Stereographic => 350.0,
            Lens::Equidistant | Lens::EqualArea => 360.0,
        };
        if !(0.1..=widest).contains(&degrees) {
            let accepted = format!("0.1 to {widest} degrees for this lens");
            return invalid("camera.fov_deg", format!("{degrees}"), &accepted);
        }
        if !(-0.5 * PI..=0.5 * PI).contains(&self.elevation) {
            let value = format!("{}", self.elevation.to_degrees());
            return invalid("camera.elevation_deg", value, "-90 to 90");
        }
        for (field, side) in [("camera.width", self.width), ("camera.height", self.height)] {
            if !(1..=16384).contains(&side) {
                return invalid(field, side.to_string(), "1 to 16384 pixels");
            }
        }
        Ok(())
    }

    /// The frame: columns right, up, forward.
    fn frame(&self) -> DMat3 {
        let (se, ce) = self.elevation.sin_cos();
        let (sa, ca) = self.azimuth.sin_cos();
        let forward = DVec3::new(ce * ca, -ce * sa, se);
        let right = DVec3::new(-sa, -ca, 0.0);
        DMat3::from_cols(right, right.cross(forward), forward)
    }

    /// Direction that a place in the picture sees (pixels from the upper left corner), as a unit
    /// vector in the world frame; nothing outside the lens's circle.
    pub fn direction(&self, column: f64, row: f64) -> Option<DVec3> {
        let half = 0.5 * self.width as f64;
        let edge = self.lens.distance(0.5 * self.field_of_view)?;
        let (x, y) =
            ((column - half) / half * edge, (0.5 * self.height as f64 - row) / half * edge);
        let angle = self.lens.angle(x.hypot(y))?;
        let turn = y.atan2(x);
        let (s, c) = angle.sin_cos();
        Some(self.frame() * DVec3::new(s * turn.cos(), s * turn.sin(), c))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lenses_invert_themselves() {
        use Lens::*;
        for lens in [Rectilinear, Equidistant, EqualArea, Stereographic, Orthographic] {
            for degrees in [0.0, 1.0, 30.0, 60.0, 89.0] {
                let angle = f64::to_radians(degrees);
                let back = lens.angle(lens.distance(angle).unwrap()).unwrap();
                assert!((back - angle).abs() < 1e-12, "{lens:?} {degrees}");
            }
        }
        assert!(Rectilinear.distance(1.6).is_none());
        assert!(Orthographic.angle(1.01).is_none());
    }

    /// Centre, right edge and top of a picture see what they should.
    #[test]
    fn pixels_look_where_they_should() {
        let camera = Camera {
            lens: Lens::Equidistant,
            field_of_view: 60f64.to_radians(),
            elevation: 10f64.to_radians(),
            azimuth: 0.0,
            width: 600,
            height: 600,
        };
        let centre = camera.direction(300.0, 300.0).unwrap();
        assert!((centre.z.asin() - camera.elevation).abs() < 1e-12 && centre.y.abs() < 1e-12);
        let top = camera.direction(300.0, 0.0).unwrap();
        assert!((top.z.asin().to_degrees() - 40.0).abs() < 1e-9);
        let right = camera.direction(600.0, 300.0).unwrap();
        assert!(right.y < 0.0, "right of the antisolar point is −y");
        assert!((right.angle_between(centre).to_degrees() - 30.0).abs() < 1e-9);
    }
}
