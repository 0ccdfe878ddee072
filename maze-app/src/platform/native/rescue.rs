//! What must not be lost, nor left behind, when the program is ended from outside: by a signal, by a window system that goes
//! away, or by one that does not answer any more.

use crate::failure::{self, Failure};
use maze_core::printable;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Writes what there is.
type Save = Arc<dyn Fn() -> Result<(), Failure> + Send + Sync>;

/// What is saved when the program ends.
static SAVES: Mutex<Vec<Save>> = Mutex::new(Vec::new());

/// Temporary files that have not got their names yet.
static TEMPORARY: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Whether a window is open: when the process then ends without our doing, the window system's library has ended it.
static HAS_WINDOW: AtomicBool = AtomicBool::new(false);

/// What another thread may have to save, behind a lock that is held for moments.
pub(crate) type Shared<T> = Arc<Mutex<T>>;

/// Locks what is shared; a thread that panicked with it has left it whole.
pub(crate) fn lock<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

/// From now on this is done before the program ends from outside; until the guard is dropped.
pub(crate) fn keep(save: impl Fn() -> Result<(), Failure> + Send + Sync + 'static) -> Kept {
    let save: Save = Arc::new(save);
    lock(&SAVES).push(Arc::clone(&save));
    Kept(save)
}

/// Stands for something that is saved when the program is ended.
pub(crate) struct Kept(Save);

impl Drop for Kept {
    fn drop(&mut self) {
        lock(&SAVES).retain(|save| !Arc::ptr_eq(save, &self.0));
    }
}

/// Makes a temporary file that is removed when the program is ended, and returns what to call when it has its name or is gone.
pub(crate) fn temporary(
    make: impl FnOnce() -> std::io::Result<tempfile::NamedTempFile>,
) -> std::io::Result<tempfile::NamedTempFile> {
    // A signal waits until the file is known.
    let mut known = lock(&TEMPORARY);
    let file = make()?;
    known.push(file.path().to_path_buf());
    Ok(file)
}

/// Forgets a temporary file that has got its name, or is gone.
pub(crate) fn forget(path: &Path) {
    lock(&TEMPORARY).retain(|known| known != path);
}

/// Saves what there is and removes what is half-written; a failure is reported. While the guard lives no other thread makes a
/// temporary file or notices that its own is gone.
#[must_use = "the process ends while the guard lives"]
fn save_all() -> MutexGuard<'static, Vec<PathBuf>> {
    let saves = lock(&SAVES).clone();
    for save in saves {
        if let Err(failure) = save() {
            failure::note(&failure.to_string());
        }
    }
    let mut temporary = lock(&TEMPORARY);
    for path in temporary.drain(..) {
        // Gone is gone.
        let _ = std::fs::remove_file(path);
    }
    temporary
}

/// Waits for signals that end the program, on a thread of its own. Without threads they end it as they always do.
#[cfg(unix)]
pub(crate) fn watch_signals() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGQUIT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level;

    let ignored = ignored_signals();
    let wanted = [SIGINT, SIGTERM, SIGHUP, SIGQUIT].into_iter().filter(move |signal| !ignored(*signal));
    let wait = move || {
        let Ok(mut signals) = Signals::new(wanted) else { return };
        if let Some(signal) = signals.forever().next() {
            let _saved = save_all();
            // As shells report a process that a signal has ended.
            low_level::exit(128 + signal);
        }
    };
    // Where no thread can be made the signals end the program as they always do.
    let _ = std::thread::Builder::new().name("signals".to_owned()).spawn(wait);
}

#[cfg(not(unix))]
pub(crate) fn watch_signals() {}

/// Set when the program goes on after it was stopped, as by Ctrl+Z.
#[cfg(unix)]
static CONTINUED: std::sync::LazyLock<Arc<AtomicBool>> = std::sync::LazyLock::new(|| {
    let continued = Arc::new(AtomicBool::new(false));
    // Where it is not known, the time in between is dropped but for a few ticks.
    let _ = signal_hook::flag::register(signal_hook::consts::SIGCONT, Arc::clone(&continued));
    continued
});

/// Whether the program was stopped since the last call.
#[cfg(unix)]
pub(crate) fn was_stopped() -> bool {
    CONTINUED.swap(false, Ordering::SeqCst)
}

#[cfg(not(unix))]
pub(crate) fn was_stopped() -> bool {
    false
}

/// Which signals the program was started to ignore, as `nohup` does.
#[cfg(unix)]
fn ignored_signals() -> impl Fn(i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    move |signal| (1..=64).contains(&signal) && mask >> (signal - 1) & 1 == 1
}

/// While this lives, a process that ends was ended by the window system's library: Xlib does that when its connection breaks.
pub(crate) struct OpenWindow(());

impl OpenWindow {
    pub(crate) fn new() -> Self {
        static ONCE: std::sync::Once = std::sync::Once::new();
        ONCE.call_once(|| {
            // Without the hook the exit status is the library's, and what was played is lost.
            let _ = shutdown_hooks::add_shutdown_hook(on_exit);
        });
        HAS_WINDOW.store(true, Ordering::SeqCst);
        Self(())
    }
}

impl Drop for OpenWindow {
    fn drop(&mut self) {
        HAS_WINDOW.store(false, Ordering::SeqCst);
    }
}

extern "C" fn on_exit() {
    if HAS_WINDOW.swap(false, Ordering::SeqCst) {
        end("the connection to the window system is lost: what was played so far is saved");
    }
}

/// Saves what there is and ends the program with one line and exit status 2, whatever its other threads wait for.
fn end(reason: &str) {
    HAS_WINDOW.store(false, Ordering::SeqCst);
    let _saved = save_all();
    let _ = writeln!(std::io::stderr(), "maze-app: {}", printable(reason));
    #[cfg(unix)]
    signal_hook::low_level::exit(2);
    #[cfg(not(unix))]
    std::process::exit(2);
}

/// When the window's events were last looked at.
static BEAT: Mutex<Option<Instant>> = Mutex::new(None);

/// The window's events are looked at.
pub(crate) fn beat() {
    *lock(&BEAT) = Some(Instant::now());
}

/// Ends the program when it should have ended by itself and has not looked at the window's events for long: the window system may
/// have stopped.
pub(crate) fn end_after(time: Duration) {
    /// More than a slow driver needs for its first frame.
    const SILENCE: Duration = Duration::from_secs(10);
    const EVERY: Duration = Duration::from_millis(250);
    let started = Instant::now();
    beat();
    let wait = move || {
        let is_silent = || lock(&BEAT).is_none_or(|beat| SILENCE <= beat.elapsed());
        while started.elapsed() < time || !is_silent() {
            let asleep = Instant::now();
            std::thread::sleep(EVERY);
            if SILENCE / 2 < asleep.elapsed() {
                // This program was stopped itself.
                beat();
            }
        }
        if HAS_WINDOW.load(Ordering::SeqCst) {
            end("the window system does not answer: ended without it");
        }
    };
    let _ = std::thread::Builder::new().name("end".to_owned()).spawn(wait);
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn r18_a_program_that_goes_on_after_a_stop_is_told_once() {
        assert!(!was_stopped());
        signal_hook::low_level::raise(signal_hook::consts::SIGCONT).unwrap();
        assert_eq!([was_stopped(), was_stopped()], [true, false]);
    }
}
