//! Multiply-add for loops compiled for several instruction sets.

/// `a b + c`: in one instruction and one rounding with `FMA`, for code compiled for machines that
/// have it (elsewhere that would be a slow library call), else in two.
#[inline(always)]
pub fn multiply_add<const FMA: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FMA { a.mul_add(b, c) } else { a * b + c }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With one rounding the error of a product is told, with two it is lost.
    #[test]
    fn rounding_happens_once_or_twice() {
        let a = 1.0 + f64::EPSILON;
        let product = a * a;
        assert_eq!(multiply_add::<true>(a, a, -product), f64::EPSILON * f64::EPSILON);
        assert_eq!(multiply_add::<false>(a, a, -product), 0.0);
    }
}
