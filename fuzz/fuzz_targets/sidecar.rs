#![no_main]

#[path = "../../maze-app/src/sidecar/text.rs"]
#[allow(dead_code)]
mod text;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    // Anything else is refused before it is read.
    let Ok(text) = str::from_utf8(bytes) else { return };
    if let Err((line, reason)) = text::Sidecar::parse(text) {
        assert!((1..=text.split('\n').count()).contains(&line), "line {line}");
        assert!(!reason.contains('\n'), "{reason:?}");
    }
});
