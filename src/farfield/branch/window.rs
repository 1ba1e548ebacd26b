//! Where an integral over rays takes over from single rays: an infinitely smooth weight.

/// A weight that rises from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Where it leaves 0.
    pub start: f64,
    /// Where it reaches 1.
    pub full: f64,
}

impl Window {
    /// The weight at a place: all its derivatives vanish at both ends.
    pub fn weight(&self, place: f64) -> f64 {
        self.with_derivatives(place)[0]
    }

    /// The weight and its first and second derivative.
    pub fn with_derivatives(&self, place: f64) -> [f64; 3] {
        let width = self.full - self.start;
        let t = (place - self.start) / width;
        if t <= 1e-3 {
            return [0.0; 3];
        }
        if t >= 1.0 - 1e-3 {
            return [1.0, 0.0, 0.0];
        }
        let u = 1.0 - t;
        // w = 1/(1 + e^g)
        let (g, g1, g2) =
            (1.0 / t - 1.0 / u, -1.0 / (t * t) - 1.0 / (u * u), 2.0 / t.powi(3) - 2.0 / u.powi(3));
        let w = 1.0 / (1.0 + g.exp());
        let w1 = -w * (1.0 - w) * g1;
        let w2 = -w1 * (1.0 - 2.0 * w) * g1 - w * (1.0 - w) * g2;
        [w, w1 / width, w2 / (width * width)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WINDOW: Window = Window { start: -0.4, full: 1.1 };

    /// What one window leaves its mirror image takes: rays and integral together count once.
    #[test]
    fn a_window_and_its_mirror_image_add_up_to_one() {
        for k in 0..=60 {
            let place = -0.6 + f64::from(k) * 0.03;
            let mirrored = WINDOW.start + WINDOW.full - place;
            assert!(
                (WINDOW.weight(place) + WINDOW.weight(mirrored) - 1.0).abs() < 1e-15,
                "{place}"
            );
        }
        assert_eq!((WINDOW.weight(-0.4), WINDOW.weight(0.35), WINDOW.weight(1.1)), (0.0, 0.5, 1.0));
    }

    #[test]
    fn the_weight_rises_and_its_derivatives_are_its_own() {
        const H: f64 = 1e-5;
        let mut before = 0.0;
        for k in 1..50 {
            let place = WINDOW.start + f64::from(k) * 0.03;
            let [weight, slope, bend] = WINDOW.with_derivatives(place);
            assert!(weight >= before, "{place}");
            before = weight;
            let (a, b) = (WINDOW.with_derivatives(place - H), WINDOW.with_derivatives(place + H));
            assert!(((b[0] - a[0]) / (2.0 * H) - slope).abs() < 1e-8, "{place}");
            assert!(((b[1] - a[1]) / (2.0 * H) - bend).abs() < 1e-7, "{place}");
        }
    }
}
