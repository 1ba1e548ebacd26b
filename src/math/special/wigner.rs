//! Wigner's functions d^l_mn(θ), which are the generalised spherical functions but for a factor i^(m-n).

/// `d^l_mn(θ)` for l = 0, 1, 2, … by upward recurrence (Mishchenko, Travis & Lacis 2002, eqs. B.9 to B.11 and B.22).
pub struct Wigner {
    m: f64,
    n: f64,
    cosine: f64,
    first: usize,
    l: usize,
    before: f64,
    now: f64,
}

impl Wigner {
    /// Of one pair of indices at one angle.
    pub fn new(m: i32, n: i32, cosine: f64) -> Self {
        let first = m.unsigned_abs().max(n.unsigned_abs());
        let (minus, plus) = ((m - n).unsigned_abs(), (m + n).unsigned_abs());
        let chosen = (1..=minus.min(plus))
            .fold(1.0, |product, k| product * f64::from(2 * first + 1 - k) / f64::from(k));
        let half = |part: f64, power: u32| (0.5 * part).max(0.0).sqrt().powi(power as i32);
        let sign = if n < m && minus % 2 == 1 { -1.0 } else { 1.0 };
        let now = sign * chosen.sqrt() * half(1.0 - cosine, minus) * half(1.0 + cosine, plus);
        let (m, n) = (f64::from(m), f64::from(n));
        Self { m, n, cosine, first: first as usize, l: 0, before: 0.0, now }
    }

    /// The function of the present l; then l grows by one. It is 0 below the larger of |m| and |n|.
    pub fn next(&mut self) -> f64 {
        let l = self.l;
        self.l += 1;
        if l < self.first {
            return 0.0;
        }
        let value = self.now;
        let (m, n, s) = (self.m, self.n, l as f64);
        let root = |s: f64| ((s * s - m * m) * (s * s - n * n)).max(0.0).sqrt();
        let above = if l == 0 {
            self.cosine
        } else {
            ((2.0 * s + 1.0) * (s * (s + 1.0) * self.cosine - m * n) * self.now
                - (s + 1.0) * root(s) * self.before)
                / (s * root(s + 1.0))
        };
        (self.before, self.now) = (value, above);
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(l: usize, m: i32, n: i32, cosine: f64) -> f64 {
        let mut function = Wigner::new(m, n, cosine);
        (0..=l).map(|_| function.next()).last().unwrap()
    }

    /// Closed forms of low degrees (Varshalovich et al. 1988, table 4.4 and 4.5).
    #[test]
    fn low_degrees_are_met() {
        let theta: f64 = 0.8;
        let (s, c) = theta.sin_cos();
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-14, "{a} {b}");
        close(at(1, 0, 0, c), c);
        close(at(2, 0, 0, c), 1.5 * c * c - 0.5);
        close(at(2, 0, 2, c), 6f64.sqrt() / 4.0 * s * s);
        close(at(2, 1, 2, c), 0.5 * s * (1.0 + c));
        close(at(2, 2, 1, c), -0.5 * s * (1.0 + c));
        close(at(2, 1, -2, c), -0.5 * s * (1.0 - c));
        close(at(1, 1, 0, c), -s / 2f64.sqrt());
    }

    /// The matrix of one degree is orthogonal: its rows have length 1.
    #[test]
    fn rows_have_length_one() {
        for l in [3, 12, 60] {
            for m in [0, 2, 3] {
                let last = l as i32;
                let sum: f64 = (-last..=last).map(|n| at(l, m, n, 0.3).powi(2)).sum();
                assert!((sum - 1.0).abs() < 1e-11, "{l} {m}: {sum}");
            }
        }
    }

    /// From the other side: d^l_mn(π - θ) = (-1)^(l+m) d^l_m,-n(θ).
    #[test]
    fn functions_mirror() {
        for (l, m) in [(4, 1), (5, 3), (7, 0)] {
            for n in [0, 2, -2] {
                let sign = if (l + m as usize).is_multiple_of(2) { 1.0 } else { -1.0 };
                let (a, b) = (at(l, m, n, -0.4), sign * at(l, m, -n, 0.4));
                assert!((a - b).abs() < 1e-14, "{l} {m} {n}: {a} {b}");
            }
        }
    }
}
