//! Interpolation over azimuth where the vertical plane is a mirror: values are known at even steps of
//! a half-turn, both ends in, and the other half is their mirror image.

use std::f64::consts::{PI, TAU};

/// A known value and its share in the value wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Share {
    /// Which value, at and above the place.
    pub index: usize,
    /// Whether the known value serves as its mirror image.
    pub mirrored: bool,
    /// Weight of that value.
    pub weight: f64,
}

/// The polynomial through the `N` nearest of `count ≥ 2` values at `jπ/(count - 1)`, at an azimuth
/// (radians, any turn).
pub fn shares<const N: usize>(azimuth: f64, count: usize) -> [Share; N] {
    let last = count as i64 - 1;
    let place = azimuth.rem_euclid(TAU) / PI * last as f64;
    let first = place.floor() as i64 - (N as i64 / 2 - 1);
    let at = place - first as f64;
    let mut shares = [Share::default(); N];
    for (k, share) in shares.iter_mut().enumerate() {
        let turned = (first + k as i64).rem_euclid(2 * last);
        let others = (0..N).filter(|&j| j != k);
        *share = Share {
            index: turned.min(2 * last - turned) as usize,
            mirrored: turned > last,
            weight: others.map(|j| (at - j as f64) / (k as f64 - j as f64)).product(),
        };
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An even and an odd function of azimuth come back, on both halves of the turn.
    #[test]
    fn even_and_odd_functions_come_back() {
        const COUNT: usize = 25;
        let known = |j: usize| PI * j as f64 / (COUNT - 1) as f64;
        for azimuth in [0.0, 0.03, 1.0, 3.1, PI, 3.2, 5.0, TAU - 0.01, -0.4] {
            let (mut even, mut odd) = (0.0, 0.0);
            for share in shares::<8>(azimuth, COUNT) {
                let phi = known(share.index);
                even += share.weight * (2.0 * phi).cos();
                odd += share.weight * if share.mirrored { -phi.sin() } else { phi.sin() };
            }
            assert!((even - (2.0 * azimuth).cos()).abs() < 1e-6, "{azimuth}: {even}");
            assert!((odd - azimuth.sin()).abs() < 1e-8, "{azimuth}: {odd}");
        }
    }
}
