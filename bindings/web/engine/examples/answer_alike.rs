//! As `answer`, with the elementary functions that WebAssembly has: those of the crate `libm`, in place of the
//! system's. What is left of a difference to the WebAssembly is then its arithmetic.

use std::io::{Read, Write};

macro_rules! functions {
    ($($name:ident($($x:ident),+))*) => {
        $(
            // SAFETY: the name and the signature are those of C's, which the definition of the program precedes.
            #[unsafe(no_mangle)]
            extern "C" fn $name($($x: f64),+) -> f64 {
                libm::$name($($x),+)
            }
        )*
    };
}

functions! {
    sin(x) cos(x) tan(x) asin(x) acos(x) atan(x) atan2(y, x)
    sinh(x) cosh(x) tanh(x) asinh(x) acosh(x) atanh(x)
    exp(x) exp2(x) expm1(x) log(x) log2(x) log10(x) log1p(x) pow(x, y) cbrt(x) hypot(x, y)
}

/// What compilers make of a sine and a cosine of one angle.
///
/// # Safety
/// As C's function of this name: both places can be written.
#[unsafe(no_mangle)]
unsafe extern "C" fn sincos(x: f64, sine: *mut f64, cosine: *mut f64) {
    let (sin, cos) = libm::sincos(x);
    // SAFETY: by the contract.
    unsafe {
        *sine = sin;
        *cosine = cos;
    }
}

fn main() -> std::io::Result<()> {
    let mut request = Vec::new();
    std::io::stdin().read_to_end(&mut request)?;
    std::io::stdout().write_all(&gonio_web::respond(&request))
}
