//! The game as a player meets it: screens by keys and by the mouse, without a window, a file or a clock.

use super::*;
use crate::input::{Control, Key as BoundKey, Stroke};
use crate::settings::SPEEDS;
use egui::{Key, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use maze_core::Tilt;
use winit::keyboard::{Key as WinitKey, KeyCode, NamedKey};

const LARGE: [f32; 2] = [1280.0, 720.0];
const SMALL: [f32; 2] = [640.0, 480.0];

/// What a platform does, as far as it can without one.
struct Platform {
    game: Game,
    chosen: Option<Choice>,
    orders: Vec<Order>,
}

impl Platform {
    fn obey(&mut self, order: Option<Order>) {
        let Some(order) = order else { return };
        if let Order::Load(source, role) = &order {
            let board = self
                .game
                .rules()
                .load(source)
                .and_then(|maze| Board::new(maze, source.clone(), *role, self.game.rules()))
                .and_then(|board| self.game.put(board));
            if let Err(failure) = board {
                self.game.trouble = Some(failure.to_string());
            }
        }
        self.orders.push(order);
    }
}

struct Desk<'a>(Harness<'a, Platform>);

fn rules(demo: bool) -> Rules {
    Rules {
        engine: EngineKind::Continuous,
        max_tilt_rad: 20_f64.to_radians(),
        demo,
        rounds: false,
        seed: 5,
        today: Date { year: 2026, month: 11, day: 27 },
    }
}

fn desk_with(size: [f32; 2], settings: Settings, demo: bool) -> Desk<'static> {
    let rules = rules(demo);
    let source = Source::random(Recipe::new(4, 3, Algorithm::default(), 5));
    let board = Board::new(source.load().unwrap(), source, Role::Look, &rules).unwrap();
    let zoom = settings.zoom(size[1]);
    let game = Game::new(board, Screen::Title, settings, rules);
    let platform = Platform { game, chosen: None, orders: Vec::new() };
    let show = |ui: &mut Ui, platform: &mut Platform| {
        let notes = Notes::default();
        let extras = Extras { notice: None, notes: &notes, pace: None, frames: None };
        platform.game.hud(&extras).show(ui);
        let chosen = platform.game.draw_screen(ui, &notes);
        platform.chosen = platform.chosen.take().or(chosen);
    };
    let builder = Harness::builder().with_size(vec2(size[0] / zoom, size[1] / zoom));
    let mut desk = Desk(builder.build_ui_state(show, platform));
    desk.settle();
    desk
}

fn desk() -> Desk<'static> {
    desk_with(LARGE, Settings::default(), false)
}

impl Desk<'_> {
    fn game(&mut self) -> &mut Game {
        &mut self.0.state_mut().game
    }

    fn top(&mut self) -> Screen {
        self.game().screens.top()
    }

    /// Some frames, and what was chosen in them.
    fn settle(&mut self) {
        for _ in 0..4 {
            self.0.step();
            let platform = self.0.state_mut();
            platform.game.settings_changed();
            if let Some(choice) = platform.chosen.take() {
                let order = platform.game.choose(choice).unwrap();
                platform.obey(order);
            }
        }
    }

    fn press(&mut self, key: Key) {
        if key == Key::Escape {
            let order = self.game().back().unwrap();
            self.0.state_mut().obey(order);
        } else {
            self.0.key_press(key);
        }
        self.settle();
    }

    fn act(&mut self, action: Action) {
        let order = self.game().act(action).unwrap();
        self.0.state_mut().obey(order);
        self.settle();
    }

    fn click(&mut self, label: &str) {
        self.0.get_all_by_label(label).next().unwrap().scroll_to_me();
        self.settle();
        self.0.get_all_by_label(label).next().unwrap().click();
        self.settle();
    }

    /// The label of what has the focus.
    fn focused(&mut self) -> String {
        let nodes = self.0.root().children_recursive();
        let mut focused = nodes.filter(|node| node.is_focused());
        focused.next().and_then(|node| node.accesskit_node().label()).unwrap_or_default()
    }

    /// Presses Down, and then Up, until that has the focus.
    fn go_to(&mut self, label: &str) {
        for key in [Key::ArrowDown, Key::ArrowUp] {
            for _ in 0..40 {
                if self.focused() == label {
                    return;
                }
                self.press(key);
            }
        }
        let nodes = self.0.root().children_recursive().collect::<Vec<_>>();
        let focused: Vec<_> = nodes.iter().filter(|node| node.is_focused()).collect();
        panic!("no key leads to {label}; the focus is on {focused:?}");
    }

    fn pass(&mut self, seconds: f64) {
        let mut left = seconds;
        while 0.0 < left {
            for _ in 0..self.game().advance(Duration::from_millis(30)) {
                self.game().tick().unwrap();
            }
            left -= 0.03;
        }
        self.settle();
    }
}

