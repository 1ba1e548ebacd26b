//! `gonio rays` for spheres whose index varies along the radius.

use gonio::medium::radial::Body;
use gonio::render::DrawnRay;
use gonio::trace::{Chord, RadialRays, Rainbow};
use serde_json::{Value, json};

/// One ray, and what becomes of it.
struct RadialRay {
    impact: f64,
    deviation_deg: Option<f64>,
    path: Option<f64>,
    fate: &'static str,
    drawn: DrawnRay,
}

/// Rays of one order, evenly spaced across the sphere, and its rainbows.
pub(super) struct Traced {
    rays: Vec<RadialRay>,
    pub rainbows: Vec<Rainbow>,
}

/// The outermost rays miss the rim by this share.
const RIM: f64 = 1e-6;

/// Trace so many rays of an order.
pub(super) fn trace(body: &Body, order: u32, count: usize) -> Traced {
    let rays = RadialRays::new(body);
    let impact = |i: usize| (1.0 - RIM) * (2.0 * i as f64 / (count - 1) as f64 - 1.0);
    let upper = rays.rainbows(order);
    let lower = upper.iter().rev().map(|bow| Rainbow { impact: -bow.impact, ..*bow });
    Traced {
        rays: (0..count).map(|i| one(&rays, impact(i), order)).collect(),
        rainbows: lower.chain(upper.iter().copied()).collect(),
    }
}

fn one(rays: &RadialRays, impact: f64, order: u32) -> RadialRay {
    let b = impact.abs();
    let outside = -2.0 * (1.0 - b * b).sqrt();
    let (path, fate) = match (order, rays.chord(b)) {
        (0, _) => (Some(outside), "out"),
        (p, Chord::Through { path, .. }) => (Some(outside + f64::from(p) * path), "out"),
        (_, Chord::Centre) => (None, "centre"),
        (_, Chord::Reflected) => (None, "reflected"),
    };
    let deflection = rays.deflection(b, order);
    // The lower half is the upper one's mirror image.
    let side = if impact < 0.0 { -1.0 } else { 1.0 };
    let leaves = match fate {
        "reflected" => Some(2.0 * b.min(1.0).asin() - std::f64::consts::PI),
        _ => deflection,
    };
    let drawn = DrawnRay {
        points: rays.path(b, order).into_iter().map(|[x, z]| [side * x, z]).collect(),
        leaves: leaves.map(|turned| [-side * turned.sin(), turned.cos()]),
    };
    let deviation_deg = deflection.map(|turned| turned.cos().clamp(-1.0, 1.0).acos().to_degrees());
    RadialRay { impact, deviation_deg, path, fate, drawn }
}

impl Traced {
    pub fn drawn(&self) -> Vec<DrawnRay> {
        self.rays.iter().map(|ray| ray.drawn.clone()).collect()
    }

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
        let bow = |bow: &Rainbow| {
            json!({
                "impact": bow.impact,
                "deviation_deg": bow.deviation.to_degrees(),
                "branch": bow.branch(),
            })
        };
        json!({
            "rays": self.rays.iter().map(ray).collect::<Vec<_>>(),
            "rainbows": self.rainbows.iter().map(bow).collect::<Vec<_>>(),
        })
    }

    /// The same as lines.
    pub fn print(&self) {
        for bow in &self.rainbows {
            let degrees = bow.deviation.to_degrees();
            println!(
                "rainbow at {degrees:.4}° ({} branch), impact {:.6}",
                bow.branch(),
                bow.impact
            );
        }
        println!("# impact  deviation_deg  optical_path  fate");
        for ray in &self.rays {
            let shown = |value: Option<f64>| value.map_or("-".into(), |v| format!("{v:.8}"));
            let (degrees, path) = (shown(ray.deviation_deg), shown(ray.path));
            println!("{:9.6} {degrees} {path} {}", ray.impact, ray.fate);
        }
    }
}
