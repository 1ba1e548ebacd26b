//! `gonio plan`: what a scene would compute, by which method, what is skipped and why.

use crate::cli::args::scene_flags::SceneFlags;
use crate::cli::cpu_time::CpuTime;
use crate::cli::failure::{Failure, Result};
use crate::cli::show::progress;
use clap::Args;
use gonio::phase_table::Slab;
use gonio::plan::{Engine, Plan, PlannedRange, Symmetry};
use gonio::render::bow::BowScene;
use gonio::scene::{Scene, SceneFile, SceneKind, human_bytes};
use gonio::simulate;
use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

/// What would be computed, what is skipped and why, time and memory expected
#[derive(Args)]
#[command(after_help = "Example: gonio plan data/scenes/raindrop.toml")]
pub struct PlanArgs {
    /// Scene of a table or of a picture; without one, the built-in raindrop
    #[arg(value_name = "SCENE.toml")]
    scene: Option<PathBuf>,
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    flags: SceneFlags,
}

pub fn run(args: PlanArgs) -> Result<()> {
    if let Some(path) = args.scene.as_deref().filter(|path| is_of_picture(path)) {
        if args.flags.keys() != SceneFile::default() {
            let words = "flags of keys belong to the scenes of tables; that of a picture says all that is planned of it";
            return Err(Failure::usage(words));
        }
        return plan_picture(path, args.json);
    }
    let scene = args.flags.scene(args.scene.as_deref())?;
    let spinner = progress::spinner("trials");
    let plan = Plan::new(&scene)?;
    let azimuths = plan.table_azimuths(&scene.phi);
    let (computed, _) = plan.computed_azimuths(&azimuths);
    let threads = rayon::current_num_threads();
    let cost = plan.cost(&scene, threads);
    let Expected { seconds, methods, sizes } = expected(&scene, &plan, &computed)?;
    let seconds = cost.writing_seconds + seconds;
    spinner.finish_and_clear();
    let engine = format!("{:?}", plan.engine);
    if args.json {
        let ranges: Vec<serde_json::Value> = methods.iter().map(as_json).collect();
        let skipped = methods.iter().flat_map(|planned| &planned.skipped);
        let skipped: BTreeSet<&String> = skipped.chain(&plan.reasons).collect();
        let report = serde_json::json!({
            "engine": engine,
            "orders": ranges.first().map(|range| &range["parts"]),
            "ranges": ranges,
            "skipped": skipped,
            "sizes": sizes,
            "forward_diffraction": plan.forward_diffraction,
            "rotational_symmetry": plan.symmetry == Symmetry::Rotational,
            "wavelengths": scene.wavelengths.len(),
            "theta": scene.theta.len(),
            "azimuths_stored": azimuths.len(),
            "azimuths_computed": computed.len(),
            "memory_bytes": cost.memory,
            "cpu_seconds": seconds,
            "expected_seconds": seconds / threads as f64,
        });
        println!("{report}");
        return Ok(());
    }
    match plan.orders.as_slice() {
        [] => println!("engine: {engine}, all orders at once"),
        orders => println!("engine: {engine}, orders {orders:?}"),
    }
    println!(
        "samples: {} wavelengths × {} scattering angles × {} azimuths ({} computed)",
        scene.wavelengths.len(),
        scene.theta.len(),
        azimuths.len(),
        computed.len()
    );
    for range in &methods {
        print!("{range}");
    }
    for words in sizes.iter().chain(&plan.reasons) {
        println!("- {words}");
    }
    println!(
        "expected: {seconds:.1} s of processor time ({:.1} s on {threads} idle cores), {} of memory",
        seconds / threads as f64,
        human_bytes(cost.memory)
    );
    Ok(())
}

fn is_of_picture(path: &Path) -> bool {
    SceneKind::of_file(path) == Some(SceneKind::Picture)
}

/// Of a picture: how much of its light is scattered more often than once.
fn plan_picture(path: &Path, json: bool) -> Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    let words = BowScene::load(path)?.plan(folder)?;
    if json {
        println!("{}", serde_json::json!({ "scattering": words }));
    } else {
        words.iter().for_each(|words| println!("- {words}"));
    }
    Ok(())
}

