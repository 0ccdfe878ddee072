//! Asks the X server what is printed on the keys; winit reports it with a key press only, and Wayland reports it to the focused window only.

use crate::input::Layout;

/// All layouts that the player can switch between; none where there is no X server to ask.
#[cfg(all(unix, not(target_os = "macos")))]
pub(super) fn read() -> Vec<Layout> {
    x11().unwrap_or_default()
}

/// There is no X server to ask.
#[cfg(not(all(unix, not(target_os = "macos"))))]
pub(super) fn read() -> Vec<Layout> {
    Vec::new()
}

/// The core protocol's table has some columns for each key: the first layout without and with Shift, the second layout
/// likewise. A key that has nothing in the second layout has the first one's letter.
#[cfg(all(unix, not(target_os = "macos")))]
fn x11() -> Option<Vec<Layout>> {
    use crate::input::lettered_places;
    use winit::keyboard::PhysicalKey;
    use winit::platform::scancode::PhysicalKeyExtScancode;
    use x11rb::connection::Connection;
    use x11rb::protocol::xproto::ConnectionExt;

    /// The kernel's numbers of keys begin at 1, and those of X11 at 9.
    const X11_OFFSET: u32 = 8;

    let (connection, _) = x11rb::connect(None).ok()?;
    let (first, last) = (connection.setup().min_keycode, connection.setup().max_keycode);
    let n_keys = (last - first).saturating_add(1);
    let table = connection.get_keyboard_mapping(first, n_keys).ok()?.reply().ok()?;
    let letter = |place, column: usize| {
        let key =
            PhysicalKey::Code(place).to_scancode()?.checked_add(X11_OFFSET)?.checked_sub(u32::from(first))?;
        let row = table.keysyms.chunks_exact(usize::from(table.keysyms_per_keycode)).nth(key as usize)?;
        let printed = |column: usize| xkeysym::Keysym::new(*row.get(column)?).key_char();
        let letter = printed(column).or_else(|| printed(0)).filter(|letter| !letter.is_control())?;
        Some((place, letter.to_uppercase().to_string()))
    };
    let layout = |column| lettered_places().filter_map(|place| letter(place, column)).collect();
    Some([0, 2].map(layout).to_vec())
}
