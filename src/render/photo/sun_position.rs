//! Where the sun stands, by time and place.
//!
//! Low-precision formulae of the Astronomical Almanac (page C5; within 0.01° from 1950 to 2050) for the sun's longitude and the
//! sidereal time of Meeus 1998, eq. 12.4. Without refraction, which lifts the sun by 0.01° at 60°, 0.09° at 10° and half
//! a degree at the horizon; the antisolar point of what is seen through the same air is lowered alike.

/// Elevation and azimuth, radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunPosition {
    /// Above the horizon.
    pub elevation: f64,
    /// From north through east.
    pub azimuth: f64,
}

/// Seconds from 1970 to noon of the first of January 2000.
const J2000: f64 = 946_728_000.0;

/// The sun at a time (seconds of universal time since 1970) seen from a latitude and a longitude (radians, north and
/// east positive).
///
/// ```
/// use gonio::render::photo::sun_position;
///
/// // noon at Greenwich, midsummer 2024: the sun is highest
/// let sun = sun_position(1_718_884_860.0, 51.48f64.to_radians(), 0.0);
/// assert!((sun.elevation.to_degrees() - (90.0 - 51.48 + 23.44)).abs() < 0.05);
/// assert!((sun.azimuth.to_degrees() - 180.0).abs() < 0.5);
/// ```
pub fn sun_position(unix_seconds: f64, latitude: f64, longitude: f64) -> SunPosition {
    let days = (unix_seconds - J2000) / 86_400.0;
    let anomaly = (357.528 + 0.985_600_3 * days).to_radians();
    let mean = 280.460 + 0.985_647_4 * days;
    let ecliptic = (mean + 1.915 * anomaly.sin() + 0.020 * (2.0 * anomaly).sin()).to_radians();
    let obliquity = (23.439 - 4e-7 * days).to_radians();
    let ascension = (obliquity.cos() * ecliptic.sin()).atan2(ecliptic.cos());
    let declination = (obliquity.sin() * ecliptic.sin()).asin();
    let sidereal = (280.460_618_37 + 360.985_647_366_29 * days).to_radians();
    let hour = sidereal + longitude - ascension;
    let (sl, cl) = latitude.sin_cos();
    let (sd, cd) = declination.sin_cos();
    let (sh, ch) = hour.sin_cos();
    let up = sl * sd + cl * cd * ch;
    let (east, north) = (-cd * sh, cl * sd - sl * cd * ch);
    let azimuth = east.atan2(north).rem_euclid(std::f64::consts::TAU);
    SunPosition { elevation: up.atan2(east.hypot(north)), azimuth }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The example of Reda & Andreas 2008 (NREL/TP-560-34302, appendix A.5): 17 October 2003, 12:30:30 at UTC − 7 h,
    /// 39.742476° N, 105.1786° W: elevation 39.872046° without refraction, azimuth 194.340241°.
    #[test]
    fn the_published_example_is_met() {
        let sun =
            sun_position(1_066_419_030.0, 39.742_476f64.to_radians(), -105.1786f64.to_radians());
        assert!(
            (sun.elevation.to_degrees() - 39.872_046).abs() < 0.02,
            "{}",
            sun.elevation.to_degrees()
        );
        assert!(
            (sun.azimuth.to_degrees() - 194.340_241).abs() < 0.02,
            "{}",
            sun.azimuth.to_degrees()
        );
    }

    /// Half a day later the sun is below the horizon, in the other half of the sky.
    #[test]
    fn at_night_it_is_below() {
        let sun = sun_position(1_066_419_030.0 + 43_200.0, 0.69, -1.84);
        assert!(sun.elevation < -0.3);
    }
}
