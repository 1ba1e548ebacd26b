//! Multiply-add for loops compiled for several instruction sets.

/// `a b + c`: in one instruction and one rounding with `FMA`, for code compiled for machines that
/// have it (elsewhere that would be a slow library call), else in two.
#[inline(always)]
pub fn multiply_add<const FMA: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FMA { a.mul_add(b, c) } else { a * b + c }
}
