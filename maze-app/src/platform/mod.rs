//! What is bound to a window system, files, a clock or threads.

pub(crate) mod native;
