//! What an X-band radar measures of rain: `cargo run --release --example rain_radar`.

use gonio::medium::{MicrowaveWater, wavelength_of_ghz};
use gonio::radar::{Beam, DropShape, DropSpectrum, Rain};
use gonio::shape::RaindropModel;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let wavelength = wavelength_of_ghz(9.4);
    let shape = DropShape::Raindrop(RaindropModel::BeardChuang1987);
    let rain = Rain {
        shape,
        index: MicrowaveWater::Liebe1991.index(wavelength, 283.15)?,
        canting: 7f64.to_radians(),
        tolerance: 1e-3,
    };
    let beam = Beam::horizontal(wavelength);
    for rate in [1.0, 10.0, 50.0] {
        let spectrum = DropSpectrum::marshall_palmer(rate);
        let seen = rain.measure_spectrum(&beam, &spectrum, (0.1e-3, shape.largest()))?;
        println!(
            "{rate} mm/h: {:.1} dBZ, Z_dr {:.2} dB, K_dp {:.3} °/km, rho_hv {:.4}",
            10.0 * seen.z_h.log10(),
            seen.z_dr_db,
            seen.k_dp_deg_km,
            seen.rho_hv
        );
    }
    Ok(())
}
