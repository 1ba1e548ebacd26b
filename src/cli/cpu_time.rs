//! Processor time of this process, which does not depend on what else the machine does.

use std::time::Instant;

/// Ticks per second of the times in `/proc` (fixed for programs, whatever the kernel's own clock).
const TICKS: f64 = 100.0;

/// A stopwatch of processor time; of the clock on the wall where the system does not tell.
pub struct CpuTime {
    ticks: Option<f64>,
    wall: Instant,
}

impl CpuTime {
    pub fn start() -> Self {
        Self { ticks: ticks(), wall: Instant::now() }
    }

    /// Seconds since the start, of all threads together.
    pub fn seconds(&self) -> f64 {
        match (self.ticks, ticks()) {
            (Some(before), Some(now)) => (now - before) / TICKS,
            _ => self.wall.elapsed().as_secs_f64() * rayon::current_num_threads() as f64,
        }
    }
}

/// Ticks spent so far, in the program and for it.
fn ticks() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    // the name, in brackets, may hold anything; utime and stime are fields 14 and 15
    let rest = text.rsplit_once(')')?.1;
    let mut fields = rest.split_whitespace().skip(11);
    let mut field = || fields.next()?.parse::<f64>().ok();
    Some(field()? + field()?)
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
