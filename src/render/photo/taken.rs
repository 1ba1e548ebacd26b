//! How a photograph was taken: what its EXIF block tells of lens, time and place.

use super::error::PhotoError;
use exif::{DateTime, Exif, In, Reader, Tag, Value};
use std::f64::consts::PI;
use std::io::Cursor;

/// What is told; all of it may be missing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Taken {
    /// Focal length on film of 36 × 24 mm with the same diagonal, metres.
    pub focal_35: Option<f64>,
    /// Seconds of universal time since 1970; told where the camera knew its time zone.
    pub time: Option<f64>,
    /// Latitude and longitude, radians, north and east positive.
    pub place: Option<[f64; 2]>,
    /// Where the camera looked, from north through east, radians.
    pub heading: Option<f64>,
    /// How the picture lies in the file (1 to 8, as the standard counts; 1 is upright).
    pub orientation: Option<u32>,
}

/// Diagonal of film, metres.
const DIAGONAL: f64 = 0.043_266_615;

impl Taken {
    /// Read the block of a JPEG, PNG, TIFF or HEIF; a file without one tells nothing.
    ///
    /// # Errors
    /// [`PhotoError::Exif`] where a value is impossible.
    pub fn of(bytes: &[u8]) -> Result<Self, PhotoError> {
        let Ok(block) = Reader::new().read_from_container(&mut Cursor::new(bytes)) else {
            return Ok(Self::default());
        };
        Ok(Self {
            focal_35: focal(&block)?,
            time: time(&block)?,
            place: place(&block)?,
            heading: heading(&block)?,
            orientation: orientation(&block)?,
        })
    }

    /// Angle across a picture's width, radians, of a lens that keeps lines straight.
    ///
    /// ```
    /// use gonio::render::photo::Taken;
    ///
    /// let wide = Taken { focal_35: Some(0.018), ..Taken::default() };
    /// assert!((wide.field_of_view(3600, 2400).unwrap().to_degrees() - 90.0).abs() < 1e-4);
    /// ```
    pub fn field_of_view(&self, width: usize, height: usize) -> Option<f64> {
        let diagonal = (width as f64).hypot(height as f64);
        let focal = self.focal_35? / DIAGONAL * diagonal;
        Some(2.0 * (0.5 * width as f64 / focal).atan())
    }
}

fn impossible<T>(
    field: &'static str,
    value: impl ToString,
    accepted: &'static str,
    flag: &'static str,
) -> Result<T, PhotoError> {
    Err(PhotoError::Exif { field, value: value.to_string(), accepted, flag })
}

fn focal(block: &Exif) -> Result<Option<f64>, PhotoError> {
    let field = block.get_field(Tag::FocalLengthIn35mmFilm, In::PRIMARY);
    let Some(mm) = field.and_then(|field| field.value.get_uint(0)) else { return Ok(None) };
    match mm {
        // the standard's word for unknown
        0 => Ok(None),
        4..=2000 => Ok(Some(1e-3 * f64::from(mm))),
        _ => impossible("FocalLengthIn35mmFilm", mm, "4 to 2000 mm", "--fov-deg"),
    }
}

fn orientation(block: &Exif) -> Result<Option<u32>, PhotoError> {
    let field = block.get_field(Tag::Orientation, In::PRIMARY);
    match field.and_then(|field| field.value.get_uint(0)) {
        None | Some(0) => Ok(None),
        Some(told @ 1..=8) => Ok(Some(told)),
        Some(other) => impossible("Orientation", other, "1 to 8", "a file turned upright"),
    }
}

fn text(block: &Exif, tag: Tag) -> Option<Vec<u8>> {
    match &block.get_field(tag, In::PRIMARY)?.value {
        Value::Ascii(lines) => lines.first().cloned(),
        _ => None,
    }
}

fn time(block: &Exif) -> Result<Option<f64>, PhotoError> {
    let (Some(date), Some(offset)) =
        (text(block, Tag::DateTimeOriginal), text(block, Tag::OffsetTimeOriginal))
    else {
        return Ok(None);
    };
    let shown = format!("{} {}", String::from_utf8_lossy(&date), String::from_utf8_lossy(&offset));
    let accepted = "a date such as 2024:06:20 19:30:00 with an offset such as +02:00";
    let Ok(mut read) = DateTime::from_ascii(&date) else {
        return impossible("DateTimeOriginal", shown, accepted, "--time");
    };
    let known = read.parse_offset(&offset).is_ok();
    let Some(minutes) = read.offset.filter(|_| known) else {
        return impossible("OffsetTimeOriginal", shown, accepted, "--time");
    };
    let day = [u32::from(read.month), u32::from(read.day)];
    let clock = [read.hour, read.minute, read.second].map(f64::from);
    match unix_seconds(i64::from(read.year), day, clock) {
        Some(seconds) => Ok(Some(seconds - 60.0 * f64::from(minutes))),
        None => impossible("DateTimeOriginal", shown, accepted, "--time"),
    }
}

fn degrees(block: &Exif, tag: Tag) -> Option<f64> {
    match &block.get_field(tag, In::PRIMARY)?.value {
        Value::Rational(parts) if parts.len() >= 3 => {
            Some(parts[0].to_f64() + parts[1].to_f64() / 60.0 + parts[2].to_f64() / 3600.0)
        }
        _ => None,
    }
}

