//! `gonio rays` for spheres whose index varies along the radius.

use gonio::medium::radial::Body;
use gonio::trace::{Chord, RadialRays};
use serde_json::{Value, json};

/// One ray: impact, deviation in degrees, optical path, and its fate.
pub struct RadialRay {
    impact: f64,
    deviation_deg: Option<f64>,
    path: Option<f64>,
    fate: &'static str,
}

/// Rays of one order, evenly spaced across the sphere, and its rainbows (impact, degrees).
pub struct Traced {
    rays: Vec<RadialRay>,
    rainbows: Vec<(f64, f64)>,
}

/// Angle between incident and exit direction, degrees.
fn folded(deflection: f64) -> f64 {
    deflection.cos().clamp(-1.0, 1.0).acos().to_degrees()
}

/// Trace so many rays of an order.
pub fn trace(body: &Body, order: u32, count: usize) -> Traced {
    let rays = RadialRays::new(body);
    let one = |i: usize| {
        let impact = (1.0 - 1e-6) * (2.0 * i as f64 / (count - 1) as f64 - 1.0);
        let b: f64 = impact.abs();
        let outside = -2.0 * (1.0 - b * b).sqrt();
        let (path, fate) = match (order, rays.chord(b)) {
            (0, _) => (Some(outside), "out"),
            (p, Chord::Through { path, .. }) => (Some(outside + f64::from(p) * path), "out"),
            (_, Chord::Centre) => (None, "centre"),
            (_, Chord::Reflected) => (None, "reflected"),
        };
        let deviation_deg = rays.deflection(b, order).map(folded);
        RadialRay { impact, deviation_deg, path, fate }
    };
    let upper: Vec<(f64, f64)> =
        rays.rainbows(order).into_iter().map(|(b, angle)| (b, folded(angle))).collect();
    let lower = upper.iter().rev().map(|&(b, angle)| (-b, angle));
    Traced { rays: (0..count).map(one).collect(), rainbows: lower.chain(upper.clone()).collect() }
}

impl Traced {
    /// As `gonio rays --json` prints other rays; what is not known is null.
    pub fn json(&self) -> Value {
        let ray = |r: &RadialRay| {
            json!({
                "impact": r.impact,
                "deviation_deg": r.deviation_deg,
                "optical_path": r.path,
                "focal_lines": null,
                "fate": r.fate,
            })
        };
        let bow = |&(impact, deviation_deg): &(f64, f64)| {
            let branch = if impact >= 0.0 { "upper" } else { "lower" };
            json!({ "impact": impact, "deviation_deg": deviation_deg, "branch": branch })
        };
        json!({
            "rays": self.rays.iter().map(ray).collect::<Vec<_>>(),
            "rainbows": self.rainbows.iter().map(bow).collect::<Vec<_>>(),
        })
    }

    /// The same as lines.
    pub fn print(&self) {
        for (impact, degrees) in &self.rainbows {
            println!("rainbow at {degrees:.4}°, impact {impact:.6}");
        }
        println!("# impact  deviation_deg  optical_path  fate");
        for ray in &self.rays {
            let (degrees, path) = (ray.deviation_deg, ray.path);
            let shown = |value: Option<f64>| value.map_or("-".into(), |v| format!("{v:.8}"));
            println!("{:9.6} {} {} {}", ray.impact, shown(degrees), shown(path), ray.fate);
        }
    }
}