/// From the title, by the words on it.
const FROM_TITLE: [(&str, Screen); 6] = [
    ("Levels", Screen::Levels),
    ("Random maze", Screen::Random),
    ("Daily maze", Screen::Daily),
    ("Open a file", Screen::Open),
    ("How it works", Screen::HowItWorks),
    ("Settings", Screen::Settings),
];

#[test]
fn every_screen_is_reached_by_keys_and_esc_leads_back_to_where_the_focus_was() {
    let mut desk = desk();
    assert_eq!((desk.top(), desk.focused().as_str()), (Screen::Title, "Continue"));
    for (label, screen) in FROM_TITLE {
        desk.go_to(label);
        desk.press(Key::Enter);
        assert_eq!(desk.top(), screen);
        assert_ne!(desk.focused(), "", "{label}: something has the focus");
        desk.press(Key::Escape);
        assert_eq!((desk.top(), desk.focused().as_str()), (Screen::Title, label));
    }
    desk.press(Key::Escape);
    assert_eq!(desk.top(), Screen::Title, "one press too many does not end the game");
    desk.go_to("Quit");
    desk.press(Key::Enter);
    assert!(matches!(desk.0.state().orders.last(), Some(Order::Quit)));
}

#[test]
fn every_screen_is_reached_and_left_by_the_mouse() {
    for size in [LARGE, SMALL] {
        let mut desk = desk_with(size, Settings::default(), false);
        for (label, screen) in FROM_TITLE {
            desk.click(label);
            assert_eq!(desk.top(), screen);
            match screen {
                Screen::HowItWorks | Screen::Settings => {
                    desk.click("Back");
                }
                _ => desk.press(Key::Escape),
            }
            assert_eq!(desk.top(), Screen::Title);
        }
    }
}

#[test]
fn the_first_start_leads_to_a_rolling_ball_in_two_presses() {
    let mut desk = desk();
    desk.press(Key::Enter);
    assert!(desk.game().screens.is_playing());
    assert_eq!(desk.game().board.source.level_number(), Some(1));
    desk.game().control.tap(crate::input::Direction::Left);
    desk.game().control.hold([crate::input::Direction::Left].into_iter());
    desk.pass(0.5);
    assert_eq!(desk.game().board.session.phase(), Phase::Playing);
    assert_ne!(desk.game().board.session.ball().velocity.norm(), 0.0);
}

#[test]
fn p1_a_ball_that_a_tap_has_set_in_motion_comes_to_rest_soon_after() {
    let mut desk = desk();
    desk.press(Key::Enter);
    desk.game().control.hold([crate::input::Direction::Left].into_iter());
    desk.game().control.tap(crate::input::Direction::Left);
    desk.pass(0.35);
    desk.game().control.hold([].into_iter());
    desk.pass(0.3);
    assert!(0.1 < desk.game().board.session.ball().velocity.norm(), "it rolls");
    desk.pass(2.0);
    assert_eq!(desk.game().board.session.ball().velocity.norm(), 0.0);
    assert_eq!(desk.game().board.session.maze().ball, BallKind::Steel);
}

#[test]
fn p4_a_tap_tips_the_board_less_than_a_held_key_does_in_the_same_time() {
    let tilt_after = |n_ticks| {
        let mut control = TiltControl::new(20_f64.to_radians());
        control.hold([crate::input::Direction::Right].into_iter());
        control.tap(crate::input::Direction::Right);
        (0..n_ticks).for_each(|_| control.tick(0.03));
        control.tilt().world_from_maze().angle().to_degrees()
    };
    let (tap, held) = (tilt_after(4), tilt_after(16));
    assert!((2.0..5.0).contains(&tap), "{tap} degrees after 0.12 s");
    assert!(17.0 < held, "{held} degrees after 0.48 s");
}

