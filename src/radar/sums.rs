//! Sums over drops of products of their amplitudes, and the radar quantities made of them.
//!
//! Horizontally polarised waves are those whose field is horizontal; wave and echo lie in the scattering plane
//! of azimuth 90°, so that `∥` is horizontal. With `f = iS/k`: `Z = λ⁴/(π⁵|K|²) Σ N 4π|f(180°)|²`,
//! `K_dp = λ Σ N Re(f_hh - f_vv)(0°)`, `A = 2λ Σ N Im f(0°)` as power (Bringi & Chandrasekar 2001, secs.
//! 3.8–3.14 and 4.5). Canting: axes tilted from the vertical by angles with the weight of a Gaussian, times the
//! sine of the tilt, all azimuths alike.

use crate::math::gauss_legendre;
use crate::series::tmatrix::{Scattered, TMatrix};
use num_complex::Complex64;
use std::f64::consts::{FRAC_PI_2, LOG10_E, PI, TAU};

/// Sums over drops, per m³; lengths in metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RadarSums {
    /// `Σ N |f|²` backwards: horizontal, vertical, cross.
    back: [f64; 3],
    /// `Σ N f_hh f_vv*` backwards.
    correlation: Complex64,
    /// `Σ N f` forwards: horizontal, vertical.
    forward: [Complex64; 2],
}

/// Radar quantities of a population.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadarQuantities {
    /// Reflectivity factor, horizontal polarisation, mm⁶/m³.
    pub z_h: f64,
    /// Vertical polarisation, mm⁶/m³.
    pub z_v: f64,
    /// Differential reflectivity, dB.
    pub z_dr_db: f64,
    /// Linear depolarisation ratio of horizontal polarisation, dB; -∞ where nothing is depolarised.
    pub ldr_db: f64,
    /// Specific differential phase, degrees per km one way.
    pub k_dp_deg_km: f64,
    /// Co-polar correlation at lag 0.
    pub rho_hv: f64,
    /// Backscatter differential phase, degrees.
    pub delta_hv_deg: f64,
    /// Specific attenuation of horizontal polarisation, dB per km one way.
    pub a_h_db_km: f64,
    /// Specific differential attenuation, dB per km one way.
    pub a_dp_db_km: f64,
}

/// Nodes over the tilt and over its azimuth.
const TILTS: usize = 10;
/// The same.
const AZIMUTHS: usize = 12;
/// Tilts counted, in standard deviations.
const REACH: f64 = 4.5;

impl RadarSums {
    /// Add drops of one size: number per m³, wavelength in metres, elevation of the beam above the horizon
    /// and standard deviation of canting (radians; 0: none).
    pub fn add(&mut self, t: &TMatrix, number: f64, wavelength: f64, elevation: f64, canting: f64) {
        // a beam that rises is light of a sun below the horizon
        let sun = -elevation;
        if canting == 0.0 {
            self.add_oriented(&Scattered::new(t, sun), 0.0, number, wavelength);
            return;
        }
        let reach = (REACH * canting).min(PI);
        let tilts: Vec<(f64, f64)> = gauss_legendre::nodes(TILTS)
            .into_iter()
            .map(|(x, weight)| {
                let tilt = 0.5 * reach * (x + 1.0);
                (tilt, weight * tilt.sin() * (-0.5 * (tilt / canting).powi(2)).exp())
            })
            .collect();
        let total: f64 = tilts.iter().map(|(_, weight)| weight).sum();
        let (sin, cos) = sun.sin_cos();
        for (tilt, weight) in tilts {
            for k in 0..AZIMUTHS {
                let about = TAU * (k as f64 + 0.5) / AZIMUTHS as f64;
                let (aside, ahead) = (tilt.sin() * about.sin(), tilt.sin() * about.cos());
                let up = tilt.cos();
                // the axis in the frame of the light: x upper side, z along the light
                let (x, z) = (up * cos + ahead * sin, ahead * cos - up * sin);
                let scattered = Scattered::new(t, -z.clamp(-1.0, 1.0).asin());
                let share = number * weight / total / AZIMUTHS as f64;
                self.add_oriented(&scattered, aside.atan2(x), share, wavelength);
            }
        }
    }

    /// Drops whose axis is turned about the beam.
    fn add_oriented(&mut self, scattered: &Scattered, turn: f64, number: f64, wavelength: f64) {
        let plane = FRAC_PI_2 - turn;
        let both = scattered.directions(&[(0.0, plane), (PI, plane)]);
        let length = Complex64::I * (wavelength / TAU);
        let (forward, back) = (both[0], both[1]);
        let (hh, vv) = (back.s2 * length, back.s1 * length);
        self.back[0] += number * hh.norm_sqr();
        self.back[1] += number * vv.norm_sqr();
        self.back[2] += number * (back.s4 * length).norm_sqr();
        self.correlation += number * hh * vv.conj();
        self.forward[0] += number * forward.s2 * length;
        self.forward[1] += number * forward.s1 * length;
    }

