//! The sphere: `F = (q - 1) / 2`.

use super::level::{Level, Slope};
use crate::math::scalar::Scalar;

pub(super) fn slope<T: Scalar>(q: T) -> Slope<T> {
    Slope { f: (q - 1.0) * 0.5, q: T::real(0.5), z: T::default() }
}

pub(super) fn level<T: Scalar>(_q: T) -> Level<T> {
    let zero = T::default();
    Level { q: T::real(0.5), z: zero, qq: zero, qz: zero, zz: zero }
}
