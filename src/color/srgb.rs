//! XYZ to sRGB (IEC 61966-2-1) with the gamut rule of this module.

use super::Observer;

/// XYZ (D65 white, Y = 1) to linear sRGB, the four digits of the standard.
const XYZ_TO_RGB: [[f64; 3]; 3] =
    [[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]];
/// Linear sRGB to XYZ, the four digits of the standard.
const RGB_TO_XYZ: [[f64; 3]; 3] =
    [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];

fn multiply(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|r| (0..3).map(|c| matrix[r][c] * v[c]).sum())
}

/// Linear sRGB, unclipped: negative or above 1 where the colour does not fit.
pub fn xyz_to_linear_srgb(xyz: [f64; 3]) -> [f64; 3] {
    multiply(&XYZ_TO_RGB, xyz)
}

/// XYZ of gamma-encoded sRGB values in [0, 1].
pub fn srgb_to_xyz(rgb: [f64; 3]) -> [f64; 3] {
    multiply(&RGB_TO_XYZ, rgb.map(decode_srgb))
}

/// Linear to gamma-encoded.
pub fn encode_srgb(linear: f64) -> f64 {
    if linear <= 0.0031308 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Gamma-encoded to linear.
pub fn decode_srgb(encoded: f64) -> f64 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// XYZ to gamma-encoded sRGB, unclipped: no gamut rule, for checks against other programs.
pub fn xyz_to_srgb(xyz: [f64; 3]) -> [f64; 3] {
    xyz_to_linear_srgb(xyz).map(encode_srgb)
}

/// Bring linear sRGB into [0, 1] by mixing with the grey of the same luminance, just enough.
pub fn fit_gamut(linear: [f64; 3]) -> [f64; 3] {
    let grey: f64 = (0..3).map(|c| RGB_TO_XYZ[1][c] * linear[c]).sum();
    if grey.is_nan() || grey <= 0.0 {
        return [0.0; 3];
    }
    if grey >= 1.0 {
        return [1.0; 3];
    }
    let share = linear.iter().fold(1.0_f64, |share, &value| {
        if value < 0.0 {
            share.min(grey / (grey - value))
        } else if value > 1.0 {
            share.min((1.0 - grey) / (value - grey))
        } else {
            share
        }
    });
    linear.map(|value| (grey + share * (value - grey)).clamp(0.0, 1.0))
}

/// XYZ times an exposure, fitted into the gamut, as 8-bit sRGB.
pub fn to_srgb(xyz: [f64; 3], exposure: f64) -> [u8; 3] {
    fit_gamut(xyz_to_linear_srgb(xyz.map(|v| v * exposure)))
        .map(|linear| (255.0 * encode_srgb(linear)).round() as u8)
}

/// The colour in which a curve of one wavelength (metres) is drawn: its spectral colour in gamut,
/// dark enough to be read on white. Outside the visible: grey.
pub fn wavelength_srgb(wavelength: f64) -> [u8; 3] {
    let linear = xyz_to_linear_srgb(Observer::Cie1931.matching(wavelength));
    let positive = linear.map(|v| v.max(0.0));
    let largest = positive.iter().fold(0.0_f64, |m, &v| m.max(v));
    if largest < 1e-3 {
        return [110, 110, 110];
    }
    positive.map(|v| (255.0 * encode_srgb(0.8 * v / largest)).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gamut_rule_keeps_luminance_and_hue_direction() {
        for linear in [[0.9, -0.2, 0.1], [1.4, 0.2, 0.05], [-0.3, 0.5, 1.3], [0.2, 0.3, 0.4]] {
            let luminance = |v: [f64; 3]| -> f64 { (0..3).map(|c| RGB_TO_XYZ[1][c] * v[c]).sum() };
            let fitted = fit_gamut(linear);
            assert!(fitted.iter().all(|v| (0.0..=1.0).contains(v)), "{fitted:?}");
            approx::assert_relative_eq!(luminance(fitted), luminance(linear), max_relative = 1e-12);
            let grey = luminance(linear);
            let ratio = (fitted[0] - grey) / (linear[0] - grey);
            for c in 1..3 {
                assert!((fitted[c] - grey - ratio * (linear[c] - grey)).abs() < 1e-12);
            }
        }
        assert_eq!(fit_gamut([2.0, 1.5, 1.2]), [1.0; 3]);
        assert_eq!(fit_gamut([f64::NAN, 0.0, 0.0]), [0.0; 3]);
    }

    #[test]
    fn transfer_function_is_its_own_inverse() {
        for i in 0..=1000 {
            let v = i as f64 / 1000.0;
            assert!((decode_srgb(encode_srgb(v)) - v).abs() < 1e-7, "{v}");
        }
    }
}
