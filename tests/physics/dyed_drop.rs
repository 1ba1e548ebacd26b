//! Anomalous dispersion turns the colours of a bow round (Weidlich & Wilkie 2009): in a drop of
//! strongly dyed water the blue bow stands outside the red one; with the dye's absorption and
//! water's own index it stands inside, as in any rainbow.

use gonio::medium::MediumSpec;
use gonio::series::lorenz_mie::Sphere;
use std::f64::consts::TAU;
use std::path::Path;

/// Scattering angle (degrees) of the main maximum of the primary bow, drops of 0.3 mm, averaged
/// over a tenth of a degree so that fine ripple does not decide.
fn bow(dispersion: bool, wavelength: f64) -> f64 {
    let text = format!(
        "{{ solute = \"fuchsine\", fraction = 0.02, host = \"water\", dispersion = {dispersion} }}"
    );
    let medium = MediumSpec::parse(&text).unwrap().resolve(Path::new("")).unwrap();
    let sphere = Sphere::new(TAU * 0.3e-3 / wavelength, medium.index(wavelength).unwrap()).unwrap();
    let theta: Vec<f64> = (0..7000).map(|i| 135.0 + 0.001 * f64::from(i)).collect();
    let radians: Vec<f64> = theta.iter().map(|t| t.to_radians()).collect();
    let intensity: Vec<f64> =
        sphere.amplitudes(&radians).iter().map(|(a, b)| a.norm_sqr() + b.norm_sqr()).collect();
    let smooth: Vec<f64> = intensity.windows(100).map(|w| w.iter().sum()).collect();
    let top = (0..smooth.len()).max_by(|&i, &j| smooth[i].total_cmp(&smooth[j])).unwrap();
    theta[top] + 0.05
}

#[test]
fn the_order_of_colours_is_reversed() {
    let [blue, red] = [425e-9, 650e-9].map(|w| bow(true, w));
    let [plain_blue, plain_red] = [425e-9, 650e-9].map(|w| bow(false, w));
    println!("dyed: blue {blue:.2}°, red {red:.2}°; water's n: {plain_blue:.2}°, {plain_red:.2}°");
    // Outside is the smaller scattering angle. Descartes: 138.2 and 139.4 against 139.1 and 137.7.
    assert!(red - blue > 0.8, "{blue} {red}");
    assert!(plain_blue - plain_red > 0.8, "{plain_blue} {plain_red}");
}
