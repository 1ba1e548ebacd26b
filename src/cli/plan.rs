//! `gonio plan`: what a scene would compute, what is skipped and why.

use super::scene_flags::SceneFlags;
use clap::Args;
use gonio::plan::methods::MethodRange;
use gonio::plan::{Plan, Symmetry};
use gonio::scene::human_bytes;
use gonio::simulate;
use std::path::PathBuf;
use std::time::Instant;

/// What would be computed, what is skipped and why, time and memory expected
#[derive(Args)]
#[command(after_help = "Example: gonio plan data/scenes/raindrop.toml")]
pub struct PlanArgs {
    /// Scene file; without one, the built-in raindrop
    #[arg(value_name = "SCENE.toml")]
    scene: Option<PathBuf>,
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    flags: SceneFlags,
}

pub fn run(args: PlanArgs) -> anyhow::Result<()> {
    let scene = args.flags.scene(args.scene.as_deref())?;
    let plan = Plan::new(&scene)?;
    let size = scene.table_size();
    let azimuths = plan.table_azimuths(&scene.phi);
    let (computed, _) = plan.computed_azimuths(&azimuths);
    // The time of one small slab, scaled: everything but the samples is the same for all.
    let seconds = expected_seconds(&scene, &plan, computed.len())?;
    let engine = format!("{:?}", plan.engine);
    let methods = plan.methods(&scene)?;
    if args.json {
        let report = serde_json::json!({
            "engine": engine,
            "orders": methods.first().map(|range| &range.orders),
            "ranges": methods,
            "forward_diffraction": plan.forward_diffraction,
            "rotational_symmetry": plan.symmetry == Symmetry::Rotational,
            "wavelengths": scene.wavelengths.len(),
            "theta": scene.theta.len(),
            "azimuths_stored": azimuths.len(),
            "azimuths_computed": computed.len(),
            "memory_bytes": size.working_memory(),
            "expected_seconds": seconds,
            "reasons": plan.reasons,
        });
        println!("{report}");
        return Ok(());
    }
    println!("engine: {engine}, orders {:?}", plan.orders);
    println!(
        "samples: {} wavelengths × {} scattering angles × {} azimuths ({} computed)",
        scene.wavelengths.len(),
        scene.theta.len(),
        azimuths.len(),
        computed.len()
    );
    for range in &methods {
        print_range(range);
    }
    for reason in &plan.reasons {
        println!("- {reason}");
    }
    println!(
        "expected: {seconds:.1} s on {} threads, {} of memory",
        rayon::current_num_threads(),
        human_bytes(size.working_memory())
    );
    Ok(())
}

/// One line per order and method.
fn print_range(range: &MethodRange) {
    println!("{:.5} to {:.5} nm:", range.from_nm, range.to_nm);
    println!("  {:>5}  {:>5}  {:>7}  {:>8}  method, and why", "order", "part", "light", "error");
    for order in &range.orders {
        let part = &order.assigned;
        println!(
            "  {:>5}  {:>4.0}%  {:>6.2}%  {:>7.2}%  {}: {}",
            part.order,
            100.0 * part.share,
            100.0 * order.share_of_light,
            100.0 * part.expected_error,
            part.method.words(),
            part.reason
        );
    }
}

/// Time one wavelength at a tenth of the azimuths, and scale up.
fn expected_seconds(
    scene: &gonio::scene::Scene,
    plan: &Plan,
    computed: usize,
) -> anyhow::Result<f64> {
    let few = computed.div_ceil(10).max(2);
    let mut probe = scene.clone();
    probe.phi = scene.phi.iter().copied().take(1).collect();
    let Some(&wavelength) = scene.wavelengths.first() else { return Ok(0.0) };
    let start = Instant::now();
    simulate::slab(&probe, plan, wavelength)?;
    let one = start.elapsed().as_secs_f64();
    if computed <= 2 {
        return Ok(one * scene.wavelengths.len() as f64);
    }
    let step = scene.phi.len().div_ceil(2 * few).max(1);
    probe.phi = scene.phi.iter().copied().step_by(step).collect();
    let (some, _) = plan.computed_azimuths(&probe.phi);
    let start = Instant::now();
    simulate::slab(&probe, plan, wavelength)?;
    let several = start.elapsed().as_secs_f64();
    let per_azimuth = ((several - one) / (some.len().max(2) - 1) as f64).max(0.0);
    Ok((one + per_azimuth * computed as f64) * scene.wavelengths.len() as f64)
}
