//! The progress of a long load, on a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use maze_core::printable;
use std::io::IsTerminal;
use std::path::Path;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

/// A shorter load shows no progress.
const PATIENCE: Duration = Duration::from_millis(500);
/// Time between two pictures of the spinner.
const BEAT: Duration = Duration::from_millis(100);

/// A spinner on stderr with the stage of the work; gone when dropped. Nothing at all where stderr is no terminal.
pub(crate) struct Progress {
    bar: ProgressBar,
    waiting: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Progress {
    pub(crate) fn of_file(path: &Path) -> Self {
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden());
        if !std::io::stderr().is_terminal() {
            return Self { bar, waiting: None };
        }
        bar.set_prefix(printable(&path.file_name().unwrap_or(path.as_os_str()).to_string_lossy()));
        if let Ok(style) = ProgressStyle::with_template("{spinner} {prefix}: {msg} ({elapsed})") {
            bar.set_style(style);
        }
        let (done, is_done) = channel();
        let shown = bar.clone();
        let show = move || {
            let mut wait = PATIENCE;
            while is_done.recv_timeout(wait) == Err(RecvTimeoutError::Timeout) {
                if wait == PATIENCE {
                    shown.set_draw_target(ProgressDrawTarget::stderr());
                }
                // The bar's own ticker would panic where no thread can be made.
                shown.tick();
                wait = BEAT;
            }
        };
        // Where no thread can be made no progress is shown; the work continues.
        let thread = std::thread::Builder::new().name("progress".to_owned()).spawn(show);
        Self { bar, waiting: thread.ok().map(|thread| (done, thread)) }
    }

    pub(crate) fn tell(&self, stage: &'static str) {
        self.bar.set_message(stage);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((done, thread)) = self.waiting.take() {
            drop(done);
            // A thread that only waits and shows cannot have failed in a way that matters here.
            let _ = thread.join();
        }
        self.bar.finish_and_clear();
    }
}
