use super::*;
use crate::input::KeySet;
use crate::input::letters::us_letter;
use winit::keyboard::NamedKey;

/// The places of the three letter rows of a US keyboard.
const PLACES: [&[KeyCode]; 3] = {
    use KeyCode::*;
    [
        &[KeyQ, KeyW, KeyE, KeyR, KeyT, KeyY, KeyU, KeyI, KeyO, KeyP],
        &[KeyA, KeyS, KeyD, KeyF, KeyG, KeyH, KeyJ, KeyK, KeyL, Semicolon],
        &[KeyZ, KeyX, KeyC, KeyV, KeyB, KeyN, KeyM, Comma, Period, Slash],
    ]
};

/// What layouts print there, without modifiers, as in xkeyboard-config.
const LAYOUTS: [(&str, [&str; 3]); 14] = [
    ("us", ["qwertyuiop", "asdfghjkl;", "zxcvbnm,./"]),
    ("de", ["qwertzuiop", "asdfghjklö", "yxcvbnm,.-"]),
    ("fr", ["azertyuiop", "qsdfghjklm", "wxcvbn,;:!"]),
    ("fr bepo", ["bépoèˆvdlj", "auie,ctsrn", "êàyx.k'qgh"]),
    ("us colemak", ["qwfpgjluy;", "arstdhneio", "zxcvbkm,./"]),
    ("us dvorak", ["',.pyfgcrl", "aoeuidhtns", ";qjkxbmwvz"]),
    ("tr f", ["fgğıodrnhp", "uieaütkmly", "jövcçzsb.,"]),
    ("ru", ["йцукенгшщз", "фывапролдж", "ячсмитьбю."]),
    ("ua", ["йцукенгшщз", "фівапролдж", "ячсмитьбю."]),
    ("gr", [";ςερτυθιοπ", "ασδφγηξκλ΄", "ζχψωβνμ,./"]),
    ("il", ["/'קראטוןםפ", "שדגכעיחלךף", "זסבהנמצתץ."]),
    ("ara", ["ضصثقفغعهخح", "شسيبلاتنمك", "ئءؤرﻻىةوزظ"]),
    ("ge", ["ქწერტყუიოპ", "ასდფგჰჯკლ;", "ზხცვბნმ,./"]),
    ("th", ["ๆไำพะัีรนย", "ฟหกดเ้่าสว", "ผปแอิืทมใฝ"]),
];

fn character(letter: char) -> Key {
    Key::Character(letter.to_string().into())
}

fn press(place: KeyCode, letter: char) -> Stroke {
    let letter = character(letter);
    Stroke { place, key: letter.clone(), letter, is_pressed: true, is_synthetic: false }
}

fn release(place: KeyCode, letter: char) -> Stroke {
    Stroke { is_pressed: false, ..press(place, letter) }
}

fn named(place: KeyCode, name: NamedKey) -> Stroke {
    let key = Key::Named(name);
    Stroke { place, key: key.clone(), letter: key, is_pressed: true, is_synthetic: false }
}

fn directions(keyboard: &Keyboard) -> Vec<Direction> {
    keyboard.directions().collect()
}

/// All places and what a layout prints there.
fn keys_with(rows: [&str; 3]) -> Vec<(KeyCode, char)> {
    let rows = PLACES.iter().zip(rows);
    let keys = rows.flat_map(|(places, letters)| places.iter().copied().zip(letters.chars()));
    let keys: Vec<_> = keys.collect();
    assert_eq!(keys.len(), 30);
    keys
}

#[test]
fn i1_a_direction_is_on_while_any_of_its_keys_is_down() {
    let mut keyboard = Keyboard::default();
    let right = named(KeyCode::ArrowRight, NamedKey::ArrowRight);
    assert_eq!(keyboard.stroke(&right), Some(Effect::Tilt(Direction::Right)));
    assert_eq!(keyboard.stroke(&press(KeyCode::KeyD, 'd')), Some(Effect::Tilt(Direction::Right)));
    // The keyboard repeats a held key.
    assert_eq!(keyboard.stroke(&press(KeyCode::KeyD, 'd')), None);
    assert_eq!(keyboard.stroke(&release(KeyCode::KeyD, 'd')), None);
    assert_eq!(directions(&keyboard), [Direction::Right]);
    keyboard.stroke(&Stroke { is_pressed: false, ..right });
    assert_eq!(directions(&keyboard), []);
    keyboard.stroke(&press(KeyCode::KeyD, 'd'));
    keyboard.release_all();
    assert_eq!(directions(&keyboard), []);
    keyboard.stroke(&release(KeyCode::KeyD, 'd'));
}

#[test]
fn i2_i3_on_every_layout_a_place_does_the_same_one_thing() {
    for (name, rows) in LAYOUTS {
        let mut keyboard = Keyboard::default();
        for (place, letter) in keys_with(rows) {
            let expected = keyboard.bindings().control_of(bindings::Key::Place(place));
            for shown in [letter, letter.to_uppercase().next().unwrap()] {
                // With Caps Lock, or a layout's own idea of it.
                let mut stroke = press(place, shown);
                stroke.letter = character(letter);
                let effect = keyboard.stroke(&stroke);
                match expected {
                    None => assert_eq!(effect, None, "{name}: {letter}"),
                    Some(Control::Act(action)) => {
                        assert_eq!(effect, Some(Effect::Act(action)), "{name}: {letter}");
                        assert_eq!(directions(&keyboard), [], "{name}: {letter} tilts, too");
                    }
                    Some(Control::Tilt(direction)) => {
                        assert_eq!(effect, Some(Effect::Tilt(direction)), "{name}: {letter}");
                        assert_eq!(directions(&keyboard), [direction]);
                    }
                }
                keyboard.stroke(&release(place, shown));
                assert_eq!(directions(&keyboard), []);
            }
        }
        // What is shown is what is printed on the key that does it.
        for (place, letter) in keys_with(rows) {
            assert!(us_letter(place).is_some());
            assert_eq!(keyboard.letters.name(place), letter.to_uppercase().to_string(), "{name}");
        }
    }
}