#[test]
fn a_level_is_played_to_its_goal_and_the_next_one_follows() {
    let mut desk = desk_with(LARGE, Settings::default(), true);
    desk.click("Levels");
    desk.click("1  First Tilt");
    assert!(desk.game().screens.is_playing());
    desk.pass(60.0);
    assert_eq!(desk.top(), Screen::Result);
    assert_eq!(desk.game().board.session.phase(), Phase::Finished);
    assert_eq!(desk.focused(), "Next level", "the first time Enter goes on");
    desk.press(Key::Enter);
    assert_eq!(desk.game().board.source.level_number(), Some(2));
    assert!(desk.game().screens.is_playing());
    assert_eq!(desk.game().settings.memory.level, Some(2));
    desk.act(Action::Menu);
    assert_eq!((desk.top(), desk.focused().as_str()), (Screen::Paused, "Resume"));
    let before = desk.game().board.session.n_ticks();
    desk.pass(1.0);
    assert_eq!(desk.game().board.session.n_ticks(), before, "the clock stands");
    desk.press(Key::Escape);
    assert!(desk.game().screens.is_playing());
}

#[test]
fn again_is_offered_first_when_the_run_was_slower_and_the_difference_is_told() {
    let mut desk = desk_with(LARGE, Settings::default(), true);
    desk.press(Key::Enter);
    desk.pass(60.0);
    desk.click("Again");
    let title = desk.game().board.source.title();
    desk.game().best.insert(title, 3);
    desk.pass(60.0);
    assert_eq!((desk.top(), desk.focused().as_str()), (Screen::Result, "Again"));
    let text = format!("best so far 0:00.09   (+{})", ui::clock_text(desk.game().outcome.time_s - 0.09));
    assert!(desk.0.query_by_label(&text).is_some(), "{text}");
}

#[test]
fn a_run_in_progress_is_not_lost_without_asking_and_waits_under_continue() {
    let mut desk = desk();
    desk.press(Key::Enter);
    desk.game().board.session.tick(Tilt::from_half_tangents(0.05, 0.0)).unwrap();
    let source = desk.game().board.source.title();
    for action in [Action::GoOn, Action::NextLevel] {
        desk.act(action);
        assert_eq!((desk.top(), desk.focused().as_str()), (Screen::Leave, "Keep playing"));
        desk.press(Key::Enter);
        assert!(desk.game().screens.is_playing());
        assert_eq!(desk.game().board.source.title(), source);
    }
    // To the title and back: the ball is where it was.
    let ball = desk.game().board.session.ball();
    desk.act(Action::Menu);
    desk.click("Quit to title");
    assert_eq!(desk.top(), Screen::Title);
    assert_ne!(desk.game().board.source.title(), source);
    desk.click("Settings");
    desk.press(Key::Escape);
    desk.go_to("Continue");
    desk.press(Key::Enter);
    assert_eq!((desk.game().board.source.title(), desk.game().board.session.ball()), (source, ball));
    desk.act(Action::GoOn);
    desk.click("Leave");
    assert_eq!(desk.game().board.source.level_number(), Some(2));
}

#[test]
fn a_key_is_bound_in_the_settings_and_works_at_once() {
    let mut desk = desk();
    desk.click("Settings");
    desk.click("Page: keys");
    desk.click("restart");
    assert!(desk.game().screens.captures.is_some());
    let platform = desk.0.state_mut();
    let key = BoundKey::Place(KeyCode::KeyK);
    assert!(platform.game.screens.capture(key, &mut platform.game.settings));
    desk.settle();
    let restart = Control::Act(Action::Restart);
    assert_eq!(desk.game().keyboard.bindings().control_of(key), Some(restart));
    let letter = WinitKey::Character("k".into());
    let stroke =
        Stroke { place: KeyCode::KeyK, key: letter.clone(), letter, is_pressed: true, is_synthetic: false };
    assert_eq!(desk.game().keyboard.stroke(&stroke), Some(crate::input::Effect::Act(Action::Restart)));
    // A clash is told in words, and Esc leaves a line as it is.
    desk.click("restart");
    let platform = desk.0.state_mut();
    platform.game.screens.capture(BoundKey::Name(NamedKey::Space), &mut platform.game.settings);
    desk.settle();
    assert!(desk.0.query_by_label_contains("also pause").is_none(), "it is a note of the line");
    assert_eq!(desk.game().keyboard.bindings().conflicts(restart).count(), 1);
    desk.click("pause");
    desk.press(Key::Escape);
    assert_eq!((desk.top(), desk.game().screens.captures), (Screen::Settings, None));
    desk.click("All keys as usual");
    assert_eq!(desk.game().settings.controls, Settings::default().controls);
}