    /// With those of other drops.
    #[must_use]
    pub fn with(mut self, other: &Self) -> Self {
        self.back.iter_mut().zip(other.back).for_each(|(to, from)| *to += from);
        self.correlation += other.correlation;
        self.forward.iter_mut().zip(other.forward).for_each(|(to, from)| *to += from);
        self
    }

    /// The quantities, for a wavelength (metres) and `|K|²` of water (0.93 by custom).
    pub fn quantities(&self, wavelength: f64, dielectric_factor: f64) -> RadarQuantities {
        let decibel = |ratio: f64| 10.0 * ratio.log10();
        let z = 4.0 * PI * wavelength.powi(4) / (PI.powi(5) * dielectric_factor) * 1e18;
        // backwards the perpendicular direction is turned over: like amplitudes of a sphere differ in sign
        let correlation = -self.correlation;
        let attenuation = |f: Complex64| 2.0 * wavelength * f.im * 10.0 * LOG10_E * 1e3;
        // what rounding leaves of a depolarisation is none
        let cross = if self.back[2] > 1e-24 * self.back[0] { self.back[2] } else { 0.0 };
        RadarQuantities {
            z_h: z * self.back[0],
            z_v: z * self.back[1],
            z_dr_db: decibel(self.back[0] / self.back[1]),
            ldr_db: decibel(cross / self.back[0]),
            k_dp_deg_km: (wavelength * (self.forward[0] - self.forward[1]).re).to_degrees() * 1e3,
            rho_hv: correlation.norm() / (self.back[0] * self.back[1]).sqrt(),
            delta_hv_deg: correlation.arg().to_degrees(),
            a_h_db_km: attenuation(self.forward[0]),
            a_dp_db_km: attenuation(self.forward[0] - self.forward[1]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{RaindropModel, Shape};

    /// 2 mm at 10 GHz and 20 °C: 2.60 dB and 0.127 °/km for one drop per m³ (an independent T-matrix,
    /// null field against least squares).
    #[test]
    fn two_millimetre_drop_at_x_band() {
        let wavelength = 0.0299792458;
        let shape = Shape::raindrop(2e-3, RaindropModel::BeardChuang1987, 0.0).unwrap();
        let index = Complex64::new(8.056804460712645, 2.030631490998273);
        let t = TMatrix::new(&shape, TAU * 2e-3 / wavelength, index, 1e-3).unwrap();
        let mut sums = RadarSums::default();
        sums.add(&t, 1.0, wavelength, 0.0, 0.0);
        let q = sums.quantities(wavelength, 0.93);
        assert!((q.z_dr_db - 2.60).abs() < 5e-3, "{q:?}");
        assert!((q.k_dp_deg_km - 0.127).abs() < 5e-4, "{q:?}");
        assert!((q.rho_hv - 1.0).abs() < 1e-12 && q.delta_hv_deg.abs() < 10.0, "{q:?}");
        assert!(q.ldr_db == f64::NEG_INFINITY, "{q:?}");
        // canting lowers Z_dr and K_dp, and depolarises
        let mut canted = RadarSums::default();
        canted.add(&t, 1.0, wavelength, 0.0, 10f64.to_radians());
        let c = canted.quantities(wavelength, 0.93);
        assert!(c.z_dr_db < q.z_dr_db && c.k_dp_deg_km < q.k_dp_deg_km, "{c:?}");
        assert!(c.ldr_db > -40.0 && c.rho_hv < 1.0, "{c:?}");
        // a little canting is next to none
        let mut upright = RadarSums::default();
        upright.add(&t, 1.0, wavelength, 0.3, 1e-4);
        let mut fixed = RadarSums::default();
        fixed.add(&t, 1.0, wavelength, 0.3, 0.0);
        let (a, b) = (upright.quantities(wavelength, 0.93), fixed.quantities(wavelength, 0.93));
        assert!((a.z_dr_db - b.z_dr_db).abs() < 1e-5 && (a.z_h / b.z_h - 1.0).abs() < 1e-6);
    }

    /// Spheroids much smaller than the wavelength: polarisabilities in closed form
    /// (Bohren & Huffman 1983, sec. 5.3).
    #[test]
    fn rayleigh_limit_of_spheroids() {
        let (ratio, index) = (0.7f64, Complex64::new(8.0, 2.0));
        let shape = Shape::spheroid(ratio, 0.0).unwrap();
        let t = TMatrix::new(&shape, 1e-3, index, 1e-3).unwrap();
        let mut sums = RadarSums::default();
        sums.add(&t, 1.0, 0.1, 0.0, 0.0);
        let square = 1.0 / (ratio * ratio) - 1.0;
        let e = square.sqrt();
        let vertical = (1.0 + square) / square * (1.0 - e.atan() / e);
        let horizontal = 0.5 * (1.0 - vertical);
        let polarisability = |l: f64| (1.0 + l * (index * index - 1.0)).inv().norm_sqr();
        let known = 10.0 * (polarisability(horizontal) / polarisability(vertical)).log10();
        let found = sums.quantities(0.1, 0.93).z_dr_db;
        assert!((found - known).abs() < 1e-4, "{found} {known}");
    }
}
