//! A long computation that can be stopped from outside, on threads of its own.
//!
//! Rays, sums and means run for minutes deep inside loops that return numbers and not errors. Whoever wants to
//! be able to stop them, a window or an interpreter whose user pressed Ctrl-C, starts them by [`run`] and keeps a
//! [`Cancel`]. The threads of that one computation carry the token; loops look at it every few milliseconds and,
//! once it is set, unwind to [`run`], as salsa's queries do. Nothing half-computed is seen by anyone.
//!
//! ```
//! use gonio::cancel::{Cancel, RunError, run};
//!
//! let cancel = Cancel::new();
//! assert_eq!(run(&cancel, 2, || 6 * 7)?, 42);
//! cancel.cancel();
//! let scene = gonio::scene::Scene::built_in(&Default::default())?;
//! let stopped = run(&cancel, 2, || gonio::simulate::table(&scene).map(|_| ()));
//! assert!(matches!(stopped, Err(RunError::Cancelled)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::fault::{Blame, Fault};
use rayon::{ThreadBuilder, ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

thread_local! {
    /// Of the computation that this thread works for.
    static TOKEN: RefCell<Option<Cancel>> = const { RefCell::new(None) };
}

/// Stops a computation; clones stop the same one.
#[derive(Clone, Debug, Default)]
pub struct Cancel(Arc<AtomicBool>);

/// Why a computation has no result.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case is")]
pub enum RunError {
    #[error("cancelled")]
    Cancelled,
    #[error("no threads could be started: {0}")]
    Threads(#[from] ThreadPoolBuildError),
}

impl Blame for RunError {
    fn fault(&self) -> Fault {
        Fault::Run
    }
}

impl Cancel {
    /// Of a computation that may go on.
    pub fn new() -> Self {
        Self::default()
    }

    /// Stop it: for good, for whatever is started with the same token.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether it was stopped.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// What unwinds.
struct Stop;

/// Do `work` on so many threads, which are gone when this returns (0: as many as rayon takes by itself), until it
/// is done or cancelled. What it starts by rayon runs on those threads.
///
/// # Errors
/// [`RunError::Cancelled`] within some milliseconds of [`Cancel::cancel`]; threads that the system refuses.
pub fn run<T: Send>(
    cancel: &Cancel,
    threads: usize,
    work: impl FnOnce() -> T + Send,
) -> Result<T, RunError> {
    let member = |thread: ThreadBuilder| {
        TOKEN.with(|token| *token.borrow_mut() = Some(cancel.clone()));
        thread.run();
    };
    let stopped = |pool: &ThreadPool| {
        catch_unwind(AssertUnwindSafe(|| {
            pool.install(|| {
                checkpoint();
                work()
            })
        }))
    };
    match ThreadPoolBuilder::new().num_threads(threads).build_scoped(member, stopped)? {
        Ok(done) => Ok(done),
        Err(payload) if payload.is::<Stop>() => Err(RunError::Cancelled),
        Err(payload) => resume_unwind(payload),
    }
}

/// Go on, unless the computation that this thread works for was cancelled. For loops whose steps take some
/// milliseconds at most, and take none but a few nanoseconds to ask.
pub fn checkpoint() {
    let cancelled = TOKEN.with(|token| token.borrow().as_ref().is_some_and(Cancel::is_cancelled));
    if cancelled {
        resume_unwind(Box::new(Stop));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::prelude::*;
    use std::time::{Duration, Instant};

    /// A loop without an end ends soon after it was told to, on all threads; panics stay panics.
    #[test]
    fn endless_loops_end() {
        let cancel = Cancel::new();
        let stopper = cancel.clone();
        let watch = Instant::now();
        std::thread::spawn(move || {
            std::thread::sleep(Duration::from_millis(20));
            stopper.cancel();
        });
        let result = run(&cancel, 3, || {
            (0..3).into_par_iter().for_each(|_| {
                while watch.elapsed() < Duration::from_secs(20) {
                    checkpoint();
                    std::thread::sleep(Duration::from_millis(1));
                }
            });
        });
        assert!(matches!(result, Err(RunError::Cancelled)));
        assert!(watch.elapsed() < Duration::from_secs(10));
        let panicked = catch_unwind(|| run(&Cancel::new(), 1, || panic!("on purpose")));
        assert_eq!(
            panicked.err().and_then(|p| p.downcast_ref::<&str>().copied()),
            Some("on purpose")
        );
    }

    /// Threads are those asked for, and a computation without a token is not touched.
    #[test]
    fn threads_are_those_asked_for() {
        let count = |threads| run(&Cancel::new(), threads, rayon::current_num_threads).unwrap();
        assert_eq!((count(1), count(3)), (1, 3));
        Cancel::new().cancel();
        checkpoint();
    }
}
