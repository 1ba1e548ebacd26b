//! What a kind of body tells of its level set `F(q, ζ)` at a point: values and derivatives.

/// `F` and its first derivatives with respect to `q = x·x` and `ζ = x·down`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slope<T> {
    /// `F`.
    pub f: T,
    /// `∂F/∂q`
    pub q: T,
    /// `∂F/∂ζ`
    pub z: T,
}

/// First and second derivatives of `F` with respect to `q` and `ζ`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level<T> {
    /// `∂F/∂q`
    pub q: T,
    /// `∂F/∂ζ`
    pub z: T,
    /// `∂²F/∂q²`
    pub qq: T,
    /// `∂²F/∂q∂ζ`
    pub qz: T,
    /// `∂²F/∂ζ²`
    pub zz: T,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::samples::shapes;

    /// What F, its slopes and its second derivatives say must be one function.
    #[test]
    fn derivatives_are_those_of_the_level_function() {
        const H: f64 = 1e-5;
        for shape in shapes() {
            let (q, z) = (0.9, 0.35);
            let slope = |q: f64, z: f64| shape.slope(q, z);
            let (s, l) = (slope(q, z), shape.level(q, z));
            let by = |f: &dyn Fn(Slope<f64>) -> f64, dq: f64, dz: f64| {
                (f(slope(q + H * dq, z + H * dz)) - f(slope(q - H * dq, z - H * dz))) / (2.0 * H)
            };
            assert!((by(&|s| s.f, 1.0, 0.0) - s.q).abs() < 1e-9, "{shape:?}");
            assert!((by(&|s| s.f, 0.0, 1.0) - s.z).abs() < 1e-9);
            assert!((l.q - s.q).abs() + (l.z - s.z).abs() < 1e-14);
            assert!((by(&|s| s.q, 1.0, 0.0) - l.qq).abs() < 1e-9);
            assert!((by(&|s| s.q, 0.0, 1.0) - l.qz).abs() < 1e-9);
            assert!((by(&|s| s.z, 0.0, 1.0) - l.zz).abs() < 1e-9);
        }
    }
}