fn as_json(planned: &PlannedRange) -> serde_json::Value {
    let mut json = serde_json::json!(planned.range);
    json["skipped"] = serde_json::json!(planned.skipped);
    json["tried_at_nm"] = serde_json::json!(planned.tried_at_nm.map(|(nm, _)| nm));
    json["tried_azimuths"] = serde_json::json!(planned.tried_at_nm.map(|(_, azimuths)| azimuths));
    if let Some((parts, rest)) = &planned.share_of_time {
        let entries = json["parts"].as_array_mut().into_iter().flatten();
        for (entry, share) in entries.zip(parts) {
            entry["share_of_time"] = serde_json::json!(share);
        }
        json["rest_of_time"] = serde_json::json!(rest);
    }
    json
}

/// What a table takes beside its file, and who computes what.
struct Expected {
    /// Of processor time.
    seconds: f64,
    methods: Vec<PlannedRange>,
    /// How many radii stand for distributions of sizes, in words.
    sizes: Vec<String>,
}

/// Compute some wavelengths; of many drops by rays one drop of each order.
fn expected(scene: &Scene, plan: &Plan, computed: &[f64]) -> Result<Expected> {
    let steps = simulate::steps_of_kinds(scene, plan)?;
    if steps.iter().all(Option::is_none) {
        let tried = Trials::new(scene, plan, computed)?;
        let methods = tried.methods(scene, plan, computed)?;
        return Ok(Expected { seconds: tried.seconds, methods, sizes: Vec::new() });
    }
    let mut all = Expected { seconds: 0.0, methods: Vec::new(), sizes: Vec::new() };
    let plans = if plan.parts.is_empty() { std::slice::from_ref(plan) } else { &plan.parts };
    for ((part, plan), steps) in scene.parts().iter().zip(plans).zip(&steps) {
        all.methods.extend(plan.methods(part)?);
        let Some(steps) = steps else {
            all.seconds += Trials::new(part, plan, computed)?.seconds;
            continue;
        };
        let seconds = steps.forecast(part, plan, |work| {
            let watch = CpuTime::start();
            work()?;
            Ok(watch.seconds())
        })?;
        all.seconds += seconds * scene.wavelengths.len() as f64;
        all.sizes.extend(steps.words());
        let error = steps.expected_error;
        all.sizes.push(format!(
            "the mean over these sizes is expected to err by {:.1} %",
            100.0 * error
        ));
        if error > scene.tolerance {
            all.sizes.push(format!(
                "that is more than the tolerance asked for, {}; the table will be marked",
                scene.tolerance
            ));
        }
    }
    Ok(all)
}

/// Processor time that trials take at least, so that the clock's ticks do not matter.
const LEAST_TRIAL: f64 = 0.3;
/// Azimuths of the two trials where all are not tried: as many as are interpolated from traced ones and
/// not traced themselves (more than 40 with their opposites), and some more.
const TRIED: [usize; 2] = [24, 36];
/// Orientations of a crystal that are tried.
const TRIED_ORIENTATIONS: u32 = 16;

/// Some wavelengths, computed at some azimuths.
struct Trials {
    /// Number of each wavelength and its slab.
    slabs: Vec<(usize, Slab)>,
    /// Processor time of all wavelengths, scaled up.
    seconds: f64,
    /// Processor time of the first slab.
    first_slab: f64,
}

impl Trials {
    /// In the middle first, then to both sides: time goes with the size parameter.
    fn new(scene: &Scene, plan: &Plan, computed: &[f64]) -> Result<Self> {
        let count = scene.wavelengths.len();
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by_key(|&i| (2 * i + 1).abs_diff(count));
        let (mut spent, mut first_slab, mut slabs) = (0.0, 0.0, Vec::new());
        for i in order {
            let (seconds, tried, slab) = try_slab(scene, plan, computed, scene.wavelengths[i])?;
            if slabs.is_empty() {
                first_slab = tried;
            }
            spent += seconds;
            slabs.push((i, slab));
            if spent > LEAST_TRIAL {
                break;
            }
        }
        let seconds = spent / slabs.len() as f64 * count as f64;
        Ok(Self { slabs, seconds, first_slab })
    }

