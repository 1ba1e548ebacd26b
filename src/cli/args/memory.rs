//! Does the computation of a table fit into this machine's memory, or into what it may take?

use crate::cli::failure::{Failure, Result};
use clap::Args;
use gonio::plan::{Engine, Plan, available_memory};
use gonio::scene::{Scene, human_bytes};

/// The flag of commands that estimate their memory before they start.
#[derive(Args, Clone, Copy, Debug)]
pub struct MemoryFlag {
    /// Refuse what needs more memory than this (default: what is free)
    #[arg(long, value_name = "GIB", value_parser = gibibytes)]
    memory_limit: Option<u64>,
}

impl MemoryFlag {
    /// The limit, bytes; `None` where none is given and the system does not say what is free.
    pub fn limit(self) -> Option<u64> {
        self.memory_limit.or_else(available_memory)
    }

    /// Refuse a scene that would not fit.
    pub fn check(self, scene: &Scene) -> Result<()> {
        let plan = Plan::new(scene)?;
        let needed = plan.cost(scene, rayon::current_num_threads()).memory;
        let Some(limit) = self.limit().filter(|limit| needed > *limit) else { return Ok(()) };
        let rays = match plan.engine {
            Engine::Patches => {
                format!(
                    " with model.rays_across = {} ({} orders)",
                    2 * plan.rings,
                    plan.orders.len()
                )
            }
            _ => String::new(),
        };
        let fewer = if rays.is_empty() { "angles" } else { "angles or rays" };
        Err(Failure::usage(format!(
            "table.theta_deg × table.azimuth_deg = {} × {}{rays}: a wavelength of {} needs about {} of \
             memory, the limit is {}; take fewer {fewer}, or raise --memory-limit",
            scene.theta.len(),
            scene.phi.len(),
            human_bytes(scene.table_size().slab_bytes),
            human_bytes(needed),
            human_bytes(limit)
        )))
    }
}

fn gibibytes(text: &str) -> Result<u64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number > 0.0 => {
            Ok((number * f64::from(1 << 30)) as u64)
        }
        _ => Err("a number of GiB above 0 is accepted, such as 8 or 0.5".into()),
    }
}