#[test]
fn i3_the_report_s_keys_and_wasd_lie_where_they_are_on_a_us_keyboard() {
    use KeyCode::*;
    let keys = [(KeyR, Action::Restart), (KeyN, Action::GoOn), (KeyP, Action::TogglePause)];
    for (place, action) in
        [&keys[..], &[(KeyB, Action::ZoomIn), (KeyS, Action::ZoomOut), (KeyT, Action::Level)]].concat()
    {
        let bindings = Bindings::new(KeySet::Report);
        assert!(bindings.keys_of(Control::Act(action)).contains(&bindings::Key::Place(place)));
    }
}

#[test]
fn i2_letters_are_us_until_the_layout_has_been_seen() {
    let mut keyboard = Keyboard::default();
    assert_eq!(keyboard.names_of(Control::Act(Action::Restart)).pop().unwrap(), "R");
    keyboard.stroke(&press(KeyCode::KeyR, 'к'));
    assert_eq!(keyboard.names_of(Control::Act(Action::Restart)).pop().unwrap(), "К");
    assert!(keyboard.take_unknown() && !keyboard.take_unknown());
    assert_eq!(keyboard.names_of(Control::Tilt(Direction::Towards)).pop().unwrap(), "US S");
    // The window system knows the layout.
    let told = vec![(KeyCode::KeyR, "К".to_owned()), (KeyCode::KeyS, "Ы".to_owned())];
    keyboard.set_layouts(vec![told], Some(&press(KeyCode::KeyR, 'к')));
    assert_eq!(keyboard.names_of(Control::Tilt(Direction::Towards)).pop().unwrap(), "Ы");
    let mut keyboard = Keyboard::default();
    // Digits are on the cap of the key although they need Shift on this layout.
    keyboard.stroke(&press(KeyCode::Digit1, '&'));
    assert_eq!(*keyboard.letters(), Letters::default());
}

#[test]
fn i3_with_ctrl_alt_or_the_logo_key_nothing_happens_and_shift_does_not_tilt() {
    for modifiers in
        [ModifiersState::CONTROL, ModifiersState::ALT, ModifiersState::SUPER, ModifiersState::SHIFT]
    {
        let mut keyboard = Keyboard::default();
        keyboard.set_modifiers(modifiers);
        assert_eq!(keyboard.stroke(&press(KeyCode::KeyD, 'd')), None);
        let restart = keyboard.stroke(&press(KeyCode::KeyR, 'r'));
        assert_eq!(restart.is_some(), modifiers == ModifiersState::SHIFT);
        // The modifier is released first, and the held key repeats.
        keyboard.set_modifiers(ModifiersState::empty());
        assert_eq!(keyboard.stroke(&press(KeyCode::KeyD, 'd')), None);
        assert_eq!(directions(&keyboard), []);
        keyboard.stroke(&release(KeyCode::KeyD, 'd'));
        keyboard.stroke(&press(KeyCode::KeyD, 'd'));
        keyboard.set_modifiers(modifiers);
        assert_eq!(directions(&keyboard), [Direction::Right], "a key that was down before goes on");
    }
}

#[test]
fn keys_are_told_by_name_where_they_print_nothing() {
    let mut keyboard = Keyboard::default();
    // Esc on Caps Lock, and arrows on a number pad without Num Lock.
    assert_eq!(keyboard.stroke(&named(KeyCode::CapsLock, NamedKey::Escape)), Some(Effect::Act(Action::Menu)));
    let up = named(KeyCode::Numpad8, NamedKey::ArrowUp);
    assert_eq!(keyboard.stroke(&up), Some(Effect::Tilt(Direction::Away)));
    // With Num Lock.
    let one = press(KeyCode::Numpad1, '1');
    assert!(matches!(keyboard.stroke(&one), Some(Effect::Act(Action::ToggleLayer(_)))));
    // Dead keys print nothing yet.
    let dead = Stroke { key: Key::Dead(Some('^')), ..press(KeyCode::KeyR, '^') };
    assert_eq!(keyboard.stroke(&dead), Some(Effect::Act(Action::Restart)));
}

#[test]
fn i10_a_key_that_was_down_before_the_window_had_the_keyboard_tilts_and_does_nothing_else() {
    let mut keyboard = Keyboard::default();
    let synthetic = |stroke: Stroke| Stroke { is_synthetic: true, ..stroke };
    assert_eq!(keyboard.stroke(&synthetic(press(KeyCode::KeyR, 'r'))), None);
    assert_eq!(keyboard.stroke(&press(KeyCode::KeyR, 'r')), None, "it repeats");
    assert!(keyboard.stroke(&synthetic(press(KeyCode::KeyA, 'a'))).is_some());
    assert_eq!(directions(&keyboard), [Direction::Left]);
}

#[test]
fn held_zoom_and_step_keys_go_on_and_others_do_not() {
    let mut keyboard = Keyboard::with(Bindings::new(KeySet::Report));
    for (place, letter, n) in [(KeyCode::KeyB, 'b', 3), (KeyCode::Period, '.', 3), (KeyCode::KeyR, 'r', 1)] {
        let n_done = (0..3).filter_map(|_| keyboard.stroke(&press(place, letter))).count();
        assert_eq!(n_done, n, "{letter}");
    }
}