    /// The plan's methods, as they were found where a range was tried, with the shares of the time at the
    /// wavelength tried first.
    fn methods(&self, scene: &Scene, plan: &Plan, computed: &[f64]) -> Result<Vec<PlannedRange>> {
        let mut methods = plan.methods(scene)?;
        if plan.engine == Engine::Facets {
            return Ok(methods);
        }
        let tried = if computed.len() <= TRIED[1] { computed } else { &some(computed, TRIED[1]) };
        for planned in &mut methods {
            let range = planned.range.first..planned.range.first + planned.range.count;
            if let Some((i, slab)) = self.slabs.iter().find(|(i, _)| range.contains(i)) {
                planned.tried(scene.wavelengths[*i], tried.len(), &slab.methods);
                if *i == self.slabs[0].0 && plan.series_parts(scene).is_empty() {
                    let shares = shares_of_time(scene, plan, tried, slab, self.first_slab);
                    planned.share_of_time = Some(shares);
                }
            }
        }
        Ok(methods)
    }
}

/// Azimuths that a trial computes: all, or so many that are not symmetric about a right angle, whose
/// opposites are others.
fn some(computed: &[f64], tried: usize) -> Vec<f64> {
    let place = |k: usize| (k as f64 + 0.31) / tried as f64 * computed.len() as f64;
    (0..tried).map(|k| computed[place(k) as usize]).collect()
}

/// Processor time of one wavelength, scaled up to all azimuths; that of its slab at some of them, and
/// this.
fn try_slab(
    scene: &Scene,
    plan: &Plan,
    computed: &[f64],
    wavelength: f64,
) -> Result<(f64, f64, Slab)> {
    let time = |azimuths: Vec<f64>| -> Result<(f64, Slab)> {
        let probe = Scene { phi: azimuths, ..scene.clone() };
        let watch = CpuTime::start();
        let slab = simulate::slab(&probe, plan, wavelength)?;
        Ok((watch.seconds(), slab))
    };
    if plan.engine == Engine::Facets {
        // time goes with the number of orientations
        let all: u32 = plan.orientations(scene).iter().product();
        let few = all.min(TRIED_ORIENTATIONS);
        let probe = Scene { orientations: Some(few), ..scene.clone() };
        let watch = CpuTime::start();
        let slab = simulate::slab(&probe, plan, wavelength)?;
        let seconds = watch.seconds() * f64::from(all) / f64::from(few);
        return Ok((seconds, seconds, slab));
    }
    if plan.engine.is_exact() && plan.engine != Engine::TMatrix || computed.len() <= TRIED[1] {
        let (seconds, slab) = time(scene.phi.clone())?;
        return Ok((seconds, seconds, slab));
    }
    let (low, _) = time(some(computed, TRIED[0]))?;
    let (high, slab) = time(some(computed, TRIED[1]))?;
    Ok((scaled_up([low, high], computed), high, slab))
}

/// From the times of two trials to all azimuths.
fn scaled_up([low, high]: [f64; 2], computed: &[f64]) -> f64 {
    let [few, more] = TRIED;
    let each = ((high - low) / (more - few) as f64).clamp(0.0, high / more as f64);
    low + each * (computed.len() - few) as f64
}

/// Shares of the time of the parts of a slab that was tried, each order computed alone, and of the rest.
fn shares_of_time(
    scene: &Scene,
    plan: &Plan,
    azimuths: &[f64],
    slab: &Slab,
    seconds: f64,
) -> (Vec<f64>, f64) {
    // It has been computed at this wavelength.
    let seen = scene.medium.seen_outside(slab.wavelength).unwrap_or(slab.wavelength);
    let size_parameter = TAU * plan.radius / seen;
    let at = |&phi: &f64| scene.theta.iter().map(move |&theta| (theta, phi));
    let directions: Vec<(f64, f64)> = azimuths.iter().flat_map(at).collect();
    let alone = |order: u32| {
        let forward_diffraction = plan.forward_diffraction && order == 0;
        let plan = Plan { orders: vec![order], forward_diffraction, ..plan.clone() };
        let watch = CpuTime::start();
        let mut runs = 0;
        while runs == 0 || watch.seconds() < LEAST_OF_ORDER && runs < MOST_RUNS {
            simulate::scatter(&plan, slab.index, size_parameter, &directions);
            runs += 1;
        }
        watch.seconds() / f64::from(runs)
    };
    let parts: Vec<f64> = slab.methods.iter().filter_map(|part| part.order).map(alone).collect();
    let orders = parts.iter().sum::<f64>();
    let whole = seconds.max(orders);
    (parts.iter().map(|part| part / whole).collect(), 1.0 - orders / whole)
}

/// Processor time that an order is computed for at least, and how often at most.
const LEAST_OF_ORDER: f64 = 0.05;
const MOST_RUNS: u32 = 10;