#[test]
fn the_board_shows_the_random_maze_that_is_chosen_and_the_level_that_has_the_focus() {
    let mut desk = desk();
    desk.click("Random maze");
    let before = desk.game().board.source.title();
    assert!(before.contains("14x9"), "{before}");
    desk.click("Another seed");
    assert_ne!(desk.game().board.source.title(), before);
    desk.click("Algorithm: wilson");
    assert!(desk.game().board.source.title().contains("wilson"));
    desk.press(Key::Escape);
    desk.click("Levels");
    assert_eq!(desk.game().board.source.level_number(), Some(1));
    desk.press(Key::ArrowRight);
    assert_eq!(desk.game().board.source.level_number(), Some(2));
    desk.press(Key::Enter);
    assert!(desk.game().board.is_played() && desk.game().screens.is_playing());
}

#[test]
fn a_file_that_cannot_be_opened_is_told_where_it_was_chosen() {
    let mut desk = desk();
    desk.click("Open a file");
    let order = desk.game().choose(Choice::Play(Start::File("nowhere.obj".into()))).unwrap();
    desk.0.state_mut().obey(order);
    desk.settle();
    assert_eq!(desk.top(), Screen::Open);
    assert!(desk.0.query_by_label_contains("nowhere.obj").is_some());
    assert_eq!(desk.game().settings.memory.recent, Vec::<std::path::PathBuf>::new());
}

#[test]
fn how_it_works_shows_one_figure_after_the_other_and_moves_tick_by_tick() {
    let mut desk = desk();
    desk.click("How it works");
    for (layer, _, _) in METHOD_STEPS {
        let shown: Vec<_> =
            crate::overlay::Layer::ALL.into_iter().filter(|one| desk.game().layers.has(*one)).collect();
        assert_eq!(shown, [layer]);
        desk.pass(1.0);
        let before = desk.game().board.session.n_played();
        desk.click("One tick");
        desk.pass(0.5);
        assert_eq!(desk.game().board.session.n_played(), before + 1);
        if desk.0.query_by_label("Next figure").is_some() {
            desk.click("Next figure");
        }
    }
    desk.click("Back");
    assert_eq!((desk.top(), desk.game().layers), (Screen::Title, Layers::default()));
}

#[test]
fn a_slower_game_is_slower_and_marked_in_the_result() {
    let mut settings = Settings::default();
    settings.accessibility.speed_percent = SPEEDS[2];
    let mut desk = desk_with(LARGE, settings, true);
    desk.press(Key::Enter);
    desk.pass(3.0);
    let n_ticks = desk.game().board.session.n_ticks();
    assert!((49..=51).contains(&n_ticks), "{n_ticks}");
    desk.pass(90.0);
    assert_eq!(desk.game().outcome.speed_percent, 50);
    assert!(desk.0.query_by_label("played at 50 % of the speed").is_some());
    assert!(desk.game().best.is_empty(), "no best time");
}

#[test]
fn everything_fits_and_can_be_read_at_every_size() {
    for (size, ui_scale) in
        [(LARGE, 1.0), (SMALL, 1.0), (LARGE, 2.0), ([1920.0, 1080.0], 1.0), ([480.0, 900.0], 1.0)]
    {
        let mut settings = Settings::default();
        settings.video.ui_scale = ui_scale;
        let zoom = settings.zoom(size[1]);
        let mut desk = desk_with(size, settings, false);
        for (label, _) in FROM_TITLE {
            desk.go_to(label);
            desk.press(Key::Enter);
            let width = size[0] / zoom;
            let nodes: Vec<_> = desk.0.root().children_recursive().collect();
            let shown = nodes.iter().filter(|node| node.accesskit_node().label().is_some());
            for node in shown {
                let (rect, label) = (node.rect(), node.accesskit_node().label());
                assert!(
                    0.0 <= rect.left() && rect.right() <= width + 0.5,
                    "{size:?} x{ui_scale}: {label:?} {rect}"
                );
                assert!(
                    13.0 <= rect.height() * zoom,
                    "{size:?}: {label:?} is {} pixels high",
                    rect.height() * zoom
                );
            }
            desk.press(Key::Escape);
        }
    }
}

#[test]
fn the_ghost_comes_along_to_the_next_maze() {
    let mut desk = desk();
    desk.press(Key::Enter);
    desk.act(Action::NextGhost);
    let name = desk.game().board.session.ghost().unwrap().0;
    desk.act(Action::NextLevel);
    assert_eq!(desk.game().board.source.level_number(), Some(2));
    assert_eq!(desk.game().board.session.ghost().map(|(name, _)| name), Some(name));
}
