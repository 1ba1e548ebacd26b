//! `gonio plan`: what a scene would compute, what is skipped and why.

use super::Result;
use super::cpu_time::CpuTime;
use super::scene_flags::SceneFlags;
use clap::Args;
use gonio::plan::{Engine, Plan, Symmetry};
use gonio::scene::{Scene, human_bytes};
use gonio::simulate;
use std::path::PathBuf;

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

pub fn run(args: PlanArgs) -> Result<()> {
    let scene = args.flags.scene(args.scene.as_deref())?;
    let plan = Plan::new(&scene)?;
    let azimuths = plan.table_azimuths(&scene.phi);
    let (computed, _) = plan.computed_azimuths(&azimuths);
    let threads = rayon::current_num_threads();
    let cost = plan.cost(&scene, threads);
    let seconds = cost.writing_seconds + physics_seconds(&scene, &plan, &computed)?;
    let engine = format!("{:?}", plan.engine);
    if args.json {
        let report = serde_json::json!({
            "engine": engine,
            "orders": plan.orders,
            "forward_diffraction": plan.forward_diffraction,
            "rotational_symmetry": plan.symmetry == Symmetry::Rotational,
            "wavelengths": scene.wavelengths.len(),
            "theta": scene.theta.len(),
            "azimuths_stored": azimuths.len(),
            "azimuths_computed": computed.len(),
            "memory_bytes": cost.memory,
            "cpu_seconds": seconds,
            "expected_seconds": seconds / threads as f64,
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
    for reason in &plan.reasons {
        println!("- {reason}");
    }
    println!(
        "expected: {seconds:.1} s of processor time ({:.1} s on {threads} idle cores), {} of memory",
        seconds / threads as f64,
        human_bytes(cost.memory)
    );
    Ok(())
}

/// Processor time that trials take at least, so that the clock's ticks do not matter.
const LEAST_TRIAL: f64 = 0.3;
/// Azimuths of the two trials where all are not tried: as many as are interpolated from traced ones and
/// not traced themselves (more than 40 with their opposites), and some more.
const TRIED: [usize; 2] = [24, 36];

/// Processor time of all wavelengths: trials at some of them, scaled up.
fn physics_seconds(scene: &Scene, plan: &Plan, computed: &[f64]) -> Result<f64> {
    let count = scene.wavelengths.len();
    // in the middle first, then to both sides: time goes with the size parameter
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by_key(|&i| (2 * i + 1).abs_diff(count));
    let (mut spent, mut tried) = (0.0, 0);
    for &i in &order {
        spent += slab_seconds(scene, plan, computed, scene.wavelengths[i])?;
        tried += 1;
        if spent > LEAST_TRIAL {
            break;
        }
    }
    Ok(spent / f64::from(tried) * count as f64)
}

/// Processor time of one wavelength.
fn slab_seconds(scene: &Scene, plan: &Plan, computed: &[f64], wavelength: f64) -> Result<f64> {
    let time = |azimuths: Vec<f64>| -> Result<f64> {
        let probe = Scene { phi: azimuths, ..scene.clone() };
        let watch = CpuTime::start();
        simulate::slab(&probe, plan, wavelength)?;
        Ok(watch.seconds())
    };
    let series = matches!(plan.engine, Engine::LorenzMie | Engine::Debye);
    if series || computed.len() <= TRIED[1] {
        return time(scene.phi.clone());
    }
    let some = |tried: usize| -> Vec<f64> {
        // not symmetric about a right angle: their opposites are others
        let place = |k: usize| (k as f64 + 0.31) / tried as f64 * computed.len() as f64;
        (0..tried).map(|k| computed[place(k) as usize]).collect()
    };
    let [few, more] = TRIED;
    let (low, high) = (time(some(few))?, time(some(more))?);
    let each = ((high - low) / (more - few) as f64).clamp(0.0, high / more as f64);
    Ok(low + each * (computed.len() - few) as f64)
}
