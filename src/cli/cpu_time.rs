//! Processor time of this process, which does not depend on what else the machine does.

use std::time::{Duration, Instant};

/// A stopwatch of processor time; of the clock on the wall where the system does not tell.
pub struct CpuTime {
    spent: Option<Duration>,
    wall: Instant,
}

impl CpuTime {
    pub fn start() -> Self {
        Self { spent: spent(), wall: Instant::now() }
    }

    /// Seconds since the start, of all threads together.
    pub fn seconds(&self) -> f64 {
        match (self.spent, spent()) {
            (Some(before), Some(now)) => now.saturating_sub(before).as_secs_f64(),
            _ => self.wall.elapsed().as_secs_f64() * rayon::current_num_threads() as f64,
        }
    }
}

/// Time spent so far, in the program and for it.
#[cfg(unix)]
fn spent() -> Option<Duration> {
    use rustix::time::{ClockId, clock_gettime};
    clock_gettime(ClockId::ProcessCPUTime).try_into().ok()
}

#[cfg(not(unix))]
fn spent() -> Option<Duration> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_takes_time() {
        let watch = CpuTime::start();
        let mut sum = 0.0f64;
        while watch.wall.elapsed().as_secs_f64() < 2.0 && watch.seconds() < 0.05 {
            sum += (0..100_000).map(|k| f64::from(k).sqrt()).sum::<f64>();
        }
        assert!(sum > 0.0 && watch.seconds() >= 0.05, "{} s", watch.seconds());
    }
}