fn place(block: &Exif) -> Result<Option<[f64; 2]>, PhotoError> {
    let told = |tag, reference, negative: u8| {
        let sign = match text(block, reference)?.first() {
            Some(letter) if letter.eq_ignore_ascii_case(&negative) => -1.0,
            _ => 1.0,
        };
        Some(sign * degrees(block, tag)?)
    };
    let latitude = told(Tag::GPSLatitude, Tag::GPSLatitudeRef, b'S');
    let longitude = told(Tag::GPSLongitude, Tag::GPSLongitudeRef, b'W');
    let (Some(latitude), Some(longitude)) = (latitude, longitude) else { return Ok(None) };
    if !(-90.0..=90.0).contains(&latitude) {
        return impossible("GPSLatitude", latitude, "-90 to 90 degrees", "--place");
    }
    if !(-180.0..=180.0).contains(&longitude) {
        return impossible("GPSLongitude", longitude, "-180 to 180 degrees", "--place");
    }
    Ok(Some([latitude.to_radians(), longitude.to_radians()]))
}

fn heading(block: &Exif) -> Result<Option<f64>, PhotoError> {
    let field = block.get_field(Tag::GPSImgDirection, In::PRIMARY);
    let Some(Value::Rational(parts)) = field.map(|field| &field.value) else { return Ok(None) };
    let Some(degrees) = parts.first().map(exif::Rational::to_f64) else { return Ok(None) };
    if !(0.0..=360.0).contains(&degrees) {
        return impossible("GPSImgDirection", degrees, "0 to 360 degrees", "--azimuth-deg");
    }
    Ok(Some(degrees * PI / 180.0))
}

/// Seconds since 1970 of a date (Gregorian) and a time of day; nothing where there is no such date.
pub fn unix_seconds(
    year: i64,
    [month, day]: [u32; 2],
    [hour, minute, second]: [f64; 3],
) -> Option<f64> {
    let leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    let february = if leap { 29 } else { 28 };
    let lengths = [31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    let length = *lengths.get(month.checked_sub(1)? as usize)?;
    let clock = (0.0..24.0).contains(&hour)
        && (0.0..60.0).contains(&minute)
        && (0.0..61.0).contains(&second);
    if !(1..=length).contains(&day) || !(1600..=2600).contains(&year) || !clock {
        return None;
    }
    let before: u32 = lengths[..month as usize - 1].iter().sum();
    let past = year - 1;
    let leaps = |year: i64| year / 4 - year / 100 + year / 400;
    let days = 365 * (year - 1970) + leaps(past) - leaps(1969) + i64::from(before + day - 1);
    Some(days as f64 * 86_400.0 + hour * 3600.0 + minute * 60.0 + second)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_counted() {
        assert_eq!(unix_seconds(1970, [1, 1], [0.0; 3]), Some(0.0));
        assert_eq!(unix_seconds(2003, [10, 17], [19.0, 30.0, 30.0]), Some(1_066_419_030.0));
        assert_eq!(unix_seconds(2024, [2, 29], [0.0; 3]), Some(1_709_164_800.0));
        assert_eq!(unix_seconds(2023, [2, 29], [0.0; 3]), None);
        assert_eq!(unix_seconds(2023, [13, 1], [0.0; 3]), None);
    }

    /// A JPEG that is nothing but an EXIF block.
    fn jpeg(fields: &[exif::Field]) -> Vec<u8> {
        let mut writer = exif::experimental::Writer::new();
        fields.iter().for_each(|field| writer.push_field(field));
        let mut block = Cursor::new(b"Exif\0\0".to_vec());
        let mut tiff = Cursor::new(Vec::new());
        writer.write(&mut tiff, false).unwrap();
        block.get_mut().extend(tiff.into_inner());
        let block = block.into_inner();
        let length = (block.len() + 2) as u16;
        [&[0xff, 0xd8, 0xff, 0xe1][..], &length.to_be_bytes(), &block, &[0xff, 0xd9]].concat()
    }

    fn field(tag: Tag, value: Value) -> exif::Field {
        exif::Field { tag, ifd_num: In::PRIMARY, value }
    }

    /// Lens, time and place come back; what cannot be is told with what to do; no block tells nothing.
    #[test]
    fn blocks_are_read() {
        let ascii = |text: &str| Value::Ascii(vec![text.as_bytes().to_vec()]);
        let angle = |d: u32, m: u32, s: u32| {
            Value::Rational([d, m, s].map(|num| exif::Rational { num, denom: 1 }).to_vec())
        };
        let good = jpeg(&[
            field(Tag::FocalLengthIn35mmFilm, Value::Short(vec![24])),
            field(Tag::DateTimeOriginal, ascii("2003:10:17 12:30:30")),
            field(Tag::OffsetTimeOriginal, ascii("-07:00")),
            field(Tag::GPSLatitude, angle(39, 30, 0)),
            field(Tag::GPSLatitudeRef, ascii("N")),
            field(Tag::GPSLongitude, angle(105, 0, 36)),
            field(Tag::GPSLongitudeRef, ascii("W")),
        ]);
        let taken = Taken::of(&good).unwrap();
        assert_eq!((taken.focal_35, taken.time), (Some(0.024), Some(1_066_419_030.0)));
        let place = taken.place.unwrap().map(f64::to_degrees);
        assert!((place[0] - 39.5).abs() < 1e-9 && (place[1] + 105.01).abs() < 1e-9, "{place:?}");
        assert_eq!(Taken::of(b"no picture").unwrap(), Taken::default());
        for (bad, words) in [
            (
                field(Tag::FocalLengthIn35mmFilm, Value::Short(vec![60_000])),
                "FocalLengthIn35mmFilm = 60000: accepted are 4 to 2000 mm; --fov-deg",
            ),
            (
                field(
                    Tag::GPSImgDirection,
                    Value::Rational(vec![exif::Rational { num: 500, denom: 1 }]),
                ),
                "GPSImgDirection = 500",
            ),
        ] {
            let error = Taken::of(&jpeg(&[bad])).unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        }
    }
}
