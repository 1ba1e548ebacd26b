//! Ctrl-C, SIGTERM and closed pipes: leave no half-written file behind, exit as shells expect.

/// Remove temporary files and exit with 128 + the signal's number when the process is interrupted
/// (130 for Ctrl-C, 143 for SIGTERM, 129 when the terminal goes away). A reader that closes the
/// pipe early (`gonio … | head`) ends the process silently.
///
/// Elsewhere than on Unix an interrupted process may leave a temporary file, never a half-written
/// file under the final name.
pub fn install() {
    #[cfg(unix)]
    unix::install();
}

#[cfg(unix)]
mod unix {
    use gonio::pending_file;
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    pub fn install() {
        // SAFETY: setting the default action is always sound; no other thread runs yet.
        unsafe { libc::signal(libc::SIGPIPE, libc::SIG_DFL) };

        let Ok(mut signals) = Signals::new([SIGINT, SIGTERM, SIGHUP]) else { return };
        std::thread::spawn(move || {
            if let Some(signal) = signals.forever().next() {
                pending_file::remove_all_pending();
                // Without the exit handlers: another thread may be in the middle of an HDF5 call.
                signal_hook::low_level::exit(128 + signal);
            }
        });
    }
}
