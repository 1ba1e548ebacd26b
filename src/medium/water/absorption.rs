//! Extinction coefficient k of pure liquid water, joined from two measurements.
//!
//! - 380 to 700 nm: Pope & Fry, Appl. Opt. 36, 8710 (1997), the reference for the visible.
//! - below 350 nm and above 720 nm: Segelstein (thesis, 1981), who extends Hale & Querry.
//! - 350 to 380 and 700 to 720 nm: ln k passes linearly in wavelength from one to the other, which
//!   keeps k continuous. At 380 nm the two differ by a factor of 5.6 (older data hold scattering
//!   and traces of dissolved matter), at 720 nm by 6 %.
//!
//! Hale & Querry 1973 and Kedenburg et al. 2012 are in the library under their own names.

use crate::math::monotone::MonotoneCurve;
use crate::medium::data::table::Table;
use crate::medium::shipped::tables;
use std::sync::OnceLock;

/// Pope & Fry are in force between the inner two, Segelstein outside the outer two, in metres.
const JOINS: [f64; 4] = [350e-9, 380e-9, 700e-9, 720e-9];

/// k at a wavelength in metres, from 0.1 to 10 µm; beyond, the end value is held.
pub(in crate::medium) fn extinction(wavelength: f64) -> f64 {
    static CURVE: OnceLock<MonotoneCurve> = OnceLock::new();
    CURVE.get_or_init(joined).value(wavelength).exp()
}

/// ln k by wavelength on the rows of both tables.
fn joined() -> MonotoneCurve {
    let outer = logarithm(tables::table("water_segelstein_1981"));
    let inner = logarithm(tables::table("water_pope_fry_1997"));
    let mut rows: Vec<f64> = inner.points().0.to_vec();
    rows.extend(outer.points().0.iter().filter(|w| !(JOINS[1]..=JOINS[3]).contains(*w)));
    rows.extend(JOINS);
    rows.sort_by(f64::total_cmp);
    rows.dedup_by(|a, b| *a - *b < 1e-12);
    let value = |&w: &f64| {
        let share = share_of_inner(w);
        // Below 380 nm the first row of Pope & Fry is held while its share fades.
        share * inner.value(w) + (1.0 - share) * outer.value(w)
    };
    let logs = rows.iter().map(value).collect();
    MonotoneCurve::new(rows, logs).expect("the shipped tables are sound: a test reads them")
}

fn share_of_inner(wavelength: f64) -> f64 {
    let rise = (wavelength - JOINS[0]) / (JOINS[1] - JOINS[0]);
    let fall = (JOINS[3] - wavelength) / (JOINS[3] - JOINS[2]);
    rise.min(fall).clamp(0.0, 1.0)
}

fn logarithm(table: &Table) -> MonotoneCurve {
    let logs = table.k.value.iter().map(|k| k.ln()).collect();
    MonotoneCurve::new(table.k.wavelength.clone(), logs)
        .expect("the shipped tables are sound: a test reads them")
}
