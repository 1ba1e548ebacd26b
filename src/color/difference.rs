//! How different two colours look: CIELAB and the ΔE of 2000.

/// CIELAB coordinates `[L*, a*, b*]`.
pub type Lab = [f64; 3];

/// CIELAB (CIE 015:2018, section 8.2.1) relative to a white in the same scale as `xyz`.
pub fn lab(xyz: [f64; 3], white: [f64; 3]) -> Lab {
    const EDGE: f64 = 24.0 / 116.0;
    let f = |t: f64| {
        if t > EDGE.powi(3) { t.cbrt() } else { 841.0 / 108.0 * t + 16.0 / 116.0 }
    };
    let [x, y, z]: [f64; 3] = std::array::from_fn(|c| f(xyz[c] / white[c]));
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// CIEDE2000 with unit weights (Sharma, Wu & Dalal 2005, Color Res. Appl. 30, 21); 1 is about a
/// just noticeable difference.
pub fn delta_e_2000(first: Lab, second: Lab) -> f64 {
    let chroma = |lab: Lab| lab[1].hypot(lab[2]);
    let seventh = |c: f64| (c.powi(7) / (c.powi(7) + 25f64.powi(7))).sqrt();
    let stretch = 1.0 + 0.5 * (1.0 - seventh(0.5 * (chroma(first) + chroma(second))));
    let polar = |lab: Lab| {
        let a = stretch * lab[1];
        let hue = if a == 0.0 && lab[2] == 0.0 {
            0.0
        } else {
            lab[2].atan2(a).to_degrees().rem_euclid(360.0)
        };
        (lab[0], a.hypot(lab[2]), hue)
    };
    let ((l1, c1, h1), (l2, c2, h2)) = (polar(first), polar(second));

    let colourless = c1 * c2 == 0.0;
    let turn = match h2 - h1 {
        _ if colourless => 0.0,
        d if d > 180.0 => d - 360.0,
        d if d < -180.0 => d + 360.0,
        d => d,
    };
    let mean_hue = match h1 + h2 {
        sum if colourless => sum,
        sum if (h1 - h2).abs() <= 180.0 => 0.5 * sum,
        sum if sum < 360.0 => 0.5 * (sum + 360.0),
        sum => 0.5 * (sum - 360.0),
    };
    let (mean_l, mean_c) = (0.5 * (l1 + l2), 0.5 * (c1 + c2));
    let cosine = |degrees: f64| degrees.to_radians().cos();

    let t = 1.0 - 0.17 * cosine(mean_hue - 30.0)
        + 0.24 * cosine(2.0 * mean_hue)
        + 0.32 * cosine(3.0 * mean_hue + 6.0)
        - 0.20 * cosine(4.0 * mean_hue - 63.0);
    let rotation = 30.0 * (-((mean_hue - 275.0) / 25.0).powi(2)).exp();
    let cross = -2.0 * seventh(mean_c) * (2.0 * rotation).to_radians().sin();
    let l50 = (mean_l - 50.0).powi(2);
    let dl = (l2 - l1) / (1.0 + 0.015 * l50 / (20.0 + l50).sqrt());
    let dc = (c2 - c1) / (1.0 + 0.045 * mean_c);
    let dh = 2.0 * (c1 * c2).sqrt() * (0.5 * turn).to_radians().sin() / (1.0 + 0.015 * mean_c * t);
    (dl * dl + dc * dc + dh * dh + cross * dc * dh).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pairs and values of Sharma, Wu & Dalal 2005, table 1.
    #[test]
    fn ciede2000_gives_the_published_pairs() {
        let pairs = [
            ([50.0, 2.6772, -79.7751], [50.0, 0.0, -82.7485], 2.0425),
            ([50.0, 3.1571, -77.2803], [50.0, 0.0, -82.7485], 2.8615),
            ([50.0, -1.3802, -84.2814], [50.0, 0.0, -82.7485], 1.0000),
            ([50.0, 0.0, 0.0], [50.0, -1.0, 2.0], 2.3669),
            ([60.2574, -34.0099, 36.2677], [60.4626, -34.1751, 39.4387], 1.2644),
            ([63.0109, -31.0961, -5.8663], [62.8187, -29.7946, -4.0864], 1.2630),
            ([22.7233, 20.0904, -46.6940], [23.0331, 14.9730, -42.5619], 2.0373),
            ([90.8027, -2.0831, 1.4410], [91.1528, -1.6435, 0.0447], 1.4441),
            ([2.0776, 0.0795, -1.1350], [0.9033, -0.0636, -0.5514], 0.9082),
        ];
        for (a, b, expected) in pairs {
            assert!((delta_e_2000(a, b) - expected).abs() < 5.1e-5, "{a:?} {b:?}");
            assert!((delta_e_2000(b, a) - expected).abs() < 5.1e-5, "{b:?} {a:?}");
        }
    }
}
