use super::unix::{expect_scale, wayland_answers, within};
use super::*;
use std::io::{Read, Write};
use std::os::unix::net::UnixListener;
use std::time::Duration;

#[test]
fn i7_scales_that_no_screen_has_are_not_used() {
    for scale in [0.0, -1.0, 1.0e9 / 96.0, f64::INFINITY, f64::NAN, 1.0e-300, 0.01] {
        assert!(!is_scale(scale), "{scale}");
    }
    assert!([0.5, 1.0, 1.25, 2.0, 4.0].into_iter().all(is_scale));
}

#[test]
fn i7_the_scale_variable_is_a_scale_or_one_line() {
    for good in [None, Some(""), Some("randr"), Some("RandR"), Some("1"), Some("1.5")] {
        assert!(expect_scale(good).is_ok(), "{good:?}");
    }
    for bad in ["abc", "0", "-1", "inf", "NaN", "1e9", "1,5", " 2"] {
        let failure = expect_scale(Some(bad)).unwrap_err().to_string();
        assert!(failure.contains("WINIT_X11_SCALE_FACTOR") && failure.contains("0.25 to 8"), "{failure}");
    }
}

#[test]
fn i6_a_window_system_that_never_answers_is_left_behind() {
    let asked = within(Duration::ZERO, || -> Result<(), String> {
        std::thread::sleep(Duration::from_secs(3600));
        Ok(())
    });
    assert_eq!(asked, None);
    assert_eq!(within(Duration::from_secs(600), || Ok(7)), Some(Ok(7)));
}

/// The probe's verdict on a server that answers with `reply`.
fn answer_to(reply: &'static [u8]) -> Result<(), String> {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("wayland-7");
    let listener = UnixListener::bind(&path).unwrap();
    let server = std::thread::spawn(move || {
        let (mut stream, _) = listener.accept().unwrap();
        stream.read_exact(&mut [0; 24]).unwrap();
        stream.write_all(reply).unwrap();
    });
    let answer = wayland_answers(path.as_os_str());
    server.join().unwrap();
    answer
}

#[test]
fn i6_a_socket_that_is_no_wayland_server_is_told_from_one() {
    let missing = tempfile::tempdir().unwrap().path().join("wayland-7");
    assert!(wayland_answers(missing.as_os_str()).is_err());
    assert!(answer_to(b"").is_err());
    assert!(answer_to(b"HTTP/1.1 400 Bad Request\r\n\r\n").is_err());
    assert!(answer_to(&[0xff; 64]).is_err());
    // The callback at once: no globals at all.
    let done: &[u8] =
        if cfg!(target_endian = "little") { &[3, 0, 0, 0, 0, 0, 12, 0, 1, 0, 0, 0] } else { &[] };
    if !done.is_empty() {
        assert_eq!(
            answer_to(done),
            Err("the Wayland server lacks wl_compositor, wl_shm, xdg_wm_base".to_owned())
        );
    }
}

#[test]
fn i7_a_panic_of_the_window_system_s_library_is_told_from_one_of_ours() {
    assert!(is_window_system(
        "/home/a/.cargo/registry/src/index/winit-0.30.13/src/platform_impl/linux/x11/mod.rs"
    ));
    assert!(is_window_system(r"C:\registry\winit-0.30.13\src\lib.rs"));
    assert!(!is_window_system("maze-app/src/app.rs"));
    assert!(guarded(|| 7).is_ok_and(|seven| seven == 7));
}
