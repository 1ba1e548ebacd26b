//! Amplitudes and what they are worth, as a table, as JSON, and in notes on stderr.

use super::args::{Job, MethodName, ScatterArgs};
use crate::cli::show::notes;
use gonio::farfield::ErrorEstimate;
use gonio::farfield::assignment::AiryRange;
use gonio::optics::AmplitudeMatrix;
use gonio::plan::{DOUBTFUL_PHASE_SHIFT, phase_shift};
use gonio::scatter::{Request, Scattering};
use num_complex::Complex64;
use serde_json::{Value, json};

/// Says on stderr where a result is worth less than was asked.
pub(super) fn note(args: &ScatterArgs, job: &Job, seen: &Scattering) {
    if let Some(left) = seen.remainder.filter(|left| left.not_converged) {
        notes::tell([format!(
            "the sum of Debye terms up to order {} has not converged: what is left out is {:.1e} of \
             the amplitude outside the forward peak; --method mie has all orders",
            left.last_order, left.share
        )]);
    }
    notes::tell(seen.bows.iter().map(ToString::to_string));
    let Some(worth) = seen.worth else { return };
    let phase_shift = phase_shift(job.request.index, job.request.size_parameter);
    if args.method == MethodName::Rays && phase_shift < DOUBTFUL_PHASE_SHIFT {
        notes::tell([format!(
            "the phase shift through the particle, 2x|n - 1| = {phase_shift:.1}, is small for rays \
             (below {DOUBTFUL_PHASE_SHIFT}): intensities from 10 to 170 degrees are {:.0} % off, \
             weighted by intensity, and {:.0} % on average over angles",
            100.0 * worth.weighted,
            100.0 * worth.by_band
        )]);
    }
    let doubtful: Vec<f64> = (job.theta_deg.iter().copied())
        .filter(|theta| worth.at(theta.to_radians()) > NOTED_ERROR)
        .collect();
    let ends =
        (doubtful.iter().copied().reduce(f64::min), doubtful.iter().copied().reduce(f64::max));
    if let (Some(from), Some(to)) = ends {
        notes::tell([format!(
            "{} of {} intensities, between {from} and {to} degrees, may be off by more than {:.0} %: see \
             error_estimate_by_theta of --json",
            doubtful.len(),
            job.theta_deg.len(),
            100.0 * NOTED_ERROR
        )]);
    }
    let back = worth.straight_back;
    if back > NOTED_ERROR {
        notes::tell([format!(
            "straight back rays may be off by {:.0} %: q_back is doubtful",
            100.0 * back
        )]);
    }
}

/// Relative error of an intensity above which it is said.
const NOTED_ERROR: f64 = 0.25;

pub(super) fn to_json(args: &ScatterArgs, job: &Job, seen: &Scattering, seconds: f64) -> Value {
    let pairs = |f: fn(&AmplitudeMatrix) -> Complex64| -> Vec<[f64; 2]> {
        seen.amplitudes.iter().map(|s| [f(s).re, f(s).im]).collect()
    };
    let budget = &seen.efficiencies;
    let by_theta = |worth: &ErrorEstimate| -> Vec<f64> {
        job.request.theta.iter().map(|&theta| worth.at(theta)).collect()
    };
    let absolute = job.request.index * job.outside;
    let mut value = json!({
        "method": match args.method {
            MethodName::Rays => "rays",
            MethodName::Mie => "mie",
            MethodName::Debye => "debye",
            MethodName::Tmatrix => "tmatrix",
            MethodName::Airy => "airy",
        },
        "size_parameter": job.request.size_parameter,
        "index": [absolute.re, absolute.im],
        "azimuth_deg": args.azimuth_deg,
        "theta_deg": job.theta_deg,
        "s1": pairs(|s| s.s1),
        "s2": pairs(|s| s.s2),
        "s3": pairs(|s| s.s3),
        "s4": pairs(|s| s.s4),
        "q_ext": budget.q_ext,
        "q_sca": budget.q_sca,
        "q_abs": budget.q_abs,
        "q_back": budget.q_back,
        "asymmetry": budget.asymmetry,
        "diffraction_included": seen.diffraction_included,
        "error_estimate": seen.worth.map(|worth| worth.weighted),
        "error_estimate_by_theta": seen.worth.map(|worth| by_theta(&worth)),
        "error_estimate_q_back": seen.worth.map(|worth| worth.straight_back),
        "remainder": seen.remainder.map(|left| left.largest),
        "remainder_share": seen.remainder.map(|left| left.share),
        "seconds": seconds,
    });
    if !seen.bows.is_empty() {
        let bow = |range: &AiryRange| {
            json!({
                "order": range.order,
                "bow_deg": range.bow.to_degrees(),
                "theta_deg": range.theta.map(f64::to_degrees),
                "expected_error": range.expected_error,
                "reason": range.to_string(),
            })
        };
        value["airy"] = seen.bows.iter().map(bow).collect();
    }
    if args.made_of.outside.is_some() {
        value["relative_index"] = json!([job.request.index.re, job.request.index.im]);
    }
    value
}

pub(super) fn print_table(job: &Job, seen: &Scattering) {
    let Request { size_parameter, index, .. } = job.request;
    let relative = if job.outside == 1.0 { "" } else { " relative to the outside" };
    println!("# size parameter {size_parameter}, index {}+{}i{relative}", index.re, index.im);
    println!("# theta_deg  S1  S2  S3  S4  S11");
    for (theta, s) in job.theta_deg.iter().zip(&seen.amplitudes) {
        let s11 = s.s11();
        println!("{theta:9.4} {:.6e} {:.6e} {:.6e} {:.6e} {s11:.6e}", s.s1, s.s2, s.s3, s.s4);
    }
}
